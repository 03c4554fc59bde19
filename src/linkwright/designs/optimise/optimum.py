"""What an optimisation gives: designs, their metrics next to those of the start, model files, and tables of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.data import Frozen
from linkwright.core.quantity import in_kind, number, unit_of_kind, with_unit, written
from linkwright.core.table import Cell, Table, Tabular
from linkwright.designs.checkpoints import RESUME
from linkwright.designs.criteria import Criterion
from linkwright.designs.optimise.problem import Problem
from linkwright.designs.varied_dimensions import changed_text
from linkwright.errors import LinkwrightError, speaker
from linkwright.files.write import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, Translate, _


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


#: Designs of a front that are listed.
LISTED = 24


def tables(found: Optimum, language: str = "en") -> tuple[Table, ...]:
    """The best design next to the start, the front, and notes."""
    name = found.problem.mechanism.name
    best = comparison(found, found.best, language)
    title = _("{name}: {goals}", name=name, goals=_goals(found, language))
    front = [_front(found, language)] if len(found.problem.goals) > 1 else []
    return replace(best, title=title), *front, Table(notes=tuple(_notes(found)))


def _notes(found: Optimum) -> Iterator[str]:
    """What to know about the search."""
    yield _(
        "{evaluations} designs judged in {generations} generations; every design passes the "
        "full cycle with the start's assembly",
        evaluations=found.evaluations,
        generations=found.generations,
    )
    moved = any(each.choices is None for each in found.problem.variables)
    if moved and found.exact:
        yield _("The last steps used exact gradients.")
    elif moved and not found.problem.robust:
        yield _(
            "This machine's designs go one after the other, and the last steps used "
            "differences: slower, and less exact."
        )
    if found.best.worst:
        yield _("At the worst within the tolerances: {numbers}.", numbers=", ".join(_worst(found)))
    if found.best.made is not None:
        yield _(
            "{share} % of the machines made within the tolerances meet all demands (512 samples).",
            share=f"{100 * found.best.made:.1f}",
        )
    for each in found.without_effect:
        yield _(
            "{address} changes none of these numbers; leave it out of vary:, or ask for a number that it changes.",
            address=each,
        )
    if found.interrupted:
        yield RESUME.format(path=found.state)


def _goals(found: Optimum, language: str) -> str:
    words = {1.0: _("minimum {number}"), -1.0: _("maximum {number}")}
    texts = (
        words[goal.sign].format(number=label(found, goal.text, language)).translate(language)
        for goal in found.problem.goals
    )
    return _("; ").translate(language).join(texts)


def label(found: Optimum, text: str, language: str) -> str:
    """A number in words; expressions and summaries as they are written."""
    if text in found.problem.define:
        return text
    kinds = {kind: name for name, kind in units.DIMENSIONS.items()}
    return Criterion(text).label(language, kinds.get(found.kinds[text], ""))


def comparison(found: Optimum, choice: Choice, language: str) -> Table:
    """A row for every variable and number: name, start, design, change, bounds."""
    tell = speaker(language)
    head = (_("number"), _("start"), _("found"), _("change"), _("bounds"))
    rows: list[list[str]] = []
    for variable, was in zip(found.problem.variables, found.problem.start, strict=True):
        now = choice.values[variable.address]
        bounds = "..".join(written(each, variable.unit, bare=True) for each in (variable.low, variable.high))
        shown = [variable.shown(value) for value in (was, now)]
        rows.append([variable.address, *shown, _change(was, now), bounds])
    for text, now in choice.numbers.items():
        was = found.start[text]
        shown = [in_kind(value, found.kinds[text]) for value in (was, now)]
        name = label(found, text, language)
        rows.append([name, *shown, _change(was, now), _limits(found, choice, text, tell)])
    return Table(head, rows, "<>>><")


def _limits(found: Optimum, choice: Choice, text: str, tell: Translate) -> str:
    goals = {goal.text: goal.sign for goal in found.problem.goals}
    texts = [tell(_("minimized") if goals[text] > 0 else _("maximized"))] if text in goals else []
    if text in found.limits:
        texts.append(_between(found, text)[0])
    if text in choice.missed:
        texts.append(tell(_("missed")))
    return ", ".join(texts)


def _change(was: float, now: float) -> str:
    if not math.isfinite(was) or was == 0:
        return "–"
    return f"{100 * (now - was) / abs(was):+.2f} %"


def _front(found: Optimum, language: str) -> Table:
    texts = [goal.text for goal in found.problem.goals]
    addresses = [variable.address for variable in found.problem.variables]
    head = ["", *(label(found, text, language) for text in texts), *addresses]
    rows: list[list[Cell]] = []
    count = len(found)
    listed = {round(k * (count - 1) / max(1, LISTED - 1)) for k in range(LISTED)} if count > LISTED else None
    for index, choice in enumerate(found.choices, 1):
        if listed is not None and index - 1 not in listed:
            continue
        cells = [in_kind(choice.numbers[text], found.kinds[text]) for text in texts]
        cells += [each.shown(choice.values[each.address]) for each in found.problem.variables]
        rows.append([index, *cells])
    title = _(
        "Designs on the front: {count}, none beaten by another in all objectives; "
        "hypervolume {hypervolume} of the box to the worst values",
        count=count,
        hypervolume=f"{found.hypervolume or 0.0:.4f}",
    )
    return Table(head, rows, ">" * len(head), title)


def _worst(found: Optimum) -> list[str]:
    """What the numbers of the first design come to at the worst within the tolerances."""
    texts = []
    for text, ends in found.best.worst.items():
        unit, factor = unit_of_kind(found.kinds[text])
        texts.append(f"{text} {with_unit('..'.join(number(end * factor) for end in sorted(ends)), unit)}")
    return texts


def missing(found: Optimum) -> list[str]:
    """The demands that the first design misses, with what is demanded and what it has."""
    texts = []
    for text in found.best.missed:
        ends = sorted(found.best.worst.get(text, (found.best.numbers[text],)))
        has = "..".join(in_kind(end, found.kinds[text]) for end in ends)
        texts.append(f"{text} {with_unit(*_between(found, text))} ({has})")
    return texts


def _between(found: Optimum, text: str) -> tuple[str, str]:
    """The limits of a number, and their unit."""
    unit, factor = unit_of_kind(found.kinds[text])
    low, high = (number(each * factor) for each in found.limits[text])
    if "∞" in low or "∞" in high:
        return (f"≤ {high}" if "∞" in low else f"≥ {low}"), unit
    return f"{low}..{high}", unit
