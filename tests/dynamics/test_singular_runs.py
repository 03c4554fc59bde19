"""Runs through dead points and change points, against an independent integration and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.dynamics import models
from tests.dynamics.agreement import by_multibody, disagreements
from tests.dynamics.models import ELBOWS, ENGINE, bar
from tests.dynamics.windows import off

import linkwright as lw

DOUBLE_ROCKER = f"""
format: 1
name: Double rocker
frame: {{points: {{P: [0 m, 0 m], Q: [4 m, 0 m]}}}}
links:
  left: {bar("P", "A", 3.0)}
  bar: {bar("A", "B", 1.5)}
  right: {bar("Q", "B", 3.0)}
assembly: {{B: left}}
driver: {{turn: left, about: P, speed: 1 rad/s, start: 70 deg}}
gravity: [0, -9.81 m/s²]
"""


def dead_points(found: lw.Run) -> int:
    return [each.kind for each in found.events].count("dead_point")


@pytest.mark.parametrize(
    ("text", "end"), [(DOUBLE_ROCKER, 0.9), (ELBOWS, 0.6), (ENGINE, 0.9)], ids=["double rocker", "elbows", "engine"]
)
def test_motion_and_forces_beyond_dead_points(text: str, end: float) -> None:
    """The driver of the model passes its dead point; motion and joint forces are those of multipliers."""
    mechanism = lw.loads(text)
    found = lw.run(mechanism, duration=end, tolerance=1e-12)
    assert dead_points(found)
    assert found.energy_residual < 1e-10
    assert not disagreements(found, by_multibody(mechanism, np.linspace(0.0, end, 4)))


@pytest.mark.rotating
def test_a_triple_rocker_changes_its_coordinate_nine_times() -> None:
    mechanism = lw.loads(models.TRIPLE_ROCKER)
    found = lw.run(mechanism, duration=8.0, tolerance=1e-12)
    assert dead_points(found) > 8
    assert found.energy_residual < 1e-10
    within = {"within": 1e-8, "forces_within": 1e-7}
    assert not disagreements(found, by_multibody(mechanism, np.linspace(0.0, 8.0, 9)), **within)


def test_the_drivers_angle_goes_on_where_another_joint_is_the_coordinate() -> None:
    """Its rate and acceleration are the derivatives of its angle, also beyond the dead point."""
    found = lw.run(lw.loads(DOUBLE_ROCKER), duration=0.9, tolerance=1e-12)
    at = next(each.time for each in found.events if each.kind == "dead_point") + 0.05
    q, w, second = found.samples([at - 1e-3, at - 5e-4, at, at + 5e-4, at + 1e-3]).course["driver"]
    weights = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / (12 * 5e-4)
    assert weights @ q == pytest.approx(w[2], rel=1e-7)
    assert weights @ w == pytest.approx(second[2], rel=1e-7)
    assert found.motion(times=[at]).link("left").angle[0] == pytest.approx(math.remainder(q[2], math.tau))


def test_two_windows_swing_through_their_change_points() -> None:
    """As the pendulum that they are; and as the printed result of the benchmark."""
    found, gap = off(2)
    assert found.energy_residual < 1e-11
    assert gap < 1e-9
    place = found.motion(times=[10.0]).point("B0").position[0]
    assert place == pytest.approx([0.3284581112, 0.9445185383], abs=2e-9)


@pytest.mark.rotating
@pytest.mark.parametrize("count", [10, 40])
def test_rows_of_windows(count: int) -> None:
    found, gap = off(count, 4.0)
    assert found.energy_residual < 1e-10
    assert gap < 1e-9


def test_forces_are_smooth_through_a_change_point() -> None:
    """All rods are parallel: accelerations of the upper ends are those of the pendulum at the change point itself."""
    found = lw.run(lw.loads(models.windows(2)), speed=-1.0, duration=1.0, tolerance=1e-12)
    times = np.linspace(0.62, 0.98, 400)
    motion = found.motion(times=times)
    q = np.unwrap(motion.link("up0").angle)
    cross = times[np.argmin(np.abs(q))]
    close = cross + np.linspace(-2e-3, 2e-3, 9)
    near = found.motion(times=close)
    weight, inertia = (3 / 2 + 2) * 9.81, 1.0 + 2
    angle, rate = near.link("up1").angle, near.link("up1").angular_velocity
    assert near.link("up1").angular_acceleration == pytest.approx(-weight / inertia * np.cos(angle), rel=1e-9)
    assert rate == pytest.approx(near.link("up0").angular_velocity, rel=1e-9)
    assert np.abs(near.link("lie1").angular_acceleration).max() < 1e-6
    assert np.isfinite(found.joint_forces(times=close).reaction("B1", on="up1")).all()


def test_a_run_may_begin_at_a_dead_point_from_rest() -> None:
    """The slide of an engine at its end; the crank takes over."""
    found = lw.run(lw.loads(ENGINE), at=1.1, duration=0.3)
    assert found.energy_residual < 1e-8
    assert found.end_state["driver"][0] < 1.09


def test_a_speed_at_a_dead_point_says_nothing() -> None:
    with pytest.raises(lw.LinkwrightError, match="begins at a dead point, at driver = 1100 mm"):
        lw.run(lw.loads(ENGINE), at=1.1, speed=1.0)


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["triad", "stephenson_sixbar_triad", "fourth_order_group"])
def test_groups_without_closed_form_go_over_to_other_coordinates(name: str) -> None:
    """The state of Newton's steps is handed over with the position."""
    found = lw.run(lw.load(f"gallery:{name}"), duration=0.5, tolerance=1e-11)
    assert dead_points(found)
    assert found.energy_residual < 1e-8


@pytest.mark.parametrize("at", [-90.0, 20.0])
def test_where_nothing_has_inertia_a_run_is_refused(at: float) -> None:
    """At the ends of its stroke the slide's mass does not move with the massless crank."""
    text = ENGINE.replace(
        "driver: {slide: guide, speed: 1 m/s, start: 0.9 m}", "driver: {turn: crank, speed: 1 rad/s}"
    )
    text = text.replace("assembly: {A: left}", "assembly: {B: forward}").replace(
        "direction: 0 deg", "direction: -90 deg"
    )
    for mass, inertia in ((1, 0.3**2 / 12), (1, 0.8**2 / 12)):
        text = text.replace(f", mass: {mass} kg, inertia: {inertia!r} kg·m²", "")
    text = text.replace("turn: crank,", "turn: crank, about: O,")
    with pytest.raises(lw.LinkwrightError, match=r"nothing with a mass moves .* at driver = -90°"):
        lw.run(lw.loads(text), at=math.radians(at), duration=2.0)


def test_designs_that_come_near_dead_points_run_by_themselves() -> None:
    """The loop of many designs has no other coordinates, and would creep into the dead point."""
    mechanism = lw.loads(DOUBLE_ROCKER)
    found = lw.run_designs(mechanism, {"right.mass": [1.0, 1.3]}, duration=0.9)
    assert found.outcomes == ("ended", "ended")
    for number, mass in enumerate((1.0, 1.3)):
        alone = lw.run(mechanism.with_dimensions({"right.mass": mass}), duration=0.9)
        assert dead_points(alone)
        assert found.coordinates["driver"][number] == pytest.approx(alone.end_state["driver"][0], rel=1e-9)
