"""Share links of PMKS+ taken apart: sections, records, flags, corrections, checks, with places for findings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeVar
from urllib.parse import unquote

from linkwright.exporters.pmks_plus.link import (
    CORRECTED,
    DIGITS,
    ROOTS,
    Share,
    ShareForce,
    ShareJoint,
    ShareLink,
    check_character,
    digest,
    read_whole,
)
from linkwright.importers.layout import Remarks
from linkwright.words import Message, _

Kind = TypeVar("Kind", ShareJoint, ShareLink, ShareForce)
#: Numbers in a record of a joint of the oldest links: flags and id, x, y, angle.
OLDEST = 4
COPY_AGAIN = _("copy the whole link again from the address bar of PMKS+")


@dataclass(frozen=True)
class Record:
    """A record, and its line and column in the file."""

    text: str
    line: int
    column: int


class ShareReader:
    """Reads one link; what is wrong is among the remarks."""

    def __init__(self, text: str, remarks: Remarks) -> None:
        self.remarks = remarks
        self.line, self.start, self.body = link_in(text)
        self.share = Share()
        self.places: dict[str, Record] = {}
        self.corrected: list[str] = []

    def refuse(self, record: Record, message: Message, code: str, key: str = "") -> None:
        """An error about a record."""
        place = {"line": record.line, "column": record.column}
        self.remarks.remark("error", message, COPY_AGAIN, code, key=key, **place)

    def read(self) -> Share | None:
        """The machine of the link; None, with an error among the remarks, where it is none."""
        if self.body.startswith("j="):
            message = _("this link is of the time before 2023, in a form that is not read here")
            self.remarks.remark("error", message, _("open it in PMKS+ and share it again"), "import.old_link")
            return None
        body = self.checked(self.body)
        records = self.records(body)
        try:
            *settings, joints, links, forces, tail = self.sections(records, body)
        except StopIteration:
            message = _("this is no whole share link of PMKS+: it ends before its links and forces")
            self.remarks.remark("error", message, COPY_AGAIN, "import.cut_link", line=self.line)
            return None
        self.settings([each[0].text for each in settings])
        self.share.joints = list(self.each(joints, joint_of))
        self.share.links = list(self.each(links, link_of))
        self.share.forces = list(self.each(forces, force_of))
        for each in tail:
            self.tail(each)
        self.resolve()
        return None if self.remarks.failed else self.share

    def checked(self, body: str) -> str:
        """The link without its check character and digest; a warning where they do not fit."""
        head, mark, found = body.rpartition("*")
        damaged = False
        if mark and len(found) == 6:
            body, damaged = head, found != digest(head)
        if "~" not in body and oldest(body):
            return body
        if damaged or check_character(body[:-1]) != body[-1:]:
            message = _("the link was changed on its way: its check does not fit, so its numbers may be wrong")
            self.remarks.remark("warning", message, COPY_AGAIN, "import.damaged_link", line=self.line)
        return body[:-1]

    def records(self, body: str) -> Iterator[Record]:
        """The records between the points, with their columns."""
        column = self.start
        for text in body.split("."):
            yield Record(text, self.line, column)
            column += len(text) + 1

    def sections(self, records: Iterator[Record], body: str) -> list[list[Record]]:
        """Four settings, joints, links, forces, and the entries of the tail; raises StopIteration where one lacks."""
        found = [[next(records)] for _setting in range(4)]
        for lacking in (False, False, True):
            section: list[Record] = []
            while (record := next(records, None)) is not None and record.text:
                section.append(record)
            if record is None and not lacking:
                raise StopIteration
            found.append(section)
        next(records, None)  # what is selected
        rest = list(records)
        entries, column = ".".join(each.text for each in rest), rest[0].column if rest else 1
        tail = []
        for text in entries.split(","):
            tail.append(Record(text, self.line, column))
            column += len(text) + 1
        return [*found, [each for each in tail if each.text]]

    def settings(self, texts: list[str]) -> None:
        """Flags, decimals, whole numbers, units."""
        share, (flags, decimals, integers, units) = self.share, texts
        bits = flags_of(flags)
        share.clockwise, share.gravity = bool(bits & 1), not bits >> 8 & 1
        for place, text in enumerate(decimals.split(",")[:2]):
            share.decimals[place] = number(text, 1000 * share.decimals[place]) / 1000
        for place, text in enumerate(integers.split(",")[:2]):
            share.integers[place] = number(text, share.integers[place])
        given = tuple(DIGITS.find(each) for each in units)
        share.units = (*given, *share.units[len(given) :])

    def each(self, records: list[Record], made: Callable[[str], Kind]) -> Iterator[Kind]:
        """What the records say; an error where one is none."""
        for record in records:
            try:
                found = made(record.text)
            except (ValueError, KeyError, IndexError):
                message = _("this is no record of PMKS+: {text}", text=record.text)
                self.refuse(record, message, "import.no_record")
                continue
            letter = {ShareJoint: "J", ShareLink: "L", ShareForce: "F"}[type(found)]
            if letter + found.id in self.places:
                message = _("there are two of the name {name}", name=found.id)
                self.refuse(record, message, "import.twice", found.id)
            self.places[letter + found.id] = record
            yield found

    def tail(self, record: Record) -> None:
        """An entry of the tail: a correction is put in, what is only seen in PMKS+ is skipped."""
        if record.text[0] != "P":
            self.share.tail.append(record.text)
            return
        self.corrected.append(record.text)
        tag, *rest = record.text.split("~")
        try:
            place, value = int(rest[0]), float(rest[1])
            if len(rest) != 2 or place < 0 or not math.isfinite(value):
                raise ValueError(record.text)
            if tag in ("PD", "PI"):
                {"PD": self.share.decimals, "PI": self.share.integers}[tag][place] = value
                return
            owner = next(each for each in self.share.of(tag[1]) if each.id == tag[2:])
            setattr(owner, CORRECTED[tag[1]][place], value)
        except (ValueError, IndexError, KeyError, StopIteration):
            message = _("{text} corrects nothing that is in the link", text=record.text)
            self.refuse(record, message, "import.no_correction")

    def resolve(self) -> None:
        """Errors for names that nothing has."""
        joints, links = {each.id for each in self.share.joints}, {each.id: each for each in self.share.links}
        for link in self.share.links:
            missing = [each for each in link.joints if each not in joints]
            missing += [each for each in link.parts if each not in links]
            self.missing(f"L{link.id}", missing)
        for force in self.share.forces:
            self.missing(f"F{force.id}", [] if force.link in links else [force.link])
        for joint in self.share.joints:
            named = [each for each in (joint.carrier, *joint.slot) if each]
            if not named:
                continue
            carrier = links.get(joint.carrier)
            missing = [] if carrier else [joint.carrier]
            missing += [each for each in joint.slot if carrier and each not in carrier.joints]
            if not missing and (joint.slot[0] == joint.slot[1] or joint.grounded):
                missing = [joint.id]
            self.missing(f"J{joint.id}", missing)

    def missing(self, place: str, names: list[str]) -> None:
        """An error where a record names what is not there."""
        if names:
            message = _("{name} names {missing}, which the link does not have", name=place[1:], missing=names[0])
            self.refuse(self.places[place], message, "import.missing", place[1:])


def link_in(text: str) -> tuple[int, int, str]:
    """The line and column of a link in a text, from 1, and the link without its address and percent signs."""
    lines = text.splitlines() or [""]
    number = next((k for k, line in enumerate(lines) if "?" in line), None)
    if number is None:
        number = next((k for k, line in enumerate(lines) if line.strip()), 0)
    line = lines[number]
    start = line.find("?") + 1 if "?" in line else len(line) - len(line.lstrip())
    return number + 1, start + 1, unquote(line[start:].strip())


def oldest(body: str) -> bool:
    """Whether a link is of the first of these forms, without names and check character."""
    records = body.split(".")
    return len(records) > 4 and records[4].count(",") == OLDEST - 1


def flags_of(digits: str) -> int:
    """Flags as a number; raises ValueError."""
    return abs(read_whole(digits))


def number(digits: str, otherwise: float) -> float:
    """The whole number of digits, or what there is otherwise."""
    try:
        return read_whole(digits)
    except ValueError:
        return otherwise


def numbers(texts: list[str]) -> list[float]:
    """Numbers in thousandths; raises ValueError."""
    return [read_whole(each) / 1000 for each in texts]


def joint_of(text: str) -> ShareJoint:
    """A joint; raises ValueError."""
    parts = text.split(",")
    if len(parts) == OLDEST:
        parts.insert(1, parts[0][1:])
    if not parts[0][1:]:
        raise ValueError(text)
    bits = flags_of(parts[0][0])
    x, y, angle = numbers(parts[2:5])
    prismatic, driven, grounded, welded, traced, sealed = (bool(bits >> k & 1) for k in range(6))
    carrier, one, other, *given = [*parts[5:10], *[""] * 5][:5]
    speed, mass = (read_whole(each) / 1000 if each else 0.0 for each in given)
    found = ShareJoint(parts[0][1:], parts[1], x, y, angle, speed, mass)
    found.prismatic, found.driven, found.grounded = prismatic, driven, grounded
    found.welded, found.traced, found.sealed = welded, traced, sealed
    found.carrier, found.slot = carrier, (one, other)
    return found


def link_of(text: str) -> ShareLink:
    """A link; raises ValueError, KeyError."""
    parts = text.split(",")
    if parts[0][1:2] not in ("R", "P") or parts[0][:1] not in ROOTS or len(parts) < 8:
        return oldest_link(parts)
    root, block, name = ROOTS[parts[0][0]], parts[0][1] == "P", parts[0][2:]
    end = parts.index("", 7) if "" in parts[7:] else len(parts)
    joined = tuple(each for each in parts[end + 1 :] if each)
    joints = tuple(parts[7:end])
    colour = f"#{parts[6].lower()}" if parts[6] else ""
    mass, inertia, x, y = numbers(parts[2:6])
    return ShareLink(name, parts[1], joints, joined, mass, inertia, x, y, colour, block, root)


def oldest_link(parts: list[str]) -> ShareLink:
    """A link of the first form: its kind and id, four numbers, joints; raises ValueError."""
    kind, name = parts[0][:1], parts[0][1:]
    if kind not in ("R", "P") or not name or not parts[5:]:
        raise ValueError(parts[0])
    mass, inertia, x, y = numbers(parts[1:5])
    return ShareLink(name, name, tuple(parts[5:]), (), mass, inertia, x, y, block=kind == "P")


def force_of(text: str) -> ShareForce:
    """A force; raises ValueError."""
    head, link, *rest = text.split(",")
    name = rest.pop(0) if len(rest) == 6 else head[1:]
    bits = flags_of(head[0])
    start_x, start_y, end_x, end_y, magnitude = numbers(rest)
    if not head[1:] or magnitude < 0:
        raise ValueError(text)
    return ShareForce(
        head[1:], link, name, start_x, start_y, end_x, end_y, magnitude, bool(bits & 1), bool(bits >> 1 & 1)
    )
