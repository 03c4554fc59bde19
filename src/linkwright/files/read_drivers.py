"""The sections ``driver``, ``drivers`` and ``cycle`` of a model file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from linkwright.drivers.base import LAWS, Driver, Law
from linkwright.drivers.cylinder import CYLINDER_FIELDS, barrel_name, rod_name
from linkwright.drivers.following import Following
from linkwright.errors import Severity
from linkwright.fields.base import Field
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Place
from linkwright.fields.references import LinkName
from linkwright.files.node_reader import NAME, as_meant
from linkwright.files.read_cylinders import read_cylinder
from linkwright.files.reader import Reader
from linkwright.joints.base import Joint, JointName
from linkwright.mechanism.cycle import LIMITS, ROCK, Cycle
from linkwright.registry import nearest
from linkwright.words import Message, _
from linkwright.words.message import together

TURN_FIELDS: Mapping[str, Field] = {
    "turn": LinkName(required=True, moving=True, doc=_("the link that is turned")),
    "about": JointName(("turn",), required=True, doc=_("the pin about which it turns")),
    "relative_to": LinkName(doc=_("the link against which (default: the frame, or the other link on the pin)")),
}
SLIDE_FIELDS: Mapping[str, Field] = {
    "slide": JointName(("slide",), required=True, doc=_("the prismatic joint that is driven"))
}
#: What a driver drives, by the key that says so, and whether that turns.
WAYS: Mapping[str, tuple[Mapping[str, Field], bool]] = {
    "turn": (TURN_FIELDS, True),
    "slide": (SLIDE_FIELDS, False),
    "between": (CYLINDER_FIELDS, False),
}


def scan_input(reader: Reader, root: MappingNode) -> None:
    """Note whether the first driver turns or slides, before the loads are read."""
    node = root.get("driver")
    several = root.get("drivers")
    if node is None and isinstance(several, MappingNode) and several.entries:
        node = several.entries[0].value
    meant = as_meant(node, _every_key()) if isinstance(node, MappingNode) else None
    reader.input_rotary = meant is None or all(meant.get(way) is None for way in ("slide", "between"))


def read_drivers(reader: Reader, root: MappingNode, joints: Mapping[str, Joint]) -> dict[str, Driver]:
    """The drivers by name; a single one is named ``driver``."""
    one, several = root.get("driver"), root.get("drivers")
    if one is not None and several is not None:
        reader.finding(several, "drivers", _("driver and drivers are both present"), "choice", _("keep one of them"))
    found: dict[str, Driver] = {}
    if one is not None:
        _add(reader, found, joints, one, "driver", Place("driver", "driver"))
    mapping = None if several is None else reader.mapping(several, "drivers")
    if mapping and any(isinstance(mapping.get(key), Scalar | Sequence) for key in WAYS):
        reader.finding(
            mapping,
            "drivers",
            _("the driver has no name"),
            "choice",
            _("write driver: {{…}} for a single one, drivers: {{name: {{…}}, …}} for several"),
        )
        return found
    for entry in mapping.entries if mapping else []:
        name = reader.name(entry.key, f"drivers.{entry.key.text}", _("driver"))
        if (name in reader.names.links or name in reader.names.joints) and name not in reader.cylinders:
            remedy = _("rename the driver")
            reader.finding(
                entry.key,
                f"drivers.{name}",
                _('a link or joint has the name "{name}" already'),
                "duplicate",
                remedy,
                name=name,
            )
        elif name is not None:
            _add(reader, found, joints, entry.value, name, Place(f"drivers.{name}", name))
    return found


def _add(
    reader: Reader, found: dict[str, Driver], joints: Mapping[str, Joint], node: Node, name: str, place: Place
) -> None:
    driver = _read_driver(reader, joints, node, name, place)
    if driver is None:
        return
    for other in found.values():
        if other.joint == driver.joint and {other.link, other.relative_to} == {driver.link, driver.relative_to}:
            reader.finding(
                node,
                place,
                _('the driver "{name}" drives the same coordinate'),
                "duplicate",
                _("remove one"),
                name=other.name,
            )
    found[name] = driver


def _read_driver(reader: Reader, joints: Mapping[str, Joint], node: Node, name: str, place: Place) -> Driver | None:
    mapping = reader.mapping(node, place)
    if mapping is None:
        return None
    before = reader.error_count
    meant = as_meant(mapping, _every_key())
    ways = [key for key in WAYS if meant.get(key) is not None]
    if len(ways) > 1:
        problem = _("{ways} are both present", code="model.both_ways", ways=together(ways))
        if ways == ["turn", "slide"]:
            problem = _("turn and slide are both present")
        reader.error(node, place, problem, _("keep one of them"), "choice")
        return None
    way, rotary = WAYS[ways[0]] if ways else WAYS["turn"]
    laws = _law_fields(rotary, tuple(LAWS.items()))
    every = {**way, **{key: each for law in laws.values() for key, each in law.items()}}
    if not ways:
        _refuse_nothing_driven(reader, mapping, place)
        return None
    values = reader.table(mapping, place, every) or {}
    law = _read_law(reader, mapping, place, values, laws, rotary)
    driver: Driver | None = None
    if ways == ["between"]:
        driver = _between(reader, mapping, place, name, values, law)
    elif law is not None and rotary:
        joint = _revolute(reader, mapping, place, values)
        driver = None if joint is None else Driver(name, *joint, law)
    elif law is not None and values.get("slide") in joints:
        guide, block = joints[values["slide"]].joined
        driver = Driver(name, values["slide"], block, guide, law)
    return None if reader.error_count > before else driver


def _between(
    reader: Reader, node: MappingNode, place: Place, name: str, values: Mapping[str, Any], law: Law | None
) -> Driver | None:
    """The driver of a cylinder."""
    between = values.get("between")
    if between is None:
        return None
    cylinder = read_cylinder(reader, node, place, name, between, values.get("stroke"))
    if cylinder is None or law is None:
        return None
    return Driver(name, name, rod_name(name), barrel_name(name), law, cylinder)


def _refuse_nothing_driven(reader: Reader, mapping: MappingNode, place: Place) -> None:
    """One finding, at the first key that would say it in other words, and those about the other unknown keys."""
    known = _every_key()
    driven = [
        entry
        for entry in mapping.entries
        if isinstance(entry.value, Scalar)
        and NAME.fullmatch(entry.value.text)
        and entry.key.text not in known
        and nearest(entry.key.text[:100], known) is None
    ]
    others = [entry for entry in mapping.entries if entry not in driven]
    reader.unknown_keys(replace(mapping, entries=others), place, known)
    at = driven[0].key if driven else mapping
    remedy = _meant(reader, mapping) or _(
        "add turn: LINK and about: PIN, or slide: JOINT, or between: [POINT, POINT]"
    )
    reader.finding(at, place, _("what the driver drives is missing"), "missing-key", remedy)


def _meant(reader: Reader, mapping: MappingNode) -> str:
    """What to write where a driver's keys or values name a link that a pin joins to the frame, or such a pin; else
    empty."""
    texts = {text for key, value in mapping for text in (key, value.text if isinstance(value, Scalar) else "")}
    for pin, links in reader.names.pins.items():
        link = next((each for each in links if each != "frame"), "")
        if len(links) == 2 and "frame" in links and texts & {pin, link}:
            return _("write turn: {link} and about: {pin}", code="model.turns_link", link=link, pin=pin)
    return ""


@lru_cache
def _law_fields(rotary: bool, laws: tuple[tuple[str, type[Law]], ...]) -> Mapping[str, Mapping[str, Field]]:
    """What files may say about every law of turning or sliding drivers."""
    return {key: law.fields(rotary) for key, law in laws}


def _every_key() -> list[str]:
    """What may stand in the table of a driver."""
    laws = _law_fields(True, tuple(LAWS.items()))
    ways = [key for fields, _unused in WAYS.values() for key in fields]
    return list(dict.fromkeys((*ways, *(key for law in laws.values() for key in law))))


def _read_law(
    reader: Reader,
    node: MappingNode,
    place: Place,
    values: Mapping[str, Any],
    laws: Mapping[str, Mapping[str, Field]],
    rotary: bool,
) -> Law | None:
    if reader.has_path and not any(key in values for key in laws):
        return _without_law(reader, node, place, values, laws, rotary)
    speed = "170 rpm" if rotary else "0.1 m/s"
    key = chosen_law(reader, node, place, values, laws, _("the driver has no law", code="model.no_law"), speed)
    return None if key is None else LAWS[key].from_values(values, rotary, reader.values)


def chosen_law(
    reader: Reader,
    node: MappingNode,
    place: Place,
    values: Mapping[str, Any],
    laws: Mapping[str, Mapping[str, Field]],
    missing: Message,
    speed: str,
) -> str | None:
    """The key of the one law that a table gives, or None after findings: there is none (``missing``) or several, keys
    of others are there, or its own cannot be read. ``speed``: an example."""
    chosen = [key for key in laws if key in values]
    if len(chosen) != 1:
        message = _("{laws} are both present", code="model.both_laws", laws=together(chosen)) if chosen else missing
        remedy = _("give exactly one of {laws}, such as speed: {speed}", laws=tuple(laws), speed=speed)
        reader.error(node, place, message, remedy, "choice")
        return None
    key = chosen[0]
    foreign = {name: None for each in laws.values() for name in each if name in values and name not in laws[key]}
    for name in foreign:
        problem = _('"{name}" does not go with {key_}', name=name, key_=key)
        reader.error(node.get(name), place.child(name), problem, _("remove it"), "choice")
    return None if foreign or values.get(key) is None else key


def _without_law(
    reader: Reader,
    node: MappingNode,
    place: Place,
    values: Mapping[str, Any],
    laws: Mapping[str, Mapping[str, Field]],
    rotary: bool,
) -> Law | None:
    """The law of a driver that follows the model's path."""
    keys = [name for name in values if any(name in each for each in laws.values())]
    for name in keys:
        problem = _('"{name}" does not go with a path, which gives the driver its law', name=name)
        reader.error(node.get(name), place.child(name), problem, _("remove it, or give the driver a law"), "choice")
    return None if keys else Following(rotary)


