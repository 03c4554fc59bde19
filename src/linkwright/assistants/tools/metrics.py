"""Design numbers of a machine."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from linkwright.analysis.base import METRICS, MetricValue
from linkwright.analysis.evaluate import applicable_metrics
from linkwright.assistants.answers import Answer, Answered, NextAction, number
from linkwright.assistants.failures import entries, of_error, of_notes
from linkwright.assistants.tool import Desk, Model
from linkwright.core.arguments import STEPS
from linkwright.errors import Finding
from linkwright.units import si_unit
from linkwright.words import _
from linkwright.words.message import in_language

#: Numbers of one answer at most.
MOST = 80


class MetricEntry(Answered):
    """One design number."""

    metric: str = Field(description="name of the metric, such as transmission_angle, stroke, peak_input_torque")
    subject: str = Field(description="the link, joint, point or group that it is about")
    value: float | None = Field(description="in the unit; null where it is infinite or not defined")
    unit: str = Field(description="SI unit: rad, m, N, N·m, W; empty for a ratio")
    at: float | None = Field(
        description="input of the first driver where it occurs (rad or m); null: of the whole cycle"
    )
    limit: float | None = Field(description="recommended limit in the unit; null where there is none")
    warning: bool = Field(description="the remark needs attention")
    remark: str = Field(description="what to know about it")
    exact: bool = Field(description="refined between positions; false: the extreme of the solved positions")


class MetricsAnswer(Answer):
    """Design numbers over the cycle."""

    metrics: list[MetricEntry] = Field(default_factory=list, description="most important first")
    left_out: int = Field(default=0, description="how many further numbers there are; ask for them by 'names'")


def get_metrics(
    desk: Desk,
    model: Model,
    names: Annotated[
        list[str],
        Field(
            description="Metrics wanted, such as ['transmission_angle', 'stroke', 'quick_return_ratio', "
            "'peak_input_torque', 'peak_reaction']. Empty (default): all that apply."
        ),
    ] = [],
) -> MetricsAnswer:
    """Compute the design numbers of one machine over its cycle: strokes, swing, transmission angle, quick-return
    ratio, Grashof type, peak driving torque, peak joint reactions, power, shaking force.

    Use it to judge or rate one machine. For values at given positions use solve_machine; for several machines side by
    side compare_machines; to improve a number optimize_machine.

    Values are SI (rad, m, N, N·m) with their unit; extremes are exact between positions, 'at' is the input where they
    occur.
    Numbers about forces need masses or loads in the model; those that do not apply are left out, named ones with a
    note why.
    Comes back: numbers with unit, place, recommended limit and remark; what is worse than its limit stands among the
    findings.
    """
    for name in names:
        METRICS[name]
    mechanism, findings = desk.source(model).mechanism()
    found = applicable_metrics(mechanism, names or None, forces=None, steps=STEPS, failures="mark")
    values = list(found.table)
    findings = [*findings, *_remarks(values), *of_notes((*found.inapplicable, *found.table.notes))]
    if found.error is not None:
        findings += of_error(found.error)
    summary = _("{name}: {count} design numbers over the cycle", name=mechanism.name, count=len(values))
    return MetricsAnswer(
        ok=not any(each.severity == "error" for each in findings),
        summary=in_language(summary, desk.language),
        findings=entries(findings, desk.language),
        next=[NextAction(tool="optimize_machine", why="varies dimensions to improve one of these numbers")],
        metrics=[_entry(each, desk.language) for each in values[:MOST]],
        left_out=max(0, len(values) - MOST),
    )


def _entry(value: MetricValue, language: str) -> MetricEntry:
    return MetricEntry(
        metric=value.metric,
        subject=value.subject,
        value=number(value.value),
        unit=si_unit(value.dimension),
        at=number(value.at),
        limit=number(value.limit),
        warning=bool(value.warnings),
        remark=value.sentence_in(language),
        exact=value.exact,
    )


def _remarks(values: list[MetricValue]) -> list[Finding]:
    """Warnings about values, each once."""
    found = {
        (each.metric, remark.key, str(remark.message)): Finding(
            "warning", "", f"{each.metric} {each.subject}".strip(), remark.message, "", f"metrics.{remark.key}"
        )
        for each in values
        for remark in each.warnings
    }
    return list(found.values())
