"""Right-hand sides on buffers that stay: equal on all back ends, and as SciPy's integrators call them."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from linkwright.dynamics.right_side import RightSide, state_slopes
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Program
from linkwright.formula.table import Table
from linkwright.formula.trace import Trace, sin

BACKENDS = [False, pytest.param(True, marks=pytest.mark.skipif(not available(), reason="no llvmlite"))]
FIRST = ("q:arm", "qd:arm", "time")
NUMBERS = {"gravity": 9.81, "length": 0.4}
CURVE = Table.spline([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, 2.0])


def pendulum() -> Program:
    """One kilogram on a rod without mass."""
    t = Trace()
    q, w = t.position("q:arm"), t.position("qd:arm")
    gravity, length = t.parameter("gravity"), t.parameter("length")
    return Program.of(t, {"qdd:arm": -gravity / length * sin(q), "power": -gravity * length * sin(q) * w})


def of_every_input() -> Program:
    """A parameter, a position, a field, a table, and a truth value among the outputs."""
    t = Trace()
    a, x, f = t.parameter("a"), t.position("x"), t.field_input("f")
    return Program.of(t, {"y": a * x + t.lookup("curve", f), "slope": t.lookup("curve", x, 1), "above": x > f})


@pytest.mark.parametrize("compiled", BACKENDS)
@pytest.mark.parametrize("lanes", [None, 3, 300])
def test_all_kinds_of_inputs(compiled: bool, lanes: int | None) -> None:
    given = {"a": 2.0, "f": 0.3}
    right = RightSide(of_every_input(), given, lanes=lanes, tables={"curve": CURVE}, compiled=compiled)
    x = right.x[right.inputs["x"]] = 1.25 if lanes is None else np.linspace(-1.0, 1.0, lanes)
    right.call()
    y, slope, above = right.out
    assert y == pytest.approx(2.0 * x + CURVE(0.3), rel=1e-14)
    assert slope == pytest.approx(CURVE(x, 1), rel=1e-14)
    assert np.array_equal(above, np.asarray(x) > 0.3)
    right.numbers[0] = 3.0
    right.call()
    assert right.out[0] == pytest.approx(3.0 * x + CURVE(0.3), rel=1e-14)


def test_what_is_missing_is_refused() -> None:
    with pytest.raises(ValueError, match="length"):
        RightSide(pendulum(), {"gravity": 9.81})
    with pytest.raises(ValueError, match="curve"):
        RightSide(of_every_input(), {"a": 1.0})


@pytest.mark.parametrize("compiled", BACKENDS)
def test_period_of_a_pendulum_by_the_elliptic_integral(compiled: bool) -> None:
    """T = 4 √(l/g) K(sin² of half the amplitude)."""
    slopes = state_slopes(RightSide(pendulum(), NUMBERS, first=FIRST, compiled=compiled), 1)
    period = 4.0 * np.sqrt(0.4 / 9.81) * ellipk(np.sin(0.6) ** 2)
    found = solve_ivp(slopes, (0.0, period), [1.2, 0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    assert found == pytest.approx([1.2, 0.0, 0.0], abs=1e-9)


@pytest.mark.skipif(not available(), reason="no llvmlite")
def test_a_call_outlives_its_right_side() -> None:
    call, out = (right := RightSide(pendulum(), NUMBERS | {"q:arm": 0.5})).call, right.out
    del right
    call()
    assert out[0] == pytest.approx(-9.81 / 0.4 * np.sin(0.5), rel=1e-14)
