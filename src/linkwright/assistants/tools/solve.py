"""Motion and forces at chosen positions."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction, numbers
from linkwright.assistants.failures import entries, of_error, of_notes
from linkwright.assistants.positions import positions_at
from linkwright.assistants.released import RestEntry, released, rests
from linkwright.assistants.tool import Desk, Model
from linkwright.core.arrays import Floats, Indices
from linkwright.core.outputs import Output
from linkwright.errors import Finding, LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import of_forces, results_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _
from linkwright.words.message import in_language

#: Positions and columns of a table at most; positions of the cycle on which angles are counted on.
MOST_ROWS, MOST_COLUMNS, FINE = 60, 40, 360
#: Names that are listed.
LISTED = 200
#: What is shown where no columns are asked for.
USUAL = ("time", "input", "angle", "angular_velocity", "displacement", "slide_velocity", "effort", "named")


class ColumnEntry(Answered):
    """One quantity at the positions."""

    name: str = Field(description="such as rocker.angle, C.velocity.x, reaction of a joint: 'B on rocker'")
    unit: str = Field(description="SI unit of the values: rad, m, rad/s, m/s, N, N·m")
    values: list[float | None] = Field(description="one per position; null where the position is not reached")


class SolveAnswer(Answer):
    """Motion and forces as a short table."""

    columns: list[ColumnEntry] = Field(default_factory=list, description="quantities, each with a value per position")
    reached: list[bool] = Field(default_factory=list, description="per position, whether the machine reaches it")
    forces: bool = Field(default=False, description="whether joint forces and driver efforts were solved")
    rests: list[RestEntry] = Field(
        default_factory=list, description="positions in which the machine stays at rest by itself, where asked for"
    )
    available: list[str] = Field(
        default_factory=list, description="names that columns may have, where some were left out of this table"
    )


def solve_machine(
    desk: Desk,
    model: Model,
    at: Annotated[
        str,
        Field(
            description=(
                "Positions: inputs of the first driver or times, with units, as a list '0 deg, 45 deg', a range "
                "with a step '0..90 deg:10 deg', times '0 s, 0.5 s', or limit positions of a link 'rocker min, "
                "rocker max'; of several drivers 'sun=10 deg, 20 deg; ring=30 deg'. Empty (default): equal steps "
                "over the whole cycle."
            )
        ),
    ] = "",
    columns: Annotated[
        list[str],
        Field(
            description=(
                "Quantities wanted: a column 'rocker.angle'; all of a link or point 'rocker', 'C.velocity'; a "
                "pattern '*.angular_velocity'; a joint force 'reaction B on rocker'; 'driver.effort' (driving torque"
                " or force). Empty (default): angles, velocities and driver efforts."
            )
        ),
    ] = [],
    positions: Annotated[
        int, Field(ge=1, le=MOST_ROWS, description="Number of equal steps over the cycle where 'at' is empty.")
    ] = 12,
    under: Annotated[
        Literal["drivers", "forces", "rest"],
        Field(
            description=(
                "What moves it. drivers (default): the laws of the drivers. forces: it is let go, and motors, loads,"
                " springs and weights decide (sections actuators, run; masses are needed); the table is over time. "
                "rest: all positions in which it stays at rest by itself, and which are stable."
            )
        ),
    ] = "drivers",
    static: Annotated[
        bool, Field(description="true: forces without inertia (quasi-static). Default false: with inertia.")
    ] = False,
) -> SolveAnswer:
    """Solve positions, velocities, accelerations, joint forces and driver efforts of a machine at chosen inputs or
    times, as a short table.

    Use it for values at given positions, and for a course over the cycle in a few steps. For extreme values over the
    cycle (largest torque, smallest transmission angle, stroke) use get_metrics: it is exact between positions. For a
    picture use draw_machine.

    With 'under' it also lets the machine go: its run under motors, springs and weights, or where it stays at rest.

    Units are SI (rad, m, s, N, N·m); angles, rates and moments are counter-clockwise positive; x to the right, y up.
    A reaction is the force on the link that is named last. Forces need masses or loads in the model. A position that
    is not reached has null values and a warning that says why. Comes back: at most 60 positions and 40 columns, and
    the names of further columns.
    """
    mechanism, findings = desk.source(model).mechanism()
    if under != "drivers" and at.strip():
        raise RequestError(
            _('"at" goes with under: drivers; leave it out where the machine is let go', code="assistants.at")
        )
    if under == "rest":
        return _at_rest(mechanism, findings, desk.language)
    course = (
        _let_go(mechanism, positions) if under == "forces" else _driven(mechanism, at, positions, columns, static)
    )
    motion, rows, forces = course.motion, course.rows, course.forces
    notes = (*motion.notes, *(forces.notes if forces is not None else ()))
    findings = [*findings, *course.findings, *_unreached(motion, rows), *of_notes(notes)]
    results = results_of(motion, forces)
    picked = _picked(mechanism, motion, forces, columns, results)
    listed = [] if len(picked) == len(results) else [each.column for each in results][:LISTED]
    return SolveAnswer(
        ok=not any(each.severity == "error" for each in findings),
        summary=in_language(course.summary, desk.language),
        findings=entries(findings, desk.language),
        next=[NextAction(tool="get_metrics", why="extreme values over the cycle, exact between positions")],
        columns=[
            ColumnEntry(name=each.column, unit=each.unit, values=numbers(values[rows]))
            for each, values in picked.items()
        ],
        reached=[bool(each) for each in motion.ok[rows]],
        forces=forces is not None,
        available=listed,
    )


def _at_rest(mechanism: Mechanism, findings: list[Finding], language: str) -> SolveAnswer:
    """The positions at rest in place of a table."""
    found = rests(mechanism)
    summary = _("{name}: {count} positions at rest", name=mechanism.name, count=len(found))
    return SolveAnswer(
        ok=True,
        summary=in_language(summary, language),
        findings=entries(findings, language),
        next=[NextAction(tool="draw_machine", why="a picture of one of these positions: at=its input")],
        rests=found,
    )


class _Course(NamedTuple):
    """A motion and the rows of it that are shown, its forces, what hinders them or happens, and a summary."""

    motion: Motion
    rows: Indices
    forces: Forces | None
    findings: Iterable[Finding]
    summary: Message


def _let_go(mechanism: Mechanism, positions: int) -> _Course:
    """The run under forces, over its time."""
    found = released(mechanism, positions)
    motion = found.forces.motion
    return _Course(motion, np.arange(motion.steps), found.forces, found.events, found.ending)


def _driven(mechanism: Mechanism, at: str, positions: int, columns: list[str], static: bool) -> _Course:
    """The motion by the laws of the drivers."""
    motion, rows = _motion(mechanism, at, positions)
    forces, hindered = _forces(motion, columns, static)
    summary = _(
        "{name}: {reached} of {count} positions reached",
        name=mechanism.name,
        reached=int(motion.ok[rows].sum()),
        count=len(rows),
    )
    return _Course(motion, rows, forces, hindered, summary)


def _motion(mechanism: Mechanism, at: str, positions: int) -> tuple[Motion, Indices]:
    """The motion and the rows that are shown."""
    if not at.strip():
        share = -(-FINE // positions)
        motion = solve_motion(mechanism, steps=positions * share, endpoint=True, failures="mark")
        return motion, np.arange(0, motion.steps, share)
    motion = positions_at(mechanism, at)
    if motion.steps > MOST_ROWS:
        raise RequestError(
            _(
                "{count} positions are asked for; ask for {most} at most",
                code="assistants.many_positions",
                count=motion.steps,
                most=MOST_ROWS,
            )
        )
    return motion, np.arange(motion.steps)


def _forces(motion: Motion, columns: list[str], static: bool) -> tuple[Forces | None, list[Finding]]:
    """The forces where there is anything to carry, or they are asked for; what hinders them."""
    mechanism = motion.mechanism
    if not (mechanism.has_loads or static or of_forces(mechanism, columns)) or not motion.ok.any():
        return None, []
    try:
        return solve_forces(motion, static=static), []
    except LinkwrightError as error:
        return None, of_error(error)


def _unreached(motion: Motion, rows: Indices) -> list[Finding]:
    """Why positions are not reached, each reason once."""
    reasons = dict.fromkeys(motion.outcomes[row].sentence for row in rows if not motion.ok[row])
    if not motion.ok.any():
        return of_error(motion.refusal())
    return [Finding("warning", "", "", each, "", getattr(each, "code", "") or "motion.refused") for each in reasons]


def _picked(
    mechanism: Mechanism, motion: Motion, forces: Forces | None, columns: list[str], results: dict[Output, Floats]
) -> dict[Output, Floats]:
    """The quantities that are asked for behind time and inputs; the usual ones where none are."""
    from linkwright.analysis.analysis import Analysis

    found = {each: values for each, values in results.items() if each.kind in ("time", "input")}
    if not columns:
        found |= {each: values for each, values in results.items() if each.kind in USUAL}
        return dict(list(found.items())[:MOST_COLUMNS])
    solved: Motion | Forces = motion if forces is None else forces
    for text in columns:
        for each in _meant(motion, text, results):
            if each in results:
                found[each] = results[each]
            elif each.of_motion or forces is not None:
                found[each] = Analysis.of(solved).signal(each.name)(solved)
    if len(found) > MOST_COLUMNS:
        raise RequestError(
            _(
                "{count} columns are asked for; ask for {most} at most",
                code="assistants.many_columns",
                count=len(found),
                most=MOST_COLUMNS,
            )
        )
    return found


def _meant(motion: Motion, text: str, results: Iterable[Output]) -> list[Output]:
    """The results that a text means: a point by its own name, or anything that has a name among them."""
    with suppress(LinkwrightError):
        text = motion.point(text).name
    return results_meant(motion.mechanism, text, results)
