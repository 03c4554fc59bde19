"""The equations of a mechanism in Modelica: unknowns, conditions of joints, drivers' laws as expressions of time."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import singledispatch
from itertools import pairwise
from typing import assert_never

import numpy as np

from linkwright.core.expression_tree import Binary, Call, Negative, Node, Number, Variable
from linkwright.drivers.base import Law
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.expression import ExpressionLaw
from linkwright.drivers.following import Following
from linkwright.drivers.rocking import Harmonic, Rocking
from linkwright.drivers.table import TableLaw
from linkwright.errors import LinkwrightError
from linkwright.exporters.results import Results
from linkwright.joints.base import Joint
from linkwright.joints.lower_pair import RigidJoint, SlidingJoint
from linkwright.kinematics.names import canonical
from linkwright.kinematics.placement import placements
from linkwright.words import _
from linkwright.words.characters import one_line, printable


@dataclass
class Text:
    """Lines of a model's three parts."""

    parameters: list[str] = field(default_factory=list)
    unknowns: list[str] = field(default_factory=list)
    equations: list[str] = field(default_factory=list)


class Equations:
    """The model's text, part by part; starting values are those of the position ``index``."""

    def __init__(self, results: Results, index: int, *, accelerations: bool) -> None:
        self.results, self.index, self.accelerations = results, index, accelerations
        self.motion, self.mechanism = results.motion, results.mechanism
        self.names, self.text = Names(), Text()
        self.known: set[str] = set()
        self.links = {name: self.names.of("link", name) for name in self.mechanism.links}
        self.placed = placements(self.motion)
        self.pins = self.mechanism.pins

    def write(self) -> Text:
        """All lines."""
        for name in self.links:
            self._link(name)
        for name in self.pins:
            self._pin(name)
        for name in self.links:
            self.plain_points(name)
        for guide in self.mechanism.guides.values():
            self._guide(guide)
        for weld in self.mechanism.welds.values():
            self._weld(weld)
        for joint in self.mechanism.joints.values():
            if joint.higher and joint.name not in self.results.structure.redundant:
                self.text.equations.append(f"{self.rolled(joint)} = 0.0;")
        for name in self.mechanism.drivers:
            self._driver(name)
        return self.text

    def unknown(self, name: str, unit: str, start: float, meaning: str) -> None:
        self.text.unknowns.append(f'Real {name}(unit="{unit}", start={number(start)}) {quoted(meaning)};')

    def parameter(self, name: str, unit: str, value: float, meaning: str) -> str:
        self.text.parameters.append(f'parameter Real {name}(unit="{unit}") = {number(value)} {quoted(meaning)};')
        return name

    def _rates(self, name: str, of: str, units: tuple[str, str], meaning: str) -> None:
        """First and, if asked for, second derivative of an unknown."""
        kinds = (("w", "velocity", units[0]), ("a", "acceleration", units[1]))
        for kind, word, unit in kinds[: 2 if self.accelerations else 1]:
            self.text.unknowns.append(f'Real {name}_{kind}(unit="{unit}") {quoted(f"{word} of {meaning}")};')
            self.text.equations.append(f"{name}_{kind} = der({of});")
            of = f"{name}_{kind}"

    def _link(self, name: str) -> None:
        me = self.links[name]
        x, y = self.placed[name].origin[self.index]
        self.unknown(f"{me}_x", "m", x, f"origin of link {name}, x")
        self.unknown(f"{me}_y", "m", y, f"origin of link {name}, y")
        self.unknown(f"{me}_phi", "rad", self.motion.link(name).angle[self.index], f"angle of link {name}")
        self._rates(me, f"{me}_phi", ("rad/s", "rad/s2"), f"link {name} (angular)")

    def _pin(self, name: str) -> None:
        me = self.names.of("pin", name)
        self.point(me, name, f"pin {name}")
        for link in self.pins[name].links:
            self._place(link, name, f"{me}_x", f"{me}_y")

    def plain_points(self, link: str) -> None:
        for point in self.mechanism.links[link].points:
            if point in self.pins and link in self.pins[point].links:
                continue
            me = self.names.of("point", f"{link}.{point}")
            self.point(me, canonical(self.mechanism, link, point), f"point {point} of link {link}")
            self._place(link, point, f"{me}_x", f"{me}_y")

    def point(self, me: str, key: str, meaning: str) -> None:
        held = self._fixed(key)
        x, y = self.mechanism.frame.points[key] if held else self.motion.point_of(key).position[self.index]
        self.unknown(f"{me}_x", "m", x, f"{meaning}, x")
        self.unknown(f"{me}_y", "m", y, f"{meaning}, y")

    def _fixed(self, key: str) -> bool:
        return key in self.pins and "frame" in self.pins[key].links

    def _place(self, link: str, point: str, x: str, y: str) -> None:
        """The point's coordinates from the place of the link."""
        right = self.world(link, point)
        self.text.equations += [f"{x} = {right[0]};", f"{y} = {right[1]};"]

    def world(self, link: str, point: str) -> tuple[str, str]:
        px, py = self.mechanism.link(link).points[point]
        base, meaning = self.names.of("local", f"{link}.{point}"), f"{point} in the axes of {link}"
        a, b = f"{base}_u", f"{base}_v"
        if base not in self.known:
            self.known.add(base)
            self.parameter(a, "m", px, f"{meaning}, x")
            self.parameter(b, "m", py, f"{meaning}, y")
        if link == "frame":
            return a, b
        me = self.links[link]
        return (f"{me}_x + cos({me}_phi)*{a} - sin({me}_phi)*{b}", f"{me}_y + sin({me}_phi)*{a} + cos({me}_phi)*{b}")

    def angle(self, link: str) -> str:
        return "0.0" if link == "frame" else f"{self.links[link]}_phi"

    def _guide(self, joint: SlidingJoint) -> None:
        me = self.names.of("guide", joint.name)
        slide = self.motion.joint(joint.name)
        self.unknown(f"{me}_s", "m", slide.displacement[self.index], f"displacement of the block on {joint.name}")
        self._rates(f"{me}_s", f"{me}_s", ("m/s", "m/s2"), f"the block on {joint.name}")
        turn = self.parameter(f"{me}_direction", "rad", joint.direction, f"direction of {joint.name}")
        offset = self.parameter(f"{me}_offset", "m", joint.offset, "normal distance, left positive")
        block = self.parameter(f"{me}_block_angle", "rad", joint.block_angle, "direction in the axes of the block")
        along = f"({self.angle(joint.guide)} + {turn})"
        (bx, by), (gx, gy) = self.world(joint.block, joint.at), self.world(joint.guide, joint.through)
        self.text.equations += [
            f"{bx} = {gx} + {me}_s*cos{along} - {offset}*sin{along};",
            f"{by} = {gy} + {me}_s*sin{along} + {offset}*cos{along};",
        ]
        if joint.name not in self.results.structure.redundant:
            angles = [self.motion.link(link).angle[self.index] for link in (joint.block, joint.guide)]
            gap = angles[0] + joint.block_angle - angles[1] - joint.direction
            self.text.equations.append(f"{self.angle(joint.block)} + {block} = {along}{turns(gap)};")

    def rolled(self, joint: Joint) -> str:
        """The sum of rotations and displacements that a higher pair keeps, less its value at the start."""
        rotations, slides, _ = joint.sums(self.mechanism)
        terms = [
            (factor, self.angle(link), self.motion.link(link).angle[self.index]) for link, factor in rotations.items()
        ]
        terms += [
            (factor, f"{self.names.of('guide', name)}_s", self.motion.joint(name).displacement[self.index])
            for name, factor in slides.items()
        ]
        start = sum(factor * float(value) for factor, _, value in terms)
        return " + ".join(f"({number(factor)})*{name}" for factor, name, _ in terms) + f" + ({number(-start)})"

    def _weld(self, joint: RigidJoint) -> None:
        a, b = joint.links
        for left, right in zip(self.world(a, joint.at), self.world(b, joint.at), strict=True):
            self.text.equations.append(f"{left} = {right};")
        first, second = (self.motion.link(link).angle[self.index] for link in (a, b))
        turn = self.parameter(
            f"{self.names.of('weld', joint.name)}_angle", "rad", joint.angle, f"angle of {joint.name}"
        )
        self.text.equations.append(
            f"{self.angle(b)} = {self.angle(a)} + {turn}{turns(second - first - joint.angle)};"
        )

    def _driver(self, name: str) -> None:
        driver = self.mechanism.drivers[name]
        begin, end = float(self.motion.time.min()), float(self.motion.time.max())
        me = self.names.of("driver", name)
        rotary = self.motion.positions.rotary[name]
        start = self.motion.inputs[name][self.index]
        self.unknown(f"{me}_q", "rad" if rotary else "m", start, f"coordinate of the driver {name}")
        self.text.equations.append(f"{me}_q = {law_text(driver.law, begin, end)};")
        if not rotary:
            self.text.equations.append(f"{self.names.of('guide', driver.joint)}_s = {me}_q;")
            return
        moved, base = (self.motion.link(link).angle[self.index] for link in (driver.link, driver.relative_to))
        against = "" if driver.relative_to == "frame" else f" - {self.angle(driver.relative_to)}"
        self.text.equations.append(f"{self.angle(driver.link)}{against} = {me}_q{turns(moved - base - start)};")


