"""WebAssembly evaluated by Node, against NumPy: gallery files, functions, look-ups."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.unit.formula.node import in_node, needs_node, work

import linkwright as lw
from linkwright.errors import RequestError
from linkwright.formula import wasm
from linkwright.formula.differentiation import slope
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.table import Table
from linkwright.formula.trace import Trace, angle, cos, exp, floor, log, power, select, sin
from linkwright.formula.wasm import wasm_module
from linkwright.gallery import names
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.solver import ForceSolver

pytestmark = needs_node
CLOSE = 1e-12


def family(name: str) -> str:
    """Outputs that round-off is measured against together: forces, couples and efforts come from each other."""
    kind = name.partition(":")[0]
    return "force" if kind in ("r", "c", "effort") else name


def agree(got: Mapping[str, Any], want: Mapping[str, Any], what: str) -> None:
    """To 1e-12 of the largest value of the family."""
    largest: dict[str, float] = {}
    for name, row in want.items():
        size = float(np.nanmax(np.abs(np.asarray(row, dtype=float)), initial=0.0))
        largest[family(name)] = max(largest.get(family(name), 0.0), size)
    for name, row in want.items():
        found = np.array(got[name], dtype=float)
        exact = np.asarray(row, dtype=float)
        scale = largest[family(name)] or 1.0
        np.testing.assert_allclose(found / scale, exact / scale, rtol=0, atol=CLOSE, err_msg=f"{what}: {name}")


def gallery_work(name: str) -> tuple[dict[str, Any], dict[str, Any]] | None:
    """All motion and force outputs of a gallery file, and what NumPy says of them."""
    mechanism = lw.load(f"gallery:{name}")
    if not mechanism.drivers:
        return None
    motion = lw.solve_motion(mechanism, steps=24, failures="mark")
    solver = ForceSolver(motion.solver)
    forces = run_forces(motion, False, solver)
    names = tuple(motion.solver.outputs.standard[:-1]) + solver.outputs.standard
    program = solver.program(names).program
    fields = {**forces.fields, **motion.states}
    values = {each: motion.design.parameters[each] for each in program.parameters}
    positions = {**motion.positions.arrays, **motion.modes}
    own = {each: positions[each] for each in program.positions}
    rows = {each: fields[each] for each in program.fields}
    want = NumpyProgram(program).run(list(values.values()), own, rows, length=motion.steps)
    return work(program, values, own, motion.steps, fields=rows), dict(zip(names, want, strict=True))


@pytest.mark.rotating
def test_every_gallery_file_gives_the_numbers_of_numpy(tmp_path: Path) -> None:
    found = {name: made for name in names() if (made := gallery_work(name)) is not None}
    assert len(found) > 30
    results = in_node([made for made, _ in found.values()], tmp_path)
    for (name, (_, want)), got in zip(found.items(), results, strict=True):
        agree(got, want, name)


def test_functions_and_look_ups(tmp_path: Path) -> None:
    """Every function, a periodic spline with two derivatives, truths that count, and a field."""
    t = Trace()
    x, a, s = t.position("x"), t.parameter("a"), t.field_input("s")
    total = s + x * a
    low, high = x < a, t.logic("or", x <= -2.0, x > 8.0)
    outputs = {
        "sin": sin(x),
        "cos": cos(x),
        "exp": exp(x),
        "log": log(x * x + 1.0),
        "power": power(x * x + a, 1.3),
        "angle": angle(sin(x), cos(x)),
        "floor": floor(x * a),
        "masked": select(x > a, 1.0, t.lookup("table", x)),
        "slope": slope(t.lookup("table", x), {x: 1.0}),
        "bend": t.lookup("table", x, 2),
        "less": x < a,
        "total": total,
        "counted": 2.0 * low - t.negate(high),
        "between": t.logic("and", low, t.negate(high)),
        "turned": -x + select(floor(x), 3.0, a),
        "bound": 1.0 / select(low, math.inf, -2.0),
        "below": 1.0 / select(low, -math.inf, 4.0),
        "none": select(high, math.nan, x),
    }
    program = Program.of(t, outputs)
    table = Table.spline([0.0, 1.0, 2.5, 4.0], [1.0, 3.0, 2.0, 1.5], periodic=True)
    n = 41
    positions = {"x": np.linspace(-7.0, 9.0, n)}
    fields = {"s": np.linspace(0.25, 3.0, n)}
    want = NumpyProgram(program).run([0.7], positions, fields, tables={"table": table})
    job = work(program, {"a": 0.7}, positions, n, fields=fields, tables={"table": table})
    (got,) = in_node([job], tmp_path)
    agree(got, dict(zip(program.output_names, want, strict=True)), "functions")


def test_without_the_target_a_sentence_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(triple: str) -> None:
        raise RuntimeError(f"no target {triple}")

    monkeypatch.setattr("llvmlite.binding.Target.from_triple", missing)
    wasm._machines.cache_clear()
    with pytest.raises(RequestError, match="WebAssembly"):
        wasm_module(Program.of(Trace(), {}))


def test_a_module_is_small() -> None:
    """The six-bar with all reactions."""
    solver = ForceSolver(lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar")).solver)
    program = solver.program(solver.outputs.standard).program
    module = wasm_module(program)
    assert module[:8] == b"\0asm\1\0\0\0"
    assert len(module) < 6000
