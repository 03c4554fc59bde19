"""References of the methods that the report used."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from inspect import getdoc

from linkwright.errors import LinkwrightError
from linkwright.groups.base import DYADS
from linkwright.metrics.base import METRICS
from linkwright.report.document import Block, Paragraph, Table, literal
from linkwright.report.machine_results import Case, Missing
from linkwright.report.section import section
from linkwright.structure.group import Group


@section("references", 31.0, common=True)
def blocks(cases: Sequence[Case]) -> Iterator[Block]:
    """Sources of the machine, of the groups' formulas and of the design numbers, each once."""
    found: dict[str, None] = {}
    for case in cases:
        if case.origin:
            found[case.origin] = None
        for group in _groups(case):
            found.update(dict.fromkeys(_of_group(group.signature)))
    if not found:
        raise Missing("report.no_references")
    for number, source in enumerate(found, 1):
        yield Paragraph(literal(f"[{number}] {source}"))
    yield from _definitions(cases)


def _groups(case: Case) -> Sequence[Group]:
    """The groups, none where the machine cannot be taken apart."""
    try:
        return case.structure.groups
    except LinkwrightError:
        return ()


def _definitions(cases: Sequence[Case]) -> Iterator[Block]:
    """Where the design numbers of the report are defined."""
    say, language = cases[0].say, cases[0].language
    names = dict.fromkeys(name for case in cases for name in case.used)
    rows = tuple(
        (literal(METRICS[name]().label_in(language)), literal(_titles(METRICS[name].source, cases[0])))
        for name in names
    )
    if rows:
        head = (say("report.number"), say("report.defined_in"))
        yield Table(say("report.definitions"), head, rows, "<<")


def _titles(source: str, case: Case) -> str:
    """A source; in other languages than its own the titles in it alone, without what it says about them."""
    if case.language == "en":
        return source
    titles = [part.partition(": ")[0] for part in source.split("; ") if part[0].isupper()]
    return "; ".join(titles) or case.say("report.own_method")


def _of_group(signature: str) -> list[str]:
    """Sources that a group's own file names, in brackets at the end of its description."""
    if signature not in DYADS:
        return []
    text = " ".join((getdoc(DYADS[signature]) or "").split())
    quoted = re.findall(r"\(([^()]*(?:ch\.|pp?\.|§|,)[^()]*)\)\.?", text)
    parts = [part.strip() for part in quoted[-1].split(";")] if quoted else []
    return [part for part in parts if part[:1].isupper()]
