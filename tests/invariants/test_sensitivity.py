"""Exact derivatives: against differences of independent solutions, and against laws that derivatives obey."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.refusals import refused
from tests.store import machine as stored

import linkwright as lw
from linkwright import sensitivity

KINDS: dict[str, Callable[[np.ndarray], float]] = {
    "rms": lambda y: np.sqrt((y * y).mean()),
    "mean": np.mean,
    "max": np.max,
    "min": np.min,
    "peak": lambda y: np.abs(y).max(),
    "range": np.ptp,
}


def curve(mechanism: lw.Mechanism, output: str, steps: int) -> Any:
    """An output by the public results."""
    motion = lw.solve_motion(mechanism, steps=steps)
    if output.endswith(".angle"):
        return motion.link(output.removesuffix(".angle")).angle
    if output.endswith(".acceleration"):
        return np.hypot(*motion.point(output.removesuffix(".acceleration")).acceleration.T)
    forces = lw.solve_forces(motion)
    if output.startswith("reaction"):
        _, joint, _, link = output.split()
        return np.hypot(*forces.reaction(joint, on=link).T)
    return forces.input_torque


def differences(mechanism: lw.Mechanism, output: str, by: str, steps: int, part: float) -> tuple[Any, dict[str, Any]]:
    """Central differences of the fourth order: of the curve, and of its summaries."""
    value = mechanism.dimension(by)
    step = part * max(abs(value), 0.1)
    ends = [curve(mechanism.with_dimensions({by: value + k * step}), output, steps) for k in (-2, -1, 1, 2)]

    def slope(a: Any, b: Any, c: Any, d: Any) -> Any:
        return (8 * (c - b) - (d - a)) / (12 * step)

    return slope(*ends), {kind: slope(*map(reduce, ends)) for kind, reduce in KINDS.items()}


CASES = [
    ("press_double_crank", ["cylinder_crank.angle", "coupler.angle"], ["coupler.length", "frame.O2.x"], 1e-4),
    ("crank_rocker", ["coupler.angle", "coupler.P.acceleration"], ["coupler.length", "frame.O2.x"], 1e-4),
    (
        "jaw_crusher_sixbar",
        ["input_torque", "reaction O5 on jaw", "jaw.angle"],
        ["pitman.length", "crank.length", "jaw.mass", "loads.crushing.ramp.1", "frame.O3.y"],
        1e-5,
    ),
    ("shaper_quick_return", ["input_torque", "reaction F on ram"], ["crank.length", "guide.offset"], 1e-4),
    (
        "triad",
        ["input_torque", "reaction O3 on bar_3", "plate.angle"],
        ["crank.A.x", "plate.R.y", "bar_1.mass"],
        1e-4,
    ),
]


@pytest.mark.rotating
@pytest.mark.parametrize("way", ["forward", "reverse"])
@pytest.mark.parametrize(("name", "outputs", "by", "part"), CASES, ids=[case[0] for case in CASES])
def test_derivatives_are_the_limits_of_differences(
    name: str, outputs: list[str], by: list[str], part: float, way: str
) -> None:
    steps = 360 if name == "jaw_crusher_sixbar" else 72
    mechanism = stored(name)
    asked = [*outputs, *((output, kind) for output in outputs for kind in KINDS)]
    found = sensitivity(mechanism, of=asked, by=by, steps=steps, way=way)  # type: ignore[arg-type]
    for output in outputs:
        for address in by:
            slope, summaries = differences(mechanism, output, address, steps, part)
            size = np.abs(slope).max()
            assert np.abs(found.slope(output, address) - slope).max() <= 1e-6 * size + 1e-9, (output, address)
            for kind, expected in summaries.items():
                gradient = found.gradient(output, kind)[found.by.index(address)]
                assert abs(gradient - expected) <= 1e-6 * max(abs(expected), 1e-3 * size) + 1e-9, (
                    output,
                    kind,
                    address,
                )


def test_angles_do_not_change_with_the_scale() -> None:
    """Σ l ∂θ/∂l = 0 over all lengths (Euler, degree 0); velocities grow with it (degree 1)."""
    mechanism = stored("crank_rocker")
    lengths = [
        a for a in mechanism.dimensions() if a.endswith((".length", ".x", ".y")) and not a.startswith("gravity")
    ]
    found = sensitivity(mechanism, of=["coupler.angle", "coupler.P.velocity"], by=lengths)
    dimensions = mechanism.dimensions()
    total = sum(dimensions[a] * found.slope("coupler.angle", a) for a in lengths)
    assert np.abs(total).max() < 1e-12
    velocity = found.curve("coupler.P.velocity")
    grown = sum(dimensions[a] * found.slope("coupler.P.velocity", a) for a in lengths)
    assert grown == pytest.approx(velocity, rel=1e-11)


def test_torque_is_linear_in_masses_and_load() -> None:
    """T is homogeneous of degree 1 in all masses, inertias and load numbers together."""
    mechanism = stored("jaw_crusher_sixbar")
    linear = [a for a in mechanism.dimensions() if a.endswith((".mass", ".inertia"))]
    linear += ["loads.crushing.ramp.0", "loads.crushing.ramp.1"]
    for way in ("forward", "reverse"):
        found = sensitivity(mechanism, of=["driver.effort rms"], by=linear, way=way)
        gradient = found.gradient("driver.effort rms")
        assert gradient @ [mechanism.dimension(a) for a in linear] == pytest.approx(
            found.value("driver.effort rms"), rel=1e-12
        )


def test_the_stroke_of_an_in_line_slider_crank_grows_by_two_cranks() -> None:
    mechanism = stored("slider_crank_inline")
    found = sensitivity(mechanism, of=["cylinder.displacement range"], by=["crank.length", "rod.length"])
    gradient = found.gradient("cylinder.displacement range")
    assert gradient[0] == pytest.approx(2.0, rel=1e-12)
    assert gradient[1] == pytest.approx(0.0, abs=1e-12)
    assert found.relative("cylinder.displacement range")[0] == pytest.approx(1.0, rel=1e-12)


def test_compiled_derivatives_agree() -> None:
    mechanism = stored("jaw_crusher_sixbar")
    asked = ["driver.effort", ("reaction O5 on jaw", "rms")]
    by = ["pitman.length", "frame.O3.x"]
    for way in ("forward", "reverse"):
        plain = sensitivity(mechanism, of=asked, by=by, backend="numpy", way=way)  # type: ignore[arg-type]
        fast = sensitivity(mechanism, of=asked, by=by, backend="llvm", way=way)  # type: ignore[arg-type]
        for address in by:
            a, b = plain.slope("driver.effort", address), fast.slope("driver.effort", address)
            assert np.abs(a - b).max() <= 1e-10 * np.abs(a).max()
            pair = [each.gradient("reaction O5 on jaw", "rms")[each.by.index(address)] for each in (plain, fast)]
            assert pair[0] == pytest.approx(pair[1], rel=1e-10)


def test_derivatives_on_the_way_through_change_points() -> None:
    """Of a parallelogram's driver torque by the coupler's mass: g r cos φ."""
    mechanism = lw.loads(
        """