def _revolute(
    reader: Reader, node: MappingNode, place: Place, values: Mapping[str, Any]
) -> tuple[str, str, str] | None:
    link, pin, other = values.get("turn"), values.get("about"), values.get("relative_to")
    if link is None or pin is None:
        return None
    owners = reader.names.pins[pin]
    if link not in owners:
        mine = [name for name, links in reader.names.pins.items() if link in links]
        remedy = _("its pins: {pins}", pins=tuple(mine)) if mine else _("it has no pins")
        at, key = node.get("about"), place.child("about")
        reader.finding(at, key, _('the link "{link}" has no pin at "{pin}"'), "reference", remedy, link=link, pin=pin)
        return None
    rest = [owner for owner in owners if owner != link]
    if other is None:
        other = "frame" if "frame" in rest else rest[0]
        if other != "frame" and len(rest) > 1:
            reader.finding(
                node,
                place.child("relative_to"),
                _('several links are on the pin "{pin}"'),
                "ambiguous",
                _("add relative_to: one of {rest}"),
                pin=pin,
                rest=tuple(rest),
            )
            return None
        if other != "frame":
            _tell_against(reader, node, place, link, pin, other)
    elif other not in rest:
        remedy = _("one of: {names}", names=tuple(rest))
        at, key = node.get("relative_to"), place.child("relative_to")
        reader.finding(
            at, key, _('"{other}" is not another link on "{pin}"'), "reference", remedy, other=other, pin=pin
        )
        return None
    return pin, link, other


