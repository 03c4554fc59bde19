"""Dimensions varied within bounds until a design number is best."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction, number
from linkwright.assistants.failures import entries
from linkwright.assistants.tool import Desk, Model, Overwrite, SaveAs
from linkwright.designs.optimise.optimize import optimize
from linkwright.designs.optimise.optimum import Choice, OptimizeError, Optimum
from linkwright.errors import Finding
from linkwright.words import _
from linkwright.words.message import in_language

#: Designs of a front that are listed, and evaluations at most.
MOST, MOST_EVALUATIONS = 12, 20_000


class NumberEntry(Answered):
    """A dimension or number at the start and in the design that was found."""

    name: str = Field(description="address of a dimension, or the number that was asked for")
    start: float | None = Field(description="value of the machine as it was, in the unit")
    found: float | None = Field(description="value in the best design, in the unit")
    unit: str = Field(description="SI unit; empty for a plain number")


class DesignEntry(Answered):
    """One design of a front of several objectives."""

    values: dict[str, float | None] = Field(description="dimensions by address, SI")
    numbers: dict[str, float | None] = Field(description="objectives and demands, SI")


class OptimumAnswer(Answer):
    """The best design."""

    variables: list[NumberEntry] = Field(default_factory=list, description="the varied dimensions")
    numbers: list[NumberEntry] = Field(default_factory=list, description="objectives and demands")
    missed: list[str] = Field(default_factory=list, description="demands that the best design does not meet")
    front: list[DesignEntry] = Field(default_factory=list, description="of several objectives: designs between them")
    evaluations: int = Field(default=0, description="designs that were judged")
    text: str = Field(default="", description="the model file with the best values, comments and order kept")
    written: str = Field(default="", description="file in the folder that holds it; empty where none was written")


def optimize_machine(
    desk: Desk,
    model: Model,
    vary: Annotated[
        dict[str, str],
        Field(
            max_length=20,
            description="Dimensions or parameters with their bounds and unit: {'coupler.length': '80..120 mm', "
            "'frame.O2.x': '0.2..0.3 m'}. Empty (default): what the model's section 'optimize' says.",
        ),
    ] = {},
    minimize: Annotated[
        list[str],
        Field(
            max_length=4,
            description=(
                "Numbers to make small: metrics 'peak_input_torque', 'peak_reaction O5', summaries of outputs "
                "'jaw.angle range', 'rocker.angular_velocity max', or a dimension 'coupler.length'. Several numbers "
                "give a front."
            ),
        ),
    ] = [],
    maximize: Annotated[
        list[str], Field(max_length=4, description="Numbers to make large, such as 'transmission_angle'.")
    ] = [],
    keep: Annotated[
        dict[str, str],
        Field(
            max_length=20,
            description=(
                "What must hold, by number: {'transmission_angle': 'at least 40 deg', 'jaw.angle range': 'same "
                "within 1 %', 'peak_reaction': 'at most 60 kN', 'rocker.angle range': '30..35 deg'}."
            ),
        ),
    ] = {},
    evaluations: Annotated[
        int,
        Field(
            ge=1, le=MOST_EVALUATIONS, description="Designs that are judged at most; more finds better ones, slower."
        ),
    ] = 2000,
    seed: Annotated[
        int, Field(ge=0, le=1_000_000, description="Seed of the search: the same gives the same result.")
    ] = 0,
    save_as: SaveAs = "",
    overwrite: Overwrite = False,
) -> OptimumAnswer:
    """Vary dimensions of a machine within bounds to minimise or maximise design numbers while demands on others hold.

    Use it to improve a machine that check_model finds without errors. Where no machine is there yet, use
    synthesize_machine; to set known values, change_dimension; to see how numbers are now, get_metrics.

    Every design passes the full cycle in the assembly of the start. Takes seconds to minutes; progress is told and it
    can be cancelled. A file is written only where save_as names one, and not where a demand is missed. Comes back:
    each dimension and number at the start and in the best design (SI), demands that cannot be met together with the
    nearest design, the model text with the best values, and of several objectives a front of designs.
    """
    source = desk.source(model)
    target = desk.folder.target(save_as, overwrite=overwrite) if save_as else None
    asked: dict[str, Any] = {"vary": vary, "minimize": minimize, "maximize": maximize, "keep": keep}
    settings = {key: value for key, value in asked.items() if value}
    try:
        found = optimize(source.document(), evaluations=evaluations, seed=seed, **settings)
    except OptimizeError as error:
        finding = Finding("error", "", "keep", error.sentence, "", error.code)
        return _answer(error.nearest, desk.language, [finding])
    written = (
        desk.folder.write(target, found.model_text().encode(), overwrite=overwrite) if target is not None else ""
    )
    return _answer(found, desk.language, [], written)


def _answer(found: Optimum, language: str, findings: list[Finding], written: str = "") -> OptimumAnswer:
    units: Mapping[str, str] = found.data()["units"]
    best, problem = found.best, found.problem
    starts = dict(zip((each.address for each in problem.variables), problem.start.tolist(), strict=True))
    notes = [
        Finding(
            "note",
            "",
            f"vary.{each}",
            _("{address} changes none of these numbers; leave it out", code="optimize.no_effect", address=each),
            "",
            "optimize.no_effect",
        )
        for each in found.without_effect
    ]
    goals = ", ".join(
        f"{each.text} {best.numbers[each.text]:.6g} {units.get(each.text, '')}".strip() for each in problem.goals
    )
    return OptimumAnswer(
        ok=not findings,
        summary=in_language(_("{name}: {goals}", name=problem.mechanism.name, goals=goals), language),
        findings=entries([*findings, *notes], language),
        next=[NextAction(tool="compare_machines", why="start and design side by side")],
        variables=[_number(name, starts[name], best.values[name], units) for name in starts],
        numbers=[_number(name, found.start[name], value, units) for name, value in best.numbers.items()],
        missed=list(best.missed),
        front=[_design(each) for each in _some(found)],
        evaluations=found.evaluations,
        text=found.model_text(),
        written=written,
    )


def _number(name: str, start: float, value: float, units: Mapping[str, str]) -> NumberEntry:
    return NumberEntry(name=name, start=number(start), found=number(value), unit=units.get(name, ""))


def _design(choice: Choice) -> DesignEntry:
    values, numbers = (
        {name: number(each) for name, each in found.items()} for found in (choice.values, choice.numbers)
    )
    return DesignEntry(values=values, numbers=numbers)


def _some(found: Optimum) -> list[Choice]:
    """Designs of the front, evenly among them; none of one objective."""
    if len(found) < 2:
        return []
    count = min(MOST, len(found))
    return [found.choices[round(k * (len(found) - 1) / (count - 1))] for k in range(count)]
