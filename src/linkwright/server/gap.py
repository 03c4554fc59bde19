"""Where a drawn machine comes apart: two ends that should meet in one point, and how far they reach."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats, runs
from linkwright.core.outputs import row_name, row_names
from linkwright.core.quantity import shown
from linkwright.drivers.base import Driver
from linkwright.drivers.rocking import Rock
from linkwright.elements import Connection, Group
from linkwright.errors import LinkwrightError
from linkwright.kinematics.input_range import input_range
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.rocking import drawn_range
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.cycle import Cycle
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: Positions to each side of the drawn one that are looked at; how far along a guide, in sizes of the machine.
LOOKS, FAR = 180, 1.5
#: Share of the machine's size by which a driver without limits rocks to each side, where nothing else says how far.
SWAY = 0.25
#: Ranges of the driver that are shown.
RANGES = 4
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_NUMBERED = re.compile(r"(?<=[^\W\d_])\d+$")


def written(name: str) -> str:
    """A point's name as it is drawn: ``O₂`` for ``O2``."""
    return _NUMBERED.sub(lambda found: found[0].translate(_SUBSCRIPTS), name)


def turned_driver(mechanism: Mechanism) -> Driver | None:
    """The only driver, of constant speed other than zero; None of another machine."""
    drivers = list(mechanism.drivers.values())
    return drivers[0] if len(drivers) == 1 and drivers[0].law.own.constant_speed else None


def rocked(mechanism: Mechanism) -> Mechanism | None:
    """The machine rocking between its limits, so that it moves wherever it can; None where that cannot be.

    A driver that finds no limit along its guide goes a little to each side.
    """
    if turned_driver(mechanism) is None:
        return None
    still = replace(mechanism, cycle=None)
    try:
        found = drawn_range(still)
    except LinkwrightError:
        return None
    if found.rotary or (found.start is not None and found.end is not None):
        return replace(mechanism, cycle=Cycle(rock=Rock()))
    drawn, sway = Drawing(still).driver(found.driver) or 0.0, SWAY * mechanism.size
    near = [each for each in (found.start, found.end) if each is not None]
    low = drawn - sway if found.start is None else found.start + 0.01 * abs(drawn - near[0])
    high = drawn + sway if found.end is None else found.end - 0.01 * abs(drawn - near[-1])
    return replace(mechanism, cycle=Cycle(rock=Rock((low, high)))) if low < high else None


@dataclass(frozen=True)
class Arm:
    """One of the two chains that do not meet: a ``link`` on a placed ``pin`` at ``centre`` (m), that reaches
    ``radius`` (m) and ends at ``end``; ``radius`` None: it slides along a guide."""

    link: str
    pin: str
    centre: complex
    radius: float | None
    end: complex


