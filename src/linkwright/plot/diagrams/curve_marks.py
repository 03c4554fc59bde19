"""Closed curves in a plane: the curve, its direction, and inputs marked along it."""

from __future__ import annotations

from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.quantity import significant
from linkwright.pictures.diagram import Axes
from linkwright.plot.diagrams.axes import InputAxis, round_up
from linkwright.plot.diagrams.marks import acting
from linkwright.plot.diagrams.names import Name, Names
from linkwright.plot.diagrams.source import Source


def jumps(source: Source) -> Floats:
    """Indices i such that a load begins or ends to act between positions i and i + 1 of the closed cycle."""
    found: set[int] = set()
    for where in acting(source).values():
        found |= set(np.flatnonzero(np.diff(where.astype(int))).tolist())
    return np.array(sorted(found), dtype=float)


def draw_curve(axes: Axes, curve: Floats, breaks: Floats, colour: str, dash: str = "-") -> Any:
    """A curve (n, 2); dotted where a load jumps. Returns its line."""
    line = None
    starts = [0, *(int(i) + 1 for i in breaks)]
    ends = [*(int(i) + 1 for i in breaks), len(curve)]
    for start, end in zip(starts, ends, strict=True):
        (line,) = axes.plot(curve[start:end, 0], curve[start:end, 1], color=colour, linestyle=dash)
    for i in breaks.astype(int):
        axes.plot(curve[i : i + 2, 0], curve[i : i + 2, 1], color=colour, linestyle=":", linewidth=1.0)
    return line


def mark_inputs(names: Names, curve: Floats, axis: InputAxis, colour: str) -> None:
    """Dots at round values of the input, which are named where there is room, and an arrow."""
    good = np.asarray(np.isfinite(curve).all(axis=1))
    if good.sum() < 3:
        return
    for index, text in _round_places(axis, good):
        names.axes.plot(*curve[index], "o", color=colour, markersize=2.8, zorder=4)
        names.names.append(Name(text, curve[index], spare=True))
    _arrow(names.axes, curve, good, colour)


def _round_places(axis: InputAxis, good: Flags) -> list[tuple[int, str]]:
    """Indices nearest to round values of the axis, each once, with their texts."""
    shown = axis.values * axis.unit.factor
    span = float(np.ptp(shown[np.isfinite(shown)]))
    if span == 0.0:
        return []
    step = 30.0 if axis.dimension == "angle" and 90 <= span <= 400 else round_up(span / 12.0)
    first, last = np.ceil(shown.min() / step - 1e-9), np.floor(shown.max() / step + 1e-9)
    found, seen = [], set()
    values = np.arange(first, last + 1) * step
    for value in values[::-1] if axis.backwards else values:
        index = int(np.nanargmin(np.abs(shown - value)))
        turned = round(value % 360.0, 6) if axis.dimension == "angle" else value
        if good[index] and turned not in seen:
            seen.add(turned)
            suffix = "°" if axis.dimension == "angle" else f" {axis.unit.name}"
            found.append((index, f"{significant(float(value), 6)}{suffix}"))
    return found


def _arrow(axes: Axes, curve: Floats, good: Flags, colour: str) -> None:
    """One arrow head where the curve is long, in the direction of the motion."""
    steps = np.hypot(*np.diff(curve, axis=0).T)
    steps = np.where(good[1:] & good[:-1], steps, 0.0)
    if not steps.sum() > 0:
        return
    usual = np.where(steps < 6 * np.median(steps[steps > 0]), steps, 0.0)
    index = int(np.searchsorted(np.cumsum(usual), 0.08 * usual.sum()))
    index = min(max(index, 1), len(curve) - 3)
    if not good[index - 1 : index + 2].all() or (curve[index - 1] == curve[index + 1]).all():
        return
    axes.annotate("", tuple(curve[index + 1]), tuple(curve[index - 1]),
                  arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 11,
                              "shrinkA": 0, "shrinkB": 0})  # fmt: skip
