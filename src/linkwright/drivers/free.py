"""A coordinate that no law prescribes: actuators and loads move it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.drivers.base import LAWS, Law
from linkwright.fields.base import Field, Quantity
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Flag
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.formula.trace import Scalar


@dataclass(frozen=True)
class OnlyTrue(Flag):
    """``true``: a key that is left out where it does not hold."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> bool | None:
        return None if reader.word(node, place, ("true",)) is None else True


@LAWS.register("free")
@dataclass(frozen=True)
class Free(Law):
    """A coordinate that begins at ``start`` (rad or m) and that no law prescribes; in a run forces move it.

    ``nominal``: the speed, rad/s or m/s, that the file gives for the motion without forces; its sign is the sense in
    which motors drive.
    """

    prescribed: ClassVar[bool] = False
    start: float = 0.0
    nominal: float = 0.0
    rotary: bool = True

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        return self.start + 0.0 * t, 0.0 * t, 0.0 * t

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        return self.start, 0.0, 0.0

    def at(self, time: float) -> float:
        return self.start

    def dimensions(self) -> Mapping[str, float]:
        return {"start": self.start}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Free:
        return replace(self, start=value("start"))

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return {
            "free": OnlyTrue(doc=_("no law: forces move the joint; write free: true")),
            "start": Quantity("angle" if rotary else "length", doc=_("coordinate at time 0 (default 0)")),
        }

    @classmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> Free:
        start = values.get("start") or 0.0
        assert isinstance(start, float)
        return cls(start, rotary=rotary)

    def text_values(self) -> Mapping[str, object]:
        return {"free": True, **({"start": self.start} if self.start else {})}
