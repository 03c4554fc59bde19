"""Programs in two parts: what is evaluated often is compiled, and nobody can tell from the results."""

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright.formula import repeated_program
from linkwright.formula.machine_code import available
from linkwright.formula.program import Program
from linkwright.formula.repeated_program import InTurn
from linkwright.formula.trace import Trace, floor, select, sin, sqrt

needs_llvm = pytest.mark.skipif(not available(), reason="llvmlite is not there")


def machine(op):
    """Rows x² and, with a limit found from them, sums and shares of it; ``op``: one more operation in them."""
    t = Trace()
    a, limit, x = t.parameter("a"), t.parameter("limit"), t.position("x")
    share = (x * a - limit * limit) / (limit + 3.0)
    late = select(share > 0.1, share - floor(share), -share)
    outputs = {"square": x * x, "late": late + op(x * x + 1.0), "scaled": a * limit + 0.0 * x}
    return InTurn(Program.of(t, outputs), 1, {"limit"})


def evaluated(program, positions, times):
    found = []
    for k in range(times):
        numbers = {"a": 1.0 + 0.1 * k}
        rows = program.run(numbers, positions, lambda v: {"limit": float(v[0].max()) / 7.0}, 41, {})
        found.append(rows)
    return found


@needs_llvm
@pytest.mark.parametrize("op", [sqrt, sin])
def test_the_bits_are_those_of_numpy_however_often_it_is_evaluated(op, monkeypatch):
    positions = {"x": np.random.default_rng(3).normal(size=41)}
    expected = evaluated(machine(op), positions, 6)
    monkeypatch.setattr(repeated_program, "REPEATED", 3)
    program = machine(op)
    found = evaluated(program, positions, 6)
    for one, other in zip(found, expected, strict=True):
        assert np.array_equal(one, other)
    x = positions["x"]
    limit, a = float((x * x).max()) / 7.0, 1.5
    share = (x * a - limit * limit) / (limit + 3.0)
    function = np.sqrt if op is sqrt else np.sin
    late = np.where(share > 0.1, share - np.floor(share), -share) + function(x * x + 1.0)
    assert found[-1] == pytest.approx(np.stack([x * x, late, np.full(41, a * limit)]), rel=1e-13)
    (over,) = (each for _, each in program._over._kept.values())
    assert (over.code is not None) == (op is sqrt)


@needs_llvm
def test_nothing_is_given_where_the_late_inputs_are_not_found(monkeypatch):
    monkeypatch.setattr(repeated_program, "REPEATED", 2)
    program, positions = machine(sqrt), {"x": np.arange(41.0)}
    assert [program.run({"a": 1.0}, positions, lambda _: None, 41, {}) for _ in range(3)] == [None] * 3


@needs_llvm
@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "swing_conveyor", "toggle_press", "crank_rocker"])
def test_an_edited_machine_has_the_same_bits_at_the_first_and_at_the_last_edit(name, monkeypatch):
    mechanism = store.machine(name)
    address = next(each for each in mechanism.dimensions() if each.endswith(".length"))
    length = mechanism.dimension(address)

    def edited(share):
        return lw.solve_forces(mechanism.with_dimensions({address: share * length}), steps=45)

    first = [edited(1.0 + 1e-3 * k) for k in range(4)]
    monkeypatch.setattr(repeated_program, "REPEATED", 3)
    for _ in range(2):
        last = [edited(1.0 + 1e-3 * k) for k in range(4)]
        for one, other in zip(first, last, strict=True):
            assert np.array_equal(one.rows.values, other.rows.values)
            assert one.fields.keys() == other.fields.keys() and len(one.rows.values)
            assert all(np.array_equal(one.fields[load], other.fields[load]) for load in one.fields)
