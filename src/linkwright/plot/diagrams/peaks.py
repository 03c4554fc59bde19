"""Largest and smallest values, marked on the curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright.metrics.analysis import Kind
from linkwright.plot.diagrams.picture import INK
from linkwright.plot.diagrams.units import Unit, size

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from linkwright.plot.diagrams.panels import Curve, Panel
    from linkwright.plot.diagrams.source import InputAxis

_HALO = {"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}


def mark_peaks(axes: Axes, panel: Panel, axis: InputAxis, unit: Unit) -> None:
    """Dots with values at the extremes of the curves that ask for it."""
    for curve in panel.curves:
        if curve.peak and np.isfinite(curve.values).any():
            _mark(axes, curve, axis, unit)


def _mark(axes: Axes, curve: Curve, axis: InputAxis, unit: Unit) -> None:
    values = curve.values
    if np.nanmax(values) - np.nanmin(values) <= 1e-9 * size(values) + 1e-12:
        return
    places = (axis.values if curve.x is None else curve.x) * axis.unit.factor
    left, right = float(np.min(places)), float(np.max(places))
    for place, value, above in _peaks(curve, axis):
        x, y = place * axis.unit.factor, value * unit.factor
        share = (x - left) / (right - left) if right > left else 0.5
        if places[-1] < places[0]:
            share = 1.0 - share
        side = "left" if share < 0.12 else "right" if share > 0.88 else "center"
        axes.plot([x], [y], "o", color=curve.colour, markersize=3.6, zorder=4)
        axes.annotate(unit.text(value), (x, y), (0, 4 if above else -4), textcoords="offset points", ha=side,
                      va="bottom" if above else "top", fontsize=7.5, color=INK, bbox=_HALO, zorder=5)  # fmt: skip


def _peaks(curve: Curve, axis: InputAxis) -> list[tuple[float, float, bool]]:
    """Place and value of the extremes that are marked, and whether their texts stand above."""
    high, low = _extreme(curve, axis, "max"), _extreme(curve, axis, "min")
    if curve.peak == "largest":
        return [(*high, True)] if high[1] >= -low[1] else [(*low, False)]
    return [(*high, True)] if curve.peak == "max" else [(*high, True), (*low, False)]


def _extreme(curve: Curve, axis: InputAxis, kind: Kind) -> tuple[float, float]:
    """Place on the axis and value: between the positions where the curve knows its extremes, else at one of them."""
    found = curve.extremes(kind) if curve.extremes is not None else None
    if found is not None:
        return (found.time if axis.dimension == "time" else found.input), found.value
    index = int(np.nanargmax(curve.values) if kind == "max" else np.nanargmin(curve.values))
    return float((axis.values if curve.x is None else curve.x)[index]), float(curve.values[index])