def _tell_against(reader: Reader, node: MappingNode, place: Place, link: str, pin: str, other: str) -> None:
    """That a link is turned against another one than the frame: doubtful where it has a pin on the frame too."""
    held = [name for name, links in reader.names.pins.items() if {link, "frame"} <= set(links)]
    remedy = (
        _("write relative_to: {other} if that is meant, else about: {held}", other=other, held=held[0])
        if held
        else _("write relative_to: {other} to say so")
    )
    severity: Severity = "warning" if held else "note"
    values = {"link": link, "pin": pin, "other": other}
    at, key = node.get("about"), place.child("about")
    reader.finding(
        at,
        key,
        _('the pin "{pin}" joins "{link}" to "{other}", not to the frame, so its angle against "{other}" is driven'),
        "doubtful",
        remedy,
        severity=severity,
        **values,
    )


#: The keys of which one set says what a cycle is.
CYCLE_FORMS = (("duration",), ("from", "to"), ("turns",), ("rock", "margin"))


def read_cycle(reader: Reader, node: Node | None, drivers: Mapping[str, Driver]) -> Cycle | None:
    """What one cycle is, if the file says so."""
    if node is None:
        return None
    before = reader.error_count
    if isinstance(node, Scalar) and node.text == ROCK:
        values: dict[str, Any] | None = {"rock": LIMITS}
    else:
        values = reader.table(node, Place("cycle", "cycle"), Cycle.fields(reader.input_dimension()))
    if values is None or reader.error_count > before:
        return None
    if set(values) not in (*map(set, CYCLE_FORMS), {"rock"}):
        problem = _("nothing is set")
        if values:
            problem = _("{keys} is set", keys=together(list(values)))
        reader.error(
            node,
            "cycle",
            problem,
            _("write one of {{duration: 2 s}}, {{from: 0 deg, to: 90 deg}}, {{turns: 1}}, or rock"),
            "choice",
        )
        return None
    law = next((driver.law for driver in drivers.values()), None)
    if "duration" not in values and law is not None:
        _check_range(reader, node, values, law, len(drivers))
    return Cycle.of(values)


