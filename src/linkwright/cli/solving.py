"""One run of ``solve``: the motion on a fine grid, its forces, the rows that are shown, and all as data."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import chain
from math import ceil
from typing import Literal

import numpy as np

from linkwright.analysis.analysis import Analysis, Kind
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options
from linkwright.cli.positions import inputs, joined, places
from linkwright.core.arrays import Floats, Indices, largest
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.core.table import Column
from linkwright.errors import Finding, LinkwrightError, RequestError, about
from linkwright.events.position_list import MOST
from linkwright.kinematics.cycle import time_span
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import no_output, of_forces, results_meant
from linkwright.kinematics.proof import Proof, prove
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces, reaction_pairs
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.table import results_of
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

Failures = Literal["raise", "mark"]
Wanted = tuple[Callable[[Forces], Floats], Kind]
#: Steps of the grid on which largest values are sought, at least.
FINE = 360
#: Steps that are shown unless others are asked for.
ROWS = 24
#: Turns of which these show the course, at most.
MOST_TURNS = 6


@dataclass(frozen=True)
class Solved:
    """A motion, its forces where asked for, the indices of the rows that are shown, and its warnings.

    ``full_cycle``: the positions are the cycle, not chosen ones; ``turns``: of how many turns the rows are the first,
    0 where they are of all.
    """

    motion: Motion
    forces: Forces | None
    rows: Indices
    warnings: tuple[Finding, ...] = ()
    trouble: LinkwrightError | None = None
    full_cycle: bool = False
    turns: int = 0

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of motion and forces, and on the rows."""
        rows = (
            (
                _(
                    "the table shows the first of {turns} turns; --steps N shows N steps of all of them, "
                    "--at 720deg..1080deg:15deg others",
                    turns=self.turns,
                ),
            )
            if self.turns
            else ()
        )
        return (*self.motion.notes, *(self.forces.notes if self.forces is not None else ()), *rows)

    @cached_property
    def proof(self) -> Proof:
        """In which steps of the motion the assembly is proved not to change."""
        return prove(self.motion)

    @cached_property
    def force_scale(self) -> float:
        """Largest joint force, N, but no less than 1."""
        sizes = [1.0]
        if self.forces is not None:
            for joint, link in reaction_pairs(self.motion.mechanism):
                force = self.forces.reaction(joint, on=link)
                sizes.append(largest(force))
        return max(sizes)

    @cached_property
    def analysis(self) -> Analysis:
        """What numbers of the cycle are read from."""
        return Analysis.of(self.motion if self.forces is None else self.forces)

    @cached_property
    def between(self) -> bool:
        """Whether what is between the positions of a cycle is known; not of chosen positions, nor where it is not
        passed."""
        return self.full_cycle and self.analysis.cycle is not None

    def results(self) -> dict[Output, Floats]:
        """All results at the shown rows, SI."""
        found = results_of(self.motion, self.forces)
        return {output: values[self.rows] for output, values in found.items()}

    def picked(self, patterns: Sequence[str]) -> dict[Output, Floats]:
        """The results at the shown rows that any pattern names: a column, the beginning of columns up to a dot, with
        ``*`` and ``?``, or an output in the user's words."""
        results, mechanism, found = self.results(), self.motion.mechanism, dict[Output, Floats]()
        solved = self.motion if self.forces is None else self.forces
        with about("--columns", UsageError, RequestError):
            for output in chain.from_iterable(results_meant(mechanism, each, results) for each in patterns):
                if output in results:
                    found[output] = results[output]
                elif output.of_motion or self.forces is not None:
                    found[output] = self.analysis.signal(output.name)(solved)[self.rows]
                elif self.trouble is None:
                    no_output(mechanism, output.name)
        return found


def solve(mechanism: Mechanism, warnings: list[Finding], options: Options) -> Solved:
    """Solves as the options say; raises LinkwrightError."""
    motion, rows, turns = _motion(mechanism, options)
    wanted = options.forces
    if wanted is None:
        wanted = mechanism.has_loads or options.static or of_forces(mechanism, options.columns or ())
    forces, trouble = None, None
    if wanted:
        try:
            forces = solve_forces(motion, static=options.static)
        except LinkwrightError as error:
            trouble = error
    full_cycle = options.at is None and options.times is None
    return Solved(motion, forces, rows, tuple(warnings), trouble, full_cycle, turns)


