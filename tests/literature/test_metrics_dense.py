"""Metrics against thousands of positions: values and places, of cranks turned either way, to and fro, through
part of a turn, and up to dead points.

What a number means is written here once more, from positions, rates and forces alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest

import linkwright as lw
from linkwright.analysis import MetricsTable, metrics

DENSE = 7200
FOURBAR = """
format: 1
frame: {points: {O: [0 m, 0 m], Q: [4 m, 0.5 m]}}
links:
  crank: {points: [O, A], length: CRANK, mass: 2 kg, inertia: 0.3 kg·m²}
  coupler: {points: [A, B], length: 3.5 m, also: {P: [1.5 m, 1 m]}, mass: 3 kg, inertia: 0.2 kg·m²}
  rocker: {points: [Q, B], length: 2.5 m, mass: 2 kg, inertia: 0.4 kg·m²}
assembly: {B: left}
driver: {turn: crank, about: O, LAW}
gravity: [0, -9.81 m/s²]
loads:
  work: {kind: torque, on: rocker, magnitude: 90 N·m, phase: {moving: rocker, direction: decreasing}}
"""
SLIDER = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.7 m, also: {S: [0.3 m, 0.1 m]}, mass: 2 kg, inertia: 0.05 kg·m²}
  piston: {points: [B], mass: 3 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B, offset: 0.05 m}}
driver: {turn: crank, about: O, LAW}
loads: {push: {kind: force, on: piston, at: B, direction: 180 deg, magnitude: 800 N}}
"""
MACHINES: Mapping[str, str] = {
    "crank-rocker": FOURBAR.replace("CRANK", "1 m").replace("LAW", "speed: 12 rad/s"),
    "clockwise": FOURBAR.replace("CRANK", "1 m").replace("LAW", "speed: -12 rad/s, start: 50 deg"),
    "slider": SLIDER.replace("LAW", "speed: 120 rpm, start: 20 deg"),
    "to and fro": SLIDER.replace("LAW", 'position: "70 deg*sin(2*pi*t/(2 s)) + 100 deg"')
    + "cycle: {duration: 2 s}\n",
    "part of a turn": SLIDER.replace("LAW", "speed: -120 rpm") + "cycle: {from: 30 deg, to: -200 deg}\n",
}
OUT_OF_REACH = FOURBAR.replace("CRANK", "2.2 m").replace("LAW", "speed: SPEED, start: 50 deg")
Signal = Callable[[lw.Forces], np.ndarray]


def size(vectors: np.ndarray) -> np.ndarray:
    return np.hypot(*vectors.T)


def signals(mechanism: lw.Mechanism) -> dict[tuple[str, str], tuple[str, Signal]]:
    """By number and subject: kind of summary, and what is summarised."""
    found: dict[tuple[str, str], tuple[str, Signal]] = {
        ("peak_power", mechanism.name): ("max", lambda f: f.input_torque * rate(f)),
        ("mean_power", mechanism.name): ("mean", lambda f: f.input_torque * rate(f)),
        ("peak_input_torque", "driver"): ("peak", lambda f: f.input_torque),
        ("rms_input_torque", "driver"): ("rms", lambda f: f.input_torque),
        ("peak_shaking_force", "frame"): ("max", lambda f: size(f.shaking_force)),
        ("peak_shaking_moment", "frame"): ("peak", lambda f: f.shaking_moment),
    }
    for name, joint in mechanism.joints.items():
        link = joint.joined[1]
        found["peak_reaction", name] = "max", lambda f, n=name, k=link: size(f.reaction(n, on=k))
        found["rms_reaction", name] = "rms", lambda f, n=name, k=link: size(f.reaction(n, on=k))
    if "rocker" in mechanism.links:
        found["peak_acceleration", "rocker"] = "peak", lambda f: f.motion.link("rocker").angular_acceleration
        found["swing_angle", "rocker"] = "range", lambda f: f.motion.link("rocker").angle
        found["velocity_ratio", "rocker"] = ("largest", lambda f: f.motion.link("rocker").angular_velocity / rate(f))
        point, group, guided = "coupler.P", "coupler+rocker", None
    else:
        found["peak_acceleration", "guide"] = "peak", lambda f: f.motion.joint("guide").acceleration
        found["stroke", "guide"] = "range", lambda f: f.motion.joint("guide").displacement
        found["velocity_ratio", "guide"] = "largest", lambda f: f.motion.joint("guide").velocity / rate(f)
        point, group, guided = "rod.S", "rod+piston", "rod"
    found["peak_acceleration", point] = "max", lambda f: size(f.motion.point(point).acceleration)
    found["transmission_angle", group] = "min", lambda f: transmission(f.motion, guided)
    found["pressure_angle", group] = "max", lambda f: 0.5 * np.pi - transmission(f.motion, guided)
    found["singularity", group] = "min", lambda f: np.sin(transmission(f.motion, guided))
    return found


