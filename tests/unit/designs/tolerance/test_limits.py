"""The share of machines within limits."""

import math

import pytest
from tests import store

import linkwright as lw
from linkwright.designs.tolerance import Tolerance, ToleranceStudy
from linkwright.designs.tolerance.problem import Limit

SLIDER = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod: {points: [A, B], length: 400 mm}
  slider: {points: [B], mass: 0 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {gas: {kind: force, on: slider, at: B, direction: 180 deg, magnitude: 500 N}}
"""


def test_yield() -> None:
    """Limits at ±1.5σ of a single normal tolerance that enters the stroke linearly."""
    problem = ToleranceStudy(
        lw.loads(SLIDER),
        {"crank.length": Tolerance(3e-4)},
        of=("B.x range",),
        limits={"B.x range": Limit(0.2 - 3e-4, 0.2 + 3e-4)},
        samples=4096,
    )
    share, low, high, linear = problem.solve().passed("B.x range")
    assert linear == pytest.approx(math.erf(1.5 / math.sqrt(2)), rel=1e-6)
    assert share == pytest.approx(linear, abs=2e-3) and low < linear < high


def test_machines_within_wide_limits_pass() -> None:
    held = {"crank.length": Tolerance(0.003)}
    within = {"swing_angle": Limit(0.0, 10.0)}
    found = ToleranceStudy(store.machine("crank_rocker"), held, of=("swing_angle",), limits=within, samples=64)
    assert found.solve().passed("swing_angle")[0] == 1.0
