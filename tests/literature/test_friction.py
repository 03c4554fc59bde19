"""Coulomb friction against formulas of statics: wedges, a lever on its pin, self-locking.

Wedge press with friction angle φ = atan μ on all three faces: the slope's resultant leans by α + φ from the
vertical, R = W / (cos(α+φ) - μ sin(α+φ)), and the drive is P = R sin(α+φ) + μ (w + R cos(α+φ)) (Beer & Johnston,
Statics, ch. 8: wedges).
"""

import math
import re

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw

WEDGE = """
format: 1
name: wedge press
frame: {points: {O: [0 m, 0 m]}}
links:
  lower: {points: [L], mass: 1 kg}
  upper: {points: [U], mass: 5 kg}
joints:
  floor: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: lower, at: L, friction: MU}
  slope: {kind: prismatic, guide: lower, through: L, direction: ANGLE deg, block: upper, at: U, friction: MU}
  wall: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: upper, at: U, friction: MU}
driver: {slide: floor, speed: -0.1 m/s, start: 0.05 m}
cycle: {from: 0.05 m, to: 0.01 m}
gravity: [0, -10 m/s²]
"""

LEVER = """
format: 1
name: lever on a rough pin
frame: {points: {O: [0 m, 0 m]}}
links:
  lever: {points: [O, A], length: 0.6 m, mass: 4 kg}
joints: {O: {kind: revolute, pin_radius: 30 mm, friction: 0.2}}
driver: {turn: lever, about: O, speed: SPEED rad/s}
gravity: [0, -10 m/s²]
"""


def wedge(friction: float, angle: float) -> lw.Mechanism:
    return lw.loads(WEDGE.replace("MU", str(friction)).replace("ANGLE", str(angle)))


PUMP = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 50 mm}
  rod: {points: [A, B], length: 200 mm, mass: 1 kg, inertia: 0.004 kg·m²}
  ram: {points: [B], mass: 2 kg}
joints:
  O: {kind: revolute, pin_radius: 10 mm, friction: 0.1}
  A: {kind: revolute, pin_radius: 10 mm, friction: 0.1}
  B: {kind: revolute, pin_radius: 10 mm, friction: 0.1}
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B, friction: 0.08}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 120 rpm}
gravity: [0, -9.81 m/s²]
loads:
  work: {kind: force, on: ram, at: B, components: [-1000 N, 0 N], phase: {of: guide, from: min, to: max}}
"""


@pytest.mark.parametrize("rod", [150.0, 200.0, 400.0])
def test_efficiency_is_the_work_done_over_the_work_supplied(rod: float) -> None:
    """1000 N over a stroke of 100 mm twice a second are 200 W; what more is supplied goes into friction."""
    mechanism = lw.loads(PUMP.replace("200 mm", f"{rod} mm"))
    forces = lw.solve_forces(mechanism, steps=48)
    table = lw.metrics(forces)
    supplied = table.value("mean_power")
    assert table.value("efficiency") == pytest.approx(200.0 / supplied, rel=1e-9)
    assert 0.85 < table.value("efficiency") < 0.95
    assert forces.friction_power.min() > 0.0
    swept = lw.study(mechanism, {"rod.length": np.array([1e-3 * rod])}, metrics=["efficiency"])
    assert swept["efficiency"][0] == pytest.approx(table.value("efficiency"), rel=1e-12)


def test_machines_without_friction_have_no_efficiency() -> None:
    assert "efficiency" not in lw.metrics(lw.solve_forces(wedge(0.0, 15.0), steps=4)).names


@pytest.mark.parametrize("angle", [15.0, 30.0])
@pytest.mark.parametrize("friction", [0.0, 0.1, 0.3])
def test_wedge_press(friction: float, angle: float) -> None:
    forces = lw.solve_forces(wedge(friction, angle), steps=4)
    lean = math.radians(angle) + math.atan(friction)
    resultant = 50.0 / (math.cos(lean) - friction * math.sin(lean))
    drive = resultant * math.sin(lean) + friction * (10.0 + resultant * math.cos(lean))
    assert forces.driver_effort("driver") == pytest.approx(np.full(5, -drive), rel=1e-10)
    if friction:
        ideal = 50.0 * math.tan(math.radians(angle))
        assert lw.metrics(forces).value("efficiency") == pytest.approx(ideal / drive, rel=1e-9)
    slope = forces.reaction("slope", on="upper")
    assert np.hypot(*slope.T) * math.sqrt(1 + friction**2) == pytest.approx(np.full(5, resultant), rel=1e-10)


def test_a_wedge_too_steep_for_its_friction_locks_and_says_so() -> None:
    with refused("forces.self_locking", name="wedge press", joint="slope", value="50 mm"):
        lw.solve_forces(wedge(0.8, 30.0), steps=4)


@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_friction_of_a_pin_resists_the_turning(speed: float) -> None:
    mechanism = lw.loads(LEVER.replace("SPEED", str(speed)))
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=[0.0, 1.0, 2.5]), static=True)
    weight = 40.0 * 0.3 * np.cos([0.0, 1.0, 2.5])
    assert forces.input_torque == pytest.approx(weight + np.sign(speed) * 0.2 * 0.03 * 40.0, rel=1e-12)


def test_the_power_of_friction_is_drawn_from_the_driver() -> None:
    rough = lw.solve_forces(lw.loads(LEVER.replace("SPEED", "2")))
    smooth = lw.solve_forces(lw.loads(LEVER.replace("SPEED", "2").replace("friction: 0.2", "friction: 0")))
    assert rough.input_torque.mean() > smooth.input_torque.mean() + 0.1
    assert np.abs(rough.power_residual).max() < 1e-12 * np.abs(rough.power).max()
    assert rough.balance_residual.max() < 1e-12 * 40.0


def test_friction_needs_the_radius_of_the_pin() -> None:
    text = LEVER.replace("SPEED", "2").replace("pin_radius: 30 mm, ", "")
    with refused("forces.needs_pin_radius", name="O"):
        lw.solve_forces(lw.loads(text))


@pytest.mark.parametrize("size", [1e-7, 1.0, 1e7])
def test_wedges_of_any_size_rise_by_the_tangent_of_their_angle(size: float) -> None:
    """Guides alone are placed by Newton's method, whose corrections are judged against the size of the machine."""
    text = store.text("wedge")
    grown, count = re.subn(r"([\d.]+) mm", lambda found: f"{float(found[1]) * 1e-3 * size!r} m", text)
    assert count > 2
    motion = lw.solve_motion(lw.loads(grown), steps=12)
    rise = 0.06 * np.sin(2 * math.pi * motion.time) * math.tan(math.radians(15))
    assert motion.point("B").position[:, 1] / size == pytest.approx(0.04 + rise, rel=1e-12)
