"""Linkage (.linkage2): pins and links in units of 96 to the inch, inputs, sliders, actuators, gears and chains."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import reduce
from pathlib import Path

from linkwright.errors import Severity
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.layout import FRAME, Drive, Layout, Remarks, free_name
from linkwright.importers.linkage.bodies import Bodies
from linkwright.importers.linkage.elements import DECIMALS, PIXEL, Connector, LinkageFile, LinkElement, read_file
from linkwright.importers.linkage.guides import Gearing, Guides
from linkwright.importers.reversing import turn_round
from linkwright.importers.rigid import join_rigid
from linkwright.words import Message, _

#: Speed that the program gives a new input, turns a minute, clockwise.
NEW_INPUT = 15.0


def recognises(source: ForeignText) -> bool:
    """Whether a text is a file of Linkage."""
    return "<linkage2" in source.text[:2000]


def read(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    """The layout of a file of Linkage."""
    text = source.text
    if "\ufffd" in text and source.binary:  # the program writes in the code page of Windows
        text = source.binary.decode("cp1252", errors="replace")
    file = read_file(text, remarks)
    if file is None or remarks.failed:
        return None
    name = "" if source.name.startswith("<") else Path(source.name).stem
    return Reader(file, name, answers, remarks).layout()


READERS.register("linkage")(ForeignFormat(_("Linkage"), (".linkage2",), recognises, read))


class Reader:
    """Makes a layout of a file."""

    def __init__(self, file: LinkageFile, name: str, answers: Answers, remarks: Remarks) -> None:
        self.file, self.answers, self.remarks = file, answers, remarks
        self.found = Layout(name=name)
        self.found.unit = answers.unit or ("in" if file.inches else "mm")
        self.found.precision = 0.0 if file.precise else 0.5 * 10**-DECIMALS * PIXEL
        self._ask()
        self.bodies = Bodies(file, self.found, remarks)

    def layout(self) -> Layout:
        """The layout; remarks tell what has no counterpart."""
        self._tell_of_decoration()
        Guides(self.bodies, self.remarks).add()
        Gearing(self.bodies, self.remarks).add()
        self._drives()
        self._traced()
        self._drop_idle()
        join_rigid(self.found, self.remarks)
        self._drop_fixed()
        turn_round(self.found, self.remarks)
        return self.found

    # -- drivers

    def _drives(self) -> None:
        """Inputs and actuators; those moved by hand rest beside others that move by themselves."""
        inputs = [each for each in self.bodies.used.values() if each.input]
        turns = [(each, body) for each in inputs if (body := self._turned(each)) is not None]
        actuators = [each for each in self.bodies.actuators if self._ends(each) is not None]
        if not turns and not actuators:
            message = _("nothing is driven")
            remedy = _("say which connector turns its link: --driver, and --speed in rad/s")
            self.remarks.remark("warning", message, remedy, "import.no_driver")
            return
        rates = [(each.rpm, each.manual) for each, _body in turns] + [(each.rate, each.manual) for each in actuators]
        by_itself = [rate for rate, manual in rates if rate and not manual]
        moving = by_itself or [rate for rate, _manual in rates if rate]
        for connector, body in turns:
            self._turn(connector, body, rests=bool(by_itself), stands=bool(moving), alone=len(rates) == 1)
        for link in actuators:
            self._actuator(link, rests=bool(by_itself), rates=moving)
        if moving and (actuators or len(moving) > 1):
            self.found.cycle = {"duration": f"{float(self._period(moving)):.12g} s"}

    def _ask(self) -> None:
        """Makes the connector that the user names an input, where the file has none."""
        if not any(each.input for each in self.file.connectors.values()):
            for each in self.file.connectors.values():
                each.input = each.shown == self.answers.driver

    def _turned(self, connector: Connector) -> str | None:
        """The body that an input turns."""
        indices = list(self.bodies.turned_by(connector))
        bodies = list(dict.fromkeys(self.bodies.of[each] for each in indices))
        if not bodies or bodies[0] == FRAME:
            self._remark("warning", _("this input turns no link; it is left out"), _("join a link to it"), connector)
            return None
        return bodies[0]

    def _turn(self, connector: Connector, body: str, *, rests: bool, stands: bool, alone: bool) -> None:
        """A driver that turns a body about a connector; turns a minute are positive clockwise."""
        name = self.bodies.names[connector.number]
        against = FRAME if connector.anchor else self._carrier(connector, body)
        if against is None:
            message = _("this input turns no link against another; it is left out")
            self._remark("warning", message, _("make it an anchor if it is to be fixed"), connector)
            return
        speed = -connector.rpm * math.pi / 30
        if not connector.rpm and self.answers.speed is not None:
            speed = self.answers.speed
        elif not connector.rpm and not stands:
            message = _(
                "its rpm is missing or 0, so that it stands still; read as 15 rpm clockwise, as a new input has"
            )
            self._remark("warning", message, _("say it: --speed, in rad/s"), connector, "import.linkage_rpm")
            speed = -NEW_INPUT * math.pi / 30
        elif not connector.rpm:
            message = _("its rpm is missing or 0: it stands still")
            self._remark("note", message, _("say it: --speed, in rad/s"), connector, "import.linkage_rpm")
        elif connector.manual:
            speed = 0.0 if rests else speed
            self._by_hand(connector.line, connector.shown, rests=rests)
        drive = "driver" if alone else f"drive_{name}"
        places = self.found.bodies[body].places
        self.found.bodies[body].places = {name: places[name], **places}
        self.found.drives.append(Drive(self._drive_name(drive), turn=body, about=name, against=against, speed=speed))

    def _carrier(self, connector: Connector, body: str) -> str | None:
        """What carries an input that is no anchor: the first other body at it."""
        others = [each for each in self.bodies.all_holding(connector.number) if each != body]
        if not others:
            return None
        message = _("it is no anchor: its link is turned against {other}, which carries it", other=others[0])
        self._remark("warning", message, _("make it an anchor if it is to be fixed"), connector)
        return others[0]

    def _actuator(self, link: LinkElement, *, rests: bool, rates: list[float]) -> None:
        """A driver of the distance of two connectors, which runs to and fro at constant speed."""
        ends = self._ends(link)
        assert ends is not None
        length = math.dist(*(self.bodies.used[each].place for each in link.connectors))
        throw = length / 2 if link.throw is None else link.throw
        throw = math.copysign(throw, link.rate)
        if throw < -length:
            message = _("its throw is longer than itself: it cannot become so short")
            self.remarks.remark(
                "warning", message, _("give it a smaller throw"), "import.linkage_throw", line=link.line, key=link.key
            )
        drive = Drive(self._drive_name(link.name or f"actuator_{link.number + 1}"), between=ends)
        if link.manual:
            self._by_hand(link.line, link.key, rests=rests)
        if not link.rate or (link.manual and rests):
            drive.speed = 0.0
        else:
            period, whole = 60 / abs(link.rate), float(self._period(rates))
            strokes = max(2, math.ceil(2 * whole / period - 1e-9))
            times = [period / 2 * k for k in range(strokes + 1)]
            drive.table = (times, [throw if k % 2 else 0.0 for k in range(strokes + 1)], "linear")
        self.found.drives.append(drive)

    def _ends(self, link: LinkElement) -> tuple[tuple[str, str], tuple[str, str]] | None:
        """The two ends of an actuator as (body, point); None, where one hangs free or both are of one body."""
        holders = [self.bodies.all_holding(each) for each in link.connectors]
        if all(holders) and not set(holders[0]) & set(holders[1]):
            one, other = (self.bodies.names[each] for each in link.connectors)
            return (holders[0][0], one), (holders[1][0], other)
        message = _("the two ends of this actuator are not pinned to two different links; it is left out")
        remedy = _("pin both of its ends")
        self.remarks.remark("warning", message, remedy, "import.linkage_actuator", line=link.line, key=link.key)
        return None

    def _by_hand(self, line: int, key: str, *, rests: bool) -> None:
        message = _("it is moved by hand only: here it rests where it begins")
        if not rests:
            message = _("it is moved by hand only: here it moves at its own speed")
        self.remarks.remark("note", message, _("change the driver"), "import.linkage_manual", line=line, key=key)

    def _drive_name(self, wanted: str) -> str:
        return free_name(wanted, [each.name for each in self.found.drives], "drive")

    @staticmethod
    def _period(rates: list[float]) -> Fraction:
        """Time (s) after which all inputs are back: as the program has it, of whole rates a minute."""
        if len({abs(each) for each in rates}) == 1:
            return 60 / Fraction(abs(rates[0])).limit_denominator(10**6)
        return Fraction(60, reduce(math.gcd, (math.ceil(abs(each)) for each in rates)))

    # -- paths, decoration, leftovers

    def _traced(self) -> None:
        """Points whose paths are asked for."""
        for each in self.bodies.used.values():
            moving = [name for name in self.bodies.all_holding(each.number) if name != FRAME]
            if each.draw and moving and not each.anchor:
                self.found.traced.append(f"{moving[0]}.{self.bodies.names[each.number]}")

    def _tell_of_decoration(self) -> None:
        """Remarks about what is drawing only."""
        left = [each.line for each in self.file.connectors.values() if each.number not in self.bodies.used]
        left += [each.line for each in self.file.links if each.shown_only or each.measure]
        if left:
            message = _("{count} elements of the drawing layer and of dimensions are left out", count=len(left))
            remedy = _("keep the drawing with the other file")
            self.remarks.remark("note", message, remedy, "import.linkage_drawing", line=min(left))
        for each in self.bodies.used.values():
            if each.circle:
                message, remedy = (
                    _("the circle drawn about it is left out"),
                    _("keep the drawing with the other file"),
                )
                self._remark("note", message, remedy, each, "import.linkage_circle")

    def _drop_idle(self) -> None:
        """Drops bodies of one point that nothing needs, and those that nothing joins to the frame."""
        for name in sorted(self._lonely() | self._islands()):
            dropped = self.found.bodies.pop(name)
            line = next((each.line for k, each in enumerate(self.bodies.rigid) if self.bodies.of[k] == name), 0)
            message = _("nothing joins this link to the others; it is left out")
            remedy = _("join it to another link if it is meant to move")
            self.remarks.remark("note", message, remedy, "import.linkage_idle", line=line, key=dropped.key)
        left = {FRAME, *self.found.bodies}
        self.found.traced = [each for each in self.found.traced if each.split(".")[0] in left]
        self.found.slides = [each for each in self.found.slides if {each.guide, each.block} <= left]
        self.found.drives = [each for each in self.found.drives if moved_by(each) <= left]

    def _lonely(self) -> set[str]:
        """Bodies of one point on which nothing slides and which nothing moves."""
        needed = {name for each in self.found.slides for name in (each.guide, each.block)}
        needed |= {name for each in self.found.wheels for name in each.values["links"]}
        needed |= {name for each in self.found.drives for name in moved_by(each)}
        return {name for name, body in self.found.bodies.items() if len(body.places) == 1 and name not in needed}

    def _islands(self) -> set[str]:
        """Bodies of the file that no chain of pins, guides, wheels and actuators joins to the frame."""
        joined = [{each.guide, each.block} for each in self.found.slides]
        joined += [set(each.values["links"]) for each in self.found.wheels]
        joined += [moved_by(each) for each in self.found.drives]
        points = {point for body in self.found.all for point in body.places}
        joined += [{body.name for body in self.found.all if point in body.places} for point in points]
        reached, before = {FRAME}, 0
        while len(reached) > before:
            before = len(reached)
            reached |= {name for each in joined if each & reached for name in each}
        return self.found.bodies.keys() - reached

    def _drop_fixed(self) -> None:
        """Drops drivers of what turned out to be fixed."""
        for each in list(self.found.drives):
            if each.turn == FRAME or (each.between and each.between[0][0] == each.between[1][0]):
                self.found.drives.remove(each)
                message = _("what it moves is fixed, as links hold each other; it is left out")
                self.remarks.remark("warning", message, _("see the links"), "import.linkage_fixed", key=each.name)

    def _remark(
        self,
        severity: Severity,
        message: Message,
        remedy: Message,
        connector: Connector,
        code: str = "import.linkage_input",
    ) -> None:
        self.remarks.remark(severity, message, remedy, code, line=connector.line, key=connector.shown)


def moved_by(drive: Drive) -> set[str]:
    """The bodies that a driver moves against each other."""
    if drive.between is not None:
        return {body for body, _point in drive.between}
    return {drive.turn or FRAME, drive.against}
