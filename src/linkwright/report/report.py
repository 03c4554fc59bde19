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
from linkwright.report.cover import cover
from linkwright.report.document import (
    NUMBERED,
    Block,
    Document,
    Heading,
    Paragraph,
    Source,
    Sources,
    Table,
    changed,
    fitted,
    literal,
    plain,
    spans,
    texts,
    walk,
    with_prefix,
)
from linkwright.report.machine_results import Case
from linkwright.report.markdown import own_text, own_words
from linkwright.report.numbers import typeset
from linkwright.report.order import Part, chosen, parts
from linkwright.report.section import Section
from linkwright.report.sections.references import own_sources
from linkwright.report.settings import Chapter, Settings, settings, worked_place
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

            if any(isinstance(block, Source) for block in walk(self.document.blocks)):
                self._miss(Sentence("report.typst_in_word").say(self.document.language))
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
#: A model or its file, or a calculation.
Given = Mechanism | str | Problem


def report(
    machines: Machine | Sequence[Machine],
    *,
    sources: Sequence[str] = (),
    sections: Sequence[str] = (),
    language: str = "en",
    position: str = "",
    positions: int | None = None,
    folder: str | Path = "",
    progress: Progress | None = None,
) -> Report:
    """The report of a machine, or of several with their comparison; and of calculations, cams among them.

    Args:
        machines: mechanisms, calculations of machine parts, paths or gallery names.
        sources: the files of mechanisms that are given themselves, for what is read from files (tasks of synthesis).
        sections: names of sections and titles of own chapters in the order wanted; empty: what the first file says,
            else all that apply.
        language: ``en`` or ``zh``.
        position: input of the worked position, such as ``"60 deg"``; else what the file says, else a sixth of the
            cycle.
        positions: numbered positions of the tables, else what the file says, else 24, or 25 where the
            input would be the same in all of them.
        folder: where pictures of own texts are looked for; empty: beside the file of each machine.
        progress: is told how many sections are done, and of how many.

    Returns:
        The report; ``save("report.pdf")``, ``.html``, ``.docx``. A section that cannot be made says so in it, and in
        ``missing``.

    Raises:
        LinkwrightError: an unknown section or language, a model that cannot be read, settings that make no sense.
    """
    require_language(language)
    given = _read(machines)
    models = [each for each in given if not isinstance(each, Problem)]
    cases = _cases(models, sources, language, position, positions, folder)
    problems = [each for each in given if isinstance(each, Problem)]
    own = cases[0].settings if cases else settings(problems[0].report, language, folder=problems[0].folder)
    entries = chosen(sections, own, calculations=not cases)
    names = [
        title_said(each.name, language) if isinstance(each, Problem) else each.mechanism.name
        for each in _in_order(given, cases)
    ]
    document = Document(
        own.title or " / ".join(dict.fromkeys(names)),
        speaker(language),
        language,
        tuple(filter(None, (own.course, own.author, own.date))),
    )
    document.cover = cover(own, document)
    ordered = list(parts(_in_order(given, cases), entries, own, asked=bool(sections)))
    progress = progress or current_progress()
    for done, part in enumerate(ordered):
        if progress is not None:
            progress(done, len(ordered))
        with reporting(None):
            _add_part(document, part, asked=bool(sections))
    _tell_what_leads_nowhere(document)
    return Report(document)


def _in_order(given: Sequence[Given], cases: Sequence[Case]) -> list[Case | Problem]:
    """Machines and calculations in the order in which they are given."""
    machines = iter(cases)
    return [each if isinstance(each, Problem) else next(machines) for each in given]


def _read(machines: Machine | Sequence[Machine]) -> list[Given]:
    """Mechanisms (or their files) and calculations."""
    from linkwright.parts.file import kind_of
    from linkwright.parts.file import load as load_calculation

    given = list(machines) if isinstance(machines, Iterable) and not isinstance(machines, str) else [machines]
    if not given:
        raise RequestError("report.no_machine")
    found: list[Given] = []
    for each in given:
        require(each, Mechanism, Problem, str, PathLike)
        if isinstance(each, Problem | Mechanism):
            found.append(each)
        else:
            calculated = kind_of(str(each)) is not None
            found.append(load_calculation(str(each)) if calculated else str(each))
    return found