def rate(forces: lw.Forces) -> np.ndarray:
    return forces.motion.link("crank").angular_velocity


def transmission(motion: lw.Motion, guided: str | None) -> np.ndarray:
    """Between coupler and rocker; of a slider between the rod and the normal of its way."""
    if guided is not None:
        return np.abs(0.5 * np.pi - np.abs(np.arcsin(motion.link(guided).direction[:, 1])))
    a, b = (motion.point(p).position - motion.point("B").position for p in ("A", "Q"))
    between = np.arccos((a * b).sum(axis=1) / (size(a) * size(b)))
    return np.minimum(between, np.pi - between)


def summary(kind: str, values: np.ndarray, weights: np.ndarray) -> tuple[float, int | None]:
    good = np.isfinite(values)
    if kind in ("mean", "rms"):
        mean = float(((values**2 if kind == "rms" else values) * weights)[good].sum() / weights[good].sum())
        return (mean**0.5 if kind == "rms" else mean), None
    if kind == "range":
        return float(np.ptp(values[good])), None
    if kind in ("peak", "largest"):
        place = int(np.nanargmax(np.abs(values)))
        return float(abs(values[place]) if kind == "peak" else values[place]), place
    place = int(np.nanargmax(values) if kind == "max" else np.nanargmin(values))
    return float(values[place]), place


@pytest.fixture(scope="module", params=MACHINES)
def solved(request: pytest.FixtureRequest) -> tuple[MetricsTable, lw.Forces]:
    mechanism = lw.loads(MACHINES[request.param])
    table, dense = (lw.solve_forces(lw.solve_motion(mechanism, steps=steps)) for steps in (96, DENSE))
    return metrics(table), dense


def test_values_and_places_are_those_of_thousands_of_positions(solved: tuple[MetricsTable, lw.Forces]) -> None:
    table, dense = solved
    weights = np.ones(dense.motion.steps)
    if not dense.motion.positions.closed:
        weights[[0, -1]] = 0.5
    checked = 0
    for (name, subject), (kind, signal) in signals(dense.mechanism).items():
        if name not in table.names or subject not in [row.subject for row in table[name]]:
            continue
        values = signal(dense)
        expected, place = summary(kind, values, weights)
        found = table[name, subject]
        scale = float(np.nanmax(np.abs(values)))
        assert found.value == pytest.approx(expected, rel=2e-3, abs=3e-4 * scale), (name, subject)
        checked += 1
        if place is None or found.at is None:
            continue
        row = lw.solve_forces(lw.solve_motion(dense.mechanism, at=[found.at])) if one_turn(dense) else None
        if row is not None:
            there = float(signal(row)[0])
            assert (abs(there) if kind == "peak" else there) == pytest.approx(found.value, rel=1e-6, abs=1e-6 * scale)
    assert checked == len(signals(dense.mechanism)) - lacking(table)


def lacking(table: MetricsTable) -> int:
    """Ratios to the input's rate are asked only where that never stops."""
    return int("velocity_ratio" in table.skipped)


def test_energy_that_a_flywheel_takes_up(solved: tuple[MetricsTable, lw.Forces]) -> None:
    """ΔE: the range of ∫ (mean - T) dφ; δ = 0.02 asks for ΔE/(δ ω²) less what turns with the crank already."""
    table, dense = solved
    whole = dense.motion.positions.closed and one_turn(dense)
    does_work = "energy_fluctuation" in table.names
    assert does_work == (whole and "rocker" in dense.mechanism.links)
    if does_work:
        torque, step = dense.input_torque * np.sign(rate(dense)), 2 * np.pi / DENSE
        work = np.cumsum(torque.mean() - torque) * step
        assert table.value("energy_fluctuation") == pytest.approx(np.ptp(work), rel=2e-3)
        own = np.mean([inertia(dense.motion, k) for k in range(0, DENSE, 40)])
        needed = max(np.ptp(work) / (0.02 * 12**2) - own, 0.0)
        assert needed > 0 and table.value("flywheel") == pytest.approx(needed, rel=3e-3)


