"""When a load acts, and how far its phase has gone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.engine.late_import import numpy as np
from linkwright.errors import LinkwrightError
from linkwright.fields.signals import InputPhase, MovingPhase, SwingPhase
from linkwright.loads.signals import Limit, Signals, Whole, input_dimension, shown
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.loads.base import Load

TURN = 2 * math.pi
#: Positions this near to the end of a phase (rad, m, or share of the cycle's time) belong to it.
NEAR = 1e-9


@dataclass(frozen=True)
class Stretch:
    """One way of an output from a limit to another; times and inputs go on through the cycle's end.

    ``values``: the output at both limits.
    """

    begin: tuple[float, float]
    end: tuple[float, float]
    values: tuple[float, float]


def strokes(phase: MovingPhase | SwingPhase, signals: Signals) -> list[Stretch]:
    """The ways of a phase: of what moves between all its reversals, else between the outermost ones.

    Raises LinkwrightError where the cycle has none.
    """
    limits = signals.limits(phase.output)
    if not limits:
        raise LinkwrightError("loads.never_reverses", output=phase.output)
    if isinstance(phase, SwingPhase):
        return _swings(phase, limits, signals)
    return stretches(limits, phase.start, phase.end, signals.whole)


def _swings(phase: SwingPhase, limits: Sequence[Limit], signals: Signals) -> list[Stretch]:
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
        "loads.no_such_swing",
        output=phase.output,
        start=Sentence(f"loads.{phase.start}"),
        end=Sentence(f"loads.{phase.end}"),
        places=places,
    )


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


def place_on(stretch: Stretch, signals: Signals) -> tuple[Flags, Floats]:
    """Where the positions lie in a stretch, ends included, and the share of the input's way that is passed; (n,)
    each."""
    length, rise = stretch.end[0] - stretch.begin[0], stretch.end[1] - stretch.begin[1]
    since, gained = signals.time - stretch.begin[0], signals.input - stretch.begin[1]
    whole = signals.whole
    slack = NEAR * (whole.period or length)
    if whole.period is not None:
        laps = np.floor((since + slack) / whole.period)
        since, gained = since - laps * whole.period, gained - laps * whole.drift
    return (since >= -slack) & (since <= length + slack), np.clip(gained / rise, 0.0, 1.0)


def switch_times(load: Load, signals: Signals) -> tuple[Floats, bool]:
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


def _times_of_inputs(inputs: Floats, signals: Signals) -> Floats | None:
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
