"""Metrics of many machines with a cam: those of the cam by itself, and of each machine alone."""

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq
from tests.invariants.dense import dense
from tests.invariants.numbers_alone import numbers_alone
from tests.invariants.turned_cams import GEARED, ROCKING, UNEVEN
from tests.refusals import findings
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import METRICS, Analysis
from linkwright.cycle import Summary

Floats = NDArray[np.float64]

BY = ("lobe.phase", "lobe.base_radius", "slide.mass")
#: Which limit of a cycle is the first changes with the phase.
NAMES = [name for name, metric in METRICS.items() if not metric.on_request and name != "limit_position"]
NAMES.append("limit_position guide max")


def rms_torque(mechanism: lw.Mechanism, mass: float) -> float:
    """Root mean square of the motor's torque: power of the cam's effort over whole segments of its program."""
    speed, program = 3.0 * math.pi, mechanism.joints["lobe"].program  # type: ignore[attr-defined]
    load, total = lw.CamLoading(speed, mass, 60.0 + 9.81 * mass), 0.0
    nodes, weights = np.polynomial.legendre.leggauss(40)
    for low, high in zip(program.breaks[:-1], program.breaks[1:], strict=True):
        half = 0.5 * (high - low)
        phi = 0.5 * (low + high) + half * nodes
        torque = 0.5 * load.effort(program, phi) * program.curves(phi)[1]
        total += half * float(weights @ torque**2)
    return math.sqrt(total / (2.0 * math.pi))


def columns(mechanism: lw.Mechanism) -> dict[str, Floats]:
    return {
        "lobe.phase": mechanism.dimension("lobe.phase") + np.array([0.0, 0.3, -1.0]),
        "lobe.base_radius": 0.05 * np.array([1.0, 0.98, 1.03]),
        "slide.mass": np.array([0.5, 0.55, 0.4]),
    }


def test_designs_are_cut_where_the_lift_of_the_cam_bends() -> None:
    mechanism = lw.loads(GEARED)
    given = columns(mechanism)
    names = list(numbers_alone(mechanism, given, 0, NAMES))
    found = lw.sweep(mechanism, given, outputs=names)
    torque = [rms_torque(mechanism, mass) for mass in given["slide.mass"]]
    assert found["rms_input_torque"] == pytest.approx(torque, rel=1e-8)
    for index in (1, 2):
        alone = numbers_alone(mechanism, given, index, names)
        assert alone.keys() >= {"peak_reaction", "mean_power", "peak_jerk", "stroke", "swept_area"}
        for name, value in alone.items():
            near = {"rel": 1e-7} if name == "swept_area" else {"rel": 1e-11, "abs": 1e-9}
            assert found[name][index] == pytest.approx(value, **near), name


def test_the_cuts_move_with_the_cam() -> None:
    """The torque of a follower that gravity holds along its guide does not know when the cam began."""
    mechanism = lw.loads(GEARED)
    given = columns(mechanism)
    by = ["lobe.phase", "slide.mass"]
    objective = lw.objective(mechanism, "rms_input_torque", vary=by)
    values, slopes = objective.many(np.stack([given[name] for name in by], axis=1))
    assert slopes[:, 0] == pytest.approx(0.0, abs=1e-9 * float(values.max()))
    step = 1e-4
    for row, slope, mass in zip(values, slopes[:, 1], given["slide.mass"], strict=True):
        near = [rms_torque(mechanism, mass + side * step) for side in (1.0, -1.0)]
        assert slope == pytest.approx((near[0] - near[1]) / (2.0 * step), rel=1e-6), row


