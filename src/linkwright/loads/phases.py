"""When a load acts, and how far its phase has gone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from linkwright.core.dataclass import dataclass
from linkwright.engine.late import numpy as np
from linkwright.errors import LinkwrightError
from linkwright.fields.signals import InputPhase, MovingPhase, Output, Phase, SwingPhase
from linkwright.fields.strokes import StrokePart
from linkwright.loads.signals import Array, Limit, Mask, Signals, Whole, input_dimension, shown
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.loads.base import Load

TURN = 2 * math.pi
#: Positions this near to the end of a phase (rad, m, or share of the cycle's time) belong to it.
NEAR = 1e-9


@dataclass(frozen=True)
class Activity:
    """``where`` (n,) a load acts; ``share`` (n,) of its phase that is passed, 0 to 1, linear in the input."""

    where: Mask
    share: Array | None = None


@dataclass(frozen=True)
class Stretch:
    """One way of an output from a limit to another; times and inputs go on through the cycle's end.

    ``values``: the output at both limits.
    """

    begin: tuple[float, float]
    end: tuple[float, float]
    values: tuple[float, float]


def activity(phase: Phase | None, signals: Signals, *, ramp: bool = False) -> Activity:
    """When a phase is on, and its share where a ``ramp`` asks for it.

    Raises LinkwrightError where the phase does not exist in the cycle.
    """
    match phase:
        case None:
            return Activity(np.ones(len(signals.time), dtype=bool))
        case InputPhase():
            return _input(phase, signals)
        case MovingPhase():
            return _moving(phase, signals, ramp)
    swings = _swings(phase, signals)
    if phase.part is not None:
        return _in_part(phase.part, swings, signals, phase.output)
    return _along(swings, signals, phase.output, ramp)


def _input(phase: InputPhase, signals: Signals) -> Activity:
    """Closed interval of the input; of angles modulo one turn.

    With ``start`` above ``end`` a turning input goes from start to end in its own direction of motion.
    """
    start, end, q = phase.start, phase.end, signals.input
    if not signals.rotary:
        inside = (q >= min(start, end) - NEAR) & (q <= max(start, end) + NEAR)
        return Activity(inside, np.clip((q - start) / (end - start), 0.0, 1.0))
    length = end - start
    if length < 0 and signals.heading == 0:
        raise LinkwrightError(
            Sentence("loads.phase_to_and_fro", start=shown(start, "angle"), end=shown(end, "angle"))
        )
    if length < 0 and signals.heading > 0:
        length = length % TURN or TURN
    if abs(length) > TURN + NEAR:
        raise LinkwrightError(
            Sentence("loads.phase_too_long", start=shown(start, "angle"), end=shown(end, "angle"))
        )
    gone = (q - min(start, start + length)) % TURN
    gone = np.where(gone > TURN - NEAR, gone - TURN, gone)
    share = np.clip(gone / abs(length), 0.0, 1.0)
    return Activity(gone <= abs(length) + NEAR, share if length > 0 else 1.0 - share)


def _moving(phase: MovingPhase, signals: Signals, ramp: bool) -> Activity:
    """While the exact rate has the asked sign; a ramp goes from each reversal to the next."""
    rate = signals.output(phase.output)[1]
    rising = phase.direction == "increasing"
    where = rate > 0 if rising else rate < 0
    if not ramp:
        return Activity(where)
    limits = _some(signals.limits(phase.output), phase.output)
    ends = ("min", "max") if rising else ("max", "min")
    found = _along(stretches(limits, *ends, signals.whole), signals, phase.output, ramp)
    return Activity(where & found.where, found.share)


def _swings(phase: SwingPhase, signals: Signals) -> list[Stretch]:
    limits = _some(signals.limits(phase.output), phase.output)
    extreme = outermost(limits)
    found = stretches(extreme, phase.start, phase.end, signals.whole)
    if found:
        return found
    places = tuple(
        Sentence(
            "loads.limit_at",
            kind=Sentence(f"loads.{each.kind}"),
            input=shown(each.input, input_dimension(signals)),
        )
        for each in extreme
    )
    raise LinkwrightError(
        Sentence(
            "loads.no_such_swing",
            output=phase.output,
            start=Sentence(f"loads.{phase.start}"),
            end=Sentence(f"loads.{phase.end}"),
            places=places,
        )
    )


def _some(limits: Sequence[Limit], output: Output) -> Sequence[Limit]:
    if limits:
        return limits
    raise LinkwrightError(Sentence("loads.never_reverses", output=output))


def outermost(limits: Sequence[Limit]) -> list[Limit]:
    """Of all reversals those with the largest and the smallest value of the output."""
    values = [each.value for each in limits]
    slack = NEAR * (max(values) - min(values))
    best = {
        "max": max((each.value for each in limits if each.kind == "max"), default=np.inf) - slack,
        "min": min((each.value for each in limits if each.kind == "min"), default=-np.inf) + slack,
    }
    return [
        each
        for each in limits
        if (each.value >= best["max"] if each.kind == "max" else each.value <= best["min"])
    ]


def stretches(limits: Sequence[Limit], start: str, end: str, whole: Whole) -> list[Stretch]:
    """From each limit of one kind to the other kind's next one, across the end of a cycle that closes."""
    found = []
    for index, last in enumerate(limits):
        first = limits[index - 1]
        if (first.kind, last.kind) != (start, end) or (index == 0 and whole.period is None):
            continue
        wrap = index == 0
        period, drift = (whole.period or 0.0, whole.drift) if wrap else (0.0, 0.0)
        begin = (first.time - period, first.input - drift)
        found.append(Stretch(begin, (last.time, last.input), (first.value, last.value)))
    return found


