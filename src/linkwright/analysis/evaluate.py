"""All metrics of a result or a model, or those asked for, and their table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import TYPE_CHECKING, Any, Literal

from linkwright.analysis.analysis import Analysis, Result
from linkwright.analysis.base import CELLS, METRICS, REMARK, Metric, MetricValue
from linkwright.applied_loads.strokes import NEAR
from linkwright.core.arguments import one_or_more, require
from linkwright.core.arrays import Flags
from linkwright.core.attached import PlotMixin
from linkwright.core.quantity import ZERO_TOLERANCES
from linkwright.core.table import Amount, Cell, Table, Tabular, dataframe
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.cycle import MOST
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import ROUNDING, Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import Message, _
from linkwright.words.message import in_language, in_words, together

if TYPE_CHECKING:
    import pandas


def metrics(result: Result, names: Iterable[str] | str | None = None) -> MetricsTable:
    """Metrics of a motion, or of forces (which have those of the motion as well).

    Args:
        result: from ``solve_motion`` or ``solve_forces``, or its analysis.
        names: which ones; None for all that apply. Asked for by name, a number that does not apply is an error.

    Returns:
        The table; extreme values are those of the continuous cycle, refined between the solved positions wherever
        the positions follow the drivers' laws and pass no change point (``exact`` says so per value).

    Raises:
        UnknownName: there is no such number (the nearest one is offered).
        LinkwrightError: a number that was asked for by name does not apply, or the cycle has more than 1000
            turns.
    """
    if not isinstance(result, Analysis):
        require(result, Motion, Forces)
    analysis = Analysis.of(result)
    _countable(analysis.motion)
    asked = None if names is None else list(one_or_more(names))
    rows: list[MetricValue] = []
    skipped: list[str] = []
    chosen = {name: metric() for name, metric in _chosen(asked).items()}
    applying = set()
    for name, metric in sorted(chosen.items(), key=lambda each: each[1].judged_last):
        if metric.applies(analysis):
            applying.add(name)
            if not metric.own_values:
                metric.asked(analysis)
    for name, metric in chosen.items():
        if name in applying:
            rows += metric.evaluate(analysis)
        elif asked is None:
            skipped.append(name)
        else:
            raise RequestError(_refusal(name, analysis))
    shown = _without_rounding(rows, _roundings(analysis))
    motion = result if isinstance(result, Motion) else result.motion
    notes = _notes(analysis, motion.ok)
    return MetricsTable(analysis.motion.mechanism.name, shown, skipped, notes)


def inapplicable(analysis: Analysis, names: Iterable[str]) -> dict[str, str]:
    """Those of some numbers that do not apply, with why."""
    chosen = {name: metric() for name, metric in _chosen(list(names)).items()}
    return {name: _refusal(name, analysis) for name, metric in chosen.items() if not metric.applies(analysis)}


def _countable(motion: Motion) -> None:
    """Refuses cycles of so many turns that their integrals and extremes could not be resolved."""
    turns_set = motion.positions.cycle and motion.mechanism.cycle is not None
    if turns_set and motion.positions.turns > MOST * (1.0 + NEAR):
        turns = f"{motion.positions.turns:.6g}"
        raise RequestError(
            _(
                "the cycle of {name!r} has {turns} turns, and metrics are found over at most {most}; "
                "leave turns or duration out (the cycle then lasts until all is back), or give fewer: "
                "cycle: {{turns: {most}}}",
                code="metrics.too_many_turns",
                name=motion.mechanism.name,
                turns=turns,
                most=MOST,
            )
        )


def _notes(analysis: Analysis, ok: Flags) -> tuple[Message, ...]:
    """Notes where not all positions are reached; ``ok``: which of those that were asked for are."""
    name = analysis.motion.mechanism.name
    if not ok.any():
        return (_("{name!r} reaches none of the positions, so only numbers of its dimensions are known", name=name),)
    if not analysis.partial:
        return ()
    message = (
        _(
            "{name!r} reaches {reached} of {count} positions; numbers of the full cycle, such as means, are left out",
            code="metrics.part_reached",
        )
        if analysis.closed
        else _(
            "{name!r} reaches {reached} of {count} positions; means are those of the time until "
            "it comes out of reach, and numbers that grow without bound there have none",
            code="metrics.part_of_way_reached",
        )
    )
    return (message.format(name=name, reached=int(ok.sum()), count=len(ok)),)


def _roundings(analysis: Analysis) -> dict[str, float]:
    """Sizes, SI, of torques, powers and works that are negligible compared with the joint forces of a machine, by
    dimension."""
    if analysis.forces is None or analysis.partial:
        return {}
    positions, size = analysis.motion.positions, analysis.motion.mechanism.size
    paces = (positions.paces[name] * (size if turns else 1.0) for name, turns in positions.rotary.items())
    force = analysis.forces.rounding
    return {"torque": force * size, "energy": force * size, "power": force * max(paces, default=0.0)}


def _without_rounding(rows: Sequence[MetricValue], negligible: Mapping[str, float]) -> list[MetricValue]:
    """The values, zero and without a place where one is negligible compared with the largest of its dimension, or
    smaller than ``negligible``.

    Angles and lengths, which may be places, stay, and are shown as zero below ``ZERO_TOLERANCES``; so do ratios,
    of which a zero has its place.
    """
    largest: dict[str, float] = {}
    for row in rows:
        if row.dimension not in (*ZERO_TOLERANCES, "dimensionless") and isfinite(row.value):
            largest[row.dimension] = max(largest.get(row.dimension, 0.0), abs(row.value))
    return [
        replace(row, value=0.0, at=None)
        if abs(row.value) <= max(ROUNDING * largest.get(row.dimension, -1.0), negligible.get(row.dimension, -1.0))
        else row
        for row in rows
    ]


def _chosen(asked: Iterable[str] | None) -> dict[str, type[Metric]]:
    """What is evaluated; when nobody says what, the most important first."""
    if asked is not None:
        return {name: METRICS[name] for name in asked}
    usual = ((name, metric) for name, metric in METRICS.items() if not metric.on_request)
    return dict(sorted(usual, key=lambda each: each[1].rank))


def unloaded(mechanism: Mechanism, names: Iterable[str]) -> Message | None:
    """That some of these numbers, each a metric with its subject, need joint forces that the machine has not."""
    metrics = {name: METRICS.get(name.split(" ")[0]) for name in names}
    idle = tuple(name for name, metric in metrics.items() if metric is not None and metric.needs_forces)
    if mechanism.has_loads or not idle:
        return None
    return _(
        "{names} cannot be found: the links of {title!r} have no mass and there are no "
        "loads; give masses (mass: 5 kg) or loads (loads: …)",
        code="metrics.unloaded",
        names=idle,
        title=mechanism.name,
    )


def _refusal(name: str, analysis: Analysis) -> str:
    title = analysis.motion.mechanism.name
    if METRICS[name].needs_forces and analysis.forces is None:
        return _(
            '"{name}" needs the joint forces of {title!r}; give it the result of solve_forces',
            code="metrics.needs_forces",
            name=name,
            title=title,
        )
    obstacle = METRICS[name]().obstacle(analysis)
    if obstacle is not None:
        return _("{name}: {cause}", name=name, cause=obstacle)
    return _(
        '"{name}" does not apply to {title!r}: {meaning}',
        code="metrics.does_not_apply",
        name=name,
        title=title,
        meaning=METRICS[name]().meaning_in,
    )


@dataclass(frozen=True)
class ApplicableMetrics:
    """Metrics, why some that were named do not apply, and the error where the forces could not be solved."""

    table: MetricsTable
    inapplicable: Sequence[str] = ()
    error: LinkwrightError | None = None

    def errors(self, language: str = "en") -> list[str]:
        """Everything that failed, in a language."""
        found = [in_language(each, language) for each in self.inapplicable]
        return found if self.error is None else [*found, self.error.translate(language)]


def applicable_metrics(
    mechanism: Mechanism,
    names: Sequence[str] | None,
    *,
    forces: bool | None,
    steps: int,
    failures: Literal["raise", "mark"] = "raise",
) -> ApplicableMetrics:
    """The named metrics that apply, or all; ``forces`` None: where the model has masses or loads.

    Raises RequestError where none of the named ones applies.
    """
    idle = {name: unloaded(mechanism, [name]) for name in names or () if forces is None}
    refused: dict[str, str] = {name: why for name, why in idle.items() if why is not None}
    if names and len(refused) == len({*names}):
        raise RequestError(unloaded(mechanism, names) or "")
    motion = solve_motion(mechanism, steps=steps, failures=failures)
    loaded = forces is not False and bool(forces or mechanism.has_loads)
    if names is None:
        return _all(motion, loaded)
    analysis = Analysis.of(solve_forces(motion) if loaded else motion)
    refused = inapplicable(analysis, names) | refused
    chosen = [name for name in names if name not in refused]
    if not chosen:
        raise RequestError(next(iter(refused.values())))
    return ApplicableMetrics(metrics(analysis, chosen), [*refused.values()])


def _all(motion: Motion, loaded: bool) -> ApplicableMetrics:
    """All metrics that apply, those of the motion alone where the forces fail."""
    if not loaded:
        return ApplicableMetrics(metrics(motion))
    try:
        return ApplicableMetrics(metrics(solve_forces(motion)))
    except LinkwrightError as error:
        return ApplicableMetrics(metrics(motion), error=error)


#: How many values of one number and subject tables show at most.
REPEATED = 6
COLUMNS = ("metric", "subject", "value", "unit", "at", "at_unit", "limit", "exact", "warning", "remark")


def cells_of_values(
    rows: Sequence[MetricValue], language: str
) -> Iterator[tuple[tuple[Cell, ...], MetricValue | None]]:
    """What tables write of values, each with its value; of a number that comes many times over the cycle the first,
    then how many more there are, between which values and inputs."""
    found: dict[tuple[str, str], list[MetricValue]] = {}
    for row in rows:
        found.setdefault((row.metric, row.subject), []).append(row)
    for same in found.values():
        few = len(same) if len(same) == REPEATED + 1 else REPEATED
        yield from ((row.cells(language), row) for row in same[:few])
        if rest := same[few:]:
            label, subject, value, unit, at, _unused = rest[0].cells(language)
            more = _("{subject}, {count} more", subject=subject, count=len(rest)).translate(language)
            places = [row.at for row in rest if row.at is not None]
            yield ((label, more, _between(value, [row.value for row in rest]), unit, _between(at, places), ""), None)


def _between(first: Cell, values: Sequence[float]) -> Cell:
    """The cell of the first of some values, from the smallest to the largest of them."""
    if not isinstance(first, Amount):
        return first
    found = replace(first, value=min(values), end=max(values))
    return found if len(set(found.number.split(" … "))) > 1 else replace(found, end=None)


def _remarks(row: MetricValue | None, language: str) -> str:
    """Remarks of a row, if it is that of a value; its warnings stand beneath the table, and are marked here."""
    if row is None:
        return ""
    texts = [remark.text(language) for remark in row.remarks if not remark.warning]
    mark = "!" if row.warnings else ""
    return f"{mark} {_('; ').translate(language).join(texts)}".strip()


class MetricsTable(PlotMixin, Tabular, Sequence[MetricValue]):
    """Values of metrics, in rows.

    ``table["stroke"]``: all values of one number; ``table["stroke", "guide"]``: the one of a subject;
    ``table.value("stroke")``: the governing value (the worst of its subjects where a direction is better, else the
    only or first one). ``skipped``: names that were not asked for by name and do not apply; ``notes``: sentences
    about the complete result.
    """

    def __init__(
        self, title: str, rows: Sequence[MetricValue], skipped: Sequence[str] = (), notes: Sequence[str] = ()
    ) -> None:
        self.title = title
        self.notes = tuple(notes)
        self.rows = tuple(rows)
        self.skipped = tuple(skipped)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the numbers in the table, in order."""
        return tuple(dict.fromkeys(row.metric for row in self.rows))

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences about what needs attention, each with its subject."""
        return self.warnings_in("en")

    def warnings_in(self, language: str) -> tuple[str, ...]:
        """The same in a language, closeness to a singular position first; subjects with the same remark are
        together."""
        notes = (in_language(note, language) for note in self.notes)
        subjects_by_text: dict[str, list[str]] = {}
        for row in sorted(self.rows, key=lambda row: row.metric != "singularity"):
            for remark in row.warnings:
                subjects_by_text.setdefault(remark.text(language), []).append(in_words(row.subject, language))
        about = {cause: together(tuple(dict.fromkeys(subjects))) for cause, subjects in subjects_by_text.items()}
        cells_of_values = (
            _("{name}: {cause}", name=in_language(names, language), cause=cause).translate(language)
            for cause, names in about.items()
        )
        return (*notes, *cells_of_values)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return self._of(key)
        if isinstance(key, tuple):
            return self._one(*key)
        return self.rows[key]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[MetricValue]:
        return iter(self.rows)

    def __contains__(self, key: object) -> bool:
        return key in self.names if isinstance(key, str) else key in self.rows

    def value(self, name: str, subject: str | None = None) -> float:
        """SI value of a number: of a subject, or the governing one. Raises LinkwrightError for unknown names."""
        if subject is not None:
            return self._one(name, subject).value
        values = [row.value for row in self._of(name)]
        better = METRICS[name].better
        return values[0] if better is None else min(values) if better == "higher" else max(values)

    def _of(self, name: str) -> tuple[MetricValue, ...]:
        found = tuple(row for row in self.rows if row.metric == name)
        if found:
            return found
        METRICS[name]
        raise RequestError(
            _(
                '"{name}" is not in the table: it does not apply here or was not asked for',
                code="metrics.not_in_table",
                name=name,
            )
        )

    def _one(self, name: str, subject: str) -> MetricValue:
        rows = self._of(name)
        for row in rows:
            if row.subject == subject:
                return row
        subjects = [row.subject for row in rows]
        hint = offered(subject, subjects)
        raise RequestError(
            _(
                '"{name}" has no value for "{subject}"; {hint}',
                code="metrics.no_value",
                name=name,
                subject=subject,
                hint=hint,
            )
        )

    def tables(self, language: str = "en") -> tuple[Table]:
        """The rows, limits and remarks where there are any, and the warnings."""
        if not self.rows:
            return (Table(title=self.title, notes=["", _("none of the metrics applies to this mechanism")]),)
        head = (*CELLS, REMARK)
        rows = [[*texts, _remarks(row, language)] for texts, row in cells_of_values(self.rows, language)]
        shown_columns = [i for i in range(len(head)) if i < 5 or any(row[i] for row in rows)]
        notes = [f"! {warning}" for warning in self.warnings_in(language)]
        align = "".join("<<><>><"[i] for i in shown_columns)
        cells = [[row[i] for i in shown_columns] for row in rows]
        return (Table([head[i] for i in shown_columns], cells, align, self.title, notes),)

    def data(self, language: str = "en") -> dict[str, Any]:
        """Plain data, SI, one mapping per row; remarks and warnings in a language."""
        return {
            "name": self.title,
            "metrics": [row.data(language) for row in self.rows],
            "warnings": list(self.warnings_in(language)),
            "not_applicable": list(self.skipped),
        }

    def columns(self, language: str = "en") -> dict[str, list[Any]]:
        """What is known of every value but its place, by name, SI; remarks in a language."""
        rows = [row.data(language) for row in self.rows]
        return {name: [row[name] for row in rows] for name in COLUMNS}

    def to_dataframe(self) -> pandas.DataFrame:
        """The rows as a table; needs pandas. Raises LinkwrightError without it."""
        return dataframe({**self.columns(), "place": [row.place for row in self.rows]})

    def __repr__(self) -> str:
        return f"MetricsTable({self.title!r}: {len(self.rows)} values of {', '.join(self.names)})"
