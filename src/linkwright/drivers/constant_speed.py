"""Constant speed: q = start + speed·t."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from linkwright.drivers.base import LAWS, Law
from linkwright.fields.base import Field, Quantity
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.formula.trace import Scalar


@LAWS.register("speed")
@dataclass(frozen=True)
class ConstantSpeed(Law):
    """q = start + speed·t; ``speed`` in rad/s (m/s), ``start`` in rad (m).

    Repeats after one turn; on a prismatic joint it has no natural duration.
    """

    speed: float
    start: float = 0.0
    rotary: bool = True

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        return self.start + self.speed * t, self.speed + 0.0 * t, 0.0 * t

    def traced(self, t: Scalar, start: float, end: float) -> tuple[Scalar, Scalar, Scalar]:
        return self.start + self.speed * t, self.speed, 0.0

    def at(self, time: float) -> float:
        return self.start + self.speed * time

    @property
    def constant_speed(self) -> float:
        return self.speed

    def natural_duration(self) -> float | None:
        return 2 * math.pi / abs(self.speed) if self.rotary and self.speed else None

    def dimensions(self) -> Mapping[str, float]:
        return {"speed": self.speed, "start": self.start}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> ConstantSpeed:
        return replace(self, speed=value("speed"), start=value("start"))

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return {
            "speed": Quantity("angular_velocity" if rotary else "velocity", doc=_("constant speed of the joint")),
            "start": Quantity("angle" if rotary else "length", doc=_("coordinate at time 0 (default 0)")),
        }

    @classmethod
    def from_values(
        cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]
    ) -> ConstantSpeed:
        speed, start = values["speed"], values.get("start") or 0.0
        assert isinstance(speed, float) and isinstance(start, float)
        return cls(speed, start, rotary)

    def text_values(self) -> Mapping[str, object]:
        return {"speed": self.speed, **({"start": self.start} if self.start else {})}