class Gap:
    """The place at which a machine cannot be assembled, for the drawn position of its driver, or for the one that
    lacks most.

    ``motion``: the positions of a turn, or of a way along the guide, those that fail marked; ``drawn``: which of them
    is the drawn one.
    """

    def __init__(self, machine: Mechanism, motion: Motion, drawn: int) -> None:
        self.machine, self.motion, self.drawn = machine, motion, drawn
        self.driver = turned_driver(machine)
        self.failed = np.flatnonzero(motion.outcome_codes != 0)
        self.index = self._worst()
        number = int(abs(motion.outcome_codes[self.index]))
        self.group: Group = motion.structure.groups[number - 1]

    # which position -----------------------------------------------------------------------------
    def _worst(self) -> int:
        """The drawn position where it fails; else the one that lacks most of those that fail."""
        if self.drawn in self.failed:
            return self.drawn
        lacking = np.zeros(self.motion.steps)
        for number, group in enumerate(self.motion.structure.groups, 1):
            own = np.abs(self.motion.outcome_codes) == number
            if not own.any():
                continue
            if group.signature == "RRR":
                d, r1, r2 = self.sides(group)
                lacking[own] = np.maximum(d - r1 - r2, np.abs(r1 - r2) - d)[own]
            elif group.signature == "RRP":
                height, length = self.heights(group)
                lacking[own] = (np.abs(height) - length)[own]
        if lacking.any():
            return int(lacking.argmax())
        return int(self.failed[len(self.failed) // 2])

    def sides(self, group: Group) -> tuple[Floats, Floats, Floats]:
        """Distance of the outer pins and lengths of both links at all positions, m."""
        names = tuple(row_name("fact", group.name, on=fact) for fact in ("distance²", "first²", "second²"))
        with np.errstate(invalid="ignore"):
            d, r1, r2 = np.sqrt(self.rows(names))
        return d, r1, r2

    def rows(self, names: tuple[str, ...]) -> Floats:
        """Outputs at all positions (outputs, n), also where groups after those that they need fail."""
        motion = self.motion
        return np.asarray(motion.solver.evaluate(names, motion.positions, motion.states, motion.modes, motion.design))

    def heights(self, group: Group) -> tuple[Floats, Floats]:
        """Distance of the outer pin from the guide's line and length of the link, m, at all positions of an RRP."""
        height, square = self.rows(tuple(row_name("fact", group.name, on=fact) for fact in ("height", "length²")))
        return height, np.sqrt(square)

    # what is placed -----------------------------------------------------------------------------
    @cached_property
    def placed(self) -> dict[str, complex]:
        """Places of points by their names, as far as groups before the one that fails have them, m."""
        found = {name: complex(*place) for name, place in self.machine.frame.points.items()}
        before = [each for each in self.motion.structure.groups if each.name != self.group.name]
        links = [link for group in before for link in group.links]
        keys = {point: canonical(self.machine, link, point) for link in links for point in self._points(link)}
        wanted = tuple(dict.fromkeys(row for key in keys.values() for row in row_names("position", key)))
        rows = dict(zip(wanted, self.rows(wanted)[:, self.index].tolist(), strict=True)) if wanted else {}
        for point, key in keys.items():
            place = complex(*(rows[row] for row in row_names("position", key)))
            if cmath.isfinite(place):
                found[point] = place
        return found

    def _points(self, link: str) -> Mapping[str, tuple[float, float]]:
        return self.machine.link(link).points

    def _direction(self, link: str) -> complex:
        """Unit vector of a placed link's x axis."""
        if link in self.machine.grounded:
            return 1.0 + 0.0j
        return complex(*self.rows(row_names("direction", link))[:, self.index])

    def _local(self, link: str, point: str) -> complex:
        return complex(*self._points(link)[point])

    # the two ends -------------------------------------------------------------------------------
    @cached_property
    def point(self) -> str:
        """The point in which the two ends should meet."""
        return self.group.inner_joints[0].joint if len(self.group.inner_joints) == 1 else ""

    @cached_property
    def arms(self) -> tuple[Arm, Arm] | None:
        """The two chains; None of a group whose ends cannot be said."""
        if len(self.group.links) != 2 or not self.point:
            return None
        outer = sorted(self.group.outer_joints, key=lambda each: each.joint in self.machine.frame.points)
        try:
            if self.group.signature == "RRR":
                return self._of_pins(outer)
            if sorted(each.letter for each in outer) == ["P", "R"] and self.group.inner_joints[0].turns:
                return self._of_slider(*sorted(outer, key=lambda each: each.letter, reverse=True))
        except KeyError:  # on what is not placed itself
            return None
        return None

    def _own(self, connection: Connection) -> str:
        return connection.a if connection.a in self.group.links else connection.b

    def _of_pins(self, outer: Sequence[Connection]) -> tuple[Arm, Arm]:
        links, pins = [self._own(each) for each in outer], [each.joint for each in outer]
        p, q = (self.placed[pin] for pin in pins)
        r1, r2 = (self._length(link, pin) for link, pin in zip(links, pins, strict=True))
        towards = (q - p) / abs(q - p) if q != p else 1.0 + 0.0j
        far = abs(q - p) > r1 + r2
        # too near: both ends lie beyond the pin of the shorter link
        first = towards if far or r1 > r2 else -towards
        second = -towards if far or r2 > r1 else towards
        return (Arm(links[0], pins[0], p, r1, p + r1 * first), Arm(links[1], pins[1], q, r2, q + r2 * second))

    def _of_slider(self, pin: Connection, guide: Connection) -> tuple[Arm, Arm] | None:
        joint, link, block = self.machine.guides[guide.joint], self._own(pin), self._own(guide)
        if joint.block != block or block == link:
            return None
        centre = self.placed[pin.joint]
        radius = self._length(link, pin.joint)
        along = self._direction(joint.guide) * cmath.exp(1j * joint.direction)
        turn = along * cmath.exp(-1j * joint.block_angle)
        offset = self._local(block, self.point) - self._local(block, joint.at)
        start = self.placed[joint.through] + joint.offset * 1j * along + turn * offset
        foot = start + ((centre - start) * along.conjugate()).real * along
        away = foot - centre
        end = centre + radius * away / abs(away)
        return Arm(link, pin.joint, centre, radius, end), Arm(block, "", foot, None, foot)

    def _length(self, link: str, pin: str) -> float:
        return abs(self._local(link, self.point) - self._local(link, pin))

    @property
    def missing(self) -> float:
        """How far the two ends are from each other, m; 0 where they cannot be said."""
        return abs(self.arms[0].end - self.arms[1].end) if self.arms else 0.0

    @cached_property
    def points(self) -> dict[str, complex]:
        """All points as far as they can be placed; those of the two links as their ends have them."""
        found = {name: place for name, place in self.placed.items() if name != self.point}
        for arm in self.arms or ():
            if arm.radius is None:
                continue
            a, b = self._local(arm.link, arm.pin), self._local(arm.link, self.point)
            turn = (arm.end - arm.centre) / (b - a)
            for name in self._points(arm.link):
                if name != self.point:
                    found.setdefault(name, arm.centre + turn * (self._local(arm.link, name) - a))
        return found

    @cached_property
    def crank(self) -> tuple[str, str] | None:
        """The pivot of the driven link and the pin that it leads the first chain with, on one and the same link."""
        driver, arms = self.driver, self.arms
        if driver is None or not self.rotary or driver.relative_to != "frame" or driver.joint not in self.placed:
            return None
        points = self.machine.link(driver.link).points
        pins = [arms[0].pin] if arms and arms[0].pin in points else [each for each in points if each != driver.joint]
        return (driver.joint, pins[0]) if driver.joint in points and pins and pins[0] in self.placed else None

    @property
    def way(self) -> tuple[complex, float, float] | None:
        """Where the pin of the driven link goes: centre and radius (m), direction (rad) at the driver's zero."""
        if self.crank is None:
            return None
        centre, pin = (self.placed[each] for each in self.crank)
        return centre, abs(pin - centre), cmath.phase(pin - centre) - self.input

    @property
    def at_drawn(self) -> bool:
        """Whether it is the drawn position that cannot be assembled."""
        return self.driver is not None and self.index == self.drawn

    # where it can be assembled ------------------------------------------------------------------
    @cached_property
    def possible(self) -> list[tuple[float, float]]:
        """Ranges of the driver's coordinate in which the machine can be assembled, rad or m."""
        if self.driver is None:
            return []
        found: list[tuple[float, float]] = []
        for start in self._starts():
            if any(low <= start + turn <= high for low, high in found for turn in self._turns):
                continue
            try:
                own = input_range(self.machine.with_dimensions({f"{self.driver.name}.start": start}))
            except LinkwrightError:
                continue
            if own.start is not None and own.end is not None:
                shift = 2 * math.pi * round((own.start + own.end) / (4 * math.pi)) if own.rotary else 0.0
                found.append((own.start - shift, own.end - shift))
        return sorted(found)[:RANGES]

    @property
    def _turns(self) -> tuple[float, ...]:
        return (-2 * math.pi, 0.0, 2 * math.pi) if self.rotary else (0.0,)

    @property
    def rotary(self) -> bool:
        """Whether the driver turns."""
        return all(driver.law.rotary for driver in self.machine.drivers.values())

    def _starts(self) -> Iterator[float]:
        """A coordinate within every run of positions that are reached."""
        if self.motion.solver.motion.next_states:
            yield float(self.motion.input[self.drawn])
            return
        good = self.motion.outcome_codes == 0
        for first, last in sorted(runs(good), key=lambda each: each[0] - each[1]):
            yield float(self.motion.input[(first + last) // 2])

    @property
    def input(self) -> float:
        """The driver's coordinate, rad or m, of one that turns in (-π, π]."""
        q = float(self.motion.input[self.index])
        if not self.rotary:
            return q
        turned = math.remainder(q, 2 * math.pi)
        return turned + 2 * math.pi if turned < 1e-9 - math.pi else turned

    @property
    def input_text(self) -> str:
        """The same as it is written; empty where the machine can be assembled at no position, or has no driver."""
        if not self.machine.drivers or not (self.motion.outcome_codes == 0).any():
            return ""
        return shown(self.input, "angle" if self.rotary else "length", 4).replace("-", "−")

    # words --------------------------------------------------------------------------------------
    @property
    def title(self) -> Message:
        """What is wrong, in a line."""
        if self.arms:
            return _("Ends {point} stay {missing} apart", point=written(self.point), missing=rounded(self.missing))
        return _("{links} cannot be put together", links=tuple(self.group.links))

    @property
    def sentence(self) -> Message:
        """What is needed, and how far the links reach."""
        if not self.arms:
            return self._limits() or _(
                "At {input}: {reason}", input=self.input_text or "–", reason=self.motion.outcomes[self.index]
            )
        first, second = self.arms
        values = {
            "input": self.input_text,
            "first": first.link,
            "second": second.link,
            "from": written(first.pin),
            "to": written(second.pin),
        }
        if second.radius is None or first.radius is None:
            values |= {"needed": rounded(abs(second.end - first.centre)), "reach": rounded(first.radius or 0.0)}
            return (_GUIDED if self.input_text else _GUIDED_NOWHERE).format(**values)
        distance, both = abs(second.centre - first.centre), first.radius + second.radius
        near = distance < both
        reach = abs(first.radius - second.radius) if near else both
        form = _NEAR if near else _FAR
        values |= {"needed": rounded(distance), "reach": rounded(reach)}
        return form[bool(self.input_text)].format(**values)

    def _limits(self) -> Message | None:
        """How far the driver goes, of a group whose ends cannot be said; None where that is not known either."""
        if self.driver is None or not self.possible or self.motion.solver.motion.placed[self.group.name].dyad:
            return None
        kind = "angle" if self.rotary else "length"
        low, high = (shown(each, kind, 4).replace("-", "−") for each in self.possible[0])
        return _(
            "The {link} goes from {low} to {high}; beyond, {links} would come apart.",
            link=self.driver.link,
            low=low,
            high=high,
            links=tuple(self.group.links),
        )


_FAR = (
    _(
        "At no position do the {first} and the {second} meet: as drawn they need {needed} from {from} to {to}, and "
        "together they reach {reach}."
    ),
    _("At {input} the {first} and the {second} need {needed} from {from} to {to}; together they reach {reach}."),
)
_NEAR = (
    _(
        "At no position do the {first} and the {second} meet: as drawn {from} and {to} are {needed} apart, and they "
        "cannot come nearer than {reach}."
    ),
    _("At {input} {from} and {to} are {needed} apart; the {first} and the {second} cannot come nearer than {reach}."),
)
_GUIDED = _("At {input} the {first} needs {needed} from {from} to the guide of the {second}; it reaches {reach}.")
_GUIDED_NOWHERE = _(
    "At no position does the {first} come to the guide of the {second}: as drawn it needs {needed} from {from}, and "
    "it reaches {reach}."
)


def rounded(length: float) -> str:
    """A length as a person says it: whole millimetres, or three digits of a small one."""
    return f"{1e3 * length:.0f} mm" if length >= 0.02 else shown(length, "length", 3)


def explored(mechanism: Mechanism) -> tuple[Motion, int]:
    """Positions of a turn, in whole degrees, or of a way along the guide, each for itself, with the number of the
    drawn one among them; of another machine those of its cycle. Raises as ``solve_motion``."""
    driver = turned_driver(mechanism)
    if driver is None:
        return solve_motion(mechanism, failures="mark"), 0
    still = replace(mechanism, cycle=None)
    drawn = Drawing(still).driver(driver.name)
    middle = driver.law.own.at(0.0) if drawn is None else drawn
    rotary = driver.law.rotary
    step = math.radians(1.0) if rotary else FAR * mechanism.size / LOOKS
    near = round(middle / step) if rotary else middle / step
    whole = step * (near + np.arange(-LOOKS, LOOKS + 1.0))
    q = np.unique(np.append(whole, middle))
    return solve_motion(still, at=q, failures="mark"), int(np.searchsorted(q, middle))


def gap_of(mechanism: Mechanism) -> Gap | None:
    """Where a machine comes apart; None where that is nowhere, or cannot be said. Raises as ``solve_motion``."""
    motion, drawn = explored(mechanism)
    return Gap(motion.mechanism, motion, drawn) if (motion.outcome_codes != 0).any() else None
