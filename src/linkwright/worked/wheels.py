"""Groups of wheels and racks alone: rotations and displacements from their pairs' rows, and the tooth forces."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from linkwright.joints.base import Contact
from linkwright.structure.group import Connection, Group, TreeJoint
from linkwright.worked.page import Step
from linkwright.worked.places import Places
from linkwright.worked.symbols import Book, tex
from linkwright.worked.terms import ZERO, Pair, Term, cosine, number, root, sine, symbol, total


@dataclass(frozen=True)
class WheelRow:
    """One pair's row: what every unknown of the group and every known rotation or slide counts in it, in m."""

    cut: Connection
    unknown: list[float]
    rotations: dict[str, float]
    slides: dict[str, float]


class Wheels:
    """Writes the positions and rates of such groups."""

    def __init__(self, book: Book) -> None:
        self.book = book

    def rows(self, group: Group) -> list[WheelRow]:
        """The rows of a group's pairs, scaled so that their multipliers are forces."""
        found = []
        for cut in group.cuts:
            joint = self.book.mechanism.joints[cut.joint]
            rotations, slides, _ = joint.sums(self.book.mechanism)
            scale = joint.contact(self.book.mechanism).scale
            unknown = [0.0] * len(group.unknowns)
            left: dict[str, float] = {}
            for link, factor in rotations.items():
                source = self._source(group, link)
                if source is None:
                    left[link] = scale * factor
                else:
                    unknown[group.unknowns.index(source)] += scale * factor
            free = {step.joint: step for step in group.unknowns if step.slides}
            kept = {}
            for name, factor in slides.items():
                if name in free:
                    unknown[group.unknowns.index(free[name])] += scale * factor
                else:
                    kept[name] = scale * factor
            found.append(WheelRow(cut, unknown, {k: v for k, v in left.items() if k != "frame"}, kept))
        return found

    @staticmethod
    def _source(group: Group, link: str) -> TreeJoint | None:
        """The free pin of the group with which a link turns."""
        for step in group.path(link):
            if step.free and step.turns:
                return step
        return None

    def positions(self, step: Step, places: Places, group: Group) -> None:
        """Rotations and displacements, as the pairs add them up."""
        book = self.book
        step.say(book.say("worked.wheels", joints=", ".join(cut.joint for cut in group.cuts)))
        for joint in group.unknowns:
            if joint.slides:
                slide = places.guide(step, joint.joint)
                if joint.joint not in places.slid:
                    places.slid.add(joint.joint)
                    step.give(slide.s, "m", f"{joint.joint}.displacement [m]")
            elif joint.child not in places.angles:
                places.angles.add(joint.child)
                step.give(book.turn(joint.child), "°", f"{joint.child}.angle [rad]")

    def rates(self, step: Step, group: Group, *, second: bool) -> None:
        """Velocities or accelerations of the unknowns: every row is linear in them."""
        book = self.book
        names = [self._rate(joint, second) for joint in group.unknowns]
        rows = self.rows(group)
        rests = [self._rest(row, second) for row in rows]
        if all(rest.is_zero for rest in rests):
            return
        step.say(book.say("worked.wheel_rates", joints=", ".join(row.cut.joint for row in rows)))
        if len(rows) == 1:
            name, unit, column = names[0]
            step.find(name, -rests[0] / number(rows[0].unknown[0]), unit, column)
            return
        for name, unit, column in names:
            step.give(name, unit, column)
        for row, rest in zip(rows, rests, strict=True):
            left = total([number(k) * name for k, (name, _, _) in zip(row.unknown, names, strict=True) if k])
            step.find(symbol("0", "0", 0.0), left + rest, "")

    def _rest(self, row: WheelRow, second: bool) -> Term:
        book = self.book
        turns = [
            number(k) * (book.alpha(link) if second else book.omega(link))
            for link, k in row.rotations.items()
        ]
        slides = [book.slide(name) for name in row.slides]
        moved = [
            number(k) * (slide.second if second else slide.rate)
            for slide, k in zip(slides, row.slides.values(), strict=True)
        ]
        return total([*turns, *moved])

    def _rate(self, joint: TreeJoint, second: bool) -> tuple[Term, str, str]:
        word, unit = ("acceleration", "/s²") if second else ("velocity", "/s")
        if joint.slides:
            slide = self.book.slide(joint.joint)
            return slide.second if second else slide.rate, f"m{unit}", f"{joint.joint}.{word} [m{unit}]"
        rate = self.book.alpha(joint.child) if second else self.book.omega(joint.child)
        return rate, f"rad{unit}", f"{joint.child}.angular_{word} [rad{unit}]"

    # forces -----------------------------------------------------------------------------------
    def multipliers(self, step: Step, group: Group, right: list[Term]) -> list[Term]:
        """The tangential force of every pair, from the moments on the unknowns."""
        rows = self.rows(group)
        named = [symbol(f"T_{r.cut.joint}", f"T_{{{tex(r.cut.joint)}}}", 0.0) for r in rows]
        matrix = np.array([r.unknown for r in rows]).T
        values = np.linalg.solve(matrix, np.array([term.value for term in right]))
        named = [symbol(n.plain, n.latex, float(value)) for n, value in zip(named, values, strict=True)]
        if len(rows) == 1:
            if right[0].is_zero:
                step.give(named[0], "N")
            else:
                step.find(named[0], right[0] / number(rows[0].unknown[0]), "N")
            return named
        for term in named:
            step.give(term, "N")
        for j, goal in enumerate(right):
            left = total([number(r.unknown[j]) * t for r, t in zip(rows, named, strict=True) if r.unknown[j]])
            step.find(symbol("0", "0", 0.0) if goal.is_zero else goal, left, "")
        return named

    def contact(self, cut: Connection, force: Term) -> tuple[Pair, Pair, Term]:
        """Force on the pair's first link, where it acts, and its couple there, from the tangential force."""
        book = self.book
        contact = book.mechanism.joints[cut.joint].contact(book.mechanism)
        along = self._along(contact)
        link, point = contact.at
        place = book.spot(link, point).place
        pushed = along.perp.times(number(contact.across) * force)
        if contact.press:
            pushed = pushed + along.times(number(contact.press) * root(force.squared))
        if contact.steady:
            pushed = pushed + along.times(number(contact.steady))
        couple = number(contact.couple) * force if contact.couple else ZERO
        return pushed, place + along.times(number(contact.reach)) if contact.reach else place, couple

    def _along(self, contact: Contact) -> Pair:
        turn = self.book.turn(contact.link) + number(
            float(f"{math.degrees(contact.angle):.13g}"), degrees=True
        )
        if contact.angle == 0.0:
            turn = self.book.turn(contact.link)
        return Pair(cosine(turn), sine(turn))
