"""Positions in worked solutions, piece by piece: points, angles of links, guides and displacements."""

from __future__ import annotations

from linkwright.core.outputs import Output
from linkwright.elements.topology import TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import Pair, Term, cosine, number, sine
from linkwright.worked_solutions.symbols import PointState, Slide, SymbolTable


class Placing:
    """Writes points, angles and displacements, each once; remembers what is known."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self.known: set[str] = set()
        self.angles: set[str] = {"frame"}
        self.guides: set[str] = set()
        self.slid: set[str] = set()

    def point(self, step: Step, spot: PointState, formula: Pair) -> None:
        """Notes where a point is."""
        if spot.key in self.known or spot.fixed:
            return
        self.known.add(spot.key)
        for term, part, c in ((spot.place.x, formula.x, "x"), (spot.place.y, formula.y, "y")):
            step.find(term, part, self.output(spot, "position", c))

    @staticmethod
    def output(spot: PointState, kind: str, component: str) -> str | Output:
        """The output that a point's motion is, or its unit."""
        found = Output(kind, spot.key, component)
        return found.unit if spot.key.endswith("@centre") else found

    def angle(self, step: Step, link: str, formula: Term) -> None:
        """Notes the angle of a link."""
        if link not in self.angles:
            self.angles.add(link)
            turn = self.book.turn(link)
            rounds = round((turn.amount - formula.value) / 360.0)
            turns = number(360.0 * abs(rounds), degrees=True)
            formula = formula - turns if rounds < 0 else formula + turns
            step.find(turn, formula, Output("angle", link))

    def follow(self, step: Step, joint: TreeJoint) -> None:
        """Notes the angle of a link that a guide, a weld or a driver turns."""
        if not (joint.free and joint.turns):
            self.angle(step, joint.child, self._cam_followed(joint))

    def _cam_followed(self, joint: TreeJoint) -> Term:
        """The angle of such a link, from that of its parent."""
        book = self.book
        parent = book.turn(joint.parent)
        if not joint.turns:
            return parent + book.turned(joint)
        assert joint.driver is not None
        q = book.drive(joint.driver)[0]
        return parent + q if joint.child == book.mechanism.drivers[joint.driver].link else parent - q

    def guide(self, step: Step, joint: str) -> Slide:
        """Notes the direction of a guide."""
        slide = self.book.slide(joint)
        if joint not in self.guides:
            self.guides.add(joint)
            turn = self._guide_turn(joint)
            for term, part in ((slide.along.x, cosine(turn)), (slide.along.y, sine(turn))):
                if term.op == "symbol":
                    step.find(term, part, "")
        return slide

    def _guide_turn(self, joint: str) -> Term:
        """Angle of a guide's direction."""
        prismatic = self.book.mechanism.guides[joint]
        own = self.book.degrees(prismatic.direction)
        return self.book.turn(prismatic.guide) + own

    def displacement(self, step: Step, slide: Slide, formula: Term) -> None:
        """Notes the displacement of a block."""
        if slide.joint in self.slid:
            return
        self.slid.add(slide.joint)
        step.find(slide.s, formula, Output("displacement", slide.joint))
