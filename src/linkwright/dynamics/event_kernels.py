"""Events of motions within their steps, as kernels.

An event's function is watched for going over from one side (1, -1) to the other; one that begins at its root is
taken to be on its side. It is looked for at some places of the polynomial through a step; the first one is located
there (Illinois), then the step is taken again with the length to it, and once more after a correction.
"""

from __future__ import annotations

from linkwright.dynamics.step_kernels import (
    ACTIONS,
    EVENTS,
    FREEDOMS,
    INSIDE,
    LENGTH,
    NEXT,
    STATES,
    TIME,
    WATCHED,
    look_within,
)
from linkwright.formula.kernel import Reals, Wholes, fabs, load, spread

#: Places in a record; then states, sides, times of events, peaks, inputs.
AT, UNTIL, FIRST, OUTCOME, EVENT, COUNT, SAMPLED, HEAD = 0, 1, 2, 3, 4, 5, 6, 8
#: Outcomes.
ENDED, STOPPED, NO_START, TOO_SMALL, TOO_MANY, RETURNED = 1.0, 2.0, 3.0, 4.0, 5.0, 6.0
#: What an event does: it ends the motion, is noted once, or turns an input from 0 to 1 and back.
STOP, NOTE, FLIP = 0, 1, 2
#: Sides of an event's function: that of its first value; none, it is not watched.
UNKNOWN, UNWATCHED = 2.0, 0.0
#: More rows of numbers by lanes: whether the step holds; was tried before; ends the motion; the motion begins anew;
#: how far the event is located; bracket, looked at; weights of its ends; the one changed last; the event, its slope.
HOLDS, TRIED, LAST, ANEW, FOUND, LOW, HIGH, LOOK, LOW_WEIGHT, HIGH_WEIGHT, MOVED, WHICH, SLOPE = (
    6,
    7,
    8,
    9,
    10,
    11,
    12,
    13,
    14,
    15,
    16,
    17,
    18,
)
LANE_ROWS = 20
#: Width of a bracket, in shares of the step, that is not cut further, and that of an event which was there already.
NARROW, AT_ONCE = 1e-14, 1e-9
#: Share of the step over which an event's slope is taken, and the longest correction by it.
APART, FARTHEST = 1e-4, 1e-2
LOOKS = 120


def crossed(side: float, value: float) -> int:
    """Whether an event's function has left its side."""
    return 1 if fabs(side) == 1.0 and side * value < 0.0 else 0


def take_value(plan: Wholes, record: Reals, gaps: Reals, e: int, value: float, at: int) -> None:
    """The value of an event's function where a step begins; its side, where none is known yet."""
    sides = record + (HEAD + plan[STATES])
    gaps[e * 8 + at] = value
    if sides[e] == UNKNOWN and value != 0.0:
        sides[e] = 1.0 if value > 0.0 else -1.0


def watch(plan: Wholes, record: Reals, values: Reals, at: int) -> None:
    """The largest sizes of watched outputs so far."""
    peaks = record + (HEAD + plan[STATES] + 2 * plan[EVENTS])
    for i in range(plan[WATCHED]):
        value = fabs(values[i * 8 + at])
        if value > peaks[i]:
            peaks[i] = value


def look_for(plan: Wholes, record: Reals, lane: Reals, values: Reals, share: float, gaps: Reals, at: int) -> int:
    """Whether an event is behind a share of the step; the bracket, and the functions at its ends."""
    events = plan[EVENTS]
    sides, low, high = record + (HEAD + plan[STATES]), gaps + 16 * events, gaps + 24 * events
    count = 0
    for e in range(events):
        count += crossed(sides[e], values[e * 8 + at])
    end = low
    if count > 0:
        end = high
    for e in range(events):
        end[e * 8 + at] = values[e * 8 + at]
    lane[(HIGH if count > 0 else LOW) * 8 + at] = share
    return count


def next_look(plan: Wholes, record: Reals, lane: Reals, gaps: Reals, at: int) -> None:
    """Where the first of the events should be: the secant's root (Illinois), halfway while the bracket begins at a
    root."""
    events = plan[EVENTS]
    sides, low, high = record + (HEAD + plan[STATES]), gaps + 16 * events, gaps + 24 * events
    start, width = lane[LOW * 8 + at], lane[HIGH * 8 + at] - lane[LOW * 8 + at]
    least = 1.0
    for e in range(events):
        if crossed(sides[e], high[e * 8 + at]) > 0:
            a = sides[e] * low[e * 8 + at] * lane[LOW_WEIGHT * 8 + at]
            b = sides[e] * high[e * 8 + at] * lane[HIGH_WEIGHT * 8 + at]
            share = 0.5
            if a > 0.0:
                share = a / (a - b)
            if share <= least:
                least = share
                lane[WHICH * 8 + at] = float(e)
    lane[LOOK * 8 + at] = start + width * min(max(least, 1e-3), 1.0 - 1e-3)


def narrow(plan: Wholes, record: Reals, lane: Reals, out: Reals, gaps: Reals, at: int) -> None:
    """The bracket after a look; found where it is narrow."""
    n = plan[FREEDOMS]
    moved = 1.0
    if look_for(plan, record, lane, out + (n + 1) * 8, lane[LOOK * 8 + at], gaps, at) > 0:
        moved = 2.0
    again = 0.5 if lane[MOVED * 8 + at] == moved else 1.0
    if moved == 2.0:
        lane[LOW_WEIGHT * 8 + at] = lane[LOW_WEIGHT * 8 + at] * again
        lane[HIGH_WEIGHT * 8 + at] = 1.0
    else:
        lane[HIGH_WEIGHT * 8 + at] = lane[HIGH_WEIGHT * 8 + at] * again
        lane[LOW_WEIGHT * 8 + at] = 1.0
    lane[MOVED * 8 + at] = moved
    if lane[HIGH * 8 + at] - lane[LOW * 8 + at] < NARROW or lane[HIGH * 8 + at] < AT_ONCE:
        lane[FOUND * 8 + at] = 2.0


