"""The closure of a group's loops as vectors, from the chains that the worked solution walks."""

from __future__ import annotations

from linkwright.report.case import Case
from linkwright.structure.group import Group
from linkwright.worked.chains import Chain, chain_closures
from linkwright.worked.symbols import Book, tex


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
