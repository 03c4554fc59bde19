"""Tolerances of a mechanism: from dimensions and clearances to the spread of its numbers and curves."""

from linkwright.designs.tolerance.problem import Clearance as Clearance
from linkwright.designs.tolerance.problem import Tolerance as Tolerance
from linkwright.designs.tolerance.result import Spread as Spread
from linkwright.designs.tolerance.study import ToleranceStudy as ToleranceStudy
