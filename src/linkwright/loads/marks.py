"""What a load shows of itself in drawings where it does not lie between points: arrows, turning arrows, pressures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from linkwright.core.dataclass import dataclass

if TYPE_CHECKING:
    from linkwright.loads.base import Load


@dataclass(frozen=True)
class Push:
    """An arrow whose point is the point ``at`` of a link; ``angle`` of the force in frame axes, rad."""

    link: str
    at: str
    angle: float


@dataclass(frozen=True)
class Turn:
    """A turning arrow on a link: ``sense`` 1 counter-clockwise, -1 clockwise, 0 where that is not known."""

    link: str
    sense: int


@dataclass(frozen=True)
class Press:
    """Arrows on the face of a guide's block, along the guide for ``sense`` 1 and against it for -1."""

    joint: str
    sense: int


Mark = Push | Turn | Press


def sign_of(load: Load) -> int:
    """1 or -1 for a magnitude that is a number, 0 for one that is not known beforehand."""
    magnitude: Any = getattr(load, "magnitude", None)
    if isinstance(magnitude, float | int):
        return -1 if magnitude < 0 else 1
    ramp: Any = getattr(load, "ramp", None)
    return 0 if ramp is None else (-1 if sum(ramp) < 0 else 1)
