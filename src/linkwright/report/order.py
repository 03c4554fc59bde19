"""The order of a report: sections and own chapters as they follow each other, of one machine or of several."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from linkwright.core.dataclass import dataclass
from linkwright.errors import RequestError
from linkwright.parts.base import Problem
from linkwright.registry import listed
from linkwright.report.machine_results import Case
from linkwright.report.section import SECTIONS, Section, section_names
from linkwright.report.settings import BESIDE_SECTIONS, Chapter, Settings

REST, CALCULATIONS = BESIDE_SECTIONS
#: The section that reports on calculations alone have, too.
SOURCES = "references"


@dataclass(frozen=True)
class Part:
    """What comes next: a section of ``cases``, an own chapter, a calculation, or the heading of a machine (``name``);
    ``own``: the settings that hold; ``within``: the machine of several whose part it is."""

    own: Settings
    cases: tuple[Case, ...] = ()
    section: Section | None = None
    chapter: Chapter | None = None
    problem: Problem | None = None
    name: str = ""
    within: str = ""


Entry = str | Chapter


def chosen(names: Iterable[str], own: Settings, *, calculations: bool) -> list[Entry]:
    """Sections and own chapters in order: those that are named, chapters by their title, else what the file says,
    else all; of a report of ``calculations`` alone these behind the last section before the references, unless they
    are named.

    Raises RequestError for a name that does not exist, the nearest offered.
    """
    asked: list[Entry] = list(names)
    if asked:
        titles = {each.title: each for each in own.sections if isinstance(each, Chapter)}
        known = [*section_names(), *BESIDE_SECTIONS, *titles]
        for name in asked:
            if name not in known:
                raise RequestError("report.no_section", name=name, hint=listed(str(name), known))
        asked = [titles.get(str(name), name) for name in asked]
    found = _with_rest(asked or list(own.sections) or [REST])
    if calculations and CALCULATIONS not in found:
        places = (i for i, each in enumerate(found, 1) if isinstance(each, str) and each != SOURCES)
        found.insert(max(places, default=len(found)), CALCULATIONS)
    return found


def _with_rest(entries: list[Entry]) -> list[Entry]:
    """Entries with the sections that are not among them in place of ``rest``."""
    others = [name for name in section_names() if name not in entries]
    found: list[Entry] = []
    for each in entries:
        found += others if each == REST else [each]
    return found


def parts(
    given: Sequence[Case | Problem], entries: Sequence[Entry], own: Settings, *, asked: bool
) -> Iterator[Part]:
    """What a report holds, in its order. Sections of machines that follow each other make a part for each machine.

    Calculations stand where ``calculations`` is named, else between the parts of the machines in the order of the
    files, once.

    Own chapters of the first file that stand between two such sections belong to the first machine; its others are
    of the whole report. The chapters of further files stand in the parts of their machines, unless sections were
    ``asked`` for by name.
    """
    cases = [each for each in given if isinstance(each, Case)]
    problems = [each for each in given if isinstance(each, Problem)]
    chapters = list(given) if CALCULATIONS not in entries else [*cases]
    several = len(chapters) > 1
    groups = list(_groups(entries))
    last = max((i for i, group in enumerate(groups) if len(group) > 1 or _of_machine(group[0])), default=-1)
    first = next((i for i, group in enumerate(groups) if _of_machine(group[0])), -1)
    for number, group in enumerate(groups):
        head = group[0]
        if _of_machine(head):
            place = -1
            for case in chapters:
                if isinstance(case, Problem):
                    yield Part(own, problem=case)
                    continue
                place += 1
                name = case.mechanism.name if several else ""
                if name:
                    yield Part(case.settings, name=name)
                others = [] if asked else case.settings.sections
                held = group if place == 0 else _of_other(others, group, number == first, number == last)
                for each in held:
                    yield _part(case.settings, (case,), each, name)
            chapters = [*cases]
        elif head == CALCULATIONS:
            yield from (Part(own, problem=each) for each in problems)
        elif isinstance(head, Chapter) or head == SOURCES or cases:
            yield _part(own, tuple(cases), head)
    yield from (Part(own, problem=each) for each in chapters if isinstance(each, Problem))


def _of_machine(entry: Entry) -> bool:
    return isinstance(entry, str) and entry != CALCULATIONS and not SECTIONS[entry].common


def _groups(entries: Sequence[Entry]) -> Iterator[list[Entry]]:
    """Sections of machines that follow each other, with the chapters between them; all else by itself."""
    held: list[Entry] = []
    behind: list[Entry] = []
    for each in entries:
        if _of_machine(each):
            held += [*behind, each]
            behind = []
        elif isinstance(each, Chapter) and held:
            behind.append(each)
        else:
            yield from ([held] if held else [])
            yield from ([other] for other in (*behind, each))
            held, behind = [], []
    yield from ([held] if held else [])
    yield from ([other] for other in behind)


def _of_other(own: Sequence[Entry], group: Sequence[Entry], first: bool, last: bool) -> Iterator[Entry]:
    """The sections of a group, with a further file's chapters where they stand in its ``own`` order."""
    follow: dict[str, list[Chapter]] = {"": []}
    name = ""
    for each in _with_rest(list(own)):
        if isinstance(each, Chapter):
            follow.setdefault(name, []).append(each)
        elif _of_machine(each):
            name = each
    yield from follow.pop("") if first else ()
    for each in group:
        if isinstance(each, str):
            yield each
            yield from follow.pop(each, ())
    if last:
        for chapters in follow.values():
            yield from chapters


def _part(own: Settings, cases: tuple[Case, ...], entry: Entry, within: str = "") -> Part:
    if isinstance(entry, Chapter):
        return Part(own, cases, chapter=entry, within=within)
    return Part(own, cases, SECTIONS[entry], within=within)
