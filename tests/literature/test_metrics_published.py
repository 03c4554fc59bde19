"""Metrics that are printed, or have a closed form."""

from dataclasses import replace
from math import acos, asin, degrees, hypot, pi, sin, sqrt

import numpy as np
import pytest
from scipy.special import ellipe
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.analysis import MetricsTable, coupler_curve, four_bars, metrics
from linkwright.files.build import Model

RECIPROCATING = """
format: 1
name: slider-crank with a reciprocating mass
frame: {points: {O: [0 mm, 0 mm], P: [0 mm, 25 mm]}}
links:
  crank: {points: [O, A], length: 40 mm}
  rod: {points: [A, B], length: 160 mm}
  piston: {points: [B], mass: 2 kg}
joints: {cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 150 rad/s}
"""


def of(name: str, steps: int = 360) -> MetricsTable:
    return metrics(store.forces(name, steps))


@pytest.mark.parametrize("steps", [24, 25, 72])
def test_a_parallelogram_that_passes_its_change_points(steps: int) -> None:
    """Its coupler goes round a circle without turning: its pins share m r ω² evenly, and nothing drives it.

    With 24 and 72 steps two positions lie on the change points, with 25 between them.
    """
    linkage = replace(lw.load("gallery:parallelogram"), cycle=None)
    motion = lw.solve_motion(linkage, steps=steps, failures="mark")
    assert motion.modes and motion.ok.all() == (steps == 25)
    table = metrics(lw.solve_forces(motion))
    for row in every(table["peak_reaction"], least=4):
        assert row.value == pytest.approx(2.0 * 1.0 * 5.0**2 / 2, rel=1e-4), row.subject
    assert table.value("peak_input_torque") < 1e-4
    assert table["peak_acceleration", "rocker"].value < 1e-4
    assert table.value("peak_shaking_force") == pytest.approx(50.0, rel=1e-6)


@pytest.mark.parametrize("steps", [36, 360, 361])
def test_slider_crank_of_the_printing_press(steps: int) -> None:
    """Its printed numbers are compared in test_published; here H = √((l + r)² - e²) - √((l - r)² - e²),
    K = (π + θ)/(π - θ) with θ = asin(e/(l - r)) - asin(e/(l + r)), cos μ = (r ∓ e)/l, at any number of steps."""
    r, rod, e = 0.198, 0.7025, 0.0605
    theta = asin(e / (rod - r)) - asin(e / (rod + r))
    working, returning = acos((r - e) / rod), acos((r + e) / rod)
    table = of("slider_crank_offset", steps)
    assert table.value("quick_return_ratio") == pytest.approx((pi + theta) / (pi - theta), rel=1e-12)
    assert table["quick_return_ratio", "guide"].at % (2 * pi) == pytest.approx(asin(e / (rod + r)), abs=1e-9)
    stroke = sqrt((rod + r) ** 2 - e**2) - sqrt((rod - r) ** 2 - e**2)
    assert table.value("stroke") == pytest.approx(stroke, abs=1e-11)
    strokes = [row.value for row in table["transmission_angle_of_stroke"]]
    assert strokes == pytest.approx([working, returning], abs=1e-9)
    places = [row.at for row in table["transmission_angle_of_stroke"]]
    assert places == pytest.approx([pi / 2, 3 * pi / 2], abs=1e-4)
    smallest = table["transmission_angle", "rod+slider"]
    assert smallest.value == pytest.approx(returning, abs=1e-9)
    assert degrees(smallest.at) % 360 == pytest.approx(270, abs=1e-4)
    assert table.value("pressure_angle") == pytest.approx(pi / 2 - smallest.value)


GENEVA = """
format: 1
frame:
  points: {{O1: [0 mm, 0 mm], O2: [100 mm, 0 mm]}}
links:
  crank: {{points: [O1, A], length: 100 mm * sin(180 deg / {slots})}}
  die: {{points: [A]}}
  wheel: {{points: {{O2: [0 mm, 0 mm], T: [70 mm, 0 mm]}}}}
joints:
  slot: {{kind: prismatic, guide: wheel, through: O2, direction: [O2, T], block: die, at: A}}
assembly: {{slot: forward}}
driver: {{turn: crank, about: O1, speed: 1 rad/s}}
cycle: {{from: 180 deg / {slots} - 90 deg, to: 90 deg - 180 deg / {slots}}}
"""


