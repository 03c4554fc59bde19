"""Limit positions: where an output reverses, to machine precision in the input.

Sign changes of the exact rate bracket the limits; Newton's steps with the exact acceleration as derivative,
kept inside their brackets, refine all of them at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.cached_property import cached_property
from linkwright.core.dataclass import dataclass
from linkwright.core.given import require
from linkwright.core.outputs import Output, kind_of, row_name
from linkwright.core.search import ends, zero, zeros
from linkwright.engine.recently_made import Recent
from linkwright.kinematics.bends import FAR, one_formula, stretches, with_leaps
from linkwright.kinematics.between_positions import Between
from linkwright.kinematics.brackets import Bracket, Columns, part_of, places_of, which_dip, zero_between
from linkwright.kinematics.motion import TURN, Motion
from linkwright.kinematics.names import output_of, program_names
from linkwright.kinematics.reached_stretches import Reach
from linkwright.loads.signals import Limit

#: Rates below this share of the output's largest one, or of that of the whole mechanism, are rounding errors of zero.
STILL, STILL_BESIDE = 1e-12, 1e-15
#: The same beside the mechanism's, where cams or laws let an output rest while what moves them leaves its digits.
STILL_IN_RESTS = 1e-13
#: The same as share of the output's largest one at the end of a rest, where what is met from beside may be.
STILL_AT_BENDS = 1e-10
#: An output whose largest rate is below this share of the mechanism's does not move.
CONSTANT = 1e-10
#: Below this quality of a group rounding hides where a rate is zero: the limit is put on the change point.
BLURRED = 1e-10
#: Where a group cannot be computed at its change point, the mean from this share of a step on both sides is taken.
BESIDE = 1e-4
#: Shares of a stretch that is reached, at whose ends outputs come with infinite rates.
NEARING = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 386)[1:-1])
#: A way back of less than this share of the travel is what the digits of a table leave open, not a reversal.
LEAST_WAY = 1e-7


@dataclass(frozen=True)
class LimitPosition(Limit):
    """A reversal of an output.

    ``input``: the first driver's coordinate (rad or m); ``time`` s; ``value`` of the output (rad or m); ``kind``
    ``max`` or ``min`` (a reversal from growing to falling as time goes on, or the other way); ``index``: the
    last position of the motion before it, or at it.
    """

    index: int


def limit_positions(motion: Motion, output: Output | str) -> tuple[LimitPosition, ...]:
    """All positions within a motion where an output's rate is zero and changes its sign, in order of the motion.

    Exact to rounding in the input, independent of the steps, as long as at most two reversals lie between two
    neighbouring positions, or within a sixth of a turn of a driver and of what wheels turn with it. In a closed
    cycle the way from the last position to the first counts as well; the ends of an open one are no limits, nor is
    a rate that touches zero without changing its sign. Of a rest between opposite motions the middle is given. A
    way there and back of less than a ten millionth of the output's travel (a rest from a table of numbers with few
    digits) counts as none.

    Args:
        motion: positions along the drivers' laws, such as a cycle.
        output: an output, or its text: ``jaw`` (angle of a link), ``C.x``, ``jaw.D.y``, ``guide`` (displacement).

    Raises:
        LinkwrightError: there is no such output, or the positions do not follow the drivers' laws in time.
    """
    require(motion, Motion)
    found = output if isinstance(output, Output) else output_of(motion.mechanism, str(output))
    if motion.steps < 3 or not motion.mechanism.drivers:
        return ()
    return motion.kept(("limits", found), lambda: _limits(motion, found))


def _limits(motion: Motion, output: Output) -> tuple[LimitPosition, ...]:
    """Of positions in no order the limits by increasing time."""
    limits, order = _Search(motion.in_order(), output).limits(), motion.order
    if order is None:
        return limits
    return tuple(replace(each, index=int(order[each.index])) for each in limits)


def limit_inputs(motion: Motion, output: Output) -> list[tuple[float, str]]:
    """The first driver's coordinates at which an output reverses, with the kinds of limits, in no order.

    As :func:`limit_positions`, but with every way there and back, however short.
    """
    return _Search(motion, output).inputs()


@dataclass(frozen=True)
class _Reversals:
    """Brackets, shares of their spans where the rate is zero (NaN at a pole), and rows that give the output there."""

    brackets: list[Bracket]
    shares: list[float]
    rows: list[list[float]]


#: Numbers of the stored rows that are angular velocities, and velocities.
_speeds: Recent[Mapping[str, int], tuple[list[int], list[int]]] = Recent(64)


def _rows_of(index: Mapping[str, int]) -> tuple[list[int], list[int]]:
    turning, moving = (
        [k for name, k in index.items() if kind_of(name) == kind] for kind in ("angular_velocity", "velocity")
    )
    return turning, moving


class _Search:
    """The limits of one output."""

    def __init__(self, motion: Motion, output: Output) -> None:
        self.motion = motion
        self.output = output
        courses = motion.solver.programs.courses
        if output not in courses:
            courses[output] = program_names(motion.mechanism, output)
        self.value_names, self.rate_names = courses[output]
        self.counted = output.kind == "angle" and motion.link(output.owner).counted
        if self.counted:
            self.value_names = (row_name("turned_angle", output.owner),)
        self.between = Between(motion)
        positions = motion.positions
        self.period = positions.period if self.between.closes else None
        self.count = positions.count - positions.repeated
        self.times, self.before = motion.time[: self.count], np.arange(self.count)
        self.one_formula, self.rests = one_formula(motion.mechanism), np.empty((0, 2))

    def limits(self) -> tuple[LimitPosition, ...]:
        return self._positions(self.found)

    def inputs(self) -> list[tuple[float, str]]:
        """Coordinates of the first driver, and kinds."""
        law, found = next(iter(self.motion.mechanism.drivers.values())).law, self.found
        zeros = zip(found.brackets, found.shares, strict=True)
        return [(law.at(self._time(each, share)), each.kind) for each, share in zeros if math.isfinite(share)]

    @cached_property
    def reach(self) -> Reach:
        """What is reached."""
        return Reach(self.motion, self.between)

    @cached_property
    def whole(self) -> bool:
        """Whether that is all."""
        return self.motion.whole or self.reach.whole

    @cached_property
    def found(self) -> _Reversals:
        """Where the rate is zero."""
        return self.motion.kept(("reversals", self.output), self._reversals)

    def _reversals(self) -> _Reversals:
        rows = self.motion.rows.fetch(self.rate_names, self.motion.evaluate)
        rate, second = self._with_leaps(*(row[: self.count] for row in rows))
        if self.one_formula and not self.motion.breaks and self._moves(rate):
            brackets = self._brackets(rate, second)
        else:
            brackets = self._brackets_of_parts(rate, second)
        return self._refined(brackets) if brackets else _Reversals([], [], [])

    def _brackets_of_parts(self, rate: Floats, second: Floats) -> list[Bracket]:
        """The same of outputs that may rest, or are not reached everywhere."""
        if not self.whole:
            rate, second = self._with_stretches_reached(rate, second)
        still = self._still(rate)
        return [] if still is None else self._brackets(*self._with_stretches(rate, second, still))

    def _with_leaps(self, rate: Floats, second: Floats) -> tuple[Floats, Floats]:
        """The rates at the positions, and at times between those from which to the next something turns far."""
        few = self.one_formula and not self.motion.solver.motion.angles.pairs
        if few and self.motion.positions.longest_turn <= FAR:
            return rate, second
        edges = np.sort(np.append(self.times, [] if self.period is None else [self._time_of(self.count)]))
        every = with_leaps(self.motion, edges)
        if every is edges:
            return rate, second
        more = np.setdiff1d(every, edges)
        order = np.argsort(self.times)
        before = self.before[order[np.searchsorted(self.times[order], more, "right") - 1]]
        return self._merged(rate, second, more, before)

    def _with_stretches_reached(self, rate: Floats, second: Floats) -> tuple[Floats, Floats]:
        """The rates with those between the ends of what is reached, the closer the nearer these are."""
        places = np.concatenate([[], *(a + (b - a) * NEARING for a, b in self.reach.stretches)])
        if (period := self.motion.positions.period) is not None:
            start = float(self.motion.time[0])
            places = start + (places - start) % period
        places = np.setdiff1d(places, self.times)
        return self._merged(rate, second, places, self.reach.before(places))

    def _merged(self, rate: Floats, second: Floats, places: Floats, before: Indices) -> tuple[Floats, Floats]:
        """The rates with those at some more times, s, behind the positions ``before``."""
        there = self.between.evaluate(self.rate_names, before, places)
        good = np.isfinite(there).all(axis=0) & (self.whole or self.reach.reached(places))
        times = np.append(self.times, places[good])
        order = np.argsort(times if times[0] <= self.times[-1] else -times, kind="stable")
        self.times, self.before = times[order], np.append(self.before, before[good])[order]
        rate, second = np.concatenate([np.stack([rate, second]), there[:, good]], axis=1)[:, order]
        return rate, second

    def _with_stretches(self, rate: Floats, second: Floats, still: float) -> tuple[Floats, Floats, Indices]:
        """The rates at the positions and at places of all stretches of one formula, in which rests are found, and
        where these are not zero."""
        parts = stretches(self.motion)
        if parts is None:
            return rate, second, np.flatnonzero(np.abs(rate) > still)
        rate, second = self._merged(rate, second, parts.places, parts.before)
        least = np.where(parts.inside(self.times), still, max(still, STILL_AT_BENDS * _largest(rate)))
        moving = np.abs(rate) > least
        self.rests = parts.resting(self.times, moving)
        return rate, second, np.flatnonzero(moving)

    def _time(self, bracket: Bracket, share: float) -> float:
        """The time at a share of a bracket, within the cycle."""
        time, start = bracket.begin + share * bracket.span, float(self.motion.time[0])
        if self.period is not None and time - start >= self.period * (1.0 - 1e-15):
            return max(time - self.period, start)
        return time

    def _moves(self, rate: Floats) -> bool:
        """Whether no rate counts as zero, whatever the fastest point of the mechanism."""
        size, motion = self.motion.mechanism.size, self.motion
        values = motion.rows.values[: len(motion.solver.outputs.standard) - 1]
        fastest = math.sqrt(np.einsum("ij,ij->", values, values)) * max(size, 1.0 / size)
        sizes = np.abs(rate)
        least, largest = sizes.item(sizes.argmin()), sizes.item(sizes.argmax())  # NaN where one is
        return bool(largest > CONSTANT * fastest and least > STILL * max(largest, 1e-3 * fastest))

    def _still(self, rate: Floats) -> float | None:
        """Rates that count as zero; None where the output does not move."""
        rows, size = self.motion.rows, self.motion.mechanism.size
        turning, moving = _speeds.get(rows.index, None, lambda: _rows_of(rows.index))
        largest = _largest(rate)
        speed = max(_largest(rows.values[turning]), _largest(rows.values[moving]) / size)
        if self.output.kind != "angle":
            speed *= size
        beside = STILL_BESIDE if self.one_formula else STILL_IN_RESTS
        return None if largest <= CONSTANT * speed else max(STILL * largest, beside * speed)

    # where the rate changes its sign --------------------------------------------------------------
    def _brackets(self, rate: Floats, second: Floats, moving: Indices | None = None) -> list[Bracket]:
        """Stretches with one zero of the rate in each, between neighbours among the positions that are ``moving``, by
        default all."""
        sense = 1.0 if self.times[-1] >= self.times[0] else -1.0
        turn = rate * second if sense > 0.0 else -rate * second
        places: Sequence[int] = range(len(rate) + 1) if moving is None else moving.tolist()
        grows, nears = (
            (each if moving is None else each[moving]).tobytes() for each in (rate > 0.0, turn < 0.0)
        )
        if self.period is not None:
            grows, nears = grows + grows[:1], nears + nears[:1]
            places = places if moving is None else [*places, *(each + len(rate) for each in places[:1])]
        together = (lambda _: True) if moving is None or self.whole else self._together(places)
        changes = sorted(places_of(grows, b"\0\1") + places_of(grows, b"\1\0"))
        found = [self._bracket(rate, second, *places[k : k + 2]) for k in changes if together(k)]
        dips = [
            (places[k], places[k + 1])
            for k in places_of(nears, b"\1\0")
            if grows[k] == grows[k + 1] and turn[places[k + 1] % len(rate)] > 0.0 and together(k)
        ]
        return found + self._split(rate, second, dips) if dips else found

    def _bracket(self, rate: Floats, second: Floats, first: int, last: int) -> Bracket:
        """The stretch between two positions, of which the second may be counted past the last one."""
        after, begin, before = last % len(self.times), float(self.times[first]), int(self.before[first])
        a, b = float(rate[first]), float(rate[after])
        span = self._time_of(last) - begin
        if last - first > 1 and len(rest := self._rest(begin, begin + span)):
            middle = (0.5 * float(rest.min() + rest.max()) - begin) / span
            return Bracket(before, begin, span, middle, middle, a, b, middle)
        same = (a > 0.0) == (b > 0.0)
        start = 0.5 if same else zero_between(a, b, float(second[first]) * span, float(second[after]) * span)
        return Bracket(before, begin, span, 0.0, 1.0, a, b, start)

    def _rest(self, begin: float, end: float) -> Floats:
        """Begin and end of what rests between two times, s; empty where nothing does."""
        low, high = min(begin, end), max(begin, end)
        near, period = BESIDE * (high - low), self.period or 0.0
        turns = self.rests + period * np.ceil((low - near - self.rests[:, :1]) / (period or np.inf))
        inside = (turns[:, 0] >= low - near) & (turns[:, 1] <= high + near)
        return turns[inside]

    def _time_of(self, position: int) -> float:
        """The time of a position, which may be counted past the last one."""
        count = len(self.times)
        return float(self.times[position % count]) + (position >= count) * (self.period or 0.0)

    def _together(self, places: Sequence[int]) -> Callable[[int], bool]:
        """Whether no end of what is reached lies between one of these positions and the next, by its number."""
        edges = np.array([time for time, _ in self.reach.edges])
        if self.period is not None:
            edges = np.append(edges, edges + math.copysign(self.period, self.times[-1] - self.times[0]))

        def together(k: int) -> bool:
            ways = (edges - self._time_of(places[k])) * (edges - self._time_of(places[k + 1]))
            return bool((ways > 0.0).all())

        return together

    def _split(self, rate: Floats, second: Floats, ends_of: list[tuple[int, int]]) -> list[Bracket]:
        """Stretches in which the rate dips below zero and comes back, between two positions: both halves of each."""
        dips = [self._bracket(rate, second, *each) for each in ends_of]
        slopes = [[float(second[each[k] % len(rate)]) for each in ends_of] for k in (0, 1)]
        dips = [dip for dip, is_one in zip(dips, which_dip(dips, *slopes), strict=True) if is_one]
        still = self._still(rate) if dips else None
        if still is None:
            return []
        columns = Columns(dips)
        sign = np.sign(self._rates(columns, columns.low)[1])
        middle = ends(
            lambda share: np.sign(self._rates(columns, share)[1]) == sign, columns.low, columns.high
        )
        rates = self._rates(columns, middle)[0]
        found = []
        for dip, share, least in zip(dips, middle.tolist(), rates.tolist(), strict=True):
            if abs(least) > still and least * dip.rate_low < 0.0:
                found += [
                    part_of(dip, dip.low, share, dip.rate_low, least),
                    part_of(dip, share, dip.high, least, dip.rate_high),
                ]
        return found

    # refinement -------------------------------------------------------------------------------------
    def _rates(self, brackets: Columns, share: Floats) -> Floats:
        """At shares of the brackets' spans the output's rate and second derivative, then what gives its value."""
        time = brackets.begin + share * brackets.span
        return self.between.evaluate((*self.rate_names, *self.value_names), brackets.before, time)

    def _refined(self, brackets: list[Bracket]) -> _Reversals:
        """Where the rate is zero, by Newton's steps inside the brackets.

        The output is that of the last step's beginning: as its rate is zero, it differs by the step's square.
        """
        outputs = self.between.on_plain_numbers((*self.rate_names, *self.value_names))
        if outputs is None:
            return self._refined_together(brackets)
        row: list[float] = []
        here, rows = [], []
        for each in brackets:

            def rate_and_slope(share: float, each: Bracket = each) -> tuple[float, float]:
                nonlocal row
                row = outputs(each.begin + share * each.span)
                return row[0], row[1] * each.span

            share = zero(rate_and_slope, each.low, each.high, each.rate_low, each.start)
            lost = not abs(row[0]) <= 10.0 * max(abs(each.rate_low), abs(each.rate_high))
            here.append(math.nan if lost else share)
            rows.append(row[2:])
        return _Reversals(brackets, here, rows)

    def _refined_together(self, found: list[Bracket]) -> _Reversals:
        """The same side by side, where change points may be passed and groups are followed."""
        brackets = Columns(found)
        a, b = brackets.rate_low, brackets.rate_high
        rows = np.empty(0)

        def rate_and_slope(share: Floats) -> tuple[Floats, Floats]:
            nonlocal rows
            rows = self._rates(brackets, share)
            return rows[0], rows[1] * brackets.span

        here = zeros(rate_and_slope, brackets.low, brackets.high, a, brackets.start)
        lost = ~(np.abs(rows[0]) <= 10.0 * np.maximum(np.abs(a), np.abs(b)))
        time = brackets.begin + here * brackets.span
        touches = np.flatnonzero(lost | (self.between.quality(brackets.before, time) < BLURRED))
        for k in touches:
            here[k] = self._at_touch(brackets, int(k))
        if len(touches):
            rows = self._rates(brackets, here)
        return _Reversals(found, here.tolist(), rows[2:].T.tolist())

    def _at_touch(self, brackets: Columns, k: int) -> float:
        """The share of a change point in a bracket whose rate cannot be computed there; NaN without one."""
        start, span = float(brackets.begin[k]), float(brackets.span[k])
        touch = self.between.touch(start + span * brackets.low[k], start + span * brackets.high[k])
        return np.nan if touch is None else (touch - start) / span

    def _positions(self, found: _Reversals) -> tuple[LimitPosition, ...]:
        known = self.motion.time
        direction = 1.0 if known[self.count - 1] >= known[0] else -1.0
        law = next(iter(self.motion.mechanism.drivers.values())).law
        values = self._output(found.rows, [each.before for each in found.brackets]) if found.rows else []
        limits = []
        for each, share, value in zip(found.brackets, found.shares, values, strict=True):
            if not math.isfinite(share):
                continue
            before, time = each.before, self._time(each, share)
            if not math.isfinite(value):
                value = self._beside(before, each.begin + share * each.span, BESIDE * each.span)
            if direction * time < direction * known[before]:
                before = 0
            while before + 1 < self.count and direction * known[before + 1] <= direction * time:
                before += 1
            limits.append(LimitPosition(law.at(time), time, value, each.kind, before))
        limits.sort(key=lambda each: direction * each.time)
        return self._without_ripple(limits) if len(limits) > 2 else tuple(limits)

    def _beside(self, before: int, time: float, way: float) -> float:
        """The output from both sides of a time at which it cannot be computed."""
        rows = self.between.evaluate(
            self.value_names, np.array([before] * 2), np.array([time - way, time + way])
        )
        return 0.5 * sum(self._output(rows.T.tolist(), [before] * 2))

    def _without_ripple(self, found: list[LimitPosition]) -> tuple[LimitPosition, ...]:
        """Without the pairs of reversals between which the output goes next to nowhere."""
        least = LEAST_WAY * float(np.ptp([each.value for each in found]))
        while len(found) > 2:
            ring = found if self.period is None else [*found, found[0]]
            ways = [abs(b.value - a.value) for a, b in pairwise(ring)]
            if min(ways) >= least:
                break
            k = ways.index(min(ways))
            del found[k], found[k % len(found)]
        return tuple(found)

    def _output(self, rows: list[list[float]], before: list[int]) -> list[float]:
        """The output from the rows that give its value, angles continuous from the positions ``before``."""
        if self.output.kind != "angle":
            return [row[0] for row in rows]
        angle = self.motion.link(self.output.owner).angle
        if self.counted:
            (turned,) = self.motion.rows.fetch(self.value_names, self.motion.evaluate)
            first = float(np.nanmax(angle - turned))
            return [row[0] + first for row in rows]
        near = angle[before].tolist()
        if not all(map(math.isfinite, near)):
            known = np.flatnonzero(np.isfinite(angle))
            near = angle[known[np.abs(np.subtract.outer(known, before)).argmin(axis=0)]].tolist()
        raw = [math.atan2(y, x) for x, y in rows]
        return [angle + TURN * round((at - angle) / TURN) for angle, at in zip(raw, near, strict=True)]


def _largest(values: Floats) -> float:
    """The largest size among values, of which some may be NaN; zero for none."""
    return float(np.fmax.reduce(np.abs(values), axis=None, initial=0.0))
