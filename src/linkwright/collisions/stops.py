"""End stops that a prescribed motion goes beyond."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from linkwright.analysis.analysis import Analysis, Kind
from linkwright.collisions.cycle_pieces import CyclePieces, Span
from linkwright.core.arrays import Floats
from linkwright.curves.polynomials import SERIES
from linkwright.kinematics.motion import TURN, Motion
from linkwright.mechanism.stops import Stop

#: Ends nearer to each other than this share of the cycle are one.
SAME = 1e-9
#: The sign of what is past a stop, and the extreme that is nearest to it or past it.
_SIDES: dict[str, tuple[float, Kind]] = {"below": (-1.0, "min"), "above": (1.0, "max")}


@dataclass(frozen=True)
class StopReach:
    """How far a motion goes against a ``stop``.

    ``value``: of the output where it is farthest on the side of the stop (rad or m), at ``time`` s and ``input``;
    ``beyond``: by how much that is past the stop, not positive where the motion stays free of it; ``spans``:
    intervals of time, s, in which it is past.
    """

    stop: Stop
    value: float
    beyond: float
    time: float
    input: float
    spans: tuple[Span, ...]


def stop_reaches(motion: Motion) -> Iterator[StopReach]:
    """Of every stop of a machine how far the motion goes against it; angles are those within half a turn of the stop
    at the first position."""
    for stop in motion.mechanism.stops.values():
        found = _reach(stop, motion)
        if found is not None:
            yield found


def _reach(stop: Stop, motion: Motion) -> StopReach | None:
    analysis, kind = Analysis.of(motion), stop.of.kind
    signal, (side, end) = analysis.signal(str(stop.of)), _SIDES[stop.side]
    found = analysis.extreme(signal, end)
    if found is None:
        return None
    turned = TURN * float(np.round((signal(motion)[motion.ok][0] - stop.at) / TURN)) if kind == "angle" else 0.0
    at = stop.at + turned
    beyond, past = side * (found.value - at), tuple[Span, ...]()
    if beyond > SAME * (1.0 if kind == "angle" else motion.mechanism.size):
        past = _past(CyclePieces(motion, lambda each: side * (signal(each) - at)[None], 1))
    return StopReach(stop, found.value - turned, beyond, found.time, found.input, past)


def _past(pieces: CyclePieces) -> tuple[Span, ...]:
    """When the signal of pieces is above zero."""
    found: list[tuple[int, float, float]] = []
    for piece, values in enumerate(pieces.values[0]):
        series = SERIES @ values
        cuts = np.concatenate([[-1.0], _zeros(series), [1.0]])
        above = chebyshev.chebval(0.5 * (cuts[1:] + cuts[:-1]), series) > 0.0
        found += [(piece, low, high) for low, high, over in zip(cuts[:-1], cuts[1:], above, strict=True) if over]
    number, low, high = np.array(found).reshape(-1, 3).T
    return pieces.spans(number.astype(np.intp), low, high, SAME)


def _zeros(series: Floats) -> Floats:
    """The zeros of a Chebyshev series between -1 and 1, in order."""
    kept = np.flatnonzero(np.abs(series) > 1e-15 * np.abs(series).max(initial=0.0))
    roots = chebyshev.chebroots(series[: kept[-1] + 1]) if len(kept) else np.empty(0)
    real = roots.real[np.abs(roots.imag) < 1e-8]
    return np.sort(real[np.abs(real) < 1.0])