def inertia(motion: lw.Motion, k: int) -> float:
    """Twice the kinetic energy over the square of the crank's rate; links have their mass centres in their middle."""
    ends = {"crank": ("O", "A"), "coupler": ("A", "B"), "rocker": ("Q", "B")}
    twice = 0.0
    for name, link in motion.mechanism.links.items():
        velocity = sum(motion.point(f"{name}.{each}").velocity[k] for each in ends[name]) / 2
        w = motion.link(name).angular_velocity[k]
        twice += link.mass * float(velocity @ velocity) + link.inertia * w**2
    return twice / motion.link("crank").angular_velocity[k] ** 2


def one_turn(forces: lw.Forces) -> bool:
    return bool(np.ptp(rate(forces)[np.isfinite(rate(forces))]) < 1e-9)


@pytest.mark.parametrize("speed", [12.0, -12.0])
@pytest.mark.parametrize("steps", [96, 961])
def test_a_crank_whose_way_ends_where_coupler_and_rocker_are_stretched(speed: float, steps: int) -> None:
    """At |AQ| = 3.5 m + 2.5 m both ways from the frame's direction; its ends are found between positions."""
    frame, towards = np.hypot(4.0, 0.5), np.arctan2(0.5, 4.0)
    end = float(np.arccos((frame**2 + 2.2**2 - 6.0**2) / (2 * frame * 2.2)))
    mechanism = lw.loads(OUT_OF_REACH.replace("SPEED", f"{speed} rad/s"))
    table = metrics(lw.solve_motion(mechanism, steps=steps, failures="mark"))
    (way,) = table["range_of_motion"]
    assert way.value == pytest.approx(2 * end, rel=1e-8)
    first = towards - end if speed > 0 else towards + end
    assert np.exp(1j * way.at) == pytest.approx(np.exp(1j * first), abs=1e-7)
    stops = [row.value for row in table["dead_point"] if row.warnings]
    expected = sorted(np.exp(1j * (towards + sign * end)).imag for sign in (1, -1))
    assert sorted(np.exp(1j * np.array(stops)).imag) == pytest.approx(expected, abs=1e-7)
    for name, limit in (("transmission_angle", 0.0), ("pressure_angle", 0.5 * np.pi), ("singularity", 0.0)):
        (row,) = table[name]
        assert row.value == pytest.approx(limit, abs=1e-7) and row.warnings
    for name in ("peak_acceleration", "velocity_ratio", "peak_jerk"):
        assert all(np.isinf(row.value) and row.warnings for row in table[name])
    stretched = np.arccos(
        (frame**2 + 6.0**2 - 2.2**2) / (2 * frame * 6.0)
    )  # of the rocker from the frame's direction
    turned_back = np.arccos((frame**2 + 2.5**2 - 5.7**2) / (2 * frame * 2.5))  # crank and coupler in one line
    assert table.value("swing_angle") == pytest.approx(stretched + turned_back, rel=1e-7)


@pytest.mark.parametrize("steps", [2, 3, 24])
def test_the_swing_of_a_way_of_which_one_position_is_solved(steps: int) -> None:
    """The rocker turns back, then stretches with the coupler, between the first position and the second."""
    frame, towards = complex(4.0, 0.5), np.arctan2(0.5, 4.0)
    end = np.arccos((abs(frame) ** 2 + 2.2**2 - 6.0**2) / (2 * abs(frame) * 2.2))
    crank = np.linspace(towards - np.radians(10.0), towards + end, 200001)
    gap = 2.2 * np.exp(1j * crank) - frame  # from the rocker's pivot to the crank's pin
    share = np.clip((abs(gap) ** 2 + 2.5**2 - 3.5**2) / (2 * abs(gap) * 2.5), -1.0, 1.0)
    rocker = np.unwrap(np.angle(gap) - np.arccos(share))
    text = OUT_OF_REACH.replace("SPEED, start: 50 deg", "1 rad/s")
    text += f"cycle: {{from: {crank[0]:.17g} rad, to: {crank[0] + np.radians(320.0):.17g} rad}}\n"
    motion = lw.solve_motion(lw.loads(text), steps=steps, failures="mark")
    (swing,) = metrics(motion)["swing_angle"]
    assert swing.exact and swing.value == pytest.approx(np.ptp(rocker), rel=1e-6)


