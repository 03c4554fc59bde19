"""Share links of PMKS+: records of a machine in the user's units, and the text that they become.

Numbers are whole thousandths in digits of base 64, the most significant first, with a leading 0 where negative;
entries ``P…~`` of the tail give those that thousandths do not hold.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from urllib.parse import quote

ADDRESS = "https://app.pmksplus.com/?"
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
#: Digits of the check character and the digest.
CHECKS = DIGITS[:62]
#: Numbers that entries of the tail correct, in their order, by the letter of what has them.
CORRECTED = {
    "J": ("x", "y", "angle", "speed", "mass"),
    "L": ("mass", "inertia", "centre_x", "centre_y"),
    "F": ("start_x", "start_y", "end_x", "end_y", "magnitude"),
}
#: Units by their numbers: length, force.
LENGTHS = ("in", "cm", "m", "cm")
#: Whether a link is a root, by its letter, which also says what PMKS+ shows of it.
ROOTS = dict.fromkeys("YAMG0123", True) | dict.fromkeys("Namg4567", False)


@dataclass
class ShareJoint:
    """A joint; ``prismatic``: a guide line, on the ground at an ``angle`` (rad) or in link ``carrier`` through the
    joints ``slot``. ``speed``: its own, rpm or length per second, 0: that of the whole machine."""

    id: str
    name: str
    x: float
    y: float
    angle: float = 0.0
    speed: float = 0.0
    mass: float = 0.0
    prismatic: bool = False
    driven: bool = False
    grounded: bool = False
    welded: bool = False
    traced: bool = False
    sealed: bool = False
    carrier: str = ""
    slot: tuple[str, str] = ("", "")

    @property
    def flags(self) -> tuple[bool, ...]:
        """What is packed into its first digit."""
        return self.prismatic, self.driven, self.grounded, self.welded, self.traced, self.sealed


@dataclass
class ShareLink:
    """A link, or the block of a guide; ``parts``: the links that are welded into it; ``root``: no such part."""

    id: str
    name: str
    joints: tuple[str, ...]
    parts: tuple[str, ...] = ()
    mass: float = 0.0
    inertia: float = 0.0
    centre_x: float = 0.0
    centre_y: float = 0.0
    colour: str = ""
    block: bool = False
    root: bool = True


@dataclass
class ShareForce:
    """A force on a link; its arrow begins where it acts, and gives only its direction."""

    id: str
    link: str
    name: str
    start_x: float
    start_y: float
    end_x: float
    end_y: float
    magnitude: float
    follows: bool = False
    outward: bool = True


@dataclass
class Share:
    """A machine; ``decimals``: scale of symbols, speed of slides; ``integers``: rpm, time step that is shown."""

    clockwise: bool = False
    gravity: bool = True
    decimals: list[float] = field(default_factory=lambda: [1.0, 0.0])
    integers: list[float] = field(default_factory=lambda: [20.0, 0.0])
    units: tuple[int, ...] = (1, 0, 1, 1)
    joints: list[ShareJoint] = field(default_factory=list)
    links: list[ShareLink] = field(default_factory=list)
    forces: list[ShareForce] = field(default_factory=list)
    tail: list[str] = field(default_factory=list)

    def of(self, letter: str) -> Sequence[ShareJoint | ShareLink | ShareForce]:
        """The records of one sort: J, L, F."""
        found: dict[str, Sequence[ShareJoint | ShareLink | ShareForce]]
        found = {"J": self.joints, "L": self.links, "F": self.forces}
        return found[letter]


def whole(value: int) -> str:
    """The digits of a whole number."""
    digits, rest = "", abs(value)
    while rest or not digits:
        digits, rest = DIGITS[rest % 64] + digits, rest // 64
    return f"0{digits}" if value < 0 else digits


def read_whole(digits: str) -> int:
    """The number of digits; raises ValueError."""
    if not digits:
        raise ValueError(digits)
    found = 0
    for digit in digits:
        found = 64 * found + DIGITS.index(digit)
    return -found if digits[0] == "0" else found


def thousandths(value: float) -> str:
    """The digits of a number in thousandths, halves away from zero on the positive side."""
    return whole(math.floor(1000 * value + 0.5))


def packed(flags: Iterable[bool]) -> str:
    """Flags as digits: as many as hold them."""
    bits = list(flags)
    value = sum(1 << k for k, each in enumerate(bits) if each)
    count = -(-len(bits) // 6)
    return "".join(DIGITS[value >> 6 * k & 63] for k in reversed(range(count)))


def check_character(body: str) -> str:
    """The character that stands for the length of what is before it."""
    return CHECKS[len(body) % len(CHECKS)]


def digest(body: str) -> str:
    """Six digits of the hash FNV-1a (32 bits) of UTF-16 units."""
    found, units = 0x811C9DC5, body.encode("utf-16-le")
    for k in range(0, len(units), 2):
        found = (found ^ units[k] ^ units[k + 1] << 8) * 0x01000193 & 0xFFFFFFFF
    digits = ""
    for _place in range(6):
        digits, found = CHECKS[found % 62] + digits, found // 62
    return digits


def share_text(share: Share) -> str:
    """The text of a machine, without the address: settings, records, corrections, check character and digest."""
    shown = (share.clockwise, False, False, True, True, True, False, bool(share.forces), not share.gravity)
    settings = (
        packed(shown),
        ",".join(thousandths(each) for each in share.decimals),
        ",".join(whole(math.floor(each)) for each in share.integers),
        "".join(DIGITS[each] for each in share.units),
    )
    records = [[joint(each) for each in share.joints], [link(each) for each in share.links]]
    records.append([force(each) for each in share.forces])
    parts = [*settings, *(part for each in records for part in (*each, "")), "N_"]
    tail = [*share.tail, *corrections(share)]
    body = ".".join([*parts, ",".join(tail)] if tail else parts)
    checked = body + check_character(body)
    return f"{checked}*{digest(checked)}"


def share_address(share: Share) -> str:
    """The whole link, with what an address cannot hold in percent signs."""
    return ADDRESS + quote(share_text(share), safe="!#$&'()*+,/:;=?@~")


def joint(each: ShareJoint) -> str:
    """The record of a joint."""
    numbers = (thousandths(value) for value in (each.x, each.y, each.angle))
    found = ",".join((packed(each.flags) + each.id, each.name, *numbers))
    slot = each.carrier, *each.slot
    if each.carrier or each.speed:
        found += "," + ",".join(slot)
    return found + (f",{thousandths(each.speed)}" if each.speed else "")


def link(each: ShareLink) -> str:
    """The record of a link."""
    numbers = (thousandths(value) for value in (each.mass, each.inertia, each.centre_x, each.centre_y))
    head = ("Y" if each.root else "N") + ("P" if each.block else "R") + each.id
    return ",".join(
        (head, each.name, *numbers, each.colour.removeprefix("#"), *each.joints, "", *(each.parts or [""]))
    )


def force(each: ShareForce) -> str:
    """The record of a force."""
    places = (each.start_x, each.start_y, each.end_x, each.end_y, each.magnitude)
    head = packed((each.follows, each.outward)) + each.id
    return ",".join((head, each.link, each.name, *(thousandths(value) for value in places)))


def corrections(share: Share) -> Iterator[str]:
    """Entries of the tail for numbers that thousandths do not hold."""
    for letter, names in CORRECTED.items():
        for each in share.of(letter):
            for place, name in enumerate(names):
                yield from correction(f"P{letter}{each.id}~{place}", getattr(each, name))
    for place, value in enumerate(share.decimals):
        yield from correction(f"PD~{place}", value)
    for place, value in enumerate(share.integers):
        if value != math.floor(value):
            yield f"PI~{place}~{value!r}"


def correction(tag: str, value: float) -> Iterator[str]:
    """The entry of a number, where it needs one."""
    if read_whole(thousandths(value)) / 1000 != value:
        yield f"{tag}~{value!r}"
