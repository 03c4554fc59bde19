"""Cycle programs against closed forms: stages, extremes between positions, kept outputs, validity."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.every import every

from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import cycle_gradient
from linkwright.engine.linear import inverse, product
from linkwright.engine.llvm_backend import available
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.replay import inlined
from linkwright.engine.stage import Stage
from linkwright.engine.summaries import Backend, Run, code_for
from linkwright.engine.tangent import slope
from linkwright.engine.trace import Scalar, Trace, Value, cos, select, sin, sqrt

Floats = NDArray[np.float64]
BACKENDS = ["numpy", pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="no llvmlite"))]
COUNT = 36
INPUT = {"q": np.arange(COUNT) * math.tau / COUNT}


def stroke_of(q: Scalar, r: Scalar, rod: Scalar, e: Scalar) -> tuple[Scalar, Scalar]:
    """Place of the slider of an offset slider crank, and what must not be negative for it to be assembled."""
    square = rod * rod - (r * sin(q) - e) * (r * sin(q) - e)
    return r * cos(q) + sqrt(square), square


def dimensions(t: Trace) -> tuple[Value, Value, Value]:
    return t.parameter("r"), t.parameter("l"), t.parameter("e")


def coarse() -> Stage:
    """Extremes at the positions, and where they are."""
    t = Trace()
    q = t.position("q")
    x, square = stroke_of(q, *dimensions(t))
    program = Program.of(t, {"x": x, "q": q, "valid": square >= 0.0})
    found = {"out.near": Reduction("q", "at_max", "x"), "in.near": Reduction("q", "at_min", "x")}
    return Stage(program, {**found, "x.mean": Reduction("x", "mean")}, complete=True, count="valid.count")


def refined(name: str) -> Stage:
    """Where the slider stands still, by Newton's steps kept within half a step of the positions."""
    t = Trace()
    q, near = t.state("q"), t.parameter(f"{name}.near")
    x, _ = stroke_of(q, *dimensions(t))
    rate = slope(x, {q: 1.0})
    newton = q - rate / slope(rate, {q: 1.0})
    width = math.tau / COUNT
    following = select((near - width < newton) & (newton < near + width), newton, q)
    program = Program.of(t, {"q": q, "x": x, "rate": rate}, {"q": following})
    found = {f"{name}.{output}": Reduction(output, "last") for output in ("q", "x", "rate")}
    return Stage(program, found, steps=7, starts={"q": f"{name}.near"}, roots={"q": "rate"})


def numbers() -> Stage:
    """What is made of both limit positions."""
    t = Trace()
    stroke = t.parameter("out.x") - t.parameter("in.x")
    return Stage(Program.of(t, {"stroke": stroke}), {"stroke": Reduction("stroke", "first")}, steps=1)


def share_above_middle() -> Stage:
    """A second look at the positions, with a number found before: how often the slider is beyond the middle."""
    t = Trace()
    x, _ = stroke_of(t.position("q"), *dimensions(t))
    beyond = x > t.parameter("in.x") + 0.5 * t.parameter("stroke")
    return Stage(Program.of(t, {"beyond": beyond}), {"beyond": Reduction("beyond", "count")})


def whole() -> CycleProgram:
    stages = (coarse(), refined("out"), refined("in"), numbers(), share_above_middle())
    return CycleProgram(stages, ("r", "l", "e"))


def designs(count: int) -> Floats:
    rng = np.random.default_rng(count)
    r = rng.uniform(0.5, 1.5, count)
    return np.stack([r, r * rng.uniform(1.8, 4.0, count), r * rng.uniform(-0.5, 0.5, count)], axis=1)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("count", [1, 8, 19])
