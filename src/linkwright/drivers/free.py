"""A coordinate that no law prescribes: actuators and loads move it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from linkwright.drivers.base import Law

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.fields.base import Field


@dataclass(frozen=True)
class Free(Law):
    """A coordinate that begins at ``start`` (rad or m) and that no law prescribes.

    ``nominal``: the speed, rad/s or m/s, that the file gives for the motion without forces; its sign is the sense in
    which motors drive.
    """

    key: ClassVar[str] = "free"
    prescribed: ClassVar[bool] = False
    start: float = 0.0
    nominal: float = 0.0
    rotary: bool = True

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        return self.start + 0.0 * t, 0.0 * t, 0.0 * t

    def dimensions(self) -> Mapping[str, float]:
        return {"start": self.start}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Free:
        return replace(self, start=value("start"))

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        raise NotImplementedError

    @classmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> Free:
        raise NotImplementedError

    def text_values(self) -> Mapping[str, object]:
        raise NotImplementedError
