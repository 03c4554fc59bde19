"""Alternatives side by side: metrics, a ranking with its reasons, curves, a written evaluation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from linkwright.analysis.base import MetricValue
from linkwright.analysis.by_name import ask
from linkwright.core.arguments import STEPS, real, require
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.data import Frozen
from linkwright.core.progress import current_progress
from linkwright.core.table import Table, Tabular, unused
from linkwright.designs.alternatives import Alternative, alternatives
from linkwright.designs.criteria import USUAL, Criterion, criteria
from linkwright.errors import LinkwrightError, RequestError, with_remedy
from linkwright.kinematics.motion import PositionError
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.units import si_unit
from linkwright.words import _

#: Values of a criterion that differ by less than this share are equal.
SAME = 1e-9


@dataclass(frozen=True)
class Row:
    """One criterion with the value of every alternative; None where it does not apply."""

    criterion: Criterion
    values: tuple[MetricValue | None, ...]
    weight: float

    @property
    def dimension(self) -> str:
        """Name of the values' dimension."""
        return next((each.dimension for each in self.values if each is not None), "dimensionless")

    @property
    def best(self) -> tuple[int, ...]:
        """Numbers of the best alternatives; empty where no direction is better, or one cannot be compared."""
        if self.criterion.better is None or not self.comparable:
            return ()
        sizes = [abs(each.value) for each in self.values if each is not None]
        goal = max(sizes) if self.criterion.better == "higher" else min(sizes)
        same = SAME * max((size for size in sizes if math.isfinite(size)), default=0.0)
        best = tuple(i for i, size in enumerate(sizes) if size == goal or abs(size - goal) <= same)
        return () if len(best) == len(sizes) else best

    @property
    def comparable(self) -> bool:
        """Whether every alternative has a value of the same dimension."""
        return all(each is not None for each in self.values) and len({v.dimension for v in self.values if v}) == 1

    def score(self, index: int) -> float:
        """1 for the best, else how near the value comes to it: best/value where lower is better, or the inverse."""
        sizes = [abs(each.value) for each in self.values if each is not None]
        mine, best = sizes[index], max(sizes) if self.criterion.better == "higher" else min(sizes)
        if mine == best:
            return 1.0
        return mine / best if self.criterion.better == "higher" else best / mine


@dataclass(frozen=True)
class Rank:
    """An alternative's place: ``score`` from 0 to 1, the weighted mean of how near it comes to the best."""

    place: int
    index: int
    label: str
    score: float