def _along(found: Sequence[Stretch], signals: Signals, output: Output, ramp: bool) -> Activity:
    where = np.zeros(len(signals.time), dtype=bool)
    share = np.zeros(len(signals.time))
    for stretch in found:
        inside, gained = _within(stretch, signals)
        rise = stretch.end[1] - stretch.begin[1]
        if ramp and abs(rise) < NEAR * (1.0 + abs(stretch.end[1])):
            raise LinkwrightError(Sentence("loads.ramp_without_length", output=output))
        where |= inside
        if ramp:
            share = np.where(inside, np.clip(gained / rise, 0.0, 1.0), share)
    return Activity(where, share if ramp else None)


def _in_part(part: StrokePart, found: Sequence[Stretch], signals: Signals, output: Output) -> Activity:
    """Where the output itself is in a part of its stroke; the share grows with the output's way."""
    where = np.zeros(len(signals.time), dtype=bool)
    share = np.zeros(len(signals.time))
    value = signals.output(output)[0]
    for stretch in found:
        start, stroke = stretch.values[0], stretch.values[1] - stretch.values[0]
        begin, end = part.ends(abs(stroke))
        slack = NEAR * abs(stroke)
        if not -slack <= begin < end <= abs(stroke) + slack:
            raise LinkwrightError(
                Sentence(
                    "loads.part_too_long",
                    part=Sentence(f"loads.part_{part.word}"),
                    amounts=" + ".join(
                        shown(each.way(abs(stroke)), output.dimension) for each in part.amounts
                    ),
                    output=output,
                    stroke=shown(abs(stroke), output.dimension),
                )
            )
        gone = (value - start) * np.sign(stroke)
        if output.kind == "angle" and abs(stroke) < TURN:
            gone = gone - TURN * np.floor((gone + (TURN - abs(stroke)) / 2) / TURN)
        inside = _within(stretch, signals)[0] & (gone >= begin - slack) & (gone <= end + slack)
        where |= inside
        share = np.where(inside, np.clip((gone - begin) / (end - begin), 0.0, 1.0), share)
    return Activity(where, share)


def _within(stretch: Stretch, signals: Signals) -> tuple[Mask, Array]:
    """Where the positions lie in a stretch, and what the input has gained since its beginning."""
    length = stretch.end[0] - stretch.begin[0]
    since, gained = signals.time - stretch.begin[0], signals.input - stretch.begin[1]
    whole = signals.whole
    slack = NEAR * (whole.period or length)
    if whole.period is not None:
        laps = np.floor((since + slack) / whole.period)
        since, gained = since - laps * whole.period, gained - laps * whole.drift
    return (since >= -slack) & (since <= length + slack), gained


def switch_times(load: Load, signals: Signals) -> tuple[Array, bool]:
    """Times, s, at which a load begins or ends to act or its table bends, and whether these are all of them.

    Known beforehand: limit positions, and inputs of one driver of constant speed. Times may lie a whole number of
    cycles away.
    """
    phase, table = getattr(load, "phase", None), getattr(load, "table", None)
    found: list[float] = []
    complete = True
    match phase:
        case InputPhase():
            ends = _times_of_inputs(np.array([phase.start, phase.end]), signals)
            complete = ends is not None
            found += [] if ends is None else ends.tolist()
        case MovingPhase() | SwingPhase():
            found += [limit.time for limit in signals.limits(phase.output)]
            complete = getattr(phase, "part", None) is None
    if table is not None and table.over in ("input", "time"):
        knots = np.array(table.x)
        bends = knots if table.over == "time" else _times_of_inputs(knots, signals)
        found += [] if bends is None else bends.tolist()
    return np.array(found), complete


def _times_of_inputs(inputs: Array, signals: Signals) -> Array | None:
    """Times at which the input has some values; of angles modulo one turn, all within the cycle. None where its law
    is no constant speed."""
    law = next(iter(signals.mechanism.drivers.values())).law
    if not law.constant_speed:
        return None
    times = law.time_at(inputs)
    if not signals.rotary:
        return np.asarray(times)
    turn = TURN / abs(law.constant_speed)
    laps = np.arange(np.ceil(np.ptp(signals.time) / turn) + 2) - 1
    first = signals.time.min() + (times - signals.time.min()) % turn
    return np.asarray((first[:, None] + laps * turn).ravel())
