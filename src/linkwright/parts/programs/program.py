"""A program from a small file: minimise or maximise an expression of variables under constraints."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright import units
from linkwright.core import expressions
from linkwright.core.arrays import Floats
from linkwright.core.quantity import in_kind, unit_of_kind
from linkwright.core.table import Block, Row, in_si, unused
from linkwright.equations.notation import Atom, row, sign, upright
from linkwright.equations.reading import filled, measured, of_file, plain, sides
from linkwright.equations.steps import Step, Written
from linkwright.errors import Finding, LinkwrightError, ModelError, fault
from linkwright.fields.base import file_key
from linkwright.fields.tables import Named
from linkwright.parts.base import Problem, Result
from linkwright.parts.programs.problem import (
    VARIABLE,
    Conditions,
    Constraint,
    Formula,
    Model,
    Objective,
    Variable,
    constraint,
    formula,
)
from linkwright.parts.programs.solvers import (
    ENUMERATED,
    branch,
    combinations,
    conflict,
    enumerate_all,
    feasible,
    multipliers,
    runaway,
    solve_linear,
    solve_nonlinear,
)
from linkwright.words import Translate, _

#: A constraint is active within this share of the size of its sides.
ACTIVE = 1e-6
#: A variable beyond this multiple of its scale has run away.
AWAY = 1e6
#: How the best was found.
WAYS = {
    "linear": _("Linear program (simplex method): the optimum of all."),
    "integer": _("Mixed-integer linear program (branch and cut): the optimum of all."),
    "nonlinear": _(
        "Nonlinear program (sequential quadratic programming): {agreed} of {starts} starts came "
        "to this optimum; it is a local one, the best that was found."
    ),
    "enumerated": _("All {count} combinations of the discrete values were tried: the optimum of all."),
    "branched": _("Mixed nonlinear program (branch and bound over local optima): the best that was found."),
}


UNBOUNDED = _("no limit: the objective improves without end along {variables}")


STOPS_THEM = _("give these variables bounds, or a constraint that stops them")


@dataclass(frozen=True)
class Program(Problem):
    """``minimize`` or ``maximize`` a formula of ``variables`` subject to constraints; :meth:`of` reads texts."""

    kind: ClassVar[str] = "program"
    variables: Mapping[str, Variable] = file_key(
        Named(
            VARIABLE,
            _("variable"),
            doc="variables by name: {from: 0 mm, to: 40 mm}, with integer: true or choices: […]",
        )
    )
    minimize: Formula | None = file_key(Objective(doc="what is to be small, an expression"), None)
    maximize: Formula | None = file_key(Objective(doc="or what is to be large"), None)
    subject_to: tuple[Constraint, ...] = file_key(Conditions(doc="constraints by name: 2*x + y <= 100"), ())
    name: str = ""
    source: str = ""

    @classmethod
    def of(
        cls,
        variables: Mapping[str, Variable],
        *,
        minimize: str = "",
        maximize: str = "",
        subject_to: Mapping[str, str] | None = None,
        parameters: Mapping[str, str] | None = None,
        name: str = "",
    ) -> Program:
        """A program from texts; ``parameters`` are quantities by name. Raises QuantityError."""
        kinds, values = dict[str, units.Dimension](), dict[str, float]()
        for key, text in (parameters or {}).items():
            expression = expressions.parse_any(text, kinds)
            kinds[key], values[key] = expression.dimension(kinds), float(expression.evaluate(values))
        known = {**kinds, **{key: v.dimension for key, v in variables.items()}}
        limits = [c for key, text in (subject_to or {}).items() for c in constraint(key, text, known, values)]
        low, high = (formula(text, known, values) if text else None for text in (minimize, maximize))
        return cls(variables, low, high, tuple(limits), name)

    @property
    def model(self) -> Model:
        """The program in numbers."""
        objective = self.minimize or self.maximize
        assert objective is not None
        return Model(self.variables, objective, 1 if self.minimize else -1, self.subject_to)

    def findings(self) -> list[Finding]:
        found = (
            []
            if self.variables
            else [
                fault(
                    "no_variables",
                    "variables",
                    _("there is no variable"),
                    _("write variables: {{x: {{from: 0, to: 10}}}}"),
                )
            ]
        )
        if (self.minimize is None) == (self.maximize is None):
            found.append(
                fault(
                    "one_objective",
                    "minimize" if self.minimize else "",
                    _("there must be exactly one of minimize and maximize"),
                    _("write minimize: 3*x + 2*y"),
                )
            )
        for name, v in self.variables.items():
            if v.minimum > v.maximum:
                found.append(
                    fault(
                        "bounds",
                        f"variables.{name}",
                        _("the lower bound {low} lies above the upper bound {high}"),
                        _("exchange them"),
                        low=self.shown(name, v.minimum),
                        high=self.shown(name, v.maximum),
                    )
                )
        return found

    def shown(self, variable: str, value: float) -> str:
        """A variable's value with its unit."""
        return in_kind(value, self.variables[variable].dimension)

    def solve(self) -> Optimum:
        """The optimum. Raises ModelError with all findings; for a program without solution with the constraints that
        cannot hold together, for one without limit with the direction in which it runs away."""
        self.require()
        choosing = any(v.choices for v in self.variables.values())
        return self._linear() if self.model.linear and not choosing else self._nonlinear()

    def _linear(self) -> Optimum:
        model = self.model
        found = solve_linear(model)
        if found is not None:
            return Optimum(self, found.x, "integer" if found.prices is None else "linear", found.prices)
        if not feasible(model):
            raise self._no_solution(feasible)
        way = runaway(model)
        moving = tuple(
            f"{name} {'↑' if step > 0 else '↓'}"
            for name, step, size in zip(self.variables, way, model.sizes, strict=True)
            if abs(step) > 1e-9 * size
        )
        raise _unbounded(moving)

    def _nonlinear(self) -> Optimum:
        model = self.model
        count = combinations(model)
        if count is not None and count <= ENUMERATED:
            found = enumerate_all(model)
            if found is None:
                raise self._no_solution(lambda m: enumerate_all(_aimless(m)) is not None, open_ends=False)
            return Optimum(self, found.x, "enumerated", None, combinations=count)
        if any(v.discrete for v in self.variables.values()):
            found, way = branch(model), "branched"
        else:
            found, way = solve_nonlinear(model), "nonlinear"
        if found is None:
            raise self._no_solution(lambda m: solve_nonlinear(_aimless(m), 6) is not None, from_starts=True)
        if (np.abs(found.x) > AWAY * model.sizes).any():
            far = tuple(n for n, x, s in zip(self.variables, found.x, model.sizes, strict=True) if abs(x) > AWAY * s)
            raise _unbounded(far)
        prices, gap = multipliers(model, found.x) if way == "nonlinear" else (None, 0.0)
        return Optimum(self, found.x, way, prices, agreed=(found.agreed, found.starts), gap=gap)

    def _no_solution(self, possible: Any, *, open_ends: bool = True, from_starts: bool = False) -> ModelError:
        names, bounds = conflict(self.model, possible, open_ends=open_ends)
        texts = tuple(f"{c.name} ({c.text})" for c in self.subject_to if c.name in names)
        for name, side in bounds:
            value = self.shown(name, getattr(self.variables[name], side))
            texts += (f"{name} {'>=' if side == 'low' else '<='} {value}",)
        if not texts:
            texts = (_("the integers or choices of the variables"),)
        key = f"subject_to.{names[0]}" if names else "variables"
        if from_starts:
            finding = fault(
                "not_found",
                key,
                _("no point was found that keeps all constraints; from no start did these hold together: {set}"),
                _("loosen one of them, or give a start near a point that keeps them"),
                set=texts,
            )
        else:
            finding = fault(
                "infeasible",
                key,
                _("no solution: these cannot hold together: {set}"),
                _("loosen one of them; any one is enough for these"),
                set=texts,
            )
        return ModelError([finding])


