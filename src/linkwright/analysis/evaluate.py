"""All metrics of a result, or those asked for; of a model: of its motion, and of its forces where they are needed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Literal

from linkwright.analysis.analysis import Analysis, Result
from linkwright.analysis.base import METRICS, Metric, MetricValue
from linkwright.analysis.table import MetricsTable
from linkwright.applied_loads.strokes import NEAR
from linkwright.core.arguments import one_or_more, require
from linkwright.core.arrays import Flags
from linkwright.core.quantity import ZERO_TOLERANCES
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.cycle import MOST
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import ROUNDING, Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


def metrics(result: Result, names: Iterable[str] | str | None = None) -> MetricsTable:
    """Design numbers of a motion, or of forces (which have those of the motion as well).

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
                "the cycle of {name!r} has {turns} turns, and design numbers are found over at most "
                "{most}; leave turns or duration out (the cycle then lasts until all is back), or "
                "give fewer: cycle: {{turns: {most}}}",
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
