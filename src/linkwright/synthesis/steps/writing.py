"""What the steps of all tasks are written with: symbols, tables, matrices, and what a four-bar is examined by."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import fixed
from linkwright.equations.matrix import Entries, side_by_side
from linkwright.equations.steps import Step, Tabulated
from linkwright.equations.terms import TWO, ZERO, Term, arccosine, symbol
from linkwright.synthesis.names import TYPE_NAMES
from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.words import Message, Translate, _

#: Lengths are printed in m where the longest link has this length or more, m.
LARGE = 10.0
#: Share of its size below which a deviation is rounding.
ROUNDING = 1e-11
#: Most rows of a table of positions.
MOST_ROWS = 24


@dataclass
class Writer:
    """The steps of one synthesis as they are written; ``pictures``: kinds of diagrams behind a step by its number."""

    found: Synthesis
    translate: Translate
    steps: list[Step] = field(default_factory=list)
    pictures: dict[str, list[str]] = field(default_factory=dict)

    @property
    def large(self) -> bool:
        """Whether lengths are printed in m."""
        return max(self.found.best.linkage.lengths().values()) >= LARGE

    @property
    def unit(self) -> str:
        """Unit of lengths."""
        return "m" if self.large else "mm"

    @property
    def scale(self) -> float:
        """That unit per m."""
        return 1.0 if self.large else 1e3

    def step(self, title: Message) -> Step:
        """A new step with its title."""
        step = Step(str(len(self.steps) + 1), self.translate(title))
        self.steps.append(step)
        return step

    def picture(self, kind: str) -> None:
        """A diagram of the result behind the step that is being written."""
        self.pictures.setdefault(self.steps[-1].number, []).append(kind)

    # symbols ------------------------------------------------------------------------------------
    def length(self, name: str, metres: float, index: str = "") -> Term:
        """A length by its letter and index; nothing where it is zero."""
        return symbol(named(name, index), metres * self.scale) if metres else ZERO

    def angle(self, name: str, radians: float, index: str = "") -> Term:
        """An angle, in degrees."""
        return symbol(named(name, index), math.degrees(radians), degrees=True)

    def value(self, name: str, amount: float, index: str = "") -> Term:
        """A plain number."""
        return symbol(named(name, index), amount)

    # texts --------------------------------------------------------------------------------------
    def lengths(self, metres: ArrayLike) -> list[str]:
        """Lengths as a column of a table prints them, to 1/10000 mm."""
        return decimals(np.asarray(metres, float) * self.scale, 7 if self.large else 4)

    def length_text(self, metres: float) -> str:
        """A length with its unit."""
        return f"{metres * self.scale:.7g} {self.unit}"

    def over(self, text: str) -> str:
        """The head of a column of lengths: ``a / mm``."""
        return f"{text} / {self.unit}"

    def table(
        self, step: Step, title: Message, columns: Sequence[tuple[str, Sequence[str]]], align: str = ""
    ) -> None:
        """Adds a table by its columns, head and texts; a long one is shown by evenly spaced rows."""
        rows = list(zip(*(texts for _, texts in columns), strict=True))
        if len(rows) > MOST_ROWS:
            chosen = np.unique(np.linspace(0, len(rows) - 1, MOST_ROWS).round().astype(int))
            rows = [rows[i] for i in chosen]
        heads = tuple(head for head, _ in columns)
        step.items.append(Tabulated(self.translate(title), heads, tuple(rows), align or ">" * len(heads)))


def named(name: str, index: str = "") -> str:
    """A symbol with its index."""
    return f"{name}_{index}" if index else name


def decimals(values: ArrayLike, places: int) -> list[str]:
    """Numbers with so many decimals, zero without a sign."""
    return [fixed(float(value), places, "-") for value in np.atleast_1d(values)]


def degrees(radians: ArrayLike, places: int = 4) -> list[str]:
    """Angles in degrees."""
    return decimals(np.degrees(np.asarray(radians, float)), places)


def small(values: ArrayLike, size: float = 1.0) -> list[str]:
    """Deviations with four digits; zero where they are rounding of ``size``."""
    numbers = np.atleast_1d(np.asarray(values, float))
    return ["0" if abs(value) <= ROUNDING * size else f"{value:.4g}" for value in numbers]


def numbers(count: int) -> list[str]:
    """1 … count."""
    return [str(i + 1) for i in range(count)]


def matrix(values: ArrayLike, places: int = 6) -> Entries:
    """A matrix of numbers; a vector is a column."""
    rows = np.asarray(values, float)
    rows = rows[:, None] if rows.ndim == 1 else rows
    return Entries(tuple(tuple(decimals(row, places)) for row in rows))


def product(step: Step, *parts: Entries | str) -> None:
    """Adds an equation of matrices."""
    step.items.append(side_by_side(parts))


def four_bar_lengths(w: Writer, each: Candidate) -> tuple[Term, Term, Term, Term]:
    """Symbols of input, coupler, output and frame of a four-bar: a, b, c, d."""
    points = each.linkage.points
    ends = (("O1", "A"), ("A", "B"), ("O2", "B"), ("O1", "O2"))
    a, b, c, d = (
        w.length(name, abs(points[last] - points[first])) for name, (first, last) in zip("abcd", ends, strict=True)
    )
    return a, b, c, d


def examine(w: Writer, each: Candidate) -> None:
    """The step that examines a four-bar: Grashof, transmission angle, and the branch at its positions."""
    step = w.step(_("Grashof's condition, transmission angle and branch"))
    sides = four_bar_lengths(w, each)
    grashof(w, step, sides, each)
    if each.turns:
        transmission(w, step, sides)
    else:
        angle = f"{math.degrees(each.transmission_angle):.2f}"
        step.note(
            w.translate(
                _(
                    "The input does not turn fully; between its first and its last position the "
                    "transmission angle never falls below {angle}°.",
                    angle=angle,
                )
            )
        )
    if len(each.positions.get("A", ())) > 1:
        branches(w, step, each)


def grashof(w: Writer, step: Step, sides: tuple[Term, ...], each: Candidate) -> None:
    """Sum of the shortest and the longest link against that of the others."""
    low, *middle, high = sorted(sides, key=lambda term: term.amount)
    step.note(w.translate(_("Shortest and longest link, and the other two (a input, b coupler, c output, d frame):")))
    for index, (first, second) in enumerate(((low, high), tuple(middle)), 1):
        total = first + second
        step.find(w.length("S", total.value / w.scale, str(index)), total, w.unit)
    gap = low.amount + high.amount - middle[0].amount - middle[1].amount
    kind = TYPE_NAMES[each.grashof_type]
    if abs(gap) <= 1e-12 * high.amount:
        step.note(w.translate(_("Both sums are equal: the linkage has a change point.")))
    elif gap < 0:
        step.note(
            w.translate(
                _(
                    "The first sum is smaller, and {shortest} is the shortest link: a {kind}.",
                    kind=kind,
                    shortest=low.plain,
                )
            )
        )
    else:
        step.note(w.translate(_("The first sum is larger, so no link turns fully: a {kind}.", kind=kind)))


def transmission(w: Writer, step: Step, sides: tuple[Term, ...]) -> None:
    """Transmission angles where the input lies along the frame: the smallest is one of them."""
    a, b, c, d = sides
    step.note(w.translate(_("The angle between coupler and output is extreme where the input lies along the frame:")))
    for index, diagonal in (("1", d - a), ("2", d + a)):
        cosine = (b.squared + c.squared - diagonal.squared) / (TWO * b * c)
        step.find(w.angle("μ", math.acos(max(-1.0, min(1.0, cosine.value))), index), arccosine(cosine), "°")
    found = [item.value for item in step.equations[-2:]]
    smallest = min(min(angle, 180.0 - angle) for angle in found)
    step.note(w.translate(_("Smallest transmission angle: {angle}°.", angle=f"{smallest:.2f}")))


def signed_transmission(each: Candidate) -> Floats:
    """Angle from the coupler B→A to the output B→O2 at every position, rad, its sign that of the branch."""
    a, b, o2 = each.positions["A"], each.positions["B"], each.linkage.points["O2"]
    return np.asarray(np.angle((o2 - b) / (a - b)))


def _one_way(angle: Floats) -> Floats:
    """Angles without jumps, in the direction in which they come within one turn where there is one, rad."""
    for sign in (1.0, -1.0):
        steps = np.mod(sign * np.diff(angle) + 1e-9, 2 * np.pi) - 1e-9
        if steps.sum() < 2 * np.pi:
            return np.asarray(angle[0] + sign * np.append(0.0, np.cumsum(steps)))
    return np.unwrap(angle)


def branches(w: Writer, step: Step, each: Candidate) -> None:
    """Input angle, transmission angle with its sign, and the lengths again at every position."""
    points, a = each.linkage.points, each.positions["A"]
    if "B" not in each.positions or "O2" not in points or each.linkage.guides:
        return
    o1, o2, b = points["O1"], points["O2"], each.positions["B"]
    turned = np.degrees(_one_way(np.angle(a - o1)))
    step.note(
        w.translate(
            _(
                "Input angle θ and transmission angle μ with the sign of its side; the link lengths "
                "from the coordinates:"
            )
        )
    )
    columns = [
        (w.translate(_("position")), numbers(len(a))),
        ("θ / °", decimals(turned, 4)),
        ("μ / °", degrees(signed_transmission(each))),
        (w.over("|O1A|"), w.lengths(np.abs(a - o1))),
        (w.over("|AB|"), w.lengths(np.abs(b - a))),
        (w.over("|O2B|"), w.lengths(np.abs(b - o2))),
    ]
    w.table(step, _("Transmission angle with its sign, and link lengths in every position"), columns)
    step.note(
        w.translate(
            _("μ keeps its sign and θ runs one way: all positions lie on one branch, in their order.")
            if not each.defects
            else _("The positions do not lie on one branch in their order: see the defects of the candidates.")
        )
    )


def coordinates(w: Writer, each: Candidate, names: Iterable[str]) -> list[tuple[str, list[str]]]:
    """Columns with the coordinates of moving points at every position."""
    columns = []
    for name in names:
        places: Complexes = each.positions[name]
        columns += [(w.over(f"x_{name}"), w.lengths(places.real)), (w.over(f"y_{name}"), w.lengths(places.imag))]
    return columns
