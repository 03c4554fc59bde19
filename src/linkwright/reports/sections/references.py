"""References of the methods that the report used, and mistakes of the source."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from inspect import getdoc

from linkwright.analysis.base import METRICS
from linkwright.core.table import Table
from linkwright.elements import Group
from linkwright.errors import LinkwrightError
from linkwright.groups.base import DYADS
from linkwright.reports.document import Block, Paragraph, Sources, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.markdown import own_words
from linkwright.reports.section import section
from linkwright.reports.settings import Erratum, Settings
from linkwright.words import Translate, _, language_of


@section("references", _("References"), 31.0, common=True)
def references(cases: Sequence[ReportContext]) -> Iterator[Block]:
    """Own sources of the files, sources of the machines and of the groups' formulas, each once; where the design
    numbers are defined. Nothing where none is known."""
    found: dict[str, str] = {}
    for case in cases:
        found.update((text, own_words(text)) for text in case.settings.references.values())
    for case in cases:
        if case.origin:
            found.setdefault(case.origin, literal(case.origin))
        for group in _groups(case):
            for text in _of_group(group.signature):
                found.setdefault(text, literal(text))
    if found:
        yield Sources(tuple(found.items()))
    yield from _definitions(cases)


def own_sources(own: Settings) -> Iterator[Block]:
    """The sources that a file names."""
    if own.references:
        yield Sources(tuple((text, own_words(text)) for text in own.references.values()))


def _groups(case: ReportContext) -> Sequence[Group]:
    """The groups, none where the machine cannot be decomposed."""
    try:
        return case.structure.groups
    except LinkwrightError:
        return ()


def _definitions(cases: Sequence[ReportContext]) -> Iterator[Block]:
    """Where the metrics of the report are defined."""
    names = dict.fromkeys(name for case in cases for name in case.used)
    language = cases[0].language
    rows = [(METRICS[name]().label_in(language), _titles(METRICS[name].source, cases[0])) for name in names]
    if rows:
        head = (_("metric"), _("defined in"))
        yield printed(Table(head, rows, "<<", _("Definitions of the metrics")), language)


def _titles(source: str, case: ReportContext) -> str:
    """A source; in other languages than its own the titles in it alone, without what it says about them."""
    if case.language == "en":
        return source
    titles = [part.partition(": ")[0] for part in source.split("; ") if part[0].isupper()]
    return "; ".join(titles) or case.translate(_("derived in this report"))


def _of_group(signature: str) -> list[str]:
    """Sources that a group's own file names, in brackets at the end of its description."""
    if signature not in DYADS:
        return []
    text = " ".join((getdoc(DYADS[signature]) or "").split())
    quoted = re.findall(r"\(([^()]*(?:ch\.|pp?\.|§|,)[^()]*)\)\.?", text)
    parts = [part.strip() for part in quoted[-1].split(";")] if quoted else []
    return [part for part in parts if part[:1].isupper()]


@section("errata", _("Mistakes of the source"), 13.0, optional=True)
def errata(case: ReportContext) -> Iterator[Block]:
    """What is printed in the source, what is right, and why."""
    translate, found = case.translate, case.settings.errata
    if not found:
        raise Missing(_("the file tells of no mistakes of its source", code="report.no_errata"))
    yield from errata_blocks(found, case.origin, translate)


def errata_blocks(found: Sequence[Erratum], source: str, translate: Translate) -> Iterator[Block]:
    """The mistakes of a source as a table."""
    yield Paragraph(
        translate(
            _(
                "The numbers of the source ({source}) were compared with those of this report. Where they differ:",
                source=literal(source or "–"),
            )
        )
    )
    rows = [(e.where, e.printed, e.right, e.why) for e in found]
    table = Table((_("where"), _("printed"), _("right"), _("why")), rows, "<<<<", _("Mistakes of the source"))
    yield printed(table, language_of(translate), "errata")
