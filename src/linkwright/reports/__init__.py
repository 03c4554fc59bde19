"""Reports: what a course design or an engineering file needs, from a model and its results."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.reports.report import Report as Report
    from linkwright.reports.report import report as report
    from linkwright.reports.section import SECTIONS as SECTIONS

offer(__name__)
