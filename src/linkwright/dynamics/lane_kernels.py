"""What each lane of the loop does by itself, as kernels: takes a motion, judges its step, moves to the end of it."""

from __future__ import annotations

from linkwright.dynamics.event_kernels import (
    ANEW,
    AT,
    COUNT,
    FIRST,
    HEAD,
    HOLDS,
    LAST,
    OUTCOME,
    SAMPLED,
    TRIED,
    UNTIL,
    take_value,
    watch,
)
from linkwright.dynamics.step_kernels import (
    ABSOLUTE,
    CARRIED,
    COEFFICIENTS,
    END,
    EVENTS,
    FIFTH,
    FREEDOMS,
    INPUTS,
    LENGTH,
    NEXT,
    RELATIVE,
    SAMPLES,
    STAGES,
    STATES,
    THIRD,
    TIME,
    WATCHED,
    carried_row,
)
from linkwright.formula.kernel import Reals, Wholes, fabs, sqrt


def begin(plan: Wholes, record: Reals, lane: Reals, y: Reals, x: Reals, at: int) -> None:
    """A record into a lane."""
    n, states, events = plan[FREEDOMS], plan[STATES], plan[EVENTS]
    lane[TIME * 8 + at] = record[AT]
    lane[END * 8 + at] = record[UNTIL]
    lane[NEXT * 8 + at] = record[FIRST]
    lane[LENGTH * 8 + at] = 0.0
    lane[TRIED * 8 + at] = 0.0
    lane[ANEW * 8 + at] = 1.0
    for i in range(states):
        y[i * 8 + at] = record[HEAD + i]
    given = record + (HEAD + states + 2 * events + plan[WATCHED])
    for i in range(plan[INPUTS]):
        x[(2 * n + 1 + i) * 8 + at] = given[i]


def finish(plan: Wholes, record: Reals, lane: Reals, y: Reals, x: Reals, at: int, outcome: float) -> None:
    """A lane into its record."""
    n, states, events = plan[FREEDOMS], plan[STATES], plan[EVENTS]
    record[AT] = lane[TIME * 8 + at]
    record[FIRST] = lane[NEXT * 8 + at]
    record[OUTCOME] = outcome
    for i in range(states):
        record[HEAD + i] = y[i * 8 + at]
    given = record + (HEAD + states + 2 * events + plan[WATCHED])
    for i in range(plan[INPUTS]):
        given[i] = x[(2 * n + 1 + i) * 8 + at]


def keep_ends(plan: Wholes, out: Reals, gaps: Reals) -> None:
    """Events' functions, watched and carried outputs at the ends of the steps."""
    n, events = plan[FREEDOMS], plan[EVENTS]
    ends = gaps + 8 * (4 * events + plan[WATCHED] + plan[CARRIED])
    for i in range(plan[CARRIED]):
        for at in range(8):
            ends[i * 8 + at] = out[(n + 1 + events + plan[WATCHED] + i) * 8 + at]
    for e in range(events):
        for at in range(8):
            gaps[(events + e) * 8 + at] = out[(n + 1 + e) * 8 + at]
    for i in range(plan[WATCHED]):
        for at in range(8):
            gaps[(4 * events + i) * 8 + at] = out[(n + 1 + events + i) * 8 + at]


def first_length(plan: Wholes, settings: Reals, lane: Reals, y: Reals, k: Reals, at: int) -> float:
    """Length of a first step, a hundredth of that in which the states change by their own size."""
    sizes, rates = 0.0, 0.0
    for i in range(2 * plan[FREEDOMS] + 1):
        allowed = settings[ABSOLUTE + i] + settings[RELATIVE] * fabs(y[i * 8 + at])
        sizes = max(sizes, fabs(y[i * 8 + at]) / allowed)
        rates = max(rates, fabs(k[i * 8 + at]) / allowed)
    if sizes < 1e-5 or rates < 1e-5:
        return 1e-6 * (lane[END * 8 + at] - lane[TIME * 8 + at])
    return 0.01 * sizes / rates


