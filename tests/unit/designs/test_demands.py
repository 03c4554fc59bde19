"""Demands as people write them, with their bounds in SI."""

from __future__ import annotations

import math

import pytest

import linkwright as lw
from linkwright.designs.demands import bounds_of, demand_of
from linkwright.designs.optimise.problem import problem
from linkwright.units import DIMENSIONS

INF = math.inf


@pytest.mark.parametrize(
    ("value", "low", "high"),
    [
        ("at least 40 mm", 0.04, INF),
        ("at most 60 mm", -INF, 0.06),
        ("1..2 m", 1.0, 2.0),
        ("10 mm .. 1 m", 0.01, 1.0),
        ("120 mm ± 0.5 mm", 0.1195, 0.1205),
        ("120 +- 0.5 mm", 0.1195, 0.1205),
        ("120 mm +/- 1 %", 0.1188, 0.1212),
        ({"equals": "120 mm", "within": "1 %"}, 0.1188, 0.1212),
        ({"equals": "120 mm ± 1 mm"}, 0.119, 0.121),
        ({"at_least": "1 cm", "at_most": "2 cm"}, 0.01, 0.02),
        ("same within 10 %", 1.8, 2.2),
    ],
)
def test_what_demands_mean(value: object, low: float, high: float) -> None:
    demand = demand_of(value)
    assert demand is not None
    bounds = bounds_of(demand, DIMENSIONS["length"], 2.0)
    assert (bounds.low, bounds.high) == pytest.approx((low, high), rel=1e-12)


@pytest.mark.parametrize(
    "value",
    [
        "",
        "120 mm",
        "at least",
        "same 1 %",
        {},
        {"within": "1 mm"},
        {"equals": "1 mm", "at_most": "2 mm"},
        {"equals": "1 mm ± 1 mm", "within": "2 mm"},
    ],
)
def test_what_is_no_demand(value: object) -> None:
    assert demand_of(value) is None


def test_searches_keep_equalities_within_tolerances() -> None:
    machine = lw.load("gallery:crank_rocker")
    settings = {
        "vary": {"crank.length": "0.9..1.1 m"},
        "minimize": "peak_acceleration",
        "keep": {"swing_angle": "45 deg ± 1 deg"},
    }
    (demand,) = problem(machine, settings).demands
    assert (demand.text, demand.equals, demand.within, demand.unit) == ("swing_angle", "45 deg", "1 deg", "deg")
    best = lw.optimize(machine, **settings, evaluations=60)
    swing = lw.metrics(lw.solve_motion(machine.with_dimensions(best.best.values)), ["swing_angle"]).value(
        "swing_angle"
    )
    assert math.radians(44.0) * (1 - 1e-6) <= swing <= math.radians(46.0) * (1 + 1e-6)
