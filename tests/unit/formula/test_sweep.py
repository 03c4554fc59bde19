"""Reductions over positions: against plain loops, on every back end, with failed positions and ties."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.unit.formula.sweeps import sweep

from linkwright.formula.llvm_backend import available, compile_program
from linkwright.formula.program import Program
from linkwright.formula.reductions import KINDS, VALID_COUNT, Kind, Reduction
from linkwright.formula.replay import along_input
from linkwright.formula.table import Table
from linkwright.formula.trace import Trace, exp, select, sqrt

BACKENDS = ["numpy", pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="no llvmlite"))]
EVERY = [Reduction("y", kind) for kind in KINDS] + [Reduction("high", "count"), Reduction("z", "max")]
ENDS: tuple[Kind, ...] = ("argmax", "argmin")
Floats = NDArray[np.float64]


def chord() -> Program:
    """Half a chord's length of a circle of radius a at the distance x; fails outside the circle."""
    t = Trace()
    x, a = t.position("x"), t.parameter("a")
    square = a * a - x * x
    y = sqrt(square)
    return Program.of(t, {"y": y, "z": 1.0 / y, "valid": square >= 0.0, "high": y > 0.5, "unused": y * 3.0})


def by_hand(a: float, x: Floats) -> dict[str, float]:
    values = [(i, math.sqrt(a * a - v * v)) for i, v in enumerate(x) if v * v <= a * a]
    count = len(values)
    if not count:
        missing = ("y.min", "y.max", "y.mean", "y.rms", "z.max")
        nothing = dict.fromkeys(missing, math.nan)
        counts = {"y.sum": 0.0, "y.count": 0, "high.count": 0, VALID_COUNT: 0}
        return {**nothing, **counts, "y.argmin": -1, "y.argmax": -1}
    ys = [y for _, y in values]
    total = math.fsum(ys)
    return {
        "y.min": min(ys),
        "y.max": max(ys),
        "y.mean": total / count,
        "y.sum": total,
        "y.rms": math.sqrt(math.fsum(y * y for y in ys) / count),
        "y.argmin": next(i for i, y in values if y == min(ys)),
        "y.argmax": next(i for i, y in values if y == max(ys)),
        "y.count": sum(y != 0.0 for y in ys),
        "high.count": sum(y > 0.5 for y in ys),
        "z.max": max(1.0 / y for y in ys),
        VALID_COUNT: count,
    }


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("n", [*range(1, 18), 40, 361])
def test_reductions_equal_plain_loops(backend: str, n: int) -> None:
    x = np.random.default_rng(n).uniform(-2.0, 2.0, n)
    radii = np.array([0.01, 0.3, 0.9, 1.5, 2.5])
    got = sweep(chord(), radii[:, None], {"x": x}, EVERY, backend=backend)
    for d, a in enumerate(radii):
        for name, want in by_hand(a, x).items():
            np.testing.assert_allclose(got[name][d], want, rtol=1e-12, err_msg=f"{name} a={a}")


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_first_of_equal_extremes_counts(backend: str) -> None:
    t = Trace()
    program = Program.of(t, {"y": t.position("x") * t.parameter("a")})
    x = np.zeros(37)
    x[[9, 12, 30]] = 5.0
    x[[11, 34]] = -5.0
    got = sweep(program, [[1.0], [-1.0]], {"x": x}, [("y", "argmax"), ("y", "argmin")], backend=backend)
    assert got["y.argmax"].tolist() == [9, 11]
    assert got["y.argmin"].tolist() == [11, 9]
    assert got[VALID_COUNT].tolist() == [37, 37]


@pytest.mark.parametrize("backend", BACKENDS)
def test_without_validity_extremes_skip_nan_and_sums_pass_it_on(backend: str) -> None:
    x = np.array([0.0, 0.5, 3.0, 0.25, 0.0])
    got = sweep(chord(), [[1.0]], {"x": x}, EVERY[:8], valid=None, backend=backend)
    assert got["y.max"][0] == 1.0
    assert got["y.argmax"][0] == 0
    assert math.isnan(got["y.sum"][0])
    assert math.isnan(got["y.rms"][0])


