"""Range of the input in which the mechanism can be assembled, its dead points; stroke of a block, swing of a link."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from itertools import chain

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Number, Remark
from linkwright.analysis.limit_positions import outermost_limits
from linkwright.analysis.outputs import output_link, turns_fully
from linkwright.analysis.transmission_angle import smallest
from linkwright.core.outputs import Output
from linkwright.core.quantity import shown
from linkwright.core.search import zeros
from linkwright.cycle.summaries import Summary
from linkwright.drivers.base import Law
from linkwright.formula.trace import Scalar, floor
from linkwright.kinetostatics.closure import dyads
from linkwright.words import _

#: Transmission angle, rad, below which a position counts as a dead point.
DEAD = 1e-6
#: Share of its largest rate below which a driver is at rest.
STILL = 1e-9
#: Places of a time, and of every formula of a driver's law in it, between which it turns back once at most.
LOOKS, WITHIN = 721, 14


def between(first: float, last: float, dimension: str) -> Remark:
    """The ends of a stretch of the input as a remark."""
    sentence = _("from {start} to {end}", start=shown(first, dimension), end=shown(last, dimension))
    return Remark("range_of_motion.from_to", sentence)


def reached_inputs(analysis: Analysis, start: float, end: float) -> tuple[float, float]:
    """Coordinates of the first driver between which it moves in a stretch of time, in the order of the motion where
    it does not turn back."""
    law = next(iter(analysis.motion.mechanism.drivers.values())).law
    if law.constant_speed is not None:
        return law.at(start), law.at(end)
    values = [value for _, value in turns(law, start, end)]
    lowest, highest = min(values), max(values)
    return (highest, lowest) if values[0] == highest and values[-1] == lowest else (lowest, highest)


def turns(law: Law, start: float, end: float) -> list[tuple[float, float]]:
    """Times, s, at which a driver begins, turns back, and ends, with its place there."""
    edges = np.concatenate([[start], law.breaks(start, end), [end]])
    within = (edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(0.0, 1.0, WITHIN)).ravel()
    time = np.unique(np.append(np.linspace(start, end, LOOKS), within))
    sign = np.sign(law.coordinate(time)[1])
    back = np.flatnonzero(sign[:-1] * sign[1:] < 0.0)
    at = zeros(lambda t: law.coordinate(t)[1:], time[back], time[back + 1], sign[back])
    times = np.sort(np.concatenate([time[sign == 0.0], at, [start, end]]))
    return list(zip(times.tolist(), law.coordinate(times)[0].tolist(), strict=True))


def _drives(analysis: Analysis, time: float) -> bool:
    """Whether the one driver moves at a time, so that an output at rest is one that could not drive."""
    laws = [driver.law for driver in analysis.motion.mechanism.drivers.values()]
    if len(laws) != 1 or laws[0].constant_speed is not None:
        return len(laws) == 1 and bool(laws[0].constant_speed)
    rates = np.abs(laws[0].coordinate(np.append(analysis.motion.time, time))[1])
    return bool(rates[-1] > STILL * rates.max())


@METRICS.register("range_of_motion")
class RangeOfMotion(Metric):
    """Extent of every stretch of the input, within the cycle, in which the mechanism can be assembled."""

    label = _("range of motion of the input")
    meaning = _("Extent of the input within the cycle over which the mechanism can be assembled.")

    dimension = "angle"
    source = "assembly of the Assur groups; ends by halving"
    input_ranges = True

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.motion.steps > 1 and analysis.resolver.possible

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        subject, kind = next(iter(analysis.motion.mechanism.drivers)), analysis.input_dimension
        for start, end in analysis.resolver.stretches:
            first, last = reached_inputs(analysis, start, end)
            remarks = (between(first, last, kind),)
            yield self.value(analysis, subject, abs(last - first), dimension=kind, at=first, remarks=remarks)


@METRICS.register("dead_point")
class DeadPoint(Metric):
    """Inputs at which a driver cannot move the machine: ends of range, change points, transmission angles of zero.

    And, for each output of a machine with one driver, the inputs at which that output could not drive it: where the
    output turns back while the driver goes on.
    """

    label = _("dead point")
    meaning = _("Input at which a driving link cannot move the mechanism.")

    dimension = "angle"
    source = "IFToMM terminology: transmission angle zero"
    own_values = True

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        """Those of outputs in their outermost limit positions, where one driver turns steadily through the cycle."""
        drivers, period = (list(analysis.motion.mechanism.drivers.values()), analysis.motion.positions.period or 0.0)
        if len(drivers) != 1 or (speed := drivers[0].law.constant_speed) is None:
            return
        within = partial(_within, float(analysis.motion.input[0]), speed * period)
        for output, kind, passed_over in outermost_limits(analysis):
            place = Summary(output.name, f"arg{kind}")
            yield Number(f"{output} {kind}", (place,), within, analysis.input_dimension, passed_over=passed_over)

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        driver, kind = next(iter(analysis.motion.mechanism.drivers)), analysis.input_dimension
        for q, subject in _distinct((q, driver) for q in self._of_driver(analysis)):
            remarks = (
                Remark(
                    "dead_point.driver",
                    _("the driver cannot move the mechanism at {at}", at=shown(q, kind)),
                    warning=True,
                ),
            )
            yield self.value(analysis, subject, q, dimension=kind, at=q, remarks=remarks)
        for output in analysis.outputs:
            link = output_link(analysis.motion.mechanism, output)
            found = [limit for limit in analysis.limits(output) if _drives(analysis, limit.time)]
            sides = ([limit for limit in found if limit.kind == kind] for kind in ("max", "min"))
            places = (_distinct((each.input, f"{output} {each.kind}") for each in side) for side in sides)
            for q, subject in chain.from_iterable(places):
                remarks = (
                    Remark(
                        "dead_point.output",
                        _(
                            "if {output} were to drive, it could not move the mechanism at {at}",
                            at=shown(q, kind),
                            output=link,
                        ),
                    ),
                )
                yield self.value(analysis, subject, q, dimension=kind, at=q, remarks=remarks)

    def _of_driver(self, analysis: Analysis) -> Iterator[float]:
        if not analysis.resolver.possible:
            return
        for time in (*(time for time, _unused in analysis.resolver.edges), *analysis.resolver.changes.tolist()):
            yield analysis.resolver.input_at(time)
        for group in dyads(analysis.motion.structure):
            low = analysis.part(smallest(group))
            if low.value < DEAD:
                yield low.input


def _within(first: float, cycle: float, place: Scalar) -> Scalar:
    """The same place in the turn of the input that begins at ``first``."""
    share = (place - first) / cycle
    return first + cycle * (share - floor(share))


def _distinct(places: Iterable[tuple[float, str]]) -> Iterator[tuple[float, str]]:
    """Inputs with their subjects in order, those within 1e-6 of the one before left out."""
    before = -np.inf
    for place, subject in sorted(places):
        if place - before > 1e-6:
            yield place, subject
        before = place


@METRICS.register("stroke")
class Stroke(Metric):
    """Travel of every block on the frame between its outermost positions, m."""

    label = _("stroke")
    meaning = _("Travel of a block between its outermost positions.")

    rank = 1
    dimension = "length"
    source = "IFToMM terminology: travel between limit positions"
    kind = "displacement"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(self._swinging(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for output in self._swinging(analysis):
            yield Number(str(output), (Summary(output.name, "range"),))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        """Those of a machine that reaches several stretches are of each of them."""
        stretches = analysis.resolver.stretches if analysis.partial else ()
        if len(stretches) < 2 or analysis.ways is None:
            yield from super().values(analysis)
            return
        for output in self._swinging(analysis):
            for (way, exact), stretch in zip(analysis.ranges(output), stretches, strict=True):
                remarks = (between(*reached_inputs(analysis, *stretch), analysis.input_dimension),)
                yield self.value(analysis, str(output), way, exact=exact, remarks=remarks)

    def _swinging(self, analysis: Analysis) -> list[Output]:
        motion = analysis.motion
        return [o for o in analysis.outputs if o.kind == self.kind and motion.ok.any() and not turns_fully(motion, o)]


@METRICS.register("swing_angle")
class SwingAngle(Stroke):
    """Angle between the outermost positions of every link that swings about the frame, rad."""

    label = _("swing angle")
    meaning = _("Angle of a link between its outermost positions.")

    dimension = "angle"
    kind = "angle"
