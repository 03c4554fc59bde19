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


def pump(*, rod: float = 300.0, friction: float = 0.0, drive: str = "") -> lw.Mechanism:
    actuators = f"actuators: {{drive: {{{drive}}}}}" if drive else ""
    return lw.loads(CRANK.format(rod=rod, friction=friction) + actuators)


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


def test_a_stall_says_where_and_how_much_is_missing() -> None:
    """8 N·m against P r sin(θ + β)/cos β: the largest one is missing the rest, and they are equal at both ends."""
    found = lw.drive_margin(pump(drive="kind: constant, on: crank, torque: 8 N·m"))
    theta = np.linspace(math.pi, 2 * math.pi, 200_001)
    beta = np.arcsin(np.sin(theta) * RADIUS / 0.3)
    needed = -FORCE * RADIUS * np.sin(theta + beta) / np.cos(beta)
    (stretch,) = found.stretches
    assert stretch.kind == found.verdict == "stall"
    assert found.missing_torque == stretch.missing == pytest.approx(needed.max() - 8.0, rel=1e-8)
    assert stretch.worst == pytest.approx(theta[needed.argmax()], abs=1e-4)
    assert found.starting_margin == pytest.approx(8.0 / needed.max(), rel=1e-8)
    short = theta[needed > 8.0]
    assert [stretch.begin, stretch.end] == pytest.approx([short[0], short[-1]], abs=2e-5)
    assert f"{needed.max() - 8.0:.4g} N·m too little" in found.findings[0]
    enough = lw.drive_margin(pump(drive="kind: constant, on: crank, torque: 12 N·m"))
    assert enough.verdict == "starts" and not enough.stretches and enough.missing_torque == 0.0
    assert "starts from every position" in enough.findings[0]


def test_a_piston_has_no_lever_arm_at_its_dead_points() -> None:
    """A constant push outwards turns the crank from 180° to 360° only; from 0° to 180° no size of it would."""
    found = lw.drive_margin(pump(drive="kind: constant, along: guide, force: 1 kN"))
    (stretch,) = found.stretches
    assert stretch.kind == found.verdict == "dead_point"
    assert [stretch.begin, stretch.end] == pytest.approx([0.0, math.pi], abs=1e-6)
    assert "dead point" in found.findings[0]


def test_too_little_torque_on_the_average_slows_the_machine_down() -> None:
    """A brake of 5 N·m on the crank's side of a drive of 4 N·m."""
    found = lw.drive_margin(
        lw.loads(
            CRANK.format(rod=300, friction=0)
            + """  drag: {kind: torque, on: crank, magnitude: -5 N·m}
actuators: {drive: {kind: constant, on: crank, torque: 4 N·m}}
"""
        )
    )
    assert found.running is not None
    assert found.running_margin == pytest.approx(0.8, rel=1e-9)
    assert "less than the 5 N·m" in found.findings[-1]


def test_a_diagram_and_a_table() -> None:
    found = lw.drive_margin(pump(drive="kind: constant, on: crank, torque: 8 N·m"), steps=72)
    assert found.plot().kind == "drive_margin"
    assert len(found.columns()["needed_at_rest [N·m]"]) == 72
    assert "too little" in found.text()


def test_a_worm_gear_holds_what_it_lifts() -> None:
    """A rope of 60 N·m runs a drum back that is switched off, but not through a worm that holds 100 N·m."""
    drum = """
format: 1
name: Hoist
frame: {{points: {{O: [0 mm, 0 mm]}}}}
links: {{drum: {{points: [O, P], length: 100 mm, inertia: 2 kg·m²}}}}
driver: {{turn: drum, about: O, speed: 1 rad/s}}
loads: {{rope: {{kind: torque, on: drum, magnitude: -60 N·m}}}}
actuators:
  motor: {{kind: dc, on: drum, ratio: 40, efficiency: 0.45, stall_torque: 5 N·m, no_load_speed: 100 rad/s{worm}}}
"""
    plain, worm = (
        lw.drive_margin(lw.loads(drum.format(worm=each)), steps=8)
        for each in ("", ", self_locking: true, holding: 100 N·m")
    )
    for each in (plain, worm):
        assert each.starting_margin == pytest.approx(40 * 0.45 * 5 / 60, rel=1e-9)
    assert plain.starting.returning == pytest.approx(60.0) and not plain.holds.any()
    assert worm.starting.returning == pytest.approx(-40.0) and worm.holds.all()


