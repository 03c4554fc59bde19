"""Design numbers: one registered file per number."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.cycle.summary import Summary as Summary
    from linkwright.metrics.analysis import Analysis as Analysis
    from linkwright.metrics.base import METRICS as METRICS
    from linkwright.metrics.base import Metric as Metric
    from linkwright.metrics.base import MetricValue as MetricValue
    from linkwright.metrics.base import Remark as Remark
    from linkwright.metrics.coupler_curve import CouplerCurve as CouplerCurve
    from linkwright.metrics.coupler_curve import coupler_curve as coupler_curve
    from linkwright.metrics.evaluate import metrics as metrics
    from linkwright.metrics.grashof import FourBar as FourBar
    from linkwright.metrics.grashof import four_bars as four_bars
    from linkwright.metrics.instant_centres import centrode as centrode
    from linkwright.metrics.instant_centres import instant_centre as instant_centre
    from linkwright.metrics.table import MetricsTable as MetricsTable

offer(__name__)
