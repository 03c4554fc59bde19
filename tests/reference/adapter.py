"""The reference system of a `linkwright` Mechanism, made from its plain data only.

Nothing of the package is called: link points, masses, joints, laws, drawing and assembly words are read, and
the starting position is found by Newton's method from the drawing, or group by group from random guesses
until the assembly words are fulfilled.
"""

from __future__ import annotations

from math import atan2
from typing import Any

import numpy as np
from tests.reference.laws import law_values
from tests.reference.multibody import (
    FRAME,
    Array,
    Body,
    Constraint,
    Motion,
    Multibody,
    Vec,
    prismatic,
    revolute,
    slide,
    turn,
    weld,
)
from tests.reference.placing import fulfils_words, place_by_groups

Mechanism = Any


def link_points(mechanism: Mechanism, link: str) -> dict[str, Vec]:
    return dict((mechanism.frame if link == FRAME else mechanism.links[link]).points)


def guide_direction(mechanism: Mechanism, joint: Any) -> float:
    """Direction of the guide's line in the axes of the guide link."""
    if joint.direction_points is None:
        return float(joint.direction)
    points = link_points(mechanism, joint.guide)
    (ax, ay), (bx, by) = (points[p] for p in joint.direction_points)
    return atan2(by - ay, bx - ax)


def reference_system(mechanism: Mechanism) -> Multibody:
    """Bodies, joints and drivers; constraints have the names of the joints and of the drivers."""
    bodies = [Body(k.name, k.mass, k.inertia, k.centre) for k in mechanism.links.values()]
    parts: list[Constraint] = []
    for joint in mechanism.joints.values():
        parts += _joint(mechanism, joint)
    for k, driver in enumerate(mechanism.drivers.values()):
        parts += _driver(mechanism, driver, k)
    return Multibody(bodies, parts, len(mechanism.drivers))


def _joint(mechanism: Mechanism, joint: Any) -> list[Constraint]:
    if joint.kind == "revolute":
        return revolute(joint.name, [(k, link_points(mechanism, k)[joint.name]) for k in joint.links])
    if joint.kind == "weld":
        a, b = ((k, link_points(mechanism, k)[joint.at]) for k in joint.links)
        return weld(joint.name, a, b, joint.angle)
    if joint.kind == "prismatic":
        at = link_points(mechanism, joint.block)[joint.at]
        return prismatic(joint.name, _guide(mechanism, joint), (joint.block, at, joint.block_angle), joint.offset)
    raise NotImplementedError(joint.kind)


def _guide(mechanism: Mechanism, joint: Any) -> tuple[str, Vec, float]:
    through = link_points(mechanism, joint.guide)[joint.through]
    return joint.guide, through, guide_direction(mechanism, joint)


def _driver(mechanism: Mechanism, driver: Any, k: int) -> list[Constraint]:
    joint = mechanism.joints[driver.joint]
    name = f"driver {driver.name}"
    if joint.kind == "revolute":
        return turn(name, driver.relative_to, driver.link, k)
    at = link_points(mechanism, joint.block)[joint.at]
    return slide(name, _guide(mechanism, joint), (joint.block, at), k)


def driver_values(mechanism: Mechanism, time: Array) -> tuple[Array, Array, Array]:
    """Coordinates of all drivers with their first two derivatives, each (n, drivers)."""
    parts = [law_values(driver.law, time) for driver in mechanism.drivers.values()]
    if not parts:
        none = np.zeros((len(time), 0))
        return none, none, none
    f, d, dd = (np.stack(columns, -1) for columns in zip(*((p.f, p.d, p.dd) for p in parts), strict=True))
    return f, d, dd


def reference_motion(mechanism: Mechanism, time: Array) -> Motion:
    """Motion of the mechanism at the times (n,), in the assembly of its words or its drawing."""
    system = reference_system(mechanism)
    u, ud, udd = driver_values(mechanism, time)
    start, u0 = starting_position(mechanism, system, u[0])
    return system.motion(start, u0, u, ud, udd)


def starting_position(mechanism: Mechanism, system: Multibody, u0: Array) -> tuple[Array, Array]:
    """An assembled position and its driver coordinates: that of the drawing, or one at u0 by the words."""
    drawn = drawn_position(mechanism, system, u0) if mechanism.drawing else None
    if drawn is None or not _as_the_words_say(mechanism, system, drawn):
        return place_by_groups(mechanism, system, u0), u0
    values = system.residual(drawn, np.zeros(system.drivers))
    rows = [int(np.flatnonzero(system.selection[:, k])[0]) for k in range(system.drivers)]
    u = values[rows]
    turning = np.array([row in system.row_angle for row in rows])
    u = np.where(turning, u + 2 * np.pi * np.round((u0 - u) / (2 * np.pi)), u)
    return system.assemble(drawn, u), u


