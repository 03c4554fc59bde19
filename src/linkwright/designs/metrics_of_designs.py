"""Metrics of sweeps: of many designs together as far as that is certain, of the others one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from linkwright.analysis import Analysis
from linkwright.analysis.by_name import Asked, ask, measured, needs_forces
from linkwright.analysis.evaluate import unloaded
from linkwright.analysis.extents_of_designs import hulls_of_designs, ranged, ranges_of_designs, swept
from linkwright.analysis.of_designs import MetricsOfDesigns, numbers_of_designs
from linkwright.applied_loads.strokes import TURN
from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.progress import Progress, paced, part_of
from linkwright.core.search import first_largest
from linkwright.cycle.summaries import Summary
from linkwright.designs.checkpoints import checkpointed, current_checkpoints, identity
from linkwright.designs.traced_outputs import Traced
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.write import dump
from linkwright.formula.machine_code import available
from linkwright.formula.summaries import Backend
from linkwright.formula.threads import chunks
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.dimensions import Design
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import MotionRun, solve_motion
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.run import run_forces, solve_forces
from linkwright.kinetostatics.solver import ForceSolver, words_name
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Designs up to which what finds their numbers together may choose to do so without a compiler.
FEW = 512
#: Designs whose metrics are stored together.
PIECE = 8192


def side_by_side(
    mechanism: Mechanism,
    varied: Iterable[str],
    names: Sequence[str],
    asked: Asked | None = None,
    *,
    steps: int = STEPS,
) -> list[MetricsOfDesigns]:
    """What finds those metrics that are found of all designs at once, by formulas, hulls and ranges of motion;
    ``asked``, ``steps``: see ``numbers_of_designs``."""
    by, hulls = tuple(varied), [name for name in names if swept(name, mechanism)]
    ranges = [name for name in names if ranged(name)]
    formulas = [name for name in names if name not in (*hulls, *ranges)]
    found = (
        numbers_of_designs(mechanism, by, formulas, steps=steps, asked=asked) if formulas else None,
        hulls_of_designs(mechanism, by, hulls) if hulls else None,
        ranges_of_designs(mechanism, by, ranges) if ranges else None,
    )
    return [each for each in found if each is not None and each.kinds]


@dataclass(frozen=True)
class Numbers:
    """Metrics (designs,) by name, NaN of designs that were not chosen, with their dimensions; sentences of designs
    for which one cannot be found, and notes."""

    values: dict[str, Floats]
    dimensions: dict[str, str]
    troubled: dict[int, str]
    notes: dict[str, None]


#: Values with their dimensions of the named metrics of one changed design, why it lacks others, and notes.
Alone = Callable[[dict[str, float], Sequence[str]], tuple[dict[str, tuple[float, str]], str, list[str]]]


def numbers_of(
    mechanism: Mechanism,
    columns: Mapping[str, Floats],
    names: Sequence[str],
    designs: Indices,
    alone: Alone,
    known: tuple[object, ...],
    *,
    asked: Asked | None = None,
    together: bool = True,
    threads: int | None = None,
    backend: Backend = "auto",
    progress: Progress | None = None,
) -> Numbers:
    """Metrics of the chosen ones of all designs; ``known``: on what else they depend.

    Formulas of summaries are found ``together`` as far as that is certain, the others, and what is no such formula,
    one by one; all are stored in the current checkpoints.
    """
    found = Numbers({name: np.full(len(next(iter(columns.values()))), np.nan) for name in names}, {}, {}, {})
    cycles, total = _cycles(mechanism, columns, names, asked) if together else [], len(designs)
    saving, compiled = current_checkpoints() is not None, backend == "auto" and available()
    own = identity(dump(replace(mechanism, optimize={})), *known) if saving else ""
    at_once = total <= PIECE if saving else progress is None or (compiled and total <= FEW)
    serving: Backend = "llvm" if compiled and not at_once else backend  # as it serves all together
    unsure = np.ones((len(names), total), dtype=np.bool_)
    for k, cycle in enumerate(cycles):
        tell = part_of(progress, k, len(cycles) + 1)
        rows = [names.index(name) for name in cycle.kinds]
        found.dimensions.update(cycle.kinds)
        for low, high in chunks(total, PIECE) if saving else [(0, total)] if at_once else paced(total):
            some = designs[low:high]
            part = {address: column[some] for address, column in columns.items()}
            evaluate = partial(cycle.evaluate, part, threads=threads, backend=serving)
            values, sure = checkpointed(evaluate, partial(tuple, (own, [*cycle.kinds], serving, part)))
            for name, column in values.items():
                found.values[name][some[sure]] = column[sure]
            unsure[rows, low:high] = ~sure
            if tell is not None:
                tell(high, total)
    left, tell = np.flatnonzero(unsure.any(axis=0)), part_of(progress, len(cycles), len(cycles) + 1)
    for done, place in enumerate(left.tolist(), total - len(left) + 1):
        index = int(designs[place])
        rest = [name for name, row in zip(names, unsure, strict=True) if row[place]]
        changes = changes_of(columns, index)
        numbers, why, notes = checkpointed(partial(alone, changes, rest), partial(tuple, (own, changes, *rest)))
        found.troubled.update({index: why} if why else {})
        found.notes.update(dict.fromkeys(notes))
        for name, (value, dimension) in numbers.items():
            found.values[name][index], found.dimensions[name] = value, dimension
        if tell is not None:
            tell(done, total)
    if tell is not None:
        tell(total, total)
    return found


def _cycles(
    mechanism: Mechanism, columns: Mapping[str, Floats], names: Sequence[str], asked: Asked | None
) -> list[MetricsOfDesigns]:
    """What finds them together; nothing where the machine as it is has no numbers: designs tell for themselves."""
    try:
        return side_by_side(mechanism, columns, names, asked)
    except RequestError:
        raise
    except LinkwrightError:
        return []


def swept_numbers(
    mechanism: Mechanism,
    columns: Mapping[str, Floats],
    names: Sequence[str],
    designs: Indices,
    *,
    in_part: bool,
    threads: int | None,
    backend: Backend,
    progress: Progress | None,
) -> Numbers:
    """Those of a sweep; ``in_part``: also of designs that reach a part of their cycle.

    Raises RequestError for a metric that applies to none.
    """
    alone = partial(_alone, mechanism, in_part)
    found = numbers_of(
        mechanism, columns, names, designs, alone, (in_part,), threads=threads, backend=backend, progress=progress
    )
    idle = [name for name in names if name not in found.dimensions]
    if idle and len(designs) > len(found.troubled):
        if (missing := unloaded(mechanism, idle)) is not None:
            raise RequestError(missing)
        raise RequestError(
            _(
                "{names} of {name!r} does not apply to it; choose another one",
                code="study.sweep_metric",
                names=tuple(idle),
                name=mechanism.name,
            )
        )
    return found


def _alone(
    mechanism: Mechanism, in_part: bool, changes: dict[str, float], names: Sequence[str]
) -> tuple[dict[str, tuple[float, str]], str, list[str]]:
    found: dict[str, tuple[float, str]] = {}
    why, design = "", mechanism.with_dimensions(changes)
    try:
        motion = solve_motion(design, failures="mark" if in_part else "raise")
        forces = any(needs_forces(name, design) for name in names)
        analysis = Analysis.of(solve_forces(motion) if forces else motion)
    except RequestError:
        raise
    except LinkwrightError as error:
        return found, error.sentence, []
    ask(names, analysis)
    for name in names:
        try:
            if (own := measured(name, analysis)) is not None:
                found[name] = own.value, own.dimension
        except RequestError:
            raise
        except LinkwrightError as error:
            why = error.sentence
    return found, why, []


#: What a summary is of values at positions; extremes skip those that do not exist.
OF_VALUES: Mapping[str, Callable[[Floats], Any]] = {
    "min": np.fmin.reduce,
    "max": np.fmax.reduce,
    "mean": np.mean,
    "rms": lambda values: np.sqrt(np.mean(values * values)),
    "range": lambda values: np.fmax.reduce(values) - np.fmin.reduce(values),
    "peak": lambda values: np.fmax.reduce(np.abs(values)),
}


def changes_of(columns: Mapping[str, Floats], index: int) -> dict[str, float]:
    """The varied dimensions of one design."""
    return {address: float(column[index]) for address, column in columns.items()}


def motion_alone(traced: Traced, changes: Mapping[str, float]) -> Motion:
    """The motion of a design in the assembly of the mechanism as it is; positions that are not reached are marked."""
    design = Design(traced.mechanism, traced.solver.assembly.modes, changes)
    positions = over_cycle(design.mechanism, traced.positions.steps)
    return MotionRun(traced.solver.for_design(design), positions).solve("mark")


def places_in(motion: Motion, positions: Positions) -> Indices:
    """Where the positions of others are among those of a motion, (n,), whose driver may turn the other way."""
    places = np.arange(positions.count)
    ways = (np.diff(next(iter(each.coordinates.values()))[0][:2]) for each in (motion.positions, positions))
    return -places % positions.count if positions.closed and np.prod([*ways]) < 0.0 else places


def outputs_alone(motion: Motion, quantities: Iterable[Quantity]) -> dict[str, Floats]:
    """Outputs of a motion, or of its forces, by their names, (n,) each, NaN where it is not reached.

    Raises LinkwrightError where its forces cannot be found.
    """
    asked = {each.name: each for each in quantities}
    words = [name for name, each in asked.items() if not each.output.of_course]
    names = tuple(map(words_name, words))
    if all(each.output.of_motion for each in asked.values()):
        values = ForceSolver(motion.solver).evaluate(names, motion, {}) if names else np.empty((0, motion.steps))
    else:
        values = run_forces(motion, False).evaluate(names)
    found = dict(zip(words, np.where(motion.ok, values, np.nan), strict=True))
    return {name: found[name] if name in found else _of_course(motion, each) for name, each in asked.items()}


def _of_course(motion: Motion, quantity: Quantity) -> Floats:
    """What only the course of a motion tells; an angle on the turn on which programs have it."""
    values = motion.read(quantity.output)
    if quantity.reference is None or not motion.ok.any():
        return values
    middle = 0.5 * (np.nanmin(values) + np.nanmax(values))
    return values + TURN * np.round((quantity.reference - middle) / TURN)


def summary_of(summary: Summary, values: Floats, reached: Flags, inputs: Floats) -> float:
    """A summary of an output over the positions that are reached; NaN where there are none."""
    found = values[reached]
    if not len(found):
        return np.nan
    if summary.kind in ("argmin", "argmax"):
        return float(inputs[reached][first_largest(found if summary.kind == "argmax" else -found)])
    return float(OF_VALUES[summary.kind](found))


def sentence_of(traced: Traced, changes: Mapping[str, float]) -> str:
    """Why a design cannot pass its cycle."""
    try:
        motion = motion_alone(traced, changes)
    except LinkwrightError as error:
        return error.sentence
    return (
        _("it could not be tracked from position to position together with the others; give more steps")
        if motion.complete
        else motion.refusal().sentence
    )
