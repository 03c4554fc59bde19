"""A place of a motion where the modes of a group meet, or that it cannot pass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

Kind = Literal["change", "meeting", "end", "gap", "pole"]


@dataclass(frozen=True)
class ChangePointCrossing:
    """Where a group's modes meet (``change``), its outer pins meet (``meeting``), or it cannot pass: out of reach
    (``gap``), or infinitely far as its guides become parallel (``pole``). An ``end`` is one of the first two beneath
    a group without closed form, which cannot be tracked through it.

    It lies at ``share`` of the step from the position ``before`` to the position ``after``, ``at`` the first driver's
    coordinate (rad or m); ``quality`` is the minimum square of the sine of the group's transmission angle there.
    ``flips``: the places between which the group has its other sign because of it.
    """

    group: str
    before: int
    after: int
    share: float
    quality: float
    kind: Kind
    at: float
    flips: tuple[float, float] = (0.0, np.inf)

    @property
    def touches(self) -> bool:
        """Whether the motion passes, with the other sign."""
        return self.kind in ("change", "meeting")

    @property
    def barred(self) -> bool:
        """Whether the group cannot be assembled there, though it can be before and after."""
        return self.kind in ("gap", "pole")

    @property
    def singular(self) -> bool:
        """Whether its modes or its outer pins meet."""
        return self.touches or self.kind == "end"

    @property
    def place(self) -> float:
        """Number of the position, counted on in between."""
        return self.before + self.share
