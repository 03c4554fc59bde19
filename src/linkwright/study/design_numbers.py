"""Design numbers of sweeps: of many designs together as far as that is certain, of the others one by one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.cycle_programs.metric_cycle import MetricCycle, metric_cycle
from linkwright.cycle_programs.range_designs import RangeDesigns, range_designs
from linkwright.cycle_programs.swept_designs import SweptDesigns, swept_designs
from linkwright.cycle_programs.terms import Asked, Term, measured
from linkwright.engine.stage import Backend
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis
from linkwright.metrics.evaluate import unloaded

#: What finds design numbers of all designs at once.
Numbers: TypeAlias = MetricCycle | SweptDesigns | RangeDesigns


def side_by_side(
    mechanism: Mechanism,
    varied: Iterable[str],
    names: Sequence[str | Term],
    asked: Asked | None = None,
    *,
    steps: int = 360,
) -> list[Numbers]:
    """What finds those design numbers that are found of all designs at once; ``asked``, ``steps``: see
    ``metric_cycle``."""
    by, plain = tuple(varied), [name for name in names if isinstance(name, str)]
    found = (
        metric_cycle(mechanism, by, names, steps=steps, asked=asked),
        swept_designs(mechanism, by, plain),
        range_designs(mechanism, by, plain),
    )
    return [each for each in found if each is not None and each.terms]


def numbers_of(
    mechanism: Mechanism,
    columns: Mapping[str, Floats],
    names: Sequence[str],
    designs: Indices,
    *,
    partial: bool = False,
    threads: int | None = None,
    backend: Backend = "auto",
) -> tuple[dict[str, Floats], dict[str, str], dict[int, str]]:
    """Metrics of the chosen ones of all designs, NaN for the others: values and dimensions by name, and sentences of
    designs for which they cannot be found. ``partial``: also of designs that reach a part of their cycle alone.

    Formulas of summaries are found together as far as that is certain, the others, and what is no such formula, one
    by one. Raises RequestError for a metric that applies to none.
    """
    count = len(next(iter(columns.values())))
    values = {name: np.full(count, np.nan) for name in names}
    dimensions: dict[str, str] = {}
    cycles = side_by_side(mechanism, columns, names)
    part = {address: column[designs] for address, column in columns.items()}
    certain = np.full(len(designs), bool(cycles))
    for cycle in cycles:
        known = cycle.evaluate(part, threads=threads, backend=backend)
        certain &= known.certain
        for each in cycle.terms:
            values[each.name][designs[known.certain]] = known.values[each.name][known.certain]
            dimensions[each.name] = each.dimension
    sure = np.zeros(count, dtype=np.bool_)
    sure[designs] = certain
    rest = [name for name in names if name not in dimensions]
    failed: dict[int, str] = {}
    for index in designs.tolist() if rest else designs[~sure[designs]].tolist():
        design = mechanism.with_dimensions({a: float(column[index]) for a, column in columns.items()})
        found_alone, why = _alone(design, rest if sure[index] else names, partial)
        failed |= {index: why} if why else {}
        for name, (value, dimension) in found_alone.items():
            values[name][index], dimensions[name] = value, dimension
    idle = [name for name in names if name not in dimensions] if len(designs) > len(failed) else []
    if idle:
        if (missing := unloaded(mechanism, idle)) is not None:
            raise RequestError(missing)
        raise RequestError("study.sweep_metric", names=tuple(idle), name=mechanism.name)
    return values, dimensions, failed


def _alone(
    design: Mechanism, names: Sequence[str], partial: bool
) -> tuple[dict[str, tuple[float, str]], str]:
    """Values and dimensions of the metrics that one design has, and why it lacks others."""
    found: dict[str, tuple[float, str]] = {}
    analysis, why = None, ""
    for name in names:
        try:
            analysis = analysis or Analysis.of(
                solve_forces(solve_motion(design, failures="mark") if partial else design)
            )
            if (own := measured(name, analysis)) is not None:
                found[name] = own
        except RequestError:
            raise
        except LinkwrightError as error:
            why = error.sentence
            if analysis is None:
                break
    return found, why
