"""Many designs of one mechanism at once: summaries of outputs over the cycle, in fixed memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.by_name import wanted
from linkwright.core.arguments import STEPS, integer, one_of, require
from linkwright.core.arrays import Flags, Floats, Integers
from linkwright.core.attached import PlotMixin
from linkwright.core.data import Frozen
from linkwright.core.progress import Progress, current_progress, part_of
from linkwright.core.quantity import shown
from linkwright.core.table import Table, Tabular, columns_table, unused
from linkwright.cycle.summaries import Summary
from linkwright.designs.cluster import current, in_order, in_turn
from linkwright.designs.failures import Failure, explained
from linkwright.designs.metrics_of_designs import OF_VALUES, swept_numbers
from linkwright.designs.sweep_run import Manner, SweepRun
from linkwright.designs.varied_dimensions import design_values, refuse_moved_positions
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.summaries import BACKENDS, Backend
from linkwright.formula.threads import chunks
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: Designs of a piece that goes to a cluster; fewer stay on this machine.
SHARED = 4096
#: What a piece finds: positions assembled, designs that pass, summaries, sentences of designs, margins, dimensions of
#: numbers.
_Piece = tuple[Integers, Flags, list[Floats], dict[int, str], Floats | None, dict[str, str]]


@dataclass(eq=False)
class Sweep(PlotMixin, Tabular, Frozen):
    """Summaries of many designs; arrays are (designs,), SI.

    ``varied``: values of the varied dimensions; ``assembled``: number of ``positions`` at which each design can be
    put together, or with ``partial`` that it reaches on its way from the first of them, as ``Motion.ok`` counts;
    ``ok``: which designs pass the full cycle, (designs,);
    ``result["driver.effort", "rms"]`` or ``result["driver.effort rms"]`` a summary, NaN for designs
    that do not pass the full cycle (unless ``partial`` was asked for). Where ``steps`` were given, those of outputs
    are of these positions, and ``notes`` says how far they are off. ``branch_margin`` (designs,): how far the
    step nearest to another assembly was from being refused, 1 far, 0 at the edge, where groups without closed form
    are tracked (their steps keep the determinant's sign, the correction small and both ends' exact rates on one
    curve); None where all groups have a closed form.
    """

    mechanism: Mechanism
    varied: Mapping[str, Floats]
    positions: int
    steps: int | None
    assembled: Integers
    ok: Flags
    summaries: Mapping[Summary, Floats]
    quantities: Mapping[str, Quantity] = field(repr=False)
    unloaded: Mapping[int, str] = field(default_factory=dict)
    of_motion: tuple[str, ...] = field(default=(), repr=False)
    branch_margin: Floats | None = None
    dimensions: Mapping[str, str] = field(default_factory=dict, repr=False)

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """Notes on the machine as it is: on its motion, and how far summaries of the positions are off."""
        if self.steps is None:
            return self.of_motion
        kinds = (self.dimension(each) for each in self.summaries)
        position_note = note_of_positions(self.mechanism, self.steps, self.summaries, kinds)
        return self.of_motion if position_note is None else (*self.of_motion, position_note)

    @property
    def designs(self) -> int:
        """Number of designs."""
        return len(self.assembled)

    def __getitem__(self, key: str | tuple[str, str]) -> Floats:
        """A summary (designs,), by output and kind."""
        (found, *more) = wanted([key])
        if found not in self.summaries or more:
            raise RequestError(
                _(
                    "{summary!r} was not asked for; there is {summaries}",
                    code="study.not_asked",
                    summary=key,
                    summaries=tuple(s.name for s in self.summaries),
                )
            )
        return self.summaries[found]

    def columns(self) -> dict[str, Floats | Integers]:
        """Varied dimensions, assembled positions and summaries by name."""
        found: dict[str, Floats | Integers] = {**self.varied}
        found[unused("assembled", found)] = self.assembled
        for summary, values in self.summaries.items():
            found[unused(summary.name, found)] = values
        return found

    def dimension(self, summary: Summary) -> str:
        """Name of the dimension of a summary's values; an extreme's place has the input's."""
        if not summary.kind:
            return self.dimensions[summary.output]
        if summary.kind in ("argmin", "argmax"):
            rotary = next(iter(over_cycle(self.mechanism, 1).rotary.values()))
            return "angle" if rotary else "length"
        return self.quantities[summary.output].dimension

    def failures(self, limit: int = 1_000_000) -> tuple[Failure, ...]:
        """Why designs cannot move: how many fail first at which group, with an example in a sentence.

        At most ``limit`` failing designs are looked at.
        """
        return explained(self.mechanism, self.varied, self.ok, self.positions, self.unloaded, limit)

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The first designs, SI."""
        return (columns_table(self.mechanism.name, self.columns(), self.notes),)

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        columns = {name: values.tolist() for name, values in self.columns().items()}
        return {"name": self.mechanism.name, "designs": self.designs, "columns": columns, "notes": list(self.notes)}

    def __repr__(self) -> str:
        passing = int(self.ok.sum())
        names = ", ".join(self.columns())
        return f"Sweep({self.mechanism.name!r}: {self.designs} designs, {passing} pass the cycle; {names})"


def sweep(
    mechanism: Mechanism,
    vary: Mapping[str, ArrayLike],
    *,
    outputs: Iterable[str | tuple[str, str]],
    steps: int | None = None,
    partial: bool = False,
    threads: int | None = None,
    backend: Backend = "auto",
    progress: Progress | None = None,
) -> Sweep:
    """Summaries over the cycle of many designs of one mechanism, the numbers of :func:`metrics` and :func:`study`.

    Args:
        mechanism: the design to start from; its assembly modes hold for all.
        vary: values (designs,), SI, by address of a dimension (``pitman.length``) or name of a parameter.
        outputs: pairs (output, kind), or texts ``output kind``. Outputs: ``C.x``, ``C.velocity`` (size),
            ``C.velocity.x``, ``jaw.angle``, ``jaw.angular_velocity``, ``guide.displacement``, ``reaction O5 on jaw``,
            ``couple guide on slider``, ``driver.effort``, ``input_torque``, ``power``, ``shaking_force``,
            ``closeness`` (to a singular position, 0 there), ``transmission_angle B``. Kinds: min, max, mean, rms,
            range, peak, argmin, argmax (see :class:`Summary`). Metrics as well, with a subject if wanted:
            ``rms_input_torque``, ``peak_reaction O5``; those that are no formulas of such summaries
            (``double_point``, ``range_of_motion``) are found one by one.
        steps: None for summaries of the cycle, exact between positions. A number for those of so many positions, off
            by some 1e-4 of smooth outputs, by percents where a load switches on between two of them
            (:attr:`Sweep.notes` says how far for the machine as it is), in a fraction of the time where nothing but
            the motion is asked. Metrics are exact in both.
        partial: keep numbers of what designs reach of the cycle, where they do not reach all, each found by itself;
            of positions from the first one on that it can be in.
        threads: None for all cores; results do not depend on it.
        backend: ``numpy``, ``llvm`` (compiled), or ``auto``.
        progress: called with (designs done, designs); what it raises stops the sweep.

    Raises:
        LinkwrightError: unknown names (nearest ones offered), values that no design can have, dimensions that
            change the drive's law.

    A dimension that changes the positions of the input is refused. Friction near locking or in more than 16 pairs of
    one group, loads that divide by an output or follow a link that turns through, and motion through change points
    are found design by design, in milliseconds each.
    """
    require(mechanism, Mechanism)
    one_of("backend", backend, BACKENDS)
    threads = None if threads is None else integer("threads", threads, 1)
    positions = over_cycle(mechanism, STEPS if steps is None else steps)
    columns = design_values(mechanism, vary)
    refuse_moved_positions(mechanism, positions, columns)
    asked = wanted(outputs)
    client = current()
    sampled = steps is not None or not mechanism.drivers  # which rests in one position
    numbers = [each.name for each in asked if not (sampled and each.kind)]
    progress = progress or current_progress()
    stages = 1 + bool(numbers)
    manner = Manner(partial, threads, backend, part_of(progress, 0, stages), sampled)
    run = SweepRun(mechanism, columns, tuple(each for each in asked if each.kind), positions, manner)
    if client is not None and run.designs > SHARED:
        return _shared(client, run, asked, steps)
    assembled, passed, values = run.swept()
    dimensions: dict[str, str] = {}
    if numbers:
        chosen = np.flatnonzero(assembled > 0 if partial else passed)
        found = swept_numbers(
            mechanism,
            columns,
            numbers,
            chosen,
            in_part=partial,
            threads=threads,
            backend=backend,
            progress=part_of(progress, 1, stages),
        )
        dimensions = found.dimensions
        values |= {each: found.values[each.name] for each in asked if each.name in found.values}
        run.unloaded |= found.troubled
        passed[list(found.troubled)] = False
    return Sweep(
        mechanism,
        columns,
        positions.count,
        steps,
        assembled,
        passed,
        {each: values[each] for each in asked},
        run.quantities,
        run.unloaded,
        run.traced.nominal.notes,
        run.margins,
        dimensions,
    )


def _shared(client: Any, run: SweepRun, asked: Sequence[Summary], steps: int | None) -> Sweep:
    """The same sweep in pieces on a cluster."""
    places, tasks = _tasks(run, [each.name for each in asked], steps, run.manner.partial, run.manner.backend)
    found: dict[int, _Piece] = {}
    for number, piece in in_turn(client, _piece, tasks, run.own):
        found[number] = piece
        run.tell(run.designs * len(found) // len(tasks))
    assembled, passed, summaries, unloaded, margins, dimensions = zip(*map(found.get, range(len(tasks))), strict=True)
    return Sweep(
        run.mechanism,
        run.columns,
        run.positions.count,
        steps,
        np.concatenate(assembled),
        np.concatenate(passed),
        dict(zip(asked, map(np.concatenate, zip(*summaries, strict=True)), strict=True)),
        run.quantities,
        {each.start + k: why for each, some in zip(places, unloaded, strict=True) for k, why in some.items()},
        run.traced.nominal.notes,
        None if margins[0] is None else np.concatenate(margins),
        {name: kind for each in dimensions for name, kind in each.items()},
    )


def _tasks(run: SweepRun, *rest: object) -> tuple[list[slice], list[tuple[Any, ...]]]:
    """Which designs go to a cluster together, and what it takes to compute them."""
    places = [slice(*ends) for ends in chunks(run.designs, SHARED)]
    parts = ({a: np.array(c[each]) for a, c in run.columns.items()} for each in places)
    return places, [(run.mechanism, part, *rest) for part in parts]


def _piece(
    mechanism: Mechanism,
    columns: Mapping[str, Floats],
    outputs: list[str],
    steps: int | None,
    partial: bool,
    backend: Backend,
) -> _Piece:
    """What a sweep of some designs finds, on a worker of a cluster."""
    found = sweep(mechanism, columns, outputs=outputs, steps=steps, partial=partial, threads=1, backend=backend)
    summaries, unloaded, dimensions = ([*found.summaries.values()], dict(found.unloaded), dict(found.dimensions))
    return found.assembled, found.ok, summaries, unloaded, found.branch_margin, dimensions


def sweep_curves(
    mechanism: Mechanism,
    vary: Mapping[str, ArrayLike],
    *,
    outputs: Sequence[str],
    steps: int = STEPS,
    threads: int | None = None,
    backend: Backend = "auto",
    progress: Progress | None = None,
) -> Iterator[tuple[slice, dict[str, Floats]]]:
    """Outputs of many designs over the positions, a few thousand designs at a time: (designs, n) by name, SI.

    Arguments and errors as for :func:`sweep`; curves of designs that do not pass the full cycle are NaN.
    """
    positions = over_cycle(mechanism, steps)
    columns = design_values(mechanism, vary)
    refuse_moved_positions(mechanism, positions, columns)
    asked = wanted([(output, "max") for output in outputs])
    client = current()
    run = SweepRun(mechanism, columns, asked, positions, Manner(False, threads, backend, progress))
    if client is not None and run.designs > SHARED:
        return _shared_curves(client, run, [*outputs], steps)
    return run.curves(outputs)


def _shared_curves(
    client: Any, run: SweepRun, outputs: list[str], steps: int
) -> Iterator[tuple[slice, dict[str, Floats]]]:
    """The same curves in pieces on a cluster, in the designs' order."""
    places, tasks = _tasks(run, outputs, steps, run.manner.backend)
    yield from zip(places, in_order(client, _curves, tasks, run.own), strict=True)


def _curves(
    mechanism: Mechanism, columns: Mapping[str, Floats], outputs: list[str], steps: int, backend: Backend
) -> dict[str, Floats]:
    """The curves of at most ``SHARED`` designs, which are one block."""
    ((_unused, found),) = sweep_curves(mechanism, columns, outputs=outputs, steps=steps, threads=1, backend=backend)
    return found


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
