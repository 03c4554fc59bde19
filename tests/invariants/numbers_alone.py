"""Metrics of one of many designs, which is solved by itself."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

import linkwright as lw
from linkwright.analysis import METRICS, Analysis


def numbers_alone(
    machine: lw.Mechanism, columns: Mapping[str, NDArray[np.float64]], index: int, names: Sequence[str]
) -> dict[str, float]:
    """Values by name, of the worst subject where none is named, of those names that the machine has values of."""
    design = machine.with_dimensions({name: float(column[index]) for name, column in columns.items()})
    analysis = Analysis.of(lw.solve_forces(design))
    asked = {name.split(maxsplit=1)[0] for name in names}
    table = lw.metrics(analysis.forces, sorted(each for each in asked if METRICS[each]().applies(analysis)))
    found = {}
    for name in names:
        metric, _, subject = name.partition(" ")
        rows = [row for row in table.rows if row.metric == metric and subject in ("", row.subject)]
        if rows:
            found[name] = worst([row.value for row in rows], METRICS[metric].better)
    return found


def worst(values: Sequence[float], better: str | None) -> float:
    """Of several values the one that governs: the least where more is better, the largest where less is, else the
    first."""
    if better is None:
        return values[0]
    return min(values) if better == "higher" else max(values, key=abs)
