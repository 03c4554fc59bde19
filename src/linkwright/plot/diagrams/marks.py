"""Limit positions and phases of a cycle, as places on the axis of the input."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.kinematics.limits import limit_positions
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.phases import activity
from linkwright.model.signal_fields import Output
from linkwright.plot.diagrams.source import Source


@dataclass(frozen=True)
class LimitMark:
    """A limit position of an output: ``place`` on the axis (SI), ``kind`` max or min."""

    place: float
    kind: str


@dataclass(frozen=True)
class PhaseMark:
    """A stretch of the axis (SI) in which a load acts."""

    name: str
    begin: float
    end: float


def limit_marks(source: Source, output: Output | str | None) -> list[LimitMark]:
    """Limit positions of an output; none for points, or where the motion follows no law in time."""
    if not isinstance(output, Output):
        return []
    try:
        found = limit_positions(source.motion, output)
    except LinkwrightError:
        return []
    in_time = source.axis.dimension == "time"
    return [LimitMark(each.time if in_time else each.input, each.kind) for each in found]


def phase_marks(source: Source, limits: list[LimitMark]) -> list[PhaseMark]:
    """Where loads with a phase act; ends next to a limit position lie on it."""
    found: list[PhaseMark] = []
    x = source.axis.values
    for name, where in acting(source).items():
        edges = np.diff(np.concatenate([[False], where, [False]]).astype(int))
        for first, last in zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0) - 1, strict=True):
            ends = (_snapped(x, int(first), limits), _snapped(x, int(last), limits))
            found.append(PhaseMark(name, *ends))
    return found


def acting(source: Source) -> dict[str, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """Of every load with a phase: at which positions it acts, up to the cycle's end."""
    found = {}
    signals = MotionSignals(source.motion)
    for name, load in source.mechanism.loads.items():
        phase = getattr(load, "phase", None)
        if phase is None:
            continue
        try:
            where = activity(phase, signals).where
        except LinkwrightError:
            continue
        found[name] = source.closed(where.astype(float)) > 0.5
    return found


def _snapped(x: np.ndarray[tuple[int], np.dtype[np.float64]], index: int, limits: list[LimitMark]) -> float:
    step = abs(float(x[1] - x[0])) * 1.01
    here = float(x[index])
    return min(
        (each.place for each in limits if abs(each.place - here) <= step),
        key=lambda p: abs(p - here),
        default=here,
    )
