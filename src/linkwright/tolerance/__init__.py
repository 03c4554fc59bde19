"""Tolerances of a mechanism: from dimensions and clearances to the spread of its numbers and curves."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.tolerance.problem import Clearance as Clearance
    from linkwright.tolerance.problem import Tolerance as Tolerance
    from linkwright.tolerance.result import Spread as Spread
    from linkwright.tolerance.study import ToleranceStudy as ToleranceStudy

offer(__name__)
