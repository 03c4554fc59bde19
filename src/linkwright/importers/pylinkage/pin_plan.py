"""A machine of pins as pylinkage thinks of it: joints with places, members that hold them, drivers in rad a step."""

from __future__ import annotations

from dataclasses import dataclass, field

from linkwright.importers.json_tree import Json
from linkwright.mechanism.link import Vec


@dataclass
class Line:
    """What a sliding joint moves on: a fixed line (through a place, rad), or the line through two joints."""

    through: Vec = (0.0, 0.0)
    angle: float = 0.0
    joints: tuple[str, str] | None = None


@dataclass
class Tracked:
    """A point of the member with two other joints: distance from the first, angle (rad) from first → second."""

    first: str
    second: str
    distance: float
    angle: float


@dataclass
class Joint:
    """A joint; ``place``: as drawn, in the file's unit; None: not given."""

    name: str
    json: Json
    place: Vec | None = None
    ground: bool = False
    line: Line | None = None
    tracked: Tracked | None = None


@dataclass
class Member:
    """A rigid body that holds joints."""

    name: str
    joints: list[str]
    json: Json


@dataclass
class Driver:
    """A member that turns about a fixed joint; ``rate``: rad a step; ``initial``: the angle of its pin at the start
    (None: as drawn); ``arc``: the angles between which it goes to and fro."""

    member: Member
    motor: str
    pin: str
    rate: float
    initial: float | None
    json: Json
    arc: tuple[float, float] | None = None


@dataclass
class PinPlan:
    """What a file has; ``lengths``: distances of joints where they are given beside their places."""

    root: Json
    joints: dict[str, Joint] = field(default_factory=dict)
    members: list[Member] = field(default_factory=list)
    drivers: list[Driver] = field(default_factory=list)
    lengths: dict[tuple[str, str], float] = field(default_factory=dict)

    def holder(self, *joints: str) -> Member | None:
        """The member that holds all of these joints."""
        return next((each for each in self.members if set(joints) <= set(each.joints)), None)