def turned(x: Floats, length: float) -> tuple[Floats, Floats, Floats]:
    """Angle of the driven crank about O with its first and second derivatives by the driver's, over inputs x, rad."""
    tip = -0.03 + 0.1 * np.exp(1j * x)
    reach, first, second = np.abs(tip), 0.1j * np.exp(1j * x) / tip, -0.1 * np.exp(1j * x) / tip
    towards, away = first.imag, (second - first**2).imag
    radial = first.real * reach
    radial2 = (second - first**2).real * reach + first.real * radial
    cosine = (reach**2 + 0.09**2 - length**2) / (0.18 * reach)
    slope = 1.0 / 0.09 - cosine / reach
    cosine1 = slope * radial
    cosine2 = slope * radial2 - (cosine1 / reach - cosine * radial / reach**2) * radial
    sine = np.sqrt(1.0 - cosine**2)
    side = -cosine1 / sine
    side2 = -cosine2 / sine - cosine * cosine1**2 / sine**3
    return np.angle(tip) + np.arccos(cosine), towards + side, away + side2


def torque_of(mechanism: lw.Mechanism, length: float, mass: float, phase: float) -> tuple[float, float]:
    """Root mean square and largest size of the shaft's torque, from power over pieces between the lift's bends."""
    program, speed = mechanism.joints["lobe"].program, 6.0 * math.pi  # type: ignore[attr-defined]
    inputs = np.linspace(0.0, 2.0 * math.pi, 4001)
    angle = np.unwrap(turned(inputs, length)[0])
    whole = [each + phase + 2.0 * math.pi * lap for each in program.breaks[:-1] for lap in range(-2, 3)]
    bends = [
        brentq(lambda x, to=to: math.remainder(float(turned(x, length)[0]) - to, math.tau), x - 0.01, x + 0.01)
        for to in whole
        if angle[0] < to < angle[-1]
        for x in [float(np.interp(to, angle, inputs))]
    ]
    edges = np.array(sorted([0.0, *np.radians([70.0, 200.0]), *bends, 2.0 * math.pi]))
    nodes, weights = np.polynomial.legendre.leggauss(40)
    total, largest = 0.0, 0.0
    for low, high in pairwise(edges):
        x = 0.5 * (low + high) + 0.5 * (high - low) * np.append(nodes, np.linspace(-1.0, 1.0, 3001))
        phi, first, second = turned(x, length)
        lift = program.curves(np.mod(phi - phase, 2.0 * math.pi))
        force = 60.0 + (40.0 if np.radians(70.0) < x[0] < np.radians(200.0) else 0.0)
        force = force + mass * speed**2 * (lift[2] * first**2 + lift[1] * second)
        torque = force * lift[1] * first
        total += 0.5 * (high - low) * float(weights @ torque[:40] ** 2)
        largest = max(largest, float(np.abs(torque[40:]).max()))
    return math.sqrt(total / (2.0 * math.pi)), largest


def test_cams_that_turn_unevenly_are_cut_where_their_lifts_bend() -> None:
    """The cam is on the driven crank of a double crank, whose bends every design passes at inputs of its own."""
    mechanism = lw.loads(UNEVEN)
    asked = ["rms_input_torque", "peak_input_torque"]
    by = ("coupler.length", "slide.mass", "lobe.phase")
    given = {"coupler.length": np.array([0.11, 0.112, 0.1]), "slide.mass": np.array([0.5, 0.9, 0.4])}
    given["lobe.phase"] = np.radians([20.0, 75.0, -12.0])
    found, designs = lw.sweep(mechanism, given, outputs=asked), np.stack([given[each] for each in by], axis=1)
    known = np.array([torque_of(mechanism, *design) for design in designs])
    assert found["rms_input_torque"] == pytest.approx(known[:, 0], rel=1e-9)
    assert found["peak_input_torque"] == pytest.approx(known[:, 1], rel=1e-6)
    values, slopes = lw.objective(mechanism, "rms_input_torque", vary=by).many(designs)
    assert values == pytest.approx(known[:, 0], rel=1e-9)
    for design, slope in zip(designs, slopes, strict=True):
        for number, step in enumerate((1e-6, 1e-5, 1e-5)):
            sides = [torque_of(mechanism, *(design + side * step * np.eye(3)[number]))[0] for side in (1.0, -1.0)]
            assert slope[number] == pytest.approx((sides[0] - sides[1]) / (2.0 * step), rel=1e-6, abs=1e-6)


