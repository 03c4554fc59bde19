"""Texts, addresses and files of PMKS: one record a joint, with the links that meet there."""

from __future__ import annotations

import math
import re
from pathlib import Path

from linkwright.core.data import Plain
from linkwright.errors import Severity
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.layout import FRAME, Body, Drive, Layout, Remarks, Slide, Wheels, free_name
from linkwright.importers.model_text import shortest
from linkwright.importers.pmks.text_records import PmksFile, Record, is_ground, joint_of, pmks_file
from linkwright.importers.reversing import turn_round
from linkwright.importers.rigid import join_rigid
from linkwright.mechanism.link import Vec
from linkwright.units import UNITS
from linkwright.words import Message, _

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
#: Speed where the file has none, rad/s or length per second.
SPEED = 1.0


def recognises(source: ForeignText) -> bool:
    """Whether a text is one of PMKS: an address of it, its JSON, or joints line by line."""
    text = source.text
    if "pmks.html?" in text or '"TypeOfJoint"' in text:
        return True
    if text.lstrip()[:1] in ("<", "{"):
        return False
    return sum(joint_of(each) is not None for each in re.split(r"[\n|]", text)) > 1


def read_pmks(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    """The machine of a text of PMKS."""
    found = pmks_file(source.text, remarks)
    if found is None or not found.records:
        return None
    name = found.name or ("" if source.name.startswith("<") else Path(source.name).stem)
    return Machine(found, name, answers, remarks).layout()


class Machine:
    """Makes a layout of the records of a file."""

    def __init__(self, file: PmksFile, name: str, answers: Answers, remarks: Remarks) -> None:
        self.file, self.answers, self.remarks = file, answers, remarks
        self.made = Layout(name=name or "Mechanism of PMKS", unit=answers.unit or "mm", source="PMKS")
        self.factor = UNITS[self.made.unit][0]
        self.bodies: dict[str, str] = {}
        self.points: list[str] = []
        self.slides: dict[int, str] = {}
        self.mirrored: set[int] = set()

    def layout(self) -> Layout | None:
        """The whole machine."""
        if self.answers.unit is None:
            message = _("PMKS gives no unit of length; mm is taken")
            self.remarks.remark("note", message, _("say another one: --unit, unit="), "import.no_unit_given")
        for number, record in enumerate(self.file.records):
            self.points.append(LETTERS[number] if number < len(LETTERS) else f"P{number + 1}")
            for link in record.links:
                self.body(link)
        if FRAME not in self.bodies.values():
            known = tuple(self.bodies.values())
            message = _("no link is the ground")
            remedy = _("say which one is fixed: --fixed, fixed=; there is: {names}", names=known)
            self.remarks.remark("error", message, remedy, "import.no_ground")
            return None
        for number, record in sorted(enumerate(self.file.records), key=lambda each: "RPG".index(each[1].kind[-1])):
            if record.kind == "G":
                self.wheels(number, record)
            else:
                self.joint(number, record)
        self.drive()
        if self.remarks.failed:
            return None
        join_rigid(self.made, self.remarks)
        turn_round(self.made, self.remarks)
        return self.made

    def tell(self, severity: Severity, message: Message, remedy: Message | str, code: str, number: int) -> None:
        """A remark about a record."""
        record = self.file.records[number]
        place = {"line": record.line, "column": record.column}
        self.remarks.remark(severity, message, remedy, code, key=self.points[number], **place)

    def body(self, link: str) -> None:
        """The body of a link."""
        if link in self.bodies:
            return
        if is_ground(link) or link == self.answers.fixed:
            self.bodies[link] = FRAME
            return
        name = free_name(link, self.made.bodies, "link_")
        self.made.add(Body(name, colour=self.file.colours.get(link, ""), key=link))
        self.bodies[link] = name

    def place(self, record: Record) -> Vec:
        """Where a joint is, m."""
        return record.x * self.factor, record.y * self.factor

    # -- joints

    def joint(self, number: int, record: Record) -> None:
        """A pin or traced point, a guide, or a pin in a slot."""
        point, place = self.points[number], self.place(record)
        bodies = list(dict.fromkeys(self.bodies[each] for each in record.links))
        if len(bodies) == 1 or record.kind == "R":
            if len(bodies) > 1:
                point = self.points[number] = self.pin_at(place, bodies) or point
            for name in bodies:
                self.made.body(name).places[point] = place
        elif len(bodies) > 2 and record.kind == "P":
            message = _("a guide joins two links, not {count}", count=len(bodies))
            self.tell("error", message, _("write one record for each two"), "import.guide_links", number)
            return
        else:
            self.guide(number, record, bodies)
            point = self.points[number]
        if record.shown or len(bodies) == 1:
            self.made.traced += [f"{each}.{point}" for each in bodies[:2] if each != FRAME][:1]

    def pin_at(self, place: Vec, bodies: list[str]) -> str | None:
        """The pin that one of the bodies has at a place already: all that is pinned there turns about it."""
        for body in map(self.made.body, bodies):
            for point, at in body.places.items():
                if at == place and sum(point in each.places for each in self.made.all) > 1:
                    return point
        return None

    def guide(self, number: int, record: Record, bodies: list[str]) -> None:
        """The slot is in the first link, its pin or block on the second."""
        place, (guide, *others) = self.place(record), bodies
        there = (each for each, at in self.made.body(others[0]).places.items() if at == place and others[0] != FRAME)
        point = self.points[number] = next(there, self.points[number])
        for name in others:
            self.made.body(name).places[point] = place
        block = others[0]
        if record.kind == "RP" or block == FRAME:
            block = self.made.add(Body(free_name(f"block_{point}", self.made.bodies), {point: place})).name
        through = free_name(f"{point}_guide", [each.through for each in self.made.slides])
        self.made.body(guide).places[through] = place
        name = self.slides[number] = free_name(f"guide_{point}", self.slides.values())
        self.made.slides.append(Slide(name, guide, through, record.angle, block, point, offset=0.0))
        if record.kind == "P" and others[0] == FRAME:
            self.turned(number, record, guide, block)

    def turned(self, number: int, record: Record, guide: str, block: str) -> None:
        """A slot in a moving link on a pin of the frame: the link is the block of a line on the frame, and moves the
        other way."""
        slide, point = self.made.slides[-1], self.points[number]
        del self.made.bodies[block]
        through = self.made.body(guide).places.pop(slide.through)
        self.made.frame.places.pop(point)
        self.made.frame.places[slide.through], self.made.body(guide).places[point] = through, through
        slide.guide, slide.block = FRAME, guide
        self.mirrored.add(number)

    def wheels(self, number: int, record: Record) -> None:
        """Two wheels that touch at a point, with the radii that their centres give."""
        bodies = [self.bodies[each] for each in record.links]
        found = self.centres(bodies) if len(bodies) == 2 else None
        if found is None:
            message = _("the wheels of this mesh have no centres on a common link")
            remedy = _("give each of two wheels a record R with the link that carries both, or the ground")
            self.tell("error", message, remedy, "import.no_centres", number)
            return
        carrier, centres = found
        contact = self.place(record)
        radii = [math.dist(each, contact) for each in centres]
        sides = [(each[0] - contact[0], each[1] - contact[1]) for each in centres]
        internal = sides[0][0] * sides[1][0] + sides[0][1] * sides[1][1] > 0
        written = [f"{shortest(each / self.factor, 1e-12)} {self.made.unit}" for each in radii]
        values: Plain = {"links": bodies, "radii": written, "carrier": carrier}
        if internal:
            values["mesh"] = "internal"
        self.made.wheels.append(Wheels(f"mesh_{self.points[number]}", "gear", values))
        off = abs(math.dist(*centres) - (abs(radii[0] - radii[1]) if internal else sum(radii)))
        if off > 1e-6 * sum(radii):
            message = _("the point of contact is not on the line through both centres")
            self.tell("error", message, _("put it there"), "import.contact", number)

    def centres(self, bodies: list[str]) -> tuple[str, list[Vec]] | None:
        """The link that carries two wheels, the frame first, and their centres."""
        carried = [each for each in self.made.all if each.name not in bodies or each.name == FRAME]
        for carrier in carried:
            pins = [self.pin(wheel, carrier) for wheel in bodies]
            if None not in pins and pins[0] != pins[1]:
                return carrier.name, [carrier.places[each] for each in pins if each is not None]
        return None

    def pin(self, wheel: str, carrier: Body) -> str | None:
        """The pin of a wheel on its carrier."""
        if wheel == carrier.name:
            return None
        places = self.made.body(wheel).places
        return next((each for each in carrier.places if each in places), None)

    # -- the driver

    def drive(self) -> None:
        """A driver at the joint that is marked, or the first one of two links."""
        number = self.driven()
        if number is None:
            message = _("no joint can be driven: none joins two links")
            self.remarks.remark("warning", message, _("say which one is: --driver, driver="), "import.no_driver")
            return
        speed = self.answers.speed
        record, slide = self.file.records[number], self.slides.get(number)
        if speed is None:
            given = self.file.speed
            if given is None:
                message = _("the file gives no speed; 1 rad/s, or one unit of length a second, is taken")
                self.tell("note", message, _("say another one: --speed, speed="), "import.no_speed", number)
                given = SPEED
            speed = given * (self.factor if slide else 1.0)
        if slide is not None:
            self.made.drives.append(Drive(slide=slide, speed=-speed if number in self.mirrored else speed))
            return
        bodies = list(dict.fromkeys(self.bodies[each] for each in record.links))
        moving = [each for each in bodies if each != FRAME]
        against = FRAME if len(moving) < len(bodies) else moving.pop(0)
        self.made.drives.append(Drive(turn=moving[0], about=self.points[number], against=against, speed=speed))

    def driven(self) -> int | None:
        """The number of the joint that is driven."""
        numbers = [k for k, each in enumerate(self.file.records) if len(each.links) > 1 and each.kind in ("R", "P")]
        if self.answers.driver is not None:
            named = [k for k in numbers if self.answers.driver in (self.points[k], *self.file.records[k].links)]
            return named[0] if named else None
        marked = [k for k in numbers if self.file.records[k].driven]
        return next(iter([*marked, *numbers]), None)


READERS.register("pmks_text")(ForeignFormat(_("PMKS text"), (".pmks", ".txt"), recognises, read_pmks))