def turns(angle: float) -> str:
    """Full turns that an equation of angles has to add, as text; nothing where there is none."""
    count = round(angle / (2 * math.pi))
    return f" + {number(2 * math.pi * count)}" if count else ""


def indented(lines: list[str]) -> Iterator[str]:
    """Lines of a part."""
    return (f"  {line}" for line in lines)


def number(value: float) -> str:
    """A number with all its digits."""
    return repr(float(value) + 0.0)


def quoted(text: str) -> str:
    """A text in quotes, on one line."""
    return '"' + one_line(text).replace("\\", "\\\\").replace('"', '\\"') + '"'


class Names:
    """Identifiers for things of the model, each used once; letters beyond ASCII are spelled by their code.

    The model's names are these with an ending (``crank_phi``), so none is a word of the language.
    """

    def __init__(self) -> None:
        self._identifiers: dict[tuple[str, str], str] = {}
        self._used: set[str] = set()

    def of(self, kind: str, name: str) -> str:
        """The identifier of a link, point, guide or driver; the same one for the same ``kind`` and ``name``."""
        if (kind, name) not in self._identifiers:
            base = identifier(name)
            found = base if base not in self._used else f"{kind}_{base}"
            count = 2
            while found in self._used:
                found, count = f"{kind}_{base}_{count}", count + 1
            self._identifiers[kind, name] = found
            self._used.add(found)
        return self._identifiers[kind, name]


