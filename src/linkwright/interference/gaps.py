"""Smallest gaps between two shapes that move, over a whole cycle, exact between the positions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from linkwright.kinematics.motion import Motion
from linkwright.shapes.shape import Shape


@dataclass(frozen=True)
class Gap:
    """The smallest gap of two shapes over a cycle.

    ``size``: m, 0 or less where they overlap (then no more than that they do is meant); ``time`` s and ``input``
    (rad or m, the first driver's) there, ``place``: the middle between the nearest places, m, in frame axes;
    ``spans``: intervals of time, s, in which the gap is below the clearance that was asked for.
    """

    size: float
    time: float
    input: float
    place: complex
    spans: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, eq=False)
class Moving:
    """A shape on a link of the motion."""

    carrier: str
    shape: Shape


def smallest_gaps(
    motion: Motion, pairs: Iterable[tuple[Moving, Moving]], *, clearance: float = 0.0, spans: bool = False
) -> list[Gap]:
    """The smallest gap of every pair over the cycle of a motion, to 1e-9 of the machine's size.

    No contact between positions is missed: a gap over an interval of time is at least that between the chords of the
    paths, less how far paths leave their chords.
    """
    raise NotImplementedError
