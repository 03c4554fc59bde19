"""Parameter studies: designs over a grid or a Sobol sequence, with any metrics."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from linkwright.analysis.by_name import Asked, ask
from linkwright.analysis.evaluate import unloaded
from linkwright.analysis.outputs import usual_output
from linkwright.core.arguments import STEPS, require
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.data import Frozen
from linkwright.core.progress import Progress, current_progress, part_of
from linkwright.core.table import Table, Tabular, csv_text, unused
from linkwright.designs.alternatives import Alternative
from linkwright.designs.checkpoints import identity
from linkwright.designs.cluster import current, in_turn
from linkwright.designs.criteria import Criterion, criteria
from linkwright.designs.failures import Failure
from linkwright.designs.metrics_of_designs import numbers_of
from linkwright.designs.ranges import Range, grid, sobol
from linkwright.designs.sweep import sweep
from linkwright.designs.varied_dimensions import varied_ranges
from linkwright.errors import LinkwrightError, RequestError, with_remedy
from linkwright.files.write import dump
from linkwright.kinematics.names import place_meant
from linkwright.machine.flywheel import FLUCTUATION, flywheel_inertia
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.units import si_unit
from linkwright.words import _

Sampling = Literal["grid", "sobol"]
_Piece = tuple[dict[str, Floats], dict[str, str], dict[str, None], dict[int, str]]

#: Fewer designs than this are solved one by one; designs that a worker of a cluster takes at a time.
FEW, PIECE = 8, 512
#: Designs whose metrics are computed at once before they are stored.
AT_ONCE = 8192
#: What is measured when nobody says what, as far as it applies.
USUAL = ("travel", "transmission_angle", "peak_input_torque", "rms_input_torque", "peak_reaction")


@dataclass(eq=False)
class Study(PlotMixin, Tabular, Frozen):
    """Metrics of many designs; arrays (designs,), SI, NaN where a design cannot move or a metric does not apply.

    ``ranges``: what varies; ``varied``: its values by address; ``metrics``: values by name; ``dimensions``: names of
    their dimensions; ``ok``: which designs pass the cycle; ``failures``: how many do not, at which group, and why.
    """

    mechanism: Mechanism
    ranges: tuple[Range, ...]
    varied: Mapping[str, Floats]
    metrics: Mapping[str, Floats]
    dimensions: Mapping[str, str]
    better: Mapping[str, str | None]
    ok: Flags
    failures: tuple[Failure, ...]
    sampling: str = "grid"
    notes: tuple[str, ...] = field(default=())

    @property
    def designs(self) -> int:
        """Number of designs."""
        return len(self.ok)

    def __getitem__(self, name: str) -> Floats:
        """Values of a metric or of a varied dimension, (designs,)."""
        for columns in (self.metrics, self.varied):
            if name in columns:
                return columns[name]
        hint = offered(name, [*self.metrics, *self.varied])
        raise RequestError(with_remedy(_("{name!r} is not in the study", code="study.not_in_study", name=name), hint))

    def best(self, metric: str) -> int:
        """Number of the design that is best in a metric.

        Raises LinkwrightError for a metric that has no better direction, or no value in any design.
        """
        values, better = self[metric], self.better.get(metric)
        if better is None:
            raise RequestError(
                _(
                    "{metric!r} has no better direction, so no design is best in it",
                    code="study.no_best",
                    metric=metric,
                )
            )
        if not np.isfinite(values).any():
            raise LinkwrightError(
                _("{metric!r} has no value in any of the designs", code="study.no_value", metric=metric)
            )
        sizes = np.abs(values)
        return int(np.nanargmax(sizes) if better == "higher" else np.nanargmin(sizes))

    def design(self, index: int) -> Mechanism:
        """One of the designs as a mechanism."""
        return self.mechanism.with_dimensions({a: float(c[index]) for a, c in self.varied.items()})

    def columns(self) -> dict[str, Floats]:
        """Varied dimensions and metrics by name with their SI unit."""
        found = {f"{each.address}": np.asarray(self.varied[each.address]) for each in self.ranges}
        for name, values in self.metrics.items():
            unit = si_unit(self.dimensions[name])
            found[unused(f"{name} [{unit}]" if unit else name, found)] = np.asarray(values)
        return found

    @attached
    def tables(self, language: str = "en", rows: int = 40) -> tuple[Table, ...]:
        """The designs (all, or ``rows`` of them evenly chosen), the best ones, and what failed."""
        raise NotImplementedError

    def csv(self) -> str:
        """The columns as CSV, SI; numbers to the last bit."""
        return csv_text(self.columns())

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        return {
            "name": self.mechanism.name,
            "sampling": self.sampling,
            "designs": self.designs,
            "movable": int(self.ok.sum()),
            "varied": {address: values.tolist() for address, values in self.varied.items()},
            "units": {each.address: each.si for each in self.ranges},
            "metrics": {
                name: {"unit": si_unit(self.dimensions[name]), "better": self.better[name], "values": values.tolist()}
                for name, values in self.metrics.items()
            },
            "best": {name: self.best(name) for name in self.metrics if self.has_best(name)},
            "failures": [
                {
                    "group": f.group,
                    "kind": f.kind,
                    "count": f.count,
                    "designs": f.designs.tolist(),
                    "example": f.example,
                }
                for f in self.failures
            ],
        }

    def has_best(self, name: str) -> bool:
        """Whether one design is best in a metric."""
        return self.better[name] is not None and bool(np.isfinite(self.metrics[name]).any())

    def __repr__(self) -> str:
        return (
            f"Study({self.mechanism.name!r}: {self.designs} designs, {int(self.ok.sum())} can move; "
            f"{', '.join(self.columns())})"
        )


def study(
    mechanism: Mechanism,
    vary: Mapping[str, str | ArrayLike],
    *,
    metrics: Iterable[str] | str | None = None,
    sampling: Sampling = "grid",
    samples: int = 64,
    seed: int = 0,
    output: str | None = None,
    fluctuation: float = FLUCTUATION,
    steps: int = STEPS,
    progress: Progress | None = None,
) -> Study:
    """Metrics of the designs that come from varying some dimensions.

    Args:
        mechanism: the design to start from.
        vary: by address of a dimension or name of a parameter, a range ``1.2..1.3 m:11`` (from, to, number of
            values), values ``1.2, 1.25, 1.3 m``, or numbers in SI.
        metrics: registered metrics, ``travel``, ``flywheel`` and the others of :func:`compare`, or summaries
            of outputs (``driver.effort rms``), which are computed for all designs at once. None: the usual ones.
        sampling: ``grid``: every combination; ``sobol``: ``samples`` designs between the ends of the ranges, spread
            evenly (needs scipy).
        samples, seed: of the Sobol sequence.
        output: the link or guide whose travel counts; None: the last one solved.
        fluctuation: coefficient of speed fluctuation δ for flywheels.
        steps: positions over the cycle.
        progress: called with (designs done, designs); what it raises stops the study.

    Returns:
        The study; designs that cannot move are counted and explained, the others go on.

    Raises:
        LinkwrightError: an unknown parameter or metric (nearest ones offered), a text that is no range, or none of
            the designs can move (how many fail, at which group, why).
    """
    require(mechanism, Mechanism)
    flywheel_inertia(1.0, 1.0, fluctuation)
    ranges = varied_ranges(mechanism, vary, sampled=sampling != "grid")
    columns = grid(ranges) if sampling == "grid" else sobol(ranges, samples, seed, sampling)
    work = _Work(mechanism, columns, _criteria(mechanism, metrics), output, fluctuation, steps, progress)
    return work.study(ranges, sampling, usual=metrics is None)


def _criteria(mechanism: Mechanism, metrics: Iterable[str] | str | None) -> list[Criterion]:
    if metrics is not None:
        return criteria(metrics)
    return [each for each in criteria(USUAL) if mechanism.has_loads or not each.forces]


class _Work:
    """One study: which designs pass by one sweep, then their numbers."""

    def __init__(
        self,
        mechanism: Mechanism,
        columns: Mapping[str, Floats],
        asked: list[Criterion],
        output: str | None,
        fluctuation: float,
        steps: int,
        progress: Progress | None,
    ) -> None:
        self.mechanism, self.columns, self.asked = mechanism, columns, asked
        self.fluctuation, self.steps, self.progress = fluctuation, steps, progress or current_progress()
        self.output = usual_output(mechanism) if output is None else place_meant(mechanism, output)
        self.count = len(next(iter(columns.values())))
        self.values = {each.name: np.full(self.count, np.nan) for each in asked}
        self.dimensions = {each.name: "dimensionless" for each in asked}
        self.notes: dict[str, None] = {}
        self.troubled: dict[int, str] = {}

    def study(self, ranges: tuple[Range, ...], sampling: str, *, usual: bool) -> Study:
        probe = ["closeness min" if self._closed() else self._any_output()]
        first = part_of(self.progress, 0, 2)
        found = sweep(self.mechanism, self.columns, outputs=probe, steps=self.steps, progress=first)
        self.progress = part_of(self.progress, 1, 2)
        ok = found.ok.copy()
        if not ok.any():
            raise LinkwrightError(_none_moves(self.count, found.failures()))
        client, designs = current(), np.flatnonzero(ok)
        if client is not None and len(designs) > PIECE:
            self._shared(client, self.asked, designs)
        else:
            self.found(self.asked, designs, len(designs) >= FEW)
        failures = [*found.failures(), *self._troubles()]
        ok[list(self.troubled)] = False
        if not ok.any():
            raise LinkwrightError(_none_moves(self.count, failures))
        if usual:
            self._leave_out_idle(ok)
        self._refuse_idle(ok)
        better = {each.name: each.better for each in self.asked}
        return Study(
            self.mechanism,
            ranges,
            self.columns,
            self.values,
            self.dimensions,
            better,
            ok,
            tuple(failures),
            sampling,
            (*found.of_motion, *self.notes),
        )

    def found(self, asked: list[Criterion], designs: Indices, together: bool) -> None:
        """Numbers of the designs, at once as far as they are certain so (``together``), the others one by one."""
        names = {each.name: each for each in asked}
        found = numbers_of(
            self.mechanism,
            self.columns,
            [*names],
            designs,
            lambda changes, some: self._measured(changes, [names[each] for each in some]),
            (str(self.output), self.fluctuation, self.steps),
            asked=Asked(self.output, self.fluctuation),
            together=together,
            progress=self.progress,
        )
        for name, values in found.values.items():
            self.values[name][designs] = values[designs]
        self.dimensions |= found.dimensions
        self.troubled |= found.troubled
        self.notes |= found.notes

    def _shared(self, client: Any, asked: list[Criterion], designs: Indices) -> None:
        """The same in pieces on a cluster."""
        parts = [designs[first : first + PIECE] for first in range(0, len(designs), PIECE)]
        columns = ({a: c[part] for a, c in self.columns.items()} for part in parts)
        rest = [each.name for each in asked], str(self.output), self.fluctuation, self.steps
        tasks = [(self.mechanism, each, *rest) for each in columns]
        pieces: dict[int, _Piece] = {}
        for done, (number, piece) in enumerate(in_turn(client, _piece, tasks, self._own), 1):
            pieces[number] = piece
            if self.progress is not None:
                self.progress(len(designs) * done // len(parts), len(designs))
        for number, part in enumerate(parts):
            values, dimensions, notes, troubled = pieces[number]
            for name in rest[0]:
                self.values[name][part] = values[name]
            self.dimensions |= {name: kind for name, kind in dimensions.items() if kind != "dimensionless"}
            self.notes |= notes
            self.troubled |= {int(part[index]): why for index, why in troubled.items()}

    @cached_property
    def _own(self) -> str:
        """What the numbers of all designs depend on."""
        return identity(dump(replace(self.mechanism, optimize={})), str(self.output), self.fluctuation, self.steps)

    def _closed(self) -> bool:
        """Whether there is a group with a closed form."""
        from linkwright.kinematics.groups import dyad_shape
        from linkwright.topology import structure

        return any(group.cuts and dyad_shape(group) is not None for group in structure(self.mechanism).groups)

    def _any_output(self) -> str:
        return f"{list(self.mechanism.links)[-1]}.angular_velocity max"

    def _measured(
        self, changes: dict[str, float], asked: list[Criterion]
    ) -> tuple[dict[str, tuple[float, str]], str, list[str]]:
        """Numbers with their dimensions, why others are missing, and notes."""
        design, numbers, troubled = (self.mechanism.with_dimensions(changes), dict[str, tuple[float, str]](), "")
        each = Alternative(design.name, design, self.output, self.steps, self.fluctuation)
        with suppress(LinkwrightError):  # where nothing is solved, measuring tells
            ask((criterion.name for criterion in asked), each.analysis, each.asked)
        for criterion in asked:
            try:
                found = criterion.measure(each)
            except RequestError:
                raise
            except LinkwrightError as error:
                troubled = troubled or error.sentence
                continue
            if found is not None:
                numbers[criterion.name] = found.value, found.dimension
        return numbers, troubled, [*each.notes]

    def _leave_out_idle(self, ok: Flags) -> None:
        """Leaves out what nobody asked for and none of the designs that move has."""
        found = {name: values for name, values in self.values.items() if not np.isnan(values[ok]).all()}
        self.values = found or self.values

    def _refuse_idle(self, ok: Flags) -> None:
        """Raises for a metric that has a value for none of the designs that move."""
        for name, values in self.values.items():
            if np.isnan(values[ok]).all():
                if (missing := unloaded(self.mechanism, [name])) is not None:
                    raise RequestError(missing)
                message = _(
                    "{name!r} does not apply to {mechanism!r}",
                    code="study.does_not_apply",
                    name=name,
                    mechanism=self.mechanism.name,
                )
                if self.notes:
                    raise RequestError(_("{name}: {cause}", name=message, cause=list(self.notes)))
                raise RequestError(with_remedy(message, _("leave it out", code="study.leave_out")))

    def _troubles(self) -> list[Failure]:
        """Designs for which a metric could not be found."""
        if not self.troubled:
            return []
        numbers = np.array(sorted(self.troubled), dtype=np.intp)
        return [Failure(None, "metric", numbers, self.troubled[int(numbers[0])])]


def _piece(
    mechanism: Mechanism, columns: Mapping[str, Floats], names: list[str], output: str, fluctuation: float, steps: int
) -> _Piece:
    """Numbers of some designs, on a worker of a cluster: values, dimensions, notes, and what is wrong with which."""
    asked = criteria(names)
    work = _Work(mechanism, columns, asked, output, fluctuation, steps, None)
    work.found(asked, np.arange(work.count), True)
    return work.values, work.dimensions, work.notes, work.troubled


def _none_moves(count: int, failures: Iterable[Failure]) -> str:
    causes = [
        (
            _("{count} fails {place}, such as: {example}")
            if f.count == 1
            else _("{count} fail {place}, such as: {example}", code="study.fail")
        ).format(count=f.count, place=f.place, example=f.example)
        for f in failures
    ]
    return _(
        "none of the {count} designs can pass its cycle: {causes}; widen or move the ranges",
        code="study.none_passes",
        count=count,
        causes=causes,
    )
