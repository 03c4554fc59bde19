"""Driver laws over time against formulas of their own: periodic tables with drift, parameters, jerk, torque."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from tests.refusals import refused

import linkwright as lw

LEVER = """
format: 1
name: driven lever
parameters: {way: 0.4 rad, pace: 3 s}
frame: {points: {O: [0 m, 0 m]}}
links:
  lever: {points: [O, A], length: 0.5 m, mass: 2 kg, inertia: 0.3 kg·m²}
driver: {turn: lever, about: O, LAW}
cycle: {duration: 2 s}
"""


def lever(law: str) -> lw.Mechanism:
    return lw.loads(LEVER.replace("LAW", law))


def test_a_periodic_table_that_goes_on_by_whole_turns() -> None:
    """Each period adds one turn; within it the rest is a periodic spline through the rows without the drift."""
    times, degrees = np.array([0, 0.5, 1.1, 1.6, 2.0]), np.array([30.0, 95, 230, 300, 390])
    rows = f"time: [{', '.join(f'{t} s' for t in times)}], position: [{', '.join(f'{d} deg' for d in degrees)}]"
    mechanism = lever(f"table: {{{rows}, interpolation: periodic}}")
    at = np.array([-0.7, 0.0, 0.3, 1.3, 2.3, 4.3, 5.9])
    motion = lw.solve_motion(mechanism, times=at)
    rest = np.radians(degrees) - np.pi * times
    spline = CubicSpline(times, np.append(rest[:-1], rest[0]), bc_type="periodic")
    assert motion.input == pytest.approx(spline(at) + np.pi * at, rel=1e-12)
    assert motion.link("lever").angular_velocity == pytest.approx(spline(at, 1) + np.pi, rel=1e-12)
    assert motion.link("lever").angular_acceleration == pytest.approx(spline(at, 2), rel=1e-11, abs=1e-12)
    later = lw.solve_motion(mechanism, times=at + 2.0)
    assert later.input - motion.input == pytest.approx(np.full(7, 2 * np.pi), rel=1e-12)


def test_a_linear_table_is_straight_between_its_rows() -> None:
    law = "table: {time: [0 s, 0.5 s, 2 s], position: [10 deg, 40 deg, -20 deg], interpolation: linear}"
    motion = lw.solve_motion(lever(law), times=[0.1, 0.4, 0.8, 1.9])
    assert np.degrees(motion.input) == pytest.approx([16, 34, 28, -16])
    assert np.degrees(motion.link("lever").angular_velocity) == pytest.approx([60, 60, -40, -40])
    assert motion.link("lever").angular_acceleration == pytest.approx(np.zeros(4))
    with refused("loads.table_range", first=0.0, last=2.0, end=2.4):
        lw.solve_motion(lever(law), times=[0.1, 2.4])


@pytest.mark.parametrize("changes", [{}, {"way": 0.7}, {"way": 0.2, "pace": 5.0}])
def test_parameters_in_a_law_follow_their_changes(changes: dict[str, float]) -> None:
    mechanism = lever('position: "way*sin(2*pi*t/pace) + 20 deg"').with_dimensions(changes)
    way, pace = changes.get("way", 0.4), changes.get("pace", 3.0)
    motion = lw.solve_motion(mechanism, steps=10)
    w = 2 * np.pi / pace
    assert motion.input == pytest.approx(way * np.sin(w * motion.time) + np.radians(20), rel=1e-12)
    assert motion.link("lever").angular_velocity == pytest.approx(way * w * np.cos(w * motion.time), abs=1e-12)
    e = -way * w * w * np.sin(w * motion.time)
    assert motion.link("lever").angular_acceleration == pytest.approx(e, abs=1e-12)
    assert lw.solve_forces(motion).input_torque == pytest.approx((0.3 + 2 * 0.25**2) * e, abs=1e-12)


SLIDER_CRANK = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m}
  rod: {points: [A, B], length: 0.7 m}
  piston: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, LAW}
"""


