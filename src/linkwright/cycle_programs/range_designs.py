"""Ranges of motion of many designs, with gradients: the inputs at which a group is stretched or folded.

There the square under a dyad's root is zero. It is smooth on both sides, so Newton's steps from the ends of the
machine itself find those of its designs, and the implicit function theorem their derivatives.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.cycle_programs.metric_cycle import Found
from linkwright.cycle_programs.terms import Term, chosen_subjects, metric_of
from linkwright.cycle_programs.timed_cycle import moves
from linkwright.cycle_programs.traced_outputs import VALID, Traced, design_table
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import CycleGradient, cycle_gradient
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import Backend, Stage
from linkwright.engine.trace import Scalar, Trace, absolute, select
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import at_times
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis

#: Newton steps, the width of the difference that is their slope, and the last one's size, rad.
STEPS, WIDTH, CONVERGED = 12, 1e-6, 1e-10
#: How near to an end, rad, positions may lie on either side.
NEAR = 1e-8
#: Share of the cycle's time within which two times are one.
SAME = 1e-12
#: Designs whose positions are looked at together.
BLOCK = 1024
VALUE = "range"


@dataclass(frozen=True)
class End:
    """Where a stretch of the input begins or ends in the machine itself, rad, and the group that is stretched or
    folded there; none where the cycle itself ends."""

    input: float
    group: str | None


def ranged(name: str) -> bool:
    """Whether a registered number is the range of motion."""
    found = metric_of(name)
    return found is not None and found[0].input_ranges


def range_designs(mechanism: Mechanism, varied: Iterable[str], names: Iterable[str]) -> RangeDesigns | None:
    """What finds the ranges of motion among some design numbers; None where none is, the machine passes its whole
    cycle, dimensions move the inputs, or not one driver turns at constant speed and all groups have closed forms."""
    asked, addresses = [name for name in names if ranged(name)], tuple(varied)
    drivers = list(mechanism.drivers.values())
    if not asked or len(drivers) != 1 or drivers[0].law.constant_speed is None or not drivers[0].law.rotary:
        return None
    for name in asked:
        chosen_subjects(name, name.partition(" ")[2], mechanism.drivers)
    traced = Traced(mechanism, addresses, over_cycle(mechanism, 360))
    analysis = Analysis.of(traced.nominal)
    steps = traced.positions.steps
    if traced.solver.motion.next_states or traced.nominal.modes or not analysis.resolver.edges:
        return None
    if not analysis.resolver.stretches or any(moves(mechanism, address, steps) for address in addresses):
        return None
    return RangeDesigns(traced, asked, analysis)


class RangeDesigns:
    """Ranges of one mechanism's designs; of several stretches the first. Made by :func:`range_designs`."""

    def __init__(self, traced: Traced, names: Iterable[str], analysis: Analysis) -> None:
        self.traced = traced
        self.terms = tuple(Term(name, (), "angle") for name in names)
        (driver,) = traced.mechanism.drivers.values()
        period = traced.positions.period or 0.0
        known = np.array([time + lap for time, _ in analysis.resolver.edges for lap in (0.0, period)])
        slack = SAME * float(np.ptp(traced.positions.time))
        self._stretches: list[tuple[End, End]] = []
        for stretch in analysis.resolver.stretches:
            reached = [np.abs(known - time).min() <= slack for time in stretch]
            begin, end = (
                End(driver.law.at(time), self._stretched(time) if inner else None)
                for time, inner in zip(stretch, reached, strict=True)
            )
            self._stretches.append((begin, end))

    def _stretched(self, time: float) -> str:
        """The group at whose end of reach the machine is at a time."""
        motion, groups = self.traced.solver.motion, tuple(modal_groups(self.traced.solver.structure))
        program = Program.of(motion.trace, {name: motion.placed[name].quality for name in groups})
        arrays = at_times(self.traced.mechanism, [time]).arrays
        found = numpy_program(program).run_designs(self.traced.numbers(program)[None, :], arrays, length=1)
        return program.output_names[int(np.abs(found[0, :, 0]).argmin())]

    @cached_property
    def _cycle(self) -> CycleProgram:
        """The ends of all stretches, and the range."""
        stages = [
            self._end(f"{number} {side}", end)
            for number, ends in enumerate(self._stretches)
            for side, end in enumerate(ends)
        ]
        t = Trace()
        way = t.parameter("end 0 1") - t.parameter("end 0 0")
        last = Stage(Program.of(t, {VALUE: absolute(way)}), {VALUE: Reduction(VALUE, "first")}, steps=1)
        return CycleProgram((*stages, last))

    def _end(self, name: str, end: End) -> Stage:
        """Newton's steps to an end; none where the cycle itself ends."""
        t = Trace()
        wanted = {f"end {name}": Reduction("x", "last"), f"moved {name}": Reduction("moved", "last")}
        x: Scalar = t.state("x")
        if end.group is None:
            program = Program.of(t, {"x": x, "moved": 0.0, "gap": x - end.input}, {"x": x})
        else:
            motion = self.traced.solver.motion
            source = Program.of(motion.trace, {"gap": motion.placed[end.group].quality})
            gap, after, before = (self.traced.at_input(source, t, x + h)["gap"] for h in (0.0, WIDTH, -WIDTH))
            following = x - gap * (2.0 * WIDTH) / (after - before)
            outputs = {"x": following, "moved": absolute(following - x), "gap": gap}
            program = Program.of(t, outputs, {"x": following})
        return Stage(program, wanted, steps=STEPS, starts={"x": end.input}, roots={"x": "gap"})

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Those of the varied dimensions on which the ranges depend."""
        free = self.traced.solver.manner.free
        return tuple(name for name in self._cycle.dimensions if name in free)

    @cached_property
    def _backwards(self) -> CycleGradient:
        return cycle_gradient(self._cycle, VALUE, self.dimensions)

    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> Found:
        """The ranges of the designs with the given columns, rad (designs,)."""
        found = self._cycle.evaluate(
            self._table(self._cycle.dimensions, columns), self.traced.positions.arrays, threads=threads,
            backend=backend,
        )  # fmt: skip
        results = {name: np.asarray(row, dtype=float) for name, row in found.items()}
        certain = self._certain(columns, results)
        return Found({each.name: results[VALUE] for each in self.terms}, certain)

    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums of ranges (sums, designs) and their gradients (sums, designs, by); NaN where they are not
        certain."""
        certain = self.evaluate(columns, threads=threads, backend=backend).certain
        values, found = self._backwards.evaluate(
            self._table(self._backwards.cycle.dimensions, columns),
            self.traced.positions.arrays,
            threads=threads,
            backend=backend,
        )
        slopes = found[:, [self._backwards.wrt.index(name) for name in by]]
        values, slopes = np.where(certain, values, np.nan), np.where(certain[:, None], slopes, np.nan)
        weights = np.array([sum(each.values()) for each in sums])
        return weights[:, None] * values, weights[:, None, None] * slopes

    def _certain(self, columns: Mapping[str, Floats], results: Mapping[str, Floats]) -> Flags:
        """Of which designs all ends are found, and lie where reached positions follow others."""
        first, lap, sense = self._lap
        inputs = next(iter(self.traced.positions.coordinates.values()))[0]
        inside = np.zeros((len(results[VALUE]), len(inputs)), dtype=np.bool_)
        near, certain = inside.copy(), np.isfinite(results[VALUE])
        with np.errstate(invalid="ignore"):
            for number, ends in enumerate(self._stretches):
                begin, end = (sense * (results[f"end {number} {side}"] - first) for side in (0, 1))
                for side, (at, known) in enumerate(zip((begin, end), ends, strict=True)):
                    certain &= results[f"moved {number} {side}"] <= CONVERGED
                    certain &= np.floor((at + NEAR) / lap) == np.floor(
                        (sense * (known.input - first) + NEAR) / lap
                    )
                    gap = np.abs(sense * (inputs - first) - at[:, None]) % lap
                    near |= np.minimum(gap, lap - gap) <= NEAR
                certain &= begin < end
                way = (sense * (inputs - first) - begin[:, None]) % lap
                inside |= way <= (end - begin)[:, None]
        return np.asarray(certain & ((self._reached(columns) == inside) | near).all(axis=1))

    @property
    def _lap(self) -> tuple[float, float, float]:
        """Input at which the cycle begins, what it goes in a closed cycle, rad, else infinite, and its sense."""
        (driver,) = self.traced.mechanism.drivers.values()
        speed, positions = driver.law.constant_speed or 0.0, self.traced.positions
        first = float(next(iter(positions.coordinates.values()))[0][0])
        way = np.inf if positions.period is None else abs(speed) * positions.period
        sense = 1.0 if positions.time[-1] * speed >= positions.time[0] * speed else -1.0
        return first, way, sense

    def _reached(self, columns: Mapping[str, Floats]) -> Flags:
        """Which positions the designs reach, (designs, n)."""
        motion, positions = self.traced.solver.motion, self.traced.positions
        program = Program.of(motion.trace, {VALID: select(motion.valid, 1.0, 0.0)})
        table = self.traced.table(program, columns)
        rows = [
            numpy_program(program).run_designs(
                table[k : k + BLOCK], positions.arrays, length=positions.count
            )[:, 0]
            for k in range(0, len(table), BLOCK)
        ]
        return np.asarray(np.concatenate(rows) == 1.0)

    def _table(self, names: Sequence[str], columns: Mapping[str, Floats]) -> Floats:
        return design_table(names, self.traced.solver.nominal.parameters, columns)
