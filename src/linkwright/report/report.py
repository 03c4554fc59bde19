"""From models to a report: sections chosen and ordered, written as PDF, HTML or DOCX."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain
from os import PathLike
from pathlib import Path

from linkwright.core.dataclass import dataclass
from linkwright.core.given import require
from linkwright.core.progress import Progress, current_progress, reporting
from linkwright.errors import LinkwrightError, RequestError, about, require_language
from linkwright.files.model_file import load
from linkwright.files.source import GALLERY
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.registry import listed
from linkwright.report.document import (
    NUMBERED,
    Block,
    Document,
    Heading,
    Paragraph,
    Table,
    fitted,
    literal,
)
from linkwright.report.machine_results import Case
from linkwright.report.markdown import own_text, printable
from linkwright.report.numbers import typeset
from linkwright.report.section import SECTIONS, Section, section_names
from linkwright.report.settings import settings, worked_place
from linkwright.synthesis.task_file import TaskFile, task_file
from linkwright.whole_files import refuse_target, write_whole
from linkwright.words import speaker
from linkwright.words.sentence import Sentence, in_language
from linkwright.words.titles import title_said

#: Characters across a page in a table.
WIDEST = 108
ENDINGS = (".pdf", ".html", ".docx", ".typ")


@dataclass(frozen=True)
class Report:
    """A finished report; ``missing``: sentences on sections that have nothing to show, as they stand in it."""

    document: Document

    @property
    def missing(self) -> tuple[str, ...]:
        """What the report lacks, and why; once its PDF is made, also the characters that no font has."""
        return tuple(self.document.missing)

    @property
    def broken(self) -> bool:
        """Whether a section is missing because of an error of the program."""
        return self.document.broken

    def content(self, ending: str) -> bytes:
        """The file of an ending: ``.pdf``, ``.html``, ``.docx``, or ``.typ`` (the Typst text, without its pictures).

        Raises LinkwrightError for another ending, a package or a font that is not there.
        """
        if ending in (".pdf", ".html"):
            from linkwright.report.typst_pages import compiled, without_glyph

            made = compiled(self.document, ending[1:])
            lost = without_glyph(self.document) if ending == ".pdf" else ""
            if lost:
                self._miss(Sentence("report.no_glyph", characters=" ".join(lost)).say(self.document.language))
            return made
        if ending == ".docx":
            from linkwright.report.word_pages import word

            return word(self.document)
        if ending == ".typ":
            from linkwright.report.typst_pages import pages

            return pages(self.document)[0].encode()
        raise RequestError("report.bad_ending", ending=ending, endings=ENDINGS)

    def _miss(self, sentence: str) -> None:
        """Notes what the report lacks, once."""
        if sentence not in self.document.missing:
            self.document.missing.append(sentence)

    def save(self, path: str | Path, *, force: bool = False) -> Path:
        """Write it, whole or not at all; the ending of ``path`` says which form.

        Raises LinkwrightError for another ending, where the file cannot be written, and for one that is there already
        unless ``force``.
        """
        refuse_target(path, force=force)
        return write_whole(path, self.content(Path(path).suffix.lower()), force=force)

    def __repr__(self) -> str:
        return f"Report({self.document.title!r}: {len(self.document.blocks)} blocks)"


Machine = Mechanism | Problem | str | Path


def report(
    machines: Machine | Sequence[Machine],
    *,
    sources: Sequence[str] = (),
    sections: Sequence[str] = (),
    language: str = "en",
    position: str = "",
    positions: int | None = None,
    progress: Progress | None = None,
) -> Report:
    """The report of a machine, or of several with their comparison; and of calculations, cams among them.

    Args:
        machines: mechanisms, calculations of machine parts, paths or gallery names; also of files that hold a task of
            synthesis alone.
        sources: the files of mechanisms that are given themselves, for what is read from files (tasks of synthesis).
        sections: names of sections in the order wanted; empty: what the first file says, else all that apply.
        language: ``en`` or ``zh``.
        position: input of the worked position, such as ``"60 deg"``; else what the file says, else a sixth of the
            cycle.
        positions: numbered positions of the tables, else what the file says, else 24, or 25 where the
            input would be the same in all of them.
        progress: is told how many sections are done, and of how many.

    Returns:
        The report; ``save("report.pdf")``, ``.html``, ``.docx``. A section that cannot be made says so in it, and in
        ``missing``.

    Raises:
        LinkwrightError: an unknown section or language, a model that cannot be read, settings that make no sense.
    """
    require_language(language)
    given, problems, tasks = _told_apart(machines, language)
    cases = _cases(given, sources, language, position, positions)
    own = cases[0].settings if cases else settings(tasks[0].report if tasks else {}, language)
    chosen = _chosen(sections or own.sections)
    names = [case.mechanism.name for case in cases]
    names = names or [problem.name for problem in problems] + [task.name for task in tasks]
    document = Document(
        own.title or " / ".join(dict.fromkeys(names)),
        speaker(language),
        language,
        tuple(filter(None, (own.course, own.author, own.date))),
    )
    parts = list(_parts(cases, chosen, document)) if cases else []
    progress = progress or current_progress()
    for done, (case, part) in enumerate(parts):
        if progress is not None:
            progress(done, len(parts))
        with reporting(None):
            _add(document, case, part, asked=bool(sections))
    for problem in problems:
        _add_calculation(document, problem)
    for task in tasks:
        _add_task(document, task, own.text.get("synthesis", ""))
    return Report(document)


def _told_apart(
    machines: Machine | Sequence[Machine], language: str
) -> tuple[list[Mechanism | str], list[Problem], list[TaskFile]]:
    """Mechanisms (or their files), calculations, and files that hold a task of synthesis alone."""
    from linkwright.parts.file import kind_of
    from linkwright.parts.file import load as load_calculation

    given = list(machines) if isinstance(machines, Iterable) and not isinstance(machines, str) else [machines]
    if not given:
        raise RequestError("report.no_machine")
    found: list[Mechanism | str] = []
    problems, tasks = [], []
    for each in given:
        require(each, Mechanism, Problem, str, PathLike)
        if isinstance(each, Problem):
            problems.append(each)
        elif isinstance(each, Mechanism):
            found.append(each)
        elif kind_of(str(each)) is not None:
            problems.append(load_calculation(str(each)))
        elif (task := task_file(each)) is not None:
            tasks.append(task.said_in(language))
        else:
            found.append(str(each))
    return found, problems, tasks


def _add_task(document: Document, task: TaskFile, text: str) -> None:
    """Adds the synthesis of a file that holds a task alone; one without a result says why."""
    from linkwright.report.sections.synthesis import of_task

    say, own = document.say, settings(task.report, document.language)
    document.blocks.append(Heading(literal(task.name), 1))
    if purpose := own.purpose or task.purpose:
        document.blocks.append(Paragraph(literal(purpose)))
    if source := own.source or task.source:
        document.blocks.append(Paragraph(say("report.source", source=literal(source))))
    try:
        for block in chain(_own(text, document) if text else (), of_task(task.file, document.language)):
            if isinstance(block, Paragraph) and block.kind == "missing":
                document.missing.append(say("cli.about", name=task.name, cause=_unmarked(block.text)))
            document.blocks += _parts_of(block, document)
    except LinkwrightError as error:
        sentence = error.say(document.language)
        document.blocks.append(Paragraph(say("report.left_out", sentence=literal(sentence)), "missing"))
        document.missing.append(say("cli.about", name=task.name, cause=sentence))


def _add_calculation(document: Document, problem: Problem) -> None:
    """Adds a calculation; one without a result says why."""
    from linkwright.report.calculation import calculation

    try:
        for block in calculation(problem, document.say, document.language):
            document.blocks += _parts_of(block, document)
    except LinkwrightError as error:
        sentence = error.say(document.language)
        document.blocks.append(Heading(literal(problem.name), 1))
        document.blocks.append(
            Paragraph(document.say("report.left_out", sentence=literal(sentence)), "missing")
        )
        document.missing.append(document.say("cli.about", name=problem.name, cause=sentence))


def _cases(
    given: list[Mechanism | str], sources: Sequence[str], language: str, position: str, positions: int | None
) -> list[Case]:
    found = []
    for index, each in enumerate(given):
        mechanism = each if isinstance(each, Mechanism) else _loaded(str(each), language)
        mechanism = mechanism.said_in(language)
        source = sources[index] if index < len(sources) else "" if isinstance(each, Mechanism) else str(each)
        own = dict(mechanism.report)
        with about("position"):
            worked_place(mechanism, position)
        if position:
            own["position"] = position
        if positions is not None:
            own["positions"] = positions
        found.append(Case(mechanism, settings(own, language, mechanism), language, source))
    names = [case.mechanism.name for case in found]
    for number, case in enumerate(found, 1):
        if names.count(case.mechanism.name) > 1:
            case.mechanism = replace(case.mechanism, name=f"{case.mechanism.name} ({number})")
    return found


def _loaded(source: str, language: str) -> Mechanism:
    """The model of a file; one of the gallery has its title in the language."""
    mechanism = load(source)
    if not source.startswith(GALLERY):
        return mechanism
    return replace(mechanism, name=title_said(mechanism.name, language))


def _chosen(names: Iterable[str]) -> list[str]:
    """Names of sections in order; raises RequestError for one that does not exist, the nearest offered."""
    asked = list(names)
    for name in asked:
        if name not in SECTIONS:
            raise RequestError("report.no_section", name=name, hint=listed(name, section_names()))
    return asked or section_names()


Part = Section | str


def _parts(cases: list[Case], chosen: list[str], document: Document) -> Iterator[tuple[list[Case], Part]]:
    """Machines and section in the order of the report; a text is the heading of a machine's part."""
    held: list[str] = []
    for name in [*chosen, ""]:
        if name and not SECTIONS[name].common:
            held.append(name)
            continue
        for case in cases if held else ():
            if len(cases) > 1:
                yield [case], case.mechanism.name
            for own in held:
                yield [case], SECTIONS[own]
        held = []
        if name:
            yield cases, SECTIONS[name]


