"""Machines side by side."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction, number, numbers
from linkwright.assistants.failures import entries, of_notes
from linkwright.assistants.tool import Desk
from linkwright.designs.compare import compare
from linkwright.words import _
from linkwright.words.message import in_language


class CriterionEntry(Answered):
    """One number of all machines."""

    name: str = Field(description="name of the metric")
    unit: str = Field(description="SI unit; empty for a ratio")
    better: str = Field(description="higher or lower is better; empty: neither")
    values: list[float | None] = Field(description="one per machine in the order given; null where it does not apply")
    best: list[str] = Field(description="labels of the best machines")


class RankEntry(Answered):
    """A machine's place."""

    place: int = Field(description="1 is the best")
    label: str = Field(description="label of the machine")
    score: float | None = Field(description="0 to 1: weighted mean of how near it comes to the best in each number")


class ComparisonAnswer(Answer):
    """Numbers of all machines, and their ranking."""

    labels: list[str] = Field(default_factory=list, description="names of the machines in the order given")
    criteria: list[CriterionEntry] = Field(default_factory=list, description="the numbers that are compared")
    ranking: list[RankEntry] = Field(default_factory=list, description="best first")
    evaluation: str = Field(default="", description="the same in sentences")


def compare_machines(
    desk: Desk,
    models: Annotated[
        list[str],
        Field(
            min_length=2,
            max_length=6,
            description=(
                "Two to six models, each the whole YAML text of a model file, the name of a file in the server's "
                "folder, or 'gallery:NAME'."
            ),
        ),
    ],
    output: Annotated[
        str,
        Field(
            description=(
                "Link or guide that does the work in all of them, such as 'jaw'. Empty (default): the last one that "
                "they share."
            )
        ),
    ] = "",
    metrics: Annotated[
        list[str],
        Field(
            description=(
                "Numbers to compare, such as ['travel', 'peak_input_torque']. Empty (default): the usual ones."
            )
        ),
    ] = [],
    weights: Annotated[
        dict[str, float], Field(description="Weights of metrics in the ranking, default 1; 0 leaves one out of it.")
    ] = {},
) -> ComparisonAnswer:
    """Compare two to six machines that do the same work: their design numbers side by side, a ranking and its
    reasons.

    Use it to choose between alternatives, or to see what a change did. For one machine use get_metrics. Each must
    pass its whole cycle, and they need a link or guide of the same name, or 'output'.

    A score is the weighted mean of how near a machine comes to the best in each number that has a better direction.
    Comes back: numbers of every machine (SI), which is best in each, the ranking, an evaluation in sentences, and
    notes where unlike things are compared (other loads, other speeds).
    """
    machines = [desk.source(each).mechanism()[0] for each in models]
    found = compare(machines, metrics=metrics or None, weights=weights or None, output=output or None)
    best = found.ranking[0]
    summary = _(
        "{count} machines; first: {label}, score {score}",
        count=len(machines),
        label=best.label,
        score=f"{best.score:.3f}",
    )
    return ComparisonAnswer(
        ok=True,
        summary=in_language(summary, desk.language),
        findings=entries(of_notes(found.notes), desk.language),
        next=[NextAction(tool="write_report", why="a report of the machine that is chosen")],
        labels=list(found.labels),
        criteria=[_criterion(each) for each in found.data()["metrics"]],
        ranking=[RankEntry(place=each.place, label=each.label, score=number(each.score)) for each in found.ranking],
        evaluation=found.evaluation(desk.language),
    )


def _criterion(each: Mapping[str, Any]) -> CriterionEntry:
    return CriterionEntry(
        name=each["name"],
        unit=each["unit"],
        better=each["better"] or "",
        values=numbers(each["values"]),
        best=each["best"],
    )