def test_limit_positions_and_stroke_equal_their_closed_form(backend: Backend, count: int) -> None:
    """Crank and rod in line: x = sqrt((l ± r)² − e²) at the angles asin(e/(l ± r)) (any book)."""
    table = designs(count)
    got = whole().evaluate(table, INPUT, backend=backend)
    r, rod, e = table.T
    out, back = np.sqrt((rod + r) ** 2 - e**2), np.sqrt((rod - r) ** 2 - e**2)
    np.testing.assert_allclose(got["out.x"], out, rtol=1e-14)
    np.testing.assert_allclose(got["in.x"], back, rtol=1e-14)
    np.testing.assert_allclose(got["stroke"], out - back, rtol=1e-13)
    at = np.mod(got["out.q"] + 1.0, math.tau) - 1.0
    np.testing.assert_allclose(at, np.arcsin(e / (rod + r)), atol=1e-13)
    np.testing.assert_allclose(got["in.q"], math.pi + np.arcsin(e / (rod - r)), atol=1e-13)
    assert np.abs(got["out.rate"]).max() < 1e-13
    x = r[:, None] * np.cos(INPUT["q"]) + np.sqrt(
        rod[:, None] ** 2 - (r[:, None] * np.sin(INPUT["q"]) - e[:, None]) ** 2
    )
    np.testing.assert_allclose(got["x.mean"], x.mean(axis=1), rtol=1e-13)
    np.testing.assert_array_equal(got["beyond"], (x > 0.5 * (out + back)[:, None]).sum(axis=1))
    assert (got["valid.count"] == COUNT).all()


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_design_that_cannot_turn_has_no_results(backend: Backend) -> None:
    table = designs(9)
    table[4, 1] = 0.9 * table[4, 0]
    got = whole().evaluate(table, INPUT, backend=backend)
    want = whole().evaluate(np.delete(table, 4, axis=0), INPUT, backend=backend)
    for name in every(whole().results):
        np.testing.assert_array_equal(np.delete(got[name], 4), want[name])
        assert math.isnan(got[name][4]) or got[name][4] == -1, name
    assert math.isnan(got["stroke"][4])
    assert got["beyond"][4] == -1


@pytest.mark.parametrize("backend", BACKENDS)
def test_outputs_are_kept_as_fields_for_later_stages(backend: Backend) -> None:
    t = Trace()
    s = t.state("s") + t.position("q") * t.parameter("a")
    sums = Stage(Program.of(t, {"sum": s}, {"s": s}), keep=("sum",), starts={"s": 0.5})
    t = Trace()
    twice = t.field_input("sum") * 2.0
    last = Stage(
        Program.of(t, {"twice": twice}), {"end": Reduction("twice", "last"), "top": Reduction("twice", "max")}
    )
    a = np.array([[1.0], [-2.0], [0.25]])
    got = CycleProgram((sums, last)).evaluate(a, INPUT, backend=backend)
    want = 2.0 * (0.5 + np.cumsum(INPUT["q"]) * a)
    np.testing.assert_allclose(got["end"], want[:, -1], rtol=1e-13)
    np.testing.assert_allclose(got["top"], want.max(axis=1), rtol=1e-13)


@pytest.mark.parametrize("backend", BACKENDS)
def test_results_depend_neither_on_threads_nor_on_the_other_designs(backend: Backend) -> None:
    table = designs(2000)
    cycle = whole()
    one = cycle.evaluate(table, INPUT, threads=1, backend=backend)
    two = cycle.evaluate(table, INPUT, threads=3, backend=backend)
    part = cycle.evaluate(table[700:717], INPUT, backend=backend)
    for name, values in one.items():
        np.testing.assert_array_equal(values, two[name])
        np.testing.assert_array_equal(values[700:717], part[name])
    empty = cycle.evaluate(table[:0], INPUT, backend=backend)
    assert all(values.shape == (0,) for values in every(empty.values()))


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_program_over_positions_is_written_again_at_a_number_found_before(backend: Backend) -> None:
    t = Trace()
    x, square = stroke_of(t.position("q"), *dimensions(t))
    along = Program.of(t, {"x": x, "valid": square >= 0.0})
    t = Trace()
    there = inlined(along, t, {"q": t.parameter("out.near") + 0.25, "e": 0.0})
    again = Stage(Program.of(t, {"x": there["x"]}), {"there": Reduction("x", "first")}, steps=1)
    table = designs(9)
    got = CycleProgram((coarse(), again), ("r", "l", "e")).evaluate(table, INPUT, backend=backend)
    want = [
        stroke_of(q + 0.25, r, rod, 0.0)[0] for q, (r, rod, _) in zip(got["out.near"], table, strict=True)
    ]
    np.testing.assert_allclose(got["there"], want, rtol=1e-14)


def objective() -> CycleProgram:
    """Numbers of every kind: over positions, there, between them, behind them, and a formula of all."""
    t = Trace()
    q = t.position("q")
    x, square = stroke_of(q, *dimensions(t))
    share = select(x < t.parameter("in.x") + 0.25 * t.parameter("stroke"), x * x, sin(x))
    program = Program.of(t, {"x": x, "y": share, "q": q, "valid": square >= 0.0})
    found = {
        "mean": Reduction("y", "mean"),
        "rms": Reduction("x", "rms"),
        "largest": Reduction("y", "max"),
        "there": Reduction("x", "at_min", "y"),
        "begin": Reduction("y", "first"),
    }
    t = Trace()
    spread = t.parameter("x.rms") * t.parameter("y.sum") / t.parameter("valid.count") + t.parameter("x.last")
    after = Program.of(t, {"spread": spread * t.parameter("r")})
    last = Stage(program, found, after)
    t = Trace()
    p = t.parameter
    total = p("mean") * p("rms") + p("largest") * p("e") - p("there") * p("begin") + p("spread") * p("out.q")
    total = total + p("stroke") * p("in.q") + p("x.mean")
    formula = Stage(Program.of(t, {"total": total}), {"total": Reduction("total", "first")}, steps=1)
    return CycleProgram((coarse(), refined("out"), refined("in"), numbers(), last, formula), ("r", "l", "e"))