def identifier(name: str) -> str:
    """A Modelica identifier that looks like the name."""
    plain = "".join(c if c.isascii() else f"u{ord(c):04x}" for c in printable(name))
    plain = re.sub(r"\W", "_", plain)
    return plain if plain[:1].isalpha() else f"n_{plain}"


@singledispatch
def law_text(law: Law, begin: float, end: float) -> str:
    """A law between two times, s, as an expression of ``time``, of operations that tools can differentiate."""
    raise LinkwrightError(
        _("a driver with the law {law!r} cannot be written as Modelica text", code="export.no_law", law=law.key)
    )


@law_text.register
def _constant_speed(law: ConstantSpeed, begin: float, end: float) -> str:
    return f"{number(law.start)} + ({number(law.speed)})*time"


@law_text.register
def _rocking(law: Rocking, begin: float, end: float) -> str:
    return law_text(law.course, begin, end)


@law_text.register
def _harmonic(law: Harmonic, begin: float, end: float) -> str:
    return f"{number(law.middle)} - ({number(law.swing)})*cos({number(law.pulsation)}*time)"


@law_text.register
def _expression_law(law: ExpressionLaw, begin: float, end: float) -> str:
    parameters = {name: number(value) for name, value in law.parameters.items()}
    return formula(law.expression.tree, {**parameters, "t": "time"})


