"""Cams as joints of a mechanism, against the cam by itself: its closed forms of motion, force and torque."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.reference.cam_models import GUIDED, PROGRAM, SPEED, SWINGING, follower, model

import linkwright as lw
from linkwright.errors import ModelError


@pytest.mark.parametrize("touch", ["roller", "knife", "flat"])
@pytest.mark.parametrize(("sense", "offset"), [("counterclockwise", 0.006), ("clockwise", -0.004)])
def test_a_guided_follower_moves_and_presses_as_its_cam_says(touch: str, sense: str, offset: float) -> None:
    mechanism = lw.loads(model(GUIDED, sense, touch, "18 mm", OFFSET=f"{1e3 * offset} mm"))
    motion = lw.solve_motion(mechanism, steps=120)
    forces = lw.solve_forces(motion)
    turn = 1.0 if sense == "counterclockwise" else -1.0
    load = lw.CamLoading(SPEED, 0.5, 60 + 0.5 * 9.81)
    program = mechanism.joints["lobe"].program
    cam = lw.Cam(program, follower(touch, offset=offset), 0.05, turn, loading=load)
    phi = turn * (motion.input - math.radians(20))
    s, v, a, _ = program.curves(phi)
    d = cam.follower.start_height(0.05)
    place = motion.point("P")
    assert place.position[:, 1] == pytest.approx(d + s, abs=1e-14)
    assert place.velocity[:, 1] == pytest.approx(v * SPEED, abs=1e-11)
    assert place.acceleration[:, 1] == pytest.approx(a * SPEED**2, abs=1e-7)
    effort = load.effort(program, phi)
    assert turn * forces.input_torque == pytest.approx(effort * v, abs=1e-8)
    assert np.abs(forces.power_residual).max() < 1e-12 * np.abs(forces.input_torque).max() * SPEED + 1e-12
    contact = cam.walls[0].contact(phi)
    push = effort / np.cos(contact.pressure_angle) * contact.normal * np.exp(1j * turn * phi)
    found = forces.reaction("lobe", on="slide")
    assert found[:, 0] + 1j * found[:, 1] == pytest.approx(push, abs=1e-7)
    arm = contact.point * np.exp(1j * turn * phi)
    moment = (arm.conj() * push).imag
    assert forces.couple("lobe", on="slide") == pytest.approx(moment, abs=1e-8)


@pytest.mark.parametrize("touch", ["roller", "knife", "flat"])
@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("sense", ["counterclockwise", "clockwise"])
def test_an_oscillating_follower_moves_and_presses_as_its_cam_says(touch: str, side: str, sense: str) -> None:
    """An arm right of the ray from the pivot to the cam's centre lies above a cam to the left of its pivot."""
    away = -1.0 if side == "right" else 1.0
    text = model(SWINGING, sense, touch, "15 deg", SIDE=side, MOMENT=f"{-3.0 * away} N·m")
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=120)
    forces = lw.solve_forces(motion)
    turn = 1.0 if sense == "counterclockwise" else -1.0
    load = lw.CamLoading(SPEED, 0.002, 3.0)
    program = mechanism.joints["lobe"].program
    rides = follower(touch, motion="oscillating", pivot_distance=0.16, arm=0.13, below=side == "left")
    cam = lw.Cam(program, rides, 0.07, turn, loading=load)
    phi = turn * motion.input
    s, v, a, _ = program.curves(phi)
    angle = math.pi + away * (rides.start_angle(0.07) + s)
    arm = motion.link("arm")
    assert np.exp(1j * arm.angle) == pytest.approx(np.exp(1j * angle), abs=1e-13)
    assert arm.angular_velocity == pytest.approx(away * v * SPEED, abs=1e-10)
    assert arm.angular_acceleration == pytest.approx(away * a * SPEED**2, abs=1e-6)
    effort = load.effort(program, phi)
    assert turn * forces.input_torque == pytest.approx(effort * v, abs=1e-8)
    contact = cam.walls[0].contact(phi)
    lever = np.abs(contact.along) if touch == "flat" else 0.13 * np.cos(contact.pressure_angle)
    push = effort / lever * contact.normal * np.exp(1j * turn * phi)
    found = forces.reaction("lobe", on="arm")
    assert found[:, 0] + 1j * found[:, 1] == pytest.approx(push, abs=1e-6)


