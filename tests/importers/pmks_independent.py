"""Share links of PMKS+, texts and .pmks files of PMKS, written and read a second time from their descriptions.

Independent of the package: reading gives the constraints of :class:`tests.importers.planar.Planar`.
"""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass, field
from urllib.parse import unquote

from tests.importers.planar import FRAME, Place, Planar

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
#: Lengths of a link's unit, m: inch, cm, m, none.
LENGTHS = (0.0254, 0.01, 1.0, 0.01)
SLIDES, DRIVEN, GROUND, WELDED, TRACED, SEALED = 1, 2, 4, 8, 16, 32
CLOCKWISE, NO_GRAVITY = 1, 256


# -- writing share links


def digits(value: int) -> str:
    """An integer, most significant digit first; a leading 0 is the minus."""
    found, rest = "", abs(value)
    while rest:
        found, rest = DIGITS[rest % 64] + found, rest // 64
    return ("0" if value < 0 else "") + found or "0"


def decimal(value: float) -> str:
    return digits(round(1000 * value))


def joint(name: str, x: float, y: float, flags: int = 0, angle: float = 0.0, *slot: object) -> str:
    """A joint; ``slot``: carrier, ends of the slot, own speed."""
    more = [decimal(each) if isinstance(each, float) else str(each) for each in slot]
    return ",".join([DIGITS[flags] + name, name, decimal(x), decimal(y), decimal(angle), *more])


def bar(joints: str, mass: float = 1.0, inertia: float = 1.0, centre: Place = (0.0, 0.0), **more: object) -> str:
    """A link of joints with names of one letter; ``name``, ``colour``, ``parts``, ``root`` in ``more``."""
    numbers = [decimal(each) for each in (mass, inertia, *centre)]
    name, colour = str(more.get("name", joints)), str(more.get("colour", "c5cae9"))
    head = [("Y" if more.get("root", True) else "N") + "R" + joints, name, *numbers, colour]
    return ",".join([*head, *joints, "", *(more.get("parts") or [""])])  # type: ignore[misc]


def block(joints: str, mass: float = 1.0) -> str:
    """A block of a pin and a slide."""
    return ",".join(["YP" + joints, joints, decimal(mass), "0", "0", "0", "", *joints, "", ""])


def force(name: str, link: str, start: Place, end: Place, size: float, flags: int = 0) -> str:
    return ",".join([DIGITS[flags] + name, link, name, *(decimal(each) for each in (*start, *end)), decimal(size)])