@law_text.register
def _table_law(law: TableLaw, begin: float, end: float) -> str:
    """By cubic pieces between the times of the table, straight ones of a linear one."""
    nodes = np.asarray(law.times)
    if law.interpolation == "periodic":
        period = nodes[-1] - nodes[0]
        first, last = np.floor((begin - nodes[0]) / period), np.ceil((end - nodes[0]) / period)
        turns = np.arange(first, max(last, first + 1))
        nodes = np.unique(np.concatenate([nodes + turn * period for turn in turns]))
    rows = np.stack([nodes, *law.coordinate(nodes)], axis=1)
    texts = []
    for (left, q, qd, qdd), (right, _unused, _unused2, qdd_next) in pairwise(rows):
        third = (qdd_next - qdd) / (6 * (right - left)) if law.interpolation != "linear" else 0.0
        x = f"(time - ({number(left)}))"
        a, b, c, d = (f"({number(each)})" for each in (q, qd, qdd / 2, third))
        texts.append((right, f"({a} + {x}*({b} + {x}*({c} + {x}*{d})))"))
    text = texts[-1][1]
    for right, piece in reversed(texts[:-1]):
        text = f"(if time < {number(right)} then {piece} else {text})"
    return text


#: Pieces in which the coordinate of a driver that follows a path is written, between two jumps of a derivative.
#: How far inside a piece, as share of it, the course is taken: at an end a derivative may have another piece's value.
PATH_PIECES, INSIDE = 120, 1e-9


@law_text.register
def _following(law: Following, begin: float, end: float) -> str:
    """By quintic pieces that meet coordinate, rate and second derivative at both ends."""
    breaks = law.breaks(begin, end)
    nodes = np.union1d(np.linspace(begin, end, PATH_PIECES + 1), breaks[(breaks > begin) & (breaks < end)])
    text = ""
    for left, right in reversed(list(pairwise(nodes.tolist()))):
        h = right - left
        ends = np.array([left + INSIDE * h, right - INSIDE * h])
        (q, p), (v, w), (a, b) = (row.tolist() for row in law.coordinate(ends))
        dq, dv, da = p - (q + v * h + a * h * h / 2), w - (v + a * h), b - a
        third = (10 * dq - 4 * dv * h + da * h * h / 2) / h**3
        fourth = (-15 * dq + 7 * dv * h - da * h * h) / h**4
        fifth = (6 * dq - 3 * dv * h + da * h * h / 2) / h**5
        x, piece = f"(time - ({number(left)}))", f"({number(fifth)})"
        for each in (fourth, third, a / 2, v, q):
            piece = f"(({number(each)}) + {x}*{piece})"
        text = f"(if time < {number(right)} then {piece} else {text})" if text else piece
    return text


def formula(node: Node, names: dict[str, str]) -> str:
    """An expression; ``names``: replacements of its free names."""
    match node:
        case Number(value):
            return f"({number(value)})"
        case Variable(name):
            return f"({names[name]})"
        case Negative(operand):
            return f"(-{formula(operand, names)})"
        case Binary(sign, left, right):
            return f"({formula(left, names)} {sign} {formula(right, names)})"
        case Call(function, arguments):
            return _call(function, [formula(each, names) for each in arguments])
    assert_never(node)


def _call(function: str, arguments: list[str]) -> str:
    if function == "step":
        return f"(if {arguments[0]} >= 0 then 1.0 else 0.0)"
    if function == "sign":
        x = arguments[0]
        return f"(if {x} > 0 then 1.0 elseif {x} < 0 then -1.0 else 0.0)"
    if function == "abs":
        return f"(if {arguments[0]} >= 0 then {arguments[0]} else -{arguments[0]})"
    if function in ("min", "max"):
        a, b = arguments
        return f"(if {a} {'<' if function == 'min' else '>'} {b} then {a} else {b})"
    return f"{function}({', '.join(arguments)})"
