"""Curves of several alternatives to draw over each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.designs.alternatives import Alternative
from linkwright.units import si_unit


@dataclass(frozen=True)
class Overlay:
    """One quantity of all alternatives: ``name`` (a key of the labels of curves), its dimension; per label
    the input passed since the cycle's begin (n,) (rad or m, in its direction of motion) and the values (n,), SI.

    A hodograph has the two components of a force instead.
    """

    name: str
    dimension: str
    lines: Mapping[str, tuple[Floats, Floats]]


def overlays(alternatives: Sequence[Alternative]) -> tuple[Overlay, ...]:
    """Output, its rates, pivot reaction with its hodograph, input torque."""
    found = [_motion(alternatives, name, place) for place, name in enumerate(("travel", "velocity", "acceleration"))]
    if any(each.loaded for each in alternatives):
        sizes = {a.label: (_passed(a), np.hypot(*a.pivot_force.T)) for a in alternatives}
        hodograph = {a.label: (a.pivot_force[:, 0], a.pivot_force[:, 1]) for a in alternatives}
        torque = {a.label: (_passed(a), a.forces.input_torque) for a in alternatives}
        found += [
            Overlay("pivot_reaction", "force", sizes),
            Overlay("hodograph", "force", hodograph),
            Overlay("input_torque", "torque", torque),
        ]
    return tuple(found)


def _motion(alternatives: Sequence[Alternative], name: str, place: int) -> Overlay:
    turning = all(each.output.kind == "angle" for each in alternatives)
    kinds = (
        ("angle", "angular_velocity", "angular_acceleration") if turning else ("length", "velocity", "acceleration")
    )
    return Overlay(name, kinds[place], {a.label: (_passed(a), a.travel()[place]) for a in alternatives})


def _passed(alternative: Alternative) -> Floats:
    """How far the input has gone since the cycle began."""
    q = alternative.motion.input
    return np.asarray(np.abs(q - q[0]))


def overlay_columns(overlays: Iterable[Overlay]) -> dict[str, Floats]:
    """Curves as columns by name with unit, SI."""
    columns: dict[str, Floats] = {}
    for overlay in overlays:
        unit = si_unit(overlay.dimension)
        for label, (x, y) in overlay.lines.items():
            if overlay.name == "hodograph":
                columns[f"{label}: pivot_reaction.x [{unit}]"] = x
                columns[f"{label}: pivot_reaction.y [{unit}]"] = y
                continue
            columns.setdefault(f"{label}: input", x)
            columns[f"{label}: {overlay.name} [{unit}]"] = y
    return columns


def overlay_data(overlays: Iterable[Overlay]) -> list[dict[str, Any]]:
    """Curves as plain data."""
    return [
        {
            "name": overlay.name,
            "unit": si_unit(overlay.dimension),
            "lines": {label: {"x": x.tolist(), "y": y.tolist()} for label, (x, y) in overlay.lines.items()},
        }
        for overlay in overlays
    ]
