"""Pressed pins position by position, and curves of many machines, against each machine alone."""

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts
from linkwright.designs.sweep import sweep_curves
from linkwright.designs.tolerance import Clearance, Tolerance, ToleranceStudy
from linkwright.designs.tolerance.pins import exact, is_position

FOURBAR = {"crank.length": 1.0, "coupler.length": 3.5, "rocker.length": 2.5, "frame.O2.x": 4.0}
SLIDER = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod: {points: [A, B], length: 400 mm}
  slider: {points: [B], mass: 0 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {gas: {kind: force, on: slider, at: B, direction: 180 deg, magnitude: 500 N}}
"""


def study(**given: object) -> ToleranceStudy:
    tolerances = dict(zip(FOURBAR, (0.003, 0.006, 0.006, 0.008), strict=True))
    held = {name: Tolerance(t) for name, t in tolerances.items()}
    return ToleranceStudy(
        lw.load("gallery:crank_rocker"), **{"dimensions": held, "of": ("rocker.angle range",), **given}
    )  # type: ignore[arg-type]


@pytest.mark.parametrize(("direction", "sign"), [("180 deg", -1.0), ("0 deg", 1.0)])
def test_pressed_pin_of_a_rod_without_mass_changes_its_length(direction: str, sign: float) -> None:
    """A two-force rod: pushed together it is shorter by the clearance, pulled apart longer."""
    text = SLIDER.replace("direction: 180 deg, m", f"direction: {direction}, m")
    one = ToleranceStudy(
        lw.loads(text), clearances={"B": Clearance(1e-4, "rod", "pressed")}, curves=("B.x",), steps=36
    )
    found = one.solve()
    place, moved, deviation = found.curve("B.x")

    def travel(rod: float) -> np.ndarray:
        return 0.1 * np.cos(place) + np.sqrt(rod**2 - (0.1 * np.sin(place)) ** 2)

    change = travel(0.4 + sign * 1e-4) - travel(0.4)
    assert exact(one, "B.x") - travel(0.4) == pytest.approx(change, abs=1e-12)
    assert moved - travel(0.4) == pytest.approx(change, abs=2e-8)
    assert not deviation.any()


def test_first_order_follows_the_exact_solution_of_every_position() -> None:
    one = parts.load("gallery:pressed_pins")
    assert isinstance(one, ToleranceStudy)
    small = ToleranceStudy(one.mechanism, clearances=one.clearances, curves=("jaw.angle",), steps=24)
    found = small.solve()
    first = found.pressed("jaw.angle")
    whole = exact(small, "jaw.angle") - found.derivatives.curve("jaw.angle")
    assert np.abs(first - whole).max() < 0.01 * np.abs(whole).max()


def test_curves_of_forces_with_loads_in_phases_are_those_of_each_machine_alone() -> None:
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    lengths = {"toggle.length": np.array([0.999, 1.0, 1.001]) * crusher.dimension("toggle.length")}
    ((_, found),) = sweep_curves(crusher, lengths, outputs=["driver.effort", "jaw.angle"], steps=72)
    for k, length in enumerate(lengths["toggle.length"]):
        machine = crusher.with_dimensions({"toggle.length": float(length)})
        forces = lw.solve_forces(machine, steps=72)
        assert found["driver.effort"][k] == pytest.approx(forces.input_torque, rel=1e-8, abs=1e-6)
        turned = (found["jaw.angle"][k] - forces.motion.link("jaw").angle) / (2 * np.pi)
        assert turned == pytest.approx(np.round(turned), abs=1e-12)


def test_machines_that_do_not_pass_have_no_curves() -> None:
    rocker = lw.load("gallery:crank_rocker")
    lengths = {"coupler.length": np.array([3.5, 1.0])}
    ((_, found),) = sweep_curves(rocker, lengths, outputs=["rocker.angle"], steps=36)
    assert np.isfinite(found["rocker.angle"][0]).all() and np.isnan(found["rocker.angle"][1]).all()


def test_positions_are_told_from_rates() -> None:
    one = study()
    assert is_position(one, "rocker.angle") and is_position(one, "B.x")
    assert not is_position(one, "rocker.angular_velocity") and not is_position(one, "B.velocity.x")
