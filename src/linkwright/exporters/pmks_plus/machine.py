"""A machine as records of a share link of PMKS+: joints, links, welds, blocks on guides."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import count, product
from string import ascii_lowercase, ascii_uppercase

import numpy as np

from linkwright.errors import RequestError
from linkwright.exporters.pmks_plus.link import Share, ShareJoint, ShareLink
from linkwright.exporters.results import Results
from linkwright.fields.colour import as_rgb
from linkwright.joints.lower_pair import RigidJoint, SlidingJoint, TurningJoint
from linkwright.kinematics.placement import placements
from linkwright.mechanism.link import Link, Vec
from linkwright.words import Message, _

FRAME = "frame"
#: Units of length and inertia in the link: cm, kg·cm².
CM, KG_CM2 = 100.0, 1e4
#: Colour of links that have none: PMKS+'s own first one.
PLAIN = "#c5cae9"
#: What a slot is longer than the way in it, as a share of the machine's size.
SPARE = 0.1


class ShareParts:
    """Joints and links of a machine as it lies at the first position that was reached.

    ``joints``: by link and point; ``links``: by the names of links; ``notes``: what the records cannot say.
    """

    def __init__(self, results: Results) -> None:
        self.motion, self.mechanism = results.motion, results.mechanism
        self.index, self.placed = results.first_ok(), placements(results.motion)
        self.share, self.notes = Share(gravity=False), list[Message]()
        self.ids = _ids()
        for joint in self.mechanism.joints.values():
            if not isinstance(joint, TurningJoint | SlidingJoint | RigidJoint):
                raise RequestError(
                    _(
                        "{joint}: PMKS+ has no joint of the kind {kind}; it has pins, slides and welds",
                        code="export.pmks_joint",
                        joint=joint.name,
                        kind=joint.kind,
                    )
                )
        self.guides = list(self.mechanism.guides.values())
        self.welds = list(self.mechanism.welds.values())
        self.joints: dict[tuple[str, str], ShareJoint] = {}
        self.links: dict[str, ShareLink] = {}
        places = [self.world(name, each) for name, link in self.bodies() for each in link.points.values()]
        self.size = max((math.dist(places[0], each) for each in places), default=0.0) or 1.0

    def bodies(self) -> Iterator[tuple[str, Link]]:
        """The frame and the links."""
        yield FRAME, self.mechanism.frame
        yield from self.mechanism.links.items()

    # -- places

    def world(self, link: str, local: Vec) -> Vec:
        """A place in a link's axes in frame axes, m."""
        x, y = self.placed[link].world(local)[self.index]
        return float(x), float(y)

    def place(self, link: str, point: str) -> Vec:
        """Where a point of a link is, m."""
        return self.world(link, self.mechanism.link(link).points[point])

    def joint(self, name: str, place: Vec) -> ShareJoint:
        """A further joint at a place (m); what is only rounding of 0 is 0."""
        x, y = (0.0 if abs(each) < 1e-15 * self.size else each * CM for each in place)
        found = ShareJoint(next(self.ids), name, x, y)
        self.share.joints.append(found)
        return found

    # -- joints and links

    def add_joints(self, driven_pin: tuple[str, str] | None) -> None:
        """A joint for each point, those of one name together; at a driven pin of the frame (point, driven link) one
        for the other links as well."""
        by_name: dict[str, ShareJoint] = {}
        used = {point for link in self.mechanism.links.values() for point in link.points}
        for name, link in self.bodies():
            for point in link.points:
                if name == FRAME and point not in used:
                    continue
                if point not in by_name:
                    by_name[point] = self.joint(point, self.place(name, point))
                    by_name[point].grounded = name == FRAME
                self.joints[name, point] = by_name[point]
        if driven_pin is None:
            return
        point, driven = driven_pin
        others = [name for name, link in self.mechanism.links.items() if point in link.points and name != driven]
        if others:
            second = self.joint(f"{point}_2", self.place(FRAME, point))
            second.grounded = True
            self.joints |= {(name, point): second for name in others}
            self.notes.append(
                _(
                    "At {point} only one link is driven; {links} have a joint of their own there.",
                    point=point,
                    links=tuple(others),
                )
            )

    def add_links(self) -> None:
        """Links that are more than the block of a pin; welded ones below the link that they become."""
        for names in self.welded():
            for name in names:
                if not self.is_pin(name):
                    self.links[name] = self.link(name)
            if len(names) > 1:
                self.compound(names)

    def welded(self) -> list[list[str]]:
        """Links that are welded to each other, each link once; raises LinkwrightError for a weld to the frame."""
        sets = [[name] for name in self.mechanism.links]
        for weld in self.welds:
            if FRAME in weld.links:
                raise RequestError(
                    _(
                        "{weld}: in PMKS+ no link is welded to the ground; make its points those of the frame",
                        code="export.pmks_weld",
                        weld=weld.name,
                    )
                )
            first, second = (next(each for each in sets if link in each) for link in weld.links)
            if first is not second:
                first += second
                sets.remove(second)
        return sets

    def link(self, name: str) -> ShareLink:
        """The record of a link."""
        link = self.mechanism.links[name]
        joints = [self.joints[name, point].id for point in link.points]
        x, y = self.world(name, link.centre)
        made = ShareLink(self.new_id("".join(joints)), name, tuple(joints), (), link.mass, link.inertia * KG_CM2)
        made.centre_x, made.centre_y = x * CM, y * CM
        made.colour = as_rgb(link.colour) or PLAIN
        self.share.links.append(made)
        return made

    def compound(self, names: list[str]) -> None:
        """The link that welded links become, with its mass and inertia about their common centre."""
        parts = [self.links[each] for each in names]
        joints = tuple(dict.fromkeys(joint for each in parts for joint in each.joints))
        mass = sum(each.mass for each in parts)
        x, y = (
            sum(each.mass * getattr(each, axis) for each in parts) / mass if mass else getattr(parts[0], axis)
            for axis in ("centre_x", "centre_y")
        )
        inertia = sum(
            each.inertia + each.mass * math.dist((each.centre_x, each.centre_y), (x, y)) ** 2 for each in parts
        )
        whole = ShareLink(
            self.new_id("".join(joints)), names[0], joints, tuple(each.id for each in parts), mass, inertia, x, y
        )
        whole.colour = parts[0].colour
        seams = [weld for weld in self.welds if weld.links[0] in names]
        if all(self.meet_alone(weld) for weld in seams):
            for weld in seams:
                self.joints[weld.links[0], weld.at].welded = True
            for each in parts:
                each.root = False
        else:  # a welded joint of PMKS+ welds all that is there: one link without parts
            whole.parts = ()
            self.share.links = [each for each in self.share.links if each not in parts]
        self.share.links.append(whole)
        self.links |= dict.fromkeys(names, whole)

    def meet_alone(self, weld: RigidJoint) -> bool:
        """Whether only the two links of a weld meet at its joint."""
        seam = self.joints[weld.links[0], weld.at]
        return {name for (name, _point), joint in self.joints.items() if joint is seam} == set(weld.links)

    def new_id(self, wanted: str) -> str:
        """An id that no link has yet."""
        taken = {each.id for each in self.share.links}
        return next(each for each in (wanted, *(f"{wanted}{k}" for k in range(2, 1000))) if each not in taken)

    def is_pin(self, name: str) -> bool:
        """Whether a link is a block of one point on one guide, of which it does not matter how it lies."""
        slides = [each for each in self.guides if name in (each.guide, each.block)]
        drivers = {link for each in self.mechanism.drivers.values() for link in (each.link, each.relative_to)}
        own = {each.joint for each in self.mechanism.drivers.values()} & {each.name for each in slides}
        held = any(name in each.links for each in self.welds)
        alone = len(self.mechanism.links[name].points) == 1 and len(slides) == 1 and slides[0].block == name
        return alone and not held and (name not in drivers or bool(own))

    # -- guides

    def add_guide(self, guide: SlidingJoint) -> tuple[ShareJoint, int]:
        """A guide with its block; its joint, and 1 where it moves as the machine's own does, -1 the other way."""
        direction = self.placed[guide.guide].direction[self.index]
        angle = math.atan2(direction[1], direction[0]) + guide.direction
        carrier, block, point, sign = guide.guide, guide.block, guide.at, 1
        if block == FRAME:  # the guide moves over the frame: its own point moves along a line on the ground
            carrier, block, point, sign = FRAME, guide.guide, guide.through, -1
        along, at = (math.cos(angle), math.sin(angle)), self.place(block, point)
        way = self.motion.joint(guide.name).displacement
        way = way[np.isfinite(way)] - way[self.index]
        pin, ahead = self.pin(guide, block, point, at, along)
        line = self.joint(guide.name, (pin.x / CM, pin.y / CM))
        line.x, line.y, line.prismatic, line.grounded = pin.x, pin.y, True, carrier == FRAME
        if carrier == FRAME:
            line.angle = math.remainder(angle, math.tau)
        else:
            line.carrier = self.links[carrier].id
            line.slot = self.slot(guide, at, along, (float(way.min()) + ahead, float(way.max()) + ahead))
        link = self.mechanism.links[block] if pin is self.joints[block, point] and self.is_pin(block) else None
        made = ShareLink(
            self.new_id(pin.id + line.id), "" if link is None else link.name, (pin.id, line.id), block=True
        )
        made.name, made.mass = made.name or made.id, 0.0 if link is None else link.mass
        self.share.links.append(made)
        return line, sign

    def pin(self, guide: SlidingJoint, block: str, point: str, at: Vec, along: Vec) -> tuple[ShareJoint, float]:
        """The joint of a block, welded to the link that must not turn on the guide, and how far it is ahead of the
        block's point, m."""
        own = self.joints[block, point]
        if self.is_pin(block):
            return own, 0.0
        holders = [name for name, each in self.joints if each == point and self.joints[name, each] is own]
        in_blocks = any(own.id in each.joints for each in self.share.links if each.block)
        if holders == [block] and not in_blocks and not own.welded:
            own.welded = True
            return own, 0.0
        ahead = SPARE * self.size
        while any(
            math.dist((at[0] + ahead * along[0], at[1] + ahead * along[1]), (each.x / CM, each.y / CM))
            < 1e-6 * self.size
            for each in self.share.joints
        ):
            ahead += SPARE * self.size
        made = self.extra(block, f"{point}_{guide.name}", (at[0] + ahead * along[0], at[1] + ahead * along[1]))
        made.welded = True
        return made, ahead

    def extra(self, link: str, name: str, place: Vec) -> ShareJoint:
        """A further joint on a link."""
        made, record = self.joint(name, place), self.links[link]
        record.joints = (*record.joints, made.id)
        return made

    def slot(self, guide: SlidingJoint, at: Vec, along: Vec, way: tuple[float, float]) -> tuple[str, str]:
        """The two joints that give a slot its direction and hold the way in it between them."""
        if guide.direction_points is not None and not guide.offset:
            ends = [self.place(guide.guide, each) for each in guide.direction_points]
            first, second = ((x - at[0]) * along[0] + (y - at[1]) * along[1] for x, y in ends)
            if first <= way[0] and way[1] <= second:
                one, other = (self.joints[guide.guide, each].id for each in guide.direction_points)
                return one, other
        spare = SPARE * self.size
        places = [(at[0] + each * along[0], at[1] + each * along[1]) for each in (way[0] - spare, way[1] + spare)]
        one, other = (self.extra(guide.guide, f"{guide.name}_{k + 1}", each).id for k, each in enumerate(places))
        return one, other


def _ids() -> Iterator[str]:
    """Ids of joints: A to Z, a to z, AA and so on."""
    letters = ascii_uppercase + ascii_lowercase
    for length in count(1):
        yield from ("".join(each) for each in product(letters, repeat=length))
