"""Metrics of a model as a command asks for them: of its motion, and of its forces where they are needed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.evaluate import inapplicable, metrics, unloaded
from linkwright.analysis.table import MetricsTable
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism


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
