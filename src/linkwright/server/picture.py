"""What of a text can be drawn: before it is a model, and with the points that only the solved machine places."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import TYPE_CHECKING

from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.server.entries import places, points_of, section, texts, word

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion


def picture_of(root: Node) -> Plain:
    """What of a text's tree can be drawn before it is a model: points (m), links with their points, fixed points,
    driver, loads with the points or links that they act on and the direction of a force (rad)."""
    fixed = places(section(root, "frame", "points"))
    driver = section(root, "driver")
    loads = [(name, load) for name, load in section(root, "loads") or () if isinstance(load, MappingNode)]
    return {
        "points": {**places(section(root, "drawing")), **fixed},
        "fixed": list(fixed),
        "links": {name: points_of(link) for name, link in section(root, "links") or ()},
        "driver": word(driver, "turn") or None if driver is not None else None,
        "guided": [
            each.text
            for _unused, joint in section(root, "joints") or ()
            if isinstance(joint, MappingNode)
            and joint.get("block") is not None
            and isinstance(each := joint.get("at"), Scalar)
        ],
        "loads": {name: _load(load) for name, load in loads},
    }


def _load(load: MappingNode) -> Plain:
    """A load as it is drawn: its words, the link and point that it acts on, its direction in space (rad)."""
    angle, components = None, texts(load.get("components"))
    with suppress(QuantityError, ValueError):
        x, y = (amount(each, "force") for each in components) if components else (0.0, 0.0)
        angle = math.atan2(y, x) if components else amount(word(load, "direction"), "angle")
    ends = texts(load.get("between")) or texts(load.get("links"))
    size = " ".join(filter(None, (word(load, key) for key in ("magnitude", "stiffness", "damping")))) or components
    return {
        "kind": word(load, "kind"),
        "on": word(load, "on"),
        "at": word(load, "at"),
        "angle": angle,
        "ends": [end.split(".")[-1] for end in ends],
        "size": size if isinstance(size, str) else ", ".join(size),
    }


def completed(shown: Plain, motion: Motion) -> Plain:
    """What can be drawn, with the points that no drawing gives where the solved machine has them (``placed``)."""
    missing = {point for points in shown["links"].values() for point in points} - set(shown["points"])
    if not missing:
        return shown
    places, there = {}, _as_drawn(motion)
    for point in sorted(missing):
        keys = [f"{link}.{point}" for link, points in shown["links"].items() if point in points]
        known = next((key for key in (point, *keys) if key in there.point_names()), None)
        if known is not None:
            places[point] = [float(each) for each in there.point(known).position[0]]
    return {**shown, "points": {**shown["points"], **places}, "placed": list(places)}


def _as_drawn(motion: Motion) -> Motion:
    """The machine in the position of its drawing, where that can be had; else from its first position on."""
    from linkwright.kinematics.solve import solve_motion
    from linkwright.mechanism.drawing import Drawing

    drawing = Drawing(motion.mechanism)
    names = motion.mechanism.drivers
    at = {name: q for name in names if (q := drawing.driver(name)) is not None}
    if at and len(at) == len(names):
        with suppress(LinkwrightError):
            return solve_motion(motion.mechanism, at=at)
    return motion
