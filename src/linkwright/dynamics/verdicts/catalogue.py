"""Catalogues of motors and gears: YAML, or CSV with a row for each motor."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

from linkwright.actuators.base import ACTUATORS, read_actuator
from linkwright.actuators.motor import Motor, Rating
from linkwright.errors import Finding, ModelError
from linkwright.fields.base import Field, Number, Quantity
from linkwright.fields.nodes import Entry, Node, Scalar
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import Place
from linkwright.files.model_file import read_root
from linkwright.files.reader import Reader
from linkwright.files.source import read_source
from linkwright.words import _

#: The link on which motors act until a machine is known.
_MACHINE = "machine"
#: What a catalogue may say of any motor, besides the keys of its kind.
RATING: Mapping[str, Field] = {
    "continuous": Quantity("torque", above=0.0, doc=_("torque that it gives all the time")),
    "peak": Quantity("torque", above=0.0, doc=_("torque that it gives for a short time")),
    "largest_speed": Quantity("angular_velocity", above=0.0, doc=_("largest speed of the motor")),
    "mass": Quantity("mass", above=0.0, doc=_("mass: the smallest motor is the one with the smallest")),
    "price": Number(above=0.0, doc=_("price: where all have one, the smallest motor is the cheapest")),
}
GEAR: Mapping[str, Field] = {
    "ratio": Number(above=0.0, required=True, doc=_("speed of the motor over that of the link")),
    "efficiency": Number(above=0.0, maximum=1.0, doc=_("efficiency of the gear (default 1)")),
    "inertia": Quantity("inertia", minimum=0.0, doc=_("moment of inertia, on the motor's side (default 0)")),
    "price": Number(above=0.0, doc=_("price, added to that of the motor")),
}
#: Of a controlled motor: what its machine decides.
_OF_CONTROLLER = {"speed": "1 rad/s", "gain": "1 N·m·s/rad"}


@dataclass(frozen=True)
class ListedMotor:
    """A motor of a catalogue: its ``motor`` (on no machine yet), its ``rating``, and what orders it."""

    motor: Motor
    rating: Rating
    mass: float | None = None
    price: float | None = None


@dataclass(frozen=True)
class ListedGear:
    """A gear of a catalogue; ``ratio``: motor over machine."""

    name: str
    ratio: float
    efficiency: float = 1.0
    inertia: float = 0.0
    price: float = 0.0


@dataclass(frozen=True)
class Catalogue:
    """Motors and gears by name."""

    name: str
    motors: Mapping[str, ListedMotor]
    gears: Mapping[str, ListedGear]

    def by_size(self) -> list[ListedMotor]:
        """The motors, the smallest first: by price, where all have one, else by mass, else by power."""
        motors = list(self.motors.values())
        if all(each.price is not None for each in motors):
            return sorted(motors, key=lambda each: each.price or 0.0)
        if all(each.mass is not None for each in motors):
            return sorted(motors, key=lambda each: each.mass or 0.0)
        return sorted(motors, key=lambda each: each.rating.power)


def read_catalogue(source: str | Path | None = None) -> Catalogue:
    """The catalogue of a file, ``.yaml`` or ``.csv``; the example that comes with the package where none is named.

    YAML has the sections ``motors`` (by name: keys of an actuator of kind induction, dc, servo or curve without those
    of its place in the machine, and ``continuous``, ``peak``, ``largest_speed``, ``mass``, ``price``) and ``gears``
    (``ratio``, ``efficiency``, ``inertia``, ``price``). CSV has a column ``name`` and one for each key of motors.

    Raises ModelError with all findings.
    """
    if source is None:
        text, name = files(__package__).joinpath("motors.yaml").read_text("utf-8"), "motors.yaml"
    else:
        text, name = read_source(source)
    return read_text(text, name)


def read_text(text: str, name: str) -> Catalogue:
    """The catalogue of a text; ``name``: of its file."""
    root, findings = (_table(text, name), []) if name.lower().endswith(".csv") else read_root(text, name)
    reader = Reader(name)
    reader.names.links = {"frame": (), _MACHINE: ()}
    reader.names.listed = True
    found = Catalogue(name, {}, {})
    if isinstance(root, MappingNode):
        found = _read(reader, root, name)
    elif root is not None and not findings:
        reader.error(root, "", _("a catalogue has a section motors"), _("write motors: {{NAME: …}}"), "type")
    findings = [*findings, *reader.findings]
    if any(each.severity == "error" for each in findings):
        raise ModelError(findings)
    return found


def _read(reader: Reader, root: MappingNode, name: str) -> Catalogue:
    for key, node in root:
        if key not in ("format", "motors", "gears"):
            problem = _('unknown key "{key}" of a catalogue', key=key)
            reader.error(node, key, problem, _("known: motors, gears"), "unknown-key")
    motors: dict[str, ListedMotor] = {}
    gears: dict[str, ListedGear] = {}
    section = root.get("motors")
    if not isinstance(section, MappingNode) or not section.entries:
        problem = _("the catalogue has no motors", code="verdicts.no_motors")
        reader.error(root, "motors", problem, _("write motors: {{NAME: …}}"), "unknown-key")
        return Catalogue(name, {}, {})
    for entry in section.entries:
        found = _motor(reader, entry)
        motors |= {} if found is None else {entry.key.text: found}
    listed = root.get("gears")
    for entry in listed.entries if isinstance(listed, MappingNode) else []:
        key, errors = f"gears.{entry.key.text}", reader.error_count
        values = reader.table(entry.value, Place(key, key), GEAR)
        if values is not None and reader.error_count == errors:
            gears[entry.key.text] = ListedGear(entry.key.text, **{k: v for k, v in values.items() if v is not None})
    return Catalogue(name, motors, gears)


def _motor(reader: Reader, entry: Entry) -> ListedMotor | None:
    """A motor, its rating apart; None after findings."""
    key, node = f"motors.{entry.key.text}", entry.value
    if not isinstance(node, MappingNode):
        reader.error(node, key, _("a motor is a mapping of keys"), _("write kind: induction, power: …"), "type")
        return None
    kind = node.get("kind")
    cls: Any = ACTUATORS.get(kind.text) if isinstance(kind, Scalar) and kind.text in ACTUATORS else None
    if cls is not None and not issubclass(cls, Motor):
        problem = _('"{kind}" is no motor', code="verdicts.not_a_motor", kind=cls.kind)
        reader.error(node, key, problem, _("write kind: induction, dc, servo or curve"), "unknown-word")
        return None
    own = {each.key or name for name, each in cls.fields().items()} if cls else set()
    extra = [each for each in node.entries if each.key.text in RATING and each.key.text not in own]
    rest = [each for each in node.entries if each not in extra]
    missing = {"on": _MACHINE, **(_OF_CONTROLLER if cls is not None and cls.controlled else {})}
    rest += [_scalars(node, name, text) for name, text in missing.items() if node.get(name) is None]
    before = reader.error_count
    motor = read_actuator(reader, replace(node, entries=rest), Place(key, key), entry.key.text)
    values = reader.table(replace(node, entries=extra), Place(key, key), RATING) or {}
    if not isinstance(motor, Motor) or reader.error_count > before:
        return None
    given = {name: values.get(name) for name in ("continuous", "peak", "largest_speed")}
    rating = replace(motor.rating, **{name: each for name, each in given.items() if each is not None})
    return ListedMotor(motor, rating, values.get("mass"), values.get("price"))


def _scalars(node: Node, name: str, text: str) -> Entry:
    """A key and its value at the place of a node."""
    key, value = (Scalar(node.line, node.column, node.start, node.end, each) for each in (name, text))
    return Entry(key, value)


def _table(text: str, name: str) -> MappingNode:
    """The rows of a CSV file as the section motors of a catalogue; raises ModelError where there is no name."""
    rows = list(csv.reader(io.StringIO(text)))
    head = [each.strip() for each in rows[0]] if rows else []
    if "name" not in head:
        problem = _("the table has no column name", code="verdicts.no_name_column")
        remedy = _("begin with a row of keys: name, kind, power, speed, …")
        raise ModelError([Finding("error", f"{name}:1:1", "", problem, remedy, "table")])
    motors = MappingNode(0, 0, 0, 0)
    for line, row in enumerate(rows[1:], 1):
        cells = {key: cell.strip() for key, cell in zip(head, row, strict=False) if cell.strip()}
        if "name" in cells:
            place = MappingNode(line, 0, 0, 0)
            place.entries = [_scalars(place, key, cell) for key, cell in cells.items() if key != "name"]
            motors.entries.append(Entry(Scalar(line, 0, 0, 0, cells["name"]), place))
    root = MappingNode(0, 0, 0, 0)
    root.entries = [Entry(Scalar(0, 0, 0, 0, "motors"), motors)]
    return root