@dataclass(eq=False)
class Comparison(PlotMixin, Tabular, Frozen):
    """Alternatives side by side.

    ``rows``: criteria with values; ``ranking``: best first; ``curves``: data to overlay. ``text(language)`` is the
    table with ranking and evaluation, ``evaluation(language)`` the sentences alone.
    """

    row_names: ClassVar[str] = "metric"
    alternatives: tuple[Alternative, ...]
    rows: tuple[Row, ...]
    fluctuation: float

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of the alternatives."""
        return tuple(each.label for each in self.alternatives)

    @property
    def notes(self) -> tuple[str, ...]:
        """What could not be found, and why."""
        from linkwright.designs.alternatives import unlike

        own = (note for each in self.alternatives for note in each.notes)
        return (*unlike(self.alternatives), *dict.fromkeys(own))

    @property
    def ranking(self) -> tuple[Rank, ...]:
        """The alternatives, best first; equal scores in the order they were given."""
        judged = self.judged
        total = sum(row.weight for row in judged)
        scores = [
            sum(row.weight * row.score(i) for row in judged) / total if total else 1.0
            for i in range(len(self.alternatives))
        ]
        order = sorted(range(len(scores)), key=lambda i: -scores[i])
        return tuple(Rank(place, i, self.labels[i], scores[i]) for place, i in enumerate(order, 1))

    @property
    def judged(self) -> tuple[Row, ...]:
        """The criteria that enter the ranking."""
        return tuple(row for row in self.rows if row.criterion.better and row.comparable and row.weight > 0.0)

    @property
    def curves(self) -> tuple[Overlay, ...]:
        """Curves to overlay: output and its rates, pivot reaction, input torque."""
        return overlays(self.alternatives)

    def value(self, metric: str, alternative: str | int) -> float:
        """SI value of a criterion; NaN where it does not apply."""
        index = alternative if isinstance(alternative, int) else self._index(alternative)
        for row in self.rows:
            if row.criterion.name == metric:
                found = row.values[index]
                return float("nan") if found is None else found.value
        raise RequestError(
            with_remedy(
                _("{metric!r} is not among the compared metrics", code="study.not_compared", metric=metric),
                offered(metric, [row.criterion.name for row in self.rows]),
            )
        )

    def columns(self) -> dict[str, Any]:
        """The criteria with SI units, and the values of every alternative; NaN where a metric does not apply."""
        names = [
            f"{row.criterion.name} [{unit}]" if (unit := si_unit(row.dimension)) else row.criterion.name
            for row in self.rows
        ]
        found = ([math.nan if each is None else each.value for each in row.values] for row in self.rows)
        columns: dict[str, Any] = {"metric": names}
        for label, values in zip(self.labels, zip(*found, strict=True), strict=True):
            columns[unused(label, columns)] = values
        return columns

    def _index(self, label: str) -> int:
        if label not in self.labels:
            raise RequestError(
                _(
                    "there is no alternative {label!r}; there is {labels}",
                    code="study.no_alternative",
                    label=label,
                    labels=tuple(map(repr, self.labels)),
                )
            )
        return self.labels.index(label)

    @attached
    def evaluation(self, language: str = "en") -> str:
        """A written evaluation, built from the numbers."""
        raise NotImplementedError

    @attached
    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The table, best values marked, the ranking with reasons, and the evaluation."""
        raise NotImplementedError

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        return {
            "alternatives": [
                {"label": each.label, "output": str(each.output), "pivot": each.pivot[0]}
                for each in self.alternatives
            ],
            "metrics": [
                {
                    "name": row.criterion.name,
                    "unit": si_unit(row.dimension),
                    "better": row.criterion.better,
                    "weight": row.weight,
                    "values": [None if each is None else each.value for each in row.values],
                    "at": [None if each is None else each.at for each in row.values],
                    "best": [self.labels[i] for i in row.best],
                }
                for row in self.rows
            ],
            "ranking": [{"place": r.place, "label": r.label, "score": r.score} for r in self.ranking],
            "evaluation": {language: self.evaluation(language) for language in ("en", "zh")},
            "notes": list(self.notes),
        }

    def __repr__(self) -> str:
        order = " > ".join(f"{rank.label} ({rank.score:.2f})" for rank in self.ranking)
        return f"Comparison({len(self.rows)} metrics: {order})"


def compare(
    machines: Sequence[Mechanism | str | Path],
    *,
    metrics: Iterable[str] | str | None = None,
    weights: Mapping[str, float] | None = None,
    output: str | Mapping[str, str] | Sequence[str] | None = None,
    fluctuation: float = FLUCTUATION,
    steps: int = STEPS,
) -> Comparison:
    """Compares alternative machines by the motion of an output that they share and by their metrics.

    Args:
        machines: two or more mechanisms, paths or gallery names.
        metrics: registered metrics, with a subject if wanted (``peak_reaction O5``); ``travel``,
            ``output_velocity``, ``output_acceleration``, ``pivot_reaction`` (of the output's pivot), ``flywheel``;
            summaries of outputs (``driver.effort rms``). None: the usual ones that apply.
        weights: of metrics in the ranking, default 1; 0 leaves one out.
        output: the link or guide that does the work, by one name for all, or by the label of each alternative.
            None: the last one solved of those whose name all share.
        fluctuation: coefficient of speed fluctuation δ for the flywheels.
        steps: positions over the cycle.

    Returns:
        The comparison. A score is the weighted mean over the metrics that have a better direction of best/value (or
        value/best where higher is better).

    Raises:
        LinkwrightError: an unknown metric or weight (nearest ones offered), alternatives without a shared output.
        PositionError: an alternative cannot pass its cycle.
    """
    found = alternatives(machines, output, steps, fluctuation)
    asked = criteria(USUAL if metrics is None else metrics)
    if metrics is None:
        asked = [each for each in asked if not each.forces or any(a.loaded for a in found)]
    weighting = _weights(weights or {}, asked)
    for alternative in found:
        alternative.analysis.ask(alternative.force_summaries)
        ask((each.name for each in asked), alternative.analysis, alternative.asked)
    rows = []
    progress = current_progress()
    for done, each in enumerate(asked):
        if progress is not None:
            progress(done, len(asked))
        values = tuple(_measured(each, alternative) for alternative in found)
        if metrics is None and all(value is None for value in values):
            continue
        if metrics is not None and all(value is None for value in values):
            known: object = [note for a in found for note in a.notes] or _("leave it out", code="study.leave_out")
            raise RequestError(
                _(
                    "{name!r} does not apply to any of the alternatives: {known}",
                    code="study.applies_to_none",
                    name=each.name,
                    known=known,
                )
            )
        rows.append(Row(each, values, weighting.get(each.name, 1.0)))
    if progress is not None:
        progress(len(asked), len(asked))
    return Comparison(tuple(found), tuple(rows), fluctuation)


