"""Programs against published optima, closed forms and the conditions that an optimum keeps."""

import math
from typing import Any

import numpy as np
import pytest
from tests.contract.calculations import solved
from tests.refusals import refused

import linkwright as lw
from linkwright import parts

INCH = 0.0254


def free(*names: str, **bounds: float) -> dict[str, parts.Variable]:
    return {name: parts.Variable(**bounds) for name in names}  # type: ignore[arg-type]


def test_wyndor_glass() -> None:
    """x = 2, y = 6, profit 36, shadow prices 0, 3/2, 1 (Hillier and Lieberman)."""
    found = solved("production_mix")
    assert found.x == pytest.approx({"doors": 2, "windows": 6})
    assert found.value == pytest.approx(36)
    assert found.prices == pytest.approx({"shop_1": 0, "shop_2": 1.5, "shop_3": 1})


def test_prices_are_derivatives_of_the_optimum() -> None:
    def optimum(limit: float, least: float) -> Any:
        limits = {"a": f"2*x + y <= {limit!r}", "b": f"x + 3*y >= {least!r}", "c": "x - y <= 1"}
        return parts.Program.of(free("x", "y", low=0.0), minimize="4*x - y", subject_to=limits).solve()

    at = optimum(10.0, 3.0)
    for name, other in (("a", optimum(10.5, 3.0)), ("b", optimum(10.0, 3.5))):
        assert at.prices[name] == pytest.approx((other.value - at.value) / 0.5, abs=1e-9)
    top = parts.Program.of(free("x", "y", low=0.0), maximize="x + 2*y", subject_to={"a": "x + y <= 4", "b": "x >= 1"})
    assert top.solve().prices == pytest.approx({"a": 2, "b": -1})


def test_whole_numbers() -> None:
    """A knapsack by hand: 60, 100, 120 of weights 10, 20, 30 within 50."""
    chosen = {n: parts.Variable(0, 1, integer=True) for n in "abc"}
    found = parts.Program.of(chosen, maximize="60*a + 100*b + 120*c", subject_to={"w": "10*a + 20*b + 30*c <= 50"})
    assert found.solve().x == {"a": 0, "b": 1, "c": 1} and found.solve().way == "integer"


def test_two_bar_truss_of_fox() -> None:
    """d = 1.878 in, h = 20.237 in, W = 12.81 lb."""
    found = solved("two_bar_truss")
    assert found.x["d"] / INCH == pytest.approx(1.878, abs=1e-3)
    assert found.x["h"] / INCH == pytest.approx(20.237, abs=1e-3)
    assert found.value / 0.45359237 == pytest.approx(12.81, abs=5e-3)
    assert found.gap < 1e-6 and all(found.active(c) for c in found.program.subject_to)


def test_beam_section() -> None:
    found = solved("beam_section")
    b = (3 * 2000 / (2 * 120e6)) ** (1 / 3)
    assert found.x == pytest.approx({"b": b, "h": 2 * b}, rel=1e-6)
    assert found.prices["bending"] == pytest.approx(-(2 / 3) * 2 * b * b / 120e6, rel=1e-5)


@pytest.mark.rotating
def test_spring_is_best_where_one_freedom_is_left() -> None:
    """With stress and rate as equations the coil index is free: a search along it finds nothing lighter."""
    found = solved("lightest_spring")
    index = np.linspace(4, 12, 80001)
    wahl = (4 * index - 1) / (4 * index - 4) + 0.615 / index
    d = np.sqrt(8 * 800 * index * wahl / (math.pi * 600e6))
    turns = 79e9 * d / (8 * index**3 * 20e3)
    mass = math.pi**2 / 4 * 7850 * d**3 * index * (turns + 2)
    ok = (turns >= 3) & (turns <= 20) & (d * (1 + index) <= 0.06) & ((turns + 2) * d + 0.04 <= 0.12)
    best = np.where(ok, mass, np.inf).argmin()
    assert found.value == pytest.approx(mass[best], rel=1e-7)
    assert found.x["D"] / found.x["d"] == pytest.approx(index[best], rel=1e-3)


