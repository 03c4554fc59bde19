"""Machines released under forces: accelerations, reactions, sticking, worked solutions."""

from __future__ import annotations

from importlib.resources import files
from math import cos, radians, sin

import pytest
from tests.dynamics.release_problems import PROBLEMS, compare, ladder

import linkwright as lw

G = 9.81
EXCAVATOR = pytest.param("excavator", marks=pytest.mark.rotating)
BLOCK = """
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{block: {{points: [B], mass: 2 kg}}}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: {slope} deg, block: block, at: B, friction: {mu}}}
driver: {{slide: guide, speed: 1 m/s}}
cycle: {{duration: 1 s}}
gravity: [0, -9.81 m/s²]
"""
ROD = """
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{rod: {{points: [O, A], length: 1.2 m, mass: {mass} kg, inertia: {inertia} kg·m²}}}}
driver: {{turn: rod, about: O, speed: 1 rad/s}}
gravity: [0, -9.81 m/s²]
"""


@pytest.mark.parametrize("made", PROBLEMS, ids=lambda made: made.__name__)
def test_problems_of_textbooks(made) -> None:  # type: ignore[no-untyped-def]
    problem = made()
    found = lw.release(lw.loads(problem.text), speed=dict(problem.rates))
    compare(
        problem,
        lambda link: float(found.motion.link(link).angular_acceleration[0]),
        lambda link, point: found.motion.point(f"{link}.{point}").acceleration[0],
        lambda joint, link: found.forces.reaction(joint, on=link)[0],
    )
    assert found.forces.balance_residual[0] < 1e-9


@pytest.mark.parametrize("made", PROBLEMS, ids=lambda made: made.__name__)
def test_worked_solutions_come_out(made) -> None:  # type: ignore[no-untyped-def]
    """Every line checks itself; the angular accelerations are among them."""
    problem = made()
    found = lw.release(lw.loads(problem.text), speed=dict(problem.rates))
    values = {each.column: each.value for each in found.worked().equations}
    for link, alpha in problem.alpha.items():
        assert values.get(f"{link}.angular_acceleration [rad/s²]", 0.0) == pytest.approx(alpha, rel=1e-10, abs=1e-10)


def test_a_swinging_rod_at_given_angle_and_rate() -> None:
    """α = -3 g cos φ/(2 l); reduced inertia m l²/3; energy J ω²/2."""
    found = lw.release(lw.loads(ROD.format(mass=3, inertia=0.36)), at=0.4, speed=2.0)
    assert found.accelerations == pytest.approx({"driver": -1.5 * G * cos(0.4) / 1.2}, rel=1e-14)
    assert found.mass_matrix == pytest.approx(3 * 1.2**2 / 3, rel=1e-14)
    assert found.generalized_forces == pytest.approx(-3 * G * 0.6 * cos(0.4), rel=1e-14)
    assert found.kinetic_energy == pytest.approx(0.5 * 1.44 * 4.0, rel=1e-14)
    assert found.outcome == "moves"


def test_a_block_slides_down_where_friction_is_small() -> None:
    found = lw.release(lw.loads(BLOCK.format(slope=30, mu=0.3)))
    slope = radians(30)
    assert found.outcome == "moves"
    assert found.accelerations["driver"] == pytest.approx(-G * (sin(slope) - 0.3 * cos(slope)), rel=1e-12)


def test_a_block_sticks_where_friction_holds_it() -> None:
    """tan 30° of 0.7 is needed; setting out either way it would be slowed down."""
    found = lw.release(lw.loads(BLOCK.format(slope=30, mu=0.7)))
    slope = radians(30)
    assert found.outcome == "sticks"
    assert found.accelerations == {"driver": 0.0}
    ways = sorted(way["driver"] for way in found.ways)
    expected = [-G * (sin(slope) + 0.7 * cos(slope)), -G * (sin(slope) - 0.7 * cos(slope))]
    assert ways == pytest.approx(expected, rel=1e-12)
    assert found.friction_used == pytest.approx(sin(slope) / (0.7 * cos(slope)), rel=1e-12)
    assert found.forces.reaction("guide")[0] == pytest.approx(
        [-2 * G * cos(slope) * sin(slope), 2 * G * cos(slope) ** 2], rel=1e-12
    )
    assert found.forces.balance_residual[0] < 1e-12
    assert "82.5 %" in found.worked().text()


def test_a_sliding_block_is_braked() -> None:
    found = lw.release(lw.loads(BLOCK.format(slope=0, mu=0.7)), speed=1.5)
    assert found.accelerations["driver"] == pytest.approx(-0.7 * G, rel=1e-12)
    assert lw.release(lw.loads(BLOCK.format(slope=0, mu=0.7)), speed=-1.5).accelerations["driver"] > 0


