"""Solvers: HiGHS for linear and mixed-integer programs, sequential quadratic programming for nonlinear ones."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
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


#: A scaled excess up to this size counts as none.
CONSTRAINT_TOLERANCE = 1e-7
#: Starts of a search, combinations that are enumerated, nodes that are branched at most.
STARTS, ENUMERATED, NODES = 24, 2_000_000, 400


@dataclass(frozen=True)
class Found:
    """The best point ``x`` (SI) of a search, how many starts ``agreed`` on its value, of how many."""

    x: Floats
    value: float
    agreed: int
    starts: int


class Scaled:
    """A model in scaled variables, objective and constraints of about size 1, as SciPy wants it."""

    def __init__(self, model: Model) -> None:
        self.model, self.sizes = model, model.sizes
        points = model.point(model.samples(32))
        self.unit = _typical(model.objective.value(points))
        self.units = [max(_typical(c.left.value(points)), _typical(c.right.value(points))) for c in model.constraints]

    def point(self, y: Floats) -> dict[str, Floats]:
        """SI values by variable at one scaled point."""
        return self.model.point((y * self.sizes)[:, None])

    def value(self, y: Floats) -> float:
        """Scaled objective, large where it has no value."""
        found = self.model.sign * float(self.model.objective.value(self.point(y))[0]) / self.unit
        return found if math.isfinite(found) else 1e10

    def slope(self, y: Floats) -> Floats:
        """Its derivatives."""
        found = self.model.sign * self.model.objective.gradient(self.point(y))[:, 0] * self.sizes / self.unit
        return np.nan_to_num(found, posinf=1e10, neginf=-1e10)

    def excess(self, y: Floats) -> Floats:
        """Scaled excesses of all constraints."""
        point = self.point(y)
        found = [float(c.excess(point)[0]) / u for c, u in zip(self.model.constraints, self.units, strict=True)]
        return np.asarray(np.nan_to_num(np.array(found), nan=1e3, posinf=1e10, neginf=-1e10))

    def slopes(self, y: Floats) -> Floats:
        """Their derivatives, (constraints, variables)."""
        point = self.point(y)
        rows = [
            c.slope(point)[:, 0] * self.sizes / u for c, u in zip(self.model.constraints, self.units, strict=True)
        ]
        return np.nan_to_num(np.array(rows).reshape(len(rows), len(self.sizes)), posinf=1e10, neginf=-1e10)

    def violation(self, y: Floats) -> float:
        """Largest violation."""
        if not self.model.constraints:
            return 0.0
        equal = np.array([c.sense == "=" for c in self.model.constraints])
        excess = self.excess(y)
        return float(np.where(equal, np.abs(excess), np.maximum(excess, 0.0)).max())

    def constraints(self) -> list[dict[str, Any]]:
        """In SciPy's form: zero, or not below zero."""
        equal = np.array([c.sense == "=" for c in self.model.constraints], dtype=bool)
        found = []
        for kind, chosen, sign in (("ineq", ~equal, -1.0), ("eq", equal, 1.0)):
            if chosen.any():
                found.append(
                    {
                        "type": kind,
                        "fun": lambda y, k=chosen, s=sign: s * self.excess(y)[k],
                        "jac": lambda y, k=chosen, s=sign: s * self.slopes(y)[k],
                    }
                )
        return found


def _typical(values: Floats) -> float:
    good = np.abs(values[np.isfinite(values)])
    good = good[good > 0]
    return float(np.median(good)) if len(good) else 1.0


def solve_nonlinear(model: Model, starts: int = STARTS) -> Found | None:
    """The best local optimum from many starts, all variables continuous; None where no start came to a point that
    keeps all constraints."""
    import warnings

    from scipy.optimize import minimize

    scaled = Scaled(model)
    low, high = model.lows / scaled.sizes, model.highs / scaled.sizes
    bounds = [
        (a if math.isfinite(a) else None, b if math.isfinite(b) else None) for a, b in zip(low, high, strict=True)
    ]
    ends: list[tuple[float, Floats]] = []
    for start in model.samples(starts).T:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            found = minimize(
                scaled.value,
                np.clip(start / scaled.sizes, low, high),
                jac=scaled.slope,
                bounds=bounds,
                method="SLSQP",
                constraints=scaled.constraints(),
                options={"maxiter": 300, "ftol": 1e-13},
            )
        y = np.clip(found.x, low, high)
        if np.isfinite(y).all() and scaled.violation(y) <= CONSTRAINT_TOLERANCE:
            ends.append((scaled.value(y), y))
    if not ends:
        return None
    value, y = min(ends, key=lambda each: each[0])
    agreed = sum(abs(each - value) <= 1e-6 * max(1.0, abs(value)) for each, _ in ends)
    return Found(y * scaled.sizes, value * scaled.unit * model.sign, agreed, starts)


