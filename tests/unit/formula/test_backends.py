"""Every way to evaluate a program against direct evaluation with Python floats, on random programs."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.unit.formula.objectives import Term, gradient_of, table_of
from tests.unit.formula.random_programs import PARAMETERS, POSITIONS, Formulas, outputs_of, random_program
from tests.unit.formula.sweeps import sweep

from linkwright.formula import ir_kernel as ir_module
from linkwright.formula import machine_code
from linkwright.formula.llvm_backend import available, compile_program
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.reductions import KINDS, Reduction
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.trace import Trace, select, sqrt

Floats = NDArray[np.float64]
needs_compiler = pytest.mark.skipif(not available(), reason="llvmlite is not installed")


def direct(formulas: Formulas, p: Floats, x: Floats, f: Floats) -> Floats:
    """Outputs (outputs, n) by Python floats, one position after another."""
    columns = []
    for i in range(x.shape[1]):
        inputs = [float(v) for v in (*p, *x[:, i], f[i])]
        values, truths = formulas(inputs, len(PARAMETERS))
        columns.append([float(v) for v in outputs_of(values, truths, inputs).values()])
    return np.array(columns).T


def case(seed: int, n: int, designs: int = 3) -> tuple[Floats, Floats, Floats]:
    rng = np.random.default_rng(1000 + seed)
    return rng.normal(size=(designs, 3)), rng.normal(size=(2, n)), rng.normal(size=(designs, n))


def agree(got: Floats, want: Floats, tolerance: float = 1e-11) -> None:
    np.testing.assert_allclose(got, want, rtol=tolerance, atol=tolerance)


def ordered(program: Program, p: Floats) -> list[float]:
    return [float(p[PARAMETERS.index(name)]) for name in program.parameters]


@pytest.mark.parametrize("seed", range(12))
def test_numpy_and_scalar_agree_with_direct_evaluation(seed: int) -> None:
    program, formulas = random_program(seed)
    p, x, f = case(seed, 5)
    table = np.array([ordered(program, row) for row in p])
    positions = dict(zip(POSITIONS, x, strict=True))
    many = NumpyProgram(program).run_designs(table, positions, {"f": f})
    scalar = ScalarProgram(program)
    for d in range(3):
        want = direct(formulas, p[d], x, f[d])
        agree(NumpyProgram(program).run(table[d], positions, {"f": f[d]}), want)
        agree(many[d], want)
        at = {**positions, "f": f[d]}
        for i in range(5):
            along = [at[name][i] for name in program.positions]
            outputs = scalar.step(table[d].tolist(), along, fields=[at[name][i] for name in program.fields])
            agree(np.array(outputs), want[:, i])


@pytest.fixture(params=["own", "in blocks", "x86-64-v3", "x86-64"])
def vectors(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Code for this machine, the same cut into blocks as for large programs, and for older machines."""
    if request.param == "own" or not available():
        return
    here = machine_code.host()
    if request.param == "in blocks":
        monkeypatch.setattr(ir_module, "LARGE", 60)
        monkeypatch.setattr(ir_module, "_BLOCK", 13)
        apart = dataclasses.replace(here, description=f"{here.description} in blocks")
        monkeypatch.setattr(machine_code, "host", lambda: apart)
        return
    if not here.features or "+avx2" not in here.features:
        pytest.skip("this machine cannot run code for other vector widths")
    features = "+avx,+avx2,+fma" if request.param == "x86-64-v3" else ""
    width = 4 if features else 2
    older = machine_code.Host(request.param, features, width, f"{request.param} {width}")
    monkeypatch.setattr(machine_code, "host", lambda: older)


@needs_compiler
@pytest.mark.usefixtures("vectors")
@pytest.mark.parametrize("n", [*range(1, 18), 100])
def test_compiled_code_agrees_with_direct_evaluation_for_every_length(n: int) -> None:
    program, formulas = random_program(n)
    p, x, f = case(n, n)
    table = np.array([ordered(program, row) for row in p])
    positions = dict(zip(POSITIONS, x, strict=True))
    compiled = compile_program(program)
    assert compiled is not None
    stored = compiled.store(table, positions, {"f": f})
    for d in range(3):
        want = direct(formulas, p[d], x, f[d])
        agree(stored[d], want)
        alone = compiled.store(table[d : d + 1], positions, {"f": f[d : d + 1]})
        np.testing.assert_array_equal(alone[0], stored[d])


@needs_compiler
@pytest.mark.usefixtures("vectors")
def test_not_a_number_stays_where_it_arises() -> None:
    t = Trace()
    x, a = t.position("x"), t.parameter("a")
    root = sqrt(x)
    outputs = {"root": root, "quotient": a / x, "kept": select(x < 0.0, a, root), "beyond": root < 1.0}
    compiled = compile_program(Program.of(t, outputs))
    assert compiled is not None
    got = compiled.store([[2.0]], {"x": np.array([-4.0, 0.0, 0.25, math.inf, math.nan])})[0]
    want = [
        [math.nan, 0.0, 0.5, math.inf, math.nan],
        [-0.5, math.inf, 8.0, 0.0, math.nan],
        [2.0, 0.0, 0.5, math.inf, math.nan],
        [0.0, 1.0, 1.0, 0.0, 0.0],
    ]
    np.testing.assert_array_equal(got, want)


