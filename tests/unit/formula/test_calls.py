"""Compiled programs called: what is missing or misshapen is refused, what lies ready is read where it lies."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tests.every import every
from tests.unit.formula.sweeps import sweep

from linkwright.formula.llvm_backend import CompiledProgram, available, compile_program
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.threads import cores, spread_over, tapering
from linkwright.formula.trace import Trace

pytestmark = pytest.mark.skipif(not available(), reason="no llvmlite")
X = np.linspace(0.0, 1.0, 40)


def line() -> CompiledProgram:
    """a x + f."""
    t = Trace()
    a, x, f = t.parameter("a"), t.position("x"), t.field_input("f")
    compiled = compile_program(Program.of(t, {"y": a * x + f}))
    assert compiled is not None
    return compiled


def product() -> CompiledProgram:
    """a x, and x."""
    t = Trace()
    compiled = compile_program(Program.of(t, {"y": t.parameter("a") * t.position("x"), "x": t.position("x")}))
    assert compiled is not None
    return compiled


def test_missing_inputs_and_other_shapes_are_refused() -> None:
    program, f = line(), np.ones((1, 40))
    with pytest.raises(ValueError, match=r"\bx\b"):
        program.store([[1.0]], {}, {"f": f})
    with pytest.raises(ValueError, match=r"\bf\b"):
        program.store([[1.0]], {"x": X})
    with pytest.raises(ValueError, match=r"\[39, 40\]"):
        program.store([[1.0]], {"x": X}, {"f": f[:, 1:]})
    with pytest.raises(ValueError, match=r"\(1,\).*\(2,\)"):
        product().repeated({"x": X})(np.ones(2))
    with pytest.raises(ValueError, match=r"\(2, 2\)"):
        program.store(np.ones((2, 2)), {"x": X}, {"f": np.ones((2, 40))})


def test_parameters_given_again_are_read_where_they_lie() -> None:
    call, given = product().repeated({"x": X}), np.array([2.0])
    for value in (2.0, 3.0, 4.0, 5.0):
        given[0] = value
        assert call(given)[0] == pytest.approx(value * X, rel=1e-15)
    assert call(np.array([7.0]))[0] == pytest.approx(7.0 * X, rel=1e-15)
    assert call(given)[0] == pytest.approx(5.0 * X, rel=1e-15)


@pytest.mark.parametrize("count", [40, 1])
def test_repeated_calls_keep_what_they_found(count: int) -> None:
    """Each result is its own array, whatever thread asks, for as few positions as one as well."""
    again, given = product().repeated({"x": X[-count:]}), np.empty(1)
    found = []
    for value in (2.0, 3.0, -4.0):
        given[0] = value
        found.append(again(given))
    with ThreadPoolExecutor(1) as pool:
        found.append(pool.submit(again, np.array([5.0])).result())
    for value, out in zip((2.0, 3.0, -4.0, 5.0), found, strict=True):
        assert out == pytest.approx(np.array([value * X[-count:], X[-count:]]), rel=1e-15)
    with pytest.raises(ValueError):  # noqa: PT011
        line().repeated({"x": X})


def test_outputs_that_nobody_holds_make_room_for_the_next() -> None:
    """A view keeps them as well as they do themselves; nobody can write them."""
    again, given = product().repeated({"x": X}), np.array([2.0])
    address = again(given).__array_interface__["data"][0]
    given[0] = 3.0
    row = again(given)[0]
    assert row.__array_interface__["data"][0] == address
    given[0] = 5.0
    other = again(given)
    assert row == pytest.approx(3.0 * X, rel=1e-15)
    assert other[0] == pytest.approx(5.0 * X, rel=1e-15)
    with pytest.raises(ValueError, match="read-only"):
        other[0, 0] = 1.0


def test_a_program_of_parameters_alone_has_the_length_of_the_inputs_that_are_given() -> None:
    t = Trace()
    program = Program.of(t, {"y": 2.0 * t.parameter("a")})
    compiled = compile_program(program)
    assert compiled is not None
    for run in (compiled.store, NumpyProgram(program).run_designs):
        assert run([[3.0]], {"x": X}).tolist() == [[[6.0] * 40]]
        assert run([[3.0]], {}, length=5).tolist() == [[[6.0] * 5]]
        with pytest.raises(ValueError, match=r"\[\]"):
            run([[3.0]], {})


def test_kernels_are_lent_no_code_that_needs_more_than_they_give() -> None:
    with pytest.raises(ValueError, match=r"\bf\b"):
        line().one_by_one(np.ones((2, 1)), {"x": X}, np.empty((1, 40)))
    with pytest.raises(ValueError, match=r"\d+"):
        product().one_by_one(np.ones((2, 1)), {"x": X[:1]}, np.empty((1, 1)))


def test_numbers_of_inputs_that_do_not_fit_are_refused() -> None:
    t = Trace()
    program = Program.of(t, {"y": t.parameter("a") * t.position("x") + t.field_input("f")})
    with pytest.raises(ValueError, match=r"1.* 2"):
        ScalarProgram(program).step([1.0], [1.0, 2.0], fields=[1.0])
    with pytest.raises(ValueError, match=r"1.* 0"):
        ScalarProgram(program).step([1.0], [1.0])
    with pytest.raises(ValueError, match=r"\ba\b.*\(2, 2\)"):
        sweep(program, np.ones((2, 2)), {"x": X}, [("y", "max")], fields={"f": np.ones((2, 40))})


def test_machines_without_the_compiler_or_the_count_of_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    assert available.__wrapped__() is True
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert available.__wrapped__() is False
    monkeypatch.undo()

    def missing() -> None:
        raise OSError("no library")

    monkeypatch.setattr("linkwright.formula.machine_code._binding", missing)
    assert available.__wrapped__() is False
    monkeypatch.delattr("os.sched_getaffinity", raising=False)
    monkeypatch.setattr("os.cpu_count", lambda: 3)
    assert cores() == 3
    monkeypatch.setattr("os.cpu_count", lambda: None)
    assert cores() == 1


def test_nobody_writes_any_more_when_an_exception_is_raised() -> None:
    """A thread that is still at work when another fails is waited for; what nobody has begun is left out."""
    both, done = threading.Barrier(2, timeout=10), []

    def work(begin: int, end: int) -> None:
        if begin < 2:
            both.wait()
        if threading.current_thread() is threading.main_thread():
            raise ZeroDivisionError
        time.sleep(0.2)
        done.append((begin, end))

    with pytest.raises(ZeroDivisionError):
        spread_over(8, 1, 2, work)
    assert done in ([(0, 1)], [(1, 2)])


def test_the_last_chunks_of_several_threads_are_small() -> None:
    """Every design once, in order; no chunk is more than a fourth of what is left to two threads."""
    found = list(tapering(1003, 160, 8, 2))
    assert [first for first, _ in found] == [0, *(after for _, after in found[:-1])] and found[-1][1] == 1003
    sizes = [after - first for first, after in found]
    assert sizes[0] == 160 and sizes == sorted(sizes, reverse=True) and sizes[-1] <= 8
    large = every((size, first) for size, (first, _) in zip(sizes, found, strict=True) if size > 8)
    assert all(4 * size <= 1003 - first for size, first in large)
    done: list[tuple[int, int]] = []
    spread_over(1003, 160, 2, lambda *chunk: done.append(chunk), minimum=8)
    assert sorted(done) == found
    spread_over(8, 160, 2, lambda *chunk: done.append(chunk), minimum=8)
    assert done[-1] == (0, 8)
