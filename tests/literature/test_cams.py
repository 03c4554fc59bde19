"""Cams against published cases, closed forms and dense polygons."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest
from tests.contract.calculations import solved
from tests.refusals import refused, said

import linkwright as lw
from linkwright import gallery, parts
from linkwright.cams.loading import CamMaterial

INCH = 0.0254


def program(rise: float = 0.024, law: str = "cycloidal", beta: float = 90.0) -> lw.MotionProgram:
    over = radians(beta)
    rest = (2 * math.pi - 2 * over) / 2
    return lw.MotionProgram(
        (lw.Segment(over, rise, law=law), lw.Segment(rest), lw.Segment(over, -rise, law=law), lw.Segment(rest))
    )


def test_the_flat_face_has_the_published_base_circle_and_width() -> None:
    """Cycloidal rise of 1 in over 90°, dwells of 90°, radius 0.25 in: base radius 1.893 in, width 2.55 in."""
    design = solved("cam_flat_face")
    assert design.cam.base_radius / INCH == pytest.approx(1.893, abs=5e-4)
    low, high = design.face
    assert (high - low) / INCH == pytest.approx(2.55, abs=5e-3)
    assert design.smallest_radius.value == pytest.approx(0.25 * INCH, rel=1e-8)


def test_the_cycloidal_cam_of_the_lecture() -> None:
    """S, V, A, J of the sine acceleration over β = 60°, rise and return, in closed form."""
    design = solved("cam_lecture")
    h, beta = 0.010, radians(60)
    phi = np.radians(np.linspace(0.0, 119.9, 500))
    u = np.where(phi < beta, phi, phi - beta) / beta
    sign = np.where(phi < beta, 1.0, -1.0)
    w = 2 * np.pi
    expected = [
        h * (np.where(phi < beta, 0, 1) + sign * (u - np.sin(w * u) / w)),
        sign * h / beta * (1 - np.cos(w * u)),
        sign * h / beta**2 * w * np.sin(w * u),
        sign * h / beta**3 * w * w * np.cos(w * u),
    ]
    for found, exact in zip(design.cam.program.curves(phi), expected, strict=True):
        assert found == pytest.approx(exact, abs=1e-12 * np.abs(exact).max())


@pytest.mark.parametrize("turn", [1.0, -1.0])
@pytest.mark.parametrize("offset", [-0.006, 0.0, 0.009])
def test_pressure_angle_and_curvature_are_those_of_the_closed_forms(turn: float, offset: float) -> None:
    """tan α = (s' - σe)/(d + s) and ρ of a curve in polar form (no offset)."""
    motion = program()
    cam = lw.Cam(motion, lw.Follower(roller_radius=0.008, offset=offset), 0.03, turn)
    wall = cam.walls[0]
    phi = np.linspace(0.01, 6.2, 301)
    s, v, a, _ = motion.curves(phi)
    height = math.sqrt(0.038**2 - offset**2) + s
    contact = wall.contact(phi)
    assert contact.pressure_angle == pytest.approx(np.arctan((v - turn * offset) / height), abs=1e-13)
    if offset == 0.0:
        bend = (height**2 + 2 * v**2 - height * a) / (height**2 + v**2) ** 1.5
        assert 1 / contact.curvature == pytest.approx(1 / bend - 0.008, rel=1e-10)


@pytest.mark.parametrize("kind", ["roller", "flat"])
@pytest.mark.parametrize("below", [False, True])
@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_an_oscillating_follower_touches_its_cam_and_does_not_cut_it(kind: str, below: bool, turn: float) -> None:
    """Rolled over by the follower at other angles, no contact point lies inside it; the contact lies on it."""
    follower = lw.Follower(
        kind, "oscillating", 0.01 if kind == "roller" else 0.0, pivot_distance=0.16, arm=0.13, below=below
    )
    cam = lw.Cam(program(0.25, "polynomial_4567", 120.0), follower, 0.07, turn)
    wall = cam.walls[0]
    phi = np.linspace(0.0, 2 * np.pi, 361)
    points = wall.contact(phi).point
    reach = wall.reach_table(points, phi)
    assert np.abs(np.diag(reach)).max() < 1e-15
    assert reach.max() < 1e-15
    h = 1e-6
    ahead, behind = (wall.contact(phi + d).point for d in (h, -h))
    slide = ((ahead - behind) * wall.contact(phi).normal.conj()).real / (2 * h)
    assert np.abs(slide).max() < 1e-9


def test_power_is_in_balance() -> None:
    """N·(normal velocity of the follower) = T·ω at every angle, for all followers."""
    loading = lw.CamLoading(30.0, 0.8, 10.0, lw.CamSpring(3000.0, 60.0))
    turning = lw.CamLoading(10.0, 0.02, 1.0, lw.CamSpring(20.0, 8.0))
    flat = lw.Follower("flat")
    arm = lw.Follower("roller", "oscillating", 0.01, pivot_distance=0.16, arm=0.13)
    face = lw.Follower("flat", "oscillating", pivot_distance=0.16)
    for follower, load, lift in (
        (lw.Follower(roller_radius=0.008, offset=0.005), loading, 0.02),
        (flat, loading, 0.01),
        (arm, turning, 0.25),
        (face, turning, 0.25),
    ):
        design = lw.Cam(program(lift, "modified_sine", 120.0), follower, 0.07, loading=load).solve()
        contact = design.contact
        h = 1e-6
        places = [design.wall.contact(design.angles + d) for d in (h, -h)]
        turns = [np.exp(1j * (design.angles + d)) for d in (h, -h)]
        normal = contact.normal * np.exp(1j * design.angles)
        # the contact moves along the cam's surface; its normal velocity in the frame is that of follower and cam
        moved = (places[0].point * turns[0] - places[1].point * turns[1]) / (2 * h)
        normal_speed = (moved * normal.conj()).real
        smooth = slice(2, -2)
        assert design.torque[smooth] == pytest.approx(
            (design.contact_force * normal_speed)[smooth], abs=2e-6 * np.abs(design.torque).max()
        )


def test_forces_are_greatest_between_the_places_of_the_curves() -> None:
    """m ω² s'' + F₀ + k s over cos α, tan α = (s' - e)/(s + s₀), of a fall by the cycloid, on 0.0001° steps."""
    program = lw.MotionProgram(
        (
            lw.Segment(radians(120), 0.025, law="polynomial_345"),
            lw.Segment(radians(60)),
            lw.Segment(radians(120), to=0.0, law="cycloidal"),
            lw.Segment(radians(60)),
        )
    )
    speed, beta = 20 * pi, radians(120)
    loading = lw.CamLoading(speed, 0.8, spring=lw.CamSpring(4000.0, 60.0))
    design = lw.Cam(program, lw.Follower(roller_radius=0.01, offset=0.008), 0.05, loading=loading).solve()
    u = np.linspace(0.0, 1.0, 1_200_001)
    s = 0.025 * (1 - u + np.sin(2 * pi * u) / (2 * pi))
    slope = -0.025 / beta * (1 - np.cos(2 * pi * u))
    effort = -0.8 * speed**2 * 0.025 / beta**2 * 2 * pi * np.sin(2 * pi * u) + 60.0 + 4000.0 * s
    force = effort * np.hypot(1.0, (slope - 0.008) / (s + np.sqrt(0.06**2 - 0.008**2)))
    for kind, k in (("max", force.argmax()), ("min", force.argmin())):
        found = design.extreme_force(kind)
        assert found.value == pytest.approx(force[k], rel=1e-9)
        assert found.place == pytest.approx(pi + beta * u[k], abs=1e-5)
    assert design.extreme_torque("min").value == pytest.approx((effort * slope).min(), rel=1e-9)


def test_a_chosen_spring_holds_on_both_sides_of_a_jump_of_the_acceleration() -> None:
    """A harmonic rise ends with s'' = -h π²/(2 β²) and is followed by a rest: the force is zero just before it."""
    program = lw.MotionProgram(
        (lw.Segment(radians(100), 0.015, law="simple_harmonic"), lw.Segment(radians(260), to=0.0))
    )
    loading, need = lw.CamLoading(100.0, 0.3, spring=lw.CamSpring(preload=0.0)), 0.3 * 100.0**2
    design = lw.Cam(program, lw.Follower("flat"), 0.045, loading=loading, spring_wanted=True).solve()
    assert design.loading.spring.stiffness == pytest.approx(need * pi**2 / (2 * radians(100) ** 2), rel=1e-9)


def test_the_largest_pressure_is_found_between_the_places_of_the_curves() -> None:
    """A flat face on a cam of radius of curvature r + s + s'', pressed with a load and the mass's force: Hertz."""
    rise, lift, speed, mass, load, base, width = radians(100.3), 0.02, 100.0, 0.5, 300.0, 0.3, 0.012
    back = lw.Segment(2.0 * pi - rise, to=0.0, law="simple_harmonic")
    program = lw.MotionProgram((lw.Segment(rise, lift, law="cycloidal"), back))
    material = CamMaterial(206e9)
    loading = lw.CamLoading(speed, mass, load)
    design = lw.Cam(program, lw.Follower("flat"), base, width=width, material=material, loading=loading).solve()
    u = np.linspace(0.0, 1.0, 2_000_001)
    s, second = lift * (u - np.sin(2 * pi * u) / (2 * pi)), lift * 2 * pi * np.sin(2 * pi * u) / rise**2
    force = load + mass * speed**2 * second
    known = np.sqrt(force * material.contact_modulus / (pi * width * (base + s + second)))
    found = design.largest_pressure
    assert found is not None and found.value == pytest.approx(known.max(), rel=1e-12)
    assert found.place == pytest.approx(u[known.argmax()] * rise, abs=1e-5)
    assert design.pressure is not None and design.pressure.max() < found.value * (1.0 - 1e-9)


def test_a_chosen_spring_just_holds_the_contact() -> None:
    design = solved("cam_roller")
    effort = design.loading.effort(design.cam.program, np.linspace(0, 6.28, 5000))
    assert effort.min() == pytest.approx(20.0, abs=1e-2)
    weaker = replace(design.cam, loading=replace(design.loading, spring=lw.CamSpring(1000.0, 5.0)))
    with refused("contact_lost", lw.ModelError, unit="N") as caught:
        weaker.solve()
    missing = float(caught.value.values["missing"])
    held = replace(weaker, loading=replace(weaker.loading, spring=lw.CamSpring(1000.0, 5.0 + 1.0001 * missing)))
    assert held.solve().extreme_force("min").value >= 0.0


def test_chosen_sizes_just_keep_their_limits() -> None:
    design = solved("cam_roller")
    limits = design.cam.limits
    assert abs(design.pressure_angle_rise.value) <= limits.pressure_angle * (1 + 1e-12)
    assert abs(design.pressure_angle_fall.value) <= limits.pressure_angle_fall * (1 + 1e-12)
    reached = [
        abs(design.pressure_angle_rise.value) / limits.pressure_angle,
        abs(design.pressure_angle_fall.value) / limits.pressure_angle_fall,
    ]
    assert max(reached) > 1 - 1e-6 and min(reached) > 0.999
    assert set(design.data()["shape"]) == {
        "pressure_angle_rise",
        "pressure_angle_fall",
        "smallest_radius",
        "hollow_radius",
    }


def test_without_offset_and_limits_of_curvature_the_base_circle_is_known() -> None:
    """The smallest d with s' <= (d + s) tan α everywhere: max of s'/tan α - s."""
    motion = program(0.02, "polynomial_345", 100.0)
    phi = np.linspace(0, 2 * np.pi, 400_001)
    s, v, _, _ = motion.curves(phi)
    least = (np.abs(v) / math.tan(radians(25.0)) - s).max()
    limits = lw.CamLimits(pressure_angle=radians(25.0))
    design = lw.Cam(motion, lw.Follower(roller_radius=0.005), limits=limits).solve()
    assert design.cam.base_radius + 0.005 == pytest.approx(least, rel=1e-7)


def test_an_undercut_is_refused_with_place_and_a_roller_that_fits() -> None:
    cam = lw.Cam(program(0.03, "cycloidal", 40.0), lw.Follower(roller_radius=0.03), 0.04)
    with refused("undercut", lw.ModelError, roller="30") as caught:
        cam.solve()
    fault = caught.value.findings[0].values
    assert fault["radius"] in caught.value.findings[0].remedy
    assert 20.0 < float(fault["start"]) < 30.0 < float(fault["end"]) < 40.0
    fits = float(fault["radius"])
    smaller = replace(
        cam, follower=replace(cam.follower, roller_radius=0.95e-3 * fits), base_radius=0.07 - 0.95e-3 * fits
    )
    assert smaller.solve().smallest_radius.value > 0.0


def test_rollers_of_a_pair_are_rigid_with_each_other() -> None:
    """The second roller keeps its distance from the first one and from the pivot, turned by the same angle."""
    design = solved("cam_oscillating")
    phi = np.linspace(0, 2 * np.pi, 200)
    turned = np.exp(1j * phi)
    first, second = (wall.pitch(phi)[0] * turned for wall in design.cam.walls)
    assert np.abs(first - second) == pytest.approx(np.full(200, abs(first[0] - second[0])), rel=1e-12)
    yoke = lw.Cam(
        program(), lw.Follower(roller_radius=0.01), 0.04, closure="conjugate", conjugate=lw.CamConjugate(0.045)
    ).solve()
    up, down = (wall.pitch(phi)[0] * turned for wall in yoke.cam.walls)
    assert np.abs(up + down) == pytest.approx(np.full(200, abs(up[0] + down[0])), rel=1e-12)


def test_a_groove_has_two_walls_a_roller_apart() -> None:
    design = lw.Cam(program(), lw.Follower(roller_radius=0.008), 0.04, closure="groove").solve()
    inner, outer = design.profile(180, 0), design.profile(180, 1)
    assert np.hypot(*(outer - inner).T) == pytest.approx(np.full(180, 0.016), rel=1e-12)


def test_the_barrel_is_its_unrolled_curve() -> None:
    design = solved("cam_barrel")
    steady = design.motion[1][(design.angles > radians(40)) & (design.angles < radians(140))]
    assert design.pressure_angle_rise.value == pytest.approx(math.atan(steady.max() / 0.045), rel=1e-9)


def test_residual_vibration_of_the_cam_is_that_of_its_rises() -> None:
    """The cycloidal law leaves h |sin πn|/(πn|1 - n²|) behind (closed form)."""
    cam = lw.Cam(
        program(0.02, "cycloidal", 90.0),
        lw.Follower(roller_radius=0.008),
        0.06,
        loading=lw.CamLoading(40.0, 0.5),
        elasticity=lw.CamElasticity(3e6),
        spring_wanted=True,
    )
    design = cam.solve()
    speeds = np.array([40.0, 90.0, 140.0])
    n = design.own_frequency / (2 * np.pi) * radians(90.0) / speeds
    exact = 0.02 * np.abs(np.sin(np.pi * n)) / (np.pi * n * np.abs(1 - n**2))
    assert design.residual_vibration(speeds)[:, 0] == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize("turn", [1.0, -1.0])
@pytest.mark.parametrize("offset", [0.01, -0.01])
def test_the_worked_pressure_angle_is_what_its_numbers_give(turn: float, offset: float) -> None:
    """tan α = (s' - e)/(d + s) counter-clockwise, (s' + e)/(d + s) clockwise: the formula on the page, read back."""
    follower = lw.Follower(roller_radius=0.008, offset=offset)
    design = lw.Cam(program(0.02, "cycloidal", 90.0), follower, 0.04, turn=turn).solve()
    (line,) = [each for each in design.worked().splitlines() if "arctan((s′" in each]
    _, formula, numbers, value = line.split(" = ")
    assert formula == f"arctan((s′ {'−' if turn > 0 else '+'} e)/(d + s))"
    read = eval(numbers.replace("−", "-"), {"arctan": math.atan})
    assert math.degrees(read) == pytest.approx(float(value.rstrip("°")), rel=1e-5)
    phi = np.linspace(0, 2 * math.pi, 360_001)
    s, rate = (np.asarray(each) for each in design.cam.program.curves(phi)[:2])
    angle = np.arctan((rate - turn * offset) / (math.sqrt(0.048**2 - offset**2) + s))
    assert abs(read) == pytest.approx(np.abs(angle).max(), rel=1e-5)


def test_the_other_wall_is_pressed_from_where_the_acceleration_changes_its_sign() -> None:
    """Without load the follower of a pair changes walls in the middle of rise and fall: 55° and 215°."""
    design = solved("cam_oscillating")
    assert np.degrees(design.wall_changes) == pytest.approx([55.0, 215.0], abs=1e-6)
    assert "55°, 215°" in design.text()


def changed(name: str, old: str, new: str) -> str:
    """The text of a calculation of the gallery with one place changed."""
    text = gallery.content(name).decode()
    assert text.count(old) == 1
    return text.replace(old, new)


@pytest.mark.parametrize("radius", ["0.6", "600"])
def test_a_second_cam_that_its_follower_does_not_reach_is_told(radius: str) -> None:
    text = changed("cam_oscillating", "{base_radius: 60 mm}", f"{{base_radius: {radius} mm}}")
    with pytest.raises(lw.ModelError) as caught:
        parts.loads(text, "cam.yaml").solve()
    said(caught.value.findings, "arm_reach", "conjugate", radius=radius)


def test_a_follower_without_stiffness_is_told() -> None:
    with pytest.raises(lw.ModelError) as caught:
        parts.loads(changed("cam_roller", "stiffness: 2 MN/m", "stiffness: 0 MN/m"), "cam.yaml")
    said(caught.value.findings, "range", "elasticity.stiffness", shown="0 MN/m")


@pytest.mark.parametrize("law", ["polynomial_345", "cycloidal", "modified_sine"])
def test_the_smallest_base_circle_under_a_flat_face_without_undercut(law: str) -> None:
    """r_b = max(-(s + s'')), which a limit of 0 on the radius of curvature asks for."""
    motion = program(0.02, law, 120.0)
    phi = np.linspace(0, 2 * math.pi, 400_001)[:-1]
    s, _, bend, _ = motion.curves(phi)
    design = lw.Cam(motion, lw.Follower("flat"), limits=lw.CamLimits(curvature_radius=0.0)).solve()
    assert design.cam.base_radius == pytest.approx(-(s + bend).min(), rel=1e-7)
    assert design.hollow_radius is None


def test_a_barrel_is_worked_with_its_own_formula() -> None:
    assert "arctan(s′/R) = arctan(23.8732/45) = 27.9467°" in solved("cam_barrel").worked()


def test_a_chosen_spring_leaves_just_the_effort_that_is_asked_for() -> None:
    """m ω² s'' + F_l + F_0 + k s at a hundred thousand places: never less, and no more than it takes."""
    for given in ("spring: {}", "spring: {preload: 30 N}", "spring: {stiffness: 12 N/mm}"):
        text = f"""
format: 1
kind: cam
follower: {{kind: roller, roller_radius: 8 mm}}
program:
  - {{rise: 20 mm, over: 95 deg, law: cycloidal}}
  - {{fall: 20 mm, over: 83 deg, law: modified_sine}}
  - {{dwell: 182 deg}}
base_radius: 60 mm
limits: {{contact_force: 20 N}}
speed: 420 rpm
mass: 1.3 kg
load: 7 N
{given}
"""
        design = parts.loads(text, "cam.yaml").solve()
        phi = np.linspace(0, 2 * math.pi, 100_001)[:-1]
        s, _, bend, _ = design.cam.program.curves(phi)
        spring = design.loading.spring
        effort = 1.3 * (420 * math.pi / 30) ** 2 * bend + 7 + spring.preload + spring.stiffness * s
        assert 20 * (1 - 1e-12) <= effort.min() <= 20 * (1 + 1e-6)


def test_a_spring_that_is_too_weak_for_the_effort_asked_for_is_told() -> None:
    cam = lw.Cam(
        program(0.02, "cycloidal", 90.0),
        lw.Follower(roller_radius=0.008),
        0.06,
        loading=lw.CamLoading(20.0, 0.5, 0.0, lw.CamSpring(2e3, 10.0)),
        limits=lw.CamLimits(contact_force=50.0),
    )
    text = cam.solve().text()
    assert " 10 N" in text and " 50 N" in text


def test_accelerations_that_jump_within_a_law_are_told() -> None:
    """Constant acceleration up and down: +, -, -, +, so that it jumps in the middle of either and nowhere else."""
    half = [lw.Segment(math.pi, rise=rise, law="constant_acceleration") for rise in (0.02, -0.02)]
    motion = lw.MotionProgram(tuple(half))
    assert motion.places_of_jumps(2) == pytest.approx((math.pi / 2, 3 * math.pi / 2))
    assert motion.smoothness == 1
    text = lw.Cam(motion, lw.Follower(roller_radius=0.008), 0.06).solve().text()
    assert " 90°, 270°" in text


def test_a_cam_that_moves_nothing_is_a_circle_of_a_given_size_only() -> None:
    rests = lw.MotionProgram((lw.Segment(2 * math.pi),))
    with refused("nothing_moves", lw.ModelError):
        lw.Cam(rests, lw.Follower(roller_radius=0.008), limits=lw.CamLimits(pressure_angle=0.5)).solve()
    round_cam = lw.Cam(
        rests, lw.Follower(roller_radius=0.008), 0.06, loading=lw.CamLoading(10.0, 1.0, 5.0), spring_wanted=True
    ).solve()
    assert np.hypot(*round_cam.profile(90).T) == pytest.approx(0.06)
    assert round_cam.extreme_force("max").value == pytest.approx(5.0)


@pytest.mark.rotating
@pytest.mark.parametrize("law", ["modified_sine", "simple_harmonic", "constant_acceleration"])
def test_steady_deviation_against_integration(law: str) -> None:
    from scipy.integrate import solve_ivp

    motion = program(0.02, law, 90.0)
    cam = lw.Cam(
        motion,
        lw.Follower(roller_radius=0.008),
        0.06,
        loading=lw.CamLoading(60.0, 0.5),
        elasticity=lw.CamElasticity(4e5, 0.2),
        spring_wanted=True,
    )
    design = cam.solve()
    w, speed = design.own_frequency, 60.0
    period = 2 * math.pi / speed

    def bend(phi: float) -> float:
        return float(motion.curves(np.array([phi]))[2][0])

    found = solve_ivp(
        lambda t, y: [y[1], -0.4 * w * y[1] - w * w * y[0] - speed**2 * bend(speed * t)],
        (0.0, 4 * period),
        [0.0, 0.0],
        t_eval=np.linspace(3 * period, 4 * period, 20001),
        rtol=1e-9,
        atol=1e-12,
        max_step=period / 60,
        method="DOP853",
    )
    assert design.steady_deviation(np.array([speed]))[0] == pytest.approx(np.abs(found.y[0]).max(), rel=2e-6)


def test_an_undamped_follower_swings_without_end_where_a_harmonic_meets_it() -> None:
    motion = program(0.02, "cycloidal", 90.0)
    cam = lw.Cam(
        motion,
        lw.Follower(roller_radius=0.008),
        0.06,
        loading=lw.CamLoading(60.0, 0.5),
        elasticity=lw.CamElasticity(4e5),
        spring_wanted=True,
    )
    design = cam.solve()
    own = design.own_frequency
    found = design.steady_deviation(np.array([own / 5, own / 5.01, 0.0]))
    assert found[0] == math.inf and 0 < found[1] < 1 and found[2] == 0


@pytest.mark.rotating
def test_profiles_are_written_for_drawing_and_mill(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    design = solved("cam_roller")
    drawn = ezdxf.readfile(design.save_profile(tmp_path / "cam.dxf", 360))
    outlines = {e.dxf.layer: np.array(e.get_points("xy")) for e in drawn.modelspace().query("LWPOLYLINE")}
    assert set(outlines) == {"profile", "pitch", "cutter"}
    assert outlines["profile"] == pytest.approx(1e3 * design.profile(360), abs=1e-9)
    assert outlines["cutter"] == pytest.approx(1e3 * design.pitch_curve(360), abs=1e-9)
    mill = np.loadtxt(design.save_profile(tmp_path / "cam.txt", 360))
    assert mill[:-1, :2] == pytest.approx(outlines["cutter"], abs=1e-6) and np.all(mill[0] == mill[-1])
    lines = design.save_profile(tmp_path / "cam.csv", 360).read_text("utf-8").splitlines()
    assert len(lines) == 361 and lines[0].startswith("wall,angle [deg],x [mm]")
    with refused("file.exists", remedy="force=True"):
        design.save_profile(tmp_path / "cam.csv")
    with refused("cams.cutter_large", radius="10000") as caught:
        design.cutter_path(10.0)
    design.cutter_path(0.999e-3 * float(caught.value.values["most"]))
    assert design.draw(0.5, "zh").svg.count("lw-gear") >= 1


FILE = """
format: 1
kind: cam
name: c
follower: {FOLLOWER}
program:
  - {rise: 20 mm, over: 90 deg, law: cycloidal}
  - {dwell: 90 deg}
  - {fall: 20 mm, over: 90 deg, law: cycloidal}
  - {dwell: 90 deg}
REST
"""
ROLLER = "kind: roller, roller_radius: 8 mm"
WEAK = "base_radius: 40 mm\nspeed: 900 rpm\nmass: 2 kg\nspring: {stiffness: 1 N/mm, preload: 5 N}"
PRESSED = "limits: {pressure_angle: 30 deg, contact_pressure: 1 MPa}\nwidth: 1 mm\nload: 500 N"


@pytest.mark.parametrize(
    ("follower", "rest", "code", "key", "values"),
    [
        (ROLLER, "base_radius: -3 mm", "range", "base_radius", {"shown": "-3 mm"}),
        (ROLLER, "", "no_base", "base_radius", {}),
        (f"{ROLLER}, offset: 60 mm", "base_radius: 40 mm", "offset", "follower", {"offset": "60", "radius": "40"}),
        ("kind: roller", "base_radius: 40 mm", "no_roller", "follower", {}),
        ("kind: flat", "base_radius: 5 mm", "undercut_flat", "base_radius", {"start": "35.1236", "more": "27.8497"}),
        (
            "kind: roller, roller_radius: 45 mm",
            "base_radius: 5 mm",
            "undercut",
            "follower.roller_radius",
            {"roller": "45", "radius": "39.4246"},
        ),
        ("kind: knife", "base_radius: 40 mm\nclosure: groove", "closure_follower", "closure", {"closure": "groove"}),
        (ROLLER, "base_radius: 40 mm\nclosure: conjugate", "conjugate", "closure", {}),
        (ROLLER, WEAK, "contact_lost", "spring", {"unit": "N"}),
        (ROLLER, PRESSED, "no_size", "limits", {}),
        (ROLLER, "barrel_radius: 40 mm\nbase_radius: 40 mm\nclosure: conjugate", "conjugate", "closure", {}),
        ("kind: wheel", "base_radius: 40 mm", "unknown-word", "follower.kind", {"text": "wheel"}),
    ],
)
def test_what_is_no_cam_is_refused_with_place_and_remedy(
    follower: str, rest: str, code: str, key: str, values: dict[str, object]
) -> None:
    text = FILE.replace("FOLLOWER", follower).replace("REST", rest)
    with refused(code, lw.ModelError, **values) as caught:
        parts.loads(text).solve()
    assert {each.key for each in caught.value.findings} == {key}
    assert all(each.remedy for each in caught.value.findings)
    assert caught.value.findings[0].translate("zh") != caught.value.findings[0].translate("en")


def test_the_lift_has_the_followers_dimension() -> None:
    swinging = "kind: roller, motion: oscillating, roller_radius: 8 mm, pivot_distance: 90 mm, arm: 80 mm"
    with refused("wrong-dimension", lw.ModelError):
        parts.loads(FILE.replace("FOLLOWER", swinging).replace("REST", "base_radius: 40 mm"))


def test_the_base_circle_of_the_pitch_curve_is_said_beside_that_of_the_profile() -> None:
    """Books that give a roller's base circle mean the one or the other; here 40 mm and, with the roller, 48 mm."""
    design = parts.loads(FILE.replace("FOLLOWER", ROLLER).replace("REST", "base_radius: 40 mm")).solve()
    sizes = design.data()["sizes"]
    assert (sizes["base_radius"]["value"], sizes["prime_radius"]["value"]) == pytest.approx((0.040, 0.048))
    assert re.findall(r" (40|48) +mm", design.text()) == ["40", "48"]
    assert np.hypot(*design.pitch_curve(720).T).min() == pytest.approx(0.048, rel=1e-9)
