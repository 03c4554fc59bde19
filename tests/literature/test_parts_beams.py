"""Beams against closed forms of textbooks, and a link's bending against beams under its line load of inertia."""

import math
from typing import Any

import numpy as np
import pytest
from tests.contract.calculations import solved as solved_of

import linkwright as lw
from linkwright import parts

E, J, L = 200e9, 3e-6, 3.0
STEEL, PLAIN = parts.Material(E), parts.Section(J)


def solved(supports: dict, length: float = L, **given: object) -> Any:
    held = {name: parts.BeamSupport(*each) for name, each in supports.items()}
    loads = {f"P{i}": parts.BeamLoad(**each) for i, each in enumerate(given.pop("loads", ()))}  # type: ignore[arg-type]
    return parts.Beam(length, STEEL, PLAIN, held, loads, **given).solve()  # type: ignore[arg-type]


def rectangle(width: float, height: float) -> parts.Section:
    """I = b h³/12, W = b h²/6."""
    return parts.Section(width * height**3 / 12, width * height, width * height**2 / 6)


def circle(diameter: float) -> parts.Section:
    """I = π d⁴/64, W = π d³/32."""
    return parts.Section(math.pi * diameter**4 / 64, math.pi * diameter**2 / 4, math.pi * diameter**3 / 32)


def close(found: object, expected: object) -> None:
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-15)


def test_cantilever_of_the_lecture() -> None:
    """Deflection −P x²(3a − x)/(6EI) up to the load, −P a²(3x − a)/(6EI) beyond."""
    line = solved_of("cantilever")
    p, a, rigidity = 2000.0, 1.5, 200e9 * 2e-5
    x = np.linspace(0, 2, 41)
    before, beyond = -p * x**2 * (3 * a - x) / (6 * rigidity), -p * a**2 * (3 * x - a) / (6 * rigidity)
    close(line.deflection(x), np.where(x < a, before, beyond))
    close(line.slope(x), np.where(x < a, -p * x * (2 * a - x) / (2 * rigidity), -p * a * a / (2 * rigidity)))
    close(line.moment(x), np.where(x < a, -p * (a - x), 0.0))
    close(line.reactions["A"], (2000.0, 3000.0))


def test_simple_beam_of_the_lecture() -> None:
    """Uniform load on the left half and a clockwise couple at three quarters: the slides' reactions, moments and
    deflection, and the moment integrated by hand."""
    line = solved_of("simple_beam")
    rigidity, x = 200e9 * 2e-6, np.linspace(0, 2, 81)
    past = lambda a, n: np.where(x > a, (x - a) ** n, 0.0)  # noqa: E731
    moment = 300 * x - 500 * x**2 + 500 * past(1, 2) + 900 * (x >= 1.5)
    bent = 50 * x**3 - 500 / 12 * x**4 + 500 / 12 * past(1, 4) + 450 * past(1.5, 2)
    assert line.moment(x)[1:-1] == pytest.approx(moment[1:-1], rel=1e-9, abs=1e-9)
    close(line.deflection(x), (bent - bent[-1] * x / 2) / rigidity)
    assert line.reactions["A"][0] == pytest.approx(300) and line.reactions["B"][0] == pytest.approx(700)
    assert [value for _, value in line.extremes("moment")] == pytest.approx([-550, 350])
    assert line.extremes("deflection")[1][1] == pytest.approx(0.1697e-3, abs=0.5e-7)


def test_propped_cantilever() -> None:
    q = 1500.0
    line = solved({"A": ("fixed", 0.0), "B": ("roller", L)}, loads=[{"line": (-q, -q)}])
    close(line.reactions["B"][0], 3 * q * L / 8)
    close(line.reactions["A"], (5 * q * L / 8, q * L**2 / 8))
    (x, moment), (y, deflection) = line.extremes("moment")[1], line.extremes("deflection")[0]
    close((x, moment), (5 * L / 8, 9 * q * L**2 / 128))
    close(y, L * (15 - math.sqrt(33)) / 16 if y < L / 2 else L - L * (1 + math.sqrt(33)) / 16)
    u = (1 + math.sqrt(33)) / 16
    close(deflection, -q * L**4 * (u - 3 * u**3 + 2 * u**4) / (48 * E * J))


def test_built_in_at_both_ends() -> None:
    q, p = 1000.0, 700.0
    line = solved({"A": ("fixed", 0.0), "B": ("fixed", L)}, loads=[{"line": (-q, -q)}, {"force": -p, "at": L / 2}])
    close(line.moment(0.0)[0], -q * L**2 / 12 - p * L / 8)
    close(line.deflection(L / 2)[0], -(q * L**4 / 384 + p * L**3 / 192) / (E * J))


