"""Summaries over positions, and formulas of them with their gradients, against closed forms of a slider-crank."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.every import every

from linkwright.formula.gradient import Gradient
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.summaries import Backend, Summaries
from linkwright.formula.trace import Scalar, Trace, cos, select, sin, sqrt

Floats = NDArray[np.float64]
BACKENDS = ["numpy", pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="no llvmlite"))]
COUNT = 36
INPUT = {"q": np.arange(COUNT) * math.tau / COUNT}
ASKED = (
    Reduction("x", "mean"),
    Reduction("x", "rms"),
    Reduction("y", "max"),
    Reduction("x", "min"),
    Reduction("y", "sum"),
    Reduction("y", "mean"),
)


def stroke_of(q: Scalar, r: Scalar, rod: Scalar, e: Scalar) -> tuple[Scalar, Scalar]:
    """Place of the slider of an offset slider-crank, and what must not be negative for it to be assembled."""
    square = rod * rod - (r * sin(q) - e) * (r * sin(q) - e)
    return r * cos(q) + sqrt(square), square


def slider() -> Program:
    t = Trace()
    r, rod, e = (t.parameter(name) for name in ("r", "l", "e"))
    x, square = stroke_of(t.position("q"), r, rod, e)
    y = select(x < rod, x * x, sin(x))
    return Program.of(t, {"x": x, "y": y, "valid": square >= 0.0})


def total() -> Program:
    """A formula of summaries of every kind, and of dimensions."""
    t = Trace()
    p = t.parameter
    spread = p("x.rms") * p("y.sum") / p("valid.count") + p("x.max")
    found = p("y.mean") * p("x.rms") + p("y.max") * p("e") - p("x.min") * p("y.min")
    return Program.of(t, {"total": found + spread * p("r") + p("x.mean")})


def total_by_hand(r: float, rod: float, e: float) -> float:
    """The same by plain sums."""
    x = r * np.cos(INPUT["q"]) + np.sqrt(rod * rod - (r * np.sin(INPUT["q"]) - e) ** 2)
    y = np.where(x < rod, x * x, np.sin(x))
    rms = math.sqrt((x * x).mean())
    spread = r * (rms * y.mean() + x.max())
    return float(y.mean() * rms + y.max() * e - x.min() * y.min() + spread + x.mean())


def designs(count: int) -> Floats:
    """Cranks, rods and offsets in the order of the program's parameters."""
    rng = np.random.default_rng(count)
    r = rng.uniform(0.5, 1.5, count)
    columns = {"r": r, "l": r * rng.uniform(1.8, 4.0, count), "e": r * rng.uniform(-0.5, 0.5, count)}
    return np.stack([columns[name] for name in slider().parameters], axis=1)


def named(row: Floats) -> dict[str, float]:
    return dict(zip(slider().parameters, row.tolist(), strict=True))


def by_hand(row: Floats) -> float:
    numbers = named(row)
    return total_by_hand(numbers["r"], numbers["l"], numbers["e"])


@pytest.mark.parametrize("backend", BACKENDS)
def test_results_depend_neither_on_threads_nor_on_the_other_designs(backend: Backend) -> None:
    table, sums = designs(2000), Summaries(slider(), ASKED)
    one = sums.evaluate(table, INPUT, threads=1, backend=backend)
    two = sums.evaluate(table, INPUT, threads=3, backend=backend)
    part = sums.evaluate(table[700:717], INPUT, backend=backend)
    for name, values in one.items():
        np.testing.assert_array_equal(values, two[name])
        np.testing.assert_array_equal(values[700:717], part[name])
    empty = sums.evaluate(table[:0], INPUT, backend=backend)
    assert all(values.shape == (0,) for values in every(empty.values()))


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("count", [1, 8, 23])
def test_gradients_pass_through_extremes_and_formulas(backend: Backend, count: int) -> None:
    """Against differences of closed forms."""
    table = designs(count)
    gradient = Gradient(slider(), total(), ["e", "r"])
    values, slopes = gradient.evaluate(table, INPUT, backend=backend)
    assert slopes.shape == (count, 2)
    np.testing.assert_array_equal(gradient.values(table, INPUT, backend=backend), values)
    for d, row in enumerate(table):
        assert values[d] == pytest.approx(by_hand(row), rel=1e-12)
        for column, name in enumerate(("e", "r")):
            step = np.zeros(3)
            step[slider().parameters.index(name)] = 1e-6
            want = (by_hand(row + step) - by_hand(row - step)) / 2e-6
            assert slopes[d, column] == pytest.approx(want, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_design_that_cannot_turn_has_no_complete_value(backend: Backend) -> None:
    table = designs(9)
    rod, crank = (slider().parameters.index(name) for name in ("l", "r"))
    table[4, rod] = 0.9 * table[4, crank]
    gradient = Gradient(slider(), total(), complete=True)
    values, slopes = gradient.evaluate(table, INPUT, backend=backend)
    want, others = gradient.evaluate(np.delete(table, 4, axis=0), INPUT, backend=backend)
    np.testing.assert_array_equal(np.delete(values, 4), want)
    np.testing.assert_array_equal(np.delete(slopes, 4, axis=0), others)
    assert math.isnan(values[4])
    assert np.isnan(slopes[4]).all()


@pytest.mark.parametrize("backend", BACKENDS)
def test_designs_that_go_in_several_parts_are_put_together(backend: Backend, monkeypatch: pytest.MonkeyPatch) -> None:
    """A few at a time, results and gradients are those of all at once."""
    table, sums, gradient = designs(19), Summaries(slider(), ASKED), Gradient(slider(), total())
    wanted = sums.evaluate(table, INPUT, backend=backend)
    values, slopes = gradient.evaluate(table, INPUT, backend=backend)
    for module in ("summaries", "gradient"):
        monkeypatch.setattr(f"linkwright.formula.{module}._BLOCK", 8 * COUNT)
    found = sums.evaluate(table, INPUT, backend=backend)
    for name, column in wanted.items():
        np.testing.assert_array_equal(found[name], column, err_msg=name)
    again, derived = gradient.evaluate(table, INPUT, backend=backend)
    np.testing.assert_array_equal(again, values)
    np.testing.assert_allclose(derived, slopes, rtol=1e-13)


def test_gradients_and_inputs_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match="speed"):
        Gradient(slider(), Reduction("x", "mean"), ["speed"])
    with pytest.raises(ValueError, match="'w'"):
        Gradient(slider(), Reduction("w", "mean"))
    sums = Summaries(slider(), ASKED)
    with pytest.raises(ValueError, match=r"\[3, 36\]"):
        sums.evaluate(designs(2), INPUT, {"other": np.ones((2, 3))}, backend="numpy")
    with pytest.raises(ValueError, match=r"\[\]"):
        sums.evaluate(designs(2), {}, backend="numpy")
    with pytest.raises(ValueError, match="columns"):
        Gradient(slider(), total()).evaluate(designs(2)[:, :1], INPUT, backend="numpy")
