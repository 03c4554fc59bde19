"""The flat-bed printing press as one model, against the numbers of its report that are right, and its own demand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests import store
from tests.press_report import PHI

import linkwright as lw

#: Slider displacements of the report (m), its driver angles (deg) there.
SLIDER = (130 + 240 * np.arange(10) / 9) * 1e-3
DRIVER = np.array(PHI)
#: Bed less cylinder without a cam at the ten positions, mm, with the rounded lengths.
GAP = np.array([2.201, 0.682, -0.637, -1.255, -1.039, -0.163, 0.997, 1.921, 1.778, -1.397])
RADIUS, FIRST = 0.180, math.radians(30.79111)
OUTER = math.sqrt((0.198 + 0.7025) ** 2 - 0.0605**2)


def parts(motion: lw.Motion) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Driver angle φ (rad), slider's and bed's travel from the outer dead point, cylinder's surface from γ₁₀ (m)."""
    phi = np.unwrap(motion.link("shaft_1").angle) + math.pi / 2
    turned = -np.unwrap(motion.link("cylinder").angle)
    off = FIRST + 2 * SLIDER[0] / RADIUS - np.interp(math.radians(DRIVER[0]), phi, turned)
    turned += 2 * math.pi * round(off / (2 * math.pi))
    slider = OUTER - motion.point("D").position[:, 0]
    bed = -motion.point("U").position[:, 0]
    return phi, slider, bed, RADIUS * (turned - FIRST)


def at(motion: lw.Motion, values: np.ndarray, phi: np.ndarray) -> np.ndarray:
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(phi, values)(np.radians(DRIVER)))


@pytest.fixture(scope="module")
def press() -> lw.Mechanism:
    return store.machine("printing_press")


@pytest.fixture(scope="module")
def still(press: lw.Mechanism) -> lw.Motion:
    """The motion with the lower rack at rest, from a model whose cam only dwells."""
    cam = press.joints["compensating_cam"]
    rest = replace(cam, lifts=(0.0,) * len(cam.lifts))
    text = lw.dump(replace(press, joints={**press.joints, "compensating_cam": rest}))
    return lw.solve_motion(lw.loads(text), steps=1440)


def test_the_whole_press_has_one_freedom_and_is_solved_group_by_group(press: lw.Mechanism) -> None:
    structure = lw.structure(press)
    assert structure.mobility == 1 and len(press.links) == 12
    assert lw.solve_motion(press, steps=120).ok.all()


def test_without_the_cam_bed_and_cylinder_differ_as_reproduced(still: lw.Motion) -> None:
    phi, slider, _, surface = parts(still)
    assert 1e3 * at(still, surface, phi) == pytest.approx(2e3 * SLIDER, abs=2e-3)
    assert 1e3 * at(still, 2 * slider - surface, phi) == pytest.approx(GAP, abs=2e-3)
    limits = 1e3 * (slider.max() - slider.min())
    assert limits == pytest.approx(1e3 * (OUTER - math.sqrt((0.7025 - 0.198) ** 2 - 0.0605**2)), abs=2e-3)


def test_with_the_cam_bed_and_cylinder_agree_in_the_zone_to_a_millionth_of_a_millimetre(press: lw.Mechanism) -> None:
    motion = lw.solve_motion(press, steps=2880)
    phi, _, bed, surface = parts(motion)
    zone = (phi >= math.radians(DRIVER[0])) & (phi <= math.radians(DRIVER[-1]))
    assert zone.sum() > 800
    assert 1e3 * np.ptp((bed - surface)[zone]) < 1e-6
    rate = motion.point("U").velocity[zone, 0] - RADIUS * motion.link("cylinder").angular_velocity[zone]
    assert np.abs(rate).max() < 1e-6 * np.abs(motion.point("U").velocity[:, 0]).max()


def test_the_lift_in_the_file_is_the_one_computed_from_the_motion(press: lw.Mechanism, still: lw.Motion) -> None:
    phi, slider, _, surface = parts(still)
    turned = np.unwrap(still.link("bell_crank").angle)
    zone = tuple(np.interp(np.radians(DRIVER[[0, -1]]), phi, turned).tolist())
    angles, lifts = lw.compensating_lift(turned, surface - 2 * slider, zone)
    cam = press.joints["compensating_cam"]
    assert np.array(cam.angles) == pytest.approx(angles, abs=3e-8)
    assert np.array(cam.lifts) == pytest.approx(lifts, abs=1e-9)


def test_the_cam_can_be_made_and_holds_its_limits(press: lw.Mechanism) -> None:
    """Roller of 20 mm on a base circle of 60 mm: pressure angle, radius and the whole profile, no undercut."""
    joint = press.joints["compensating_cam"]
    phi = np.linspace(0, 2 * math.pi, 20_001)
    s, v, a = joint.lift.curves(phi)
    h = 0.080 + s
    assert np.degrees(np.abs(np.arctan(v / h)).max()) < 32.0
    bend = (h**2 + 2 * v**2 - h * a) / (h**2 + v**2) ** 1.5
    assert 1 / bend.max() - 0.020 > 0.030


def test_forces_are_in_balance_and_the_flywheel_is_known(press: lw.Mechanism) -> None:
    forces = lw.solve_forces(lw.solve_motion(press, steps=360))
    assert np.abs(forces.power_residual).max() < 1e-9 * np.abs(forces.input_torque).max() * 16
    work = np.trapezoid(forces.input_torque * 2 * math.pi * -150 / 60, forces.motion.time)
    bed = forces.motion.point("U").position[:, 0]
    assert work == pytest.approx(1500 * (bed.max() - bed.min()), rel=2e-2)
    running = lw.steady_running(forces, fluctuation=0.05)
    assert running.flywheel == pytest.approx(running.exact_flywheel, rel=0.1)


def test_the_rack_rests_where_the_table_rests() -> None:
    """The compensating lift has four reversals; its dwell of 40 equal lifts is one rest, with neither motion nor
    reversals, however few digits the table has."""
    press = store.machine("printing_press")
    cam = press.joints["compensating_cam"]
    assert cam.kind == "cam"
    angles, lifts = (np.array(each) for each in (cam.angles, cam.lifts))
    resting = angles[lifts == np.median(lifts[lifts > 0.0432])]
    assert len(resting) > 30
    value, rate, second = cam.lift.curves(np.linspace(resting[0], resting[-1], 400)[:-1])
    assert np.ptp(value) < 1e-16
    assert not rate.any()
    assert not second.any()
    motion = lw.solve_motion(press, steps=180)
    limits = lw.limit_positions(motion, "rack_guide")
    assert [each.kind for each in limits] == ["min", "max", "min", "max"]
    dead = [row.subject for row in lw.metrics(motion) if row.metric == "dead_point"]
    assert len([each for each in dead if each in ("rack_guide max", "rack_guide min")]) == 4