def _as_the_words_say(mechanism: Mechanism, system: Multibody, drawn: Array) -> bool:
    """Whether the drawn position fulfils all words that the file gives."""
    poses = {name: (float(q[0]), float(q[1]), float(q[2])) for name, q in zip(system.index, drawn, strict=True)}
    inner = (mechanism.joints[name].joined for name in mechanism.assembly)
    return all(fulfils_words(mechanism, poses, [k for k in links if k != FRAME]) for links in inner)


def drawn_position(mechanism: Mechanism, system: Multibody, u0: Array) -> Array | None:
    """Poses of all links fitted to the drawing; None where the drawing does not place some link."""
    drawing = {**mechanism.frame.points, **mechanism.drawing}
    poses: dict[str, tuple[float, float, float]] = {FRAME: (0.0, 0.0, 0.0)}
    for name, link in mechanism.links.items():
        known = [p for p in link.points if p in drawing]
        if len(known) >= 2:
            poses[name] = _fitted([link.points[p] for p in known], [drawing[p] for p in known])
    slides = [joint for joint in mechanism.joints.values() if joint.kind == "prismatic"]
    signs = {d.joint: float(np.sign(u) or 1.0) for d, u in zip(mechanism.drivers.values(), u0, strict=True)}
    for joint in slides * len(slides):
        _pose_along_slide(mechanism, joint, drawing, poses)
    for joint in slides:
        _pose_of_line(mechanism, joint, signs.get(joint.name, 1.0), drawing, poses)
    for joint in slides * len(slides):
        _pose_along_slide(mechanism, joint, drawing, poses)
    if len(poses) <= len(mechanism.links):
        return None
    return np.array([poses[FRAME]] + [poses[body.name] for body in system.bodies])


def _fitted(local: list[Vec], there: list[Vec]) -> tuple[float, float, float]:
    """Pose that brings the local points to the drawn ones, from the two points farthest from each other."""
    pairs = [(i, j) for i in range(len(local)) for j in range(i)]
    i, j = max(pairs, key=lambda ij: np.hypot(*np.subtract(local[ij[0]], local[ij[1]])))
    (ax, ay), (bx, by) = np.subtract(local[i], local[j]), np.subtract(there[i], there[j])
    phi = float(np.arctan2(by, bx) - np.arctan2(ay, ax))
    return _anchored(local[j], there[j], phi)


def _anchored(local: Vec, there: Vec, phi: float) -> tuple[float, float, float]:
    c, s = np.cos(phi), np.sin(phi)
    return float(there[0] - c * local[0] + s * local[1]), float(there[1] - s * local[0] - c * local[1]), phi


def _pose_along_slide(
    mechanism: Mechanism, joint: Any, drawing: dict[str, Vec], poses: dict[str, tuple[float, float, float]]
) -> None:
    lean = guide_direction(mechanism, joint) - joint.block_angle
    for new, old, turned in ((joint.block, joint.guide, lean), (joint.guide, joint.block, -lean)):
        if new not in poses and old in poses:
            points = link_points(mechanism, new)
            known = [p for p in points if p in drawing]
            if known:
                poses[new] = _anchored(points[known[0]], drawing[known[0]], poses[old][2] + turned)


def _pose_of_line(
    mechanism: Mechanism,
    joint: Any,
    sign: float,
    drawing: dict[str, Vec],
    poses: dict[str, tuple[float, float, float]],
) -> None:
    """Guide and block that the drawing gives one point each: the line goes from one to the other."""
    if joint.guide in poses or joint.block in poses or not {joint.through, joint.at} <= {*drawing}:
        return
    d = np.subtract(drawing[joint.at], drawing[joint.through])
    lean = float(np.arctan2(d[1], d[0]) - np.arctan2(joint.offset, sign * np.sqrt(d @ d - joint.offset**2)))
    for link, point, local in (
        (joint.guide, joint.through, guide_direction(mechanism, joint)),
        (joint.block, joint.at, joint.block_angle),
    ):
        poses[link] = _anchored(link_points(mechanism, link)[point], drawing[point], lean - local)