def test_two_spans() -> None:
    q = 800.0
    line = solved({"A": ("pinned", 0.0), "B": ("roller", L / 2), "C": ("roller", L)}, loads=[{"line": (-q, -q)}])
    close(line.reactions["B"][0], 1.25 * q * L / 2)
    close(line.moment(L / 2)[0], -q * (L / 2) ** 2 / 8)


def test_load_rising_from_zero() -> None:
    q = 900.0
    line = solved({"A": ("pinned", 0.0), "B": ("roller", L)}, loads=[{"line": (0.0, -q)}])
    x, moment = line.extremes("moment")[1]
    close((x, moment), (L / math.sqrt(3), q * L**2 / (9 * math.sqrt(3))))


def test_settlement_and_springs() -> None:
    line = solved({"A": ("fixed", 0.0), "B": ("roller", L, -0.01)})
    close(line.reactions["B"][0], -3 * E * J * 0.01 / L**3)
    k, p = 4e4, 500.0
    line = solved({"A": ("fixed", 0.0), "B": ("spring", L, 0.0, k)}, loads=[{"force": -p, "at": L}])
    close(line.deflection(L)[0], -p / (k + 3 * E * J / L**3))
    close(line.reactions["B"][0], k * p / (k + 3 * E * J / L**3))


def test_hinged_beam() -> None:
    """A cantilever carries half of the beam that hangs on its end by a hinge."""
    p, a = 1200.0, 1.2
    line = solved({"A": ("fixed", 0.0), "B": ("roller", L)}, hinges=(a,), loads=[{"force": -p, "at": (a + L) / 2}])
    close(line.reactions["B"][0], p / 2)
    close(line.reactions["A"], (p / 2, p * a / 2))
    assert abs(line.moment(a)[0]) < 1e-9
    close(line.deflection(a)[0], -p / 2 * a**3 / (3 * E * J))


def test_own_weight_stress_and_needed_modulus() -> None:
    line = solved_of("propped_cantilever")
    q = 3000 + 9.80665 * 7850 * 1321e-6
    close(line.stress[1], q * 16 / 8 / 53.0e-6)
    close(line.needed_modulus, 1.5 * q * 16 / 8 / 235e6)
    close(line.safety, 235e6 / line.stress[1])


def test_the_whole_is_in_balance() -> None:
    """A beam of everything: its slope turns by ∫M/EI, and its free end carries nothing."""
    loads = [
        {"force": -900.0, "at": 0.7},
        {"couple": 250.0, "at": 1.9},
        {"line": (-300.0, -1400.0), "start": 0.4, "end": 2.6},
    ]
    line = solved({"A": ("fixed", 0.0), "B": ("roller", 1.3), "C": ("spring", 2.8, 0.0, 8e4, 2e3)}, loads=loads)
    middle = (np.arange(6000) + 0.5) * L / 6000
    bent = float(line.moment(middle).sum()) * L / 6000 / (E * J)
    assert bent == pytest.approx(line.slope(L)[0] - line.slope(0.0)[0], rel=1e-6)
    assert line.deflection([0.0, 1.3]) == pytest.approx([0, 0], abs=1e-15)
    assert line.moment(L, "left")[0] == pytest.approx(0, abs=1e-9) and line.shear(L, "left")[0] == pytest.approx(
        0, abs=1e-9
    )


FOURBAR = """
format: 1
frame: {points: {A: [0 m, 0 m], D: [0.5 m, 0 m]}}
links:
  crank: {points: [A, B], length: 0.15 m}
  coupler: {points: [B, C], length: 0.5 m, mass: 6 kg, inertia: 0.125 kg·m²}
  rocker: {points: [D, C], length: 0.35 m, mass: 3 kg, inertia: 0.030625 kg·m²}
assembly: {C: left}
driver: {turn: crank, about: A, speed: 300 rpm}
gravity: [0, -9.81 m/s²]
"""


