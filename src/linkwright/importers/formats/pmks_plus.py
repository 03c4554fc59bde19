"""Share links of PMKS+: joints with flags, links, blocks on guides, forces; the text holds the whole machine."""

from __future__ import annotations

import math

from linkwright.exporters.pmks_plus.link import ShareForce, ShareJoint
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.layout import FRAME, Drive, Force, Layout, Remarks, free_name
from linkwright.importers.model_text import RPM
from linkwright.importers.pmks.share_bodies import ROUNDED, ShareBodies
from linkwright.importers.pmks.share_records import ShareReader, link_in, oldest
from linkwright.importers.reversing import turn_round
from linkwright.importers.rigid import join_rigid
from linkwright.words import _

GRAVITY = -9.81
#: Speed of a slide where a link has none: length per second.
SLIDES_AT = 5.0
POUND_FORCE = 4.4482216152605
#: Entries of the tail that only lock what is drawn.
LOCKS = "LJF"


def recognises(source: ForeignText) -> bool:
    """Whether a text is a share link."""
    if "pmksplus" in source.text[:1000]:
        return True
    _line, _column, body = link_in(source.text[:5000])
    return body.count(".") > 6 and body.count(",") > 6 and (oldest(body) or ".YR" in body)


def read_share(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    """The machine of a share link."""
    reader = ShareReader(source.text, remarks)
    share = reader.read()
    return None if share is None else Machine(reader, share, answers).layout()


class Machine(ShareBodies):
    """Makes a layout of the records of a link."""

    def layout(self) -> Layout | None:
        """The whole machine."""
        if not any(each.root and not each.block for each in self.share.links):
            self.remarks.remark("error", _("the link holds no links"), _("draw some in PMKS+"), "import.no_links")
            return None
        self.assumed_units()
        self.points()
        for link in self.share.links:
            if link.root and not link.block:
                self.body(link)
        self.welds()
        for joint in self.share.joints:
            if joint.prismatic:
                self.guide(joint)
        self.tell_snapped()
        for joint in self.driven():
            self.drive(joint)
        for force in self.share.forces:
            self.force(force)
        self.traces()
        self.gone(join_rigid(self.made, self.remarks))
        self.made.gravity = (0.0, GRAVITY) if self.share.gravity else (0.0, 0.0)
        self.only_seen()
        if self.remarks.failed:
            return None
        turn_round(self.made, self.remarks)
        return self.made

    # -- drivers, loads, views

    def driven(self) -> list[ShareJoint]:
        """The joints that are driven, or the one that the user names."""
        if self.answers.driver is not None:
            named = [each for each in self.share.joints if self.answers.driver in (each.id, each.name)]
            if named:
                return named[:1]
            message = _("no joint is called {name}", name=self.answers.driver)
            known = ", ".join(each.name for each in self.share.joints)
            self.remarks.remark("error", message, _("there is: {names}", names=known), "import.no_such_driver")
        found = [each for each in self.share.joints if each.driven]
        if not found:
            message = _("no joint of the link is driven")
            self.remarks.remark("warning", message, _("say which one is: --driver, driver="), "import.no_driver")
        return found

    def drive(self, joint: ShareJoint) -> None:
        """A driver of constant speed about a pin or along a guide."""
        name = free_name(
            "driver" if not self.made.drives else f"driver_{joint.id}", [each.name for each in self.made.drives]
        )
        slides = {each.name: each for each in self.made.slides}
        if joint.prismatic:
            slide = next((each for each in slides if each == f"{self.names[joint.id]}_guide"), None)
            speed = self.answers.speed if self.answers.speed is not None else self.slide_speed(joint)
            if slide is not None:
                self.made.drives.append(Drive(name, slide=slide, speed=speed))
            return
        bodies = self.at(joint.id)
        if joint.grounded:
            bodies.insert(0, FRAME)
        if len(bodies) != 2:
            message = _("at the driven joint {name} {count} bodies meet, not two", name=joint.id, count=len(bodies))
            enough = len(bodies) > 2
            remedy = _("the second turns against the first; check this") if enough else _("drive another joint")
            self.tell(message, remedy, "import.driven_bodies", f"J{joint.id}", "warning" if enough else "error")
            if not enough:
                return
        own = joint.speed or (-1 if self.share.clockwise else 1) * self.share.integers[0]
        speed = self.answers.speed if self.answers.speed is not None else own * RPM
        if not speed:
            message = _("the driven joint {name} has the speed 0", name=joint.id)
            self.tell(message, _("say another one: --speed, speed="), "import.no_speed", f"J{joint.id}", "error")
            return
        pin = self.names[joint.id]
        self.made.drives.append(Drive(name, turn=bodies[1], about=pin, against=bodies[0], speed=speed))

    def slide_speed(self, joint: ShareJoint) -> float:
        """The speed of a driven guide, m/s; a remark where the link does not give it."""
        if joint.speed:
            return joint.speed * self.factor
        size = self.share.decimals[1]
        if not size:
            size = SLIDES_AT
            shown = f"{size:g} {self.unit}/s"
            message = _(
                "the link gives no speed of the slide {name}; {speed} is taken, as PMKS+ does",
                name=joint.id,
                speed=shown,
            )
            self.tell(message, _("say another one: --speed, speed="), "import.no_speed", f"J{joint.id}")
        return (-1 if self.share.clockwise else 1) * size * self.factor

    def force(self, force: ShareForce) -> None:
        """A force on a point of its link."""
        body = self.made.body(self.bodies[force.link])
        start = (force.start_x * self.factor, force.start_y * self.factor)
        end = (force.end_x * self.factor, force.end_y * self.factor)
        length = math.dist(start, end)
        if not length or not force.magnitude:
            message = _("the force {name} has no direction or no size and is left out", name=force.id)
            self.tell(message, _("give it one in PMKS+"), "import.no_force", f"F{force.id}", "warning")
            return
        near = ROUNDED * self.factor
        point = next((each for each, place in body.places.items() if math.dist(place, start) <= near), None)
        taken = [*self.made.frame.places, *(each for body in self.made.bodies.values() for each in body.places)]
        if point is None:
            point = free_name(force.name or force.id, taken)
            body.places[point] = start
        size = force.magnitude * (POUND_FORCE if self.unit == "in" else 1.0)
        components = (size * (end[0] - start[0]) / length, size * (end[1] - start[1]) / length)
        name = free_name(force.name or force.id, [each.name for each in self.made.forces])
        self.made.forces.append(Force(name, body.name, point, components, follows=force.follows))

    def traces(self) -> None:
        """Points whose paths are shown."""
        for joint in self.share.joints:
            bodies = self.at(joint.id)
            if joint.traced and bodies and not joint.grounded:
                self.made.traced.append(f"{bodies[0]}.{self.names[joint.id]}")

    def assumed_units(self) -> None:
        """Says in which units numbers are read."""
        inch = self.unit == "in"
        units = (f"{self.unit}, lb, lb·in², lbf") if inch else (f"{self.unit}, kg, kg·{self.unit}², N")
        message = _("lengths, masses, moments of inertia and forces are read in {units}", units=units)
        self.remarks.remark("note", message, _("say another unit of length: --unit, unit="), "import.units")

    def only_seen(self) -> None:
        """A remark about what a link says that does not change the machine."""
        seen = [each for each in self.share.tail if each[0] not in LOCKS]
        if seen:
            message = _(
                "colours of pins, anchors of mass centres and designs of PMKS+ are left out: {entries}",
                entries=", ".join(seen),
            )
            self.remarks.remark("note", message, "", "import.only_seen", line=self.reader.line)


READERS.register("pmks_plus")(ForeignFormat(_("PMKS+ share link"), (".pmksplus", ".txt"), recognises, read_share))
