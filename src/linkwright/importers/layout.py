"""A machine as other programs store it: everything where it lies at the start, in frame axes, SI units."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from linkwright.core.data import Plain
from linkwright.errors import Finding, Severity
from linkwright.mechanism.link import Vec
from linkwright.words import Message

#: Name of the fixed body.
FRAME = "frame"


@dataclass
class Body:
    """A rigid body with the places (m, frame axes) of its points as it lies at the start; bodies that share the name
    of a point are pinned there.

    Where bodies disagree about a shared point, their own places give their dimensions, and the machine is assembled
    near them. ``length``: from its first point to the second, where the file gives it beside the places; further
    points are then known in the body's axes. ``centre``: mass
    centre in frame axes; None: not given. ``key``: what the foreign file calls it, for findings.
    """

    name: str
    places: dict[str, Vec] = field(default_factory=dict)
    length: float | None = None
    mass: float = 0.0
    inertia: float = 0.0
    centre: Vec | None = None
    colour: str = ""
    key: str = ""

    @property
    def spread(self) -> bool:
        """Whether its points are at more than one place, so that they show how it lies."""
        return len(set(self.places.values())) > 1

    @property
    def axis(self) -> float:
        """Angle (rad) of the x axis that its link will have: from the first point to the next at another place; 0
        where there is none."""
        first, *others = list(self.places.values()) or [(0.0, 0.0)]
        second = next((each for each in others if each != first), None)
        return 0.0 if second is None else math.atan2(second[1] - first[1], second[0] - first[0])


@dataclass
class Slide:
    """A guide line of body ``guide`` on which the point ``at`` of body ``block`` moves, which does not turn on it.

    The line runs through the guide's point ``through``, in a ``direction`` in frame axes at the start (rad), or from
    one of its points to another. A pin that slides in a slot is a block of one point on the pin. ``offset`` of the
    point from the line (m) and the line's angle in the block, ``block_angle`` (rad), follow from where things lie,
    unless they are given here.
    """

    name: str
    guide: str
    through: str
    direction: float | tuple[str, str]
    block: str
    at: str
    offset: float | None = None
    block_angle: float | None = None


@dataclass
class Wheels:
    """Two bodies that turn together; ``kind`` and ``values`` as in the section ``joints`` (gear, chain, belt, rack,
    rolling): ``Wheels("mesh", "gear", {"links": ["a", "b"], "radii": ["20 mm", "40 mm"]})``."""

    name: str
    kind: str
    values: Plain


@dataclass
class Drive:
    """A driver: ``turn`` a body about a pin against another body, ``slide`` a guide, or the distance ``between`` two
    points as (body, point).

    The law is one of ``speed`` (rad/s or m/s), ``added`` (what is added to the coordinate of the start: an expression
    of t with its units), or ``table`` (times in s, what is added, rad or m, interpolation); none: it is free.
    """

    name: str = "driver"
    turn: str | None = None
    about: str = ""
    against: str = FRAME
    slide: str | None = None
    between: tuple[tuple[str, str], tuple[str, str]] | None = None
    speed: float | None = None
    added: str | None = None
    table: tuple[list[float], list[float], str] | None = None


@dataclass
class Force:
    """A force (N, frame axes at the start) on a point of a body; ``follows``: it turns with the body."""

    name: str
    on: str
    at: str
    components: Vec
    follows: bool = False


@dataclass
class Layout:
    """What a reader found.

    ``unit``: of lengths in the text that is made of it; ``precision``: to which places are known, m (0: all digits
    count), within which numbers are written short; ``centre_precision``: likewise of mass centres. ``traced``:
    points whose paths the file asks for, "body.point". ``loads``: further loads as the section of a model file has
    them; ``cycle`` likewise.
    """

    name: str = ""
    source: str = ""
    unit: str = "mm"
    precision: float = 0.0
    centre_precision: float = 0.0
    frame: Body = field(default_factory=lambda: Body(FRAME))
    bodies: dict[str, Body] = field(default_factory=dict)
    slides: list[Slide] = field(default_factory=list)
    wheels: list[Wheels] = field(default_factory=list)
    drives: list[Drive] = field(default_factory=list)
    forces: list[Force] = field(default_factory=list)
    loads: dict[str, Plain] = field(default_factory=dict)
    gravity: Vec = (0.0, 0.0)
    cycle: Plain | str | None = None
    traced: list[str] = field(default_factory=list)

    def body(self, name: str) -> Body:
        """The body of a name, the frame among them."""
        return self.frame if name == FRAME else self.bodies[name]

    def add(self, body: Body) -> Body:
        """The body, filed under its name."""
        self.bodies[body.name] = body
        return body

    @property
    def all(self) -> list[Body]:
        """The frame and the bodies."""
        return [self.frame, *self.bodies.values()]

    def taken(self) -> set[str]:
        """Names that a driver cannot have: of links, points, guides, wheels, other drivers."""
        points = {point for body in self.all for point in body.places}
        joints = {each.name for each in self.slides} | {each.name for each in self.wheels}
        return points | joints | {each.name for each in self.drives} | self.bodies.keys()

    def drawing(self) -> Mapping[str, Vec]:
        """The place of each point that is not the frame's: that of the first body which has it."""
        found: dict[str, Vec] = {}
        for body in self.bodies.values():
            for point, place in body.places.items():
                if point not in self.frame.places:
                    found.setdefault(point, place)
        return found


class Remarks:
    """Findings about a foreign file, each with its place there; about a second file with those of the first."""

    def __init__(self, file: str, found: list[Finding] | None = None) -> None:
        self.file = file
        self.found = [] if found is None else found

    def remark(
        self,
        severity: Severity,
        message: Message | str,
        remedy: Message | str,
        code: str,
        *,
        line: int = 0,
        column: int = 1,
        key: str = "",
    ) -> None:
        """Notes something about a line (from 1; 0: the whole file); ``key``: what it is about there."""
        where = f"{self.file}:{line}:{column}" if line else self.file
        self.found.append(Finding(severity, where, key, message, remedy, code))

    @property
    def failed(self) -> bool:
        """Whether one of them is an error."""
        return any(each.severity == "error" for each in self.found)


_OUTSIDE = re.compile(r"[^\w'-]+")


def free_name(wanted: str, taken: Collection[str], fallback: str = "p") -> str:
    """A name that a model file takes, as near to the wanted one as it goes, and that is not taken yet."""
    name = _OUTSIDE.sub("_", wanted.strip()).strip("_-'")
    if not name or name[0].isdigit():
        name = f"{fallback}{name}"
    found, number = name, 1
    while found in taken or found == FRAME:
        number += 1
        found = f"{name}_{number}"
    return found