def _check_range(reader: Reader, node: Node, values: Mapping[str, Any], law: Law, drivers: int) -> None:
    word = "turns" if "turns" in values else "rock" if "rock" in values else _("from and to")
    problem, remedy, code = None, _("give duration"), "choice"
    if law.constant_speed is None:
        problem = _("{word} needs a first driver of constant speed", word=word)
    elif law.constant_speed == 0:
        problem = _("{word} needs a speed other than zero", word=word)
    elif "rock" in values:
        problem, remedy, code = _check_rock(values, drivers)
    elif "turns" in values and not law.rotary:
        problem, remedy = _("the first driver does not turn"), _("give duration, or from and to")
    elif "from" in values and (values["to"] - values["from"]) * law.constant_speed <= 0:
        problem, remedy, code = (
            _("the driver does not move from the first value to the last", code="model.wrong_way"),
            _("exchange from and to, or turn the sign of the speed"),
            "range",
        )
    if problem is not None:
        reader.error(node, "cycle", problem, remedy, code)


def _check_rock(values: Mapping[str, Any], drivers: int) -> tuple[Message | None, Message, str]:
    """What is in the way of a cycle that rocks."""
    if drivers > 1:
        return (
            _("rock needs a single driver, not {count}", code="model.rock_drivers", count=drivers),
            _("give duration"),
            "choice",
        )
    if values["rock"] != LIMITS and "margin" in values:
        return (
            _("a margin goes with the limits that are found, not with two coordinates", code="model.rock_margin"),
            _("remove margin, or write rock: limits"),
            "choice",
        )
    return None, _("give duration"), "choice"
