"""Parts of a report put into its document: sections, own chapters, calculations; what they lack is noted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from linkwright.errors import LinkwrightError
from linkwright.parts.base import Problem
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
from linkwright.reports.machine_results import Missing
from linkwright.reports.markdown import own_text, own_words
from linkwright.reports.numbers import typeset
from linkwright.reports.order import Part
from linkwright.reports.section import Section
from linkwright.reports.sections.references import own_sources
from linkwright.reports.settings import Chapter, Settings
from linkwright.synthesis.tasks import TaskFile
from linkwright.words import _
from linkwright.words.sentence import in_language

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
    say, language = document.say, document.language
    try:
        for block in (
            task_chapter(problem, part.own, say, language)
            if isinstance(problem, TaskFile)
            else calculation(problem, part.own, say, language)
        ):
            if isinstance(block, Paragraph) and block.kind == "missing":
                _miss(document, name, plain(block.text))
            found = _own(block.text, part.own, document, name) if isinstance(block, OwnText) else (block,)
            document.blocks += (new for each in found for new in _parts_of(each, document))
    except LinkwrightError as error:
        sentence = error.say(document.language)
        document.blocks.append(Heading(literal(name), 1))
        document.blocks.append(
            Paragraph(document.say(_("Left out: {sentence}", sentence=literal(sentence))), "missing")
        )
        _miss(document, name, sentence)


def _add(document: Document, within: Part, part: Section, *, asked: bool) -> None:
    """Adds a section; what it cannot show becomes a paragraph that says why, and one without content nothing."""
    say, cases = document.say, within.cases
    shift, prefix = (1, f"{within.within}: ") if within.within else (0, "")
    title = say(part.title)
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
            sentence = error.say(document.language)
            found.append(Paragraph(say(_("Left out: {sentence}", sentence=literal(sentence))), "missing"))
            _miss(document, prefix + title, sentence)
    except Exception as error:
        sentence = say(
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
    message = document.say(_("{name}: {cause}", name=title, cause=sentence))
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
            caption = document.say(_("{caption} (continued)", caption=each.caption)) if each.caption else ""
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
                _('a text refers to "{label}", but nothing in the report has this label', label=label).say(
                    document.language
                )
            )
    listed = any(isinstance(block, Sources) for block in numbers.blocks)
    if any(span.kind == "source" for span in parts) and not listed:
        document.missing.append(
            _("texts cite sources, but the report has no section references; add it to the sections").say(
                document.language
            )
        )