@pytest.mark.parametrize(
    ("slots", "fastest", "largest"),
    [(3, 6.46, 31.39), (4, 2.41, 5.41), (5, 1.43, 2.30), (6, 1.00, 1.35), (8, 0.62, 0.70)],
)
def test_geneva_wheels(slots: int, fastest: float, largest: float) -> None:
    """Sun Huan, Theory of Machines and Mechanisms: largest ω₂/ω₁ and α₂/ω₁² of wheels with z slots.

    Of three slots the book has 31.44, its own formula λ(λ² - 1) sin φ/(1 - 2λ cos φ + λ²)² 31.39.
    """
    table = metrics(lw.solve_motion(lw.loads(GENEVA.format(slots=slots)), steps=90))
    ratio = sin(pi / slots)
    assert -table.value("velocity_ratio") == pytest.approx(ratio / (1 - ratio), rel=1e-12)
    assert -table.value("velocity_ratio") == pytest.approx(fastest, abs=0.006)
    assert table.value("peak_acceleration", "wheel") == pytest.approx(largest, abs=0.006)
    assert degrees(table.value("swing_angle")) == pytest.approx(360 / slots, rel=1e-9)


def test_shaper() -> None:
    """sin(θ/2) = r/d: K = (π + θ)/(π - θ), swing θ; the slotted lever without offset passes on all of the force."""
    theta = 2 * asin(110 / 380)
    table = of("shaper_quick_return", 90)
    assert table.value("quick_return_ratio", "lever") == pytest.approx((pi + theta) / (pi - theta), rel=1e-9)
    assert table.value("crank_angle_between_limits", "lever") == pytest.approx(theta, rel=1e-9)
    assert table.value("swing_angle", "lever") == pytest.approx(theta, rel=1e-9)
    assert table.value("stroke", "guide") == pytest.approx(2 * 0.540 * 110 / 380, rel=1e-9)
    lever = next(row for row in table["transmission_angle"] if "lever" in row.subject)
    assert lever.value == pytest.approx(pi / 2, abs=1e-7)


def test_crank_rocker() -> None:
    """Transmission angle with crank and frame in line, swing with crank and coupler in line, by the cosine rule."""
    table = of("crank_rocker", 45)
    frame, crank, coupler, rocker = 4.0, 1.0, 3.5, 2.5
    angles = [acos((coupler**2 + rocker**2 - d**2) / (2 * coupler * rocker)) for d in (frame - crank, frame + crank)]
    assert table.value("transmission_angle") == pytest.approx(min(min(a, pi - a) for a in angles), abs=1e-9)
    reach = [acos((frame**2 + rocker**2 - r**2) / (2 * frame * rocker)) for r in (coupler + crank, coupler - crank)]
    assert table.value("swing_angle") == pytest.approx(reach[0] - reach[1], rel=1e-9)
    assert table.value("grashof") == pytest.approx(coupler + rocker - frame - crank)
    assert table["grashof"][0].remarks[0].key == "grashof.crank_rocker"


def test_swing_conveyor_warns_of_the_singular_position() -> None:
    table = of("swing_conveyor")
    near = next(row for row in table["singularity"] if row.subject == "coupler+rocker")
    assert near.warnings and 300 < degrees(near.at) < 350
    assert not next(row for row in table["singularity"] if "slider" in row.subject).warnings


def test_scotch_yoke() -> None:
    """s = r cos θ: acceleration r ω², jerk r ω³, torque ½ m r² ω² at its peak, no mean power."""
    table = of("scotch_yoke", 72)
    r, w, m = 0.05, 20.0, 4.0
    assert table.value("peak_acceleration", "guide") == pytest.approx(r * w**2, rel=1e-12)
    assert table.value("peak_jerk", "guide") == pytest.approx(r * w**3, rel=1e-12)
    assert table.value("velocity_ratio") in (pytest.approx(r, rel=1e-12), pytest.approx(-r, rel=1e-12))
    assert table.value("mechanical_advantage") == pytest.approx(1 / r, rel=1e-12)
    assert table.value("peak_input_torque") == pytest.approx(0.5 * m * r**2 * w**2, rel=1e-10)
    assert table.value("rms_input_torque") == pytest.approx(0.5 * m * r**2 * w**2 / sqrt(2), rel=1e-10)
    assert table.value("peak_power") == pytest.approx(0.5 * m * r**2 * w**3, rel=1e-10)
    assert table.value("mean_power") == pytest.approx(0.0, abs=1e-9)
    assert table.value("peak_shaking_force") == pytest.approx(m * r * w**2, rel=1e-12)


