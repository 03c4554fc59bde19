"""What one cycle of a mechanism is: the section ``cycle`` of a model file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.drivers.rocking import Rock
from linkwright.fields.base import Field, Quantities, Quantity, Schema
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader
from linkwright.words import _

#: The word for the limits of the range, in ``rock: limits``; the one of a cycle that says no more than this.
LIMITS, ROCK = "limits", "rock"


@dataclass(frozen=True)
class RockEnds(Field):
    """``limits``, or two coordinates of the driver."""

    across: str

    @property
    def _ends(self) -> Quantities:
        return Quantities(self.across, ("from", "to"))

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, Scalar):
            return reader.word(node, place, (LIMITS,))
        found = self._ends.read(reader, node, place, siblings)
        if found is not None and found[0] >= found[1]:
            message, remedy = _("the first end is not below the second"), _("exchange them")
            reader.error(node, place, message, remedy, "range")
            return None
        return found

    def shape(self) -> Schema:
        return {"anyOf": [{"const": LIMITS}, self._ends.shape()]}

    def flatten(self, value: Any) -> dict[str, float]:
        return {} if value == LIMITS else self._ends.flatten(value)

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return value if value == LIMITS else self._ends.rebuild(value, lookup)

    def written(self, value: Any) -> Any:
        return value if value == LIMITS else self._ends.written(value)


@dataclass(frozen=True)
class Cycle:
    """What one cycle is: a ``duration`` (s), a range of the first driver's coordinate (rad or m),
    ``turns`` of it, or the way there and back between two limits (``rock``)."""

    duration: float | None = None
    start: float | None = None
    end: float | None = None
    turns: float | None = None
    rock: Rock | None = None

    @staticmethod
    def fields(across: str) -> dict[str, Field]:
        """The keys of the section ``cycle``; ``across``: dimension of the first driver's coordinate."""
        margin = _("share of the range that stays free at each limit (default 0.01)")
        return {
            "duration": Quantity("time", above=0, doc=_("time of one cycle")),
            "from": Quantity(across, doc=_("first coordinate of the first driver")),
            "to": Quantity(across, doc=_("last coordinate of the first driver")),
            "turns": Quantity("dimensionless", above=0, doc=_("turns of the first driver")),
            "rock": RockEnds(across, doc=_("between what the driver rocks: its limits, or two coordinates")),
            "margin": Quantity("dimensionless", above=0, below=0.5, doc=margin),
        }

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Cycle:
        """The cycle of these keys of a file."""
        rock = values.get("rock")
        ends = None if rock in (None, LIMITS) else rock
        return cls(
            values.get("duration"),
            values.get("from"),
            values.get("to"),
            values.get("turns"),
            None if rock is None else Rock(ends, values.get("margin")),
        )

    @property
    def natural(self) -> bool:
        """Whether the drivers' laws say how long it is."""
        return self.rock is not None

    def values(self) -> dict[str, Any]:
        """The keys of the file that are set, with their SI values."""
        found: dict[str, Any] = {"duration": self.duration, "from": self.start, "to": self.end, "turns": self.turns}
        if self.rock is not None:
            found |= {"rock": self.rock.ends or LIMITS, "margin": self.rock.margin}
        return {name: value for name, value in found.items() if value is not None}

    def dimensions(self) -> dict[str, float]:
        """Addresses (``cycle.duration``, ``cycle.from``, ``cycle.rock.from``, …) with their SI values."""
        fields, values = self.fields("angle"), self.values()
        flat = {key: fields[key].flatten(value) for key, value in values.items()}
        return {f"cycle.{key}{end}": value for key, parts in flat.items() for end, value in parts.items()}

    def with_dimensions(self, value: Callable[[str], float]) -> Cycle:
        """The same cycle with the values that ``value`` gives for the addresses of ``dimensions``."""
        fields = self.fields("angle")
        return Cycle.of(
            {
                key: fields[key].rebuild(old, lambda end, key=key: value(f"cycle.{key}{end}"))  # type: ignore[misc]
                for key, old in self.values().items()
            }
        )

    def written(self, across: str) -> Any:
        """As plain data for a file: the word ``rock`` where there is no more to say."""
        fields, values = self.fields(across), self.values()
        if values == {"rock": LIMITS}:
            return ROCK
        return {key: fields[key].written(value) for key, value in values.items()}