def _turns(mechanism: Mechanism) -> int:
    """Of how many turns the first is shown; 0 where so few are passed that rows of all of them show their course."""
    if not mechanism.drivers:
        return 0
    speeds = [driver.law.constant_speed or 0.0 for driver in mechanism.drivers.values() if driver.law.rotary]
    turns = max(map(abs, speeds), default=0.0) * abs(time_span(mechanism)[1]) / (2.0 * np.pi)
    return ceil(turns - 1e-9) if turns > MOST_TURNS else 0


def chosen_motion(mechanism: Mechanism, options: Options, failures: Failures = "raise") -> Motion | None:
    """The motion at the positions of ``--at`` or ``--times``, in their order; None where neither is given."""
    if options.at is not None:
        return solve_motion(mechanism, at=inputs(joined(options.at), mechanism), failures=failures)
    if options.times is not None:
        times = places(joined(options.times), mechanism, "time", "--times")
        return solve_motion(mechanism, times=times, failures=failures)
    return None


def with_forces(motion: Motion) -> Motion | Forces:
    """The motion with its forces where there is anything to carry."""
    return solve_forces(motion) if motion.mechanism.has_loads else motion


def _motion(mechanism: Mechanism, options: Options) -> tuple[Motion, Indices, int]:
    """The motion, the rows that are shown, and of how many turns these are the first."""
    failures: Failures = "mark" if options.mark else "raise"
    motion = chosen_motion(mechanism, options, failures)
    if motion is None:
        turns = 0 if options.steps else _turns(mechanism)
        steps = options.steps or ROWS * max(1, turns)
        if steps > MOST:
            raise UsageError(
                _("--steps is {steps}; take {most} at most", code="solve.too_many", steps=steps, most=MOST)
            )
        share = -(-FINE // steps)
        motion = solve_motion(mechanism, steps=steps * share, endpoint=True, failures=failures)
        return motion, np.arange(0, motion.steps, share)[: ROWS + 1 if turns else None], turns
    return motion, np.arange(motion.steps), 0


def leading(solved: Solved, columns: Mapping[str, Column]) -> list[Column]:
    """Time where it matters, and the drivers' coordinates."""
    first = [] if placed_by_inputs(solved.motion) else [columns["time"]]
    return first + [columns[name] for name in solved.motion.mechanism.drivers]


def point_keys(motion: Motion, names: Sequence[str] | None) -> list[str]:
    """Names that the columns have for points that are asked for; raises UsageError for an unknown one."""
    with about("--points", UsageError, LinkwrightError):
        return [motion.point(name).name for name in names or ()]


def named_columns(solved: Solved, options: Options) -> dict[str, Floats]:
    """The chosen columns by their names with units."""
    return {f"{column.name} [{column.unit}]": column.values for column in chosen(solved, options)}


def chosen(solved: Solved, options: Options) -> list[Column]:
    """The columns that are asked for behind time and inputs; all of them if none is asked for."""
    columns = {column.name: column for column in (Column.of(*item) for item in solved.results().items())}
    patterns = [*(options.columns or ()), *point_keys(solved.motion, options.points)]
    if not patterns:
        return list(columns.values())
    first = {column.name: column for column in [columns["time"], *leading(solved, columns)]}
    picked = (Column.of(*item) for item in solved.picked(patterns).items())
    return list({**first, **{column.name: column for column in picked}}.values())


@dataclass(frozen=True)
class Place:
    """A number of a result where it is largest or smallest: ``value``, the input there as text, the forces there and
    the number of their position."""

    value: float
    input: str
    forces: Forces
    row: int


def data(solved: Solved, options: Options) -> dict[str, object]:
    """Everything in the table and in the notes below it."""
    motion, forces = solved.motion, solved.forces
    failed = [int(row) for row in solved.rows if not motion.ok[row]]
    found: dict[str, object] = {
        "ok": motion.complete and solved.trouble is None,
        "name": motion.mechanism.name,
        "mobility": motion.structure.mobility,
        "turned": motion.structure.data()["turned"],
        "positions": len(solved.rows),
        "columns": named_columns(solved, options),
        "reached": motion.ok[solved.rows],
        "not_reached": {str(list(solved.rows).index(row)): motion.outcomes[row].sentence for row in failed},
        "notes": list(solved.notes),
        "warnings": [each.removeprefix("! ") for each in closeness(motion, "en")],
        "findings": [finding.data() for finding in solved.warnings],
    }
    if options.prove:
        proof = solved.proof
        found["proof"] = {"said": proof.explain(), "proved": proof.proved, "margin": proof.margin}
    if forces is not None:
        found["static"] = forces.static
        found["checks"] = {
            "power_residual [W]": largest(forces.power_residual),
            "balance_residual [N]": largest(forces.balance_residual),
        }
        peaks = largest_reactions(solved) if motion.ok.any() else []
        found["largest_reactions [N]"] = {
            f"{joint} on {link}": peak.value
            for (joint, link), peak in zip(reaction_pairs(forces.mechanism), peaks, strict=bool(peaks))
        }
    if solved.trouble is not None:
        found["error"] = str(solved.trouble)
    return found


def largest_reactions(solved: Solved, *, degrees: bool = True) -> list[Place]:
    """The largest force of every joint on a link, in the order of ``reaction_pairs``."""
    pairs = reaction_pairs(solved.motion.mechanism)
    return extremes_of(solved, [(partial(_size, joint=joint, on=link), "max") for joint, link in pairs], degrees)


def _size(forces: Forces, joint: str, on: str) -> Floats:
    """Size of a joint's force on a link, (n,) N."""
    return np.asarray(np.hypot(*forces.reaction(joint, on=on).T))


def extremes_of(solved: Solved, wanted: Sequence[Wanted], degrees: bool) -> list[Place]:
    """Extremes of what the forces give: refined between the positions of a full cycle, else those of positions."""
    forces = solved.forces
    assert forces is not None
    if not solved.between:
        rows = [first_largest(signal(forces) if kind == "max" else -signal(forces)) for signal, kind in wanted]
        values = [float(signal(forces)[row]) for (signal, _unused), row in zip(wanted, rows, strict=True)]
    else:
        found = [(signal, solved.analysis.extreme(signal, kind, of="forces")) for signal, kind in wanted]
        known = [(signal, each.time, each.value) for signal, each in found if each is not None]
        forces, rows = solved.analysis.resolver.forces_at(known)
        values = [value for _unused, _unused2, value in known]
    return [
        Place(value, input_text(forces.motion, row, degrees=degrees), forces, row)
        for value, row in zip(values, rows, strict=True)
    ]


def closeness(motion: Motion, language: str) -> list[str]:
    """Warnings about groups whose cycle passes close to a singular position, each with the place.

    Of chosen inputs or times the full cycle is examined where there is one.
    """
    if not motion.inputs or not motion.ok.any():
        return []
    from linkwright.analysis.singularity import Singularity

    cycle = motion
    if not motion.positions.closed:
        with contextlib.suppress(LinkwrightError):
            cycle = solve_motion(motion.mechanism, failures="mark")
    values = Singularity().evaluate(cycle)
    return [f"! {remark.text(language)}" for value in values for remark in value.warnings]


def input_text(motion: Motion, place: int, *, degrees: bool) -> str:
    """Where a position is: the drivers' coordinates, or the time where drivers follow laws of their own."""
    if not placed_by_inputs(motion):
        return f"t = {_short(motion.time[place])} s"
    texts = []
    for name, values in motion.inputs.items():
        turn = motion.positions.rotary[name]
        in_degrees = turn and degrees
        unit = "°" if in_degrees else " rad" if turn else " m"
        texts.append(f"{_short(np.degrees(values[place]) if in_degrees else values[place])}{unit}")
    return ", ".join(texts)


def placed_by_inputs(motion: Motion) -> bool:
    """Whether inputs say where a position is: with constant speeds, or where the machine is let go from it."""
    free = not any(driver.law.prescribed for driver in motion.mechanism.drivers.values())
    return motion.mechanism.steady or (free and bool(np.ptp(motion.time) == 0.0) and bool(motion.inputs))


def _short(value: float) -> str:
    return f"{round(float(value), 4) + 0.0:g}"
