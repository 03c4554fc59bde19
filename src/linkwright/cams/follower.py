"""What rides on a cam: where it is guided and what it touches the cam with."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.fields.base import Field, Quantity, Schema, Word, file_key
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Flag
from linkwright.words import _

KINDS = ("roller", "knife", "flat")
MOTIONS = ("translating", "oscillating")


@dataclass(frozen=True)
class Follower:
    """A follower of a disc cam whose centre is the origin; lengths in m, angles in rad.

    ``translating``: it moves up along the line x = ``offset``. ``oscillating``: it turns about a pivot on the x axis
    at ``pivot_distance``; its ``arm`` points back over the cam (``below``: under it), and the lift is the angle by
    which it turns away from the cam. ``roller`` (of ``roller_radius``) and ``knife`` touch at the end of the arm; a
    ``flat`` face is square to a translating follower, and lies along the arm of an oscillating one, ``face_offset``
    from the pivot towards the cam.
    """

    kind: str = file_key(Word(KINDS, required=True, doc=_("what touches the cam")), "roller")
    motion: str = file_key(Word(MOTIONS, doc="default translating"), "translating")
    roller_radius: float = file_key(Quantity("length", above=0.0, doc=_("radius of the roller")), 0.0)
    offset: float = file_key(
        Quantity("length", doc="distance of a translating follower's line to the right of the centre, 0"), 0.0
    )
    pivot_distance: float | None = file_key(
        Quantity("length", above=0.0, doc="from the cam's centre to the pivot"), None
    )
    arm: float | None = file_key(
        Quantity("length", above=0.0, doc="from the pivot to the roller's centre or the edge"), None
    )
    face_offset: float = file_key(
        Quantity("length", doc="of a flat oscillating face: from the pivot towards the cam, 0"), 0.0
    )
    below: bool = file_key(Flag(doc="the arm points under the cam"), False)

    @property
    def oscillating(self) -> bool:
        """Whether it turns about a pivot."""
        return self.motion == "oscillating"

    @property
    def lift_dimension(self) -> str:
        """Dimension of its coordinate: ``angle`` or ``length``."""
        return "angle" if self.oscillating else "length"

    @property
    def side(self) -> float:
        """+1 where the arm points over the cam, -1 below it."""
        return -1.0 if self.below else 1.0

    def start_angle(self, base_radius: float) -> float | None:
        """Angle ψ₀ (rad) of the arm over the line to the cam's centre at zero lift, None where it cannot be.

        Roller and knife: c² + l² - 2cl cos ψ₀ = (r_b + r_r)²; flat: c sin ψ₀ = r_b + f.
        """
        assert self.pivot_distance is not None
        c = self.pivot_distance
        if self.kind == "flat":
            share = (base_radius + self.face_offset) / c
            return math.asin(share) if abs(share) < 1 else None
        assert self.arm is not None
        prime = base_radius + self.roller_radius
        share = (c * c + self.arm**2 - prime**2) / (2 * c * self.arm)
        return math.acos(share) if abs(share) < 1 else None

    def start_height(self, base_radius: float) -> float | None:
        """Height d (m) of a translating trace point above the centre when the lift is zero: √((r_b + r_r)² - e²)."""
        if self.kind == "flat":
            return base_radius
        prime = base_radius + self.roller_radius
        return math.sqrt(prime**2 - self.offset**2) if prime > abs(self.offset) else None


def lift_of(values: Mapping[str, Any]) -> str:
    """Dimension of the lift, by the follower that was read before."""
    follower = values.get("follower")
    return follower.lift_dimension if isinstance(follower, Follower) else "length"


@dataclass(frozen=True)
class LiftQuantity(Field):
    """A quantity of one dimension for a translating follower and of another for an oscillating one."""

    straight: str
    turning: str
    minimum: float | None = None
    above: float | None = None

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        dimension = self.turning if lift_of(siblings) == "angle" else self.straight
        return Quantity(dimension, minimum=self.minimum, above=self.above).read(reader, node, place, siblings)

    def shape(self) -> Schema:
        return {"anyOf": [Quantity(each).shape() for each in (self.straight, self.turning)]}
