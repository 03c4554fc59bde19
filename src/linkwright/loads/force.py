"""A force at a point of a link."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from linkwright.loads import base
from linkwright.loads.base import LOADS, Load, Phase, Table
from linkwright.model.expressions import Expression


@LOADS.register("force")
@dataclass(frozen=True, kw_only=True)
class Force(Load):
    """A force on the link ``on`` at its point ``at``, in N.

    Direction, one of: ``direction``, an angle (rad) fixed in space; ``in_link``, an angle in the axes of
    ``on``;
    ``normal_to`` [P, Q], along the left normal of the ray from P to Q of ``on``; ``along`` [P, Q], along
    that ray.
    Magnitude, one of: ``magnitude``, a number or an expression; ``ramp`` [q0, q1], linear in the input
    over the
    phase; ``table``. A negative magnitude reverses the force. Outside ``phase`` the force is zero.
    """

    kind: ClassVar[str] = "force"
    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("direction", "in_link", "normal_to", "along"),
        ("magnitude", "ramp", "table"),
    )
    on: str = base.link(moving=True, doc="the link on which the force acts")
    at: str = base.point_of("on", doc="the point of the link at which it acts")
    direction: float | None = base.quantity("angle", default=None, doc="direction, fixed in space")
    in_link: float | None = base.quantity("angle", default=None, doc="direction in the axes of the link")
    normal_to: tuple[str, str] | None = base.ray(
        "on", default=None, doc="[P, Q]: along the left normal of the ray P→Q"
    )
    along: tuple[str, str] | None = base.ray("on", default=None, doc="[P, Q]: along the ray P→Q")
    magnitude: float | Expression | None = base.magnitude("force", default=None, doc="magnitude")
    ramp: tuple[float, float] | None = base.values(
        "force", count=2, default=None, doc="from, to over the phase"
    )
    table: Table | None = base.table(
        "force", default=None, doc="magnitude over the input, the time or an output"
    )
    phase: Phase | None = base.phase()

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
        if values.get("ramp") is not None and values.get("phase") is None:
            report(
                "ramp",
                "a ramp runs over a phase, and none is given",
                "add phase: {input: [from, to]} or another",
            )
