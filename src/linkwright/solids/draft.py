"""The solids of a machine in the making."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.joints.cam import CamJoint
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import Placement, placements
from linkwright.mechanism.construction import Construction
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.plate import material_of
from linkwright.shapes.shape import Shape
from linkwright.sizing.sizes import Sizes
from linkwright.solids.carriers import Carriers
from linkwright.solids.slots import Slot
from linkwright.solids.solid import Solid, Solids, Sort
from linkwright.words import Message

#: Places nearer to each other than this share of a machine are one.
SAME = 1e-9


@dataclass
class Body:
    """Links that move as one: their ``carrier``, the ``links``, what the plate of theirs is to hold.

    ``slots`` that are cut into the plate; ``fixed``: places (in the carrier's axes, m) that it reaches besides the
    points, those of the posts of one guide, ring or rack together; ``plate``: its name, empty where there is none;
    ``shape``: that of the plate instead of the links' own.
    """

    carrier: str
    links: tuple[str, ...]
    slots: list[Slot] = field(default_factory=list)
    fixed: list[tuple[complex, ...]] = field(default_factory=list)
    plate: str = ""
    sort: Sort = "link"
    shape: Shape | None = None

    @property
    def held(self) -> list[complex]:
        """All places that the plate reaches besides the points of the links."""
        return [each for places in self.fixed for each in places]


@dataclass
class Draft:
    """A machine with its motion and sizes, and what of its solids is there already."""

    mechanism: Mechanism
    motion: Motion
    sizes: Sizes
    solids: dict[str, Solid] = field(default_factory=dict)
    level: list[tuple[str, str]] = field(default_factory=list)
    joined: set[tuple[str, str]] = field(default_factory=set)
    notes: dict[Message, None] = field(default_factory=dict)
    bores: dict[str, dict[complex, float]] = field(default_factory=dict)

    @cached_property
    def carriers(self) -> Carriers:
        """Which links move as one."""
        return Carriers(self.mechanism)

    @cached_property
    def bodies(self) -> Mapping[str, Body]:
        """Links that move as one by the names of their carriers."""
        return {carrier: Body(carrier, links) for carrier, links in self.carriers.groups()}

    @cached_property
    def placed(self) -> Mapping[str, Placement]:
        """Where the links are at all positions."""
        return placements(self.motion)

    @cached_property
    def construction(self) -> Construction:
        """How the machine is made: as its file says, else as usual."""
        return self.mechanism.construction or Construction()

    @property
    def near(self) -> float:
        """What is nearer to each other than this is at one place, m."""
        return SAME * self.mechanism.size

    def body(self, link: str) -> Body:
        """The links with which a link moves."""
        return self.bodies[self.carriers.carrier(link)]

    def width(self, body: Body) -> float:
        """The width of the plate of some links, m."""
        return max(self.sizes.width[link] for link in body.links)

    def points(self, body: Body) -> list[complex]:
        """All places of the points of some links, each once, in the carrier's axes, m."""
        found: list[complex] = []
        for link in body.links:
            for point in self.mechanism.link(link).points:
                place = self.carriers.place(link, point)
                if not any(abs(place - each) <= self.near for each in found):
                    found.append(place)
        return found

    def pinned(self, body: Body) -> list[tuple[str, complex]]:
        """Pins in some links with their places in the carrier's axes."""
        return [
            (name, self.carriers.place(link, name))
            for name, pin in self.mechanism.pins.items()
            for link in pin.joined
            if link in body.links
        ]

    def rollers(self, body: Body) -> Iterator[CamJoint]:
        """The cams on which rollers of some links run."""
        for joint in self.mechanism.joints.values():
            if (
                isinstance(joint, CamJoint)
                and joint.centre
                and joint.touch == "roller"
                and joint.follower in body.links
            ):
                yield joint

    def add(self, solid: Solid, *joined: str) -> None:
        """Adds a solid that touches others, by their names."""
        self.solids[solid.name] = solid
        self.join(solid.name, *joined)

    def join(self, name: str, *others: str) -> None:
        """Says that a solid is meant to touch others."""
        self.joined |= {(min(name, each), max(name, each)) for each in others if each and each != name}

    def known(self, name: str) -> str:
        """The name of a solid; empty where there is none of that name."""
        return name if name in self.solids else ""

    def free_name(self, name: str) -> str:
        """A name that no solid has: this one, or with a number."""
        names = (name, *(f"{name} {number}" for number in range(2, len(self.solids) + 3)))
        return next(each for each in names if each not in self.solids)

    def plate(self, name: str, sort: Sort, carrier: str, shape: Shape, link: str, *joined: str) -> None:
        """Adds a plate as thick and of the same material as those of a link."""
        density = material_of(self.mechanism.link(link), self.construction).density
        self.add(Solid(name, sort, carrier, shape, (name,), 0.0, self.sizes.thickness[link], density), *joined)

    def is_free(self, body: Body) -> bool:
        """Whether nothing says yet what the plate of some moving links is."""
        own = any(self.mechanism.link(link).shape is not None for link in body.links)
        return body.carrier != "frame" and body.shape is None and not body.slots and not own

    def bore(self, plates: Iterable[str], places: Mapping[str, complex], radius: float) -> None:
        """Holes in plates for a pin or a post, at its ``places`` by the carriers of the plates."""
        for name in plates:
            carrier = self.solids[name].carrier
            if carrier in places:
                holes, place = self.bores.setdefault(name, {}), places[carrier]
                same = next((each for each in holes if abs(each - place) <= self.near), place)
                holes[same] = max(holes.get(same, 0.0), radius + 0.5 * self.construction.fit)

    def stroke(self, guide: SlidingJoint) -> tuple[float, float]:
        """The smallest and the largest displacement of a block, m; (0, 0) where no position is reached."""
        displacement = self.motion.joint(guide.name).displacement
        reached = displacement[np.isfinite(displacement)]
        return (float(reached.min()), float(reached.max())) if len(reached) else (0.0, 0.0)

    def point_path(self, link: str, point: str, on: str) -> Complexes:
        """A point of a link at all positions that are reached, in the axes of a carrier, complex numbers, m."""
        return self.path_of(self.carriers.carrier(link), self.carriers.place(link, point), on)

    def path_of(self, carrier: str, place: complex, on: str) -> Complexes:
        """A place of a carrier at all positions that are reached, in the axes of another one, complex numbers, m."""
        placed = self.placed[on]
        gap = self.placed[carrier].world((place.real, place.imag)) - placed.origin
        found = (gap[:, 0] + 1j * gap[:, 1]) * (placed.direction[:, 0] - 1j * placed.direction[:, 1])
        return np.asarray(found[np.isfinite(found)])

    def finished(self) -> Solids:
        """All solids, their plates bored."""
        for name, holes in self.bores.items():
            solid = self.solids[name]
            shape = replace(solid.shape, holes=(*solid.shape.holes, *holes.items()))
            self.solids[name] = replace(solid, shape=shape)
        return Solids(self.solids, tuple(self.level), frozenset(self.joined), tuple(self.notes))
