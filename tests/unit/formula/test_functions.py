"""Functions and look-ups on every back end and their derivatives, against mpmath and SciPy."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator
from tests.unit.formula.objectives import Term, gradient_of, table_of
from tests.unit.formula.sweeps import sweep

from linkwright.formula import trace as tr
from linkwright.formula.differentiation import slope
from linkwright.formula.gradient import Gradient, forward
from linkwright.formula.llvm_backend import available, compile_program
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.table import Table

Floats = NDArray[np.float64]
needs_compiler = pytest.mark.skipif(not available(), reason="llvmlite is not installed")
BACKENDS = ["scalar", "numpy", pytest.param("llvm", marks=needs_compiler)]

#: name: (traced function, mpmath's, arguments in its range)
CASES: dict[str, tuple[Callable[..., Any], Callable[..., Any], list[Floats]]] = {
    "sqrt": (tr.sqrt, mpmath.sqrt, [np.array([0.03, 0.7, 4.0, 1e9])]),
    "sin": (tr.sin, mpmath.sin, [np.array([-40.0, -1.3, 0.2, 3.0])]),
    "cos": (tr.cos, mpmath.cos, [np.array([-40.0, -1.3, 0.2, 3.0])]),
    "tan": (tr.tan, mpmath.tan, [np.array([-40.0, -1.3, 0.2, 3.0])]),
    "asin": (tr.asin, mpmath.asin, [np.array([-0.99, -0.3, 0.2, 0.97])]),
    "acos": (tr.acos, mpmath.acos, [np.array([-0.99, -0.3, 0.2, 0.97])]),
    "atan": (tr.atan, mpmath.atan, [np.array([-50.0, -0.3, 0.2, 3.0])]),
    "exp": (tr.exp, mpmath.exp, [np.array([-700.0, -0.3, 0.2, 30.0])]),
    "log": (tr.log, mpmath.log, [np.array([1e-3, 0.3, 1.5, 3e7])]),
    "power": (tr.power, mpmath.power, [np.array([0.3, 2.0, 9.5, 1.01]), np.array([-2.5, 0.3, 3.0, 300.0])]),
    "angle": (tr.angle, mpmath.atan2, [np.array([0.3, -2.0, 9.5, -1e-3]), np.array([-2.5, -0.3, 3.0, 300.0])]),
}


def evaluate(program: Program, backend: str, p: list[float], x: dict[str, Floats], **more: Any) -> Floats:
    if backend == "numpy":
        return NumpyProgram(program).run(p, x, **more)
    if backend == "llvm":
        compiled = compile_program(program)
        assert compiled is not None
        stored: Floats = compiled.store([p], x, **more)[0]
        return stored
    scalar = ScalarProgram(program, more.get("tables"))
    rows = zip(*(x[name] for name in program.positions), strict=True)
    return np.array([scalar.step(p, [float(v) for v in row]) for row in rows]).T


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("level", ["position", "design"])
@pytest.mark.parametrize("name", CASES)
def test_functions_equal_their_definition(name: str, level: str, backend: str) -> None:
    traced, exact, arguments = CASES[name]
    names = [f"x{k}" for k in range(len(arguments))]
    for place in range(len(arguments[0])):
        numbers = [float(a[place]) for a in arguments]
        t = tr.Trace()
        x = {"i": np.zeros(5)} | {n: np.full(5, v) for n, v in zip(names, numbers, strict=True)}
        given = [t.position(n) if level == "position" else t.parameter(n) for n in names]
        program = Program.of(t, {"y": traced(*given), "i": t.position("i")})
        p = numbers if level == "design" else []
        got = evaluate(program, backend, p, x)[0]
        assert got == pytest.approx(float(exact(*numbers)), rel=4e-15)
        assert traced(*numbers) == pytest.approx(float(exact(*numbers)), rel=4e-15)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", CASES)
def test_derivatives_of_functions_equal_those_of_mpmath(name: str, backend: str) -> None:
    traced, exact, arguments = CASES[name]
    names = [f"x{k}" for k in range(len(arguments))]
    t = tr.Trace()
    program = forward(Program.of(t, {"y": traced(*[t.position(n) for n in names])}), names)
    got = evaluate(program, backend, [], dict(zip(names, arguments, strict=True)))
    with mpmath.workdps(40):
        for place in range(len(arguments[0])):
            numbers = [mpmath.mpf(float(a[place])) for a in arguments]
            for k, row in enumerate(got[1:]):
                orders = tuple(int(k == j) for j in range(len(numbers)))
                want = float(mpmath.diff(exact, tuple(numbers), orders))
                assert row[place] == pytest.approx(want, rel=1e-13)


@pytest.mark.parametrize("name", CASES)
def test_gradients_through_functions_equal_those_of_mpmath(name: str) -> None:
    traced, exact, arguments = CASES[name]
    names = [f"x{k}" for k in range(len(arguments))]
    t = tr.Trace()
    y = traced(*[t.parameter(n) for n in names]) * t.position("w")
    gradient = gradient_of(Program.of(t, {"y": y}), [Term("y")], names)
    weights = np.array([0.5, -2.0, 3.25])
    table = table_of(gradient, dict(zip(names, arguments, strict=True)))
    values, slopes = gradient.evaluate(table, {"w": weights})
    with mpmath.workdps(40):
        for d in range(len(arguments[0])):
            numbers = [mpmath.mpf(float(a[d])) for a in arguments]
            assert values[d] == pytest.approx(float(exact(*numbers)) * weights.sum(), rel=1e-13)
            for k in range(len(numbers)):
                orders = tuple(int(k == j) for j in range(len(numbers)))
                want = float(mpmath.diff(exact, tuple(numbers), orders)) * weights.sum()
                assert slopes[d, k] == pytest.approx(want, rel=1e-13)


@pytest.mark.parametrize("backend", BACKENDS)
def test_whole_and_half_powers_are_products_and_roots(backend: str) -> None:
    t = tr.Trace()
    x = t.position("x")
    whole = {str(b): tr.power(x, float(b)) for b in range(-8, 9)}
    program = Program.of(t, {**whole, "half": tr.power(x, 0.5), "x": x})
    assert "pow" not in program.counts()["position"]
    at = np.array([0.25, -1.5, 3.0])
    got = dict(zip(program.output_names, evaluate(program, backend, [], {"x": at}), strict=True))
    for b in range(-8, 9):
        np.testing.assert_allclose(got[str(b)], at ** float(b), rtol=4e-15)
    assert got["half"][0] == 0.5
    assert math.isnan(got["half"][1])


@pytest.mark.parametrize("backend", BACKENDS)
def test_outside_its_range_a_function_gives_no_number(backend: str) -> None:
    t = tr.Trace()
    x, zero = t.position("x"), t.position("zero")
    outputs: dict[str, Any] = {
        "log": tr.log(x),
        "asin": tr.asin(x),
        "acos": tr.acos(x),
        "pow": tr.power(x, 0.4),
        "exp": tr.exp(x * 1e3),
        "inverse": tr.power(zero, x),
        "sin": tr.sin(x / zero),
    }
    got = evaluate(Program.of(t, outputs), backend, [], {"x": np.array([-2.0, 2.0, math.nan]), "zero": np.zeros(3)})
    nan = math.nan
    want = [
        [nan, math.log(2.0), nan],
        [nan, nan, nan],
        [nan, nan, nan],
        [nan, 2.0**0.4, nan],
        [0.0, math.inf, nan],
        [math.inf, 0.0, nan],
        [nan, nan, nan],
    ]
    np.testing.assert_allclose(got, want, rtol=4e-15)


@pytest.mark.parametrize("backend", BACKENDS)
def test_floor_sign_and_turns_are_exact(backend: str) -> None:
    t = tr.Trace()
    x = t.position("x")
    outputs = {"floor": tr.floor(x), "sign": tr.sign(x), "near": tr.nearest_turn(0.5, x)}
    at = np.array([-7.5, -1.0, -0.0, 0.5, 2.0, 10.0, math.nan])
    got = evaluate(Program.of(t, outputs), backend, [], {"x": at})
    np.testing.assert_array_equal(got[0], [-8.0, -1.0, 0.0, 0.0, 2.0, 10.0, math.nan])
    np.testing.assert_array_equal(got[1], [-1.0, -1.0, 0.0, 1.0, 1.0, 1.0, math.nan])
    turns = [-1.0, 0.0, 0.0, 0.0, 0.0, 2.0, math.nan]
    np.testing.assert_allclose(got[2], 0.5 + math.tau * np.array(turns), rtol=1e-15)
    slopes = evaluate(forward(Program.of(t, outputs), ["x"]), backend, [], {"x": at[:-1]})
    np.testing.assert_array_equal(slopes[3:], np.zeros((3, 6)))


def looked_up(order: int = 0) -> Program:
    t = tr.Trace()
    x = t.position("x")
    return Program.of(t, {"y": tr.lookup("law", x, order), "z": t.lookup("other", x, order) * x})


def curve(count: int, seed: int = 0) -> tuple[Floats, Floats]:
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(0.2, 1.0, count)), rng.normal(size=count)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("count", [2, 3, 4, 5, 17, 100])
def test_look_ups_of_splines_equal_scipy(count: int, backend: str) -> None:
    xs, ys = curve(count)
    want, pchip = CubicSpline(xs, ys), PchipInterpolator(xs, ys)
    tables = {"law": Table.spline(xs, ys), "other": Table(xs, pchip.c[::-1].T)}
    at = np.concatenate([np.linspace(xs[0] - 0.5, xs[-1] + 0.5, 61), xs])
    for order in range(4):
        got = evaluate(looked_up(order), backend, [], {"x": at}, tables=tables)
        np.testing.assert_allclose(got[0], want(at, order), rtol=1e-9, atol=1e-8)
        np.testing.assert_allclose(got[1], pchip(at, order) * at, rtol=1e-11, atol=1e-10)


@pytest.mark.parametrize("backend", BACKENDS)
def test_periodic_tables_equal_scipy_and_rise(backend: str) -> None:
    xs, ys = curve(9, 3)
    closed = np.append(ys[:-1], ys[0])
    periodic = CubicSpline(xs, closed, bc_type="periodic")
    rising = closed + 0.7 * (xs - xs[0])
    tables = {"law": Table.spline(xs, ys), "other": Table.spline(xs, rising, periodic=True)}
    at = np.linspace(xs[0] - 9.0, xs[-1] + 13.0, 101)
    for order in range(3):
        got = evaluate(looked_up(order), backend, [], {"x": at}, tables=tables)
        line = [0.7 * (at - xs[0]), 0.7, 0.0][order]
        np.testing.assert_allclose(got[1] / at, periodic(at, order) + line, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("backend", BACKENDS)
def test_straight_tables_stay_level_beyond_their_ends_and_break_where_they_say(backend: str) -> None:
    table = Table.linear([0.0, 1.0, 3.0], [2.0, 4.0, 3.0])
    steps = Table(np.array([0.0, 1.0, 2.0]), np.array([[5.0, 0, 0, 0], [7.0, 0, 0, 0]]), periodic=True)
    at = np.array([-100.0, -1.0, 0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 100.0, math.nan])
    got = evaluate(looked_up(), backend, [], {"x": at}, tables={"law": table, "other": steps})
    np.testing.assert_array_equal(got[0], [2.0, 2.0, 2.0, 3.0, 4.0, 3.5, 3.0, 3.0, 3.0, math.nan])
    np.testing.assert_array_equal(got[1][:-1] / np.where(at == 0, 1, at)[:-1], [5, 7, 0, 5, 7, 5, 7, 5, 5])


@pytest.mark.parametrize("backend", BACKENDS)
def test_look_ups_of_a_design_and_of_a_field(backend: str) -> None:
    xs, ys = curve(12, 9)
    spline, table = CubicSpline(xs, ys), Table.spline(xs, ys)
    t = tr.Trace()
    a, f = t.parameter("a"), t.field_input("f")
    program = Program.of(t, {"alone": t.lookup("law", a) + 0.0 * f, "both": t.lookup("law", a + f * 0.1)})
    numbers = np.linspace(xs[1], xs[-2], 11)
    fields = np.random.default_rng(12).uniform(-1.0, 1.0, (11, 5))
    want = spline(numbers[:, None] + fields * 0.1)
    if backend == "scalar":
        scalar = ScalarProgram(program, {"law": table})
        for d, number in enumerate(numbers):
            outputs = scalar.step([float(number)], [], [float(fields[d, 0])])
            assert outputs == pytest.approx([float(spline(number)), want[d, 0]], rel=1e-12)
        return
    got = sweep(
        program,
        numbers[:, None],
        {},
        [("alone", "mean"), ("both", "max"), ("both", "sum")],
        fields={"f": fields},
        tables={"law": table},
        backend=backend,  # type: ignore[arg-type]
    )
    np.testing.assert_allclose(got["alone.mean"], spline(numbers), rtol=1e-12)
    np.testing.assert_allclose(got["both.max"], want.max(axis=1), rtol=1e-12)
    np.testing.assert_allclose(got["both.sum"], want.sum(axis=1), rtol=1e-12)


@pytest.mark.parametrize("backend", ["numpy", pytest.param("llvm", marks=needs_compiler)])
def test_gradients_through_look_ups_are_those_of_the_spline(backend: str) -> None:
    xs, ys = curve(12, 4)
    spline, tables = CubicSpline(xs, ys), {"law": Table.spline(xs, ys), "other": Table.spline(xs, ys)}
    t = tr.Trace()
    y = t.lookup("law", t.parameter("a") + t.position("x")) * t.parameter("b")
    gradient = Gradient(Program.of(t, {"y": y}), Reduction("y", "sum"))
    at, table = np.linspace(0.0, 1.0, 9), np.array([[xs[2], 2.0], [xs[4], -1.0], [xs[5], 0.5]])
    values, slopes = gradient.evaluate(table, {"x": at}, tables=tables, backend=backend)  # type: ignore[arg-type]
    places = table[:, :1] + at
    np.testing.assert_allclose(values, spline(places).sum(axis=1) * table[:, 1], rtol=1e-11)
    np.testing.assert_allclose(slopes[:, 0], spline(places, 1).sum(axis=1) * table[:, 1], rtol=1e-11)
    np.testing.assert_allclose(slopes[:, 1], spline(places).sum(axis=1), rtol=1e-11)


@needs_compiler
def test_look_ups_have_equal_bits_on_all_back_ends() -> None:
    xs, ys = curve(23, 7)
    tables = {"law": Table.spline(xs, ys), "other": Table.spline(xs, ys, periodic=True)}
    at = np.random.default_rng(1).uniform(xs[0] - 30.0, xs[-1] + 30.0, 1000)
    for order in range(4):
        one, two, three = (
            evaluate(looked_up(order), backend, [], {"x": at}, tables=tables)
            for backend in ("scalar", "numpy", "llvm")
        )
        np.testing.assert_array_equal(one[0], two[0])
        np.testing.assert_array_equal(one[0], three[0])


@pytest.mark.parametrize("backend", ["numpy", pytest.param("llvm", marks=needs_compiler)])
def test_tables_enter_sweeps_and_gradients_by_name(backend: str) -> None:
    xs, ys = curve(12, 5)
    spline = CubicSpline(xs, ys)
    t = tr.Trace()
    a, x = t.parameter("a"), t.position("x")
    program = Program.of(t, {"y": t.lookup("law", a * x)})
    tables = {"law": Table.spline(xs, ys)}
    at, factors = np.linspace(xs[0], xs[-1], 37), np.linspace(0.5, 1.0, 11)
    got = sweep(program, factors[:, None], {"x": at}, [("y", "sum")], tables=tables, backend=backend)
    want = spline(factors[:, None] * at).sum(axis=1)
    np.testing.assert_allclose(got["y.sum"], want, rtol=1e-11)
    slopes = sweep(
        forward(program, ["a"]), factors[:, None], {"x": at}, [("y|a", "sum")], tables=tables, backend=backend
    )
    np.testing.assert_allclose(slopes["y|a.sum"], (spline(factors[:, None] * at, 1) * at).sum(axis=1), rtol=1e-11)


def test_the_program_does_not_depend_on_the_numbers_of_a_table() -> None:
    program = looked_up()
    assert program.tables == ("law", "other")
    assert "lookup[law, 0](v0)" in program.text()
    with pytest.raises(ValueError, match="other"):
        NumpyProgram(program).run([], {"x": np.zeros(3)}, tables={"law": Table.linear([0, 1], [0, 1])})
    with pytest.raises(ValueError):  # noqa: PT011
        Table(np.array([0.0, 0.0]), np.zeros((1, 4)))
    with pytest.raises(ValueError):  # noqa: PT011
        Table(np.array([0.0, 1.0]), np.zeros((2, 4)))


def test_a_slope_in_the_trace_is_a_value_like_others() -> None:
    t = tr.Trace()
    x, a, s = t.position("x"), t.parameter("a"), t.field_input("s")
    y = tr.exp(a * x) * tr.sin(x) + s * x
    first = slope(y, {x: 1.0})
    second = slope(first, {x: 1.0})
    along = slope(y, {x: 2.0, s: a})
    mixed = slope(first, {s: 1.0})
    assert slope(y, {t.field_input("f"): 1.0}) == 0.0
    assert mixed == 1.0
    program = Program.of(t, {"first": first, "second": second, "along": along})
    at = np.linspace(-1.0, 1.0, 7)
    got = NumpyProgram(program).run([0.7], {"x": at}, {"s": np.full(7, 0.3)})
    for place, number in enumerate(at):

        def f(v: Any) -> Any:
            return mpmath.exp(0.7 * v) * mpmath.sin(v) + 0.3 * v

        with mpmath.workdps(30):
            one, two = float(mpmath.diff(f, number)), float(mpmath.diff(f, number, 2))
        np.testing.assert_allclose(got[:, place], [one, two, 2.0 * one + 0.7 * number], rtol=1e-13, atol=1e-13)
    with pytest.raises(ValueError):  # noqa: PT011
        slope(y, {tr.Trace().position("x"): 1.0})


@pytest.mark.long
@needs_compiler
@pytest.mark.parametrize("name", ["sin", "cos", "atan", "angle"])
def test_functions_in_all_lanes_are_exact_to_two_units_in_the_last_place(name: str) -> None:
    """Against mpmath, near multiples of a quarter turn and of the ratios where the formula changes, far away too."""
    traced, exact, arguments = CASES[name]
    random = np.random.default_rng(1)
    quarters = np.arange(-40, 40) * (np.pi / 2) * (1.0 + 1e-15 * random.normal(size=80))
    ratios = np.repeat([0.0, 0.4375, 0.6875, 1.1875, 2.4375], 4) + 1e-9 * random.normal(size=20)
    x = np.concatenate([quarters, ratios, -ratios, random.uniform(-9e4, 9e4, 60), [1e-300, 1e7, -1e22]])
    given = [x, random.normal(size=len(x)) * 10.0 ** random.uniform(-3, 3, len(x))][: len(arguments)]
    names = [f"x{k}" for k in range(len(given))]
    t = tr.Trace()
    program = Program.of(t, {"y": traced(*[t.position(n) for n in names])})
    got = evaluate(program, "llvm", [], dict(zip(names, given, strict=True)))[0]
    with mpmath.workdps(60):
        for value, *numbers in zip(got, *given, strict=True):
            want = exact(*[mpmath.mpf(float(number)) for number in numbers])
            assert abs(mpmath.mpf(float(value)) - want) <= 2 * np.spacing(abs(float(want))), numbers
    at_zero = {"sin": [0.0, -0.0], "cos": [1.0, 1.0], "atan": [0.0, -0.0], "angle": [0.0, -0.0]}[name]
    zeros = {n: np.array([0.0, -0.0] if n == "x0" else [1.0, 1.0]) for n in names}
    found = evaluate(program, "llvm", [], zeros)[0]
    assert (found == at_zero).all() and (np.signbit(found) == np.signbit(at_zero)).all()
