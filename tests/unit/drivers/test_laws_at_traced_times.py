"""Laws of drivers at traced times: coordinate and rates of every registered kind are those over arrays."""

import numpy as np
import pytest

from linkwright.core.expressions import parse
from linkwright.drivers.base import LAWS, Law
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.expression import ExpressionLaw
from linkwright.drivers.free import Free
from linkwright.drivers.program import ProgramLaw
from linkwright.drivers.table import TableLaw
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.trace import Trace
from linkwright.laws.program import MotionProgram, Segment

TIMES, PLACES = (0.0, 0.3, 0.5, 0.9, 1.6, 2.0), (0.1, 0.4, 0.2, -0.3, 0.6, 0.1)


def program(law: str) -> ProgramLaw:
    segments = (Segment(0.7, rise=0.5, law=law), Segment(0.2), Segment(1.1, rise=-0.5, law=law))
    return ProgramLaw(MotionProgram(segments, period=2.0, closed=False))


CASES: dict[str, Law] = {
    "speed": ConstantSpeed(-3.0, 0.4),
    "position": ExpressionLaw(parse("a*sin(7*t) + abs(t - 0.9)*t^2 + exp(-t)", ["t", "a"]), {"a": 0.3}),
    "table": TableLaw(TIMES, PLACES),
    "table linear": TableLaw(TIMES, PLACES, "linear"),
    "table periodic": TableLaw(TIMES, PLACES, "periodic"),
    "free": Free(0.4),
    "program": program("polynomial_345"),
    "program cycloidal": program("cycloidal"),
    "program modified_sine": program("modified_sine"),
    "program freudenstein": program("freudenstein"),
}


@pytest.mark.parametrize("name", CASES)
def test_a_law_at_traced_times_is_that_over_arrays(name: str) -> None:
    law = CASES[name]
    t = Trace()
    outputs = {str(k): value for k, value in enumerate(law.traced(t.position("t"), 0.0, 2.0))}
    time = np.sort(np.random.default_rng(5).uniform(0.0, 2.0, 2000))
    found = numpy_program(Program.of(t, outputs)).run((), {"t": time}, length=len(time))
    for row, expected in zip(found, law.coordinate(time), strict=True):
        np.testing.assert_allclose(row, expected, rtol=0.0, atol=4e-14 * np.abs(expected).max())


def test_every_registered_law_is_among_these() -> None:
    assert {name.split()[0] for name in CASES} == set(LAWS)