def test_one_block_sticks_while_another_slides() -> None:
    """On a slope of 20° with friction 0.5 the first holds, on one of 45° with 0.2 the second slides."""
    text = """
format: 1
frame: {points: {O: [0 m, 0 m], P: [1 m, 0 m]}}
links: {first: {points: [A], mass: 2 kg}, second: {points: [B], mass: 3 kg}}
joints:
  one: {kind: prismatic, guide: frame, through: O, direction: 20 deg, block: first, at: A, friction: 0.5}
  two: {kind: prismatic, guide: frame, through: P, direction: 45 deg, block: second, at: B, friction: 0.2}
drivers: {a: {slide: one, speed: 1 m/s}, b: {slide: two, speed: 1 m/s}}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""
    found = lw.release(lw.loads(text))
    slope = radians(45)
    expected = {"a": 0.0, "b": -G * (sin(slope) - 0.2 * cos(slope))}
    assert found.accelerations == pytest.approx(expected, rel=1e-10, abs=1e-10)
    assert found.outcome == "moves"
    assert found.forces.balance_residual[0] < 1e-10


def test_a_crank_without_mass_carries_nothing_where_its_yoke_sticks() -> None:
    """Nothing pushes the yoke along its guide, so that all joints in line with it rest with it, without a force."""
    text = (files("linkwright") / "gallery/scotch_yoke.yaml").read_text(encoding="utf-8")
    pins = "joints:\n" + "".join(f"  {name}: {{kind: revolute, pin_radius: 20 mm, friction: 0.4}}\n" for name in "OA")
    text = text.replace("joints:\n", pins).replace("at: Y}", "at: Y, friction: 0.4}") + "gravity: [0, -9.81 m/s²]\n"
    found = lw.release(lw.loads(text), at=0.1)
    assert found.outcome == "sticks"
    assert 0.0 <= found.friction_used <= 1.0
    assert found.forces.reaction("A", on="die")[0] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert found.forces.reaction("guide", on="yoke")[0] == pytest.approx([0.0, 4.0 * 9.81], rel=1e-9)


def test_a_load_at_a_dead_point_of_its_way() -> None:
    """A force against the motion of a block that is at rest for a moment does nothing there."""
    found = lw.release(lw.load("gallery:chain_drive"))
    assert found.outcome == "moves"
    assert found.forces.balance_residual[0] < 1e-12
    assert lw.release(lw.load("gallery:pinion_between_racks")).outcome == "rests"


def test_teeth_that_stick_have_no_worked_solution() -> None:
    found = lw.release(lw.load("gallery:rack_and_rocker"))
    assert found.outcome == "sticks"
    with pytest.raises(lw.LinkwrightError, match="sticks"):
        found.worked()


def test_what_balances_rests() -> None:
    assert lw.release(lw.loads(ROD.format(mass=3, inertia=0.36)), at=radians(-90)).outcome == "rests"


def test_a_driver_may_keep_its_law() -> None:
    """Two rods, the first at constant speed: the second's acceleration is that of a rod on a turning support."""
    text = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 1 m}
  lower: {points: [A, T], length: 0.8 m, mass: 0.7 kg, inertia: 0.04 kg·m²}
drivers:
  one: {turn: upper, about: O, speed: 2 rad/s}
  two: {turn: lower, about: A, speed: 1 rad/s, start: 90 deg}
cycle: {duration: 1 s}
"""
    found = lw.release(lw.loads(text), prescribed=["one"])
    inertia = 0.04 + 0.7 * 0.4**2
    assert found.accelerations["one"] == 0.0
    assert found.accelerations["two"] == pytest.approx(-0.7 * 0.4 * 4.0 / inertia, rel=1e-12)
    assert found.worked().equations


@pytest.mark.parametrize(
    ("text", "options", "expected"),
    [
        (ROD.format(mass=0, inertia=0), {}, "no finite acceleration"),
        (ROD.format(mass=1, inertia=0), {"speed": {"crank": 1.0}}, "crank"),
        (ROD.format(mass=1, inertia=0), {"at": float("nan")}, "finite"),
    ],
)
def test_what_cannot_be_released_is_refused(text: str, options: dict[str, float], expected: str) -> None:
    with pytest.raises(lw.LinkwrightError, match=expected):
        lw.release(lw.loads(text), **options)  # type: ignore[arg-type]


def test_a_position_out_of_reach_is_refused() -> None:
    with pytest.raises(lw.PositionError):
        lw.release(lw.loads(ladder(60, 4.0, 12.0)), at=4.5)


def test_a_structure_has_no_coordinate() -> None:
    with pytest.raises(lw.LinkwrightError, match="no driver"):
        lw.release(lw.load("gallery:two_bars_equilibrium"))


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", EXCAVATOR, "geared_fivebar", "class_four_group"])
def test_machines_of_the_gallery(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    first = next(iter(mechanism.drivers))
    found = lw.release(mechanism, speed={first: -0.5})
    assert found.forces.balance_residual[0] < 1e-10 * max(1.0, abs(found.forces.rows.values).max())
    assert found.worked(language="zh").equations
