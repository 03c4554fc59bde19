"""A second reading of share links of PMKS+, from the description of the format, for the solver of these tests.

Independent of the package; of a link it knows what the links of these tests have.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from urllib.parse import unquote

from tests.importers.planar import FRAME, Place, Planar

VALUES = {digit: value for value, digit in enumerate(
    "0123456789" + "ABCDEFGHIJKLMNOPQRSTUVWXYZ" + "abcdefghijklmnopqrstuvwxyz" + "_-"
)}  # fmt: skip
METRES = {"0": 0.0254, "1": 0.01, "2": 1.0, "3": 0.01}
STEP = math.radians(15)


def value(digits: str) -> float:
    """A number in thousandths; a leading 0 is a minus."""
    total = 0
    for digit in digits:
        total = total * 64 + VALUES[digit]
    return (-total if digits.startswith("0") else total) / 1000


def written(number: float) -> str:
    """The digits of a number in thousandths."""
    thousandths, digits = round(abs(number) * 1000), ""
    while thousandths or not digits:
        thousandths, rest = divmod(thousandths, 64)
        digits = list(VALUES)[rest] + digits
    return "0" + digits if number < 0 else digits


def stamped(body: str, digest: bool = False) -> str:
    """A link of a body with its check character, and its digest."""
    checks = "".join(list(VALUES)[:62])
    text = body + checks[len(body) % 62]
    if not digest:
        return "https://app.pmksplus.com/?" + text
    found = 2166136261
    for letter in text:
        found = ((found ^ ord(letter)) * 16777619) % 2**32
    places = [checks[found // 62**k % 62] for k in range(5, -1, -1)]
    return f"https://app.pmksplus.com/?{text}*{''.join(places)}"


@dataclass
class ByHand:
    """What a link says, for the solver; ``at``: places of joints (m); ``rates``: of its drivers, rad/s or m/s."""

    machine: Planar = field(default_factory=Planar)
    at: dict[str, Place] = field(default_factory=dict)
    body_at: dict[str, str] = field(default_factory=dict)
    rates: list[float] = field(default_factory=list)


def by_hand(link: str, oldest: bool = False) -> ByHand:
    """Reads a link; ``oldest``: of the form without names and check."""
    text = unquote(link.partition("?")[2])
    text = text if oldest else text.partition("*")[0][:-1]
    flags, decimals, integers, units, rest = text.split(".", 4)
    joint_part, rest = rest.split("..", 1)
    link_part, rest = rest.split("..", 1)
    settings = {
        "D": [value(each) for each in decimals.split(",")],
        "I": [1000 * value(each) for each in integers.split(",")],
    }
    tail = rest.split("N_.", 1)[1] if "N_." in rest else ""
    unit, clockwise = METRES[units[0]], VALUES[flags[-1]] & 1
    found, joints = ByHand(), {}
    for record in joint_part.split("."):
        names = record.split(",")
        names.insert(1, names[0][1:]) if oldest else None
        joints[names[0][1:]] = (VALUES[names[0][0]], [value(each) for each in names[2:5]], names[5:8], names[8:9])
    for entry in tail.split(","):
        if entry.startswith(("PD~", "PI~")):
            _tag, place, number = entry.split("~")
            settings[entry[1]][int(place)] = float(number)
        elif entry.startswith("PJ"):
            owner, place, number = entry[2:].split("~")
            joints[owner][1][int(place)] = float(number)
    links = {}
    for record in link_part.split("."):
        names = record.split(",")
        if record.startswith("N"):
            continue
        own = names[5:] if oldest else names[7 : names.index("", 7)]
        links[names[0][1 if oldest else 2 :]] = ((names[0][0] if oldest else names[0][1]) == "P", own)
    found.at = {name: (each[1][0] * unit, each[1][1] * unit) for name, each in joints.items()}
    for name, (bits, numbers, slot, speed) in joints.items():
        holders = [body for body, (_block, own) in links.items() if name in own]
        found.body_at[name] = FRAME if bits & 4 and not bits & 1 else next(iter(holders), FRAME)
        own_speed = value(speed[0]) if speed else 0.0
        turned = math.tau / 60 * (own_speed or (-1 if clockwise else 1) * settings["I"][0])
        pushed = unit * (own_speed or (-1 if clockwise else 1) * settings["D"][1]) if bits & 1 else 0.0
        if not bits & 1:
            pin(found, name, [FRAME] * (bits >> 2 & 1) + holders, bool(bits & 8), turned if bits & 2 else None)
            continue
        (block,) = holders
        line = (
            round(numbers[2] / STEP) * STEP
            if abs(numbers[2] - round(numbers[2] / STEP) * STEP) < 5e-4
            else numbers[2]
        )
        guide, through = FRAME, found.at[name]
        if any(slot):
            a, b = (found.at[each] for each in slot[1:])
            guide, through, line = slot[0], a, math.atan2(b[1] - a[1], b[0] - a[0])
        found.machine.slide(guide, block, found.at[name], line, through)
        found.machine.parallel(block, guide)
        if bits & 2:
            found.rates.append(pushed)
            found.machine.move(guide, block, found.at[name], line, lambda t, rate=pushed: rate * t)
    return found


def pin(found: ByHand, name: str, bodies: list[str], welded: bool, speed: float | None) -> None:
    """Bodies pinned, or welded, at a joint; the second turns against the first."""
    first, *others = bodies
    for body in others:
        found.machine.pin(first, body, found.at[name])
        if welded:
            found.machine.parallel(first, body)
    if speed is not None:
        found.rates.append(speed)
        found.machine.turn(others[0], first, lambda t: speed * t)