def test_the_cam_may_be_driven_through_a_linkage_and_its_follower_drive_another() -> None:
    """A rocker carries the cam; the slide drives a further crank: power balance, rates as differences."""
    text = """
format: 1
name: cam in a linkage
frame: {points: {C: [-100 mm, 0 mm], O: [0 mm, 0 mm], G: [0 mm, 0 mm], R: [60 mm, 150 mm]}}
links:
  crank: {points: [C, A], length: 30 mm, mass: 1 kg}
  coupler: {points: [A, B], length: 100 mm, mass: 1 kg}
  rocker: {points: [O, B], length: 60 mm, mass: 1 kg, inertia: 0.01 kg·m²}
  slide: {points: {P: [0 mm, 0 mm], Q: [0 mm, 40 mm]}, mass: 0.5 kg, inertia: 0.001 kg·m²}
  rod: {points: [Q, T], length: 90 mm, mass: 0.3 kg}
  bell: {points: [R, T], length: 70 mm, mass: 0.4 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}
  lobe:
    kind: cam
    cam: rocker
    follower: slide
    at: P
    touch: roller
    roller_radius: 10 mm
    base_radius: 50 mm
    program: PROGRAM
assembly: {B: left, T: left}
driver: {turn: crank, about: C, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
""".replace("PROGRAM", PROGRAM.replace("LIFT", "15 mm"))
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=720)
    assert motion.ok.all()
    forces = lw.solve_forces(motion)
    assert np.abs(forces.power_residual).max() < 1e-10
    for name in ("P", "T"):
        place = motion.point(name)
        step = motion.time[1] - motion.time[0]
        rate = (np.roll(place.position, -1, 0) - np.roll(place.position, 1, 0)) / (2 * step)
        assert np.abs(rate - place.velocity).max() < 2e-3 * np.abs(place.velocity).max()
        second = (np.roll(place.velocity, -1, 0) - np.roll(place.velocity, 1, 0)) / (2 * step)
        assert np.abs(second - place.acceleration).max() < 3e-2 * np.abs(place.acceleration).max()
    assert lw.solve_motion(lw.loads(lw.dump(mechanism)), steps=24).point("T").position == pytest.approx(
        lw.solve_motion(mechanism, steps=24).point("T").position, abs=1e-12
    )
    assert mechanism.structure().mobility == 1


def test_a_table_of_lifts_moves_the_follower_through_its_points() -> None:
    angles = np.arange(0, 360, 6.0)
    lifts = 5.0 - 5.0 * np.cos(np.radians(angles)) + np.sin(np.radians(2 * angles)) + 1.0
    table = f"\n    angles: [{', '.join(f'{a} deg' for a in angles)}]"
    table += f"\n    lifts: [{', '.join(f'{x:.12g} mm' for x in lifts)}]"
    text = model(GUIDED, "counterclockwise", "roller", "1 mm", OFFSET="0 mm").replace(
        "\n    program: " + PROGRAM.replace("LIFT", "1 mm"), table
    )
    motion = lw.solve_motion(lw.loads(text), steps=360)
    phi = motion.input - math.radians(20)
    exact = 1e-3 * (5.0 - 5.0 * np.cos(phi) + np.sin(2 * phi) + 1.0)
    assert motion.point("P").position[:, 1] - 0.06 == pytest.approx(exact, abs=1e-9)


