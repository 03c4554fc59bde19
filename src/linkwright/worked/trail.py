"""Adding up the parts of a chain whose rotation is known, its unknown slides at zero."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from linkwright.structure.group import TreeJoint
from linkwright.worked.book import Book
from linkwright.worked.chains import attach
from linkwright.worked.terms import NOWHERE, ZERO, Pair, Term, cosine, number, sine, symbol


@dataclass
class Trail:
    """From a point to the end of a chain: ``reach`` with the free slides at zero, and their directions."""

    reach: Pair = NOWHERE
    slides: list[tuple[TreeJoint, Pair, Term]] = field(default_factory=list)


def turned(arm: Pair, angle: Term) -> Pair:
    """A vector of a link's axes, turned by an angle."""
    c, s = cosine(angle), sine(angle)
    return Pair(arm.x * c - arm.y * s, arm.x * s + arm.y * c)


def trail(book: Book, steps: Sequence[TreeJoint], link: str, point: str, end: str, *, local: bool) -> Trail:
    """From ``point`` of ``link`` along ``steps`` to the point ``end`` of the last link.

    ``local``: in the axes of ``link``; otherwise in frame axes, with the angles of all links known.
    """
    found = Trail()
    angle = ZERO if local else book.turn(link)
    for step in steps:
        held = attach(step, step.parent, book)
        found.reach = found.reach + turned(_arm(book, link, point, held), angle)
        if step.slides:
            _slide(book, step, angle, found, local=local)
        angle = _next(book, step, angle) if local else book.turn(step.child)
        link, point = step.child, attach(step, step.child, book)
    found.reach = found.reach + turned(_arm(book, link, point, end), angle)
    return found


def _arm(book: Book, link: str, start: str, end: str) -> Pair:
    if link == "frame":
        return book.spot(link, end).place - book.spot(link, start).place if start != end else NOWHERE
    return book.arm(link, start, end)


def _slide(book: Book, step: TreeJoint, angle: Term, found: Trail, *, local: bool) -> None:
    joint = book.mechanism.guides[step.joint]
    sign = 1 if step.child == joint.block else -1
    slide = book.slide(step.joint)
    along, turn = slide.along, ZERO
    if local:
        own = book.guide_angle(step) if sign > 0 else book.degrees(joint.block_angle)
        turn = merged(angle, own)
        along = Pair(cosine(turn), sine(turn))
    if step.free:
        heading = merged(turn, number(180.0, degrees=True)) if sign < 0 else turn
        found.slides.append((step, along if sign > 0 else -along, heading))
    else:
        shift = along.times(slide.s)
        found.reach = found.reach + (shift if sign > 0 else -shift)
    if joint.offset:
        name = f"h_{step.joint}"
        across = along.perp.times(symbol(name, name, joint.offset))
        found.reach = found.reach + across if sign > 0 else found.reach - across


def merged(a: Term, b: Term) -> Term:
    """Sum of two angles; of plain numbers as one number."""
    if a.op == b.op == "number":
        value = a.amount + b.amount
        return ZERO if value == 0.0 else number(value, degrees=True)
    return a + b


def _next(book: Book, step: TreeJoint, angle: Term) -> Term:
    if step.driver is not None and step.turns:
        q = book.drive(step.driver)[0]
        return angle + q if step.child == book.mechanism.drivers[step.driver].link else angle - q
    return merged(angle, book.turned(step))
