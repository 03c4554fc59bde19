"""Programs that are found: the smoothest periodic spline that meets points, windows, dwells and limits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.errors import Finding, ModelError, fault
from linkwright.laws.program import TURN, Program
from linkwright.laws.spline_space import DEGREE, Pieces, SplineSpace
from linkwright.words import _

ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3}
#: Places of a window between two knots at which it is enforced, and rounds that correct what lies between.
_LOOKS, _ROUNDS = 6, 4
#: What a limit is worth, as a share of the aim, for it to be called binding.
_WORTH = 1e-7


_WORDS = {"velocity": _("velocity"), "acceleration": _("acceleration"), "jerk": _("jerk")}


@dataclass(frozen=True)
class Window:
    """The lift is from ``least`` to ``most`` while x goes from ``start`` to ``end``; equal bounds make a dwell."""

    start: float
    end: float
    least: float = -math.inf
    most: float = math.inf


@dataclass(frozen=True)
class Binding:
    """What keeps the motion from being smoother: the demand and its worth, the change of the aim per unit of it."""

    what: str
    worth: float


@dataclass(frozen=True)
class FoundProgram(Program):
    """The periodic spline of order 5 with the minimum peak of ``minimize`` (velocity, acceleration or jerk).

    ``points``: (x, lift) it goes through; ``windows`` it stays in; ``limits`` on the derivatives by name, in lift per
    rad, rad², rad³. Derivatives are bounded by their control values, so limits hold everywhere; ``pieces`` of the
    spline over the turn. A linear program (HiGHS). Raises ModelError where nothing meets all demands.
    """

    points: tuple[tuple[float, float], ...] = ()
    windows: tuple[Window, ...] = ()
    limits: tuple[tuple[str, float], ...] = ()
    minimize: str = "acceleration"
    pieces: int = 90
    period: float = TURN

    def __post_init__(self) -> None:
        found = self._faults()
        if found:
            raise ModelError(found)
        _unused = self._solution

    def _faults(self) -> list[Finding]:
        found = []
        if self.minimize not in ORDERS:
            found.append(
                fault(
                    "aim",
                    "find.minimize",
                    _('"{aim}" cannot be minimized; give one of {known}'),
                    _("write minimize: acceleration"),
                    aim=self.minimize,
                    known=tuple(ORDERS),
                )
            )
        if not self.points and not self.windows:
            found.append(
                fault("nothing_asked", "find", _("nothing is asked of the motion"), _("give points or windows"))
            )
        if not 12 <= self.pieces <= 720:
            found.append(
                fault(
                    "pieces",
                    "find.pieces",
                    _("{pieces} pieces of the spline"),
                    _("give 12 to 720"),
                    pieces=self.pieces,
                )
            )
        for k, each in enumerate(self.windows):
            if not 0 <= each.start < each.end <= self.period + 1e-12 or each.least > each.most:
                found.append(
                    fault(
                        "window",
                        f"find.windows.{k}",
                        _("a window that ends before it begins, or with the larger bound below"),
                        _("give from and to within the turn, increasing, and the minimum below the maximum"),
                    )
                )
        for k, (x, _unused) in enumerate(self.points):
            if not 0 <= x <= self.period + 1e-12:
                found.append(
                    fault(
                        "point_outside",
                        f"find.points.{k}",
                        _("a point outside the turn"),
                        _("give an angle from 0 to 360 deg"),
                    )
                )
        return found

    @cached_property
    def space(self) -> SplineSpace:
        """The splines among which it is looked for: equal knots, and those at the ends of windows."""
        even = np.linspace(0.0, self.period, self.pieces + 1)
        own = {x for each in self.windows for x in (each.start, each.end) if 0 < x < self.period}
        near = 0.3 * self.period / self.pieces
        inner = [x for x in even[1:-1] if all(abs(x - each) > near for each in own)]
        return SplineSpace(np.array([0.0, *sorted({*inner, *own}), self.period]), periodic=True)

    @property
    def _size(self) -> float:
        """The largest lift that is spoken of."""
        named = [abs(lift) for _unused, lift in self.points]
        named += [abs(b) for each in self.windows for b in (each.least, each.most) if math.isfinite(b)]
        return max(named, default=0.0) or 1.0

    @cached_property
    def _solution(self) -> tuple[Pieces, tuple[Binding, ...], float]:
        margins = np.zeros(len(self.windows))
        for _unused in range(_ROUNDS):
            values, binding, peak = self._solved(margins)
            pieces = self.space.pieces(values)
            over = self._outside(pieces)
            if over.max(initial=0.0) <= 1e-9 * max(np.ptp(values), 1e-12):
                break
            margins += 1.5 * over
        return pieces, binding, peak

    def _outside(self, pieces: Pieces) -> Floats:
        """By how much every window is violated between the places at which it is enforced."""
        found = np.zeros(len(self.windows))
        for k, each in enumerate(self.windows):
            if each.least == each.most:
                continue
            s = pieces.curves(np.linspace(each.start, each.end, 40 * self.pieces))[0]
            found[k] = max(0.0, each.least - float(s.min()), float(s.max()) - each.most)
        return found

    def _solved(self, margins: Floats) -> tuple[Floats, tuple[Binding, ...], float]:
        from scipy.optimize import linprog

        space = self.space
        upper, upper_right, names = self._upper(space, margins)
        equal, equal_right, equal_names = self._equal(space)
        cost = np.zeros(space.size + 1)
        cost[-1] = 1.0
        size = self._size  # the program works on lifts of about one, for its tolerances are absolute
        found = linprog(
            cost,
            A_ub=upper,
            b_ub=upper_right / size,
            A_eq=equal if len(equal) else None,
            b_eq=equal_right / size if len(equal) else None,
            bounds=[(None, None)] * (space.size + 1),
            method="highs",
        )
        if not found.success:
            raise ModelError(
                [
                    fault(
                        "nothing_meets",
                        "find",
                        _("no motion meets all points, windows and limits"),
                        _("widen a window or a limit, or take more pieces"),
                    )
                ]
            )
        binding = self._binding(names, -found.ineqlin.marginals, found.fun)
        if len(equal):
            binding += self._binding(equal_names, np.abs(found.eqlin.marginals), found.fun)
        return size * found.x[:-1], tuple(sorted(binding, key=lambda each: -each.worth)), size * found.fun

    def _upper(self, space: SplineSpace, margins: Floats) -> tuple[Floats, Floats, list[str]]:
        """Rows A (control values, peak) <= b with what each demands."""
        blocks: list[Floats] = []
        right: list[Floats] = []
        names: list[str] = []

        def add(rows: Floats, peak: float, limit: float, what: str) -> None:
            blocks.append(np.column_stack([rows, np.full(len(rows), peak)]))
            right.append(np.full(len(rows), limit))
            names.extend([what] * len(rows))

        one_side = space.bounds(ORDERS[self.minimize])
        add(np.concatenate([one_side, -one_side]), -1.0, 0.0, "")
        for name, limit in self.limits:
            bound = space.bounds(ORDERS[name])
            add(np.concatenate([bound, -bound]), 0.0, limit, _("limit of the {what}", what=_WORDS[name]))
        for k, each in enumerate(self.windows):
            if each.least == each.most:
                continue
            rows = space.at(self._looks(each))
            if math.isfinite(each.most):
                add(rows, 0.0, each.most - margins[k], _("window {number}, upper bound", number=k + 1))
            if math.isfinite(each.least):
                add(-rows, 0.0, -each.least - margins[k], _("window {number}, lower bound", number=k + 1))
        return np.concatenate(blocks), np.concatenate(right), names

    def _looks(self, window: Window) -> Floats:
        count = math.ceil(_LOOKS * self.pieces * (window.end - window.start) / self.period) + 2
        return np.linspace(window.start, window.end, count)

    def _equal(self, space: SplineSpace) -> tuple[Floats, Floats, list[str]]:
        """Points, and dwells: all control values that reach into one are its lift."""
        rows = [space.at(np.array([x]))[0] for x, _unused in self.points]
        right = [lift for _unused, lift in self.points]
        names = [_("point at {place}°", place=number(x, "angle")) for x, _unused in self.points]
        for k, each in enumerate(self.windows):
            if each.least != each.most:
                continue
            spans = np.flatnonzero((space.knots[:-1] < each.end - 1e-12) & (space.knots[1:] > each.start + 1e-12))
            touched = sorted({int(i + j) % space.size for i in spans for j in range(DEGREE + 1)})
            for i in touched:
                rows.append(np.eye(space.size)[i])
                right.append(each.least)
                names.append(_("dwell of window {number}", number=k + 1))
        if not rows:
            return np.zeros((0, space.size + 1)), np.zeros(0), []
        return np.column_stack([np.array(rows), np.zeros(len(rows))]), np.array(right), list(names)

    def _binding(self, names: list[str], worths: Floats, aim: float) -> list[Binding]:
        """The demands that cost something, each named once with all it costs."""
        total: dict[str, float] = {}
        for name, worth in zip(names, worths, strict=True):
            if name and worth > _WORTH * max(abs(aim), 1e-9):
                total[name] = total.get(name, 0.0) + float(worth)
        return [Binding(name, worth) for name, worth in total.items()]

    @property
    def binding(self) -> tuple[Binding, ...]:
        """The demands that keep it from being smoother, the dearest first."""
        return self._solution[1]

    @property
    def peak(self) -> float:
        """The lowest bound on the peak of what is minimized; the peak itself is a little below it."""
        return self._solution[2]

    @property
    def edges(self) -> Floats:
        return self._solution[0].edges

    @property
    def breaks(self) -> Floats:
        return self.edges

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        x = np.asarray(x)
        return self._solution[0].curves(x - self.period * np.floor(x.real / self.period))
