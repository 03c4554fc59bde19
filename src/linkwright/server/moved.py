"""The motion of a drawn machine: over its cycle, or to and fro as far as it goes, with what bars its way."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import NamedTuple

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.server.gap import Gap, gap_of, rocked
from linkwright.server.remedies import Loop, remedies, wanted
from linkwright.words.message import in_language, link_label


class Moved(NamedTuple):
    """The motion, None where the machine can be assembled nowhere; the gap that bars its cycle; the error of that."""

    motion: Motion | None
    gap: Gap | None
    error: LinkwrightError | None


def moved(mechanism: Mechanism) -> Moved:
    """The motion over the cycle, or, where that cannot be passed, rocking between the limits of the driver."""
    try:
        return Moved(solve_motion(mechanism), None, None)
    except LinkwrightError as error:
        barred = error
    motion, gap = None, None
    with suppress(LinkwrightError):
        rocking = rocked(mechanism)
        motion = None if rocking is None else solve_motion(rocking)
    slides = mechanism.cycle is None and not all(each.law.rotary for each in mechanism.drivers.values())
    if motion is not None and slides:  # what slides has no cycle of its own: it goes to and fro
        return Moved(motion, None, None)
    with suppress(LinkwrightError, ArithmeticError, ValueError):
        gap = gap_of(mechanism)
    return Moved(motion, gap, barred)


def gap_data(gap: Gap, mechanism: Mechanism, language: str) -> Plain:
    """A gap as the studio draws it, with its remedies."""
    factor = math.degrees(1.0) if gap.rotary else 1e3
    arms = gap.arms or ()
    rocks = mechanism.cycle is not None and mechanism.cycle.rock is not None and mechanism.cycle.rock.ends is None
    mended = remedies(gap, rocks=rocks)
    lengths = wanted(mended)
    return {
        "title": in_language(gap.title, language),
        "sentence": in_language(gap.sentence, language),
        "input": gap.input_text,
        "point": gap.point,
        "ends": [_place(each.end) for each in arms] or None,
        "missing": gap.missing,
        "reaches": [
            {"name": each.link, "centre": _place(each.centre), "radius": each.radius} for each in arms if each.radius
        ],
        "points": {name: _place(place) for name, place in gap.points.items()},
        "drawn": gap.at_drawn,
        "way": gap.way and {"centre": _place(gap.way[0]), "radius": gap.way[1], "zero": gap.way[2]},
        "chains": [[each.link] for each in arms] or [list(gap.group.links), []],
        "possible": [[factor * low, factor * high] for low, high in gap.possible],
        "unit": "deg" if gap.rotary else "mm",
        "lengths": [
            {"name": link_label(link, language), "length": length, "wanted": lengths.get(link)}
            for link, length in Loop(gap).lengths.items()
        ],
        "remedies": [each.data(language) for each in mended],
    }


def _place(z: complex) -> list[float]:
    return [z.real, z.imag]
