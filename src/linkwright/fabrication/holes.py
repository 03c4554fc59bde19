"""Holes of plates: which pin or post goes through each, and whether it is pressed in or turns.

A pin is pressed into its lowest plate, and into all that move with that one; in the others and in rollers it turns,
so that their holes are larger by the fit. A post is pressed into both its plates.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.quantity import shown
from linkwright.errors import RequestError
from linkwright.fabrication.body import Pose, link_poses
from linkwright.fabrication.part import Hole, Part
from linkwright.kinematics.solve import solve_motion
from linkwright.layering.arrangement import Layers
from linkwright.shapes.distance import contains
from linkwright.solids.solid import Solid
from linkwright.words import _

_OUTSIDE = _(
    "the hole for {pin} in {part}, {diameter} in diameter, breaks through the edge; make the link wider there, or "
    "the pin thinner",
    code="cut.hole_outside",
)
_OVERLAP = _(
    "the holes for {pin}, {diameter} in diameter, and {other} in {part} overlap; make the pins thinner",
    code="cut.holes_overlap",
)
#: Places nearer to each other than this share of the machine are one.
SAME = 1e-7


def holes_of(layers: Layers, pose: Assembly) -> Mapping[str, tuple[Hole, ...]]:
    """The holes of all plates, by the names of the plates: what goes through them is where they are when the machine
    is put together at one position."""
    solids = layers.solids.by_name
    pins = [each for each in solids.values() if each.sort in ("pin", "post")]
    found = {}
    for plate in solids.values():
        through = [each for each in pins if plate.name in each.plates]
        if plate.is_plate:
            found[plate.name] = tuple(_holes(layers, pose, plate, through))
    return found


def _holes(layers: Layers, pose: Assembly, plate: Solid, pins: list[Solid]) -> Iterator[Hole]:
    fit = 0.0 if layers.mechanism.construction is None else layers.mechanism.construction.fit
    for centre, radius in plate.shape.holes:
        place = pose.links[plate.carrier].of(centre)
        through = [each for each in pins if abs(pose.axis(each) - place) <= pose.near]
        pin = max(through, key=pin_radius, default=None)  # a pin within a hub does not touch the plate
        if pin is None:
            yield Hole("", centre, radius, False)
        else:
            fixed = plate.name in fixed_plates(layers, pin)
            yield Hole(pin.name, centre, pin_radius(pin) + (0.0 if fixed else 0.5 * fit), fixed)


def axis(pin: Solid) -> complex:
    """Where a pin or post is on what carries it, m."""
    return complex(pin.shape.pieces[0].corners[0])


def hubs_around(layers: Layers, pose: Assembly, pin: Solid) -> list[Solid]:
    """The posts around a pin: hubs that hold a wheel on its link, in which the pin turns."""
    posts = (
        each for each in layers.solids.by_name.values() if each.sort == "post" and {*each.plates} & {*pin.plates}
    )
    return [each for each in posts if abs(pose.axis(each) - pose.axis(pin)) <= pose.near]


def pin_radius(pin: Solid) -> float:
    """The radius of a pin or post, m."""
    return pin.shape.pieces[0].radius


def fixed_plates(layers: Layers, pin: Solid) -> frozenset[str]:
    """The plates into which a pin is pressed: its lowest one and those that move with that, no rollers; of a post all
    of them."""
    solids = layers.solids.by_name
    if pin.sort == "post":
        return frozenset(pin.plates)
    held = [plate for plate in pin.plates if solids[plate].sort != "roller"]
    lowest = min(held, key=lambda plate: layers.height[plate])
    return frozenset(plate for plate in held if solids[plate].carrier == solids[lowest].carrier)


def level_turn(holes: Sequence[Hole]) -> float:
    """Direction (rad, up to a right angle either way) of the line through the two holes that are farthest apart."""
    pairs = [(a.centre, b.centre) for k, a in enumerate(holes) for b in holes[k + 1 :]]
    a, b = max(pairs, key=lambda pair: abs(pair[1] - pair[0]), default=(0j, 1 + 0j))
    turn = cmath.phase(b - a)
    return turn if -0.5 * math.pi < turn <= 0.5 * math.pi else turn - math.copysign(math.pi, turn)


def check_holes(part: Part) -> None:
    """Raises RequestError for a hole that breaks through the edge of its plate or into another hole."""
    edges = [edge for loop in part.edge for edge in loop.edges]
    for k, hole in enumerate(part.holes):
        about = {"pin": hole.pin, "part": part.name, "diameter": shown(2.0 * hole.radius, "length")}
        inside = contains(part.shape, np.array([hole.centre]))[0]
        if not inside or min(edge.distance(hole.centre) for edge in edges) < hole.radius * (1.0 - SAME):
            raise RequestError(_OUTSIDE.format(**about))
        for other in part.holes[:k]:
            if abs(other.centre - hole.centre) < (other.radius + hole.radius) * (1.0 - SAME):
                raise RequestError(_OVERLAP.format(**about, other=other.pin))


@dataclass(frozen=True)
class Assembly:
    """Where the ``links`` are at the first position that is reached; places within ``near`` (m) are one."""

    links: Mapping[str, Pose]
    near: float

    @classmethod
    def of(cls, layers: Layers) -> Assembly:
        """That of a machine."""
        motion = solve_motion(layers.mechanism, failures="mark")
        return cls(link_poses(motion, int(motion.ok.argmax())), SAME * layers.mechanism.size)

    def axis(self, pin: Solid) -> complex:
        """Where a pin or post is, m."""
        return self.links[pin.carrier].of(axis(pin))
