"""One run of ``solve``: the motion on a fine grid, its forces, and the rows that are shown of it."""

from __future__ import annotations

import argparse
from functools import cached_property

import numpy as np

from linkwright.cli.errors import UsageError
from linkwright.cli.positions import MOST, inputs, quantities
from linkwright.core.arrays import Floats, Indices, largest
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.errors import Finding, LinkwrightError
from linkwright.kinematics.cycle import rotary
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinematics.table import motion_results
from linkwright.kinetostatics.forces import Forces, solve_forces
from linkwright.kinetostatics.table import force_results
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.cycle_grid import CycleGrid
from linkwright.plot.force_names import reaction_pairs
from linkwright.words.sentence import Sentence

#: Steps of the grid on which largest values are sought, at least.
FINE = 360
#: Steps that are shown unless others are asked for.
ROWS = 24


@dataclass(frozen=True)
class Solved:
    """A motion, its forces where asked for, the indices of the rows that are shown, and what is to be said.

    ``whole``: the positions are the cycle, not chosen ones.
    """

    motion: Motion
    forces: Forces | None
    rows: Indices
    warnings: tuple[Finding, ...] = ()
    trouble: LinkwrightError | None = None
    whole: bool = False

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of motion and forces."""
        return (*self.motion.notes, *(self.forces.notes if self.forces is not None else ()))

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
    def grid(self) -> CycleGrid | None:
        """The cycle between its positions; None of chosen positions, and where it is not passed."""
        return self.analysis.grid if self.whole else None

    def results(self) -> dict[Output, Floats]:
        """All results at the shown rows, SI."""
        found = motion_results(self.motion) if self.forces is None else force_results(self.forces)
        return {output: values[self.rows] for output, values in found.items()}


def solve(mechanism: Mechanism, warnings: list[Finding], options: argparse.Namespace) -> Solved:
    """Solves as the options say; raises LinkwrightError."""
    motion, rows = _motion(mechanism, options)
    wanted = options.forces if options.forces is not None else mechanism.has_loads or options.static
    forces, trouble = None, None
    if wanted:
        try:
            forces = solve_forces(motion, static=options.static)
        except LinkwrightError as error:
            trouble = error
    whole = options.at is None and options.times is None
    return Solved(motion, forces, rows, tuple(warnings), trouble, whole)


def _motion(mechanism: Mechanism, options: argparse.Namespace) -> tuple[Motion, Indices]:
    failures = "mark" if options.mark else "raise"
    if options.at is not None:
        if not mechanism.drivers:
            raise UsageError("cli.about", name="--at", cause=Sentence("solve.no_input"))
        given = inputs(options.at, rotary(mechanism))
        motion = solve_motion(mechanism, at=given, failures=failures)  # type: ignore[arg-type]
    elif options.times is not None:
        times = quantities(options.times, "time", "--times")
        motion = solve_motion(mechanism, times=times, failures=failures)  # type: ignore[arg-type]
    else:
        steps = options.steps or ROWS
        if steps > MOST:
            raise UsageError("solve.too_many", steps=steps, most=MOST)
        share = -(-FINE // steps)
        motion = solve_motion(mechanism, steps=steps * share, endpoint=True, failures=failures)  # type: ignore[arg-type]
        return motion, np.arange(0, motion.steps, share)
    return motion, np.arange(motion.steps)