def test_primary_and_secondary_forces_of_a_slider_crank() -> None:
    """Norton, Design of Machinery, ch. 13: m r ω² and m r ω² (λ + λ³/4 + 15 λ⁵/128 + 35 λ⁷/512 + …)."""
    forces = lw.solve_forces(lw.solve_motion(lw.loads(RECIPROCATING)))
    table = lw.metrics(forces, ["shaking_force_harmonic", "shaking_moment_harmonic"])
    once, ratio = 2.0 * 0.04 * 150.0**2, 0.04 / 0.16
    series = ratio + ratio**3 / 4 + 15 * ratio**5 / 128 + 35 * ratio**7 / 512
    assert table.value("shaking_force_harmonic", "1×") == pytest.approx(once, rel=1e-12)
    assert table.value("shaking_force_harmonic", "2×") == pytest.approx(once * series, rel=1e-6)
    assert table.value("shaking_moment_harmonic", "1×") == pytest.approx(0.0, abs=1e-9)


def test_shaking_of_each_order_is_that_of_fourier() -> None:
    """Offset, with masses beside the links' lines; for one machine and for many."""
    text = RECIPROCATING.replace("through: O", "through: P").replace(
        "rod: {points: [A, B], length: 160 mm}",
        "rod: {points: [A, B], length: 160 mm, mass: 0.7 kg, inertia: 0.002 kg·m², mass_centre: [60 mm, 9 mm]}",
    )
    machine, numbers = lw.loads(text), ["shaking_force_harmonic", "shaking_moment_harmonic"]
    forces = lw.solve_forces(lw.solve_motion(machine, steps=720))
    table = lw.metrics(forces, numbers)
    many = lw.study(machine, {"crank.length": [0.039, 0.04]}, metrics=[f"{n} {k}×" for n in numbers for k in (1, 2)])
    phase = np.linspace(0.0, 2.0 * pi, 20001)
    for order in (1, 2):
        x, y, moment = (
            np.mean(signal * np.exp(-1j * order * forces.motion.input))
            for signal in (*forces.shaking_force.T, forces.shaking_moment)
        )
        way = [2.0 * (each * np.exp(1j * phase)).real for each in (x, y)]
        want = {"shaking_force_harmonic": np.hypot(*way).max(), "shaking_moment_harmonic": 2.0 * abs(moment)}
        for name, value in want.items():
            assert table.value(name, f"{order}×") == pytest.approx(value, rel=1e-7)
            assert many[f"{name} {order}×"][1] == pytest.approx(table.value(name, f"{order}×"), rel=1e-12)


def test_ellipse_of_the_trammel() -> None:
    motion = lw.solve_motion(lw.load("gallery:elliptic_trammel"))
    a, b = 0.12, 0.08
    curve = coupler_curve(motion, "bar.P")
    assert abs(curve.area) == pytest.approx(pi * a * b, rel=1e-12)
    assert curve.length == pytest.approx(4 * a * ellipe(1 - (b / a) ** 2), rel=1e-12)
    assert not curve.double_points and not curve.cusps


@pytest.mark.parametrize(
    ("lengths", "kind"),
    [
        ((4, 1, 3.5, 2.5), "crank_rocker"),
        ((1, 3, 3.5, 4), "double_crank"),
        ((3, 3.5, 1, 4), "double_rocker"),
        ((3, 4, 3.5, 1.2), "crank_rocker"),
        ((4, 2.5, 3, 3), "triple_rocker"),
        ((2, 1, 2, 1), "change_point"),
    ],
)
def test_grashof_types(lengths: tuple[float, float, float, float], kind: str) -> None:
    """Norton, Design of Machinery, sec. 2.12: which link is shortest decides, wherever the machine stands."""
    frame, crank, coupler, rocker = lengths
    model = Model("four-bar")
    model.frame(O1=(0.7, -1.3), O2=(0.7 + frame, -1.3))
    model.link("crank", ["O1", "A"], length=crank)
    model.link("coupler", ["A", "B"], length=coupler)
    model.link("rocker", ["O2", "B"], length=rocker)
    model.drive("crank", about="O1", speed=1)
    (loop,) = four_bars(model.build())
    assert loop.type == kind
    assert list(loop.lengths.values()) == pytest.approx([frame, crank, coupler, rocker], rel=1e-14)


def crunodal(apex: tuple[float, float]) -> lw.Mechanism:
    model = Model("four-bar")
    model.frame(O1=(0, 0), O2=(2.0, 0))
    model.link("crank", ["O1", "A"], length=0.6)
    model.link("coupler", ["A", "B"], length=1.9, also={"P": apex})
    model.link("rocker", ["O2", "B"], length=1.3)
    model.drive("crank", about="O1", speed=3)
    model.assemble(B="left")
    return model.build()


