"""Compiled code and gradients for the programs of real mechanisms, against NumPy and differences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.unit.formula.objectives import Term, gradient_of, table_of

import linkwright as lw
from linkwright.formula.llvm_backend import available, compile_program
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program

Floats = NDArray[np.float64]
MODELS = ["jaw_crusher_sixbar", "shaper_quick_return", "dyad_rpp", "triad", "peaucellier", "swing_conveyor"]


@dataclass(frozen=True)
class Used:
    """A program as an analysis has evaluated it."""

    program: Program
    parameters: list[float]
    positions: Mapping[str, Floats]
    fields: Mapping[str, Floats]
    length: int

    def outputs(self, parameters: list[float] | None = None) -> Floats:
        values = self.parameters if parameters is None else parameters
        return NumpyProgram(self.program).run(values, self.positions, self.fields, length=self.length)


@pytest.fixture(scope="module", params=MODELS)
def used(request: pytest.FixtureRequest) -> list[Used]:
    """Every program that finding motion and forces of a mechanism takes."""
    seen: list[Used] = []
    original = NumpyProgram.run

    def recorded(self: NumpyProgram, parameters: Any, positions: Any, *more: Any, **named: Any) -> Floats:
        result = original(self, parameters, positions, *more, **named)
        given = {**(more[0] or {})} if more else {}
        own = {name: given[name] for name in self.program.fields}
        seen.append(Used(self.program, [float(p) for p in parameters], positions, own, result.shape[1]))
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(NumpyProgram, "run", recorded)
        motion = lw.solve_motion(lw.load(f"gallery:{request.param}"), steps=36)
        assert np.isfinite(lw.solve_forces(motion).power_residual).all()
    assert seen
    return seen


@pytest.mark.skipif(not available(), reason="llvmlite is not installed")
def test_compiled_programs_of_mechanisms_agree_with_numpy(used: list[Used]) -> None:
    for case in used:
        compiled = compile_program(case.program)
        assert compiled is not None
        want = case.outputs()
        rows = {name: np.asarray(array)[None, :] for name, array in case.fields.items()}
        got = compiled.store([case.parameters], case.positions, rows, length=case.length)[0]
        np.testing.assert_array_equal(np.isfinite(got), np.isfinite(want))
        largest = np.abs(want[np.isfinite(want)]).max(initial=1.0)
        np.testing.assert_allclose(got, want, rtol=1e-9, atol=1e-11 * largest)


@pytest.mark.parametrize("backend", ["numpy", "llvm"] if available() else ["numpy"])
def test_gradients_of_mechanisms_equal_differences(used: list[Used], backend: str) -> None:
    case = max(used, key=lambda u: len(u.program.nodes))
    size = np.sqrt((case.outputs() ** 2).mean(axis=1))
    name = case.program.output_names[int(np.argmax(np.where(np.isfinite(size), size, 0.0)))]
    row = case.program.output_names.index(name)
    gradient = gradient_of(case.program, [Term(name, "rms")], valid=None)
    fields = {key: np.asarray(array)[None, :] for key, array in case.fields.items()}
    given = dict(zip(case.program.parameters, case.parameters, strict=True))
    value, slopes = gradient.evaluate(table_of(gradient, given), case.positions, fields, backend=backend)  # type: ignore[arg-type]
    assert value[0] == pytest.approx(size[row], rel=1e-9)
    scale = np.abs(slopes[0]).max()
    for column, parameter in enumerate(case.parameters):
        step = 1e-6 * max(1e-3, abs(parameter))
        both = []
        for sign in (1.0, -1.0):
            moved = list(case.parameters)
            moved[column] += sign * step
            both.append(np.sqrt((case.outputs(moved)[row] ** 2).mean()))
        want = (both[0] - both[1]) / (2.0 * step)
        assert slopes[0, column] == pytest.approx(want, rel=1e-4, abs=1e-5 * scale)
