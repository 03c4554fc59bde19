"""Why a program has no solution: an irreducible set of constraints that cannot hold together."""

from __future__ import annotations

import math
from collections.abc import Callable

from linkwright.parts.programs.problem import Model


def conflict(model: Model, feasible: Callable[[Model], bool]) -> tuple[list[str], list[tuple[str, str]]]:
    """Names of constraints, and bounds (variable, ``low`` or ``high``), that cannot hold together; without any one of
    them the others can (deletion filter: Chinneck and Dravnieks, ORSA Journal on Computing 3, 1991)."""
    constraints = [c.name for c in model.constraints]
    bounds = [
        (name, side)
        for name, v in model.variables.items()
        for side in ("low", "high")
        if math.isfinite(getattr(v, side)) and not v.choices
    ]
    kept: list[str] = []
    for name in constraints:
        fewer = model.without(constraint=name)
        if feasible(fewer):
            kept.append(name)
        else:
            model = fewer
    held: list[tuple[str, str]] = []
    for bound in bounds:
        fewer = model.without(bound=bound)
        if feasible(fewer):
            held.append(bound)
        else:
            model = fewer
    return kept, held