def share_link(
    joints: list[str],
    links: list[str],
    forces: tuple[str, ...] = (),
    *,
    flags: int = NO_GRAVITY,
    rpm: int = 20,
    slow: float = 0.0,
    units: str = "1011",
) -> str:
    """The address: settings, records, and the character that checks the length."""
    head = [DIGITS[flags // 64] + DIGITS[flags % 64], f"{decimal(0.5)},{decimal(slow)}", f"{digits(rpm)},0", units]
    body = ".".join([*head, *joints, "", *links, "", *forces, "", "N_"])
    return f"https://app.pmksplus.com/?{body}{DIGITS[len(body) % 62]}"


# -- reading them


@dataclass
class Reading:
    """The machine, where its joints are at the start (m) and on which bodies, the traced ones, lengths of a unit."""

    machine: Planar = field(default_factory=Planar)
    points: dict[str, tuple[str, Place]] = field(default_factory=dict)
    traced: set[str] = field(default_factory=set)
    #: Turn per minute of the input, counter-clockwise, or way per second, m.
    rates: list[float] = field(default_factory=list)
    #: Of a text: the links of each joint with its place.
    joints: list[tuple[list[str], Place]] = field(default_factory=list)


def number_of(text: str) -> float:
    value = 0
    for digit in text:
        value = 64 * value + DIGITS.index(digit)
    return (-value if text.startswith("0") else value) / 1000


def angle_of(text: str) -> float:
    """An angle in rad; of a multiple of 15 degrees the exact one."""
    value, step = number_of(text), math.pi / 12
    return step * round(value / step) if abs(value - step * round(value / step)) <= 5e-4 else value


def read_link(address: str) -> Reading:
    """The reading of a share link with names of joints and root letters of links."""
    records = unquote(address.partition("?")[2]).split(".")
    unit, flags = LENGTHS[DIGITS.index(records[3][0])], 64 * DIGITS.index(records[0][0]) + DIGITS.index(records[0][1])
    ends = [k for k, record in enumerate(records) if not record and k > 3]
    joints = {
        record.split(",")[0][1:]: (DIGITS.index(record[0]), record.split(",")) for record in records[4 : ends[0]]
    }
    links = [record.split(",") for record in records[ends[0] + 1 : ends[1]]]
    found = Reading()
    at = {name: (number_of(record[2]) * unit, number_of(record[3]) * unit) for name, (_f, record) in joints.items()}
    rods = {each[0][2:]: each[7 : each.index("", 7)] for each in links if each[0][:2] == "YR"}
    for name, (bits, record) in joints.items():  # pins lie on the lines of their slots
        if bits & SLIDES and not bits & GROUND:
            pin = next(
                each for link in links if link[0][1] == "P" and name in link[7:] for each in link[7:9] if each != name
            )
            a, b = (at[each] for each in record[6:8])
            dx, dy = b[0] - a[0], b[1] - a[1]
            share = ((at[pin][0] - a[0]) * dx + (at[pin][1] - a[1]) * dy) / (dx * dx + dy * dy)
            at[pin] = at[name] = (a[0] + share * dx, a[1] + share * dy)
    holders = {name: [rod for rod, held in rods.items() if name in held] for name in joints}
    for name, (bits, record) in joints.items():
        if bits & SLIDES:
            continue
        bodies = ([FRAME] if bits & GROUND else []) + holders[name]
        for other in bodies[1:]:
            found.machine.pin(bodies[0], other, at[name])
        if bodies:
            found.points[record[1]] = (bodies[-1], at[name])
        if bits & TRACED:
            found.traced.add(record[1])
        if bits & DRIVEN:
            rpm = (-1 if flags & CLOCKWISE else 1) * round(1000 * number_of(records[2].split(",")[0]))
            found.rates.append(rpm)
            found.machine.turn(bodies[1], bodies[0], lambda t, w=rpm * math.pi / 30: w * t)  # type: ignore[misc]
    for link in (each for each in links if each[0][1] == "P"):
        pin, slide = sorted(link[7:9], key=lambda name: joints[name][0] & SLIDES)
        bits, record = joints[slide]
        guide, through, angle = FRAME, at[pin], angle_of(record[4])
        if not bits & GROUND:
            guide, through = record[5], at[record[6]]
            end = at[record[7]]
            angle = math.atan2(end[1] - through[1], end[0] - through[0])
        body = holders[pin][0] if joints[pin][0] & WELDED else "block " + link[0]
        pinned = ([FRAME] if joints[pin][0] & GROUND else []) + holders[pin]
        for other in [each for each in pinned if each != body]:
            found.machine.pin(body, other, at[pin])
        found.machine.slide(guide, body, at[pin], angle, through)
        found.machine.parallel(body, guide)
        if bits & DRIVEN:
            sense = -1 if flags & CLOCKWISE else 1  # of what has no speed of its own, a slide's as well
            own = number_of(record[8]) if len(record) > 8 else sense * number_of(records[1].split(",")[1])
            found.rates.append(own * unit)
            found.machine.move(guide, body, at[pin], angle, lambda t, v=own * unit: v * t)  # type: ignore[misc]
    return found


# -- texts and files of PMKS

GROUNDS = {"0", "gnd", "grnd", "grond", "gound", "groud"}


def read_text(text: str) -> Reading:
    """The reading of a text of PMKS, in mm; ``rates``: its speed in rad/s where it says one."""
    if "mech=" in text:
        settings, _unused, mechanism = unquote(text).rpartition("?")[2].partition("mech=")
        speeds = re.findall(r"\bs=?(-?[\d.]+)", settings.replace("set=", ""))
        text = "\n".join([*(f"s={each}" for each in speeds), mechanism])
    records, speed = [], []
    for line in re.split(r"[\n|]", text):
        words = re.split(r"[,\s]+", line.strip().rstrip(","))
        if words[0].startswith("s="):
            speed.append(float(words[0][2:]))
        kinds = [k for k, word in enumerate(words) if word.upper() in ("R", "P", "RP", "G")]
        if not kinds or "=" in words[0]:
            continue
        names, (x, y, *rest) = words[: kinds[-1]], words[kinds[-1] + 1 :]
        numbers = [each for each in rest if re.fullmatch(r"[-+]?[\d.]+", each)]
        flags = next((each for each in rest if re.fullmatch(r"[-+tf]+", each, re.I)), "")
        flags = flags or "".join(each[0] for each in rest if each.lower() in ("true", "false"))
        angle = math.radians(float(numbers[0])) if numbers else 0.0
        bodies = [FRAME if each.lower() in GROUNDS or each.lower().startswith("ground") else each for each in names]
        driven = len(flags) > 3 and flags[3] in "tT+"
        records.append((bodies, words[kinds[-1]].upper(), (float(x) / 1e3, float(y) / 1e3), angle, driven))
    return _machine(records, speed)


def read_pmks(text: str) -> Reading:
    """The reading of a .pmks file whose angles are 0, in mm."""
    data = json.loads(text)
    records = []
    for index, each in enumerate(data["Joints"]):
        bodies = [FRAME if link.lower().startswith("ground") else link for link in each["Links"]]
        driven = index == data.get("DrivingIndex")
        records.append((bodies, each["TypeOfJoint"], (each["X"] / 1e3, each["Y"] / 1e3), 0.0, driven))
    return _machine(records, [data["InputSpeed"]] if "InputSpeed" in data else [])


Record = tuple[list[str], str, Place, float, bool]


def _machine(records: list[Record], speed: list[float]) -> Reading:
    found = Reading(rates=speed)
    for bodies, kind, place, angle, _driven in records:
        if kind != "G":
            found.joints.append((bodies, place))
        if kind == "R":
            for other in bodies[1:]:
                found.machine.pin(bodies[0], other, place)
        elif kind in ("P", "RP"):  # the slot is the first link's
            found.machine.slide(bodies[0], bodies[1], place, angle)
            if kind == "P":
                found.machine.parallel(bodies[1], bodies[0])
        elif kind == "G":
            _gear(found, records, bodies, place)
    driven = [each for each in records if each[4]] or [
        each for each in records if each[1] in ("R", "P") and len(each[0]) == 2
    ]
    bodies, kind, place, angle, _unused = driven[0]
    moved = bodies[0] if bodies[1] == FRAME else bodies[1]
    other = bodies[1] if moved == bodies[0] else bodies[0]
    rate = speed[0] if speed else 1.0
    if kind == "R":
        found.machine.turn(moved, other, lambda t: rate * t)
    else:
        found.machine.move(other, moved, place, angle, lambda t: rate * t / 1e3)
    return found


def _gear(found: Reading, records: list[Record], bodies: list[str], contact: Place) -> None:
    """Wheels by their contact: radii from their pins, on a third body that has pins at both places."""
    pins = [(set(each[0]), each[2]) for each in records if each[1] == "R" and len(each[0]) > 1]
    centres = [[place for names, place in pins if name in names] for name in bodies]
    others = {name for names, _place in pins for name in names} - (set(bodies) - {FRAME})
    for carrier in sorted(others, key=lambda name: name != FRAME):
        there = [place for names, place in pins if carrier in names]
        for a in (each for each in centres[0] if each in there):
            for b in (each for each in centres[1] if each in there and each != a):
                inside = (a[0] - contact[0]) * (b[0] - contact[0]) + (a[1] - contact[1]) * (b[1] - contact[1]) > 0
                ratio = math.dist(a, contact) / math.dist(b, contact)
                if carrier not in bodies:
                    found.machine.coupled(bodies[0], bodies[1], carrier, ratio if inside else -ratio)
                    return
