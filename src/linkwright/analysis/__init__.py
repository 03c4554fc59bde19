"""Design numbers: one registered file per number."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.analysis.analysis import Analysis as Analysis
    from linkwright.analysis.base import METRICS as METRICS
    from linkwright.analysis.base import Metric as Metric
    from linkwright.analysis.base import MetricValue as MetricValue
    from linkwright.analysis.base import Remark as Remark
    from linkwright.analysis.coupler_curve import CouplerCurve as CouplerCurve
    from linkwright.analysis.coupler_curve import coupler_curve as coupler_curve
    from linkwright.analysis.evaluate import metrics as metrics
    from linkwright.analysis.grashof import FourBar as FourBar
    from linkwright.analysis.grashof import four_bars as four_bars
    from linkwright.analysis.instant_centres import centrode as centrode
    from linkwright.analysis.instant_centres import instant_centre as instant_centre
    from linkwright.analysis.table import MetricsTable as MetricsTable
    from linkwright.cycle.summary import Summary as Summary

offer(__name__)
