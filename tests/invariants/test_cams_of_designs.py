"""Design numbers of many machines with a cam: those of the cam by itself, and of each machine alone."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright.core.arrays import Floats
from linkwright.metrics import METRICS, Analysis
from linkwright.study.design_numbers import numbers_of
from linkwright.study.metric_cycle import metric_cycle
from linkwright.study.terms import measured

GEARED = """
format: 1
name: cam behind gears
frame: {points: {M: [-90 mm, 0 mm], O: [0 mm, 0 mm], G: [6 mm, 0 mm]}}
links:
  motor: {points: {M: [0 mm, 0 mm], R: [10 mm, 0 mm]}, mass_centre: [0 mm, 0 mm], mass: 1 kg, inertia: 0.001 kg·m²}
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}, mass_centre: [0 mm, 0 mm], mass: 1 kg, inertia: 0.001 kg·m²}
  slide: {points: {P: [0 mm, 0 mm], Q: [0 mm, 40 mm]}, mass: 0.5 kg, inertia: 0.001 kg·m²}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}
  mesh: {kind: gear, links: [motor, cam], teeth: [30, 60], module: 2 mm, phase: 15 deg}
  lobe:
    kind: cam
    cam: cam
    follower: slide
    at: P
    touch: roller
    roller_radius: 10 mm
    base_radius: 50 mm
    phase: 20 deg
    program:
      - {rise: 18 mm, over: 110 deg, law: double_harmonic}
      - {dwell: 60 deg}
      - {fall: 18 mm, over: 100 deg, law: {kind: modified_sine, crossover: 0.45}}
      - {dwell: 90 deg}
driver: {turn: motor, about: M, speed: -180 rpm}
gravity: [0, -9.81 m/s²]
loads: {spring: {kind: force, on: slide, at: P, direction: -90 deg, magnitude: 60 N}}
"""
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
    cycle = metric_cycle(mechanism, BY, NAMES)
    assert cycle is not None
    given = columns(mechanism)
    found = cycle.evaluate(given)
    assert found.certain.all()
    area, _, _ = numbers_of(mechanism, given, ["swept_area"], np.arange(3))
    torque = [rms_torque(mechanism, mass) for mass in given["slide.mass"]]
    assert found.values["rms_input_torque"] == pytest.approx(torque, rel=1e-8)
    for index in (1, 2):
        alone = mechanism.with_dimensions({name: float(column[index]) for name, column in given.items()})
        analysis = Analysis.of(lw.solve_forces(alone))
        assert (measured("swept_area", analysis) or (0.0,))[0] == pytest.approx(
            area["swept_area"][index], rel=1e-7
        )
        assert {"peak_reaction", "mean_power", "peak_jerk", "stroke"} <= {term.name for term in cycle.terms}
        for term in cycle.terms:
            known = measured(term.name, analysis)
            assert known is not None
            assert found.values[term.name][index] == pytest.approx(known[0], rel=1e-11, abs=1e-9), term.name


def test_the_cuts_move_with_the_cam() -> None:
    """The torque of a follower that gravity holds along its guide does not know when the cam began."""
    mechanism = lw.loads(GEARED)
    cycle = metric_cycle(mechanism, BY, ["rms_input_torque"])
    assert cycle is not None
    given = columns(mechanism)
    values, slopes = cycle.gradients([{"rms_input_torque": 1.0}], given, ["lobe.phase", "slide.mass"])
    assert slopes[0, :, 0] == pytest.approx(0.0, abs=1e-9 * float(values[0].max()))
    step = 1e-4
    for row, slope, mass in zip(values[0], slopes[0, :, 1], given["slide.mass"], strict=True):
        near = [rms_torque(mechanism, mass + side * step) for side in (1.0, -1.0)]
        assert slope == pytest.approx((near[0] - near[1]) / (2.0 * step), rel=1e-6), row