format: 1
name: parallelogram
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.4 m, mass: 2 kg}
  follower: {points: [O2, B], length: 0.1 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 30.5 deg}
gravity: [0, -9.81 m/s²]
"""
    )
    for way in ("forward", "reverse"):
        asked = ["driver.effort", "driver.effort mean"]
        found = sensitivity(mechanism, of=asked, by=["coupler.mass"], steps=360, way=way)
        expected = 9.81 * 0.1 * np.cos(found.input)
        assert found.slope("driver.effort", "coupler.mass") == pytest.approx(expected, abs=1e-7)
        assert found.gradient("driver.effort mean")[0] == pytest.approx(0.0, abs=1e-7)


LOADS = {
    "expression": 'magnitude: "100 N*(1 + rocker/(1 rad))^2 + 30 N*sin(input)"',
    "table over an output": "table: {over: rocker, x: [0 deg, 60 deg, 100 deg, 180 deg], "
    "y: [0 N, 90 N, 20 N, 300 N]}",
    "ramp while it moves": "ramp: [10 N, 200 N], phase: {moving: rocker, direction: increasing}",
    "ramp between limits": "ramp: [10 N, 200 N], phase: {of: rocker, from: max, to: min}",
    "ramp over a part of a stroke": "ramp: [10 N, 200 N], phase: {of: rocker, from: max, to: min, first: 0.4}",
    "link that turns through": 'magnitude: "100 N + 10 N*crank/(1 rad)*sin(rocker)"',
    "expression that divides": 'magnitude: "100 N/(2 + rocker/(1 rad))"',
    "constant in a phase": "magnitude: 150 N, phase: {of: rocker, from: max, to: min}",
}


@pytest.mark.parametrize("load", LOADS.values(), ids=LOADS)
def test_loads_that_follow_the_motion_are_differentiated(load: str) -> None:
    text = lw.dump(stored("crank_rocker"))
    mechanism = lw.loads(text + f"\nloads: {{push: {{kind: force, on: rocker, at: B, direction: 20 deg, {load}}}}}\n")
    for address in ("coupler.length", "crank.length"):
        value, steps = mechanism.dimension(address), 360
        step = 2e-6 * value
        ends = [
            lw.solve_forces(mechanism.with_dimensions({address: value + k * step}), steps=steps).input_torque
            for k in (-1, 1)
        ]
        expected = (ends[1] - ends[0]) / (2 * step)
        found = sensitivity(mechanism, of=["input_torque"], by=[address], steps=steps)
        gap = np.abs(found.slope("input_torque", address) - expected)
        # positions that enter or leave the phase, or cross a kink of the table, between the differences may differ
        assert np.sort(gap)[:-4].max() <= 1e-6 * np.abs(expected).max()
        assert np.abs(expected).max() > 1.0


ITERATED = {
    "ramp over the input": "ramp: [10 N, 200 N], phase: {input: [40 deg, 190 deg]}",
    "while it moves": "magnitude: 150 N, phase: {moving: bar_2, direction: increasing}",
    "between limits": "magnitude: 150 N, phase: {of: bar_2, from: max, to: min}",
    "angle": 'magnitude: "100 N*(1 + bar_2/(1 rad))"',
}


def iterated(load: str) -> lw.Mechanism:
    """A triad, which Newton's method solves: where a load acts is known per position."""
    text = lw.dump(stored("triad")).split("\nloads:")[0]
    return lw.loads(text + f"\nloads: {{push: {{kind: force, on: bar_2, at: Q, direction: 20 deg, {load}}}}}\n")