def test_brakes_and_flywheels_are_part_of_the_load() -> None:
    wheel = (
        CRANK.format(rod=300, friction=0)
        + """
actuators:
  drive: {kind: constant, on: crank, torque: 30 N·m}
  drag: {kind: brake, on: crank, torque: 5 N·m}
  disc: {kind: flywheel, on: crank, inertia: 1 kg·m²}
  stop: {kind: brake, on: crank, torque: 500 N·m, from: 10 s}
"""
    )
    without, found = lw.drive_margin(pump()), lw.drive_margin(lw.loads(wheel))
    assert found.starting.needed == pytest.approx(without.starting.needed + 5.0, abs=1e-9)
    assert found.starting.available == pytest.approx(30.0)
    assert lw.drive_margin(
        lw.loads(wheel.replace("drive: {kind: constant, on: crank, torque: 30 N·m}", ""))
    ).verdict == ("no_drive")


def test_a_force_against_the_velocity_resists_at_rest_as_well() -> None:
    """The same torque as of a force that always points against the motion: P r |sin(θ + β)|/cos β."""
    against = CRANK.format(rod=300, friction=0).replace(
        "components: [-100 N, 0 N]", "opposes: velocity, magnitude: 100 N"
    )
    found = lw.drive_margin(lw.loads(against), steps=72).starting
    theta = found.input
    beta = np.arcsin(np.sin(theta) * RADIUS / 0.3)
    assert found.needed == pytest.approx(np.abs(FORCE * RADIUS * np.sin(theta + beta) / np.cos(beta)), abs=1e-9)


def test_a_free_slide_is_looked_at_between_its_dead_points() -> None:
    """The piston drives a crank with 4 N·m against it: F = M cos β/(r sin(θ + β)), at 50 N from x to x."""
    free = CRANK.format(rod=300, friction=0).partition("driver:")[0].replace("{B: forward}", "{A: left}")
    free += """driver: {slide: guide, free: true, start: 300 mm}
actuators: {push: {kind: constant, along: guide, force: 50 N}}
loads: {brake: {kind: torque, on: crank, magnitude: 4 N·m}}
"""
    found = lw.drive_margin(lw.loads(free), steps=60)
    assert found.dimension == "force" and found.running is None and found.verdict == "stall"
    low, high = found.stretches
    theta = np.linspace(1e-3, math.pi - 1e-3, 400_001)
    beta = np.arcsin(np.sin(theta) / 3)
    place = RADIUS * np.cos(theta) + 0.3 * np.cos(beta)
    moved = place[4.0 * np.cos(beta) / (RADIUS * np.sin(theta + beta)) < 50.0]
    assert [low.end, high.begin] == pytest.approx([moved.min(), moved.max()], abs=1e-6)


def test_a_dead_point_of_the_input_itself() -> None:
    """A piston that drives its crank to 0.1 mm from its end: cos ψ = (r² + l² - x²)/(2 r l)."""
    text = CRANK.format(rod=300, friction=0).partition("driver:")[0].replace("{B: forward}", "{A: left}")
    text += "driver: {slide: guide, speed: 10 mm/s, start: 300 mm}\ncycle: {from: 200.1 mm, to: 390 mm}\n"
    found = lw.drive_margin(lw.loads(text), steps=20)
    psi = math.acos((0.1**2 + 0.3**2 - 0.2001**2) / 0.06)
    assert math.sqrt(found.quality.min()) == pytest.approx(math.sin(psi), rel=1e-9)
    assert f"near 200.1 mm two links of 'Pump' are almost in line ({math.degrees(psi):.3g}°)" in found.findings[-1]
