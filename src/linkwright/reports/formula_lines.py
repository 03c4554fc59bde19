"""How wide formulas are, and where an equation that is too wide for a page is broken."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from linkwright.equations.latex import LARGE, RELATIONS
from linkwright.equations.notation import (
    EQUAL,
    Accent,
    Atom,
    Bracket,
    Fraction,
    Limits,
    Matrix,
    Node,
    Root,
    Row,
    Script,
)
from linkwright.words.characters import cells

#: Binary signs and relations: a line may break before them.
SIGNS = "+-−=≤≥≈≠"


def lines(row: Row, widest: float) -> Iterator[Row]:
    """A formula in lines no wider than ``widest`` em: broken before signs, inside brackets where it must be."""
    line: list[Node] = []
    for piece in _pieces(row, widest):
        if line and width(Row((*line, *piece))) > widest:
            yield Row(tuple(line))
            line = []
        line += piece
    yield Row(tuple(line))


@dataclass(frozen=True)
class Line:
    """One line of an equation; ``place`` says where it begins: ``left``, ``right`` of the left side, ``below`` it,
    at the equal ``sign`` of the line before, or ``further`` in as what goes on from there."""

    place: str
    row: Row


def set_lines(sides: Sequence[Row], widest: float, left: float) -> Iterator[Line]:
    """Sides joined by equal signs: on one line no wider than ``widest`` em, else the signs below each other.

    Behind a left side wider than ``left`` em a new line begins.
    """
    if len(sides) == 1:
        for number, row in enumerate(lines(sides[0], widest)):
            yield Line("further" if number else "left", row)
        return
    if sum(width(row) for row in sides) + 1.25 * (len(sides) - 1) <= widest:
        first, *rest = sides
        yield Line("left", Row((*first.items, *(each for row in rest for each in (EQUAL, *row.items)))))
        return
    first, *rest = sides
    yield Line("left", first)
    place, margin = ("below", 1.5) if width(first) > left else ("right", width(first) + 1.5)
    room = widest - margin - 1.0
    for side in _joined(rest, room):
        for number, row in enumerate(lines(side, room)):
            yield Line("further", row) if number else Line(place, Row((EQUAL, *row.items)))
        place = "sign"


def _joined(sides: Sequence[Row], room: float) -> Iterator[Row]:
    """Short sides that follow each other share a line."""
    held: Row | None = None
    for side in sides:
        if held is not None and width(held) + width(side) + 1.25 <= room:
            held = Row((*held.items, EQUAL, *side.items))
            continue
        if held is not None:
            yield held
        held = side
    if held is not None:
        yield held


def _pieces(row: Row, widest: float) -> Iterator[list[Node]]:
    """Parts between which a line may break; brackets that are too wide are opened."""
    part: list[Node] = []
    for item in _opened(row, widest):
        breaks = isinstance(item, Atom) and item.kind == "sign" and item.text in f"{SIGNS}⋅"
        if breaks and part and not _leading(part):
            yield part
            part = []
        part.append(item)
    yield part


def _leading(part: Sequence[Node]) -> bool:
    """Whether nothing but a sign or an opening bracket stands there yet: the next sign belongs to it."""
    return all(isinstance(each, Atom) and (each.kind == "sign" or each.text == "(") for each in part)


def _opened(row: Row, widest: float) -> Iterator[Node]:
    for item in row.items:
        if isinstance(item, Bracket) and width(item) > 0.6 * widest:
            yield from (Atom("open", item.left),) if item.left else ()
            yield from _opened(item.inside, widest)
            yield from (Atom("close", item.right),) if item.right else ()
        else:
            yield item


def large(node: Node) -> bool:
    """Whether it is the sign of a sum or an integral."""
    return isinstance(node, Atom) and node.text in LARGE.values()


def relation(node: Node) -> bool:
    """Whether it is a sign between two sides."""
    return isinstance(node, Atom) and node.kind == "sign" and node.text in ("=", "<", ">", *RELATIONS.values())


def width(node: Node | None, size: float = 1.0) -> float:
    """Roughly how wide a formula is printed, in em."""
    match node:
        case None:
            return 0.0
        case Atom("space", text):
            return size * {"quad": 1.0, "qquad": 2.0}.get(text, 0.2)
        case Atom("sign", text):
            return size * (1.25 if text in "+−" or relation(node) else 1.1 if large(node) else 0.35)
        case Atom(_, text):
            return size * 0.54 * cells(text)
        case Row(items):
            return sum(width(each, size) for each in items)
        case Fraction(above, below):
            return max(width(above, size), width(below, size)) + 0.3 * size
        case Root(inside, degree):
            return width(inside, size) + width(degree, 0.5 * size) + 0.9 * size
        case Script(base, below, above):
            return width(base, size) + max(width(below, 0.7 * size), width(above, 0.7 * size))
        case Limits(base, below, above):
            return max(width(base, size), width(below, 0.7 * size), width(above, 0.7 * size))
        case Accent(_, inside):
            return width(inside, size)
        case Bracket(inside):
            return width(inside, size) + 0.8 * size
        case Matrix(rows, left, right):
            columns = (max(width(row[i], size) for row in rows) for i in range(len(rows[0])))
            return sum(columns) + size * (len(rows[0]) - 1 + 0.5 * (bool(left) + bool(right)))
