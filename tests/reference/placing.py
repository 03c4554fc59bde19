"""Finds an assembled position group by group: Newton from random guesses until the assembly words hold."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from tests.reference.multibody import FRAME, Angle, Array, Coincide, Constraint, Multibody, Unreachable, Vec, revolute

Pose = tuple[float, float, float]


def place_by_groups(mechanism: Any, system: Multibody, u: Array) -> Array:
    """Poses of all bodies (the frame first) at the driver coordinates u."""
    poses: dict[str, Pose] = {FRAME: (0.0, 0.0, 0.0)}
    rng = np.random.default_rng(7)
    while len(poses) < system.count:
        group, inside = _next_group(system, poses)
        part = Multibody([system.bodies[system.index[k] - 1] for k in group], inside, system.drivers)
        _place(mechanism, part, u, poses, rng)
    return np.array([poses[FRAME]] + [poses[body.name] for body in system.bodies])


def _next_group(system: Multibody, poses: dict[str, Pose]) -> tuple[tuple[str, ...], list[Constraint]]:
    """The smallest set of bodies that is determined by the placed ones."""
    free = [body.name for body in system.bodies if body.name not in poses]
    for size in range(1, len(free) + 1):
        for group in combinations(free, size):
            held = _held(system, group, poses)
            if sum(2 if isinstance(c, Coincide) else 1 for c in held) >= 3 * size:
                return group, [_anchored(c, poses) for c in held]
    raise Unreachable(f"the drivers do not determine {free}")


def _held(system: Multibody, group: tuple[str, ...], poses: dict[str, Pose]) -> list[Constraint]:
    """Constraints of the group with itself and with placed bodies; a shared pin as one chain through them."""
    pins: dict[str, dict[str, Vec]] = {}
    held: list[Constraint] = []
    for c in system.constraints:
        if isinstance(c, Coincide):
            pins.setdefault(c.name, {}).update({c.a: c.pa, c.b: c.pb})
        elif {c.a, c.b} <= {*group, *poses} and {c.a, c.b} & {*group}:
            held.append(c)
    for name, ends in pins.items():
        placed = [(k, p) for k, p in ends.items() if k in poses][:1]
        held += revolute(name, placed + [(k, p) for k, p in ends.items() if k in group])
    return held


def _anchored(c: Constraint, poses: dict[str, Pose]) -> Constraint:
    """The constraint with placed bodies made part of the frame."""
    if c.a in poses:
        pose = poses[c.a]
        if isinstance(c, Coincide):
            c = replace(c, a=FRAME, pa=moved(pose, c.pa))
        elif isinstance(c, Angle):
            c = replace(c, a=FRAME, value=c.value + pose[2])
        else:
            c = replace(c, a=FRAME, through=moved(pose, c.through), direction=c.direction + pose[2])
    if c.b in poses:
        pose = poses[c.b]
        if isinstance(c, Coincide):
            c = replace(c, b=FRAME, pb=moved(pose, c.pb))
        elif isinstance(c, Angle):
            c = replace(c, b=FRAME, value=c.value - pose[2])
        else:
            c = replace(c, b=FRAME, at=moved(pose, c.at))
    return c


def moved(pose: Pose, local: Vec) -> Vec:
    x, y, phi = pose
    c, s = np.cos(phi), np.sin(phi)
    return float(x + c * local[0] - s * local[1]), float(y + s * local[0] + c * local[1])


def _place(mechanism: Any, part: Multibody, u: Array, poses: dict[str, Pose], rng: np.random.Generator) -> None:
    names = [body.name for body in part.bodies]
    size = max(np.abs(v).max() for v in (part.pin_pa, part.pin_pb, part.line_t, part.line_p) if v.size)
    for _ in range(300):
        guess = rng.uniform(-1.0, 1.0, (len(names) + 1, 3)) * (2 * size, 2 * size, np.pi)
        guess[0] = 0.0
        try:
            q = part.assemble(guess, u)
        except Unreachable:
            continue
        found = {name: (float(x), float(y), float(phi)) for name, (x, y, phi) in zip(names, q[1:], strict=True)}
        if fulfils_words(mechanism, {**poses, **found}, names):
            poses.update((k, (x, y, float(np.arctan2(np.sin(p), np.cos(p))))) for k, (x, y, p) in found.items())
            return
    raise Unreachable(f"no assembly of {names} found that fulfils the words")


def fulfils_words(mechanism: Any, poses: dict[str, Pose], group: list[str]) -> bool:
    """Whether a dyad of the two links is assembled as its word (default left, forward) says."""
    if len(group) != 2:
        return True
    order = [name for name in mechanism.links if name in group]
    inner = next((j for j in mechanism.joints.values() if {*group} <= {*j.joined}), None)
    outer = [_outer_joint(mechanism, name, inner, poses, group) for name in order]
    if inner is None or None in outer:
        return True
    kinds = [j.kind for j in outer]
    word = mechanism.assembly.get(inner.name)
    if inner.kind == "revolute" and kinds == ["revolute", "revolute"]:
        p, q = (_point(mechanism, poses, j.name) for j in outer)
        c = _point(mechanism, poses, inner.name)
        turn = (q[0] - p[0]) * (c[1] - p[1]) - (q[1] - p[1]) * (c[0] - p[0])
        return (turn > 0) == ((word or "left") == "left")
    forward = (word or "forward") == "forward"
    if inner.kind == "revolute" and sorted(kinds) == ["prismatic", "revolute"]:
        pin, guide = sorted(outer, key=lambda j: j.kind, reverse=True)
        ahead = np.subtract(_point(mechanism, poses, inner.name), _point(mechanism, poses, pin.name))
        return bool(ahead @ _along(mechanism, poses, guide) > 0) == forward
    if inner.kind == "prismatic" and kinds == ["revolute", "revolute"]:
        on = dict(zip(order, outer, strict=True))
        p, q = (_point(mechanism, poses, on[k].name) for k in (inner.guide, inner.block))
        return bool(np.subtract(q, p) @ _along(mechanism, poses, inner) > 0) == forward
    return True


def _outer_joint(mechanism: Any, link: str, inner: Any, poses: dict[str, Pose], group: list[str]) -> Any:
    """The joint by which a link of the group hangs on a link placed earlier."""
    earlier = {k for k in poses if k not in group}
    joints = [j for j in mechanism.joints.values() if j is not inner and link in j.joined]
    return next((j for j in joints if earlier & {*j.joined} and j.kind != "weld"), None)


def _point(mechanism: Any, poses: dict[str, Pose], pin: str) -> Vec:
    link = next(k for k in mechanism.joints[pin].joined if k in poses)
    points = mechanism.frame.points if link == FRAME else mechanism.links[link].points
    return moved(poses[link], points[pin])


def _along(mechanism: Any, poses: dict[str, Pose], joint: Any) -> Array:
    from tests.reference.adapter import guide_direction

    angle = poses[joint.guide][2] + guide_direction(mechanism, joint)
    return np.array([np.cos(angle), np.sin(angle)])
