"""What of a text can be drawn: before it is a model, and with the points that only the solved machine places."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.server.entries import places, points_of, section, word
from linkwright.server.loads import applied

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.mechanism.mechanism import Mechanism


def picture_of(root: Node) -> Plain:
    """What of a text's tree can be drawn before it is a model: points (m), links with their points, fixed points,
    driver, and what :func:`~linkwright.server.loads.applied` finds."""
    fixed = places(section(root, "frame", "points"))
    driver = section(root, "driver")
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
        **applied(root),
    }


def completed(shown: Plain, motion: Motion) -> Plain:
    """What can be drawn, with the points that no drawing gives where the solved machine has them (``placed``)."""
    missing = {point for points in shown["links"].values() for point in points} - set(shown["points"])
    missing |= {point for link in shown.get("unmet", ()) for point in shown["links"][link]} - set(shown["fixed"])
    if not missing:
        return shown
    places, there = {}, _as_drawn(motion)
    for point in sorted(missing):
        keys = [f"{link}.{point}" for link, points in shown["links"].items() if point in points]
        known = next((key for key in (point, *keys) if key in there.point_names()), None)
        if known is not None:
            places[point] = [float(each) for each in there.point(known).position[0]]
    return {**shown, "points": {**shown["points"], **places}, "placed": list(places)}


def weighed(shown: Plain, mechanism: Mechanism) -> Plain:
    """What can be drawn, with mass (kg), moment of inertia (kg·m²) and centre (m) of links that their shape gives."""
    found = {
        name: {
            **shown["masses"].get(name, {}),
            "mass": link.mass,
            "inertia": link.inertia,
            "centre": [*link.mass_centre] if isinstance(link.mass_centre, tuple) else link.mass_centre,
        }
        for name, link in mechanism.links.items()
        if link.mass_from_shape
    }
    return {**shown, "masses": {**shown["masses"], **found}} if found else shown


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
