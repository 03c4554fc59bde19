"""A report put together: sections, own chapters and calculations in their order, in one document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from linkwright.errors import LinkwrightError, RequestError
from linkwright.parts.base import Problem
from linkwright.registry import listed
from linkwright.reports.document import (
    NUMBERED,
    Block,
    Document,
    Heading,
    Paragraph,
    Sources,
    Table,
    changed,
    fitted,
    literal,
    plain,
    spans,
    texts,
    with_prefix,
)
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.markdown import own_text, own_words
from linkwright.reports.numbers import typeset
from linkwright.reports.section import SECTIONS, Section, section_names
from linkwright.reports.sections.references import own_sources
from linkwright.reports.settings import OTHER_SECTIONS, Chapter, Settings
from linkwright.synthesis.tasks import TaskFile
from linkwright.words import _
from linkwright.words.message import in_language

#: Characters across a page in a table.
WIDEST = 108


def add_part(document: Document, part: Part, *, asked: bool) -> None:
    """Adds what comes next; ``asked``: whether sections were named for this report."""
    if part.section is not None:
        _add(document, part, part.section, asked=asked)
    elif part.chapter is not None:
        _add_chapter(document, part, part.chapter)
    elif part.calculation is not None:
        _add_calculation(document, part, part.calculation)
    else:
        document.blocks.append(Heading(literal(part.name), 1))


def _add_chapter(document: Document, part: Part, chapter: Chapter) -> None:
    """Adds an own chapter, within the part of a machine where it belongs to one of several."""
    shift, prefix = (1, f"{in_language(part.within, document.language)}: ") if part.within else (0, "")
    heading = Heading(own_words(chapter.title), 1, chapter.label)
    for block in chain([heading], _own(chapter.text, part.own, document, prefix + chapter.title)):
        document.blocks += [new for each in _parts_of(block, document) for new in _placed(each, shift, prefix)]


def _add_calculation(document: Document, part: Part, problem: Problem | TaskFile) -> None:
    """Adds a calculation, or a task of synthesis, its own chapters behind it; one without a result says why."""
    from linkwright.reports.calculation import OwnText, calculation
    from linkwright.reports.sections.synthesis import task_chapter

    name = in_language(problem.name, document.language)
    translate, language = document.translate, document.language
    try:
        for block in (
            task_chapter(problem, part.own, translate, language)
            if isinstance(problem, TaskFile)
            else calculation(problem, part.own, translate, language)
        ):
            if isinstance(block, Paragraph) and block.kind == "missing":
                _miss(document, name, plain(block.text))
            found = _own(block.text, part.own, document, name) if isinstance(block, OwnText) else (block,)
            document.blocks += (new for each in found for new in _parts_of(each, document))
    except LinkwrightError as error:
        sentence = error.translate(document.language)
        document.blocks.append(Heading(literal(name), 1))
        document.blocks.append(
            Paragraph(document.translate(_("Left out: {sentence}", sentence=literal(sentence))), "missing")
        )
        _miss(document, name, sentence)


def _add(document: Document, within: Part, part: Section, *, asked: bool) -> None:
    """Adds a section; what it cannot show becomes a paragraph that says why, and one without content nothing."""
    translate, cases = document.translate, within.cases
    shift, prefix = (1, f"{within.within}: ") if within.within else (0, "")
    title = translate(part.title)
    found: list[Block] = []
    text = within.own.text.get(part.name, "")
    own = _own(text, within.own, document, prefix + title) if text else ()
    try:
        for block in chain(own, part.blocks(cases) if cases else own_sources(within.own)):
            if isinstance(block, Paragraph) and block.kind == "missing":
                _miss(document, prefix + title, plain(block.text))
            found += [new for each in _parts_of(block, document) for new in _placed(each, shift, prefix)]
    except LinkwrightError as error:
        named = asked or part.name in within.own.sections
        if named or not (part.optional and isinstance(error, Missing)):
            sentence = error.translate(document.language)
            found.append(Paragraph(translate(_("Left out: {sentence}", sentence=literal(sentence))), "missing"))
            _miss(document, prefix + title, sentence)
    except Exception as error:
        sentence = translate(
            _(
                "an unexpected error ({kind}: {message}); please report it with the model file",
                kind=type(error).__name__,
                message=" ".join(str(error).split()),
            )
        )
        found.append(Paragraph(literal(sentence), "missing"))
        _miss(document, prefix + title, sentence)
        document.broken = True
    if found:
        document.blocks += [Heading(title, 1 + shift), *found]


def _miss(document: Document, title: str, sentence: str) -> None:
    """Notes what a chapter lacks, once."""
    message = document.translate(_("{name}: {cause}", name=title, cause=sentence))
    if message not in document.missing:
        document.missing.append(message)


def _parts_of(block: Block, document: Document) -> Iterator[Block]:
    """A block; of a table that is too wide for a page its parts, of lists and quotations likewise."""

    def parted(each: Block) -> Iterator[Block]:
        if not isinstance(each, Table):
            yield each
            return
        rows = tuple(tuple(typeset(cell) for cell in row) for row in each.rows)
        first, *rest = fitted(replace(each, rows=rows), WIDEST)
        yield first
        for part in rest:
            caption = document.translate(_("{caption} (continued)", caption=each.caption)) if each.caption else ""
            yield replace(part, caption=caption)

    yield from changed(block, parted)


def _own(text: str, own: Settings, document: Document, title: str) -> Iterator[Block]:
    """The blocks of own text; after one that cannot be printed as intended comes the reason."""
    for block, faults in own_text(text, context=own.text_context):
        yield block
        for fault in faults:
            sentence = in_language(fault.sentence, document.language)
            _miss(document, title, sentence)
            yield Paragraph(literal(sentence), "missing")


def _placed(block: Block, shift: int, prefix: str) -> Iterator[Block]:
    """A block of one of several machines: its headings one level down, its labels the machine's own."""

    def own(each: Block) -> Iterator[Block]:
        if isinstance(each, Heading):
            each = replace(each, level=min(each.level + shift, 4))
        if prefix and isinstance(each, (Heading, *NUMBERED)) and each.label:
            each = replace(each, label=f"{prefix}{each.label}")
        yield with_prefix(each, prefix) if prefix else each

    yield from changed(block, own)


def note_dangling(document: Document) -> None:
    """Notes what texts refer to and is not there: labels of blocks, and the list of sources."""
    numbers = document.number()
    parts = [span for block in numbers.blocks for text in texts(block) for span in spans(text)]
    asked = [span.link[1:] for span in parts if span.link[:1] == "#"]
    asked += [span.text for span in parts if span.kind == "reference"]
    for label in dict.fromkeys(asked):
        if label not in numbers.labels:
            document.missing.append(
                _('a text refers to "{label}", but nothing in the report has this label', label=label).translate(
                    document.language
                )
            )
    listed = any(isinstance(block, Sources) for block in numbers.blocks)
    if any(span.kind == "source" for span in parts) and not listed:
        document.missing.append(
            _("texts cite sources, but the report has no section references; add it to the sections").translate(
                document.language
            )
        )


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
