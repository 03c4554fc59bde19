"""The sections ``driver``, ``drivers`` and ``cycle`` of a model file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkwright.drivers.base import LAWS, Driver, Law
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.model.fields import Field, Quantity
from linkwright.model.mechanism import Cycle
from linkwright.model.nodes import Mapping as MappingNode
from linkwright.model.nodes import Node
from linkwright.model.plain_reader import Place
from linkwright.model.reader import Reader
from linkwright.model.reference_fields import JointName, LinkName

TURN_FIELDS: Mapping[str, Field] = {
    "turn": LinkName(required=True, moving=True, doc="the link that is turned"),
    "about": JointName(("revolute",), required=True, doc="the pin about which it turns"),
    "relative_to": LinkName(doc="the link against which (default: the frame)"),
}
SLIDE_FIELDS: Mapping[str, Field] = {
    "slide": JointName(("prismatic",), required=True, doc="the prismatic joint that is driven"),
}


def scan_input(reader: Reader, root: MappingNode) -> None:
    """Note whether the first driver turns or slides, before the loads are read."""
    node = root.get("driver")
    several = root.get("drivers")
    if node is None and isinstance(several, MappingNode) and several.entries:
        node = several.entries[0].value
    reader.input_rotary = not (isinstance(node, MappingNode) and node.get("slide") is not None)


def read_drivers(reader: Reader, root: MappingNode) -> dict[str, Driver]:
    """The drivers by name; a single one is named ``driver``."""
    one, several = root.get("driver"), root.get("drivers")
    if one is not None and several is not None:
        reader.error(several, "drivers", "driver and drivers are both given", "keep one of them", "choice")
    found: dict[str, Driver] = {}
    if one is not None:
        _add(reader, found, one, "driver", Place("driver", "driver"))
    mapping = None if several is None else reader.mapping(several, "drivers")
    for entry in mapping.entries if mapping else []:
        name = reader.name(entry.key, f"drivers.{entry.key.text}", "driver")
        if name in reader.names.links or name in reader.names.joints:
            reader.error(
                entry.key,
                f"drivers.{name}",
                f'a link or joint has the name "{name}" already',
                "rename the driver",
                "duplicate",
            )
        elif name is not None:
            _add(reader, found, entry.value, name, Place(f"drivers.{name}", name))
    return found


def _add(reader: Reader, found: dict[str, Driver], node: Node, name: str, place: Place) -> None:
    driver = _read_driver(reader, node, name, place)
    if driver is None:
        return
    for other in found.values():
        if other.joint == driver.joint and {other.link, other.relative_to} == {
            driver.link,
            driver.relative_to,
        }:
            reader.error(
                node,
                place,
                f'the driver "{other.name}" drives the same coordinate',
                "remove one",
                "duplicate",
            )
    found[name] = driver


def _read_driver(reader: Reader, node: Node, name: str, place: Place) -> Driver | None:
    mapping = reader.mapping(node, place)
    if mapping is None:
        return None
    before = reader.error_count
    turns, slides = mapping.get("turn") is not None, mapping.get("slide") is not None
    if turns and slides:
        reader.error(node, place, "turn and slide are both given", "keep one of them", "choice")
        return None
    rotary = not slides
    way = TURN_FIELDS if rotary else SLIDE_FIELDS
    laws = {key: law.fields(rotary) for key, law in LAWS.items()}
    every = {**way, **{key: each for law in laws.values() for key, each in law.items()}}
    if not turns and not slides:
        reader.unknown_keys(mapping, place, [*every, *SLIDE_FIELDS])
        reader.error(
            node,
            place,
            "what the driver drives is missing",
            "add turn: LINK and about: PIN, or slide: JOINT",
            "missing-key",
        )
        return None
    given = reader.table(mapping, place, every) or {}
    law = _read_law(reader, mapping, place, given, laws, rotary)
    joint = _revolute(reader, mapping, place, given) if rotary else _prismatic(reader, given)
    if joint is None or law is None or reader.error_count > before:
        return None
    return Driver(name, *joint, law)


def _read_law(
    reader: Reader,
    node: MappingNode,
    place: Place,
    given: Mapping[str, Any],
    laws: Mapping[str, Mapping[str, Field]],
    rotary: bool,
) -> Law | None:
    chosen = [key for key in laws if node.get(key) is not None]
    if len(chosen) != 1:
        speed = "170 rpm" if rotary else "0.1 m/s"
        message = f"{' and '.join(chosen)} are both given" if chosen else "the driver has no law"
        reader.error(
            node, place, message, f"give exactly one of {', '.join(laws)}, such as speed: {speed}", "choice"
        )
        return None
    key = chosen[0]
    foreign = [name for each in laws.values() for name in each if name in given and name not in laws[key]]
    for name in foreign:
        reader.error(
            node.get(name), place.child(name), f'"{name}" does not go with {key}', "remove it", "choice"
        )
    if foreign or given.get(key) is None:
        return None
    return LAWS[key].from_values(given, rotary, reader.values)


def _prismatic(reader: Reader, given: Mapping[str, Any]) -> tuple[str, str, str] | None:
    joint = given.get("slide")
    return None if joint is None else (joint, "", "")


def _revolute(
    reader: Reader, node: MappingNode, place: Place, given: Mapping[str, Any]
) -> tuple[str, str, str] | None:
    link, pin, other = given.get("turn"), given.get("about"), given.get("relative_to")
    if link is None or pin is None:
        return None
    owners = reader.names.pins[pin]
    if link not in owners:
        mine = [name for name, links in reader.names.pins.items() if link in links]
        reader.error(
            node.get("about"),
            place.child("about"),
            f'the link "{link}" has no pin at "{pin}"',
            f"its pins: {', '.join(mine) or 'none'}",
            "reference",
        )
        return None
    rest = [owner for owner in owners if owner != link]
    if other is None:
        other = "frame" if "frame" in rest else rest[0]
        if other != "frame" and len(rest) > 1:
            reader.error(
                node,
                place.child("relative_to"),
                f'several links are on the pin "{pin}"',
                f"add relative_to: one of {', '.join(rest)}",
                "ambiguous",
            )
            return None
    elif other not in rest:
        reader.error(
            node.get("relative_to"),
            place.child("relative_to"),
            f'"{other}" is not another link on "{pin}"',
            f"one of: {', '.join(rest)}",
            "reference",
        )
        return None
    return pin, link, other


def read_cycle(reader: Reader, node: Node | None, drivers: Mapping[str, Driver]) -> Cycle | None:
    """What one cycle is, if the file says so."""
    if node is None:
        return None
    across = reader.input_dimension()
    fields: dict[str, Field] = {
        "duration": Quantity("time", above=0, doc="time of one cycle"),
        "from": Quantity(across, doc="first coordinate of the first driver"),
        "to": Quantity(across, doc="last coordinate of the first driver"),
        "turns": Quantity("dimensionless", above=0, doc="turns of the first driver"),
    }
    before = reader.error_count
    given = reader.table(node, Place("cycle", "cycle"), fields)
    if given is None or reader.error_count > before:
        return None
    if set(given) not in ({"duration"}, {"from", "to"}, {"turns"}):
        reader.error(
            node,
            "cycle",
            f"{' and '.join(given) or 'nothing'} is given",
            "write one of {duration: 2 s}, {from: 0 deg, to: 90 deg}, {turns: 1}",
            "choice",
        )
        return None
    law = next((driver.law for driver in drivers.values()), None)
    if "duration" not in given and law is not None:
        _check_range(reader, node, given, law)
    return Cycle(given.get("duration"), given.get("from"), given.get("to"), given.get("turns"))


def _check_range(reader: Reader, node: Node, given: Mapping[str, float], law: Law) -> None:
    word = "turns" if "turns" in given else "from and to"
    if not isinstance(law, ConstantSpeed):
        reader.error(
            node, "cycle", f"{word} needs a first driver of constant speed", "give duration", "choice"
        )
    elif law.speed == 0:
        reader.error(node, "cycle", f"{word} needs a speed other than zero", "give duration", "choice")
    elif "turns" in given and not law.rotary:
        reader.error(
            node, "cycle", "the first driver does not turn", "give duration, or from and to", "choice"
        )
    elif "from" in given and (given["to"] - given["from"]) * law.speed <= 0:
        reader.error(
            node,
            "cycle",
            "the driver does not move from the first value to the last",
            "exchange from and to, or turn the sign of the speed",
            "range",
        )


def complete(drivers: Mapping[str, Driver], ends: Mapping[str, tuple[str, str]]) -> dict[str, Driver]:
    """The drivers with block and guide of their prismatic joints filled in; ``ends`` gives (block, guide)."""
    from dataclasses import replace

    return {
        name: replace(driver, link=ends[driver.joint][0], relative_to=ends[driver.joint][1])
        if driver.joint in ends else driver
        for name, driver in drivers.items()
    }  # fmt: skip
