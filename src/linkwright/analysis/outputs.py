"""What a mechanism puts out, and the motion of an output."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from linkwright.core.outputs import Output, row_name
from linkwright.kinematics.between_positions import Between
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.mechanism import Mechanism


def mechanism_outputs(mechanism: Mechanism) -> tuple[Output, ...]:
    """Angles of links that turn about the frame and displacements of blocks on it, driven ones left out.

    What is welded to the frame is part of it.
    """
    driven = {(driver.joint, driver.link) for driver in mechanism.drivers.values()}
    driven |= {(driver.joint, driver.relative_to) for driver in mechanism.drivers.values()}
    found: dict[Output, None] = {}
    for name, joint in mechanism.joints.items():
        if mechanism.grounded.isdisjoint(joint.joined):
            continue
        links = [link for link in joint.joined if link not in mechanism.grounded and (name, link) not in driven]
        if joint.coordinate == "turn":
            found |= {Output("angle", link): None for link in links}
        elif joint.coordinate == "slide" and links:
            found[Output("displacement", name)] = None
    return tuple(found)


def usual_output(mechanism: Mechanism) -> Output:
    """The output that counts where none is named: the last one, else the angle of the last link."""
    return (*mechanism_outputs(mechanism)[-1:], Output("angle", [*mechanism.links][-1]))[0]


def output_link(mechanism: Mechanism, output: Output) -> str:
    """The link that carries an output."""
    if output.kind == "angle":
        return output.owner
    joint = mechanism.joints[output.owner]
    return next(link for link in joint.joined if link not in mechanism.grounded)


def turns_fully(motion: Motion, output: Output) -> bool:
    """Whether an angle gains full turns over a closed cycle, so that it never swings back to its start."""
    if output.kind != "angle" or motion.steps < 3 or not motion.complete:
        return False
    angle, period = motion.read(output), motion.positions.period
    step = angle[-1] - angle[-2] if period else 0.0
    if period and motion.link(output.owner).counted:
        ends = motion.time[0] + np.array([0.0, np.sign(motion.time[1] - motion.time[0]) * period])
        first, last = Between(motion).evaluate((row_name("turned_angle", output.owner),), np.array([0, -1]), ends)[0]
        return bool(abs(last - first) > np.pi)
    return bool(abs(angle[-1] + step - angle[0]) > np.pi)


def free_points(mechanism: Mechanism, without: Collection[str] = ()) -> tuple[str, ...]:
    """Points of links, ``without`` some, that are no joint's: coupler points, tool points; as ``link.point``."""
    used = set(mechanism.joints)
    for joint in mechanism.guides.values():
        used |= {joint.through, joint.at, *(joint.direction_points or ())}
    return tuple(
        f"{name}.{point}"
        for name, link in mechanism.links.items()
        for point in link.points
        if name not in without and name not in mechanism.grounded and point not in used
    )


def coupler_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Free points of links that no joint holds to the frame."""
    at_frame = (each for each in mechanism.joints.values() if mechanism.grounded & set(each.joined))
    held = {link for joint in at_frame for link in joint.joined}
    return free_points(mechanism, held)
