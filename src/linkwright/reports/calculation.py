"""A calculation of machine parts as a chapter of a report: purpose, given data, sketch, the worked way, results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from linkwright.core.table import Table
from linkwright.errors import LinkwrightError
from linkwright.parts.base import Problem, Result
from linkwright.reports.document import Block, Figure, Heading, Paragraph, literal, noted, printed, symbols
from linkwright.reports.given_data import given_data
from linkwright.reports.machine_results import picture
from linkwright.reports.section import SECTIONS
from linkwright.reports.sections import method
from linkwright.reports.sections.errata import errata_blocks
from linkwright.reports.sections.worked_position import to_scale
from linkwright.reports.settings import Settings
from linkwright.words import Message, Translate, _
from linkwright.words.sentence import in_language

#: Sections of machines' reports whose own text follows a heading of a calculation, by the heading.
PLACES: Mapping[Message, str] = {_("Purpose"): "task", _("Sketch"): "drawing", _("Solution"): "worked"}
#: Share of the page's width of a sketch, and its maximum height, mm.
WIDE, TALLEST = 0.8, 90.0


@dataclass(frozen=True)
class OwnText:
    """The user's own text at its place in a chapter."""

    text: str


def calculation(problem: Problem, own: Settings, say: Translate, language: str) -> Iterator[Block | OwnText]:
    """The blocks of one calculation with the settings of its file, under a heading with its name; raises
    LinkwrightError where it has no result."""
    found = problem.solve()
    texts = dict(own.text)
    places = {say(heading): name for heading, name in PLACES.items()}
    for block in _chapters(problem, found, own, say, language):
        yield block
        name = places.get(block.text) if isinstance(block, Heading) else None
        if name is not None and name in texts:
            yield OwnText(texts.pop(name))
    for name, text in texts.items():
        yield Heading(say(SECTIONS[name].title), 2)
        yield OwnText(text)
    if own.errata:
        yield Heading(say(_("Mistakes of the source")), 2)
        yield from errata_blocks(own.errata, in_language(own.source or problem.source, language), say)


def _chapters(problem: Problem, found: Result, own: Settings, say: Translate, language: str) -> Iterator[Block]:
    """Heading, purpose, given data, sketch, solution and results."""
    yield Heading(literal(in_language(found.title, language)), 1)
    purpose, source = (
        in_language(each, language) for each in (own.purpose or problem.purpose, own.source or problem.source)
    )
    if purpose or source:
        yield Heading(say(_("Purpose")), 2)
        if purpose:
            yield Paragraph(literal(purpose))
        if source:
            yield Paragraph(say(_("Source: {source}.", source=literal(source))))
    data = list(given_data(problem, say))
    if data:
        yield Heading(say(_("Given data")), 2)
        yield from data
    yield from _sketch(problem, say, language)
    yield from numbers_and_way(found, say, language, 2)


def numbers_and_way(found: Result, say: Translate, language: str, level: int) -> Iterator[Block]:
    """The worked way, the numbers, and diagrams of them, under headings of a level."""
    yield Heading(say(_("Solution")), level)
    for step in found.tidy_steps(say):
        yield Heading(symbols(step.title), level + 1)
        yield from method.printed(step)
    yield Heading(say(_("Results")), level)
    yield from _results(found, say, language)
    yield from _pictures(found, say, language)


def _results(found: Result, say: Translate, language: str) -> Iterator[Block]:
    head = (_("name"), _("value"), _("unit"), _("remark"))
    for table in found.tables(language)[1:]:
        width = 4 if any(row[3] for row in table.rows) else 3
        if table.rows:
            title, rows = (
                literal(in_language(table.title, language)) or _("Results"),
                [row[:width] for row in table.rows],
            )
            yield printed(Table(head[:width], rows, "<><<"[:width], title), language, first=_label)
        for remark in table.notes:
            yield Paragraph(literal(in_language(remark, language)))


def _label(text: str) -> str:
    """A label of a table: a symbol as a formula, words as they are."""
    bare = text.strip()
    short = len(bare) <= 4 or "." in bare or "_" in bare
    if (
        short
        and bare.isprintable()
        and " " not in bare
        and not any(c > "\u2e7f" for c in bare)
        and not bare.islower()
        and any(c.isalpha() for c in bare)
    ):
        return noted(bare)
    return symbols(text)


def _sketch(problem: Problem, say: Translate, language: str) -> Iterator[Block]:
    """The sketch of what is calculated, where its kind has one."""
    from linkwright.plotting.sketches.base import sketch

    try:
        drawn = sketch(problem, language)
    except LinkwrightError as error:
        yield Paragraph(literal(error.say(language)), "missing")
        return
    if drawn is not None:
        yield Heading(say(_("Sketch")), 2)
        yield Figure(
            say(_("Supports, loads and dimensions: {name}", name=literal(in_language(problem.name, language)))),
            ((drawn.svg, WIDE),),
            tallest=TALLEST,
        )


def _pictures(found: Result, say: Translate, language: str) -> Iterator[Block]:
    """Its own drawing, where it has one, and its diagrams."""
    draw = getattr(found, "draw", None)
    if draw is not None:
        yield Figure(literal(in_language(found.title, language)), ((draw(language=language).svg, 0.5),))
    from linkwright.plotting.diagrams.base import RESULT_DIAGRAMS

    for kind in sorted(RESULT_DIAGRAMS, key=lambda each: not RESULT_DIAGRAMS[each].usual):
        if not RESULT_DIAGRAMS[kind].suits(found):
            continue
        try:
            svg = picture(found.plot(kind, language=language, title=""))
        except LinkwrightError as error:
            if RESULT_DIAGRAMS[kind].usual:
                yield Paragraph(literal(error.say(language)), "missing")
            continue
        caption = f"{literal(in_language(found.title, language))}: {say(RESULT_DIAGRAMS[kind].title)}"
        yield (to_scale(say, caption, svg) if RESULT_DIAGRAMS[kind].to_scale else Figure(caption, ((svg, 0.75),)))
