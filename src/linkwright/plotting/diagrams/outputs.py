"""Outputs, links, points and joints that a diagram is about: by name, or the ones that matter most."""

from __future__ import annotations

import numpy as np

from linkwright.analysis.outputs import free_points, mechanism_outputs, output_link
from linkwright.core.arrays import largest
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.errors import RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.force_names import reaction_pairs
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


def main_output(motion: Motion) -> Output:
    """The output that matters most: the last in solving order on the frame, else a free point, else a link; wheels
    that turn in a fixed ratio to a driver only where there is nothing else."""
    mechanism = motion.mechanism
    points = free_points(mechanism)
    if len(mechanism.drivers) > 1 and points:
        return Output("position", points[-1])
    outputs = mechanism_outputs(mechanism)
    order = [link for group in motion.structure.groups for link in group.links]
    slides, geared = [each for each in outputs if each.kind == "displacement"], _geared(motion)
    for found in (slides, [each for each in outputs if output_link(mechanism, each) not in geared]):
        if found:
            return max(found, key=lambda each: order.index(output_link(mechanism, each)))
    if free := free_points(mechanism, geared):
        return Output("position", free[-1])
    moving = [link for link in reversed(order) if largest(motion.link(link).angular_velocity) > 1e-9]
    moving.sort(key=lambda link: link in geared)
    return Output("angle", moving[0]) if moving else Output("angle", order[-1])


def main_outputs(motion: Motion) -> list[Output]:
    """The main output, among the last one on the frame of every group that moves no other group."""
    main, mechanism, geared = main_output(motion), motion.mechanism, _geared(motion)
    groups, found = motion.structure.groups, dict[int, Output]()
    place = {link: number for number, group in enumerate(groups) for link in group.links}
    moving = {
        place[link]
        for number, group in enumerate(groups)
        for each in group.joints
        for link in mechanism.joints[each.joint].joined
        if link != "frame" and place[link] < number
    }
    for output in mechanism_outputs(mechanism):
        link = output_link(mechanism, output)
        if place[link] not in moving and link not in geared:
            found[place[link]] = output
    return list(found.values()) if main in found.values() else [main]


def _geared(motion: Motion) -> set[str]:
    """Driven links, and the wheels that turn in a fixed ratio to one."""
    found = {driver.link for driver in motion.mechanism.drivers.values()}
    for train in motion.structure.trains:
        if not train.planetary and found & train.ratios.keys():
            found |= train.ratios.keys()
    return found


def turning_links(motion: Motion) -> list[str]:
    """Links that turn and are not driven against the frame, in solving order; the driven ones where no other does."""
    driven = {d.link if d.link != "frame" else d.relative_to for d in motion.mechanism.drivers.values()}
    order = [link for group in motion.structure.groups for link in group.links]
    fastest = max((largest(motion.link(link).angular_velocity) for link in order), default=0.0)
    turning = [link for link in order if largest(motion.link(link).angular_velocity) > 1e-9 * fastest]
    return [link for link in turning if link not in driven] or turning


def known_link(mechanism: Mechanism, name: str) -> str:
    """The name of a link; raises LinkwrightError with the nearest one where there is none."""
    return mechanism.link(name).name


def traced_points(mechanism: Mechanism) -> list[str]:
    """Points whose paths are worth drawing: free points, else pins between moving links."""
    free = list(free_points(mechanism))
    if free:
        return free
    pins = [
        name
        for name, joint in mechanism.joints.items()
        if joint.coordinate == "turn" and mechanism.grounded.isdisjoint(joint.joined)
    ]
    return pins or [canonical(mechanism, link.name, p) for link in mechanism.links.values() for p in link.points][:1]


def joint_and_link(forces: Forces, joint: str | None, on: str | None) -> tuple[str, str]:
    """The joint asked for with its link, else the one on the frame that carries most.

    Raises LinkwrightError for unknown names.
    """
    mechanism = forces.mechanism
    if joint is None:
        pairs = reaction_pairs(mechanism)
        driven = {driver.joint for driver in mechanism.drivers.values()}
        held = {name for name, each in mechanism.joints.items() if mechanism.grounded & {*each.joined}} - driven
        on_frame = [pair for pair in pairs if pair[0] in held and pair[1] not in mechanism.grounded]
        if on is not None:
            on_frame = pairs = [p for p in pairs if p[1] == known_link(mechanism, on)]
        if not pairs:
            raise RequestError(
                _(
                    '"{name}" has no joint that carries a force there; name another joint',
                    code="picture.no_force_there",
                    name=mechanism.name,
                )
            )
        pairs = on_frame or pairs
        return pairs[first_largest(np.array([largest(forces.reaction(name, on=on)) for name, on in pairs]))]
    if on is None and joint in mechanism.joints:
        on = [link for link in mechanism.joints[joint].joined if link != "frame"][-1]
    forces.reaction(joint, on=on)
    assert on is not None
    return joint, on


def loaded(forces: Forces) -> bool:
    """Whether any joint carries a force."""
    pairs = reaction_pairs(forces.mechanism)
    return any(np.nan_to_num(largest(forces.reaction(joint, on=link))) > 1e-9 for joint, link in pairs)