def test_coupler_bends_as_a_simple_beam_under_its_inertia() -> None:
    """A uniform bar between pins: line load −ρ(a − g) across, linear between the ends; M = q0 s(L − s)/2 + …"""
    mechanism = lw.loads(FOURBAR)
    found = parts.LinkBending(mechanism, "coupler", STEEL, rectangle(0.02, 0.04), steps=24).solve()
    motion = found.forces.motion
    e = motion.link("coupler").direction
    normal = np.stack([-e[:, 1], e[:, 0]], axis=1)
    length, rho, s = 0.5, 12.0, found.stations
    first, last = (
        -rho * ((motion.point(p).acceleration - [0, -9.81]) * normal).sum(axis=1) for p in ("coupler.B", "coupler.C")
    )
    rate = (last - first)[:, None] / length
    expected = -(first[:, None] * s * (length - s) / 2 + rate * s * (length**2 - s**2) / 6)
    assert np.abs(found.moment - expected).max() < 1e-9 * np.abs(expected).max()
    assert found.closure < 1e-9 * np.abs(found.normal).max()
    stress = np.abs(found.normal) / 8e-4 + np.abs(found.moment) / (0.02 * 0.04**2 / 6)
    assert found.stress == pytest.approx(stress, rel=1e-12)


def test_driven_crank_is_clamped_by_its_torque() -> None:
    """The moment at the shaft is the input torque, and vanishes at the pin of the coupler."""
    found = parts.LinkBending(lw.loads(FOURBAR), "crank", STEEL, circle(0.03), steps=24).solve()
    assert found.moment[:, 1] == pytest.approx(-found.forces.input_torque, rel=1e-9)
    assert np.abs(found.moment[:, -1]).max() < 1e-9


def test_largest_values_are_those_between_the_positions() -> None:
    """The crank's moment is largest at the shaft, the peak of the input torque."""
    found = parts.LinkBending(lw.loads(FOURBAR), "crank", STEEL, circle(0.03), steps=24).solve()
    torque = lw.metrics(lw.solve_forces(lw.loads(FOURBAR), steps=3600)).value("peak_input_torque")
    assert abs(found.largest("largest_moment")) == pytest.approx(abs(torque), rel=1e-8)
    assert np.abs(found.moment).max() < 0.9999 * abs(torque)


def test_a_load_on_a_link_is_a_force_at_its_place() -> None:
    """A massless bar between pins with a force across at a third: M = P a b/L there."""
    text = FOURBAR.replace("mass: 6 kg, inertia: 0.125 kg·m²", "also: {Q: [0.2 m, 0 m]}")
    text += "loads:\n  P: {kind: force, on: coupler, at: Q, normal_to: [B, C], magnitude: 100 N}\n"
    found = parts.LinkBending(lw.loads(text), "coupler", STEEL, circle(0.03), steps=12).solve()
    assert np.abs(found.moment).max(axis=1) == pytest.approx(np.full(12, 100 * 0.2 * 0.3 / 0.5), rel=1e-9)
    assert found.stations[found.worst(found.moment)[1]] == pytest.approx(0.2)


def test_a_bar_between_pins_sags_as_a_simple_beam() -> None:
    """w = P a² b²/(3 E I L) under the force, away from it as in every textbook; the ends stay on their line."""
    text = FOURBAR.replace("mass: 6 kg, inertia: 0.125 kg·m²", "also: {Q: [0.2 m, 0 m]}")
    text += "loads:\n  P: {kind: force, on: coupler, at: Q, normal_to: [B, C], magnitude: 100 N}\n"
    section = circle(0.03)
    found = parts.LinkBending(lw.loads(text), "coupler", STEEL, section, steps=12).solve()
    a, b, length, rigidity = 0.2, 0.3, 0.5, STEEL.modulus * section.second_moment
    s = found.stations
    left = 100 * b * s * (length**2 - b**2 - s**2) / (6 * length * rigidity)
    right = 100 * a * (length - s) * (length**2 - a**2 - (length - s) ** 2) / (6 * length * rigidity)
    expected = np.where(s <= a, left, right)
    assert np.abs(np.abs(found.deflection[:, :, 1]) - expected).max() < 1e-9 * expected.max()


BELL_CRANK = """
format: 1
frame: {points: {O: [0 m, 0 m], P: [0.5 m, 0.1 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.45 m}
  bell: {points: {P: [0 m, 0 m], B: [0.4 m, 0 m], C: [0 m, 0.3 m]}, mass: 7 kg, inertia: INERTIA,
         mass_centre: [CENTRE]}
assembly: {B: left}
drawing: {A: [0.1 m, 0 m]}
driver: {turn: crank, about: O, speed: 120 rpm}
gravity: [0, -9.81 m/s²]
loads: {F: {kind: force, on: bell, at: C, direction: 20 deg, magnitude: 300 N}}
"""