def _add_calculation(document: Document, problem: Problem) -> None:
    """Adds a calculation; one without a result says why."""
    from linkwright.report.calculation import OwnText, calculation

    try:
        for block in calculation(problem, document.say, document.language):
            found: Iterable[Block] = (
                _own(block.text, block.own, document, problem.name)
                if isinstance(block, OwnText)
                else (block,)
            )
            document.blocks += (part for each in found for part in _parts_of(each, document))
    except LinkwrightError as error:
        sentence = error.say(document.language)
        document.blocks.append(Heading(literal(problem.name), 1))
        document.blocks.append(
            Paragraph(document.say("report.left_out", sentence=literal(sentence)), "missing")
        )
        document.missing.append(document.say("cli.about", name=problem.name, cause=sentence))


def _cases(
    given: Sequence[Mechanism | str],
    sources: Sequence[str],
    language: str,
    position: str,
    positions: int | None,
    folder: str | Path,
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
        beside = Path(folder or ("" if source.startswith(GALLERY) else Path(source).parent))
        found.append(Case(mechanism, settings(own, language, mechanism, beside), language, source))
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


def _add_part(document: Document, part: Part, *, asked: bool) -> None:
    """Adds what comes next; ``asked``: whether sections were named for this report."""
    if part.section is not None:
        _add(document, part, part.section, asked=asked)
    elif part.chapter is not None:
        _add_chapter(document, part, part.chapter)
    elif part.problem is not None:
        _add_calculation(document, part.problem)
    else:
        document.blocks.append(Heading(literal(part.name), 1))


def _add_chapter(document: Document, part: Part, chapter: Chapter) -> None:
    """Adds an own chapter, within the part of a machine where it belongs to one of several."""
    shift, prefix = (1, f"{part.within}: ") if part.within else (0, "")
    heading = Heading(own_words(chapter.title), 1, chapter.label)
    for block in chain([heading], _own(chapter.text, part.own, document, prefix + chapter.title)):
        document.blocks += [
            new for each in _parts_of(block, document) for new in _placed(each, shift, prefix)
        ]


def _add(document: Document, within: Part, part: Section, *, asked: bool) -> None:
    """Adds a section; what it cannot show becomes a paragraph that says why, and one without content nothing."""
    say, cases = document.say, within.cases
    shift, prefix = (1, f"{within.within}: ") if within.within else (0, "")
    title = say(f"report.title_{part.name}")
    found: list[Block] = []
    text = within.own.text.get(part.name, "")
    own = _own(text, within.own, document, prefix + title) if text else ()
    try:
        for block in chain(own, part.blocks(cases) if cases else own_sources(within.own)):
            if isinstance(block, Paragraph) and block.kind == "missing":
                _miss(document, prefix + title, plain(block.text))
            found += [new for each in _parts_of(block, document) for new in _placed(each, shift, prefix)]
    except LinkwrightError as error:
        if part.optional and not asked and not text:
            return
        sentence = error.say(document.language)
        found.append(Paragraph(say("report.left_out", sentence=literal(sentence)), "missing"))
        _miss(document, prefix + title, sentence)
    except Exception as error:
        sentence = say("report.unexpected", kind=type(error).__name__, message=" ".join(str(error).split()))
        found.append(Paragraph(literal(sentence), "missing"))
        _miss(document, prefix + title, sentence)
        document.broken = True
    if found:
        document.blocks += [Heading(title, 1 + shift), *found]


def _miss(document: Document, title: str, sentence: str) -> None:
    """Notes what a chapter lacks, once."""
    told = document.say("cli.about", name=title, cause=sentence)
    if told not in document.missing:
        document.missing.append(told)


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
            caption = document.say("report.continued", caption=each.caption) if each.caption else ""
            yield replace(part, caption=caption)

    yield from changed(block, parted)


def _own(text: str, own: Settings, document: Document, title: str) -> Iterator[Block]:
    """The blocks of own text; behind one that cannot be printed as it was meant stands why."""
    for block, faults in own_text(text, beside=own.beside):
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


def _tell_what_leads_nowhere(document: Document) -> None:
    """Notes what texts refer to and is not there: labels of blocks, and the list of sources."""
    numbers = document.number()
    parts = [span for block in numbers.blocks for text in texts(block) for span in spans(text)]
    asked = [span.link[1:] for span in parts if span.link[:1] == "#"]
    asked += [span.text for span in parts if span.kind == "reference"]
    for label in dict.fromkeys(asked):
        if label not in numbers.labels:
            document.missing.append(Sentence("report.no_label", label=label).say(document.language))
    listed = any(isinstance(block, Sources) for block in numbers.blocks)
    if any(span.kind == "source" for span in parts) and not listed:
        document.missing.append(Sentence("report.no_list_of_sources").say(document.language))
