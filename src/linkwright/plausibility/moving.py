"""Links and drivers of which nothing moves, and weights of nothing: seen in the structure, without a motion."""

from __future__ import annotations

import re
from collections.abc import Iterator

from linkwright.errors import Finding
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure
from linkwright.words import Message, _

_NAME = re.compile(r"[^\W\d][\w'-]*")
#: Shares of the cycle at which the laws of drivers are looked at; no law repeats itself at all of them.
LOOKS = (0.0, 0.087, 0.191, 0.317, 0.443, 0.571, 0.683, 0.797, 0.911)
#: What moves less than this, rad or shares of the machine's size, rests.
RESTING = 1e-9


def resting_links(mechanism: Mechanism, structure: Structure) -> tuple[str, ...]:
    """Links that no driver moves, whatever the dimensions: groups that hang on the frame and on each other alone."""
    moving, resting = set[str](), set(mechanism.grounded)
    for group in structure.groups:
        hung = {joint.joint: {joint.a, joint.b} - set(group.links) for joint in group.outer_joints}
        driving = [others for pin, others in hung.items() if not resting & {*others, *mechanism.pin_links(pin)}]
        (moving if group.drivers or any(moving & others for others in driving) else resting).update(group.links)
    return tuple(link for link in mechanism.links if link in resting - mechanism.grounded)


def of_structure(mechanism: Mechanism, structure: Structure) -> Iterator[Finding]:
    """Findings about links that never move, drivers that move nothing, and gravity without masses."""
    resting = resting_links(mechanism, structure)
    if mechanism.drivers and resting:
        yield _resting(mechanism, resting)
    elif resting and not mechanism.has_loads and not mechanism.actuators:
        message = _("nothing moves and nothing is loaded: the links form a rigid structure without drivers")
        remedy = _("give a driver and one freedom more, or masses or loads whose joint forces are asked for")
        yield Finding("note", "", "", message, remedy, "rigid")
    else:
        yield from _idle_drivers(mechanism)
    if any(mechanism.gravity) and not any(link.mass for link in mechanism.links.values()):
        message = _("gravity acts on nothing: no link has a mass")
        yield Finding("note", "", "gravity", message, _("give masses (mass: 5 kg), or leave gravity out"), "unloaded")


def _resting(mechanism: Mechanism, resting: tuple[str, ...]) -> Finding:
    """That links never move; of a machine whose drivers move nothing else, that as well."""
    driven = {link for driver in mechanism.drivers.values() for link in (driver.link, driver.relative_to)}
    rest = [link for link in mechanism.links if link not in {*resting, *driven, *mechanism.grounded}]
    message: Message = _("the links {links} never move: they are joined to the frame and to each other alone")
    if not rest:
        message = _(
            "the driver moves {driven} alone; {links} never move: they are joined to the frame and to each other "
            "alone"
        )
    names = tuple(link for link in mechanism.links if link in driven)
    remedy = _(
        "give a point of a moving link and one of theirs the same name where they are pinned, or make them part of "
        "the frame"
    )
    return Finding(
        "warning", "", f"links.{resting[0]}", message.format(links=resting, driven=names), remedy, "never-moves"
    )


def _idle_drivers(mechanism: Mechanism) -> Iterator[Finding]:
    """Drivers that turn a link on the frame on which nothing hangs and nothing acts, while others move the rest."""
    for name, driver in mechanism.drivers.items() if len(mechanism.drivers) > 1 else ():
        link = mechanism.links.get(driver.link)
        joints = [each.name for each in mechanism.joints.values() if driver.link in each.joined]
        if link is None or joints != [driver.joint] or driver.relative_to not in mechanism.grounded:
            continue
        own = {driver.link, *(point for point in link.points if point not in mechanism.joints)}
        if link.mass or link.inertia or own & words_of(mechanism):
            continue
        message = _(
            "the driver {name!r} moves nothing but {link}, on which nothing hangs", name=name, link=driver.link
        )
        remedy = _("give a point of {link} the name of the point to which it is pinned, or leave the driver out")
        yield Finding("warning", "", f"drivers.{name}", message, remedy.format(link=driver.link), "never-moves")


def words_of(mechanism: Mechanism) -> set[str]:
    """Names in loads, actuators, stops, named outputs and expectations."""
    acting = [each.written() for each in mechanism.loads.values()]
    acting += [each.written() for each in mechanism.actuators.values()]
    acting += [each.written() for each in mechanism.stops.values()]
    found = words(acting)
    return found | words([each.expression.text for each in mechanism.outputs.values()]) | words([*mechanism.expect])


def words(value: object) -> set[str]:
    """All names in plain data, those with dots in parts."""
    if isinstance(value, dict):
        return {word for each in value.values() for word in words(each)}
    if isinstance(value, list | tuple):
        return {word for each in value for word in words(each)}
    return set(_NAME.findall(str(value)))


def of_laws(mechanism: Mechanism) -> Iterator[Finding]:
    """That no driver of a machine moves over the cycle."""
    if not mechanism.drivers or any(driver.law.constant_speed for driver in mechanism.drivers.values()):
        return
    from linkwright.kinematics.cycle import time_span

    start, duration, _unused = time_span(mechanism)
    for driver in mechanism.drivers.values():
        values = [driver.law.at(start + share * duration) for share in LOOKS]
        size = 1.0 if driver.law.rotary else mechanism.size
        if max(values) - min(values) > RESTING * size:
            return
    key = "driver" if [*mechanism.drivers] == ["driver"] else f"drivers.{next(iter(mechanism.drivers))}"
    message = _("the driver never moves: its coordinate is the same over the cycle", code="motion.driver_rests")
    if len(mechanism.drivers) > 1:
        message = _("none of the drivers moves over the cycle", code="motion.driver_rests")
    yield Finding("warning", "", key, message, _("give it a speed or a law that moves it"), "never-moves")
