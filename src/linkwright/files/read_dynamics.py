"""The sections ``actuators``, ``stops`` and ``run`` of a model file: motion under forces."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from linkwright.actuators.base import Actuator, read_actuator
from linkwright.drivers.base import Driver
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place
from linkwright.files.reader import Reader
from linkwright.mechanism.run_conditions import ENDS, RunConditions
from linkwright.mechanism.stops import STOP_FIELDS, Stop
from linkwright.words import _
from linkwright.words.message import together


def read_actuators(reader: Reader, node: Node | None, loads: Collection[str]) -> dict[str, Actuator]:
    """The actuators by name; none has the name of one of the ``loads``."""
    mapping = None if node is None else reader.mapping(node, "actuators")
    found: dict[str, Actuator] = {}
    for entry in mapping.entries if mapping else []:
        key = f"actuators.{entry.key.text}"
        name = reader.name(entry.key, key, _("actuator"))
        if name in loads:
            problem = _('a load has the name "{name}" already', code="actuators.name_of_load", name=name)
            reader.error(entry.key, key, problem, _("rename one of them"), "duplicate")
        elif name is not None and (actuator := read_actuator(reader, entry.value, Place(key, key), name)) is not None:
            found[name] = actuator
    return found


def read_stops(reader: Reader, node: Node | None) -> dict[str, Stop]:
    """The end stops by name."""
    mapping = None if node is None else reader.mapping(node, "stops")
    found: dict[str, Stop] = {}
    for entry in mapping.entries if mapping else []:
        key = f"stops.{entry.key.text}"
        name = reader.name(entry.key, key, _("stop"))
        before = reader.error_count
        values = None if name is None else reader.table(entry.value, Place(key, key), STOP_FIELDS)
        if name is None or values is None or reader.error_count > before:
            continue
        if any(values.get(each) is None for each in ("of", "at", "side")):
            continue
        found[name] = Stop.of_values(name, values)
    _refuse_crossed(reader, mapping, found)
    return found


def _refuse_crossed(reader: Reader, mapping: MappingNode | None, stops: Mapping[str, Stop]) -> None:
    """Findings about stops that leave an output no room."""
    lower = {str(each.of): each for each in stops.values() if each.side == "below"}
    for stop in stops.values():
        other = lower.get(str(stop.of))
        if mapping is None or stop.side != "above" or other is None or other.at < stop.at:
            continue
        problem = _(
            'the stops "{low}" and "{high}" leave {output} no room: it may not go below the one nor above the other',
            code="dynamics.stops_crossed",
            low=other.name,
            high=stop.name,
            output=str(stop.of),
        )
        at = mapping.get(stop.name)
        reader.error(at, f"stops.{stop.name}.at", problem, _("exchange at or side of the two"), "range")


def read_run(reader: Reader, root: MappingNode, drivers: Mapping[str, Driver]) -> RunConditions | None:
    """How a run begins and ends, if the file says so; not read where its ``drivers`` are not all legible."""
    node = root.get("run")
    if node is None or (reader.error_count and len(drivers) < _declared(root)):
        return None
    before, place = reader.error_count, Place("run", "run")
    values = reader.table(node, place, RunConditions.fields(drivers))
    if values is None or reader.error_count > before:
        return None
    _check_run(reader, node, place, values, drivers)
    return RunConditions.of_values(values)


def _declared(root: MappingNode) -> int:
    """How many drivers the file has, legible or not."""
    several = root.get("drivers")
    return (root.get("driver") is not None) + (len(several.entries) if isinstance(several, MappingNode) else 0)


def _check_run(
    reader: Reader, node: Node, place: Place, values: Mapping[str, Any], drivers: Mapping[str, Driver]
) -> None:
    """Findings across the keys of the section ``run``."""

    def report(key: str, problem: str, remedy: str) -> None:
        at = node.get(key) if isinstance(node, MappingNode) else node
        reader.error(at or node, place.child(key), problem, remedy, "choice")

    ends = [key for key in ENDS if values.get(key) is not None]
    if len(ends) > 1:
        report(
            ends[1],
            _("{keys} are both set", code="loads.both_given", keys=together(ends)),
            _("keep one of {words}", words=ENDS),
        )
    if values.get("from") and any((values.get("speed") or {}).values()):
        report("speed", _("a speed is given with from: rest", code="dynamics.rest_with_speed"), _("keep one of them"))
    if values.get("at_most") is not None and (not ends or "for" in ends):
        report(
            "at_most",
            _("at_most goes with until or turns", code="dynamics.at_most_alone"),
            _("write for: … instead, or add until: steady"),
        )
    first = next(iter(drivers.values()), None)
    if "turns" in ends and (first is None or not first.law.rotary):
        report("turns", _("the first driver does not turn"), _("give for: …, or until: …"))
    if drivers and set(values.get("prescribed") or ()) == set(drivers):
        report(
            "prescribed",
            _("every driver moves by its law, so forces move nothing", code="dynamics.all_prescribed"),
            _("leave one out, or find the forces with solve"),
        )
    for name in values.get("prescribed") or ():
        if any(name in (values.get(key) or {}) for key in ("at", "speed")):
            report(
                "prescribed",
                _(
                    'the law of "{name}" says where and how fast it begins',
                    code="dynamics.prescribed_start",
                    name=name,
                ),
                _("remove it from at and speed"),
            )
