"""A pair with wheels as a package of its own has it, and what must work with it; run by the installed one."""

#: The module ``drums``: a tape from one drum to another.
PACKAGE = '''
from dataclasses import dataclass
from math import sqrt as sqrt_of
from typing import ClassVar

from linkwright.formula.trace import reciprocal, sqrt
from linkwright.fields.base import Quantities
from linkwright.fields.references import LinkName, LinkNames, PointPair
from linkwright.joints.base import HigherPair
from linkwright.mechanism.wheels_and_cams import WheelSizes, wheel_sizes
from linkwright.plotting.drawing.joint_marks import Mark, marks


@dataclass(frozen=True)
class Tape(HigherPair):
    """A tape wound on the drums ``links`` (a, b) of ``radii``, pinned to ``carrier`` in ``centres``: it runs on their
    right sides, seen from a to b, and r_a (w_a - w_c) = r_b (w_b - w_c)."""

    kind: ClassVar[str] = "tape"
    letter: ClassVar[str] = "T"
    rotations_only: ClassVar[bool] = True
    couples: ClassVar[bool] = True
    links: tuple
    carrier: str
    centres: tuple
    radii: tuple

    @property
    def joined(self):
        return self.links

    @property
    def turning(self):
        return (*self.links, self.carrier)

    @property
    def seats(self):
        return tuple((self.carrier, each) for each in self.centres)

    @classmethod
    def fields(cls):
        return {
            "links": LinkNames(required=True, doc="the two drums [a, b]"),
            "carrier": LinkName(required=True, doc="the link on which both are pinned"),
            "centres": PointPair("carrier", required=True, doc="their pins [P, Q]"),
            "radii": Quantities("length", count=2, required=True, doc="their radii [a, b]"),
        }

    def dimensions(self):
        return {f"{self.name}.radii.{k}": radius for k, radius in enumerate(self.radii)}

    def _factors(self):
        a, b = self.radii
        return dict(zip(self.turning, (a, -b, b - a), strict=True))

    def sums(self, mechanism):
        return self._factors(), {}, 0.0

    def residual(self, at):
        a, b = (at.dimension(f"{self.name}.radii.{k}") for k in (0, 1))
        return [sum(k * at.rotation(link) for k, link in zip((a, -b, b - a), self.turning))]

    def held(self, at, force, size):
        """Its tension pulls the drums together along the tape."""
        a, b = (at.dimension(f"{self.name}.radii.{k}") for k in (0, 1))
        one, other = (at.local(self.carrier, each) for each in self.centres)
        along = at.vector(self.carrier, (other - one) * reciprocal(sqrt((other - one).square)))
        gap = at.point(self.links[1], self.centres[1]) - at.point(self.links[0], self.centres[0])
        sine = (a - b) * reciprocal(sqrt((other - one).square))
        return [(along.cross(gap), -sine * force), (along.dot(gap), -force * sqrt(1.0 - sine * sine))]

    def line(self, mechanism):
        points = mechanism.link(self.carrier).points
        return (complex(*points[each]) for each in self.centres)


@marks.register
def tape_marks(joint: Tape, mechanism, tooth):
    for link, centre, radius in zip(joint.links, joint.centres, joint.radii, strict=True):
        yield Mark("disc", link, mechanism.link(link).points[centre], radius)
    a, b = joint.line(mechanism)
    e, sine = (b - a) / abs(b - a), (joint.radii[0] - joint.radii[1]) / abs(b - a)
    n = e * complex(sine, -sqrt_of(1.0 - sine * sine))
    start, end = a + joint.radii[0] * n, b + joint.radii[1] * n
    yield Mark("strand", joint.carrier, (start.real, start.imag), to=(end.real, end.imag))


@wheel_sizes.register
def tape_sizes(joint: Tape, mechanism):
    a, b = joint.line(mechanism)
    return WheelSizes(joint.links, None, joint.radii, abs(b - a), joint.radii[0] / joint.radii[1])
'''
#: Checks in a process in which the package is installed: against a belt, whose taut strand is the tape.
PROGRAM = r'''
import xml.etree.ElementTree as ET
from linkwright.reports.document import Table
from linkwright.reports.report import report
DRUMS = """
format: 1
name: hoist
frame: {points: {P: [0 m, 0 m], Q: [0.3 m, 0.1 m]}}
links:
  drum: {points: {P: [0 m, 0 m], U: [0.02 m, 0 m]}, mass: 3 kg, inertia: 0.02 kg·m²}
  barrel: {points: {Q: [0 m, 0 m], V: [0.05 m, 0 m]}, mass: 5 kg, inertia: 0.05 kg·m²}
joints: {lift: {PAIR, links: [drum, barrel], carrier: frame, radii: [40 mm, 100 mm]}}
driver: {turn: drum, about: P, speed: 50 rpm}
cycle: {turns: 1}
loads: {weight: {kind: torque, on: barrel, magnitude: 20 N·m}}
"""
def hoist(pair):
    return lw.loads(DRUMS.replace("PAIR", pair))
own, belt = hoist("kind: tape, centres: [P, Q]"), hoist("kind: belt")
found, expected = (lw.solve_forces(lw.solve_motion(m, steps=12)) for m in (own, belt))
for name in ("drum", "barrel"):
    one, two = (f.motion.link(name).angular_velocity for f in (found, expected))
    assert np.abs(one - two).max() < 1e-12, name
for joint, link in (("lift", "barrel"), ("P", "drum"), ("Q", "barrel")):
    one, two = (f.reaction(joint, on=link) for f in (found, expected))
    assert np.abs(one - two).max() < 1e-9 * np.abs(two).max() and np.abs(two).max() > 100.0, (joint, one, two)
assert np.abs(found.input_torque + 20.0 * 40 / 100).max() < 1e-9
assert lw.loads(dump(own)).joints == own.joints
(train,) = lw.structure(own).trains
assert list(train.ratios) == ["drum", "barrel"] and train.pairs == ("lift",)
assert abs(train.ratios["barrel"] - 0.4) < 1e-15
varied = ["lift.radii.0", "lift.radii.1"]
problem = lw.objective(own, "driver.effort rms", vary=varied, steps=12)
value, slope = problem(problem.start)
assert abs(value - 8.0) < 1e-9 and abs(slope[0] - 200.0) < 1e-6 and abs(slope[1] + 80.0) < 1e-6, (value, slope)
open("hoist.yaml", "w").write(dump(own))
tables = [b for b in report("hoist.yaml", sections=["gears"]).document.blocks if isinstance(b, Table)]
(row,) = next(table for table in tables if table.label == "wheels").rows
told = ["lift", "tape", "drum, barrel", "–", "–", "40, 100", "316.228", "–", "2/5"]
assert [str(cell) for cell in row] == told, row
for language in ("en", "zh"):
    made = ["--to", "html", "--lang", language, "--force"]
    assert main(["report", "hoist.yaml", "--sections", "gears", *made]) == 0
assert main(["draw", "hoist.yaml", "--output", "hoist.svg"]) == 0
NS = "{http://www.w3.org/2000/svg}"
drawn = [float(e.get("r")) for e in ET.parse("hoist.svg").iter(NS + "circle") if "lw-gear" in (e.get("class") or "")]
assert len(drawn) == 2 and abs(max(drawn) / min(drawn) - 2.5) < 1e-2, drawn
assert len([e for e in ET.parse("hoist.svg").iter() if "lw-strand" in (e.get("class") or "")]) == 1
print("the drums too")
'''