def _unbounded(variables: tuple[str, ...]) -> ModelError:
    """The refusal of a program whose optimum runs away along some variables."""
    return ModelError([fault("unbounded", "subject_to", UNBOUNDED, STOPS_THEM, variables=variables)])


def _aimless(model: Model) -> Model:
    """The same constraints without an aim."""
    return Model(model.variables, formula("0", {}, {}), 1, model.constraints)


@dataclass(frozen=True, repr=False)
class Optimum(Result):
    """The optimum: ``x`` (SI) by variable, ``value``, and the state of every constraint.

    ``way``: linear, integer, nonlinear, enumerated, branched. ``prices``: change of the objective per unit of each
    constraint's right side (SI), where it is known. ``agreed``: starts that came to this optimum, of how many;
    ``gap``: how far the condition of Karush, Kuhn and Tucker is from holding, scaled.
    """

    program: Program
    values: Floats
    way: str
    _prices: Floats | None
    agreed: tuple[int, int] = (1, 1)
    gap: float = 0.0
    combinations: int = 0

    @property
    def x(self) -> dict[str, float]:
        """The variables, SI."""
        return dict(zip(self.program.variables, self.values.tolist(), strict=True))

    @cached_property
    def point(self) -> dict[str, Floats]:
        """The optimum as columns of one value, for formulas."""
        return self.program.model.point(self.values[:, None])

    @property
    def value(self) -> float:
        """The objective, SI."""
        return float(self.program.model.objective.value(self.point)[0])

    @property
    def prices(self) -> dict[str, float]:
        """Change of the objective, as it was given, per unit of each constraint's right side, SI."""
        if self._prices is None:
            return {}
        sign = self.program.model.sign
        pairs = zip(self.program.subject_to, self._prices, strict=True)
        # a price counts the excess' right side; that of >= is turned round
        return {c.name: float(sign * price * (-1.0 if c.sense == ">=" else 1.0)) + 0.0 for c, price in pairs}

    def slack(self, constraint: Constraint) -> float:
        """How much is left until the constraint becomes active, SI."""
        return -float(constraint.excess(self.point)[0])

    def active(self, constraint: Constraint) -> bool:
        """Whether it holds with equality."""
        sides = [abs(float(side.value(self.point)[0])) for side in (constraint.left, constraint.right)]
        return constraint.sense == "=" or self.slack(constraint) <= ACTIVE * max(*sides, 1e-300)

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [
            Row(
                name,
                value,
                label=name,
                note=self._at_bound(name, translate),
                scale=in_si(self._kind(name)),
                text=in_kind(value, self._kind(name)),
            )
            for name, value in self.x.items()
        ]
        word = translate(_("minimum") if self.program.minimize else _("maximum"))
        kind = self.program.model.objective.dimension
        rows.append(Row("objective", self.value, label=word, scale=in_si(kind), text=in_kind(self.value, kind)))
        found = [Block("optimum", _("Optimum"), rows, (self._method(translate),))]
        limits = [self._limit_row(c, translate) for c in self.program.subject_to]
        if limits:
            found.append(Block("constraints", _("Constraints"), limits, self._explained(translate)))
        return found

    def data(self) -> dict[str, Any]:
        """Variables, objective, and of every constraint its sides, slack and price, SI, each with its unit."""
        kind = self.program.model.objective.dimension
        limits: dict[str, Any] = {}
        for c in self.program.subject_to:
            limits[unused(c.name, limits)] = self._limit_data(c)
        return {
            "name": self.title,
            "way": self.way,
            "x": {name: _measured(value, self._kind(name)) for name, value in self.x.items()},
            "objective": _measured(self.value, kind),
            "constraints": limits,
        }

    def _limit_data(self, c: Constraint) -> dict[str, Any]:
        """A constraint as data; the price is in units of the objective per unit of the constraint."""
        sides = {"left": c.left, "right": c.right}
        objective = self.program.model.objective.dimension
        price = self.prices.get(c.name)
        return {
            **{key: _measured(float(side.value(self.point)[0]), side.dimension) for key, side in sides.items()},
            "sense": c.sense,
            "slack": _measured(self.slack(c), _limit_kind(c)),
            "active": self.active(c),
            "price": None if price is None else _measured(price, units.times(objective, _limit_kind(c), -1)),
        }

    def _kind(self, name: str) -> units.Dimension:
        """The dimension of a variable."""
        return self.program.variables[name].dimension

    def _method(self, translate: Translate) -> str:
        return translate(
            WAYS[self.way].format(
                agreed=self.agreed[0], starts=self.agreed[1], count=self.combinations, gap=f"{self.gap:.1e}"
            )
        )

    def _at_bound(self, name: str, translate: Translate) -> str:
        variable, value = self.program.variables[name], self.x[name]
        for bound, word in ((variable.minimum, _("at its lower bound")), (variable.maximum, _("at its upper bound"))):
            if math.isfinite(bound) and abs(value - bound) <= ACTIVE * max(variable.size, abs(bound)):
                return translate(word)
        return ""

    def _limit_row(self, c: Constraint, translate: Translate) -> Row:
        left, right = (in_kind(float(side.value(self.point)[0]), side.dimension, 5) for side in (c.left, c.right))
        state = (
            translate(_("active"))
            if self.active(c)
            else translate(_("{slack} left", slack=in_kind(self.slack(c), c.left.dimension, 4)))
        )
        text = f"{left} {c.sense} {right}"
        return Row(c.name, self.slack(c), label=c.name, note=state, scale=in_si(_limit_kind(c)), text=text)

    def _explained(self, translate: Translate) -> tuple[str, ...]:
        """What one more unit of every active constraint is worth."""
        lines = []
        for c in self.program.subject_to:
            price = self.prices.get(c.name, 0.0)
            if price:
                (unit, factor), (own, size) = (
                    unit_of_kind(_limit_kind(c)),
                    unit_of_kind(self.program.model.objective.dimension),
                )
                gain = f"{abs(price) * size / factor:.6g} {own}".rstrip()
                best = translate(_("minimum") if self.program.minimize else _("maximum"))
                effect = (
                    _("Raising the right side of {name} by {step} raises the {best} by {price} (shadow price).")
                    if price > 0
                    else _("Raising the right side of {name} by {step} lowers the {best} by {price} (shadow price).")
                )
                lines.append(translate(effect.format(name=c.name, step=f"1 {unit}".rstrip(), best=best, price=gain)))
        return tuple(lines)

    def _allowed(self, name: str, variable: Variable) -> str:
        """The values that a variable may take: ``0 ≤ x ≤ 5 ∈ ℤ``, ``x ≥ 0 mm``, ``x ∈ {1 mm, 2 mm}``, ``x ∈ ℝ``."""
        shown = self.program.shown
        if variable.choices:
            return f"{name} ∈ {{{', '.join(shown(name, c) for c in variable.choices)}}}"
        below, above = math.isfinite(variable.low), math.isfinite(variable.high)
        if not (below or above):
            return f"{name} ∈ {'ℤ' if variable.integer else 'ℝ'}"
        if below and above:
            text = f"{shown(name, variable.low)} ≤ {name} ≤ {shown(name, variable.high)}"
        else:
            text = f"{name} ≥ {shown(name, variable.low)}" if below else f"{name} ≤ {shown(name, variable.high)}"
        return f"{text} ∈ ℤ" if variable.integer else text

    @staticmethod
    def _law(
        step: Step, text: str, name: str = "", values: Mapping[str, str] | None = None, result: str = ""
    ) -> None:
        """A formula of the file: as it is written in texts, set in reports; with numbers and a result."""
        formula = of_file(text)
        parts = [formula, *filter(None, [filled(formula.partition(" = ")[2], values) if values else ""])]
        parts += [measured(result)] if result else []
        shown_text = " = ".join([text, *(plain(part) for part in parts[1:])])
        label = f"{name}:  " if name else ""
        try:
            set_sides = tuple(each for part in parts for each in sides(part))
        except LinkwrightError:
            step.note(label + shown_text)
            return
        before = (upright(name), sign(":"), Atom("space", "quad")) if name else ()
        first = row((*before, set_sides[0]))
        step.items.append(Written(label + shown_text, (first, *set_sides[1:])))

    def steps(self, translate: Translate) -> list[Step]:
        task, found, test = (
            Step(str(i), translate(title))
            for i, title in enumerate((_("The program"), _("The optimum"), _("Constraints at the optimum")), 1)
        )
        objective = self.program.model.objective
        self._law(task, f"{'min' if self.program.minimize else 'max'} f = {objective.text}")
        for c in self.program.subject_to:
            self._law(task, c.text, c.name)
        for name, v in self.program.variables.items():
            self._law(task, self._allowed(name, v))
        found.note(self._method(translate))
        for name, value in self.x.items():
            found.law(f"{name} = {measured(self.program.shown(name, value))}")
        values = {name: self.program.shown(name, value) for name, value in self.x.items()}
        self._law(found, f"f = {objective.text}", values=values, result=in_kind(self.value, objective.dimension))
        for c in self.program.subject_to:
            row = self._limit_row(c, translate)
            test.note(f"{c.name}: {row.text}   {row.note}")
        for line in self._explained(translate):
            test.note(line)
        if self.way == "nonlinear":
            test.note(translate(_("Condition of Karush, Kuhn and Tucker, scaled:")))
            test.put("|∇f + Σλ∇g|", "", self.gap)
        return [task, found, test]


def _limit_kind(c: Constraint) -> units.Dimension:
    """The dimension of a constraint's sides; a plain number may stand on the left."""
    return c.right.dimension if c.left.dimension == units.NONE else c.left.dimension


def _measured(value: float, kind: units.Dimension) -> dict[str, Any]:
    """A value with its SI unit."""
    return {"value": value, "unit": units.si_symbol(kind)}
