"""Help lists tasks, sections and sizes without importing what they stand for."""

from linkwright import fields
from linkwright.cli.commands import report
from linkwright.reports.section import section_names
from linkwright.sheets import paper
from linkwright.synthesis.names import TASK_NAMES
from linkwright.synthesis.tasks import tasks


def test_help_names_all_that_there_are() -> None:
    assert tuple(tasks()) == TASK_NAMES
    assert tuple(section_names()) == report.SECTIONS
    assert tuple(paper.SIZES) == fields.sheet.SIZES
