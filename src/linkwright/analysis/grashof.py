"""Grashof type of four-bar loops with the frame."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from math import hypot

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Number, Remark
from linkwright.core.quantity import shown
from linkwright.cycle.summaries import Summary
from linkwright.formula.trace import Scalar, maximum, minimum
from linkwright.joints.lower_pair import TurningJoint
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: A Grashof sum this near to zero, relative to the longest link, is a change point.
EQUAL = 1e-12
#: What the types of loops are.
TYPES = {
    "crank_rocker": _(
        "crank-rocker: s + l < p + q ({s} + {l} < {p} + {q}) and the shortest link {shortest} is next to the frame"
    ),
    "double_crank": _("double crank: s + l < p + q ({s} + {l} < {p} + {q}) and the frame is shortest"),
    "double_rocker": _("double rocker: s + l < p + q ({s} + {l} < {p} + {q}) and the coupler {shortest} is shortest"),
    "change_point": _(
        "change point: s + l = p + q ({s} + {l} = {p} + {q}), so the links can come into one "
        "line and the motion is not determined there"
    ),
    "triple_rocker": _("triple rocker: s + l > p + q ({s} + {l} > {p} + {q}), so no link can turn fully"),
}


@dataclass(frozen=True)
class FourBar:
    """A loop of four pinned links: ``first`` and ``second`` turn about the frame, ``coupler`` between; lengths m, and
    the two pins of every link as LINK.POINT (those of the frame may be of links that are welded to it)."""

    first: str
    coupler: str
    second: str
    lengths: dict[str, float]
    pins: dict[str, tuple[str, str]]

    @property
    def name(self) -> str:
        """Its links, the frame left out."""
        return f"{self.first}–{self.coupler}–{self.second}"

    @property
    def margin(self) -> float:
        """p + q - (s + l), m: positive where the shortest link can turn fully against the others."""
        found = _margin(*self.lengths.values())
        assert isinstance(found, float)
        return found

    @property
    def shortest(self) -> str:
        """The shortest link; of equal ones a side link before the frame."""
        return min(self.lengths, key=lambda link: (self.lengths[link], link == "frame", link == self.coupler))

    @property
    def type(self) -> str:
        """``crank_rocker``, ``double_crank``, ``double_rocker``, ``change_point`` or ``triple_rocker``."""
        if abs(self.margin) <= EQUAL * max(self.lengths.values()):
            return "change_point"
        if self.margin < 0:
            return "triple_rocker"
        return {"frame": "double_crank", self.coupler: "double_rocker"}.get(self.shortest, "crank_rocker")


def _margin(*lengths: Scalar) -> Scalar:
    """The sum of all lengths less twice the shortest and the longest."""
    return sum(lengths) - 2.0 * (reduce(minimum, lengths) + reduce(maximum, lengths))


def four_bars(mechanism: Mechanism) -> tuple[FourBar, ...]:
    """All four-bar loops of pins only that contain the frame, and what is welded to it."""
    pins = mechanism.pins
    ground = mechanism.grounded
    held = {name: next((link for link in joint.links if link in ground), "") for name, joint in pins.items()}
    sides = [(link, pin) for pin in pins if held[pin] for link in pins[pin].links if link not in ground]
    found = []
    for (first, a0), (second, b0) in combinations(sides, 2):
        if first == second or a0 == b0:
            continue
        for a, b, coupler in _couplers(mechanism, pins, (first, a0), (second, b0)):
            ends = {first: (a0, a), coupler: (a, b), second: (b0, b)}
            frame = _ground_place(mechanism, held[b0], b0) - _ground_place(mechanism, held[a0], a0)
            lengths = {"frame": abs(frame)}
            lengths |= {link: _length(mechanism, link, *pair) for link, pair in ends.items()}
            named = {"frame": (f"{held[a0]}.{a0}", f"{held[b0]}.{b0}")}
            named |= {link: (f"{link}.{one}", f"{link}.{other}") for link, (one, other) in ends.items()}
            if min(lengths.values()) > 0:
                found.append(FourBar(first, coupler, second, lengths, named))
    return tuple(found)


def _couplers(
    mechanism: Mechanism, pins: Mapping[str, TurningJoint], first: tuple[str, str], second: tuple[str, str]
) -> Iterator[tuple[str, str, str]]:
    """Pins on both sides and the link between them."""
    on_first = [name for name, joint in pins.items() if first[0] in joint.links and name != first[1]]
    on_second = [name for name, joint in pins.items() if second[0] in joint.links and name != second[1]]
    for a in on_first:
        for b in on_second:
            shared = set(pins[a].links) & set(pins[b].links) - {*mechanism.grounded, first[0], second[0]}
            yield from ((a, b, link) for link in sorted(shared) if a != b)


def _length(mechanism: Mechanism, link: str, a: str, b: str) -> float:
    (xa, ya), (xb, yb) = (mechanism.link(link).points[name] for name in (a, b))
    return hypot(xb - xa, yb - ya)


def _loops(analysis: Analysis) -> tuple[FourBar, ...]:
    mechanism = analysis.motion.mechanism
    return analysis.motion.cached("four-bars", lambda: four_bars(mechanism))


@METRICS.register("grashof")
class Grashof(Metric):
    """p + q - (s + l) of every four-bar loop with the frame, with its type and the conditions that it rests on."""

    label = _("Grashof margin")
    meaning = _(
        "Sum of the two middle lengths minus sum of the shortest and longest of a four-bar "
        "loop; positive where the shortest link can turn fully."
    )

    dimension = "length"
    source = "Grashof 1883; Norton, Design of Machinery, sec. 2.12: s + l ≤ p + q"
    own_values = True

    def suits(self, analysis: Analysis) -> bool:
        return bool(_loops(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for loop in _loops(analysis):
            parts = (Summary(f"distance {a} {b}", "mean") for a, b in loop.pins.values())
            yield Number(loop.name, tuple(parts), _margin)

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for loop in _loops(analysis):
            s, p, q, longest = (shown(v, "length") for v in sorted(loop.lengths.values()))
            sentence = TYPES[loop.type].format(s=s, l=longest, p=p, q=q, shortest=loop.shortest)
            remark = Remark(f"grashof.{loop.type}", sentence, warning=loop.type == "change_point")
            yield self.value(analysis, loop.name, loop.margin, remarks=(remark,))


def _ground_place(mechanism: Mechanism, link: str, point: str) -> complex:
    """Position of a point of the frame, or of a link that is welded to it, in frame axes: x + iy, m."""
    turn, shift = _ground_poses(mechanism)[link]
    return shift + turn * complex(*mechanism.link(link).points[point])


def _ground_poses(mechanism: Mechanism) -> dict[str, tuple[complex, complex]]:
    """Unit turn and shift of the axes of the frame and of every link that is welded to it, also through others."""
    poses = {"frame": (1.0 + 0j, 0j)}
    open_ends = ["frame"]
    while open_ends:
        held = open_ends.pop()
        for weld in mechanism.welds.values():
            other = next((each for each in weld.joined if each not in poses), None)
            if held not in weld.joined or other is None:
                continue
            turn = poses[held][0] * cmath.rect(1.0, weld.turn_of(other, mechanism))
            at = poses[held][1] + poses[held][0] * complex(*mechanism.link(held).points[weld.at])
            poses[other] = (turn, at - turn * complex(*mechanism.link(other).points[weld.at]))
            open_ends.append(other)
    return poses
