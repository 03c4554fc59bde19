"""What an optimisation gives: designs, their metrics next to those of the start, and the model files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.read_only import Frozen
from linkwright.core.table import Table, Tabular
from linkwright.designs.changed_text import changed_text
from linkwright.designs.optimise.problem import Problem
from linkwright.errors import LinkwrightError
from linkwright.files.document import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message


@dataclass(frozen=True)
class Choice:
    """One design: ``values`` of the variables, ``numbers`` of goals and demands, SI; ``missed``: demands that it
    does not meet; ``made``: share of the machines within the tolerances that meet all, None where none are given;
    ``worst``: what a number comes to at the worst within the tolerances (upwards, downwards, or both, as its demand
    has it), where this was asked for."""

    values: Mapping[str, float]
    numbers: Mapping[str, float]
    missed: tuple[str, ...] = ()
    made: float | None = None
    worst: Mapping[str, tuple[float, ...]] = field(default_factory=dict)


@dataclass(eq=False)
class Optimum(PlotMixin, Tabular, Frozen):
    """The designs that an optimisation found: one, or the front of several objectives in order of the first.

    Args:
        problem: what was asked.
        choices: the designs; ``best`` is the first.
        start: numbers of the machine as it was.
        limits: demands as (low, high), SI.
        kinds: dimension of every number.
        evaluations, generations: of the search.
        history: smallest first objective after each generation (infinite: none was feasible yet).
        hypervolume: share of the box between the front's best values and its worst (or the start's) that the front
            beats; None for one objective.
        exact: gradients were exact.
        state: the file from which a search goes on that was stopped before its end; None: it came to its end.
        without_effect: variables that change none of the numbers.
    """

    problem: Problem
    choices: tuple[Choice, ...]
    start: Mapping[str, float]
    limits: Mapping[str, tuple[float, float]]
    kinds: Mapping[str, units.Dimension]
    evaluations: int
    generations: int
    history: tuple[float, ...]
    hypervolume: float | None = None
    exact: bool = True
    state: Path | None = None
    without_effect: tuple[str, ...] = ()
    document: Document | None = field(default=None, repr=False)

    @property
    def best(self) -> Choice:
        """The first design."""
        return self.choices[0]

    @property
    def interrupted(self) -> bool:
        """Whether the search was stopped before its end."""
        return self.state is not None

    def __iter__(self) -> Iterator[Choice]:
        return iter(self.choices)

    def __len__(self) -> int:
        return len(self.choices)

    def mechanism(self, index: int = 0) -> Mechanism:
        """One of the designs as a mechanism."""
        return self.problem.mechanism.with_dimensions(dict(self.choices[index].values))

    def model_text(self, index: int = 0) -> str:
        """The model file with the design's values in it; all else stays as it was written, comments too."""
        if self.document is None:
            from linkwright.files.write import dump

            return dump(self.mechanism(index))
        return changed_text(self.document, self.choices[index].values)

    def write(self, path: str | Path, index: int = 0, *, force: bool = False) -> Path:
        """Writes the model file of one design, atomically.

        Raises LinkwrightError where it cannot be written, and for a file that is there already unless ``force``.
        """
        from linkwright.filesystem import atomic_write

        return atomic_write(path, self.model_text(index).encode(), force=force)

    @attached
    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """Variables and metrics next to those of the start, the front of several objectives, and notes."""
        raise NotImplementedError

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        addresses = [each.address for each in self.problem.variables]
        return {
            "name": self.problem.mechanism.name,
            "objectives": [{"number": each.text, "sign": each.sign} for each in self.problem.goals],
            "demands": {text: list(limits) for text, limits in self.limits.items()},
            "units": {
                **{each.address: each.si for each in self.problem.variables},
                **{text: units.si_symbol(kind) for text, kind in self.kinds.items()},
            },
            "start": {
                "values": dict(zip(addresses, self.problem.start.tolist(), strict=True)),
                "numbers": dict(self.start),
            },
            "designs": [
                {
                    "values": dict(each.values),
                    "numbers": dict(each.numbers),
                    "missed": list(each.missed),
                    "made": each.made,
                    "worst": {text: list(ends) for text, ends in each.worst.items()},
                }
                for each in self.choices
            ],
            "hypervolume": self.hypervolume,
            "evaluations": self.evaluations,
            "generations": self.generations,
            "exact_gradients": self.exact,
            "interrupted": self.interrupted,
            "state": None if self.state is None else str(self.state),
            "without_effect": list(self.without_effect),
        }

    def __repr__(self) -> str:
        goals = ", ".join(each.text for each in self.problem.goals)
        return f"Optimum({self.problem.mechanism.name!r}: {len(self)} designs for {goals})"


class OptimizeError(LinkwrightError):
    """Demands that cannot be met together: which fail, and the ``nearest`` design."""

    def __init__(self, sentence: Message, nearest: Optimum) -> None:
        self.nearest = nearest
        super().__init__(sentence)

    def __reduce__(self) -> tuple[type[OptimizeError], tuple[Any, ...]]:
        return OptimizeError, (self.args[0], self.nearest)


def hypervolume(goals: Floats, worst: Floats) -> float:
    """Volume that points (N, m) beat below a point (m,), as a share of the box from their minimum values to it."""
    low = np.minimum(goals.min(axis=0), worst)
    size = worst - low
    if not (size > 0).all():
        return 0.0
    return _volume((goals - low) / size)


def _volume(points: Floats) -> float:
    """Volume below 1 in all coordinates that points from 0 beat, slice by slice along the last coordinate."""
    points = points[(points < 1).all(axis=1)]
    if not len(points):
        return 0.0
    if points.shape[1] == 1:
        return 1.0 - float(points.min())
    order = points[np.argsort(points[:, -1], kind="stable")]
    edges = np.append(order[:, -1], 1.0)
    return float(
        sum(
            (edges[k + 1] - edges[k]) * _volume(order[: k + 1, :-1])
            for k in range(len(order))
            if edges[k + 1] > edges[k]
        )
    )
