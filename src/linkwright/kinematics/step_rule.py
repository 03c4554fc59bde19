"""What a step must fulfil so that a group without closed form keeps its assembly.

One rule serves one machine, many designs, and pages.
A step is predicted with the exact rates of two orders and corrected by Newton's method. It counts if the determinants
keep their signs, the correction, of third order small, is small against the step, and both ends' exact rates fit one
quintic. Where a step can be halved, doubt halves it.
"""

from __future__ import annotations

from typing import Any

from linkwright.formula.trace import Scalar, maximum, reciprocal

#: Largest correction, and largest misfit of both ends' rates, as share of the step.
CORRECTION, MISFIT = 0.1, 0.01
#: Largest change of a coordinate in one step, rad or share of the size.
LARGEST = 0.3
#: What a correction and a misfit may be in addition to these shares: rounding; and where steps cannot be halved, as
#: where a cam's rise begins behind a dwell: no other assembly of the same sign of the determinant is so near.
ROUNDING, ROOM = 1e-10, 1e-4


def doubt(change: Scalar, correction: Scalar, misfit: Scalar, room: Scalar) -> Scalar:
    """Of a step's largest change, correction and misfit: below 1 the step counts."""
    return maximum(correction * reciprocal(CORRECTION * change + room), misfit * reciprocal(MISFIT * change + room))


def misfit(rise: Any, rate: Any, second: Any, rate_there: Any, second_there: Any) -> Any:
    """How far a coordinate's rise in a step is from what one quintic of the rates at both ends gives; these times the
    step, and times its square."""
    return rise - 0.5 * (rate + rate_there) - (1.0 / 12.0) * (second - second_there)


def quintic(rise: Any, rate: Any, second: Any, rate_there: Any, second_there: Any) -> tuple[Any, Any, Any]:
    """The coefficients of the third to the fifth power, over shares of the step, of the quintic with the values and
    rates of both ends, see :func:`misfit`."""
    d, dv, ds = rise - rate - 0.5 * second, rate_there - rate - second, 0.5 * (second_there - second)
    return 10.0 * d - 4.0 * dv + ds, 7.0 * dv - 15.0 * d - 2.0 * ds, 6.0 * d - 3.0 * dv + ds
