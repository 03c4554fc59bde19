"""How a run under forces begins and ends: the section ``run`` of a model file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from linkwright.core.data import Frozen
from linkwright.drivers.base import Driver
from linkwright.fields.base import Field, Quantity, Schema, Text, Word, quantity_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Listed
from linkwright.words import _

Until = Literal["steady", "rest"]
#: Keys that say when a run ends, of which a file has one at most.
ENDS = ("for", "turns", "until")


@dataclass(frozen=True)
class PerDriver(Field):
    """A quantity of each driver by its name, or of the only driver without; ``rotary`` and ``linear``: the dimension
    of one that turns and of one that slides."""

    drivers: Mapping[str, bool]
    rotary: str
    linear: str

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> Mapping[str, float] | None:
        if not self.drivers:
            problem = _("there is no driver, so nothing to give this of", code="dynamics.run_without_driver")
            reader.error(node, place, problem, _("remove it, or add a driver"), "reference")
            return None
        if isinstance(node, MappingNode):
            return self._by_name(reader, node, place)
        if len(self.drivers) > 1:
            problem = _("one value for {count} drivers", code="dynamics.run_which_driver", count=len(self.drivers))
            first = next(iter(self.drivers))
            form = f"{{{first}: {quantity_schema(self._dimension(first))['examples'][0]}}}"
            reader.error(node, place, problem, _("write a value by driver: {form}", form=form), "choice")
            return None
        (name,) = self.drivers
        value = reader.quantity(node, place.child(name), self._dimension(name))
        return None if value is None else {name: value}

    def _by_name(self, reader: Reader, node: MappingNode, place: Place) -> Mapping[str, float] | None:
        found: dict[str, float] = {}
        for entry in node.entries:
            name, at = entry.key.text, place.child(entry.key.text)
            if not reader.known(entry.key, at, _("driver"), name, list(self.drivers)):
                continue
            value = reader.quantity(entry.value, at, self._dimension(name))
            found |= {} if value is None else {name: value}
        return found if len(found) == len(node.entries) else None

    def _dimension(self, driver: str) -> str:
        return self.rotary if self.drivers[driver] else self.linear

    def shape(self) -> Schema:
        one: Schema = {
            "anyOf": [{"type": "string"}, {"const": 0}],
            "examples": quantity_schema(self.rotary)["examples"],
        }
        return {"anyOf": [one, {"type": "object", "additionalProperties": one}]}

    def flatten(self, value: Any) -> dict[str, float]:
        return {f".{name}": each for name, each in value.items()}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return {name: lookup(f".{name}") for name in value}

    def written(self, value: Any) -> Any:
        return {name: Quantity(self._dimension(name)).written(each) for name, each in value.items()}


@dataclass(frozen=True)
class DriverName(Text):
    """The name of a driver that has a law."""

    drivers: Mapping[str, Driver] = field(default_factory=dict)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        name = super().read(reader, node, place, siblings)
        if name is None or not reader.known(node, place, _("driver"), name, list(self.drivers)):
            return None
        if not self.drivers[name].law.prescribed:
            problem = _('the driver "{name}" is free: it has no law', code="dynamics.prescribed_free", name=name)
            remedy = _("give it a law such as speed, or leave it out here")
            reader.error(node, place, problem, remedy, "choice")
            return None
        return name


@dataclass(frozen=True)
class RunConditions(Frozen):
    """How a run begins: the drivers' coordinates ``at`` (rad or m) and their ``speed`` (rad/s or m/s), by name, those
    of the drawing and rest where nothing is given; and how it ends: after ``duration`` (s), after ``turns`` of the
    first driver, or ``until`` it is steady or at rest, ``at_most`` (s). ``prescribed``: drivers whose laws hold."""

    at: Mapping[str, float] = field(default_factory=dict)
    speed: Mapping[str, float] = field(default_factory=dict)
    duration: float | None = None
    turns: float | None = None
    until: Until | None = None
    at_most: float | None = None
    prescribed: tuple[str, ...] = ()

    @staticmethod
    def fields(drivers: Mapping[str, Driver]) -> dict[str, Field]:
        """The keys of the section ``run`` of a machine with these drivers."""
        turning = {name: each.law.rotary for name, each in drivers.items()}
        return {
            "from": Word(("rest",), doc=_("rest: from rest, as without speed (default)")),
            "at": PerDriver(
                turning, "angle", "length", doc=_("coordinate of the drivers at the beginning (default: their start)")
            ),
            "speed": PerDriver(
                turning,
                "angular_velocity",
                "velocity",
                doc=_("speed of the drivers at the beginning (default: none)"),
            ),
            "for": Quantity("time", above=0, doc=_("how long it runs")),
            "turns": Quantity("dimensionless", above=0, doc=_("how many turns of the first driver it runs")),
            "until": Word(
                ("steady", "rest"), doc=_("steady: until each turn is as the one before; rest: until nothing moves")
            ),
            "at_most": Quantity("time", above=0, doc=_("with until or turns: how long it runs at most")),
            "prescribed": Listed(
                DriverName(drivers=drivers),
                "[feed]",
                doc=_("drivers that move by their laws during the run, whatever forces that needs"),
            ),
        }

    @classmethod
    def of_values(cls, values: Mapping[str, Any]) -> RunConditions:
        """The conditions of these keys of a file."""
        return cls(
            values.get("at") or {},
            values.get("speed") or {},
            values.get("for"),
            values.get("turns"),
            values.get("until"),
            values.get("at_most"),
            tuple(values.get("prescribed") or ()),
        )

    def values(self) -> dict[str, Any]:
        """The keys of the file that are set, with their SI values."""
        found = {
            "at": self.at,
            "speed": self.speed,
            "for": self.duration,
            "turns": self.turns,
            "until": self.until,
            "at_most": self.at_most,
            "prescribed": list(self.prescribed),
        }
        return {key: value for key, value in found.items() if value not in (None, {}, [])}

    def dimensions(self) -> dict[str, float]:
        """Addresses (``run.at.NAME``, ``run.speed.NAME``, ``run.for``, …) with their SI values."""
        fields = self.fields({})
        flat = {key: fields[key].flatten(value) for key, value in self.values().items()}
        return {f"run.{key}{end}": value for key, parts in flat.items() for end, value in parts.items()}

    def with_dimensions(self, value: Callable[[str], float]) -> RunConditions:
        """The same conditions with the values that ``value`` gives for the addresses of ``dimensions``."""
        fields = self.fields({})
        return self.of_values(
            {
                key: fields[key].rebuild(old, lambda end, key=key: value(f"run.{key}{end}"))  # type: ignore[misc]
                for key, old in self.values().items()
            }
        )

    def written(self, drivers: Mapping[str, Driver]) -> dict[str, Any]:
        """As plain data for a file; ``from: rest`` where there is nothing else to say."""
        fields = self.fields(drivers)
        return {key: fields[key].written(value) for key, value in self.values().items()} or {"from": "rest"}
