"""Objectives that are summed over the positions: terms, and groups of terms with a common factor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from linkwright.engine.trace import Scalar, Trace

TermKind = Literal["sum", "mean", "rms", "max", "min"]
EXTREMES = ("max", "min")


@dataclass(frozen=True, slots=True)
class Term:
    """A part of an objective: ``weight`` times a summary of an output over the valid positions.

    ``rms``: root of the mean square; ``max``, ``min``: extremes.
    """

    output: str
    kind: TermKind = "sum"
    weight: float = 1.0


@dataclass(frozen=True, slots=True)
class Group:
    """Terms whose adjoints share one factor, known after the last position.

    ``seeded``: the weights of the positions are fields ``seed:output``.
    """

    number: int
    terms: tuple[Term, ...]
    kind: TermKind
    seeded: bool = False

    @property
    def part(self) -> str:
        """The output that is summed for the group's value."""
        return f"part:{self.number}"

    def adjoint(self, index: int) -> str:
        """The output that is summed for a boundary line's adjoint."""
        return f"adjoint:{self.number}:{index}"

    def at_position(self, t: Trace, values: Sequence[Scalar]) -> Scalar:
        """What one position adds: the weighted values, or the square of the value."""
        if self.kind == "rms":
            return t.mul(values[0], values[0])
        total: Scalar = 0.0
        for term, value in zip(self.terms, values, strict=True):
            total = t.add(total, t.mul(self.seed(t, term, value), value))
        return total

    def seed(self, t: Trace, term: Term, value: Scalar) -> Scalar:
        """Adjoint of a term's output at one position, without the common factor."""
        if self.seeded:
            return t.field_input(f"seed:{term.output}")
        return value if self.kind == "rms" else term.weight

    def after(self, t: Trace, total: Scalar, count: Scalar) -> tuple[Scalar, Scalar]:
        """The group's value, and the common factor of its adjoints."""
        if self.kind == "sum":
            return total, 1.0
        if self.kind == "mean":
            return t.div(total, count), t.div(1.0, count)
        root = t.function("sqrt", t.div(total, count))
        weight = self.terms[0].weight
        return t.mul(weight, root), t.div(weight, t.mul(count, root))


def groups_of(terms: Sequence[Term]) -> list[Group]:
    """Sums together, means together, every root mean square for itself; extremes left out.

    Raises ValueError for unknown kinds, and where there is no term.
    """
    kinds = get_args(TermKind)
    unknown = sorted({t.kind for t in terms} - set(kinds))
    if unknown or not terms:
        raise ValueError(f"an objective has terms of the kinds {', '.join(kinds)}, not {unknown}")
    parted: list[tuple[tuple[Term, ...], TermKind]] = []
    linear: tuple[TermKind, ...] = ("sum", "mean")
    for kind in linear:
        same = tuple(t for t in terms if t.kind == kind)
        if same:
            parted.append((same, kind))
    parted += [((t,), "rms") for t in terms if t.kind == "rms"]
    return [Group(number, same, kind) for number, (same, kind) in enumerate(parted)]