def test_a_bell_crank_of_two_even_bars_is_cut_as_the_statics_of_its_arms_demand() -> None:
    """Arms of 0.4 m and 0.3 m with 10 kg/m: what acts on the arm beyond a cut, summed by itself."""
    centre = np.array([4 * 0.2, 3 * 0.15]) / 7
    bars = 4 * 0.4**2 / 12 + 4 * ((0.2 - centre[0]) ** 2 + centre[1] ** 2)
    bars += 3 * 0.3**2 / 12 + 3 * (centre[0] ** 2 + (0.15 - centre[1]) ** 2)
    text = BELL_CRANK.replace("INERTIA", f"{float(bars)!r} kg*m^2").replace(
        "CENTRE", f"{float(centre[0])!r} m, {float(centre[1])!r} m"
    )
    text = text.replace("drawing: {A: [0.1 m, 0 m]}\n", "")
    mechanism = lw.loads(text)
    problem = parts.LinkBending(mechanism, "bell", STEEL, rectangle(0.03, 0.05), steps=24, axis=("B", "P", "C"))
    found = problem.solve()
    density = found.mass.density
    assert density(np.linspace(0, 0.7, 9)) == pytest.approx(np.full(9, 10.0), rel=1e-9)
    assert found.closure < 1e-9 * np.abs(found.normal).max()
    link, e = found.forces.motion.link("bell"), found.forces.motion.link("bell").direction
    ends = {"B": (0.4, e), "C": (0.3, np.stack([-e[:, 1], e[:, 0]], axis=1))}
    force = {"B": found.forces.reaction("B", on="bell"), "C": 300 * np.array([np.cos(np.pi / 9), np.sin(np.pi / 9)])}
    for name, (arm, way) in ends.items():
        beside = np.stack([-way[:, 1], way[:, 0]], axis=1)
        tip = (np.broadcast_to(force[name], beside.shape) * beside).sum(axis=1) * arm
        weight = -9.81 * beside[:, 1] * 10 * arm**2 / 2
        inertia = -10 * arm**3 / 3 * link.angular_acceleration
        expected = np.abs(tip + weight + inertia)
        at = np.flatnonzero(np.isclose(found.stations, 0.4))
        beyond = at[0] if name == "B" else at[-1]
        assert np.abs(found.moment[:, beyond]) == pytest.approx(expected, rel=1e-8, abs=1e-8)


def test_the_ends_of_a_bent_link_move_as_those_of_two_cantilevers() -> None:
    """Both arms of a massless bell crank clamped at the corner: the ends move by F l³/(3 E I) and F l/(E A) each."""
    text = BELL_CRANK.replace("mass: 7 kg, inertia: INERTIA,\n         mass_centre: [CENTRE]", "mass: 0 kg")
    text = text.replace("drawing: {A: [0.1 m, 0 m]}\n", "").replace("gravity: [0, -9.81 m/s²]\n", "")
    section = rectangle(0.03, 0.05)
    found = parts.LinkBending(lw.loads(text), "bell", STEEL, section, steps=8, axis=("B", "P", "C")).solve()
    rigidity, stretch = STEEL.modulus * section.second_moment, STEEL.modulus * section.area
    u = found.deflection
    e = found.forces.motion.link("bell").direction
    force = found.forces.reaction("B", on="bell")
    across = (force * np.stack([-e[:, 1], e[:, 0]], axis=1)).sum(axis=1)
    along = (force * e).sum(axis=1)
    load = 300 * np.array([np.cos(np.pi / 9), np.sin(np.pi / 9)])
    up = load @ np.stack([-e[:, 1], e[:, 0]], axis=0)
    sagged = across * 0.4**3 / (3 * rigidity)
    leaned = -(load @ e.T) * 0.3**3 / (3 * rigidity)
    distance = np.array([0.4, -0.3])
    tips = {"B": (along * 0.4 / stretch, sagged), "C": (-leaned, up * 0.3 / stretch)}
    change = np.array([tips["B"][0] - tips["C"][0], tips["B"][1] - tips["C"][1]])
    shorter = distance @ change / np.hypot(*distance)
    first = -u[:, 0, 0, None] * [1.0, 0.0] - u[:, 0, 1, None] * [0.0, 1.0]
    last = u[:, -1, 0, None] * [0.0, 1.0] - u[:, -1, 1, None] * [1.0, 0.0]
    gained = (first - last) @ distance / np.hypot(*distance)
    assert gained == pytest.approx(shorter, rel=1e-8, abs=1e-12)
    assert np.abs((first - last) @ np.array([0.3, 0.4])).max() < 1e-12
