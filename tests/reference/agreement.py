"""Compares results of the package with the reference's, kind by kind, relative to the largest value."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.reference.adapter import link_points
from tests.reference.multibody import FRAME, Array, Motion

Pairs = dict[str, list[tuple[str, Array, Array]]]


class Comparison:
    """Pairs of found and expected values by kind of quantity (position, angular velocity, force, ...)."""

    def __init__(self) -> None:
        self.pairs: Pairs = {}

    def add(self, kind: str, what: str, found: Array, expected: Array) -> None:
        self.pairs.setdefault(kind, []).append((what, np.asarray(found), np.asarray(expected)))

    def failures(self, tolerance: float, floors: dict[str, float] | None = None) -> list[str]:
        """One line for each quantity that differs by more than tolerance times the kind's largest value."""
        lines = []
        for kind, pairs in self.pairs.items():
            scale = max(float(np.abs(expected).max()) for _, _, expected in pairs)
            scale = max(scale, (floors or {}).get(kind, 0.0))
            for what, found, expected in pairs:
                if found.shape != expected.shape:
                    lines.append(f"{kind} of {what}: shape {found.shape}, expected {expected.shape}")
                    continue
                error = float(np.abs(found - expected).max())
                if not error <= tolerance * scale:
                    lines.append(f"{kind} of {what}: off by {error:.3g}, largest value {scale:.3g}")
        return lines


def motion_comparison(mechanism: Any, motion: Any, reference: Motion, *, derived: bool = True) -> Comparison:
    """Points and links against the reference's; derived: mass centres and joint coordinates too."""
    found = Comparison()
    motion.columns()  # evaluates most of what is compared in one program
    for name, link in mechanism.links.items():
        direction, rate, second = reference.direction(name), *reference.angle(name)[1:]
        ours = motion.link(name)
        found.add("direction", name, ours.direction, direction)
        turned = np.stack([np.cos(ours.angle), np.sin(ours.angle)], -1)
        found.add("direction", f"{name} by its angle", turned, direction)
        found.add("angular velocity", name, ours.angular_velocity, rate)
        found.add("angular acceleration", name, ours.angular_acceleration, second)
        if derived:
            _add_point(found, f"mass centre of {name}", ours.centre, reference.point(name, link.centre))
        for point, local in link.points.items():
            _add_point(found, f"{name}.{point}", motion.point(f"{name}.{point}"), reference.point(name, local))
    for joint in mechanism.joints.values() if derived else ():
        _add_joint(found, mechanism, motion, reference, joint)
    return found


def _add_point(found: Comparison, what: str, ours: Any, expected: tuple[Array, Array, Array]) -> None:
    found.add("position", what, ours.position, expected[0])
    found.add("velocity", what, ours.velocity, expected[1])
    found.add("acceleration", what, ours.acceleration, expected[2])


def _add_joint(found: Comparison, mechanism: Any, motion: Any, reference: Motion, joint: Any) -> None:
    if joint.kind == "weld":
        return
    ours = motion.joint(joint.name)
    if joint.kind == "revolute":
        first, second = (reference.angle(link) for link in joint.links[:2])
        turned = np.stack([np.cos(ours.displacement), np.sin(ours.displacement)], -1)
        relative = second[0] - first[0]
        found.add("direction", f"joint {joint.name}", turned, np.stack([np.cos(relative), np.sin(relative)], -1))
        found.add("angular velocity", f"joint {joint.name}", ours.velocity, second[1] - first[1])
        found.add("angular acceleration", f"joint {joint.name}", ours.acceleration, second[2] - first[2])
        return
    s, sd, sdd = slide_coordinate(mechanism, reference, joint)
    found.add("position", f"joint {joint.name}", ours.displacement, s)
    found.add("velocity", f"joint {joint.name}", ours.velocity, sd)
    found.add("acceleration", f"joint {joint.name}", ours.acceleration, sdd)