@pytest.mark.parametrize("load", ITERATED.values(), ids=ITERATED)
def test_loads_of_a_machine_without_closed_form_go_on_acting_where_they_act(load: str) -> None:
    mechanism, steps = iterated(load), 30
    address = "plate.R.y"
    value = mechanism.dimension(address)
    step = 1e-6 * abs(value)
    ends = [
        lw.solve_forces(mechanism.with_dimensions({address: value + k * step}), steps=steps).input_torque
        for k in (-1, 1)
    ]
    expected = (ends[1] - ends[0]) / (2 * step)
    assert np.abs(expected).max() > 1.0
    found = sensitivity(mechanism, of=["input_torque"], by=[address], steps=steps)
    gap = np.abs(found.slope("input_torque", address) - expected)
    assert np.sort(gap)[:-2].max() <= 2e-6 * np.abs(expected).max()
    alone = lw.solve_forces(mechanism, steps=steps).input_torque
    assert found.curve("input_torque") == pytest.approx(alone, rel=1e-9, abs=1e-9)


def test_what_moves_without_a_closed_form_or_almost_locks_has_no_derivative() -> None:
    ramp = iterated("ramp: [10 N, 200 N], phase: {of: bar_2, from: max, to: min}")
    with refused("study.ramp_slope", name="push"):
        sensitivity(ramp, of=["input_torque"], by=["plate.R.y"], steps=60)
    wheels = stored("rack_and_rocker")
    joints = {
        name: replace(joint, friction=0.3)
        if joint.coordinate == "slide"
        else replace(joint, friction=0.3, pin_radius=0.25)
        for name, joint in wheels.joints.items()
        if not joint.higher
    }
    locking = replace(wheels, joints={**wheels.joints, **joints})
    with refused("study.friction_slope"):
        sensitivity(locking, of=["input_torque"], by=["rocker.mass"], steps=24)


def test_relative_derivatives_are_percent_per_percent_and_none_of_zero() -> None:
    """In line: the stroke is twice the crank, and B stays on the x axis."""
    found = sensitivity(
        stored("slider_crank_inline"),
        of=["cylinder.displacement range", "B.y max", "cylinder.displacement min", "cylinder.displacement max"],
        by=["crank.length", "rod.length"],
        steps=24,
    )
    assert found.relative("cylinder.displacement range") == pytest.approx([1.0, 0.0], abs=1e-12)
    assert np.isnan(found.relative("B.y max")).all()
    for kind, sense in (("min", -1.0), ("max", 1.0)):
        place = 0.2 + sense * 0.05
        assert found.value("cylinder.displacement", kind) == pytest.approx(place)
        assert found.gradient("cylinder.displacement", kind) == pytest.approx([sense, 1.0])
        assert found.relative("cylinder.displacement", kind) == pytest.approx([sense * 0.05 / place, 0.2 / place])
    assert found.by_name("cylinder.displacement range") == pytest.approx({"crank.length": 2.0, "rod.length": 0.0})
    rows = found._repr_html_().split("<tr>")[2:]
    assert len(rows) == 4 and rows[0].count("<td") == 4 and ">0.1<" in rows[0] and ">2<" in rows[0]


