"""NumPy and scalar evaluation against the formulas computed directly with Python floats."""

from __future__ import annotations

import math

import numpy as np
import pytest

from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.trace import Trace, absolute, power, select, sin, sqrt, stop


def formulas(a, b, c, x, y, f):  # type: ignore[no-untyped-def]
    """Works on numbers and on traced values."""
    k = sin(a) * b - c
    r = sqrt(x * x + y * y + k * k)
    low = x < y
    z = select(low, r / (x - 2.0), absolute(y) - f)
    return {"r": r, "z": z, "k": k, "x": x, "twice": r, "u": stop(z) * 3.0 + r * f - b / c}


@pytest.fixture(scope="module")
def program() -> Program:
    t = Trace()
    p = [t.parameter(n) for n in "abc"]
    x, y, f = t.position("x"), t.position("y"), t.field_input("f")
    return Program.of(t, {**formulas(*p, x, y, f), "low": x < y, "both": (x < y) & ~(f < p[0]), "yes": True})


def expected(p, x, y, f) -> list[float]:  # type: ignore[no-untyped-def]
    return [*formulas(*p, x, y, f).values(), float(x < y), float(x < y and not f < p[0]), 1.0]


@pytest.mark.parametrize("n", [1, 2, 7, 360])
def test_one_design_agrees_with_direct_evaluation(program: Program, n: int) -> None:
    rng = np.random.default_rng(n)
    x, y, f = rng.normal(size=(3, n))
    p = [0.3, 1.7, -0.4]
    want = np.array([expected(p, *v) for v in zip(x, y, f, strict=True)]).T
    got = NumpyProgram(program).run(p, {"x": x, "y": y}, {"f": f})
    np.testing.assert_allclose(got, want, rtol=1e-14)


@pytest.mark.parametrize(("designs", "n"), [(1, 1), (3, 5), (700, 11), (2, 40_000)])
def test_many_designs_equal_one_at_a_time(program: Program, designs: int, n: int) -> None:
    rng = np.random.default_rng(n)
    positions = {"x": rng.normal(size=n), "y": rng.normal(size=n)}
    f = rng.normal(size=(designs, n))
    table = rng.normal(size=(designs, 3))
    evaluator = NumpyProgram(program)
    got = evaluator.run_designs(table, positions, {"f": f})
    for d in {0, designs // 2, designs - 1}:
        np.testing.assert_allclose(got[d], evaluator.run(table[d], positions, {"f": f[d]}), rtol=1e-15)


def test_scalar_steps_agree_with_direct_evaluation(program: Program) -> None:
    scalar = ScalarProgram(program)
    for p in ([0.3, 1.7, -0.4], [0.1, 2.0, 5.0]):
        for x, y, f in ((1.0, 2.0, 3.0), (3.0, -2.0, 0.0)):
            outputs = scalar.step(p, [x, y], [f])
            assert outputs == pytest.approx(expected(p, x, y, f), rel=1e-15)


def test_division_by_zero_and_negative_roots_follow_ieee() -> None:
    t = Trace()
    a, x = t.parameter("a"), t.position("x")
    outputs = {"q": a / x, "r": sqrt(x), "h": 1.0 / a, "s": sqrt(a - 1.0)}
    program = Program.of(t, outputs)
    x_values = np.array([0.0, -0.0, -4.0, 4.0])
    got = NumpyProgram(program).run([0.0], {"x": x_values})
    want = np.array([[math.nan, math.nan, -0.0, 0.0], [0.0, -0.0, math.nan, 2.0], [math.inf] * 4, [math.nan] * 4])
    np.testing.assert_array_equal(got, want)
    scalar = ScalarProgram(program)
    for i, value in enumerate(x_values):
        np.testing.assert_array_equal(scalar.step([0.0], [float(value)]), want[:, i])
    assert NumpyProgram(program).run([-3.0], {"x": x_values})[0, :2].tolist() == [-math.inf, math.inf]


def test_powers_of_nought_follow_ieee() -> None:
    t = Trace()
    program = Program.of(t, {"p": power(t.position("x"), t.position("y"))})
    x, y = np.repeat([0.0, -0.0], 4), np.tile([-1.0, -3.0, -2.0, -0.5], 2)
    want = [math.inf] * 4 + [-math.inf, -math.inf, math.inf, math.inf]
    assert NumpyProgram(program).run([], {"x": x, "y": y})[0].tolist() == want
    assert [ScalarProgram(program).step([], [a, b])[0] for a, b in zip(x, y, strict=True)] == want


def test_missing_and_unequal_inputs_are_refused(program: Program) -> None:
    evaluator = NumpyProgram(program)
    x = np.ones(3)
    with pytest.raises(ValueError, match=r"\bf\b"):
        evaluator.run([1.0, 2.0, 3.0], {"x": x, "y": x})
    with pytest.raises(ValueError, match=r"\[3, 4\]"):
        evaluator.run([1.0, 2.0, 3.0], {"x": x, "y": np.ones(4)}, {"f": x})
    with pytest.raises(ValueError, match="3"):
        evaluator.run_designs(np.ones((2, 2)), {"x": x, "y": x}, {"f": np.ones((2, 3))})
