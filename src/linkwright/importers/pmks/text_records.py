"""Files of PMKS taken apart: records of joints in a text, in an address, or in JSON; settings beside them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from urllib.parse import unquote

from linkwright.importers.layout import Remarks
from linkwright.words import Message, _

KINDS = ("R", "P", "RP", "G")
#: Names of the fixed link; so is all that begins with the last one.
GROUND = ("0", "gnd", "grnd", "grond", "gound", "groud", "ground")
_FLAGS = re.compile(r"[tfTF+-]{1,4}")
_SETTING = re.compile(r"(name|set|s|d|e|f)\s*=\s*(.*)", re.IGNORECASE)
_ADDRESS_SETTING = re.compile(r"([a-z])=?(-?[\d.]+)", re.IGNORECASE)
#: Angles beyond this are no radians folded to a quarter turn.
QUARTER = 1.001 * math.pi / 2


@dataclass
class Record:
    """A joint: its kind, the links that meet there, its place, the angle of its slot (rad), whether its path is
    shown, whether it is driven."""

    kind: str
    links: list[str]
    x: float
    y: float
    angle: float = 0.0
    shown: bool = False
    driven: bool = False
    line: int = 1
    column: int = 1


@dataclass
class PmksFile:
    """What a file holds; ``speed``: rad/s or length per second, None: not given; ``driving``: number of the joint."""

    name: str = ""
    driving: int | None = None
    speed: float | None = None
    records: list[Record] = field(default_factory=list)
    colours: dict[str, str] = field(default_factory=dict)


def is_ground(name: str) -> bool:
    """Whether a name is one of those of the fixed link."""
    return name.lower() in GROUND or name.lower().startswith(GROUND[-1])


def pmks_file(text: str, remarks: Remarks) -> PmksFile | None:
    """What a text holds; None, with an error among the remarks, where it is none of PMKS."""
    if text.lstrip().startswith("{"):
        return _json_file(text, remarks)
    found = PmksFile()
    for line, column, record in _records(text, found, remarks):
        joint = joint_of(record)
        if joint is None:
            _refuse(remarks, _("this is no joint of PMKS: {text}", text=record.strip()), line, column)
            continue
        joint.line, joint.column = line, column
        found.records.append(joint)
    if not found.records and not remarks.failed:
        _refuse(remarks, _("there is no joint in this text"), 1, 1)
    if found.driving is not None and 0 <= found.driving < len(found.records):
        found.records[found.driving].driven = True
    return None if remarks.failed else found


def _records(text: str, found: PmksFile, remarks: Remarks) -> Iterator[tuple[int, int, str]]:
    """Line, column and text of each record, settings put aside; of several addresses the first one."""
    addresses = [k for k, line in enumerate(text.splitlines(), 1) if "pmks.html?" in line]
    for number, line in enumerate(text.splitlines(), 1):
        if addresses and number != addresses[0]:
            continue
        start = 0
        if addresses:
            line, start = _address(line, found)
        for part in line.split("|"):
            setting = _SETTING.fullmatch(part.strip())
            record = re.sub(r"^\s*mech\s*=", "", part)
            if setting and setting[1].lower() == "set":
                _set_all(found, setting[2])
            elif _ADDRESS_SETTING.fullmatch(part.strip()):
                _set_all(found, part)
            elif setting:
                _set(found, setting[1].lower(), setting[2].strip())
            elif record.strip(" ,\t"):
                yield number, start + 1 + len(part) - len(part.lstrip()), record
            start += len(part) + 1
    if len(addresses) > 1:
        message = _("the file holds {count} machines; the first is read", count=len(addresses))
        remedy = _("put each of the others into a file of its own")
        remarks.remark("warning", message, remedy, "import.several", line=addresses[1])


def _address(line: str, found: PmksFile) -> tuple[str, int]:
    """The records of an address, and the column before them."""
    query = line.partition("?")[2].replace('"', "")
    for part in query.split("&"):
        key, _equals, value = part.partition("=")
        if key == "set":
            _set_all(found, unquote(value))
        elif key == "mech":
            return unquote(value), line.find(value)
    return "", 0


def _set_all(found: PmksFile, text: str) -> None:
    """Settings one after another, as s5|f5."""
    for letter, number in _ADDRESS_SETTING.findall(text):
        _set(found, letter.lower(), number)


def _set(found: PmksFile, key: str, value: str) -> None:
    """A setting: the name, the speed, the number of the driven joint; what steers solving says nothing here."""
    try:
        if key == "name":
            found.name = value
        elif key == "s":
            found.speed = float(value)
        elif key == "d":
            found.driving = int(value)
    except ValueError:
        return


def joint_of(text: str) -> Record | None:
    """The joint of a record; None: it is none."""
    words = [each for each in re.split(r"[,\s]+", text) if each]
    places = [k for k, each in enumerate(words) if each.upper() in KINDS]
    if not places or not words[: places[-1]]:
        return None
    kind, links, rest = words[places[-1]].upper(), words[: places[-1]], words[places[-1] + 1 :]
    numbers: list[float] = []
    while rest and (number := _number(rest[0])) is not None:
        numbers.append(number)
        rest = rest[1:]
    if len(rest) <= 4 and all(each.lower() in ("true", "false") for each in rest):  # as the oldest texts have them
        rest = ["".join(each[0] for each in rest)][: len(rest)]
    if not 1 <= len(numbers) <= 3 or len(rest) > 1 or not all(map(_FLAGS.fullmatch, rest)):
        return None
    x, y, angle = [*numbers, 0.0, 0.0][:3]
    flags = [each in "tT+" for each in rest[0]] if rest else []
    return Record(kind, links, x, y, math.radians(angle), any(flags[:1]), any(flags[3:]))


def _number(word: str) -> float | None:
    try:
        found = float(word)
    except ValueError:
        return None
    return found if math.isfinite(found) else None


def _json_file(text: str, remarks: Remarks) -> PmksFile | None:
    """The file that the later library writes."""
    try:
        data = json.loads(text)
        joints, links = list(data["Joints"]), list(data.get("Links") or [])
        found = PmksFile(str(data.get("Name") or ""))
        found.speed = float(data["InputSpeed"]) if data.get("InputSpeed") else None
        for joint in joints:
            place = float(joint["X"]), float(joint["Y"])
            names, kind = [str(each) for each in joint["Links"]], str(joint["TypeOfJoint"]).upper()
            if kind not in KINDS or not names:
                raise ValueError(kind)
            shown = bool(joint.get("PositionVisible"))
            found.records.append(Record(kind, names, *place, float(joint.get("Angle") or 0.0), shown))
        driven = data.get("DrivingIndex")
        if isinstance(driven, int) and 0 <= driven < len(joints):
            found.records[driven].driven = True
        found.colours = {str(each["Name"]): _colour(str(each.get("FillColor") or "")) for each in links}
    except (ValueError, KeyError, TypeError) as error:
        line = error.lineno if isinstance(error, json.JSONDecodeError) else 1
        _refuse(remarks, _("this is no file of PMKS: Joints with X, Y, TypeOfJoint and Links are missing"), line, 1)
        return None
    _lines_of(found.records, text)
    _angles(found, remarks)
    return found


def _lines_of(records: list[Record], text: str) -> None:
    """The line of each joint: that of its kind."""
    lines = [k for k, line in enumerate(text.splitlines(), 1) for _each in re.findall('"TypeOfJoint"', line)]
    for record, line in zip(records, lines, strict=False):
        record.line = line


def _angles(found: PmksFile, remarks: Remarks) -> None:
    """Angles of slots as rad where all fit into a quarter turn, else as degrees; a remark says which."""
    slots = [each for each in found.records if each.kind in ("P", "RP") and each.angle]
    if not slots:
        return
    degrees = any(abs(each.angle) > QUARTER for each in slots)
    for each in found.records:
        each.angle = math.radians(each.angle) if degrees else each.angle
    unit = "°" if degrees else "rad"
    message = _("the file does not say the unit of angles of slots; they are read in {unit}", unit=unit)
    remedy = _("check the directions of the guides")
    remarks.remark("warning", message, remedy, "import.angle_unit", line=slots[0].line)


def _colour(value: str) -> str:
    """A colour without its opacity."""
    return f"#{value[3:].lower()}" if re.fullmatch(r"#[0-9a-fA-F]{8}", value) else ""


def _refuse(remarks: Remarks, message: Message, line: int, column: int) -> None:
    remedy = _("write the links, one of R, P, RP, G, then x y, the angle, and four of t or f")
    remarks.remark("error", message, remedy, "import.no_joint", line=line, column=column)