def multipliers(model: Model, x: Floats) -> tuple[Floats, float]:
    """Change of the minimised value per unit of each constraint's right side, and how far Karush, Kuhn and Tucker's
    condition ∇f + Σ λ ∇g = 0 is from holding (scaled); zero for constraints that are not active."""
    from scipy.optimize import lsq_linear

    scaled = Scaled(model)
    y = x / scaled.sizes
    excess, slopes = scaled.excess(y), scaled.slopes(y)
    equal = np.array([c.sense == "=" for c in model.constraints], dtype=bool)
    active = [i for i in range(len(excess)) if equal[i] or excess[i] > -1e-6]
    columns, lows = [slopes[i] for i in active], [-np.inf if equal[i] else 0.0 for i in active]
    for j, axis in enumerate(np.eye(len(y))):
        for bound, sign in ((model.lows[j], -1.0), (model.highs[j], 1.0)):
            if math.isfinite(bound) and abs(x[j] - bound) <= 1e-7 * scaled.sizes[j]:
                columns.append(sign * axis)
                lows.append(0.0)
    gradient, prices = scaled.slope(y), np.zeros(len(excess))
    if not columns:
        return prices, float(np.abs(gradient).max())
    matrix = np.array(columns).T
    found = lsq_linear(matrix, -gradient, (lows, np.inf), tol=1e-14)
    for i, each in zip(active, found.x, strict=False):
        prices[i] = -each * scaled.unit / scaled.units[i]
    return prices, float(np.abs(matrix @ found.x + gradient).max())


def enumerate_all(model: Model) -> Found | None:
    """The best of all combinations of discrete variables: exact; None where none keeps the constraints."""
    values = [_values(v) for v in model.variables.values()]
    grid = np.array(list(itertools.product(*values))).T
    points = model.point(grid)
    good = np.ones(grid.shape[1], dtype=bool)
    for c, unit in zip(model.constraints, Scaled(model).units, strict=True):
        excess = c.excess(points) / unit
        good &= (np.abs(excess) <= 1e-9) if c.sense == "=" else (excess <= 1e-9)
    objective = np.where(good, model.sign * model.objective.value(points), np.inf)
    best = int(np.nanargmin(objective)) if good.any() else -1
    if best < 0 or not np.isfinite(objective[best]):
        return None
    return Found(grid[:, best], model.sign * float(objective[best]), 1, 1)


def _values(variable: Any) -> Sequence[float]:
    if variable.choices:
        return list(variable.choices)
    return [float(n) for n in range(math.ceil(variable.low), math.floor(variable.high) + 1)]


def combinations(model: Model) -> int | None:
    """How many combinations there are; None where a variable is continuous or without bounds."""
    if not all(
        v.discrete and math.isfinite(v.minimum) and math.isfinite(v.maximum) for v in model.variables.values()
    ):
        return None
    return math.prod(len(_values(v)) for v in model.variables.values())


def branch(model: Model) -> Found | None:
    """Mixed programs: continuous optima with bounds drawn closer until all discrete variables take their values."""
    waiting, best = [model], None
    for _ in range(NODES):
        if not waiting:
            break
        node = waiting.pop()
        found = solve_nonlinear(_relaxed(node), 8)
        if found is None or (best is not None and model.sign * (found.value - best.value) >= 0):
            continue
        split = _split(node, found.x)
        if split is None:
            best = found
        else:
            waiting += split
    return best


def _relaxed(model: Model) -> Model:
    """All variables continuous within their bounds."""
    free = {
        name: replace(v, low=v.minimum, high=v.maximum, integer=False, choices=(), start=None)
        for name, v in model.variables.items()
    }
    return Model(free, model.objective, model.sign, model.constraints)


def _split(model: Model, x: Floats) -> list[Model] | None:
    """Two models that exclude a value between two allowed ones, the nearer last; None where all are allowed."""
    for (name, variable), value in zip(model.variables.items(), x, strict=True):
        if not variable.discrete:
            continue
        allowed = variable.choices or (math.floor(value + 1e-6), math.floor(value + 1e-6) + 1)
        size = 1e-6 * max(abs(value), 1.0 if variable.integer else abs(allowed[-1]))
        if any(abs(value - each) <= size for each in allowed):
            continue
        below = [each for each in allowed if each < value]
        above = [each for each in allowed if each > value]
        parts = []
        for values, side in ((below, "high"), (above, "low")):
            if values:
                choices = tuple(values) if variable.choices else ()
                end = {"choices": choices} if choices else {side: values[-1] if side == "high" else values[0]}
                changed = {**model.variables, name: replace(variable, **end)}
                parts.append(Model(changed, model.objective, model.sign, model.constraints))
        return parts if not below or (above and value - below[-1] > above[0] - value) else parts[::-1]
    return None