@pytest.mark.parametrize("apex", [(1.4, -1.5), (2.0, -0.5), (2.0, 0.5), (2.5, 2.0)])
def test_double_points_lie_on_the_circle_of_singular_foci(apex: tuple[float, float]) -> None:
    """Roberts: O1, O2 and the third focus form a triangle similar to the coupler's; its circle holds all nodes."""
    curve = coupler_curve(lw.solve_motion(crunodal(apex), steps=180), "coupler.P")
    assert curve.double_points
    third = 2.0 * complex(*apex) / 1.9
    a, b, c = 0j, 2 + 0j, third
    w = (c - a) / (b - a)
    centre = (b - a) * (w - abs(w) ** 2) / (w - w.conjugate()) + a
    for (x, y), _ in curve.double_points:
        assert abs(complex(x, y) - centre) == pytest.approx(abs(centre), rel=1e-9)


def test_a_point_of_the_moving_centrode_draws_a_cusp() -> None:
    """P at the pole of the coupler for one crank angle stands still there; the pole by crossing crank and rocker."""
    angle = 1.1
    ax, ay = 0.6 * np.cos(angle), 0.6 * np.sin(angle)
    d = hypot(2.0 - ax, ay)
    along = (d**2 + 1.9**2 - 1.3**2) / (2 * d)
    ex, ey = (2.0 - ax) / d, -ay / d
    across = sqrt(1.9**2 - along**2)
    bx, by = ax + along * ex - across * ey, ay + along * ey + across * ex
    s = 2.0 * by / (by * np.cos(angle) - (bx - 2.0) * np.sin(angle))
    px, py = s * np.cos(angle) - ax, s * np.sin(angle) - ay
    ux, uy = (bx - ax) / 1.9, (by - ay) / 1.9
    apex = (float(px * ux + py * uy), float(ux * py - uy * px))
    curve = coupler_curve(lw.solve_motion(crunodal(apex)), "coupler.P")
    inputs = [at for _, at in curve.cusps]
    assert inputs == [pytest.approx(angle, abs=1e-5)]


def test_four_bars_of_larger_linkages() -> None:
    """The loops with the frame of Jansen's leg and of the six-bar crusher."""
    leg = {loop.name: loop for loop in four_bars(lw.load("gallery:theo_jansen_leg"))}
    assert set(leg) == {"crank–upper_rod–upper_plate", "crank–lower_rod–lower_rocker"}
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    first, second = four_bars(crusher)
    assert (first.name, second.name) == ("crank–pitman–rocker", "rocker–toggle–jaw")
    for loop in (first, second):
        for link in (loop.first, loop.coupler, loop.second):
            length = f"{link}.length"
            if link != "jaw":
                assert loop.lengths[link] == pytest.approx(crusher.dimension(length))
        at = {joint: np.array(crusher.frame.points[joint]) for joint in ("O1", "O3", "O5")}
        ends = ("O1", "O3") if loop is first else ("O3", "O5")
        assert loop.lengths["frame"] == pytest.approx(np.hypot(*(at[ends[0]] - at[ends[1]])))
        s, p, q, longest = sorted(loop.lengths.values())
        assert loop.margin == pytest.approx(p + q - s - longest)
    assert (first.type, second.type) == ("crank_rocker", "triple_rocker")
    assert (first.shortest, second.shortest) == ("crank", "rocker")


@pytest.mark.parametrize("start", ["0 deg", "30 deg", "180 deg"])
def test_the_range_of_a_crank_that_does_not_turn_through(start: str) -> None:
    """The crank reaches as far as coupler and rocker are stretched (law of cosines), wherever the cycle begins."""
    fourbar = lw.loads(f"""
format: 1
frame: {{points: {{O: [0 mm, 0 mm], Q: [100 mm, 0 mm]}}}}
links:
  crank: {{points: [O, A], length: 70 mm}}
  coupler: {{points: [A, B], length: 50 mm}}
  rocker: {{points: [Q, B], length: 40 mm}}
assembly: {{B: left}}
driver: {{turn: crank, about: O, speed: 1 rad/s, start: {start}}}
""")
    (found,) = metrics(lw.solve_motion(fourbar, steps=72, failures="mark"))["range_of_motion"]
    half = acos((70**2 + 100**2 - 90**2) / (2 * 70 * 100))
    assert (found.subject, found.value) == ("driver", pytest.approx(2 * half, rel=1e-9))


def test_velocity_ratio_and_mechanical_advantage_say_what_they_are() -> None:
    table = metrics(lw.solve_motion(lw.load("gallery:slider_crank_inline")))
    (ratio,), (advantage,) = table["velocity_ratio"], table["mechanical_advantage"]
    assert (ratio.dimension, advantage.dimension) == ("length_per_angle", "angle_per_length")
    assert ratio.value * advantage.value == pytest.approx(1.0, rel=1e-12)
