"""Derivatives against differences in 60-digit arithmetic, and where the chain rule is treacherous."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import mpmath
import numpy as np
import pytest
from mpmath import mpf
from tests.every import every
from tests.unit.formula.objectives import Term, gradient_of, table_of

from linkwright.formula.gradient import forward, reverse
from linkwright.formula.llvm_backend import available
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.trace import Trace, absolute, cos, select, sin, sqrt, stop

BACKENDS = ["numpy", pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="no llvmlite"))]
X = np.array([-1.3, -0.2, 0.4, 0.9, 1.7, 2.2, 3.1, 0.05, 1.1, 2.9, -0.7])
P = {"a": 0.7, "b": -1.2, "c": 2.1}

EXACT: dict[str, Callable] = {  # type: ignore[type-arg]
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "sqrt": mpmath.sqrt,
    "abs": abs,
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "stop": lambda a: a,
    "less": lambda a, b: a < b,
    "less_equal": lambda a, b: a <= b,
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
    "not": lambda a: not a,
    "select": lambda c, a, b: a if c else b,
}


def exact(program: Program, inputs: Mapping[str, object]) -> dict[str, object]:
    """Outputs by the plain meaning of every line."""
    values: list[object] = []
    for node in program.nodes:
        if node.args:
            values.append(EXACT[node.op](*(values[a] for a in node.args)))
        else:
            values.append(mpf(node.constant) if node.op == "constant" else inputs[node.name])
    return {name: values[i] for name, i in program.outputs}


def mixture() -> Program:
    t = Trace()
    a, b, c = (t.parameter(n) for n in "abc")
    x = t.position("x")
    turn = sin(a) * c + cos(b) / (c + 2.0)
    d = x * turn - b
    r = sqrt(d * d + c * c)
    q = (x + a) / r
    chosen = select(q < 0.3, q * r * a, absolute(d) - b * x)
    twice = select((x < 1.0) & ~(d < 0.0), r / c, select(x <= 2.0, c, a) * q)
    return Program.of(t, {"r": r, "q": q, "w": chosen + twice, "d": -d * turn, "k": turn / a, "valid": x < 2.5})


def difference(program: Program, name: str, at: Mapping[str, float], function: Callable) -> float:  # type: ignore[type-arg]
    with mpmath.workdps(60):
        step = mpf(10) ** -20
        both = []
        for sign in (1, -1):
            inputs = {k: mpf(v) for k, v in at.items()}
            inputs[name] += sign * step
            both.append(function(inputs))
        return float((both[0] - both[1]) / (2 * step))


@pytest.mark.parametrize("name", ["a", "b", "c", "x"])
def test_forward_derivatives_equal_differences(name: str) -> None:
    program = mixture()
    derived = forward(program, [name])
    got = NumpyProgram(derived).run([P[n] for n in derived.parameters], {"x": X})
    rows = dict(zip(derived.output_names, got, strict=True))
    for output in ("r", "q", "w", "d", "k"):
        for i, x in enumerate(X):
            at = {**P, "x": float(x)}
            want = difference(program, name, at, lambda v, o=output: exact(program, v)[o])
            assert rows[f"{output}|{name}"][i] == pytest.approx(want, rel=1e-12, abs=1e-13)
    assert "valid|a" not in rows


def objective_exactly(program: Program, terms: list[Term], inputs: Mapping[str, object]) -> object:
    rows = [exact(program, {**inputs, "x": mpf(float(x))}) for x in X]
    rows = [row for row in rows if row["valid"]]
    total = mpf(0)
    for term in terms:
        values = [row[term.output] for row in rows]
        result = sum(values)
        if term.kind == "mean":
            result = result / len(values)
        elif term.kind == "rms":
            result = mpmath.sqrt(sum(v * v for v in values) / len(values))
        elif term.kind != "sum":
            result = max(values) if term.kind == "max" else min(values)
        total += mpf(term.weight) * result
    return total


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize(
    "terms",
    [
        [Term("w")],
        [Term("r", "mean", 2.0), Term("q", "mean")],
        [Term("d", "rms")],
        [Term("d", "rms", 0.5), Term("d", "rms"), Term("w", "max"), Term("w", "max")],
        [Term("w", "max"), Term("d", "min", -2.0)],
        [Term("k", "max"), Term("q", "min"), Term("r", "mean")],
        [Term("k", "sum"), Term("w", "mean", -0.5), Term("q", "rms", 3.0), Term("r", "rms")],
    ],
)
def test_gradients_equal_differences(terms: list[Term], backend: str) -> None:
    program = mixture()
    gradient = gradient_of(program, terms)
    assert gradient.wrt == program.parameters
    designs = {n: np.array([v, v * 0.9, v + 0.1]) for n, v in P.items()}
    values, slopes = gradient.evaluate(table_of(gradient, designs), {"x": X}, backend=backend)  # type: ignore[arg-type]
    for d in range(3):
        at = {n: float(v[d]) for n, v in designs.items()}
        want = objective_exactly(program, terms, {k: mpf(v) for k, v in at.items()})
        assert values[d] == pytest.approx(float(want), rel=1e-12)
        for column, name in every(enumerate(gradient.wrt)):
            slope = difference(program, name, at, lambda v: objective_exactly(program, terms, v))
            assert slopes[d, column] == pytest.approx(slope, rel=1e-11, abs=1e-12)


@pytest.mark.parametrize("backend", BACKENDS)
def test_seeds_weigh_every_position(backend: str) -> None:
    program = mixture()
    gradient = reverse(program, ["q", "w"], ["c", "a"], valid=None)
    rng = np.random.default_rng(1)
    seeds = {"seed:q": rng.normal(size=(2, len(X))), "seed:w": rng.normal(size=(2, len(X)))}
    table = table_of(gradient, {n: np.array([v, v * 1.1]) for n, v in P.items()})
    _, got = gradient.evaluate(table, {"x": X}, seeds, backend=backend)  # type: ignore[arg-type]
    derived = forward(program, ["c", "a"])
    for d in range(2):
        p = [P[n] * (1.0 if d == 0 else 1.1) for n in derived.parameters]
        rows = dict(zip(derived.output_names, NumpyProgram(derived).run(p, {"x": X}), strict=True))
        for column, name in enumerate(("c", "a")):
            want = sum((seeds[f"seed:{o}"][d] * rows[f"{o}|{name}"]).sum() for o in ("q", "w"))
            assert got[d, column] == pytest.approx(want, rel=1e-11)


@pytest.mark.parametrize("backend", BACKENDS)
def test_failed_positions_neither_enter_nor_poison_the_gradient(backend: str) -> None:
    t = Trace()
    a, x = t.parameter("a"), t.position("x")
    square = a * a - x * x
    program = Program.of(t, {"y": sqrt(square), "valid": square > 0.0})
    x_values = np.array([0.0, 0.5, 1.0, 1.5, 3.0])
    gradient = gradient_of(program, [Term("y", "mean")])
    value, slope = gradient.evaluate([[1.0], [0.01]], {"x": x_values}, backend=backend)  # type: ignore[arg-type]
    root = math.sqrt(0.75)
    assert value[0] == pytest.approx((1.0 + root) / 2.0, rel=1e-15)
    assert slope[0, 0] == pytest.approx((1.0 + 1.0 / root) / 2.0, rel=1e-15)
    assert slope[1, 0] == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_branch_not_taken_does_not_poison_the_gradient(backend: str) -> None:
    t = Trace()
    a, x = t.parameter("a"), t.position("x")
    gap = a - x
    root = sqrt(gap)
    safe = select(gap > 0.0, select(x < 0.0, a, a * root / gap * 2.0), 3.0 * a)
    x_values = np.array([-1.0, 0.5, 1.0, 2.0])
    gradient = gradient_of(Program.of(t, {"y": safe}), [Term("y")])
    _, slope = gradient.evaluate([[1.0]], {"x": x_values}, backend=backend)  # type: ignore[arg-type]
    inside = 2.0 / math.sqrt(0.5) - 1.0 / 0.5**1.5
    assert slope[0, 0] == pytest.approx(1.0 + inside + 3.0 + 3.0, rel=1e-14)


def test_stop_cuts_derivatives() -> None:
    t = Trace()
    a, x = t.parameter("a"), t.position("x")
    program = Program.of(t, {"y": stop(a * x) * a + stop(a)})
    derived = forward(program, ["a"])
    got = NumpyProgram(derived).run([3.0], {"x": X})
    np.testing.assert_allclose(got[derived.output_names.index("y|a")], 3.0 * X, rtol=1e-15)
    _, slope = gradient_of(program, [Term("y")]).evaluate([[3.0]], {"x": X})
    assert slope[0, 0] == pytest.approx(3.0 * X.sum(), rel=1e-14)


def test_what_cannot_be_differentiated_is_refused() -> None:
    with pytest.raises(ValueError, match=r"\bz\b"):
        forward(mixture(), ["z"])
    with pytest.raises(ValueError, match="valid"):
        reverse(mixture(), ["valid"])
    with pytest.raises(ValueError, match=r"\bz\b"):
        reverse(mixture(), ["r"], ["z"])


@pytest.mark.parametrize("backend", BACKENDS)
def test_extremes_of_designs_without_a_valid_position_are_not_numbers(backend: str) -> None:
    t = Trace()
    a, b, x = t.parameter("a"), t.parameter("b"), t.position("x")
    square = a * a - x * x
    program = Program.of(t, {"y": sqrt(square), "valid": square > 0.0, "other": b * x})
    gradient = gradient_of(program, [Term("y", "max")])
    table = table_of(gradient, {"a": [1.0, 0.1], "b": 1.0})
    value, slope = gradient.evaluate(table, {"x": np.array([0.5, 0.8])}, backend=backend)  # type: ignore[arg-type]
    assert value[0] == pytest.approx(math.sqrt(0.75), rel=1e-15)
    assert slope[0].tolist() == pytest.approx([1.0 / math.sqrt(0.75), 0.0], rel=1e-15)
    assert np.isnan(value[1])
    assert np.isnan(slope[1]).all()
