"""Many designs of one mechanism at once: summaries of outputs over the cycle, in fixed memory."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.engine.program import Program
from linkwright.engine.sweep import Backend, Progress, Results
from linkwright.engine.sweep import sweep as engine_sweep
from linkwright.engine.threads import chunks
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import Positions, over_cycle
from linkwright.model.mechanism import Mechanism
from linkwright.study.failures import Failure, explained
from linkwright.study.following import Following
from linkwright.study.loads import fields_of_designs
from linkwright.study.named import Quantity
from linkwright.study.summary import Summary, finished, reductions, wanted
from linkwright.study.traced import VALID, Traced
from linkwright.study.vary import design_values, refuse_moved_positions

if TYPE_CHECKING:
    import pandas

Floats = NDArray[np.float64]
Counts = NDArray[np.int64]

#: Designs of one block, and of one whose loads are found design by design.
BLOCK, LOADED_BLOCK = 1 << 16, 1 << 9


@dataclass(eq=False)
class Sweep:
    """Summaries of many designs; arrays are (designs,), SI.

    ``varied``: values of the varied dimensions; ``assembled``: number of positions that each design reaches, of
    ``positions``; ``result["driver.effort", "rms"]`` or ``result["driver.effort rms"]`` a summary, NaN for designs
    that do not pass the whole cycle (unless ``partial`` was asked for).
    """

    mechanism: Mechanism
    varied: Mapping[str, Floats]
    positions: int
    assembled: Counts
    summaries: Mapping[Summary, Floats]
    quantities: Mapping[str, Quantity] = field(repr=False)
    unloaded: Mapping[int, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def designs(self) -> int:
        """Number of designs."""
        return len(self.assembled)

    @property
    def ok(self) -> NDArray[np.bool_]:
        """Which designs pass the whole cycle, (designs,)."""
        good: NDArray[np.bool_] = self.assembled == self.positions
        if self.unloaded:
            good[list(self.unloaded)] = False
        return good

    def __getitem__(self, key: str | tuple[str, str]) -> Floats:
        """A summary (designs,), by output and kind."""
        (found, *more) = wanted([key])
        if found not in self.summaries or more:
            raise LinkwrightError(
                f"{key!r} was not asked for; there is {', '.join(s.name for s in self.summaries)}"
            )
        return self.summaries[found]

    def columns(self) -> dict[str, Floats | Counts]:
        """Varied dimensions, assembled positions and summaries by name."""
        named = {summary.name: values for summary, values in self.summaries.items()}
        return {**self.varied, "assembled": self.assembled, **named}

    def dimension(self, summary: Summary) -> str:
        """Name of the dimension of a summary's values; an extreme's place has the input's."""
        if summary.kind in ("argmin", "argmax"):
            rotary = next(iter(over_cycle(self.mechanism, 1).rotary.values()))
            return "angle" if rotary else "length"
        return self.quantities[summary.output].dimension

    def failures(self, limit: int = 1_000_000) -> tuple[Failure, ...]:
        """Why designs cannot move: how many fail first at which group, with an example in a sentence.

        At most ``limit`` failing designs are looked at.
        """
        return explained(self.mechanism, self.varied, self.ok, self.positions, self.unloaded, limit)

    def to_dataframe(self) -> pandas.DataFrame:
        """The columns as a pandas table; needs pandas."""
        from linkwright.kinematics.table import dataframe

        return dataframe({name: np.asarray(values) for name, values in self.columns().items()})

    def __repr__(self) -> str:
        kept = int(self.ok.sum())
        names = ", ".join(self.columns())
        return f"Sweep({self.mechanism.name!r}: {self.designs} designs, {kept} pass the cycle; {names})"


