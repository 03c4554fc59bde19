"""A run that does not get going, or stands, says where and what is missing; metrics of drives."""

from __future__ import annotations

import pytest

import linkwright as lw
from linkwright.dynamics.run_text import RunText

HOIST = """
format: 1
name: Hoist
frame: {{points: {{O: [0 mm, 0 mm]}}}}
links: {{drum: {{points: [O, P], length: 100 mm, mass: 1 kg, mass_centre: [0 m, 0 m], inertia: 2 kg·m²}}}}
driver: {{turn: drum, about: O, speed: 20 rad/s}}
actuators:
  motor: {{kind: dc, on: drum, ratio: 10, stall_torque: {stall} N·m, no_load_speed: 250 rad/s}}
  brake: {{kind: brake, on: drum, torque: 6 N·m{brake}}}
loads: {{rope: {{kind: torque, on: drum, magnitude: {rope} N·m}}}}
run: {{for: 1 s}}
"""


def hoist(stall: float, rope: float = 0.0, brake: str = "") -> lw.Mechanism:
    return lw.loads(HOIST.format(stall=stall, rope=rope, brake=brake))


@pytest.mark.parametrize(("rope", "brake"), [(0.0, ""), (-6.0, ", from: 100 s")])
def test_a_motor_that_cannot_start(rope: float, brake: str) -> None:
    """5 N·m on the drum against 6, of a brake or of a rope that turns it back."""
    text = RunText(lw.run(hoist(0.5, rope, brake))).text()
    assert "does not start at 0°: it needs 6 N·m there, and its drive has 5 N·m, 1 N·m too little" in text
    assert "does not start" not in RunText(lw.run(hoist(0.7, rope, brake))).text()


def test_a_crank_that_stalls_on_its_way() -> None:
    """Where 8 N·m hold the piston's 100 N in their steepest position the crank comes to rest, short of it."""
    text = """
format: 1
name: Pump
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm, mass: 2 kg, inertia: 0.02 kg·m²}
  rod: {points: [A, B], length: 300 mm}
  slider: {points: [B], mass: 1 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {work: {kind: force, on: slider, at: B, opposes: velocity, magnitude: 100 N}}
actuators: {m: {kind: dc, on: crank, stall_torque: 8 N·m, no_load_speed: 20 rad/s}}
run: {for: 5 s}
"""
    mechanism = lw.loads(text)
    found = lw.run(mechanism)
    place, rate = found.end_state["driver"]
    (first, _second) = lw.drive_margin(mechanism).stretches
    assert rate == 0.0 and first.begin < place < first.end
    assert "stalls at" in RunText(found).text()


def test_numbers_of_drives_among_the_metrics() -> None:
    """10·1.2 N·m over 6; braked by 6 N·m and the rope's 2."""
    mechanism = hoist(1.2, -2.0, ", from: 100 s")
    table = lw.metrics(
        lw.solve_forces(mechanism), ["starting_margin", "run_up_time", "braking_time", "braking_angle"]
    )
    values = {row.metric: row.value for row in table}
    assert values["starting_margin"] == pytest.approx(6.0, rel=1e-9)
    assert values["braking_time"] == pytest.approx(2 * 20 / 8, rel=1e-9)
    assert values["braking_angle"] == pytest.approx(2 * 20**2 / 16, rel=1e-9)
    assert values["run_up_time"] == pytest.approx(lw.motor_duty(mechanism).run_up or 0.0, rel=1e-2)
