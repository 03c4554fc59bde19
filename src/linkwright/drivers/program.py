"""A coordinate given by a motion program over time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from linkwright.drivers.base import BEYOND_LAW, LAWS, Law, repeated
from linkwright.errors import LinkwrightError
from linkwright.fields.base import Field, Quantity
from linkwright.laws.program_fields import ProgramField
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.drivers.base import Array
    from linkwright.laws.program import MotionProgram


@LAWS.register("program")
@dataclass(frozen=True)
class ProgramLaw(Law):
    """q goes through the segments of a motion program, from the program's ``start`` (rad or m).

    Where it ends with the velocity it began with it is repeated, from where it has come; else times beyond its end
    raise.
    """

    program: MotionProgram
    rotary: bool = True

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        import numpy as np

        if not self._repeats:
            first, last = self.span()
            slack = 1e-9 * last
            if np.any(t < -slack) or np.any(t > last + slack):
                values = {"first": first, "last": last, "begin": np.min(t), "end": np.max(t)}
                raise LinkwrightError(BEYOND_LAW.format(**values))
            t = np.clip(t, 0.0, np.nextafter(last, 0.0))
        q, rate, second, _unused = self.program.curves(t)
        return q, rate, second

    @cached_property
    def _repeats(self) -> bool:
        """Whether the program begins with the velocity with which it ends."""
        import numpy as np

        period = self.program.period
        first, last = self.program.curves(np.array([0.0, np.nextafter(period, 0.0)]))[1].tolist()
        size = max(abs(first), abs(last), abs(self.program.extreme(1, "max").value))
        return bool(abs(first - last) <= 1e-7 * size)

    def span(self) -> tuple[float, float]:
        return super().span() if self._repeats else (0.0, self.program.period)

    def breaks(self, start: float, end: float) -> Array:
        return repeated(self.program.breaks[:-1], self.program.period, start, end)

    def natural_duration(self) -> float | None:
        return self.program.period

    def dimensions(self) -> Mapping[str, float]:
        return {"start": self.program.start}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> ProgramLaw:
        return replace(self, program=replace(self.program, start=value("start")))

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        lift = "angle" if rotary else "length"
        return {
            "start": Quantity(lift, doc=_("coordinate at time 0 (default 0)")),
            "program": ProgramField(lift, "time", closed=False, doc=_("segments over time, one after the other")),
        }

    @classmethod
    def from_values(cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]) -> ProgramLaw:
        from linkwright.laws.program import MotionProgram

        program = values["program"]
        assert isinstance(program, MotionProgram)
        return cls(program, rotary)

    def text_values(self) -> Mapping[str, object]:
        start = {"start": self.program.start} if self.program.start else {}
        return {"program": self.program, **start}
