"""One step of DOP853 for eight motions at once, each of its own length, as kernels.

All arrays of states are (rows, LANES). A state is q (freedoms), q' (freedoms), work, and the integrals of the
squares of watched outputs. Inputs of the program begin with q, q', time, outputs with q'', power, gaps, watched,
carried (see ``loop.py``).

Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.5 and II.6; coefficients and control
of the step as in SciPy's ``DOP853``.
"""

from __future__ import annotations

from linkwright.formula.kernel import Reals, Vector, Wholes, invoke, load, maximum, root, spread, store

#: Numbers of the plan of a run.
FREEDOMS, STATES, EVENTS, WATCHED, CARRIED, INPUTS, INSIDE, SAMPLES = 0, 1, 2, 3, 4, 5, 6, 7
#: From here on: what an event does, then which of the inputs it flips.
ACTIONS = 8
#: Rows of numbers by lanes: time, length of the step, of the next one, end; the sums of squares of the errors.
TIME, LENGTH, NEXT, END, FIFTH, THIRD = 0, 1, 2, 3, 4, 5
#: Slopes of a step: twelve stages, that at its end, three more for the polynomial through it.
STAGES, SLOPES, COEFFICIENTS = 12, 16, 7
#: Places in the table of the method: matrix, weights, places of the stages, errors, polynomial.
MATRIX, WEIGHTS, PLACES, ERRORS, DENSE = 0, 256, 272, 288, 320
#: Change of the coordinates of groups without closed form that counts as none, rad or m.
CLOSED = 1e-10
#: Places in the settings.
RELATIVE, MOST, ABSOLUTE = 0, 1, 2


def carried_row(plan: Wholes) -> int:
    """The first of the inputs that are carried from step to step."""
    return 2 * plan[FREEDOMS] + 1 + plan[INPUTS] - plan[CARRIED]


def combine(y: Reals, k: Reals, weights: Reals, lane: Reals, to: Reals, states: int, count: int) -> None:
    """y and h times the weighted slopes."""
    h = load(lane, LENGTH * 8)
    for i in range(states):
        added = spread(0.0)
        for j in range(count):
            if weights[j] != 0.0:
                added += weights[j] * load(k, (j * states + i) * 8)
        store(to, i * 8, load(y, i * 8) + h * added)


def close(code: int, block: Wholes, x: Reals, out: Reals, plan: Wholes) -> None:
    """Newton's steps of groups without closed form go on from what they found; accelerations are NaN where they do
    not come to rest."""
    n, carried = plan[FREEDOMS], plan[CARRIED]
    first, row = n + 1 + plan[EVENTS] + plan[WATCHED], carried_row(plan)
    missed = spread(0.0)
    for again in range(2):
        for i in range(carried):
            store(x, (row + i) * 8, load(out, (first + i) * 8))
        if again == 0:
            invoke(code, block)
            for i in range(carried):
                change = load(out, (first + i) * 8) - load(x, (row + i) * 8)
                missed = missed + change * change
    refused = 0.0 * root(CLOSED * CLOSED - missed)
    for i in range(n + 1):
        store(out, i * 8, load(out, i * 8) + refused)


def evaluate(
    code: int, block: Wholes, x: Reals, out: Reals, plan: Wholes, lane: Reals, source: Reals, share: Vector
) -> None:
    """The outputs at states and a share of the step."""
    n = plan[FREEDOMS]
    for i in range(2 * n):
        store(x, i * 8, load(source, i * 8))
    store(x, 16 * n, load(lane, TIME * 8) + share * load(lane, LENGTH * 8))
    invoke(code, block)
    if plan[CARRIED] > 0:
        close(code, block, x, out, plan)


def find_slopes(
    code: int, block: Wholes, x: Reals, out: Reals, plan: Wholes, lane: Reals, source: Reals, share: Vector, k: Reals
) -> None:
    """Slopes of the states."""
    evaluate(code, block, x, out, plan, lane, source, share)
    n, first = plan[FREEDOMS], plan[FREEDOMS] + 1 + plan[EVENTS]
    for i in range(n):
        store(k, i * 8, load(source, (n + i) * 8))
    for i in range(n + 1):
        store(k, (n + i) * 8, load(out, i * 8))
    for i in range(plan[WATCHED]):
        value = load(out, (first + i) * 8)
        store(k, (2 * n + 1 + i) * 8, value * value)