def search(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    lane: Reals,
    y: Reals,
    probe: Reals,
    dense: Reals,
    gaps: Reals,
    whose: Wholes,
    records: Reals,
    size: int,
) -> int:
    """How many motions have an event in their step, each in a bracket; watched outputs before it."""
    events, parts, count = plan[EVENTS], plan[INSIDE] + 1, 0
    for at in range(8):
        lane[FOUND * 8 + at] = 0.0
        lane[LOW * 8 + at] = 0.0
        for e in range(events):
            gaps[(2 * events + e) * 8 + at] = gaps[e * 8 + at]
    for part in range(1, parts + 1):
        share = float(part) / float(parts)
        if part < parts:
            look_within(code, block, x, out, plan, lane, y, probe, dense, spread(share))
        for at in range(8):
            if lane[HOLDS * 8 + at] > 0.0 and lane[FOUND * 8 + at] == 0.0:
                record = records + whose[at] * size
                values = out + (plan[FREEDOMS] + 1) * 8
                if part == parts:
                    values = gaps + 8 * events
                if look_for(plan, record, lane, values, share, gaps, at) > 0:
                    lane[FOUND * 8 + at] = 1.0
                    lane[LOW_WEIGHT * 8 + at] = 1.0
                    lane[HIGH_WEIGHT * 8 + at] = 1.0
                    lane[MOVED * 8 + at] = 0.0
                    count += 1
                elif part < parts:
                    watch(plan, record, out + (plan[FREEDOMS] + 1 + events) * 8, at)
    return count


def locate(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    lane: Reals,
    y: Reals,
    probe: Reals,
    dense: Reals,
    gaps: Reals,
    whose: Wholes,
    records: Reals,
    size: int,
) -> None:
    """The events in their brackets, on the polynomials; the slopes of their functions."""
    n, high = plan[FREEDOMS], gaps + 24 * plan[EVENTS]
    busy, looks = 1, 0
    while busy > 0 and looks < LOOKS:
        busy = 0
        for at in range(8):
            lane[LOOK * 8 + at] = 1.0
            if lane[FOUND * 8 + at] == 1.0:
                next_look(plan, records + whose[at] * size, lane, gaps, at)
                busy += 1
        if busy > 0:
            look_within(code, block, x, out, plan, lane, y, probe, dense, load(lane, LOOK * 8))
            for at in range(8):
                if lane[FOUND * 8 + at] == 1.0:
                    narrow(plan, records + whose[at] * size, lane, out, gaps, at)
        looks += 1
    for at in range(8):
        lane[LOOK * 8 + at] = lane[HIGH * 8 + at] - APART if lane[FOUND * 8 + at] > 0.0 else 1.0
    look_within(code, block, x, out, plan, lane, y, probe, dense, load(lane, LOOK * 8))
    for at in range(8):
        if lane[FOUND * 8 + at] > 0.0:
            which = int(lane[WHICH * 8 + at])
            lane[SLOPE * 8 + at] = (high[which * 8 + at] - out[(n + 1 + which) * 8 + at]) / APART
            lane[LAST * 8 + at] = 0.0
            lane[NEXT * 8 + at] = lane[LENGTH * 8 + at]
            lane[LENGTH * 8 + at] = lane[NEXT * 8 + at] * lane[HIGH * 8 + at]


def correct(plan: Wholes, lane: Reals, out: Reals) -> None:
    """Lengths to the events, by their functions at the ends of the shortened steps."""
    for at in range(8):
        if lane[FOUND * 8 + at] > 0.0:
            which = int(lane[WHICH * 8 + at])
            change = out[(plan[FREEDOMS] + 1 + which) * 8 + at] / lane[SLOPE * 8 + at]
            if fabs(change) < FARTHEST and change < lane[HIGH * 8 + at]:
                lane[LENGTH * 8 + at] = lane[NEXT * 8 + at] * (lane[HIGH * 8 + at] - change)


def take_events(plan: Wholes, record: Reals, lane: Reals, x: Reals, gaps: Reals, at: int) -> float:
    """What the events at the end of a step do; the outcome of the motion where they end it."""
    n, events, now = plan[FREEDOMS], plan[EVENTS], lane[TIME * 8 + at]
    sides, high = record + (HEAD + plan[STATES]), gaps + 24 * events
    times = sides + events
    began, outcome = now - lane[LENGTH * 8 + at], 0.0
    for e in range(events):
        if crossed(sides[e], high[e * 8 + at]) > 0:
            if lane[HIGH * 8 + at] < AT_ONCE and fabs(began - times[e]) <= 1e-14 * fabs(now):
                outcome = RETURNED
                record[EVENT] = float(e)
            times[e] = now
            action = plan[ACTIONS + e]
            if action == STOP:
                if outcome == 0.0:
                    outcome = STOPPED
                    record[EVENT] = float(e)
            elif action == NOTE:
                sides[e] = UNWATCHED
            else:
                row = (2 * n + 1 + plan[ACTIONS + events + e]) * 8 + at
                x[row] = 1.0 - x[row]
                sides[e] = -sides[e]
                lane[ANEW * 8 + at] = 1.0
    return outcome


EVENT_KERNELS = (crossed, take_value, watch, look_for, next_look, narrow, search, locate, correct, take_events)
