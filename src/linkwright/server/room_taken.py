"""What the parts of a machine take up: their outlines for the sheet, layers, the smallest gap, and what collides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from linkwright.collisions.gaps import Gap, Moving, smallest_gaps
from linkwright.core.data import Plain
from linkwright.core.outputs import row_name
from linkwright.core.quantity import length_text, shown
from linkwright.errors import LinkwrightError, ModelError
from linkwright.fabrication.svg import path_of
from linkwright.files.model_file import read_text
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.layering.arrangement import Conflict, Layers
from linkwright.layering.demands import is_too_small
from linkwright.layering.layers_of import layers
from linkwright.mechanism.mechanism import Mechanism
from linkwright.server.loose import moving_part
from linkwright.server.moved import moved
from linkwright.shapes.boundary import boundary
from linkwright.sizing.sizes import sizes_of
from linkwright.solids.solid import Solid
from linkwright.solids.solids_of import solids
from linkwright.words import _
from linkwright.words.message import in_language

#: What lies above is drawn later.
ORDER = ("frame", "guide", "link", "wheel", "cam", "block", "roller", "post", "pin")


def room_taken(text: str, language: str, *, layered: bool = True) -> Plain:
    """Outlines, sizes (m) of links, layers from the frame up, the smallest gap and collisions of a text's machine; a
    ``sentence`` where there are none.

    ``layered``: False for what is found at once, which leaves out layers and what depends on them.
    """
    try:
        motion = _motion(text)
        if motion is None:
            return _nothing(_("the machine does not move yet").translate(language))
        found = solids(motion.mechanism)
        outlines = [*_outlines(motion.mechanism, [*found.by_name.values()])]
    except ModelError:
        return _nothing("")
    except LinkwrightError as error:
        return _nothing(error.translate(language))
    taken = {
        **_nothing(""),
        "outlines": outlines,
        "sizes": _sizes(motion.mechanism),
        "notes": [in_language(each, language) for each in found.notes],
    }
    if not layered:
        return taken
    try:
        arranged = _arranged(text)
    except LinkwrightError as error:
        return {**taken, "sentence": error.translate(language)}
    return {
        **taken,
        "outlines": [{**each, "layer": arranged.layer.get(each["name"])} for each in outlines],
        "layers": [{"number": each.number, "plates": list(each.plates)} for each in arranged.layers],
        "gap": _nearest(arranged, motion, language),
        "collisions": _collisions(arranged, motion),
        "conflicts": [_conflict(each, motion, language) for each in arranged.conflicts],
        "remedies": [in_language(each, language) for each in arranged.remedies],
    }


def side_view(text: str, language: str) -> Plain:
    """The section through the pins of a text's machine as ``svg``; "" where it has no layers."""
    try:
        if _motion(text) is None or (arranged := _arranged(text)).conflicts:
            return {"svg": ""}
        return {"svg": arranged.plot("side", title="", language=language).svg()}
    except LinkwrightError:
        return {"svg": ""}


@lru_cache(maxsize=4)
def _motion(text: str) -> Motion | None:
    """The motion of a text's machine, of the part of it that moves; raises ModelError where it is none."""
    part = moving_part(text)
    mechanism, findings = (part.document.mechanism, []) if part else read_text(text, "model")
    if mechanism is None:
        raise ModelError(findings)
    return moved(mechanism).motion


@lru_cache(maxsize=4)
def _arranged(text: str) -> Layers:
    """The layers of a text's machine that moves; they may take seconds."""
    motion = _motion(text)
    assert motion is not None
    return layers(motion.mechanism)


def _sizes(mechanism: Mechanism) -> Plain:
    """Width and thickness by link, m."""
    found = sizes_of(mechanism)
    return {name: {"width": found.width[name], "thickness": found.thickness[name]} for name in found.width}


def _nothing(sentence: str) -> Plain:
    lists: Plain = {name: [] for name in ("outlines", "layers", "collisions", "conflicts", "remedies", "notes")}
    return {**lists, "gap": None, "sizes": {}, "sentence": sentence}


def _outlines(mechanism: Mechanism, found: Sequence[Solid]) -> Iterator[Plain]:
    """Outlines about a point of their links along these, mm, y downwards, from the lowest to the highest."""
    for solid in sorted(found, key=lambda each: (ORDER.index(each.sort), -each.shape.bound[1])):
        link = mechanism.link(solid.carrier)
        point, place = next(iter(link.points.items()))
        loops = (loop.moved(0.0, -complex(*place)) for loop in boundary(solid.shape))
        fixed = solid.carrier == "frame"
        yield {
            "name": solid.name,
            "sort": solid.sort,
            "link": solid.carrier,
            "at": canonical(mechanism, solid.carrier, point),
            "along": None if fixed else row_name("direction", solid.carrier),
            "path": "".join(map(path_of, loops)),
            "colour": link.colour,
        }


def _nearest(arranged: Layers, motion: Motion, language: str) -> Plain | None:
    """The smallest gap in one layer, where and when."""
    if arranged.conflicts or (nearest := arranged.nearest) is None:
        return None
    first, second, gap = nearest
    return {
        "pair": [first, second],
        "size": gap.size,
        "text": length_text(gap.size, 4),
        "share": _shares(motion, [gap.time])[0],
        "place": [gap.place.real, gap.place.imag],
        "sentence": _(
            "smallest gap {gap}, {first} – {second} at {input}",
            gap=length_text(gap.size, 4),
            first=first,
            second=second,
            input=_where(gap, motion),
        ).translate(language),
    }


def _conflict(conflict: Conflict, motion: Motion, language: str) -> Plain:
    """A demand that contradicts others, and at which share of the cycle it can be seen."""
    gap = conflict.gap
    share = None if gap is None else _shares(motion, [gap.time])[0]
    return {"sentence": in_language(conflict.sentence, language), "share": share}


def _where(gap: Gap, motion: Motion) -> str:
    if np.isfinite(gap.input):
        return shown(gap.input, motion.mechanism.across, 4)
    return shown(gap.time, "time", 4)


def _collisions(arranged: Layers, motion: Motion) -> list[Plain]:
    """Pairs that no layers keep apart, with the shares of the cycle in which they are too near."""
    names = {each.first for each in arranged.conflicts} | {each.second for each in arranged.conflicts}
    known = arranged.solids.by_name
    pairs = [
        pair
        for pair, gap in arranged.gaps.items()
        if {*pair} <= names and is_too_small(gap, arranged.clearance, motion)
    ]
    moving = [(Moving(known[a].carrier, known[a].shape), Moving(known[b].carrier, known[b].shape)) for a, b in pairs]
    found = smallest_gaps(motion, moving, clearance=arranged.clearance, spans=True)
    return [
        {"pair": [*pair], "spans": [_shares(motion, span) for span in gap.spans]}
        for pair, gap in zip(pairs, found, strict=True)
    ]


def _shares(motion: Motion, times: Sequence[float]) -> list[float]:
    """Times as shares of the cycle from its first position on, whose positions follow evenly."""
    begin, period = float(motion.time[0]), motion.positions.period
    whole = period if period else float(motion.time[-1] - begin) or 1.0
    return [(each - begin) / whole for each in times]
