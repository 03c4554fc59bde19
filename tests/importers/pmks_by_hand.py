"""A second reading of texts of PMKS, from the description of the format, for the solver of these tests."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

from tests.importers.planar import FRAME, Place, Planar

MM = 1e-3


@dataclass
class ByHand:
    """What a text says, for the solver; ``at``: joints (A, B …) with a body and a place (m)."""

    machine: Planar = field(default_factory=Planar)
    at: dict[str, tuple[str, Place]] = field(default_factory=dict)


def by_hand(text: str, speed: float) -> ByHand:
    """Reads joints line by line; the fourth flag drives, else the first joint of two links."""
    found, joints = ByHand(), []
    for line in text.strip().splitlines():
        links, kind, rest = re.fullmatch(r"(.+?)[ ,]+(R|P|RP|G)[ ,]+(.+)", line.strip(), re.IGNORECASE).groups()  # type: ignore[union-attr]
        numbers = [float(each) for each in re.findall(r"(?<![\w.])-?\d+\.?\d*", rest)] + [0.0, 0.0]
        names = [FRAME if re.match("0$|gnd|gr", each, re.IGNORECASE) else each for each in re.split("[ ,]+", links)]
        place = (numbers[0] * MM, numbers[1] * MM)
        joints.append((kind.upper(), names, place, math.radians(numbers[2]), re.search(r"[tf+-]{3}[t+]\s*$", rest)))
    for letter, (kind, names, place, angle, _driven) in zip("ABCDEFGHIJKLMNOP", joints, strict=False):
        moving = next((each for each in names[::-1] if each != FRAME), FRAME)
        if kind != "G":
            on = names[-1] if kind in ("P", "RP") else moving
            found.at |= {letter: (on, place)} if on != FRAME or kind == "R" else {}
        if kind == "R":
            for each in names[1:]:
                found.machine.pin(names[0], each, place)
        elif kind in ("P", "RP"):
            found.machine.slide(names[0], names[1], place, angle)
            if kind == "P":
                found.machine.parallel(names[0], names[1])
    for kind, names, place, _angle, _driven in joints:
        if kind == "G":
            mesh(found.machine, joints, names, place)
    drives = [each for each in joints if each[4]] or [
        each for each in joints if len(each[1]) > 1 and each[0] in ("R", "P")
    ]
    kind, names, place, angle, _driven = drives[0]
    if kind == "P":
        found.machine.move(names[0], names[1], place, angle, lambda t: speed * MM * t)
    else:
        turned, against = (names[1], names[0]) if names[1] != FRAME else (names[0], names[1])
        found.machine.turn(turned, against, lambda t: speed * t)
    return found


def mesh(machine: Planar, joints: list, wheels: list[str], contact: Place) -> None:
    """Two wheels by the radii from their centres, which one link carries, to the point of contact."""
    pins = [(names, place) for kind, names, place, *_rest in joints if kind == "R"]
    for carrier in dict.fromkeys(name for names, _place in pins for name in names):
        centres = [next((place for names, place in pins if {wheel, carrier} <= set(names)), None) for wheel in wheels]
        if carrier not in wheels and None not in centres:
            break
    away = [contact[0] - each[0] + contact[1] - each[1] for each in centres if each is not None]
    machine.coupled(*wheels, carrier, away[0] / away[1])