def start_anew(
    plan: Wholes, record: Reals, settings: Reals, lane: Reals, y: Reals, k: Reals, out: Reals, gaps: Reals, at: int
) -> int:
    """Whether a motion can go on from where it is: first values of events and watched outputs, length of a step."""
    n, events, size = plan[FREEDOMS], plan[EVENTS], 0.0
    for i in range(n + 1):
        size += fabs(k[(n + i) * 8 + at])
    if size < 1e300:
        for e in range(events):
            take_value(plan, record, gaps, e, out[(n + 1 + e) * 8 + at], at)
        watch(plan, record, out + (n + 1 + events) * 8, at)
        if lane[NEXT * 8 + at] <= 0.0:
            lane[NEXT * 8 + at] = first_length(plan, settings, lane, y, k, at)
        lane[ANEW * 8 + at] = 0.0
        return 1
    return 0


def choose_lengths(whose: Wholes, lane: Reals) -> None:
    """The next steps, not beyond the ends."""
    for at in range(8):
        lane[HOLDS * 8 + at] = 0.0
        lane[LAST * 8 + at] = 0.0
        lane[LENGTH * 8 + at] = 0.0
        if whose[at] >= 0:
            rest = lane[END * 8 + at] - lane[TIME * 8 + at]
            h = lane[NEXT * 8 + at]
            if h >= rest:
                h = rest
                lane[LAST * 8 + at] = 1.0
            lane[LENGTH * 8 + at] = h


def judge(plan: Wholes, whose: Wholes, lane: Reals) -> int:
    """How many steps hold; the lengths of the next ones."""
    count = 0
    for at in range(8):
        if whose[at] >= 0:
            fifth, third = lane[FIFTH * 8 + at], lane[THIRD * 8 + at]
            error = lane[LENGTH * 8 + at] * fifth / sqrt((fifth + 0.01 * third) * (2 * plan[FREEDOMS] + 1) + 1e-300)
            factor = 10.0
            if error > 1e-30:
                factor = 0.9 / sqrt(sqrt(sqrt(error)))
            if error < 1.0:
                factor = min(10.0, factor)
                if lane[TRIED * 8 + at] > 0.0:
                    factor = min(1.0, factor)
                lane[HOLDS * 8 + at] = 1.0
                lane[TRIED * 8 + at] = 0.0
                count += 1
            elif error >= 1.0:
                factor = max(0.2, factor)
                lane[TRIED * 8 + at] = 1.0
            else:
                factor = 0.2
                lane[TRIED * 8 + at] = 1.0
            lane[NEXT * 8 + at] = lane[LENGTH * 8 + at] * factor
    return count


def sample(
    plan: Wholes, record: Reals, lane: Reals, y: Reals, dense: Reals, grid: Reals, samples: Reals, at: int
) -> None:
    """The states at the times of the grid within a step."""
    states, number = plan[STATES], int(record[SAMPLED])
    start, h = lane[TIME * 8 + at], lane[LENGTH * 8 + at]
    going = 1
    while going > 0:
        going = 0
        if number < plan[SAMPLES] and grid[number] <= start + h * (1.0 + 1e-12):
            share = max(grid[number] - start, 0.0) / h
            for i in range(states):
                value = 0.0
                for r in range(COEFFICIENTS):
                    value += dense[((COEFFICIENTS - 1 - r) * states + i) * 8 + at]
                    value = value * (share if r % 2 == 0 else 1.0 - share)
                samples[number * states + i] = y[i * 8 + at] + value
            number += 1
            going = 1
    record[SAMPLED] = float(number)


def move(
    plan: Wholes, record: Reals, lane: Reals, y: Reals, trial: Reals, k: Reals, gaps: Reals, x: Reals, at: int
) -> None:
    """A lane to the end of its step."""
    states, events, count = plan[STATES], plan[EVENTS], plan[CARRIED]
    row, carried = carried_row(plan), gaps + 8 * (4 * events + plan[WATCHED])
    for i in range(count):
        value = carried[(count + i) * 8 + at]
        carried[i * 8 + at] = value
        x[(row + i) * 8 + at] = value
    if lane[LAST * 8 + at] > 0.0:
        lane[TIME * 8 + at] = lane[END * 8 + at]
    else:
        lane[TIME * 8 + at] = lane[TIME * 8 + at] + lane[LENGTH * 8 + at]
    for i in range(states):
        y[i * 8 + at] = trial[i * 8 + at]
        k[i * 8 + at] = k[(STAGES * states + i) * 8 + at]
    for e in range(events):
        take_value(plan, record, gaps, e, gaps[(events + e) * 8 + at], at)
    record[COUNT] = record[COUNT] + 1.0


LANE_KERNELS = (begin, finish, keep_ends, first_length, start_anew, choose_lengths, judge, sample, move)
