"""Method: loop equations of each group and the formulas that solve them; one position worked out with its numbers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from linkwright.elements import Group
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
from linkwright.kinetostatics.forces import Forces
from linkwright.pictures.drawing import PIXELS
from linkwright.pictures.svg import natural_size
from linkwright.plotting.diagrams.base import title_of
from linkwright.plotting.diagrams.pages import link_forces
from linkwright.reports.document import (
    Block,
    Figure,
    Formula,
    Heading,
    Paragraph,
    Table,
    literal,
    noted,
    strong,
    symbols,
)
from linkwright.reports.formula import width
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.words import Translate, _
from linkwright.worked_solutions.chains import Chain, chain_closures
from linkwright.worked_solutions.solution import Worked
from linkwright.worked_solutions.symbols import SymbolTable

VECTOR_N = Accent("vec", letter("n"))
#: Width of a line of formulas, em.
LINE = 36.0


@section("method", _("Method"), 4.0)
def method(case: ReportContext) -> Iterator[Block]:
    """Closure of every group as vectors, then the formulas of positions, rates and forces, without numbers."""
    translate, steps = case.translate, list[Step]()
    case.require_position()
    try:
        solution = case.worked
    except LinkwrightError as error:
        yield Paragraph(
            translate(
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
        title = translate(
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
        yield Paragraph(case.translate(_("Closure of its loops:")))
    for left, right in found:
        yield Formula((left, right))


def formulas(step: Step) -> Iterator[Block]:
    """The relations and formulas of a step, its numbers left out."""
    if any(
        item.formula if isinstance(item, Equation) else isinstance(item, Relation | Written) for item in step.items
    ):
        yield Paragraph(strong(symbols(step.title)), "lead")
        yield from step_blocks(step, numbers=False)


def step_blocks(step: Step, *, numbers: bool = True) -> Iterator[Block]:
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
    book = SymbolTable(*case.worked_motion, case.translate)
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


#: A point, the width of the text and the tallest polygon, mm.
TEXT, TALLEST = 170.0, 225.0
#: Links whose force polygons share a page; a page that would be smaller than this share is parted.
ON_PAGE, SMALL = 5, 0.6
#: Captions of polygons.
CAPTIONS = {
    "velocity_polygon": _("Velocity polygon, next to the position"),
    "acceleration_polygon": _("Acceleration polygon, next to the position"),
    "force_polygon": _("Force polygons of the links, group by group"),
}


@section("worked", _("One position worked out"), 5.0)
def worked_position(case: ReportContext) -> Iterator[Block]:
    """Every equation of the position with the numbers put in; polygons of velocities, accelerations and forces."""
    translate = case.translate
    case.require_position()
    if case.worked_text:
        yield Paragraph(translate(_("The position {input} is worked out in full.", input=literal(case.worked_text))))
    try:
        yield from _solution(case.worked)
    except LinkwrightError as error:
        yield Paragraph(
            translate(
                _(
                    "The equations with their numbers cannot be written here, the polygons can be drawn: {sentence}",
                    sentence=literal(case.message(error)),
                )
            ),
            "missing",
        )
    yield Heading(translate(_("Polygons of this position")), 2)
    yield from _polygons(case)


def _solution(solution: Worked) -> Iterator[Block]:
    """All steps of a worked solution."""
    for line in solution.legend:
        yield Paragraph(symbols(line))
    for step in solution.steps:
        yield Heading(symbols(step.title), 2 if "." not in step.number else 3)
        yield from step_blocks(step)


def _polygons(case: ReportContext) -> Iterator[Block]:
    source, index = case.worked_result
    pages: list[tuple[str, list[str]]] = []
    if case.mechanism.drivers:
        pages += [("velocity_polygon", []), ("acceleration_polygon", [])]
    if isinstance(source, Forces):
        pages += [("force_polygon", links) for links in _sheets(source, index)]
    drawn: list[str] = []
    while pages:
        kind, links = pages.pop(0)
        of = {"of": links} if links else {}
        result = source if kind == "force_polygon" else None
        try:
            picture = case.diagram(kind, result, at=case.worked_place, **of)
        except LinkwrightError as error:
            yield Paragraph(f"{case.translate(title_of(kind))}: {literal(case.message(error))}", "missing")
            continue
        if len(links) > 1 and share_of(picture) < SMALL:
            half = len(links) // 2
            pages[:0] = [(kind, links[:half]), (kind, links[half:])]
            continue
        caption = case.translate(CAPTIONS[kind])
        again = kind in drawn
        shown = case.translate(_("{caption} (continued)", caption=caption)) if again else caption
        yield to_scale(case.translate, shown, picture, "" if again else kind)
        drawn.append(kind)


def _sheets(forces: Forces, index: int) -> list[list[str]]:
    """Links whose force polygons share a page: groups in the order of statics, links with three forces or more."""
    sheets: list[list[str]] = [[]]
    found = link_forces(forces, index)
    for group in reversed(forces.motion.structure.groups):
        links = [link for link in reversed(group.links) if len(found.get(link, ())) > 2]
        if sheets[-1] and len(sheets[-1]) + len(links) > ON_PAGE:
            sheets.append([])
        sheets[-1] += links
    return sheets


def share_of(picture: str) -> float:
    """The share of its own size in which a picture fits a page."""
    wide, high = (each / PIXELS for each in natural_size(picture))
    return min(1.0, TEXT / wide, TALLEST / high)


def to_scale(translate: Translate, caption: str, picture: str, label: str = "") -> Figure:
    """A picture in its own size, so that a millimetre is one; where it must be smaller the caption says so."""
    wide, share = natural_size(picture)[0] / PIXELS, share_of(picture)
    if share < 0.995:
        caption = translate(
            _(
                "{caption} (printed at {percent} % of the scale that it states)",
                caption=caption,
                percent=f"{100 * share:.0f}",
            )
        )
    return Figure(caption, ((picture, share * wide / TEXT),), label, TALLEST)