def test_gear_pair_is_the_best_of_all() -> None:
    found = solved("gear_pair")
    best = min(
        m * (z1 + z2) / 2
        for m in (1, 1.25, 1.5, 2, 2.5, 3, 4)
        for z1 in range(17, 41)
        for z2 in range(50, 131)
        if 3.18 <= z2 / z1 <= 3.22 and 120 / (10 * (m / 1000) ** 3 * z1 * (0.484 - 2.87 / z1)) <= 180e6
    )
    assert found.value == pytest.approx(best / 1000) and found.way == "enumerated"


def test_rosenbrock_without_constraints() -> None:
    variables = {n: parts.Variable(start=-1.2) for n in "xy"}
    found = parts.Program.of(variables, minimize="100*(y - x^2)^2 + (1 - x)^2").solve()
    assert found.x == pytest.approx({"x": 1, "y": 1}, abs=1e-4)


def test_hock_schittkowski_71() -> None:
    """f = 17.0140173 at (1, 4.7429994, 3.8211503, 1.3794082)."""
    limits = {"product": "a*b*c*d >= 25", "sum": "a^2 + b^2 + c^2 + d^2 = 40"}
    found = parts.Program.of(
        free(*"abcd", low=1.0, high=5.0), minimize="a*d*(a + b + c) + c", subject_to=limits
    ).solve()
    assert found.value == pytest.approx(17.0140173, abs=1e-6)
    assert list(found.x.values()) == pytest.approx([1, 4.7429994, 3.8211503, 1.3794082], abs=1e-5)
    assert found.prices["product"] == pytest.approx(0.5522937, abs=1e-5)
    assert found.gap < 1e-5


def test_mixed_program_by_branching() -> None:
    """min (x − 2.6)² + (y − x)², x whole, y continuous: x = 3, y = 3."""
    variables = {"x": parts.Variable(0, 10, integer=True), "y": parts.Variable(0, 10)}
    found = parts.Program.of(variables, minimize="(x - 2.6)^2 + (y - x)^2").solve()
    assert found.x == pytest.approx({"x": 3, "y": 3}, abs=1e-6) and found.way == "branched"


def test_conflicts_are_irreducible() -> None:
    """All of the set together cannot hold; without any one of it the rest can."""
    limits = {"a": "x + y >= 10", "b": "x <= 3", "c": "y <= 4", "d": "x - y <= 20", "e": "x + y <= 50"}

    def solve(*without: str) -> None:
        left = {name: limit for name, limit in limits.items() if name not in without}
        parts.Program.of(free("x", "y", low=0.0, high=100.0), minimize="x", subject_to=left).solve()

    with refused("infeasible", lw.ModelError, set={"a (x + y >= 10)", "b (x <= 3)", "c (y <= 4)"}):
        solve()
    with refused("infeasible", lw.ModelError):
        solve("d", "e")
    for one in ("a", "b", "c"):
        solve(one)


def test_units_enter() -> None:
    """The largest force of a bar of 20 mm by 5 mm at 100 MPa."""
    force = {"F": parts.Variable(low=0.0, dimension=(1, 1, -2, 0))}
    program = parts.Program.of(
        force, maximize="F", subject_to={"s": "F/(b*t) <= 100 MPa"}, parameters={"b": "20 mm", "t": "5 mm"}
    )
    assert program.solve().value == pytest.approx(10e3)
    assert program.solve().prices["s"] == pytest.approx(1e-4)


def test_a_variable_without_an_upper_bound_is_written_without_one() -> None:
    text = """
format: 1
kind: program
variables: {x: {from: 0}, y: {from: 1, to: 4, integer: true}, z: {to: 3}}
maximize: z - x - y
"""
    worked = parts.loads(text).solve().worked()
    assert "  x ≥ 0\n" in worked and "  1 ≤ y ≤ 4 ∈ ℤ\n" in worked and "  z ≤ 3\n" in worked