def _add(document: Document, cases: list[Case], part: Part, *, asked: bool) -> None:
    """Adds a section; what it cannot show becomes a paragraph that says why."""
    if isinstance(part, str):
        document.blocks.append(Heading(literal(part), 1))
        return
    say, first = document.say, cases[0]
    several = not part.common and any(
        isinstance(block, Heading) and block.text == literal(first.mechanism.name)
        for block in document.blocks
    )
    shift = 1 if several else 0
    title = say(f"report.title_{part.name}")
    found: list[Block] = [Heading(title, 1 + shift)]
    text = first.settings.text.get(part.name, "")
    prefix = f"{first.mechanism.name}: " if several else ""
    try:
        for block in chain(_own(text, document) if text else (), part.blocks(cases)):
            if isinstance(block, Paragraph) and block.kind == "missing":
                document.missing.append(say("cli.about", name=prefix + title, cause=_unmarked(block.text)))
            found += [_placed(each, shift, prefix) for each in _parts_of(block, document)]
    except LinkwrightError as error:
        if part.optional and not asked and not text:
            return
        sentence = error.say(document.language)
        found.append(Paragraph(say("report.left_out", sentence=literal(sentence)), "missing"))
        document.missing.append(say("cli.about", name=prefix + title, cause=sentence))
    except Exception as error:
        sentence = say("report.unexpected", kind=type(error).__name__, message=" ".join(str(error).split()))
        found.append(Paragraph(literal(sentence), "missing"))
        document.missing.append(say("cli.about", name=prefix + title, cause=sentence))
        document.broken = True
    document.blocks += found


