"""Design numbers of sweeps: of many designs together as far as that is certain, of the others one by one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial as partial_of

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.given import STEPS
from linkwright.core.progress import Progress, paced, part_of
from linkwright.designs.finished_parts import identity, once, surrounding
from linkwright.designs.one_by_one import changes_of
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.write import dump
from linkwright.formula.machine_code import available
from linkwright.formula.summaries import Backend
from linkwright.formula.threads import chunks
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis
from linkwright.metrics.by_name import ask, measured, needs_forces
from linkwright.metrics.evaluate import unloaded
from linkwright.metrics.hulls_of_designs import hulls_of_designs, swept
from linkwright.metrics.of_designs import MetricsOfDesigns, numbers_of_designs
from linkwright.metrics.of_output import Asked
from linkwright.metrics.ranges_of_designs import ranged, ranges_of_designs
from linkwright.words import _

#: Designs up to which what finds their numbers together may choose to do so without a compiler.
FEW = 512
#: Designs whose numbers are kept together.
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


def numbers_of(
    mechanism: Mechanism,
    columns: Mapping[str, Floats],
    names: Sequence[str],
    designs: Indices,
    *,
    partial: bool = False,
    threads: int | None = None,
    backend: Backend = "auto",
    progress: Progress | None = None,
) -> tuple[dict[str, Floats], dict[str, str], dict[int, str]]:
    """Metrics of the chosen ones of all designs, NaN for the others: values and dimensions by name, and sentences of
    designs for which they cannot be found. ``partial``: also of designs that reach a part of their cycle alone.

    Formulas of summaries are found together as far as that is certain, the others, and what is no such formula, one
    by one. Raises RequestError for a metric that applies to none.
    """
    count = len(next(iter(columns.values())))
    values = {name: np.full(count, np.nan) for name in names}
    dimensions: dict[str, str] = {}
    try:
        cycles = side_by_side(mechanism, columns, names)
    except RequestError:
        raise
    except LinkwrightError:  # of the machine as it is; designs tell for themselves
        cycles = []
    certain = np.full(len(designs), bool(cycles))
    kept = surrounding() is not None
    own = identity(dump(replace(mechanism, optimize={})), *names, partial) if kept else ""
    compiled = backend == "auto" and available()
    whole = progress is None or (compiled and len(designs) <= FEW)
    serving: Backend = "llvm" if compiled and not whole else backend  # as it serves all together
    for k, cycle in enumerate(cycles):
        tell = part_of(progress, k, len(cycles) + 1)
        pieces = [(0, len(designs))] if whole else paced(len(designs))
        for low, high in chunks(len(designs), PIECE) if kept else pieces:
            some = designs[low:high]
            part = {address: column[some] for address, column in columns.items()}
            evaluate = partial_of(cycle.evaluate, part, threads=threads, backend=serving)
            known, sure_here = once(evaluate, partial_of(tuple, (own, k, serving, part)))
            certain[low:high] &= sure_here
            for name, column in known.items():
                values[name][some[sure_here]] = column[sure_here]
            dimensions |= cycle.kinds
            if tell is not None:
                tell(high, len(designs))
    sure = np.zeros(count, dtype=np.bool_)
    sure[designs] = certain
    rest = [name for name in names if name not in dimensions]
    failed: dict[int, str] = {}
    left = designs.tolist() if rest else designs[~sure[designs]].tolist()
    tell = part_of(progress, len(cycles), len(cycles) + 1)
    for done, index in enumerate(left, 1):
        changes, asked = changes_of(columns, index), rest if sure[index] else names
        alone = partial_of(_alone, mechanism, changes, asked, partial)
        found_alone, why = once(alone, partial_of(tuple, (own, changes, *asked)))
        failed |= {index: why} if why else {}
        for name, (value, dimension) in found_alone.items():
            values[name][index], dimensions[name] = value, dimension
        if tell is not None:
            tell(len(designs) * done // len(left), len(designs))
    idle = [name for name in names if name not in dimensions] if len(designs) > len(failed) else []
    if idle:
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
    return values, dimensions, failed


def _alone(
    mechanism: Mechanism, changes: Mapping[str, float], names: Sequence[str], partial: bool
) -> tuple[dict[str, tuple[float, str]], str]:
    """Values and dimensions of the metrics that one design has, and why it lacks others."""
    found: dict[str, tuple[float, str]] = {}
    why, design = "", mechanism.with_dimensions(changes)
    try:
        motion = solve_motion(design, failures="mark" if partial else "raise")
        forces = any(needs_forces(name, design) for name in names)
        analysis = Analysis.of(solve_forces(motion) if forces else motion)
    except RequestError:
        raise
    except LinkwrightError as error:
        return found, error.sentence
    ask(names, analysis)
    for name in names:
        try:
            if (own := measured(name, analysis)) is not None:
                found[name] = own.value, own.dimension
        except RequestError:
            raise
        except LinkwrightError as error:
            why = error.sentence
    return found, why
