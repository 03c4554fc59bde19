"""Method: loop equations of each group with this machine's symbols, and the formulas that solve them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from linkwright.elements.topology import Group
from linkwright.errors import LinkwrightError
from linkwright.report.document import Block, Formula, Heading, Paragraph, literal, strong, symbols
from linkwright.report.formula import formula, width
from linkwright.report.machine_results import Case
from linkwright.report.section import section
from linkwright.worked.chains import Chain, chain_closures
from linkwright.worked.page import Equation, Note, Relation, Step, Tabulated, Written
from linkwright.worked.symbols import Book, tex

#: Width of a line of formulas, em.
LINE = 36.0


@section("method", 4.0)
def blocks(case: Case) -> Iterator[Block]:
    """Closure of every group as vectors, then the formulas of positions, rates and forces, without numbers."""
    say, steps = case.say, list[Step]()
    case.require_position()
    try:
        solution = case.worked
    except LinkwrightError as error:
        yield Paragraph(say("report.only_loops", sentence=literal(case.told(error))), "missing")
    else:
        steps = list(solution.steps)
        for line in solution.legend[:2]:
            yield Paragraph(symbols(line))
    for number, group in enumerate(case.structure.groups, 1):
        links = literal(", ".join(group.links))
        title = say("report.method_group", number=number, signature=group.signature, links=links)
        own = (formulas(step) for step in steps if step.group == group.name)
        found = [*_loops(case, group), *chain.from_iterable(own)]
        if found:
            yield Heading(title, 2)
            yield from found
    others = [step for step in steps if not step.group and step.number != "1"]
    for step in others:
        if step.equations:
            yield from formulas(step)


def _loops(case: Case, group: Group) -> Iterator[Block]:
    found = loops(case, group)
    if found:
        yield Paragraph(case.say("report.loops_vector"))
    for left, right in found:
        yield Formula((left, right))


def formulas(step: Step) -> Iterator[Block]:
    """The relations and formulas of a step, its numbers left out."""
    shown = [
        item
        for item in step.items
        if not isinstance(item, Tabulated) and (not isinstance(item, Equation) or item.formula)
    ]
    if not any(isinstance(item, Equation | Relation | Written) for item in shown):
        return
    yield Paragraph(strong(symbols(step.title)), "lead")
    held: list[str] = []
    for item in shown:
        if isinstance(item, Equation):
            held.append(f"{item.latex_symbol} = {item.latex_formula}")
            continue
        yield from side_by_side(held)
        held = []
        if isinstance(item, Note):
            yield Paragraph(symbols(item.text))
        else:
            yield Formula(item.latex_sides)
    yield from side_by_side(held)


def side_by_side(formulas: list[str]) -> Iterator[Formula]:
    """Formulas that are short enough share a line."""
    line: list[str] = []
    used = 0.0
    for each in formulas:
        wide = width(formula(each)) + 2.5
        if line and used + wide > LINE:
            yield Formula((r" ,\quad ".join(line),), number=False)
            line, used = [], 0.0
        line.append(each)
        used += wide
    if line:
        yield Formula((r" ,\quad ".join(line),), number=False)


def loops(case: Case, group: Group) -> list[tuple[str, str]]:
    """Left and right side of every loop, LaTeX; for the cut at a guide the component across it.

    Rows of gears and racks are no loops: they stand among the formulas.
    """
    book = Book(*case.worked_motion, case.say)
    found = []
    for closure in chain_closures(book, group):
        first, second = (_sum(chain) for chain in closure.chains)
        if closure.across is not None:
            name = tex(closure.cut.joint)
            first, second = (
                rf"\vec{{n}}_{{\perp {name}}}\cdot \left({each}\right)" for each in (first, second)
            )
            joint = case.mechanism.joints[closure.cut.joint]
            if getattr(joint, "offset", 0.0):
                first = rf"{first} + h_{{{name}}}"
        found.append((first, second))
    return found


def _sum(chain: Chain) -> str:
    """Vectors along a chain, from its base to its tip."""
    found = rf"\vec{{r}}_{{{tex(chain.base.label)}}}"
    for piece in chain.pieces:
        if piece.start.key != piece.end.key:
            found += rf" + \overrightarrow{{{tex(piece.start.label)}{tex(piece.end.label)}}}"
        for step, _, sign in piece.slides:
            name = tex(step.joint)
            found += rf" {'+' if sign > 0 else '-'} s_{{{name}}}\,\vec{{n}}_{{{name}}}"
    return found
