"""Links, welds and guides of a share link of PMKS+ as bodies and slides of a layout."""

from __future__ import annotations

import math

from linkwright.errors import Severity
from linkwright.exporters.pmks_plus.link import LENGTHS, Share, ShareJoint, ShareLink
from linkwright.importers.foreign import Answers
from linkwright.importers.layout import FRAME, Body, Layout, Slide, free_name
from linkwright.importers.pmks.share_records import ShareReader
from linkwright.importers.rigid import join
from linkwright.mechanism.link import Vec
from linkwright.units import UNITS
from linkwright.words import Message, _

#: Numbers of thousandths are this far off at most, in the link's unit or rad; a slot's pin off its line by more than
#: some of these is told.
ROUNDED, OFF_LINE = 5e-4, 2e-3
#: Angles of guides within the rounding of a multiple of this are meant to be it, rad.
SNAP = math.pi / 12
POUND = 0.45359237


class ShareBodies:
    """Makes bodies and slides of the records of a link."""

    def __init__(self, reader: ShareReader, share: Share, answers: Answers) -> None:
        self.reader, self.share, self.answers, self.remarks = reader, share, answers, reader.remarks
        length = share.units[0]
        self.unit = answers.unit or LENGTHS[length if 0 <= length < len(LENGTHS) else 1]
        self.factor = UNITS[self.unit][0]
        self.made = Layout(name="Mechanism of PMKS+", unit=self.unit, source="a share link of PMKS+")
        self.joints = {each.id: each for each in share.joints}
        self.names: dict[str, str] = {}
        self.bodies: dict[str, str] = {}
        self.snapped: list[ShareJoint] = []
        if not any(each.startswith("PL") for each in reader.corrected):
            self.made.centre_precision = ROUNDED * self.factor / 10
        self.corrected = {
            tag[2:] for tag, place, *_value in (each.split("~") for each in reader.corrected) if place == "2"
        }

    def tell(
        self, message: Message, remedy: Message | str, code: str, owner: str, severity: Severity = "note"
    ) -> None:
        """A remark about a record, such as "JA"."""
        record = self.reader.places[owner]
        place = {"line": record.line, "column": record.column}
        self.remarks.remark(severity, message, remedy, code, key=owner[1:], **place)

    def points(self) -> None:
        """Names of joints; places of those on the ground."""
        for joint in self.share.joints:
            self.names[joint.id] = free_name(joint.name or joint.id, self.names.values())
            if joint.grounded and not joint.prismatic:
                self.made.frame.places[self.names[joint.id]] = self.place(joint)

    def place(self, joint: ShareJoint) -> Vec:
        """Where a joint is, m."""
        return joint.x * self.factor, joint.y * self.factor

    def body(self, link: ShareLink) -> None:
        """A link with its points, mass and colour."""
        joints = dict.fromkeys(link.joints)
        for part in self.share.links:
            joints |= dict.fromkeys(part.joints) if part.id in link.parts else {}
        places = {self.names[each]: self.place(self.joints[each]) for each in joints if self.revolute(each)}
        body = Body(
            free_name(link.name or link.id, self.made.bodies, "link"), places, colour=link.colour, key=link.id
        )
        if link.mass or link.inertia:
            mass_unit = POUND if self.unit == "in" else 1.0
            body.mass, body.inertia = link.mass * mass_unit, link.inertia * mass_unit * self.factor**2
            body.centre = self.centre(link, list(places.values()))
        self.made.add(body)
        for each in (link.id, *link.parts):
            self.bodies[each] = body.name
        for each in joints:
            self.carried_mass(self.joints[each], body)

    def centre(self, link: ShareLink, places: list[Vec]) -> Vec | None:
        """The mass centre; None where it is midway between two points, to the digits of the link."""
        given = (link.centre_x * self.factor, link.centre_y * self.factor)
        if len(places) == 2 and not any(each.startswith(f"PL{link.id}~") for each in self.reader.corrected):
            apart = (abs(given[k] - (places[0][k] + places[1][k]) / 2) for k in range(2))
            if max(apart) <= 1.001 * ROUNDED * self.factor:
                return None
        return given

    def carried_mass(self, joint: ShareJoint, body: Body) -> None:
        """A mass on a joint becomes a part of the first link there."""
        if not joint.mass:
            return
        mass, joint.mass = joint.mass, 0.0
        before = body.mass
        places = list(body.places.values())[:2]
        midway = tuple(sum(each) / len(places) for each in zip(*places, strict=True))
        at, centre = self.place(joint), body.centre or midway
        body.mass = before + mass
        body.centre = (
            (before * centre[0] + mass * at[0]) / body.mass,
            (before * centre[1] + mass * at[1]) / body.mass,
        )
        body.inertia += before * math.dist(centre, body.centre) ** 2 + mass * math.dist(at, body.centre) ** 2
        message = _("the mass of joint {joint} is counted to link {link}", joint=joint.id, link=body.name)
        self.tell(message, "", "import.joint_mass", f"J{joint.id}")

    def revolute(self, name: str) -> bool:
        """Whether a joint is a pin or a point."""
        return not self.joints[name].prismatic

    def welds(self) -> None:
        """Links that are welded at a joint become one."""
        for joint in self.share.joints:
            if joint.welded and not joint.prismatic:
                first, *others = self.at(joint.id) or [""]
                for name in others:
                    join(self.made, first, name)
                    self.gone({name: first})

    def at(self, joint: str) -> list[str]:
        """The bodies at a joint, in the order of the link."""
        found = [self.bodies[each.id] for each in self.share.links if joint in each.joints and each.id in self.bodies]
        return list(dict.fromkeys(found))

    def gone(self, joined: dict[str, str]) -> None:
        """Notes what bodies have become."""
        self.bodies = {link: joined.get(body, body) for link, body in self.bodies.items()}

    # -- guides

    def guide(self, joint: ShareJoint) -> None:
        """The guide of a block, or of the link that is welded to it."""
        holders = [each for each in self.share.links if joint.id in each.joints and each.root]
        block = next((each for each in holders if each.block), None)
        pin = next((each for each in block.joints if self.revolute(each)), None) if block else None
        rider = self.at(pin)[:1] if pin and self.joints[pin].welded else []
        rider = rider or [self.bodies[each.id] for each in holders if not each.block][:1]
        if pin is None and not rider:
            self.tell(
                _("the guide {name} carries nothing", name=joint.id),
                _("delete it in PMKS+, or put a link on it"),
                "import.empty_guide",
                f"J{joint.id}",
                "warning",
            )
            return
        line = self.floating(joint) if joint.carrier else self.grounded(joint)
        if line is None:
            return
        guide, through, direction = line
        point = self.names[pin or joint.id]
        if not rider:
            mass = block.mass if block else 0.0
            body = Body(free_name(block.name if block else joint.id, self.made.bodies, "block"), {}, mass=mass)
            rider = [self.made.add(body).name]
            if block:
                self.bodies[block.id] = body.name
        self.made.bodies[rider[0]].places[point] = self.place(self.joints[pin or joint.id])
        name = free_name(f"{self.names[joint.id]}_guide", [each.name for each in self.made.slides])
        slide = Slide(name, guide, through, direction, rider[0], point, offset=0.0)
        if joint.sealed:
            slide.block_angle = self.along(slide)
        self.made.slides.append(slide)

    def grounded(self, joint: ShareJoint) -> tuple[str, str, float | tuple[str, str]]:
        """Guide, point, direction of a line on the ground."""
        name = self.names[joint.id]
        self.made.frame.places[name] = self.place(joint)
        angle = joint.angle
        meant = round(angle / SNAP) * SNAP
        if joint.id not in self.corrected and angle != meant and abs(angle - meant) <= ROUNDED:
            angle = meant
            self.snapped.append(joint)
        return FRAME, name, angle

    def tell_snapped(self) -> None:
        """A remark about angles that were rounded."""
        if not self.snapped:
            return
        first, *others = self.snapped
        degrees = f"{math.degrees(round(first.angle / SNAP) * SNAP):.0f}"
        message = _(
            "angles have three decimals here: {angle} rad is read as {degrees}°", angle=first.angle, degrees=degrees
        )
        if others:
            message = _("{message}, likewise at {names}", message=message, names=tuple(each.id for each in others))
        self.tell(message, "", "import.angle_rounded", f"J{first.id}")

    def floating(self, joint: ShareJoint) -> tuple[str, str, tuple[str, str]] | None:
        """Guide, point, direction of a slot in a link; the block is put on the line."""
        first, second = (self.joints[each] for each in joint.slot)
        (x0, y0), (x1, y1), (x, y) = self.place(first), self.place(second), self.place(joint)
        length = math.hypot(x1 - x0, y1 - y0)
        if not length:
            message = _("the slot of {name} has no direction: its two joints are at one place", name=joint.id)
            self.tell(message, _("move one of them in PMKS+"), "import.no_direction", f"J{joint.id}", "error")
            return None
        off = ((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / length
        if abs(off) > OFF_LINE * self.factor:
            shown = f"{abs(off) / self.factor:.3g} {self.unit}"
            message = _(
                "the block {name} is {distance} off the line of its slot; it is put on the line",
                name=joint.id,
                distance=shown,
            )
            self.tell(message, _("check the assembled position"), "import.off_line", f"J{joint.id}", "warning")
        ends = self.names[first.id], self.names[second.id]
        return self.bodies[joint.carrier], ends[0], ends

    def along(self, slide: Slide) -> float | None:
        """The angle of a cylinder's line in its rod: none, or a half turn; None: the rod is not along the line."""
        guide, rod = self.made.body(slide.guide), self.made.bodies[slide.block]
        if not isinstance(slide.direction, tuple) or len(rod.places) < 2:
            return None
        (x0, y0), (x1, y1) = (guide.places[each] for each in slide.direction)
        turned = math.remainder(math.atan2(y1 - y0, x1 - x0) - rod.axis, 2 * math.pi)
        straight = math.remainder(turned, math.pi)
        first, second = list(rod.places.values())[:2]
        near = OFF_LINE * self.factor / (math.dist(first, second) or 1.0)
        return turned - straight if abs(straight) <= near else None
