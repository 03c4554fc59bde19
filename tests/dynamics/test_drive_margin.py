"""Whether machines start: wedges and cranks with friction against the closed forms of textbooks."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw

RADIUS, FORCE = 0.1, 100.0
CRANK = """
format: 1
name: Pump
frame: {{points: {{O: [0 mm, 0 mm]}}}}
links:
  crank: {{points: [O, A], length: 100 mm}}
  rod: {{points: [A, B], length: {rod} mm}}
  slider: {{points: [B]}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B, friction: {friction}}}
assembly: {{B: forward}}
driver: {{turn: crank, about: O, speed: 60 rpm}}
loads:
  work: {{kind: force, on: slider, at: B, components: [-100 N, 0 N]}}
"""


def pump(*, rod: float = 300.0, friction: float = 0.0) -> lw.Mechanism:
    return lw.loads(CRANK.format(rod=rod, friction=friction))


def wedges(angle: float, friction: float) -> lw.Mechanism:
    """A wedge pushed to the right under a block that can only rise; it weighs 78.48 N, and only the incline rubs."""
    text = f"""
format: 1
name: Screw unrolled
frame: {{points: {{O: [0 mm, 0 mm], C: [200 mm, 40 mm]}}}}
links:
  lower: {{points: {{A: [0 mm, 0 mm], W: [200 mm, 40 mm]}}}}
  upper: {{points: [B], mass: 8 kg}}
joints:
  floor: {{kind: prismatic, guide: frame, through: O, direction: 0 deg, block: lower, at: A}}
  incline: {{kind: prismatic, guide: lower, through: W, direction: {180 - angle} deg, block: upper, at: B,
            block_angle: {180 - angle} deg, friction: {friction}}}
  column: {{kind: prismatic, guide: frame, through: C, direction: 90 deg, block: upper, at: B, block_angle: 90 deg}}
drawing: {{B: [200 mm, 40 mm]}}
driver: {{slide: floor, speed: 10 mm/s}}
cycle: {{duration: 1 s}}
gravity: [0, -9.81 m/s²]
"""
    return lw.loads(text)


@pytest.mark.parametrize("friction", [0.1, 0.2679491924311227, 0.5])
def test_a_wedge_needs_the_tangent_of_its_angle_and_that_of_friction(friction: float) -> None:
    """W·tan(α + ρ) to lift, efficiency tan α/tan(α + ρ); left alone it runs back where α > ρ (tan 15° = 0.268)."""
    found = lw.drive_margin(wedges(15.0, friction), steps=10)
    alpha, rho = math.radians(15.0), math.atan(friction)
    assert found.dimension == "force"
    assert found.starting.needed == pytest.approx(8 * 9.81 * math.tan(alpha + rho), rel=1e-12)
    assert found.starting.returning == pytest.approx(8 * 9.81 * math.tan(alpha - rho), rel=1e-10, abs=1e-10)
    assert found.efficiency == pytest.approx(math.tan(alpha) / math.tan(alpha + rho), rel=1e-12)
    assert found.holds.all() == (friction > 0.3) or friction == pytest.approx(math.tan(alpha))


def test_a_wedge_too_steep_for_its_friction_jams() -> None:
    """α + ρ ≥ 90°: no force pushes it in."""
    found = lw.drive_margin(wedges(60.0, math.tan(math.radians(31.0))), steps=10)
    assert found.verdict == "jam"
    assert np.isnan(found.starting.needed).all()
    assert lw.drive_margin(wedges(60.0, math.tan(math.radians(29.0))), steps=10).verdict == "no_drive"


def test_a_crank_jams_where_the_rod_leaves_the_cone_of_friction() -> None:
    """Against the load tan β = 1/μ is the end: sin θ = (l/r)·sin β; returning with it the crank never jams."""
    rod, friction = 110.0, 1.2
    found = lw.drive_margin(pump(rod=rod, friction=friction))
    sine = rod / 100.0 * math.sin(math.atan(1 / friction))
    (stretch,) = found.stretches
    assert stretch.kind == found.verdict == "jam"
    assert stretch.begin == pytest.approx(math.pi + math.asin(sine), abs=1e-8)
    assert stretch.end == pytest.approx(2 * math.pi - math.asin(sine), abs=1e-8)
    (sentence,) = found.findings
    assert "Pump" in sentence and "225.2" not in sentence and "jams between 224.765° and 315.235°" in sentence


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_torque_to_start_by_the_balance_of_the_slider(friction: float) -> None:
    """T = P r sin(θ + β)/(cos β - μ |sin β|) against the load, P on the way out; the piston's friction in between."""
    found = lw.drive_margin(pump(friction=friction), steps=72)
    theta = found.starting.input
    beta = np.arcsin(np.sin(theta) * RADIUS / 0.3)
    inwards = np.sin(theta) > 1e-12
    turn = np.where(inwards, 1.0, -1.0)
    expected = -FORCE * RADIUS * np.sin(theta + beta) / (np.cos(beta) + turn * friction * np.abs(np.sin(beta)))
    still = np.abs(np.sin(theta)) < 1e-12
    assert found.starting.needed[~still] == pytest.approx(expected[~still], rel=1e-10)


def test_the_peak_is_found_between_the_positions() -> None:
    coarse, fine = (lw.drive_margin(pump(), steps=steps).peak for steps in (16, 720))
    assert coarse.needed[0] == pytest.approx(fine.needed[0], rel=1e-9)
    assert coarse.input[0] == pytest.approx(fine.input[0], abs=1e-4)


def test_what_is_refused() -> None:
    with pytest.raises(lw.LinkwrightError, match="did you mean"):
        lw.drive_margin(pump(), driver="drver")
    with pytest.raises(lw.LinkwrightError, match="no driver"):
        lw.drive_margin(lw.load("gallery:truss"))
