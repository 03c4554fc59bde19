"""How far summaries of positions are from those between the positions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.cycle.summary import Summary
from linkwright.designs.one_by_one import OF_VALUES
from linkwright.errors import LinkwrightError
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


def note_of_positions(
    mechanism: Mechanism, steps: int, summaries: Iterable[Summary], dimensions: Iterable[str]
) -> Message | None:
    """That summaries are those of the positions, with how far the worst one of the machine as it is is from the one
    between them; None where none is asked."""
    asked = [(each, kind) for each, kind in zip(summaries, dimensions, strict=True) if each.kind in OF_VALUES]
    if not asked:
        return None
    worst, off = None, 0.0
    try:
        motion = solve_motion(mechanism, steps=steps, failures="mark")
        forces = solve_forces(motion) if mechanism.has_loads else None
        for summary, dimension in asked:
            sampled, exact, size = _both(Analysis.of(forces or motion), summary, forces)
            if size and abs(exact - sampled) > off * size:
                worst, off = (summary, sampled, exact, dimension), abs(exact - sampled) / size
    except LinkwrightError:
        worst = None
    if worst is None:
        return _(
            "minima, maxima and means of outputs are those of the {steps} positions; those of the "
            "cycle are found without steps",
            code="study.of_positions",
            steps=steps,
        )
    summary, sampled, exact, dimension = worst
    values = {"there": shown(sampled, dimension), "between": shown(exact, dimension), "share": f"{100.0 * off:.2g}"}
    return _(
        "minima, maxima and means of outputs are those of the {steps} positions: {name} of "
        "the machine as it is is {there} there, but {between} between them ({share} % of the "
        "largest value apart); leave steps out for those of the cycle, or give more of them",
        code="study.of_positions_off",
    ).format(steps=steps, name=summary.name, **values)


def _both(analysis: Analysis, summary: Summary, forces: Forces | None) -> tuple[float, float, float]:
    """A summary of the positions, the same between them, and the size of the signal; size 0 where that is unknown."""
    values: Floats = analysis.signal(summary.output)(forces or analysis.motion)
    found = analysis.part(summary)
    if not (found.exact and np.isfinite(found.value) and np.isfinite(values).all()):
        return 0.0, 0.0, 0.0
    return float(OF_VALUES[summary.kind](values)), found.value, float(np.abs(values).max())