@pytest.mark.parametrize("backend", BACKENDS)
def test_results_do_not_depend_on_threads_or_chunks(backend: str) -> None:
    rng = np.random.default_rng(5)
    radii = rng.uniform(0.1, 3.0, (3000, 1))
    x = rng.uniform(-2.0, 2.0, 361)
    one = sweep(chord(), radii, {"x": x}, EVERY, backend=backend, threads=1)
    several = sweep(chord(), radii, {"x": x}, EVERY, backend=backend, threads=3)
    part = sweep(chord(), radii[1000:1013], {"x": x}, EVERY, backend=backend)
    for name, values in one.items():
        np.testing.assert_array_equal(values, several[name])
        np.testing.assert_array_equal(values[1000:1013], part[name])


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("n", [1, 5, 8, 13, 16, 40])
def test_extremes_are_found_beside_what_is_no_number_and_does_not_count(backend: str, n: int) -> None:
    t = Trace()
    x, y, a = t.position("x"), t.position("y"), t.parameter("a")
    outputs = {"x": x * a, "y": y, "valid": y < 1.0}
    kinds = [Reduction(name, kind) for name in "xy" for kind in ENDS]
    rng = np.random.default_rng(n)
    xs, ys = rng.integers(-3, 4, n).astype(float), rng.normal(size=n)
    ys[rng.integers(0, n)] = math.nan
    factors = np.array([1.0, -2.0, 0.25])
    got = sweep(Program.of(t, outputs), factors[:, None], {"x": xs, "y": ys}, kinds, backend=backend)
    for d, factor in enumerate(factors):
        rows = {"x": xs * factor, "y": ys}
        for kind in kinds:
            best, want = None, -1
            for i in np.flatnonzero(ys < 1.0):
                number = rows[kind.output][i] * (1.0 if kind.kind == "argmax" else -1.0)
                if best is None or number > best:
                    best, want = number, int(i)
            assert got[kind.name][d] == want, kind.name


def test_what_does_not_exist_is_refused() -> None:
    x = {"x": np.zeros(3)}
    with pytest.raises(ValueError, match="'w'"):
        sweep(chord(), [[1.0]], x, [("w", "max")])
    with pytest.raises(ValueError, match="median"):
        sweep(chord(), [[1.0]], x, [("y", "median")])  # type: ignore[list-item]
    with pytest.raises(ValueError, match="gpu"):
        sweep(chord(), [[1.0]], x, [("y", "max")], backend="gpu")  # type: ignore[arg-type]


def test_machine_code_is_asked_for_where_it_cannot_be_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Left to itself a sweep is made by NumPy."""
    monkeypatch.setattr("linkwright.formula.llvm_backend.available", lambda: False)
    designs, x = np.array([[1.0], [2.0]]), {"x": np.linspace(0.0, 1.0, 20_001)}
    with pytest.raises(ValueError, match="llvmlite"):
        sweep(chord(), designs, x, [("y", "max")], backend="llvm")
    assert sweep(chord(), designs, x, [("y", "max")])["y.max"].tolist() == [1.0, 2.0]


@pytest.mark.skipif(not available(), reason="no llvmlite")
def test_a_program_compiled_for_storing_does_not_sweep() -> None:
    compiled = compile_program(chord())
    assert compiled is not None
    with pytest.raises(ValueError):  # noqa: PT011
        compiled.sweep([[1.0]], {"x": np.zeros(3)})


@pytest.mark.parametrize("backend", BACKENDS)
def test_functions_of_the_positions_alone_are_found_once_for_all_designs(backend: str) -> None:
    t = Trace()
    x, a, b = t.position("x"), t.parameter("a"), t.parameter("b")
    load = exp(x * 0.5) + t.lookup("law", x)
    late = select(exp(x) < 2.0, load, a)
    program = Program.of(t, {"y": load * b + a, "late": late, "load": load, "valid": x < 0.9})
    parted = along_input(program)
    assert parted is not None
    alone, rest = parted
    assert not alone.parameters
    assert rest.parameters == program.parameters
    assert not {"exp", "lookup"} & set(rest.counts()["position"])
    assert along_input(rest) is None
    table = Table.linear([-1.0, 0.0, 1.0], [3.0, 1.0, 2.0])
    xs, numbers = np.linspace(-1.0, 1.0, 21), np.random.default_rng(1).normal(size=(6, 2))
    kinds = [Reduction(name, kind) for name in ("y", "late", "load") for kind in ("sum", "max", "argmin")]
    got = sweep(program, numbers, {"x": xs}, kinds, tables={"law": table}, backend=backend)
    held = xs < 0.9
    there = np.exp(xs * 0.5) + np.interp(xs, [-1.0, 0.0, 1.0], [3.0, 1.0, 2.0])
    columns = dict(zip(program.parameters, numbers.T, strict=True))
    for d in range(6):
        one, two = columns["a"][d], columns["b"][d]
        rows = {"y": there * two + one, "late": np.where(np.exp(xs) < 2.0, there, one), "load": there}
        for name, row in rows.items():
            assert got[f"{name}.sum"][d] == pytest.approx(row[held].sum(), rel=1e-12)
            assert got[f"{name}.max"][d] == pytest.approx(row[held].max(), rel=1e-14)
            assert row[got[f"{name}.argmin"][d]] == pytest.approx(row[held].min(), rel=1e-14)


@pytest.mark.parametrize("backend", BACKENDS)
def test_fields_of_another_number_of_designs_are_refused(backend: str) -> None:
    t = Trace()
    x, gain, g = t.position("x"), t.parameter("a"), t.field_input("g")
    program = Program.of(t, {"y": x * gain + g})
    xs, gains = np.linspace(0.0, 1.0, 4), np.ones((3, 1))
    given = {"fields": {"g": np.ones((2, 4))}, "backend": backend}
    with pytest.raises(ValueError, match="3"):
        sweep(program, gains, {"x": xs}, [Reduction("y", "max")], **given)
