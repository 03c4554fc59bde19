"""The report of a calculation of machine parts, a cam among them: data, numbers, the way to them, pictures."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.parts.base import Problem, Result
from linkwright.report.document import Block, Figure, Heading, Paragraph, Table, literal, symbols
from linkwright.report.machine_results import picture
from linkwright.words import Say
from linkwright.worked.page import Equation, Note, Step


def calculation(problem: Problem, say: Say, language: str) -> Iterator[Block]:
    """The blocks of one calculation, under a heading with its name; raises LinkwrightError where it has no result."""
    found = problem.solve()
    yield Heading(literal(found.title), 1)
    if problem.source:
        yield Paragraph(say("report.source", source=literal(problem.source)))
    yield from numbers_and_way(found, say, language, 2)


def numbers_and_way(found: Result, say: Say, language: str, level: int) -> Iterator[Block]:
    """Pictures, numbers and the way to them, under headings of a level."""
    yield from _pictures(found, say, language)
    yield Heading(say("report.results"), level)
    for block in found.blocks(say):
        cells = [row.cells(found.area, say) for row in block.rows]
        head = tuple(say(f"report.{key}") for key in ("name", "value", "unit", "remark"))
        if cells:
            yield Table(literal(block.title), head, tuple(tuple(map(literal, row)) for row in cells), "<><<")
        for remark in block.remarks:
            yield Paragraph(literal(str(remark)))
    yield Heading(say("report.way"), level)
    for step in found.steps(say):
        yield Heading(literal(step.title), level + 1)
        yield from _lines(step)


def _pictures(found: Result, say: Say, language: str) -> Iterator[Block]:
    """Its own drawing, where it has one, and its diagrams."""
    draw = getattr(found, "draw", None)
    if draw is not None:
        yield Figure(literal(found.title), ((draw(language=language).svg, 0.5),))
    from linkwright.plot.diagrams.base import RESULT_DIAGRAMS

    for kind in sorted(RESULT_DIAGRAMS, key=lambda each: not RESULT_DIAGRAMS[each].usual):
        if not RESULT_DIAGRAMS[kind].suits(found):
            continue
        try:
            svg = picture(found.plot(kind, language=language, title=""))
        except LinkwrightError as error:
            if RESULT_DIAGRAMS[kind].usual:
                yield Paragraph(literal(error.say(language)), "missing")
            continue
        yield Figure(f"{literal(found.title)}: {say(f'plot.kind.{kind}')}", ((svg, 0.75),))


def _lines(step: Step) -> Iterator[Block]:
    """Sentences and equations of a step; calculations write their formulas as plain text."""
    for item in step.items:
        if isinstance(item, Note):
            yield Paragraph(symbols(item.text.strip()))
        elif isinstance(item, Equation):
            unit = item.unit if item.unit in ("", "°") else f" {item.unit}"
            sides = [item.symbol, item.formula, item.numbers, f"{item.result}{unit}"]
            yield Paragraph(symbols(" = ".join(side for side in sides if side)))
        else:
            yield Paragraph(symbols(item.text))