def test_jerk_is_the_third_derivative_and_left_out_where_the_driver_accelerates() -> None:
    """Piston of a slider-crank at 3 rad/s: the third derivative of its place, by 30-digit differences."""

    def place(t: mpmath.mpf) -> mpmath.mpf:
        return mpmath.cos(3 * t) / 5 + mpmath.sqrt(mpmath.mpf("0.49") - mpmath.sin(3 * t) ** 2 / 25)

    with mpmath.workdps(30):
        largest = max(abs(float(mpmath.diff(place, t, 3))) for t in np.linspace(0.0, 2.1, 401))
    steady = lw.metrics(lw.solve_motion(lw.loads(SLIDER_CRANK.replace("LAW", "speed: 3 rad/s")), steps=90))
    assert steady["peak_jerk", "guide"].value == pytest.approx(largest, rel=1e-4)
    law = 'position: "0.1 rad*(t/(1 s))^3"}\ncycle: {duration: 4 s'
    gathering = lw.metrics(lw.solve_motion(lw.loads(SLIDER_CRANK.replace("LAW", law)), steps=90))
    assert "peak_jerk" in gathering.skipped and "peak_acceleration" in gathering


def test_a_changed_link_is_written_with_its_new_numbers() -> None:
    """Lengths, angles, masses and centres that were changed stand in the file; what was not keeps its form."""
    from linkwright.files.write import dump

    text = """
format: 1
name: bent
frame: {points: {O: [0 m, 0 m], Q: [1 m, 0 m]}}
links:
  arm: {points: [O, A, B], lengths: [0.4 m, 0.3 m], angle: 30 deg, mass: 2 kg, inertia: 0.1 kg·m²}
  bar: {points: [A, C], length: 0.9 m, also: {D: [0.2 m, 0.1 m]}, mass: 1 kg, mass_centre: [0.3 m, 0.05 m]}
  lever: {points: {Q: [0 m, 0 m], C: [0.1 m, 0.7 m]}, mass: 3 kg}
drawing: {A: [0.4 m, 0 m], B: [0.66 m, 0.15 m], C: [1 m, 0.7 m]}
driver: {turn: arm, about: O, speed: 2 rad/s}
"""
    changes = {
        "arm.lengths.0": 0.5,
        "arm.lengths.1": 0.25,
        "arm.angle": 0.7,
        "arm.mass": 4.0,
        "bar.length": 1.1,
        "bar.D.y": 0.2,
        "bar.mass_centre.x": 0.4,
        "lever.C.x": 0.15,
        "lever.mass": 6.0,
        "driver.speed": -3.0,
        "frame.Q.x": 1.2,
    }
    changed = lw.loads(text).with_dimensions(changes)
    again = lw.loads(dump(changed))
    for address, value in changes.items():
        assert again.dimension(address) == pytest.approx(value, rel=1e-14), address
    untouched = lw.loads(text).dimensions().keys() - changes.keys()
    assert len(untouched) > 5
    for address in untouched:
        assert again.dimension(address) == pytest.approx(lw.loads(text).dimension(address), rel=1e-14), address
    assert again.links["arm"].geometry == "bent" and again.links["bar"].geometry == "length"


def test_a_pin_with_friction_has_its_dimensions() -> None:
    text = LEVER.replace("LAW", "speed: 1 rad/s").replace(
        "driver:", "joints: {O: {kind: revolute, pin_radius: 20 mm, friction: 0.2}}\ndriver:"
    )
    mechanism = lw.loads(text)
    assert mechanism.dimension("O.friction") == 0.2 and mechanism.dimension("O.pin_radius") == pytest.approx(0.02)
    changed = mechanism.with_dimensions({"O.friction": 0.3, "O.pin_radius": 0.01}).joints["O"]
    assert (changed.friction, changed.pin_radius) == (0.3, 0.01)
    assert "O.friction" not in lw.loads(text.replace(", friction: 0.2", "")).dimensions()