@needs_compiler
@pytest.mark.usefixtures("vectors")
@pytest.mark.parametrize("n", [1, 3, 5, 9, 22])
def test_reductions_of_random_programs_agree_with_numpy(n: int) -> None:
    program, _ = random_program(50 + n)
    p, x, f = case(50 + n, n, designs=9)
    table = np.array([ordered(program, row) for row in p])
    positions = dict(zip(POSITIONS, x, strict=True))
    kinds = [Reduction(output, kind) for output in ("v0", "v3", "design", "low") for kind in KINDS]
    stored = NumpyProgram(program).run_designs(table, positions, {"f": f})
    rows = dict(zip(program.output_names, stored.transpose(1, 0, 2), strict=True))
    got = sweep(program, table, positions, kinds, fields={"f": f}, backend="llvm")
    holds = rows["valid"] == 1.0
    np.testing.assert_array_equal(got["valid.count"], holds.sum(axis=1))
    for d in range(9):
        for output in ("v0", "v3", "design", "low"):
            values = rows[output][d][holds[d]]
            want = {"sum": values.sum(), "count": np.count_nonzero(values), "min": math.nan, "max": math.nan}
            want |= dict.fromkeys(("mean", "rms"), math.nan)
            if len(values):
                want |= {"min": values.min(), "max": values.max(), "mean": values.mean()}
                want["rms"] = np.sqrt((values**2).mean())
            for kind, number in want.items():
                np.testing.assert_allclose(got[f"{output}.{kind}"][d], number, rtol=1e-10, atol=1e-12)
            for kind in ("argmin", "argmax") if len(values) else ():
                at = int(got[f"{output}.{kind}"][d])
                assert holds[d][at]
                np.testing.assert_allclose(rows[output][d][at], want[kind[3:]], rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("backend", ["numpy", pytest.param("llvm", marks=needs_compiler)])
@pytest.mark.parametrize("seed", range(6))
def test_gradients_of_random_programs_equal_differences(seed: int, backend: str) -> None:
    program, formulas = random_program(seed)
    p, x, f = case(seed, 9, designs=2)
    gradient = gradient_of(program, [Term("v0"), Term("v3", "mean")], list(PARAMETERS), valid=None)
    positions = dict(zip(POSITIONS, x, strict=True))
    parameters = dict(zip(PARAMETERS, p.T, strict=True))
    values, slopes = gradient.evaluate(table_of(gradient, parameters), positions, {"f": f}, backend=backend)  # type: ignore[arg-type]

    def objective(d: int, row: Floats) -> float:
        rows = direct(formulas, row, x, f[d])
        return float(rows[0].sum() + rows[3].mean())

    for d in range(2):
        assert values[d] == pytest.approx(objective(d, p[d]), rel=1e-11)
        for column in range(3):
            step = np.zeros(3)
            step[column] = 1e-6
            want = (objective(d, p[d] + step) - objective(d, p[d] - step)) / 2e-6
            assert slopes[d, column] == pytest.approx(want, rel=1e-6, abs=1e-6)


@pytest.mark.usefixtures("vectors")
def test_truths_count_as_one_and_numbers_but_zero_as_true() -> None:
    """In sums, choices and conditions, per position and per design."""
    t = Trace()
    x, a = t.position("x"), t.parameter("a")
    low, rich = x < 0.5, a < 3.0
    outputs = {
        "counted": low * 2.0 + rich - t.negate(rich),
        "chosen": select(x, a, -a),
        "alone": select(a, 1.0, 2.0) + low,
        "both": t.logic("and", x, a),
        "neither": t.negate(t.logic("or", x, a)) + 0.0,
        "total": x,
    }
    program = Program.of(t, outputs)
    row = np.array([-1.0, 0.0, 0.25, 0.5, 2.0, 0.0, -0.0, math.inf, 0.4])
    table, positions = np.array([[2.0], [0.0], [4.0]]), {"x": row}
    want = []
    for (number,) in table:
        below, few, some = row < 0.5, float(number < 3.0), number != 0.0
        want.append(
            [
                2.0 * below + few - (1.0 - few),
                np.where(row != 0.0, number, -number),
                (1.0 if some else 2.0) + below,
                (row != 0.0) & some,
                ~((row != 0.0) | some),
                row,
            ]
        )
    evaluator = NumpyProgram(program)
    np.testing.assert_array_equal(evaluator.run_designs(table, positions), want)
    scalar = ScalarProgram(program)
    for place, number in enumerate(row):
        found = scalar.step([2.0], [number])
        np.testing.assert_array_equal(found, [each[place] for each in want[0]])
    for parameters, found in zip(table, want, strict=True):
        (alone,) = evaluator.run_designs(parameters[None, :], positions)
        np.testing.assert_array_equal(alone, found)
    compiled = compile_program(program) if available() else None
    if compiled is not None:
        np.testing.assert_array_equal(compiled.store(table, positions), want)
