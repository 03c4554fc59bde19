"""Values of a trace beside plain numbers: what is known at once is not written, what makes no sense is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.operations import FUNCTIONS
from linkwright.formula.program import Program
from linkwright.formula.table import Table
from linkwright.formula.trace import Scalar, Trace, absolute, floor, maximum, minimum, power, select, sign


def test_a_traced_value_has_no_truth_and_belongs_to_one_trace() -> None:
    t, other = Trace(), Trace()
    x = t.position("x")
    with pytest.raises(TypeError):
        bool(x < 1.0)
    with pytest.raises(ValueError):  # noqa: PT011
        x + other.position("x")
    assert +x is x
    assert x == t.position("x")
    assert x != other.position("x")


def test_what_is_known_while_tracing_is_a_number() -> None:
    t = Trace()
    x = t.position("x")
    yes, no = t.compare("less", 1.0, 2.0), t.compare("less", 2.0, 2.0)
    assert (yes, no, t.compare("less_equal", 2.0, 2.0), t.compare("less_equal", 2.5, 2.0)) == (
        True,
        False,
        True,
        False,
    )
    unknown = x < 1.0
    assert t.logic("and", True, unknown) is unknown
    assert t.logic("and", unknown, False) is False
    assert t.logic("or", unknown, True) is True
    assert t.logic("or", False, unknown) is unknown
    assert (t.negate(True), t.negate(False)) == (False, True)
    assert select(True, x, 2.0) is x
    assert select(False, x, 2.0) == 2.0
    assert t.select(unknown, x, x) is x
    assert t.div(0.0, x) == 0.0
    assert t.div(x, x) == 1.0
    assert t.div(x, 1.0) is x
    assert t.neg(t.neg(x)) == x
    assert t.lookup("lift", x, 4) == 0.0
    assert t.function("pow", 3.0, 4.0) == 81.0


def test_numbers_divide_as_the_standard_of_floating_point_says() -> None:
    t = Trace()
    assert (t.div(1.0, 0.0), t.div(-2.0, 0.0), t.div(3.0, 2.0)) == (math.inf, -math.inf, 1.5)
    log, power, exp = (FUNCTIONS[name].value for name in ("log", "pow", "exp"))
    assert (log(0.0), log(1.0), exp(800.0)) == (-math.inf, 0.0, math.inf)
    assert math.isnan(log(-1.0))
    assert (power(-1e200, 3.0), power(-1e200, 2.0), power(1e200, 3.0)) == (-math.inf, math.inf, math.inf)
    assert (power(0.0, -1.0), power(0.0, -2.0), power(0.0, -1.5)) == (math.inf, math.inf, math.inf)
    assert math.isnan(power(-2.0, 0.5))


@pytest.mark.parametrize(
    ("x", "y"), [([0.0], [1.0]), ([0.0, 0.0], [1.0, 2.0]), ([0.0, 1.0], [1.0]), ([0.0, 1.0], [1.0, math.nan])]
)
def test_tables_that_are_none_are_refused(x: list[float], y: list[float]) -> None:
    with pytest.raises(ValueError):  # noqa: PT011
        Table.linear(x, y)


@pytest.mark.parametrize(("drift", "rise"), [(None, 3.0), (0.0, 0.0), (10.0, 10.0)])
def test_straight_tables_that_repeat_rise_by_their_drift(drift: float | None, rise: float) -> None:
    t = Trace()
    program = NumpyProgram(Program.of(t, {"y": t.lookup("way", t.position("x"))}))
    table = Table.linear([0.0, 1.0, 2.0], [0.0, 1.0, 3.0], periodic=True, drift=drift)
    found = program.run([], {"x": np.array([0.5, 1.5, 2.5, 5.5, -0.5])}, tables={"way": table})[0]
    assert found == pytest.approx([0.5, 2.0, 0.5 + rise, 2.0 + 2 * rise, 2.0 - rise], rel=1e-15)


def test_a_formula_over_arrays_is_the_one_over_numbers() -> None:
    """Selection, functions and logic: arrays, numbers one by one, and a program of the same lines."""

    def formula(x: Scalar, y: Scalar) -> Scalar:
        inside = (x > -1.0) & (True & (y <= 0.5)) | (x > y + 1.0)
        return select(inside, minimum(x, y) + sign(x) * power(y, 2.5), maximum(absolute(x), floor(y)))

    x, y = np.linspace(-2.0, 2.0, 41), np.cos(np.arange(41.0))
    arrays: Any = (x, y)
    t = Trace()
    program = NumpyProgram(Program.of(t, {"f": formula(t.position("x"), t.position("y"))}))
    with np.errstate(invalid="ignore"):
        found: Any = formula(*arrays)
    assert 0 < np.count_nonzero(np.isnan(found)) < 30
    np.testing.assert_array_equal(found, program.run([], {"x": x, "y": y})[0])
    singly = [formula(float(a), float(b)) for a, b in zip(x, y, strict=True)]
    np.testing.assert_allclose(found, singly, rtol=1e-15, equal_nan=True)