@pytest.mark.parametrize("steps", [24, 96, 961])
def test_a_wheel_swings_as_far_as_the_crank_that_is_reached_through_the_end_of_the_cycle(steps: int) -> None:
    """The crank's way contains the position in which the cycle begins; a wheel at 3:2 goes on beyond it."""
    text = (
        OUT_OF_REACH.replace("SPEED", "12 rad/s")
        .replace(
            "assembly:",
            "  wheel: {points: {W: [0 m, 0 m], T: [1 m, 0 m]}, mass_centre: [0 m, 0 m]}\n"
            "joints: {mesh: {kind: gear, links: [crank, wheel], teeth: [30, 20], module: 0.1 m}}\nassembly:",
        )
        .replace("Q: [4 m, 0.5 m]}", "Q: [4 m, 0.5 m], W: [0 m, 2.5 m]}")
    )
    table = metrics(lw.solve_motion(lw.loads(text), steps=steps, failures="mark"))
    assert table.value("swing_angle", "wheel") == pytest.approx(1.5 * table.value("range_of_motion"), rel=1e-7)


def test_loads_of_a_way_that_is_left_have_no_end_and_no_mean() -> None:
    """Forces of masses grow as the accelerations, without bound; means would depend on the positions alone."""
    mechanism = lw.loads(OUT_OF_REACH.replace("SPEED", "12 rad/s"))
    table = metrics(lw.solve_forces(lw.solve_motion(mechanism, steps=96, failures="mark")))
    for name in ("peak_input_torque", "peak_power", "peak_shaking_force"):
        assert np.isinf(table.value(name))
    assert all(np.isinf(row.value) for row in table["peak_reaction"])
    assert table["mechanical_advantage"][0].value == 0.0
    assert not {"mean_power", "rms_input_torque", "rms_reaction"} & set(table.names)
    assert [note.code for note in table.notes] == ["metrics.part_reached"]


def test_of_inputs_on_both_sides_of_a_gap_each_stretch_has_its_swing() -> None:
    """A crank of 3 m, a coupler of 1 m and a frame of 3.2 m: a stretch on each side of the frame line, of which the
    second one ends at the last input, 320°; ways of the rocker by the intersection of two circles."""
    text = OUT_OF_REACH.replace("SPEED", "1 rad/s").replace("[4 m, 0.5 m]", "[3.2 m, 0 m]")
    text = text.replace("length: 2.2 m", "length: 3 m").replace("length: 3.5 m", "length: 1 m")
    machine = lw.loads(text.replace("length: 2.5 m", "length: 2.8 m"))
    motion = lw.solve_motion(machine, at=np.radians(np.arange(0.0, 360.0, 40.0)), failures="mark")
    swings, expected = metrics(motion)["swing_angle"], []
    near, far = (np.arccos((3.0**2 + 3.2**2 - gap**2) / (2.0 * 3.0 * 3.2)) for gap in (1.8, 3.8))
    for crank in (np.linspace(near, far, 200_001), np.linspace(-far, -np.radians(40.0), 200_001)):
        gap = 3.0 * np.exp(1j * crank) - 3.2
        corner = np.arccos(np.clip((abs(gap) ** 2 + 2.8**2 - 1.0) / (2.0 * abs(gap) * 2.8), -1.0, 1.0))
        expected.append(np.ptp(np.unwrap(np.angle(gap)) - corner))
    assert [each.value for each in swings] == pytest.approx(expected, rel=1e-6)
    assert all(each.exact for each in swings) and "from 33.5573° to 75.5225°" in swings[0].sentence
    assert metrics(motion).value("swing_angle") == swings[0].value
