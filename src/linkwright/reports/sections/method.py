"""Method: loop equations of each group with this machine's symbols, and the formulas that solve them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from linkwright.elements.topology import Group
from linkwright.equations.notation import (
    COMMA,
    EQUAL,
    THIN,
    TIMES,
    Accent,
    Atom,
    Bracket,
    Node,
    Row,
    Script,
    label,
    letter,
    row,
    sign,
)
from linkwright.equations.steps import Equation, Note, Relation, Step, Tabulated, Written
from linkwright.errors import LinkwrightError
from linkwright.reports.document import Block, Formula, Heading, Paragraph, Table, literal, noted, strong, symbols
from linkwright.reports.formula_lines import width
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.words import _
from linkwright.worked_solutions.chains import Chain, chain_closures
from linkwright.worked_solutions.symbols import SymbolTable

VECTOR_N = Accent("vec", letter("n"))
#: Width of a line of formulas, em.
LINE = 36.0


@section("method", _("Method"), 4.0)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Closure of every group as vectors, then the formulas of positions, rates and forces, without numbers."""
    say, steps = case.say, list[Step]()
    case.require_position()
    try:
        solution = case.worked
    except LinkwrightError as error:
        yield Paragraph(
            say(
                _(
                    "The equations of the groups cannot be written here, their loops can: {sentence}",
                    sentence=literal(case.message(error)),
                )
            ),
            "missing",
        )
    else:
        steps = list(solution.steps)
        for line in solution.legend[:2]:
            yield Paragraph(symbols(line))
    for number, group in enumerate(case.structure.groups, 1):
        links = literal(", ".join(group.links))
        title = say(
            _("Step {number}: {signature}, links {links}", number=number, signature=group.signature, links=links)
        )
        own = (formulas(step) for step in steps if step.group == group.name)
        found = [*_loops(case, group), *chain.from_iterable(own)]
        if found:
            yield Heading(title, 2)
            yield from found
    others = [step for step in steps if not step.group and step.number != "1"]
    for step in others:
        if step.equations:
            yield from formulas(step)


def _loops(case: ReportContext, group: Group) -> Iterator[Block]:
    found = loops(case, group)
    if found:
        yield Paragraph(case.say(_("Closure of its loops:")))
    for left, right in found:
        yield Formula((left, right))


def formulas(step: Step) -> Iterator[Block]:
    """The relations and formulas of a step, its numbers left out."""
    if any(
        item.formula if isinstance(item, Equation) else isinstance(item, Relation | Written) for item in step.items
    ):
        yield Paragraph(strong(symbols(step.title)), "lead")
        yield from printed(step, numbers=False)


def printed(step: Step, *, numbers: bool = True) -> Iterator[Block]:
    """Sentences and equations of a step, given values side by side; without ``numbers`` the formulas alone."""
    held: list[Row] = []
    for item in step.items:
        if isinstance(item, Equation) and not (numbers and (item.formula or item.filled)):
            right = item.sides[-1] if numbers else item.printed_formula
            held += [row((item.printed_symbol, EQUAL, right))] if right.items else []
            continue
        if isinstance(item, Tabulated) and not numbers:
            continue
        yield from side_by_side(held)
        held = []
        if isinstance(item, Note):
            yield Paragraph(symbols(item.text))
        elif isinstance(item, Tabulated):
            rows = tuple(tuple(map(symbols, cells)) for cells in item.rows)
            yield Table(symbols(item.title), tuple(map(symbols, item.head)), rows, item.align)
        elif isinstance(item, Written) and item.cells and numbers:
            yield _system(item)
        else:
            yield Formula(item.sides, number=isinstance(item, Equation) or not numbers)
    yield from side_by_side(held)


def _system(item: Written) -> Table:
    """A system of equations that is too wide for a formula, as a table."""
    head, *rows = item.cells
    names = tuple(noted(each) if each else "" for each in head)
    body = tuple((literal(first), *others) for first, *others in rows)
    return Table(noted("A X = B"), names, body, "<" + ">" * (len(head) - 1))


def side_by_side(formulas: list[Row]) -> Iterator[Formula]:
    """Formulas that are short enough share a line."""
    line: list[Node] = []
    for each in formulas:
        if line and width(Row((*line, *each.items))) > LINE:
            yield Formula((Row(tuple(line)),), number=False)
            line = []
        line += [*((COMMA, Atom("space", "quad")) if line else ()), *each.items]
    if line:
        yield Formula((Row(tuple(line)),), number=False)


def loops(case: ReportContext, group: Group) -> list[tuple[Row, Row]]:
    """Left and right side of every loop; for the cut at a guide the component across it.

    Rows of gears and racks are no loops: they stand among the formulas.
    """
    book = SymbolTable(*case.worked_motion, case.say)
    found = []
    for closure in chain_closures(book, group):
        first, second = (_sum(chain) for chain in closure.chains)
        if closure.across is not None:
            name = closure.cut.joint
            across = Script(VECTOR_N, row((sign("⊥"), label(name))))
            first, second = (Row((across, TIMES, Bracket(each))) for each in (first, second))
            if getattr(case.mechanism.joints[name], "offset", 0.0):
                first = row((first, sign("+"), Script(letter("h"), label(name))))
        found.append((first, second))
    return found


def _sum(chain: Chain) -> Row:
    """Vectors along a chain, from its base to its tip."""
    found: list[Node] = [Script(Accent("vec", letter("r")), label(chain.base.label))]
    for piece in chain.pieces:
        if piece.start.key != piece.end.key:
            ends = Row((label(piece.start.label), label(piece.end.label)))
            found += [sign("+"), Accent("overrightarrow", ends)]
        for step, _unused, way in piece.slides:
            at = label(step.joint)
            found += [sign("+" if way > 0 else "-"), Script(letter("s"), at), THIN, Script(VECTOR_N, at)]
    return Row(tuple(found))