def total_by_hand(r: float, rod: float, e: float) -> float:
    """The same by closed forms and plain sums."""
    x = r * np.cos(INPUT["q"]) + np.sqrt(rod * rod - (r * np.sin(INPUT["q"]) - e) ** 2)
    out, back = math.sqrt((rod + r) ** 2 - e * e), math.sqrt((rod - r) ** 2 - e * e)
    y = np.where(x < back + 0.25 * (out - back), x * x, np.sin(x))
    rms = math.sqrt((x * x).mean())
    spread = r * (rms * y.mean() + x[-1])
    out_at = math.asin(e / (rod + r)) + (math.tau if e < 0.0 and np.argmax(x) > COUNT / 2 else 0.0)
    total = y.mean() * rms + y.max() * e - x[y.argmin()] * y[0] + spread * out_at
    return float(total + (out - back) * (math.pi + math.asin(e / (rod - r))) + x.mean())


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("count", [1, 8, 23])
def test_gradients_pass_through_events_extremes_and_formulas(backend: Backend, count: int) -> None:
    """Against differences of closed forms."""
    table = designs(count)
    gradient = cycle_gradient(objective(), "total", ["e", "r"])
    values, slopes = gradient.evaluate(table, INPUT, backend=backend)
    assert slopes.shape == (count, 2)
    for d, row in enumerate(table):
        assert values[d] == pytest.approx(total_by_hand(*row), rel=1e-12)
        for column, place in enumerate((2, 0)):
            step = np.zeros(3)
            step[place] = 1e-6
            want = (total_by_hand(*(row + step)) - total_by_hand(*(row - step))) / 2e-6
            assert slopes[d, column] == pytest.approx(want, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("backend", BACKENDS)
def test_limit_angles_change_as_their_closed_form_does(backend: Backend) -> None:
    """d asin(e / (l + r)): by e 1/sqrt((l + r)² - e²), by l and r -e/(l + r) times that."""
    table = designs(9)
    table[3, 1] = 0.9 * table[3, 0]
    values, slopes = cycle_gradient(whole(), "out.q").evaluate(table, INPUT, backend=backend)
    r, rod, e = np.delete(table, 3, axis=0).T
    factor = 1.0 / np.sqrt((rod + r) ** 2 - e**2)
    want = np.stack([-e / (rod + r) * factor, -e / (rod + r) * factor, factor], axis=1)
    np.testing.assert_allclose(np.delete(slopes, 3, axis=0), want, rtol=1e-12)
    assert math.isnan(values[3])
    assert np.isnan(slopes[3]).all()


@pytest.mark.parametrize("backend", BACKENDS)
def test_several_unknowns_change_together(backend: Backend) -> None:
    """x + y = a, x y = b by Newton's steps: the roots of z² - a z + b."""
    t = Trace()
    x, y, a, b = t.state("x"), t.state("y"), t.parameter("a"), t.parameter("b")
    one, two = x + y - a, x * y - b
    inverted = inverse([[1.0, 1.0], [y, x]])
    steps = product(inverted, [one, two])
    following = {"x": x - steps[0], "y": y - steps[1]}
    program = Program.of(t, {"one": one, "two": two, "x": following["x"], "ratio": x / y}, following)
    found = {"x": Reduction("x", "last"), "ratio": Reduction("ratio", "last")}
    roots = {"x": "one", "y": "two"}
    stage = Stage(program, found, steps=12, starts={"x": "a", "y": 0.1}, roots=roots)
    cycle = CycleProgram((stage,), ("a", "b"))
    table = np.array([[5.0, 6.0], [4.0, 1.0], [3.0, 2.0]])
    values, slopes = cycle_gradient(cycle, "x").evaluate(table, backend=backend)
    a_, b_ = table.T
    root = np.sqrt(a_ * a_ / 4.0 - b_)
    np.testing.assert_allclose(values, a_ / 2.0 + root, rtol=1e-13)
    np.testing.assert_allclose(slopes, np.stack([0.5 + a_ / (4.0 * root), -0.5 / root], axis=1), rtol=1e-12)
    _, ratios = cycle_gradient(cycle, "ratio", ["b"]).evaluate(table, backend=backend)
    big, small = a_ / 2.0 + root, a_ / 2.0 - root
    np.testing.assert_allclose(ratios[:, 0], -0.5 / root / small - big / small**2 * 0.5 / root, rtol=1e-12)


def test_a_gradient_that_does_not_exist_is_refused() -> None:
    with pytest.raises(ValueError, match="speed"):
        cycle_gradient(whole(), "speed")
    with pytest.raises(ValueError, match="speed"):
        cycle_gradient(whole(), "stroke", ["speed"])
    t = Trace()
    s = t.state("s") + t.parameter("a")
    carried = Stage(
        Program.of(t, {"s": s}, {"s": s}), {"end": Reduction("s", "last")}, starts={"s": 0.0}, steps=3
    )
    with pytest.raises(ValueError, match=r"\bs\b"):
        cycle_gradient(CycleProgram((carried,)), "end")


def test_names_that_do_not_fit_together_are_refused() -> None:
    with pytest.raises(ValueError, match=r"out\.near"):
        CycleProgram((coarse(), coarse()))
    with pytest.raises(ValueError, match=r"out\.near"):
        CycleProgram((refined("out"), coarse()))
    with pytest.raises(ValueError, match=r"\be\b"):
        CycleProgram((coarse(),), ("r", "l"))
    with pytest.raises(ValueError, match="r, l, e"):
        whole().evaluate(np.zeros((3, 2)), INPUT)
    assert CycleProgram((coarse(), refined("in"))).dimensions == ("r", "l", "e")


@pytest.mark.parametrize("backend", BACKENDS)
def test_designs_that_go_in_several_parts_are_put_together(
    backend: Backend, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A few at a time, results and gradients are those of all at once."""
    table, cycle = designs(19), whole()
    wanted = cycle.evaluate(table, INPUT, backend=backend)
    stroke, slopes = cycle_gradient(cycle, "stroke").evaluate(table, INPUT, backend=backend)
    for size in ("_RESULTS", "_KNOWN"):
        monkeypatch.setattr(f"linkwright.engine.cycle.{size}", 8 * COUNT)
    found = cycle.evaluate(table, INPUT, backend=backend)
    for name, column in wanted.items():
        np.testing.assert_array_equal(found[name], column, err_msg=name)
    values, again = cycle_gradient(cycle, "stroke").evaluate(table, INPUT, backend=backend)
    np.testing.assert_array_equal(values, stroke)
    np.testing.assert_array_equal(again, slopes)


def test_inputs_of_two_lengths_and_missing_parameters_are_refused() -> None:
    with pytest.raises(ValueError, match=r"\[3, 36\]"):
        whole().evaluate(designs(2), INPUT, {"other": np.ones((2, 3))}, backend="numpy")
    with pytest.raises(ValueError, match=r"\[\]"):
        whole().evaluate(designs(2), {}, backend="numpy")
    with pytest.raises(ValueError, match="r, l, e"):
        cycle_gradient(whole(), "stroke").evaluate(designs(2)[:, :1], INPUT, backend="numpy")


@pytest.mark.parametrize("blocks", [1, 2, 3])
def test_blocks_of_designs_come_back_as_one_table(blocks: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkwright.engine.cycle._RESULTS", 10 * COUNT)
    t = Trace()
    sums = Stage(Program.of(t, {"y": t.parameter("a") * t.position("q")}), {"y.mean": Reduction("y", "mean")})
    table = np.arange(10.0 * blocks)[:, None]
    found = CycleProgram((sums,)).evaluate(table, INPUT)
    np.testing.assert_allclose(found["y.mean"], table[:, 0] * math.pi * (COUNT - 1) / COUNT, rtol=1e-13)


@pytest.mark.skipif(not available(), reason="no llvmlite")
def test_what_goes_on_from_position_to_position_is_compiled_for_one_design_too() -> None:
    """NumPy takes its positions one by one: some hundred of them last longer than compiling."""
    t = Trace()
    q, last = t.position("q"), t.state("last")
    going_on, plain = Program.of(t, {"turned": q * last}, {"last": q}), Program.of(t, {"square": q * q})
    run = Run({"q": np.arange(2000.0)}, 2000, None, 1, "auto")
    assert code_for(plain, None, run, 1) is None
    assert code_for(going_on, None, run, 1) is not None