def step(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    lane: Reals,
    y: Reals,
    trial: Reals,
    k: Reals,
    table: Reals,
    carried: Reals,
) -> None:
    """The states after the step in ``trial``, from the first slopes; ``carried``: where Newton's steps begin."""
    states, row = plan[STATES], carried_row(plan)
    for i in range(plan[CARRIED]):
        store(x, (row + i) * 8, load(carried, i * 8))
    for s in range(1, STAGES):
        combine(y, k, table + MATRIX + 16 * s, lane, trial, states, s)
        find_slopes(code, block, x, out, plan, lane, trial, spread(table[PLACES + s]), k + s * states * 8)
    combine(y, k, table + WEIGHTS, lane, trial, states, STAGES)


def find_errors(y: Reals, trial: Reals, k: Reals, table: Reals, settings: Reals, plan: Wholes, lane: Reals) -> None:
    """Sums of the squares of both estimates of the error, over what is allowed."""
    states = plan[STATES]
    fifth, third = spread(0.0), spread(0.0)
    for i in range(2 * plan[FREEDOMS] + 1):
        five, three = spread(0.0), spread(0.0)
        for j in range(STAGES):
            slope = load(k, (j * states + i) * 8)
            five += table[ERRORS + j] * slope
            three += table[ERRORS + 16 + j] * slope
        before, after = load(y, i * 8), load(trial, i * 8)
        size = maximum(maximum(before, -before), maximum(after, -after))
        size = settings[ABSOLUTE + i] + settings[RELATIVE] * size
        fifth += (five / size) * (five / size)
        third += (three / size) * (three / size)
    store(lane, FIFTH * 8, fifth)
    store(lane, THIRD * 8, third)


def find_polynomial(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    lane: Reals,
    y: Reals,
    trial: Reals,
    probe: Reals,
    k: Reals,
    dense: Reals,
    table: Reals,
) -> None:
    """The states within the step, of order 7, by three more slopes."""
    states, h = plan[STATES], load(lane, LENGTH * 8)
    for s in range(STAGES + 1, SLOPES):
        combine(y, k, table + MATRIX + 16 * s, lane, probe, states, s)
        find_slopes(code, block, x, out, plan, lane, probe, spread(table[PLACES + s]), k + s * states * 8)
    for i in range(states):
        change = load(trial, i * 8) - load(y, i * 8)
        first, last = load(k, i * 8), load(k, (STAGES * states + i) * 8)
        store(dense, i * 8, change)
        store(dense, (states + i) * 8, h * first - change)
        store(dense, (2 * states + i) * 8, 2.0 * change - h * (first + last))
        for r in range(4):
            added = spread(0.0)
            for j in range(SLOPES):
                added += table[DENSE + 16 * r + j] * load(k, (j * states + i) * 8)
            store(dense, ((3 + r) * states + i) * 8, h * added)


def look_within(
    code: int,
    block: Wholes,
    x: Reals,
    out: Reals,
    plan: Wholes,
    lane: Reals,
    y: Reals,
    probe: Reals,
    dense: Reals,
    share: Vector,
) -> None:
    """The outputs at shares of the step, of the states on its polynomial."""
    states, rest = plan[STATES], 1.0 - share
    for i in range(states):
        value = spread(0.0)
        for r in range(COEFFICIENTS):
            value += load(dense, ((COEFFICIENTS - 1 - r) * states + i) * 8)
            value = value * (share if r % 2 == 0 else rest)
        store(probe, i * 8, load(y, i * 8) + value)
    evaluate(code, block, x, out, plan, lane, probe, share)


STEP_KERNELS = (carried_row, combine, close, evaluate, find_slopes, step, find_errors, find_polynomial, look_within)