def _parts_of(block: Block, document: Document) -> Iterator[Block]:
    """A block; of a table that is too wide for a page its parts."""
    if not isinstance(block, Table):
        yield block
        return
    rows = tuple(tuple(typeset(cell) for cell in row) for row in block.rows)
    first, *rest = fitted(replace(block, rows=rows), WIDEST)
    yield first
    for part in rest:
        yield replace(part, caption=document.say("report.continued", caption=block.caption))


def _own(text: str, document: Document) -> Iterator[Block]:
    """The blocks of own text; behind one that cannot be printed as it was meant stands why."""
    for block in own_text(text):
        shown, faults = printable(block)
        yield shown
        for fault in faults:
            yield Paragraph(literal(in_language(fault, document.language)), "missing")


def _unmarked(text: str) -> str:
    from linkwright.report.document import plain

    return plain(text)


def _placed(block: Block, shift: int, prefix: str) -> Block:
    """A block of one of several machines: its headings one level down, its labels the machine's own."""
    if isinstance(block, Heading):
        return replace(block, level=min(block.level + shift, 4))
    if not prefix:
        return block
    if isinstance(block, NUMBERED) and block.label:
        return replace(block, label=f"{prefix}{block.label}")
    if isinstance(block, Paragraph):
        return replace(block, text=block.text.replace("[[", f"[[{prefix}"))
    return block
