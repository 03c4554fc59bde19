"""Largest and smallest values, marked on the curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from linkwright.kinematics.cycle import Floats
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
    for index, above in _places(values, curve.peak):
        x, y = float(places[index]), float(values[index]) * unit.factor
        share = (x - left) / (right - left) if right > left else 0.5
        if places[-1] < places[0]:
            share = 1.0 - share
        side = "left" if share < 0.12 else "right" if share > 0.88 else "center"
        axes.plot([x], [y], "o", color=curve.colour, markersize=3.6, zorder=4)
        text = f"{unit.text(float(values[index]))}"
        axes.annotate(text, (x, y), (0, 4 if above else -4), textcoords="offset points", ha=side,
                      va="bottom" if above else "top", fontsize=7.5, color=INK, bbox=_HALO, zorder=5)  # fmt: skip


def _places(values: Floats, peak: str) -> list[tuple[int, bool]]:
    """Indices of the extremes that are marked, and whether their texts stand above."""
    high, low = int(np.nanargmax(values)), int(np.nanargmin(values))
    if peak == "largest":
        return [(high, True)] if values[high] >= -values[low] else [(low, False)]
    return [(high, True)] if peak == "max" else [(high, True), (low, False)]
