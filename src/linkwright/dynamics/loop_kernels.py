"""Motions from their starts to their ends or first events, eight at once, as kernels.

Every motion is a record (places in ``event_kernels``); a lane whose motion is over takes the next one.
"""

from __future__ import annotations

from functools import cache

from linkwright.dynamics.event_kernels import (
    ANEW,
    COUNT,
    ENDED,
    EVENT_KERNELS,
    FOUND,
    HOLDS,
    LANE_ROWS,
    LAST,
    NO_START,
    TOO_MANY,
    TOO_SMALL,
    correct,
    locate,
    search,
    take_events,
    watch,
)
from linkwright.dynamics.lane_kernels import (
    LANE_KERNELS,
    begin,
    choose_lengths,
    finish,
    judge,
    keep_ends,
    move,
    sample,
    start_anew,
)
from linkwright.dynamics.step_kernels import (
    CARRIED,
    COEFFICIENTS,
    END,
    EVENTS,
    INSIDE,
    LENGTH,
    MOST,
    NEXT,
    SAMPLES,
    SLOPES,
    STAGES,
    STATES,
    STEP_KERNELS,
    TIME,
    WATCHED,
    carried_row,
    find_errors,
    find_polynomial,
    find_slopes,
    step,
)
from linkwright.formula.kernel import Kernels, Reals, Wholes, fabs, spread


def start_all(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    settings: Reals,
    lane: Reals,
    y: Reals,
    k: Reals,
    gaps: Reals,
    whose: Wholes,
    records: Reals,
    size: int,
) -> None:
    """The first slopes of the motions that begin anew; those that cannot begin are over."""
    carried = gaps + 8 * (4 * plan[EVENTS] + plan[WATCHED])
    for at in range(8):
        lane[LENGTH * 8 + at] = 0.0
    find_slopes(code, block, x, out, plan, lane, y, spread(0.0), k)
    for at in range(8):
        if whose[at] >= 0 and lane[ANEW * 8 + at] > 0.0:
            record = records + whose[at] * size
            for i in range(plan[CARRIED]):
                carried[i * 8 + at] = x[(carried_row(plan) + i) * 8 + at]
            if start_anew(plan, record, settings, lane, y, k, out, gaps, at) == 0:
                finish(plan, record, lane, y, x, at, NO_START)
                whose[at] = -1


def end_steps(
    plan: Wholes,
    settings: Reals,
    x: Reals,
    lane: Reals,
    y: Reals,
    trial: Reals,
    k: Reals,
    dense: Reals,
    gaps: Reals,
    whose: Wholes,
    records: Reals,
    size: int,
    grid: Reals,
    samples: Reals,
) -> None:
    """Samples and ends of the steps that hold, what happens there, and the motions that are over."""
    states, events = plan[STATES], plan[EVENTS]
    for at in range(8):
        if whose[at] >= 0:
            record, outcome = records + whose[at] * size, 0.0
            if lane[HOLDS * 8 + at] > 0.0:
                if plan[SAMPLES] > 0:
                    sample(plan, record, lane, y, dense, grid, samples + whose[at] * plan[SAMPLES] * states, at)
                move(plan, record, lane, y, trial, k, gaps, x, at)
                watch(plan, record, gaps + 32 * events, at)
                if events > 0 and lane[FOUND * 8 + at] > 0.0:
                    outcome = take_events(plan, record, lane, x, gaps, at)
                if lane[LAST * 8 + at] > 0.0:
                    outcome = ENDED
                elif outcome == 0.0 and record[COUNT] >= settings[MOST]:
                    outcome = TOO_MANY
            elif lane[NEXT * 8 + at] < 1e-15 * max(fabs(lane[TIME * 8 + at]), 1e-3 * lane[END * 8 + at]):
                outcome = TOO_SMALL
            if outcome > 0.0:
                finish(plan, record, lane, y, x, at, outcome)
                whose[at] = -1


def run(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    settings: Reals,
    table: Reals,
    room: Reals,
    whose: Wholes,
    count: int,
    size: int,
    records: Reals,
    grid: Reals,
    samples: Reals,
) -> int:
    """All motions; the number of evaluations of the program for steps and polynomials, by lanes of eight."""
    states, events = plan[STATES], plan[EVENTS]
    y, trial, probe = room, room + 8 * states, room + 16 * states
    k, dense = room + 24 * states, room + (24 + 8 * SLOPES) * states
    lane = dense + 8 * COEFFICIENTS * states
    gaps = lane + 8 * LANE_ROWS
    carried = gaps + 8 * (4 * events + plan[WATCHED])
    looking = events + plan[WATCHED]
    waiting, active, calls = 0, 1, 0
    for at in range(8):  # lanes without a motion of their own compute with the numbers of the first
        begin(plan, records, lane, y, x, at)
        whose[at] = -1
        lane[ANEW * 8 + at] = 0.0
    while active > 0:
        fresh, active = 0, 0
        for at in range(8):
            if whose[at] < 0 and waiting < count:
                begin(plan, records + waiting * size, lane, y, x, at)
                whose[at] = waiting
                waiting += 1
            if whose[at] >= 0:
                active += 1
                if lane[ANEW * 8 + at] > 0.0:
                    fresh += 1
        if fresh > 0:
            start_all(code, block, x, out, plan, settings, lane, y, k, gaps, whose, records, size)
            calls += 1
        if active == 0:
            break
        choose_lengths(whose, lane)
        step(code, block, x, out, plan, lane, y, trial, k, table, carried)
        find_errors(y, trial, k, table, settings, plan, lane)
        calls += STAGES
        if judge(plan, whose, lane) > 0:
            find_slopes(code, block, x, out, plan, lane, trial, spread(1.0), k + 8 * STAGES * states)
            keep_ends(plan, out, gaps)
            polynomial = 0
            if looking > 0:
                if plan[INSIDE] > 0:
                    find_polynomial(code, block, x, out, plan, lane, y, trial, probe, k, dense, table)
                    polynomial = 1
                    calls += 3 + plan[INSIDE]
                found = search(code, block, x, out, plan, lane, y, probe, dense, gaps, whose, records, size)
                if found > 0:
                    if polynomial == 0:
                        find_polynomial(code, block, x, out, plan, lane, y, trial, probe, k, dense, table)
                    locate(code, block, x, out, plan, lane, y, probe, dense, gaps, whose, records, size)
                    for again in range(2):
                        step(code, block, x, out, plan, lane, y, trial, k, table, carried)
                        find_slopes(code, block, x, out, plan, lane, trial, spread(1.0), k + 8 * STAGES * states)
                        calls += STAGES
                        if again == 0:
                            correct(plan, lane, out)
                    keep_ends(plan, out, gaps)
                    polynomial = 0
            if plan[SAMPLES] > 0 and polynomial == 0:
                find_polynomial(code, block, x, out, plan, lane, y, trial, probe, k, dense, table)
                calls += 3
        end_steps(plan, settings, x, lane, y, trial, k, dense, gaps, whose, records, size, grid, samples)
    return calls


@cache
def kernels() -> Kernels:
    """The module of these."""
    return Kernels((*STEP_KERNELS, *EVENT_KERNELS, *LANE_KERNELS, start_all, end_steps, run), apart=True)
