"""The order of a report: sections and own chapters as they follow each other, of one machine or of several."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from linkwright.errors import RequestError
from linkwright.parts.base import Problem
from linkwright.registry import listed
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import SECTIONS, Section, section_names
from linkwright.reports.settings import OTHER_SECTIONS, Chapter, Settings
from linkwright.synthesis.tasks import TaskFile
from linkwright.words import _
from linkwright.words.sentence import in_language

REST, CALCULATIONS = OTHER_SECTIONS
#: The section that reports on calculations alone have, too.
SOURCES = "references"


@dataclass(frozen=True)
class Calculation:
    """A calculation, or a task of synthesis on its own, with the settings of its file."""

    problem: Problem | TaskFile
    settings: Settings

    def title(self, language: str) -> str:
        """Its name in a language."""
        return in_language(self.problem.name, language)


@dataclass(frozen=True)
class Part:
    """What comes next: a section of ``cases``, an own chapter, a calculation, or the heading of a machine (``name``);
    ``own``: the settings that hold; ``within``: the machine or calculation of several whose part it is."""

    own: Settings
    cases: tuple[ReportContext, ...] = ()
    section: Section | None = None
    chapter: Chapter | None = None
    calculation: Problem | TaskFile | None = None
    name: str = ""
    within: str = ""


Entry = str | Chapter


def chosen(names: Iterable[str], own: Settings) -> list[Entry]:
    """Sections and own chapters in order: those that are named, chapters by their title, else what the file says,
    else all. Raises RequestError for a name that does not exist, the nearest offered.
    """
    asked: list[Entry] = list(names)
    if asked:
        titles = {each.title: each for each in own.sections if isinstance(each, Chapter)}
        known = [*section_names(), *OTHER_SECTIONS, *titles]
        for name in asked:
            if name not in known:
                raise RequestError(
                    _(
                        'there is no section "{name}"; {hint}',
                        code="report.no_section",
                        name=name,
                        hint=listed(str(name), known),
                    )
                )
        asked = [titles.get(str(name), name) for name in asked]
    return _with_rest(asked or list(own.sections) or [REST])


def _with_rest(entries: list[Entry]) -> list[Entry]:
    """Entries with the sections that are not among them in place of ``rest``."""
    others = [name for name in section_names() if name not in entries]
    found: list[Entry] = []
    for each in entries:
        found += others if each == REST else [each]
    return found


def parts(
    subjects: Sequence[ReportContext | Calculation], entries: Sequence[Entry], own: Settings, *, asked: bool
) -> Iterator[Part]:
    """What a report holds, in its order. Sections of machines that follow each other make a part for each machine.

    Calculations stand where ``calculations`` is named, else once in their places between the parts of the machines.
    Own chapters of the first file that stand between two sections of machines belong to the first machine; its others
    are of the complete report. The chapters of further files stand in the parts of their machines and behind their
    calculations, unless sections were ``asked`` for by name.
    """
    cases = tuple(each for each in subjects if isinstance(each, ReportContext))
    groups = list(_groups(_with_calculations(entries, subjects)))
    machines = [i for i, group in enumerate(groups) if _of_machine(group[0])]
    between = bool(cases) and CALCULATIONS not in entries
    for number, group in enumerate(groups):
        head = group[0]
        if head == CALCULATIONS:
            for each in subjects:
                yield from _calculated(each, own, asked) if isinstance(each, Calculation) else ()
        elif not _of_machine(head):
            yield from ([_part(own, cases, head)] if isinstance(head, Chapter) or cases or head == SOURCES else ())
        else:
            for each in subjects if between and number == machines[0] else cases:
                if isinstance(each, Calculation):
                    yield from _calculated(each, own, asked)
                    continue
                held = group
                if each is not cases[0]:
                    others = [] if asked else each.settings.sections
                    held = list(_of_other(others, group, number == machines[0], number == machines[-1]))
                yield from _of_case(each, held, several=len(subjects) > 1)


def _with_calculations(entries: Sequence[Entry], subjects: Sequence[ReportContext | Calculation]) -> list[Entry]:
    """Entries with a place for calculations where no part of a machine has one: before the references."""
    found = list(entries)
    interleaved = any(isinstance(each, ReportContext) for each in subjects) and any(map(_of_machine, entries))
    if CALCULATIONS not in found and not interleaved:
        places = (i for i, each in enumerate(found, 1) if isinstance(each, str) and each != SOURCES)
        found.insert(max(places, default=0), CALCULATIONS)
    return found


def _of_case(case: ReportContext, entries: Sequence[Entry], *, several: bool) -> Iterator[Part]:
    """The part of a machine, under its name where there are several."""
    name = case.mechanism.name if several else ""
    if name:
        yield Part(case.settings, name=name)
    for each in entries:
        yield _part(case.settings, (case,), each, name)


def _calculated(each: Calculation, own: Settings, asked: bool) -> Iterator[Part]:
    """A calculation, and the chapters of its file behind it, where these are not those of the report."""
    yield Part(each.settings, calculation=each.problem)
    for chapter in each.settings.sections if each.settings is not own and not asked else ():
        if isinstance(chapter, Chapter):
            yield Part(each.settings, chapter=chapter, within=each.problem.name)


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


def _part(own: Settings, cases: tuple[ReportContext, ...], entry: Entry, within: str = "") -> Part:
    if isinstance(entry, Chapter):
        return Part(own, cases, chapter=entry, within=within)
    return Part(own, cases, SECTIONS[entry], within=within)
