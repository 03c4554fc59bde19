"""One position worked out with its numbers, and its polygons."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.plot.svg.render import natural_size
from linkwright.report.case import Case
from linkwright.report.document import Block, Figure, Formula, Heading, Paragraph, literal
from linkwright.report.section import SECTIONS, Section
from linkwright.report.sections.method import side_by_side
from linkwright.worked.page import Equation, Note, Relation, Step

#: A point, the width of the text and the tallest polygon, mm.
POINT, TEXT, TALLEST = 25.4 / 72.0, 170.0, 225.0


@SECTIONS.register("worked")
class WorkedPosition(Section):
    """Every equation of the position with the numbers put in; polygons of velocities, accelerations and forces."""

    name, rank = "worked", 5.0

    def blocks(self, case: Case) -> Iterator[Block]:
        say, solution = case.say, case.worked
        if case.worked_text:
            yield Paragraph(say("report.worked_at", input=literal(case.worked_text)))
        for line in solution.legend:
            yield Paragraph(literal(line))
        for step in solution.steps:
            level = 2 if "." not in step.number else 3
            yield Heading(literal(step.title), level)
            yield from with_numbers(step)
        yield Heading(say("report.polygons"), 2)
        yield from _polygons(case)


def with_numbers(step: Step) -> Iterator[Block]:
    """Sentences and equations of a step; given values side by side."""
    given: list[str] = []
    for item in step.items:
        if isinstance(item, Equation) and not item.formula and not item.numbers:
            given.append(f"{item.latex_symbol} = {_result(item)}")
            continue
        yield from side_by_side(given)
        given = []
        if isinstance(item, Note):
            yield Paragraph(literal(item.text))
        elif isinstance(item, Relation):
            left, right = item.data()["latex"].split(" = ", 1)  # type: ignore[attr-defined]
            yield Formula((left, right), number=False)
        else:
            sides = [item.latex_symbol, item.latex_formula, item.latex_numbers, _result(item)]
            yield Formula(tuple(side for side in sides if side))
    yield from side_by_side(given)


def _result(item: Equation) -> str:
    """The result with its unit."""
    base, e, power = item.result.partition("e")
    number = rf"{base}\cdot 10^{{{power}}}" if e else base
    if item.unit == "°":
        return number + r"^\circ"
    return rf"{number}\,\mathrm{{{item.unit}}}" if item.unit else number


def _polygons(case: Case) -> Iterator[Block]:
    source, _ = case.worked_result
    kinds = ["velocity_polygon", "acceleration_polygon"] if case.mechanism.drivers else []
    if isinstance(source, Forces):
        kinds.append("force_polygon")
    for kind in kinds:
        try:
            picture = case.diagram(kind, source if kind == "force_polygon" else None, at=case.worked_place)
        except LinkwrightError as error:
            yield Paragraph(f"{case.say(f'plot.kind.{kind}')}: {literal(case.told(error))}", "missing")
            continue
        yield to_scale(case, kind, picture)


def to_scale(case: Case, kind: str, picture: str) -> Figure:
    """A polygon in its own size, so that a millimetre is one; where it must be smaller the caption says so."""
    wide, high = (POINT * each for each in natural_size(picture))
    share = min(1.0, TEXT / wide, TALLEST / high)
    caption = case.say(f"report.caption_{kind}")
    if share < 1.0:
        caption = case.say("report.reduced", caption=caption, percent=f"{100 * share:.0f}")
    return Figure(caption, ((picture, share * wide / TEXT),), kind, TALLEST)