def test_a_heavy_wheel_beside_a_cam_is_a_warning() -> None:
    """The cam's own size needs its pivot, which is found after the file is read."""
    text = GEARED.replace("inertia: 0.001", "inertia: 9")
    assert {each.code for each in findings(text)} == {"unlikely"}


def test_numbers_of_one_machine_with_a_cam_are_those_of_a_dense_quadrature() -> None:
    machine = lw.loads(UNEVEN.partition("  press:")[0])
    expected = dense(machine, 1.0 / 3.0)
    analysis = Analysis.of(lw.solve_forces(machine))
    found = [analysis.part(Summary.of(part)).value for part in ("power mean", "driver.effort rms")]
    assert found[1] == pytest.approx(expected[1], rel=1e-12)
    assert found[0] == pytest.approx(expected[0], abs=1e-12 * 6.0 * np.pi * expected[1])


@pytest.mark.rotating
def test_reactions_of_the_press_go_side_by_side_though_its_teeth_change_flanks_beside_its_cam() -> None:
    machine = stored("printing_press")
    names = ["peak_reaction", "rms_reaction", "rms_input_torque", "mean_power"]
    given = {"rod.length": machine.dimension("rod.length") * np.array([1.0, 1.002])}
    found = lw.sweep(machine, given, outputs=names)
    for k in range(2):
        alone = numbers_alone(machine, given, k, names)
        assert {name: found[name][k] for name in names} == pytest.approx(alone, rel=1e-10)


@pytest.mark.rotating
def test_designs_whose_cam_rocks_go_side_by_side() -> None:
    """The bends of the lift between the ends of the cam's way are passed on the way to and again on the way back."""
    machine = lw.loads(ROCKING)
    phases = machine.dimension("lobe.phase") + np.radians([0.0, 0.7, -0.5])
    given = {"lobe.phase": phases, "slide.mass": np.array([0.5, 0.5, 0.6])}
    found = lw.sweep(machine, given, outputs=["rms_input_torque", "peak_reaction"])
    objective = lw.objective(machine, "rms_input_torque", vary=list(given))
    values, slopes = objective.many(np.transpose(list(given.values())))
    assert values == pytest.approx(found["rms_input_torque"], rel=1e-13)
    for k, design in enumerate(np.transpose(list(given.values())).tolist()):

        def rms(changed: list[float]) -> float:
            return dense(machine.with_dimensions(dict(zip(given, changed, strict=True))), 1.0 / 3.0)[1]

        assert found["rms_input_torque"][k] == pytest.approx(rms(design), rel=1e-12)
        for number, step in enumerate((1e-4, 1e-4)):
            near = [[x + side * step * (i == number) for i, x in enumerate(design)] for side in (1, -1)]
            difference = (rms(near[0]) - rms(near[1])) / (2.0 * step)
            assert slopes[k, number] == pytest.approx(difference, rel=1e-5, abs=1e-8)
        known = numbers_alone(machine, given, k, ["peak_reaction"])["peak_reaction"]
        assert found["peak_reaction"][k] == pytest.approx(known, rel=1e-10)


@pytest.mark.parametrize("law", ["cycloidal", "modified_sine", "modified_trapezoidal", "polynomial_4567"])
def test_lifts_come_to_rest_where_their_laws_do(law: str) -> None:
    """At both sides of every bend, however short the pieces beside it."""
    begin, _, rest = GEARED.partition("program:")
    ways = [f"{{{way}: 4 mm, over: {over} deg, law: {law}}}" for way, over in (("rise", 5), ("fall", 345))]
    segments = f"[{ways[0]}, {{dwell: 10 deg}}, {ways[1]}]"
    joint = lw.loads(f"{begin}program: {segments}\ndriver:{rest.partition('driver:')[2]}").joints["lobe"]
    for bend in np.radians([0.0, 5.0, 15.0]):
        rate = joint.lift.curves(np.array([np.nextafter(bend, -1.0), bend]))[1]
        largest = 4e-3 * 2.0 / np.radians(5.0)
        assert np.abs(rate).max() < 1e-13 * largest