def slide_coordinate(mechanism: Any, reference: Motion, joint: Any) -> tuple[Array, Array, Array]:
    """Displacement of a prismatic joint's block along the guide, with its rates as seen from the guide."""
    from tests.reference.adapter import guide_direction

    through = reference.point(joint.guide, link_points(mechanism, joint.guide)[joint.through])
    at = reference.point(joint.block, link_points(mechanism, joint.block)[joint.at])
    u = reference.direction(joint.guide, guide_direction(mechanism, joint))
    n = np.stack([-u[:, 1], u[:, 0]], -1)
    _, w, e = reference.angle(joint.guide)
    d, v, a = (x - y for x, y in zip(at, through, strict=True))
    along, across = (d * u).sum(1), (d * n).sum(1)
    rate = (v * u).sum(1) + w * across
    second = (a * u).sum(1) + 2 * w * (v * n).sum(1) + e * across - w**2 * along
    return along, rate, second


def floors(mechanism: Any, reference: Motion) -> dict[str, float]:
    """Smallest scales, so that what is zero in exact arithmetic is compared with its kin."""
    moving = [k for k in mechanism.links if k != FRAME]
    rates, seconds = reference.qd[:, 1:], reference.qdd[:, 1:]
    size = max(float(np.abs(reference.q[:, 1:, :2]).max()), 1e-3)
    fast = float(np.abs(rates[..., :2]).max())
    turning = float(np.abs(rates[..., 2]).max()) if moving else 0.0
    speed = max(fast, turning * size)
    sudden = max(float(np.abs(seconds[..., :2]).max()), float(np.abs(seconds[..., 2]).max()) * size)
    sudden = max(sudden, speed**2 / size)
    return {
        "position": size,
        "velocity": speed,
        "acceleration": sudden,
        "angular velocity": speed / size,
        "angular acceleration": sudden / size,
    }


def forces_comparison(mechanism: Any, forces: Any, reference: Any) -> Comparison:
    """Reactions, couples, driver efforts and shaking of the package against the reference's."""
    found, motion = Comparison(), reference.motion
    for joint in mechanism.joints.values():
        for link in joint.joined:
            expected, _ = reference.on(joint.name, link)
            found.add("force", f"{joint.name} on {link}", forces.reaction(joint.name, on=link), expected)
        if joint.kind != "revolute":
            block = joint.joined[1]
            about = motion.point(block, link_points(mechanism, block)[joint.at])[0]
            _, expected = reference.on(joint.name, block, about)
            found.add("moment", f"{joint.name} on {block}", forces.couple(joint.name, on=block), expected)
    for driver in mechanism.drivers.values():
        kind = "moment" if mechanism.joints[driver.joint].kind == "revolute" else "force"
        effort = reference.effort(f"driver {driver.name}")
        found.add(kind, f"driver {driver.name}", forces.driver_effort(driver.name), effort)
    inertial = motion.inertia_terms()[:, 1:]
    arms = motion.q[:, 1:, 0] * inertial[..., 1] - motion.q[:, 1:, 1] * inertial[..., 0]
    found.add("force", "shaking force", forces.shaking_force, -inertial[..., :2].sum(1))
    found.add("moment", "shaking moment", forces.shaking_moment, -(arms + inertial[..., 2]).sum(1))
    return found


def force_floors(reference: Any) -> dict[str, float]:
    """Smallest scales of forces and moments, from the loads and the inertia forces."""
    forces = [float(np.abs(w.force).max()) for w in reference.wrenches]
    forces += [float(np.abs(reference.inertial[..., :2]).max())]
    moments = [float(np.abs(w.torque).max()) for w in reference.wrenches]
    size = max(float(np.abs(reference.motion.q[:, 1:, :2]).max()), 1e-3)
    largest = max([*forces, 1e-3])
    return {"force": largest, "moment": max([*moments, largest * size])}