@pytest.mark.parametrize(("links", "turns"), [("[coupler, rocker]", False), ("[frame, crank]", True)])
def test_torsion_springs_are_differentiated(links: str, turns: bool) -> None:
    """Between links that a dyad places; on the crank, which winds it up whatever the lengths of the others."""
    spring = f"{{kind: torsion_spring, links: {links}, stiffness: 20 N·m/rad, free_angle: 100 deg}}"
    machine = lw.loads(lw.dump(stored("crank_rocker")) + f"\nloads: {{spring: {spring}}}\n")
    by = ["coupler.length", "loads.spring.stiffness"]
    found = sensitivity(machine, of=["driver.effort rms"], by=by, steps=36)

    def alone(changes: dict[str, float]) -> float:
        torque = lw.solve_forces(machine.with_dimensions(changes), steps=36).input_torque
        return float(np.sqrt((torque**2).mean()))

    for address, slope in zip(by, found.gradient("driver.effort rms"), strict=True):
        value = machine.dimension(address)
        ends = [alone({address: value + k * 1e-5 * value}) for k in (-1, 1)]
        assert slope == pytest.approx((ends[1] - ends[0]) / (2e-5 * value), rel=1e-6, abs=1e-9)
    assert found.value("driver.effort rms") == pytest.approx(alone({}), rel=1e-12)
    swept = lw.sweep(machine, {by[0]: [3.1, 3.3]}, outputs=["driver.effort rms"], steps=36)
    assert swept["driver.effort rms"] == pytest.approx([alone({by[0]: x}) for x in (3.1, 3.3)], rel=1e-9)
    assert (found.gradient("driver.effort rms")[0] == 0.0) == turns


@pytest.mark.parametrize("way", ["forward", "reverse"])
def test_what_passes_through_zero_at_a_position_keeps_its_slope_there(way: Any) -> None:
    """y of a crank's pin is y of the frame's plus r sin θ: exactly zero at the first of eight positions."""
    crank = lw.loads(
        "format: 1\nname: crank\nframe: {points: {O: [0 m, 0 m]}}\n"
        "links: {crank: {points: [O, A], length: 0.1 m}}\ndriver: {turn: crank, about: O, speed: 2 rad/s}"
    )
    found = sensitivity(crank, of=["A.y", "A.y mean"], by=["frame.O.y"], steps=8, way=way)
    assert found.curve("A.y")[0] == 0.0
    assert found.slope("A.y", "frame.O.y").tolist() == pytest.approx([1.0] * 8, rel=1e-14)
    assert found.gradient("A.y mean") == pytest.approx([1.0], rel=1e-14)


def test_a_structure_has_derivatives_at_its_one_position() -> None:
    """Two bars at 45° carry 20 N downwards at their pin: a compression of F/√2 in each."""
    text = """
format: 1
name: two bars
frame: {points: {O: [0 m, 0 m], Q: [2 m, 0 m]}}
links:
  left: {points: [O, C], length: 1.4142135623730951 m}
  right: {points: [Q, C], length: 1.4142135623730951 m}
assembly: {C: left}
loads: {weight: {kind: force, on: left, at: C, direction: -90 deg, magnitude: 20 N}}
"""
    found = sensitivity(lw.loads(text), of=["reaction O on left"], by=["loads.weight.magnitude"])
    assert found.input.tolist() == [0.0]
    slope = found.slope("reaction O on left", "loads.weight.magnitude")
    assert slope == pytest.approx([np.sqrt(0.5)], rel=1e-12)


def test_a_machine_that_cannot_pass_between_two_positions_has_no_derivatives() -> None:
    """Crank 1 m + 10 µm, frame 4 m: coupler and rocker of 5 m together do not reach around half a turn."""
    model = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1.00001 m}
  coupler: {points: [A, B], length: 3 m}
  rocker: {points: [O2, B], length: 2 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s, start: 20.5 deg}
"""
    with refused("motion.not_passed", lw.PositionError, where="driver = 180°"):
        lw.sensitivity(lw.loads(model), of="rocker.angle max", by=["crank.length"], steps=36)