def _measured(asked: Criterion, alternative: Alternative) -> MetricValue | None:
    """The value of an alternative; None, with the reason among its notes, where it has none."""
    try:
        return asked.measure(alternative)
    except PositionError:
        raise
    except LinkwrightError as error:
        alternative.notes.append(error.sentence)
        return None


def _weights(weights: Mapping[str, float], asked: Sequence[Criterion]) -> Mapping[str, float]:
    """The weights, checked."""
    require(weights, Mapping)
    known = {each.name: each for each in asked}
    for name, weight in weights.items():
        if name not in known:
            hint = offered(name, known, _("compared are {names}"))
            raise RequestError(
                _(
                    "the weight of {name!r} belongs to no compared metric; {hint}",
                    code="study.stray_weight",
                    name=name,
                    hint=hint,
                )
            )
        if not real(f"weights[{name!r}]", weight) >= 0.0 or weight == float("inf"):
            raise RequestError(
                _(
                    "the weight of {name!r} is {weight}; give a number that is not negative",
                    code="study.bad_weight_value",
                    name=name,
                    weight=weight,
                )
            )
        if known[name].better is None and weight > 0.0:
            raise RequestError(
                _(
                    "{name!r} has no better direction, so it cannot be weighted; leave its weight out",
                    code="study.no_direction",
                    name=name,
                )
            )
    judged = [each.name for each in asked if each.better]
    if judged and all(weights.get(name, 1.0) == 0.0 for name in judged):
        raise RequestError(_("all weights are zero; give one metric a weight above zero", code="study.all_zero"))
    return weights


@dataclass(frozen=True)
class Overlay:
    """One quantity of all alternatives: ``name`` (a key of the labels of curves), its dimension; per label
    the input passed since the cycle's begin (n,) (rad or m, in its direction of motion) and the values (n,), SI.

    A hodograph has the two components of a force instead.
    """

    name: str
    dimension: str
    lines: Mapping[str, tuple[Floats, Floats]]


def overlays(alternatives: Sequence[Alternative]) -> tuple[Overlay, ...]:
    """Output, its rates, pivot reaction with its hodograph, input torque."""
    found = [_motion(alternatives, name, place) for place, name in enumerate(("travel", "velocity", "acceleration"))]
    if any(each.loaded for each in alternatives):
        sizes = {a.label: (_passed(a), np.hypot(*a.pivot_force.T)) for a in alternatives}
        hodograph = {a.label: (a.pivot_force[:, 0], a.pivot_force[:, 1]) for a in alternatives}
        torque = {a.label: (_passed(a), a.forces.input_torque) for a in alternatives}
        found += [
            Overlay("pivot_reaction", "force", sizes),
            Overlay("hodograph", "force", hodograph),
            Overlay("input_torque", "torque", torque),
        ]
    return tuple(found)


def _motion(alternatives: Sequence[Alternative], name: str, place: int) -> Overlay:
    turning = all(each.output.kind == "angle" for each in alternatives)
    kinds = (
        ("angle", "angular_velocity", "angular_acceleration") if turning else ("length", "velocity", "acceleration")
    )
    return Overlay(name, kinds[place], {a.label: (_passed(a), a.travel()[place]) for a in alternatives})


def _passed(alternative: Alternative) -> Floats:
    """How far the input has gone since the cycle began."""
    q = alternative.motion.input
    return np.asarray(np.abs(q - q[0]))


def overlay_columns(overlays: Iterable[Overlay]) -> dict[str, Floats]:
    """Curves as columns by name with unit, SI."""
    columns: dict[str, Floats] = {}
    for overlay in overlays:
        unit = si_unit(overlay.dimension)
        for label, (x, y) in overlay.lines.items():
            if overlay.name == "hodograph":
                columns[f"{label}: pivot_reaction.x [{unit}]"] = x
                columns[f"{label}: pivot_reaction.y [{unit}]"] = y
                continue
            columns.setdefault(f"{label}: input", x)
            columns[f"{label}: {overlay.name} [{unit}]"] = y
    return columns


def overlay_data(overlays: Iterable[Overlay]) -> list[dict[str, Any]]:
    """Curves as plain data."""
    return [
        {
            "name": overlay.name,
            "unit": si_unit(overlay.dimension),
            "lines": {label: {"x": x.tolist(), "y": y.tolist()} for label, (x, y) in overlay.lines.items()},
        }
        for overlay in overlays
    ]
