"""Linear and mixed-integer programs by HiGHS: optimum, duals, and why there is none."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.parts.programs.problem import Model


@dataclass(frozen=True)
class LinearForm:
    """min c·y + c0 under A y ≤ b, E y = d in scaled variables y = x/s, rows scaled by ``scales``."""

    costs: Floats
    constant: float
    rows: Floats
    right: Floats
    equal: Flags
    scales: Floats
    sizes: Floats
    bounds: Floats
    integral: Floats


def linear_form(model: Model) -> LinearForm:
    """The numbers of a linear model."""
    zero = model.point(np.zeros((len(model.variables), 1)))
    sizes = np.where([v.integer for v in model.variables.values()], 1.0, model.sizes)
    costs = model.sign * model.objective.gradient(zero)[:, 0] * sizes
    constant = model.sign * float(model.objective.value(zero)[0])
    slopes = [c.slope(zero)[:, 0] * sizes for c in model.constraints]
    rows = np.array(slopes).reshape(len(slopes), len(sizes))
    right = np.array([-float(c.excess(zero)[0]) for c in model.constraints])
    scales = np.abs(rows).max(axis=1, initial=0.0)
    scales[scales == 0.0] = 1.0
    return LinearForm(
        costs,
        constant,
        rows / scales[:, None],
        right / scales,
        np.array([c.sense == "=" for c in model.constraints], dtype=bool),
        scales,
        sizes,
        np.stack([model.lows / sizes, model.highs / sizes], axis=1),
        np.array([float(v.integer) for v in model.variables.values()]),
    )


@dataclass(frozen=True)
class LinearOptimum:
    """Optimum ``x`` (SI); ``prices``: change of the minimised value per unit of each constraint's right side.

    None for integer programs.
    """

    x: Floats
    prices: Floats | None


def _run(form: LinearForm, costs: Floats) -> Any:
    from scipy.optimize import LinearConstraint, linprog, milp

    if form.integral.any():
        low = np.where(form.equal, form.right, -np.inf)
        limits = LinearConstraint(form.rows, low, form.right) if len(form.rows) else ()
        return milp(costs, constraints=limits, integrality=form.integral, bounds=_bounds(form))
    up, eq = ~form.equal, form.equal
    return linprog(
        costs,
        form.rows[up] if up.any() else None,
        form.right[up] if up.any() else None,
        form.rows[eq] if eq.any() else None,
        form.right[eq] if eq.any() else None,
        form.bounds,
        method="highs",
    )


def _bounds(form: LinearForm) -> Any:
    from scipy.optimize import Bounds

    return Bounds(form.bounds[:, 0], form.bounds[:, 1])


def feasible(model: Model) -> bool:
    """Whether any point keeps all constraints."""
    form = linear_form(model)
    if (form.bounds[:, 0] > form.bounds[:, 1]).any():
        return False
    return int(_run(form, np.zeros_like(form.costs)).status) == 0


def solve_linear(model: Model) -> LinearOptimum | None:
    """The optimum; None where there is none (:func:`feasible` and :func:`runaway` say why)."""
    form = linear_form(model)
    size = _size(form.costs)
    found = _run(form, form.costs / size)
    if found.status != 0:
        return None
    x = np.asarray(found.x)
    x = np.where(form.integral > 0, np.round(x), x) * form.sizes
    if form.integral.any():
        return LinearOptimum(x, None)
    prices = np.zeros(len(form.rows))
    prices[~form.equal] = found.ineqlin.marginals
    prices[form.equal] = found.eqlin.marginals
    return LinearOptimum(x, size * prices / form.scales)


def _size(costs: Floats) -> float:
    """The largest cost, by which an objective is divided so that its unit does not matter."""
    return float(np.abs(costs).max(initial=0.0)) or 1.0


def runaway(model: Model) -> Floats:
    """The direction (SI, largest part of scaled size 1) along which a linear objective falls without end."""
    from scipy.optimize import linprog

    form = linear_form(model)
    ends = [(0.0 if np.isfinite(low) else -1.0, 0.0 if np.isfinite(high) else 1.0) for low, high in form.bounds]
    up, eq = ~form.equal, form.equal
    found = linprog(
        form.costs / _size(form.costs),
        form.rows[up] if up.any() else None,
        np.zeros(int(up.sum())) if up.any() else None,
        form.rows[eq] if eq.any() else None,
        np.zeros(int(eq.sum())) if eq.any() else None,
        ends,
        method="highs",
    )
    return np.asarray(found.x) * form.sizes


def conflict(
    model: Model, feasible: Callable[[Model], bool], *, open_ends: bool = True
) -> tuple[list[str], list[tuple[str, str]]]:
    """Names of constraints, and bounds (variable, ``low`` or ``high``), that cannot hold together; without any one of
    them the others can (deletion filter: Chinneck and Dravnieks, ORSA Journal on Computing 3, 1991).

    Without ``open_ends`` all bounds stay and none is named: ``feasible`` goes through every value between them.
    """
    constraints = [c.name for c in model.constraints]
    bounds = [
        (name, side)
        for name, v in model.variables.items()
        for side in ("low", "high")
        if math.isfinite(getattr(v, side)) and not v.choices and open_ends
    ]
    needed: list[str] = []
    for name in constraints:
        fewer = model.without(constraint=name)
        if feasible(fewer):
            needed.append(name)
        else:
            model = fewer
    held: list[tuple[str, str]] = []
    for bound in bounds:
        fewer = model.without(bound=bound)
        if feasible(fewer):
            held.append(bound)
        else:
            model = fewer
    return needed, held