def test_contact_that_would_have_to_pull_is_said_with_its_place() -> None:
    """At 900 rpm without a spring the roller leaves the cam where m (g + a) < 0; in a groove it cannot."""
    text = model(GUIDED, "counterclockwise", "roller", "18 mm", OFFSET="6 mm").replace("90 rpm", "900 rpm")
    text = text[: text.index("loads:")]
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=720))
    program = forces.mechanism.joints["lobe"].program
    speed = 900 * 2 * math.pi / 60
    phi = forces.motion.input - math.radians(20)
    lost = 0.5 * (9.81 + program.curves(phi)[2] * speed**2) < 0
    first = math.degrees(forces.motion.input[lost][0])
    (lost_at,) = (lw.LinkwrightError(each) for each in forces.notes)
    missing = -0.5 * (9.81 + program.curves(phi)[2] * speed**2)
    push = forces.reaction("lobe", on="slide")[:, 1]
    assert np.allclose(push, -missing, rtol=0, atol=1e-9 * missing.max())
    most = np.linalg.norm(forces.reaction("lobe", on="slide")[lost], axis=1)
    where = math.degrees(forces.motion.input[lost][most.argmax()])
    assert lost_at.code == "forces.contact_lost_cam" and lost_at.values["name"] == "lobe"
    assert lost_at.values["most"] == f"{most.max():.4g} N" and lost_at.values["where"] == f"{where:g} deg"
    assert f"{first:g} deg" in str(lost_at.values["places"])
    steady = lw.loads(text.replace("touch: roller", "closure: groove\n    touch: roller"))
    assert not lw.solve_forces(lw.solve_motion(steady, steps=72)).notes
    pressed = lw.loads(model(GUIDED, "counterclockwise", "roller", "18 mm", OFFSET="6 mm"))
    assert not lw.solve_forces(lw.solve_motion(pressed, steps=72)).notes


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("follower: slide\n    at: P", "follower: cam\n    at: X", ("reference", "follower")),
        ("touch: knife", "touch: roller", ("missing-key", "roller_radius")),
        ("base_radius: 50 mm", "base_radius: 3 mm", ("range", "base_radius")),
        (
            "    program:",
            "    angles: [0 deg, 90 deg]\n    lifts: [0 mm, 2 mm]\n    program:",
            ("missing-key", "program"),
        ),
        ("touch: knife", "touch: knife\n    side: left", ("wrong-dimension", "program.0.rise")),
        ("direction: 90 deg, block: slide", "direction: 90 deg, block: slide", None),
    ],
)
def test_a_cam_that_cannot_be_is_refused(old: str, new: str, said: tuple[str, str] | None) -> None:
    text = model(GUIDED, "counterclockwise", "knife", "18 mm", OFFSET="6 mm").replace(old, new)
    if said is None:
        assert lw.loads(text)
        return
    with pytest.raises(ModelError) as refused:
        lw.loads(text)
    first = refused.value.findings[0]
    assert (first.code, first.key) == (said[0], f"joints.lobe.{said[1]}")


@pytest.mark.parametrize(
    ("touch", "radius", "reached"),
    [
        ("knife", 29.9, False),
        ("knife", 30.1, True),
        ("knife", 289.9, True),
        ("knife", 290.1, False),
        ("roller", 19.9, False),
        ("roller", 20.1, True),
        ("roller", 279.9, True),
        ("roller", 280.1, False),
        ("flat", 159.9, True),
        ("flat", 160.1, False),
    ],
)
@pytest.mark.parametrize("side", ["left", "right"])
def test_an_arm_reaches_base_circles_of_some_radii(touch: str, radius: float, reached: bool, side: str) -> None:
    """160 mm from pivot to cam and an arm of 130 mm: an edge or a roller's centre (10 mm) comes as near as 30 mm and
    as far as 290 mm; a flat face through the pivot touches circles up to the pivot."""
    text = model(SWINGING, "counterclockwise", touch, "1 deg", SIDE=side, MOMENT="3 N·m")
    text = text.replace("base_radius: 70 mm", f"base_radius: {radius} mm")
    if reached:
        assert lw.loads(text)
        return
    least, most = {"flat": (0, 160), "knife": (30, 290), "roller": (20, 280)}[touch]
    with pytest.raises(ModelError, match=rf"lobe\.base_radius.* {least} mm .* {most} mm"):
        lw.loads(text)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("points: [A, P], length: 130 mm", "points: {A: [0 mm, 0 mm], P: [0 mm, 0 mm]}"),
        ("A: [160 mm, 0 mm]", "A: [0 mm, 0 mm]"),
    ],
)
@pytest.mark.parametrize("touch", ["knife", "flat"])
def test_an_arm_or_a_distance_of_no_length_does_not_reach(old: str, new: str, touch: str) -> None:
    text = model(SWINGING, "counterclockwise", touch, "1 deg", SIDE="left", MOMENT="3 N·m")
    assert old in text
    with pytest.raises(ModelError) as refused:
        lw.loads(text.replace(old, new))
    last = refused.value.findings[-1]
    assert (last.code, last.key) == ("range", "joints.lobe.base_radius")