def sweep(
    mechanism: Mechanism,
    vary: Mapping[str, ArrayLike],
    *,
    outputs: Iterable[str | tuple[str, str]],
    steps: int = 360,
    partial: bool = False,
    threads: int | None = None,
    backend: Backend = "auto",
    progress: Progress | None = None,
) -> Sweep:
    """Summaries over the cycle of many designs of one mechanism, computed without storing the positions.

    Args:
        mechanism: the design to start from; its assembly modes hold for all.
        vary: values (designs,), SI, by address of a dimension (``pitman.length``) or name of a parameter.
        outputs: pairs (output, kind), or texts ``output kind``. Outputs: ``C.x``, ``C.velocity`` (size),
            ``C.velocity.x``, ``jaw.angle``, ``jaw.angular_velocity``, ``guide.displacement``, ``reaction O5 on jaw``,
            ``couple guide on slider``, ``driver.effort``, ``input_torque``, ``power``, ``shaking_force``,
            ``closeness`` (to a singular position, 0 there), ``transmission_angle B``. Kinds: min, max, mean, rms,
            range, peak, argmin, argmax (see :class:`Summary`).
        steps: positions over the cycle.
        partial: keep summaries over the positions that a design reaches, where it does not reach all.
        threads: None for all cores; results do not depend on it.
        backend: ``numpy``, ``llvm`` (compiled), or ``auto``.
        progress: called with (designs done, designs); what it raises stops the sweep.

    Raises:
        LinkwrightError: unknown names (nearest ones offered), values that no design can have, dimensions that
            change the drive's law.

    A dimension that changes the positions of the input is refused. Loads that follow the motion (phases, tables,
    expressions, friction) are found design by design, which takes milliseconds each. Change points are not passed:
    designs there count as not assembled.
    """
    positions = over_cycle(mechanism, steps)
    columns = design_values(mechanism, vary)
    refuse_moved_positions(mechanism, positions, columns)
    asked = wanted(outputs)
    return _Run(mechanism, columns, asked, positions, partial, threads, backend, progress).sweep()


@dataclass
class _Run:
    """One sweep."""

    mechanism: Mechanism
    columns: Mapping[str, Floats]
    asked: tuple[Summary, ...]
    positions: Positions
    partial: bool
    threads: int | None
    backend: Backend
    progress: Progress | None

    def __post_init__(self) -> None:
        self.designs = len(next(iter(self.columns.values())))
        self.traced = Traced(self.mechanism, self.columns, self.positions)
        names = [summary.output for summary in self.asked]
        self.quantities = self.traced.quantities(names)
        self.reductions = reductions(self.asked, self.quantities)
        self.program = self.traced.program(self.quantities)
        self.unloaded: dict[int, str] = {}
        self.follow: Following | None = None
        if self.program.states and not self.program.fields:
            self.follow = Following(self.traced, names)

    def sweep(self) -> Sweep:
        assembled = np.zeros(self.designs, dtype=np.int64)
        values = {summary: np.empty(self.designs) for summary in self.asked}
        count = self.positions.count
        for first, end in chunks(self.designs, LOADED_BLOCK if self.program.fields else BLOCK):
            part = {address: column[first:end] for address, column in self.columns.items()}
            results = self._block(part, first)
            assembled[first:end] = results["valid.count"]
            for summary, into in values.items():
                found = finished(summary, self.quantities[summary.output], results, self._input())
                if not self.partial:
                    found[results["valid.count"] != count] = np.nan
                into[first:end] = found
            if self.progress is not None:
                self.progress(end, self.designs)
        for index in self.unloaded:
            for into in values.values():
                into[index] = np.nan
        notes = self.traced.nominal.notes
        return Sweep(
            self.mechanism, self.columns, count, assembled, values, self.quantities, self.unloaded, notes
        )

    def _input(self) -> Floats:
        return (
            next(iter(self.positions.coordinates.values()))[0] if self.positions.coordinates else np.zeros(1)
        )

    def _block(self, part: Mapping[str, Floats], first: int) -> Results:
        if self.follow is not None:
            return self.follow.block(part, self.reductions, self.threads, self.backend)
        if self.program.fields or self.program.states:
            return self._loaded(part, first)
        return self._reduced(self.program, part, {})

    def _loaded(self, part: Mapping[str, Floats], first: int) -> Results:
        """Two passes: the motion of each design and what its loads are, then the summaries of the block."""
        from linkwright.engine.states import states_as_fields

        program = states_as_fields(self.program) if self.program.states else self.program
        rows, failed = fields_of_designs(self.traced, program.fields, part)
        self.unloaded.update({first + index: sentence for index, sentence in failed.items()})
        return self._reduced(program, part, rows)

    def _reduced(self, program: Program, part: Mapping[str, Floats], rows: Mapping[str, Floats]) -> Results:
        return engine_sweep(
            program,
            self.traced.table(program, part),
            self.positions.arrays,
            self.reductions,
            fields=rows,
            valid=VALID,
            threads=self.threads,
            backend=self.backend,
        )


def with_values(mechanism: Mechanism, columns: Mapping[str, Floats], index: int) -> Mechanism:
    """One of the designs."""
    changed = mechanism.with_dimensions(
        {address: float(column[index]) for address, column in columns.items()}
    )
    return replace(changed, name=mechanism.name)
