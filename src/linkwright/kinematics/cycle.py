"""The cycle of a mechanism: how long it takes until drivers, wheels and racks are back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from itertools import chain
from math import lcm

import numpy as np

from linkwright.core.arguments import integer
from linkwright.core.arrays import Floats, Indices
from linkwright.core.outputs import row_name
from linkwright.drivers.base import Driver, Law
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.positions import CycleError, Positions, at_times, refuse_free, rotary
from linkwright.kinematics.rotations import Key, RotationSums, Terms
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure
from linkwright.words import _

#: More positions of a cycle than one computer takes at once.
MOST_POSITIONS = 10_000_000
#: A cycle in which drivers of several speeds come back is taken by itself up to so many turns of the slowest one.
FEW = 12


def over_cycle(mechanism: Mechanism, steps: int, endpoint: bool = False) -> Positions:
    """``steps`` equal steps over the cycle of the mechanism.

    A closed cycle (full turns of a driver, or a law that repeats) gives ``steps`` positions, or one more with
    ``endpoint``; an open one always ``steps`` + 1 positions, both ends among them.
    """
    steps = integer("steps", steps, 1, MOST_POSITIONS)
    if not mechanism.drivers:
        return at_times(mechanism, [0.0])
    if mechanism.higher:
        return _over_cycle(mechanism, steps, endpoint)
    turning = tuple(rotary(mechanism).values())
    key = (steps, endpoint, mechanism.cycle, turning)
    return _cycles.get(mechanism.drivers, key, lambda: _over_cycle(mechanism, steps, endpoint))


#: Of machines without wheels, whose cycle their drivers alone decide.
_cycles: Recent[Mapping[str, Driver], Positions] = Recent(16)


def _over_cycle(mechanism: Mechanism, steps: int, endpoint: bool) -> Positions:
    start, duration, closed = time_span(mechanism)
    count = steps if closed and not endpoint else steps + 1
    time = start + duration * np.arange(count) / steps
    found = replace(at_times(mechanism, time, duration if closed else None), cycle=True)
    for row in (found.time, *chain.from_iterable(found.coordinates.values())):
        row.flags.writeable = False
    return found


def time_span(mechanism: Mechanism) -> tuple[float, float, bool]:
    """Start and duration (s) of the cycle, and whether it closes."""
    cycle = mechanism.cycle
    first = next(iter(mechanism.drivers.values()))
    refuse_free(mechanism)
    known = _naturals(mechanism)
    if (cycle is None or cycle.natural) and not known:
        problem = (
            _(
                "the cycle of {name!r} has no natural end, as driver {driver!r} does not turn; write "
                "cycle: rock, cycle: {{from: …, to: …}} (the driver's coordinate) or cycle: {{duration: 2 s}}",
                code="motion.no_natural_end",
            )
            if first.law.constant_speed
            else _(
                "the cycle of {name!r} has no natural end, as driver {driver!r} follows a law in "
                "time; write how long it is: cycle: {{duration: 2 s}}",
                code="motion.law_without_end",
            )
        )
        raise CycleError(problem.format(name=mechanism.name, driver=first.name))
    if cycle is None or cycle.natural:
        full_span = _full_span(mechanism) if together(mechanism) <= FEW else None
        return 0.0, full_span or max(known), full_span is not None
    if cycle.duration is not None:
        return 0.0, cycle.duration, _closes(mechanism, cycle.duration)
    speed = first.law.constant_speed
    if not speed:
        raise CycleError(
            _(
                "the cycle is given by the coordinate of driver {name!r}, which has no constant "
                "speed; write cycle: {{duration: …}} instead",
                code="motion.cycle_by_coordinate",
                name=first.name,
            )
        )
    if cycle.turns is not None:
        duration = cycle.turns * 2 * np.pi / abs(speed)
        return 0.0, duration, _closes(mechanism, duration)
    begin = first.law.at(0.0) if cycle.start is None else cycle.start
    assert cycle.end is not None
    return float(first.law.time_at(begin)), (cycle.end - begin) / speed, False


def cycle_turns(mechanism: Mechanism, period: float) -> tuple[int, str]:
    """How often the slowest driver comes back within a period, s, and its name."""
    natural = {driver.law.natural_duration() or 0.0: name for name, driver in mechanism.drivers.items()}
    return round(period / max(natural)), natural[max(natural)]


def not_back(mechanism: Mechanism) -> bool:
    """Whether the drivers come back together, but never all wheels and racks with them."""
    return math.isfinite(together(mechanism)) and _full_span(mechanism) is None


def together(mechanism: Mechanism) -> float:
    """After how many of the longest natural duration all drivers are back; ∞: not within 1000; NaN: never, as one of
    them that does not stand has no such duration, ends, or does not come back."""
    laws = [each.law for each in mechanism.drivers.values() if each.law.constant_speed != 0.0]
    known = _naturals(mechanism)
    if not known or len(known) < len(laws):
        return math.nan
    longest, count = max(known), 1
    for duration in (each for each in known if not _multiple(longest, each)):
        from fractions import Fraction

        count = math.lcm(count, Fraction(longest / duration).limit_denominator(MOST).denominator)
    common = count * longest
    if count > MOST or not all(_multiple(common, duration) for duration in known):
        return math.inf if all(law.span()[1] == math.inf for law in laws) else math.nan
    return count if all(_back(law, common) for law in laws) else math.nan


def _full_span(mechanism: Mechanism) -> float | None:
    """Time in s after which drivers, wheels and racks are all back; None: never, or not within 1000 turns."""
    count = together(mechanism)
    if not math.isfinite(count):
        return None
    span = count * max(_naturals(mechanism))
    turns = full_turns(mechanism, span)
    return None if turns is None else turns * span


def _closes(mechanism: Mechanism, duration: float) -> bool:
    full_span = _full_span(mechanism)
    return full_span is not None and _multiple(duration, full_span)


def _naturals(mechanism: Mechanism) -> list[float]:
    natural = [driver.law.natural_duration() for driver in mechanism.drivers.values()]
    return [duration for duration in natural if duration is not None]


def _back(law: Law, duration: float) -> bool:
    """Whether a law is where it began after a time."""
    first, last = law.span()
    if first > 0.0 or last < duration:
        return False
    ends = law.coordinate(np.array([0.0, duration]))
    wrap = 2 * np.pi if law.rotary and last == np.inf else np.inf
    gap = abs(ends[0][1] - ends[0][0])
    gap = min(gap % wrap, wrap - gap % wrap) if np.isfinite(wrap) else gap
    return bool(gap <= 1e-9 * (1 + abs(ends[0][0])))


def _multiple(total: float, part: float) -> bool:
    return abs(total / part - round(total / part)) < 1e-9


#: Cycles of more turns are not looked for.
MOST = 1000
#: A rotation this near (turns) to an integer number of turns is one.
FULL_TURN = 1e-9


def full_turns(mechanism: Mechanism, duration: float) -> int | None:
    """After how many times ``duration`` (s), after which the drivers are back, all links are; None: never, or not
    within 1000 times."""
    if not mechanism.higher:
        return 1
    structure = analysed(mechanism)
    first = _gained(mechanism, structure, duration, driven_only=True)
    ahead = None if first is None else _count(first[0])
    if ahead is None:
        return None
    gained = _gained(mechanism, structure, ahead * duration)
    if gained is None or np.abs(gained[1]).max(initial=0.0) > FULL_TURN:
        return None
    count = _count(gained[0])
    return None if count is None or ahead * count > MOST else ahead * count


def _count(turns: Floats) -> int | None:
    """After how many times all of these turns (of one time each) are integers."""
    from fractions import Fraction

    count = 1
    for turn in turns:
        part = Fraction(float(turn)).limit_denominator(MOST)
        count = lcm(count, part.denominator)
        if abs(turn - float(part)) > FULL_TURN or count > MOST:
            return None
    return count


def _gained(
    mechanism: Mechanism, structure: Structure, duration: float, *, driven_only: bool = False
) -> tuple[Floats, Floats] | None:
    """By how many turns every link turns, and by how many metres wheels move slides, while the drivers come back.

    ``driven_only``: of links that follow the drivers through wheels alone, and no slides.
    """
    sums = RotationSums(mechanism, structure)
    unknowns = sums.unknowns
    columns = {key: i for i, key in enumerate([*unknowns, *(("drive", name) for name in mechanism.drivers)])}

    def row(terms: Terms) -> Floats:
        found = np.zeros(len(columns))
        for key, factor in sums.reduced(terms).items():
            found[columns[key]] += factor
        return found

    rotations = [row(terms) for terms in sums.rotations.values()]
    slides = [row({key: 1.0}) for key in sums.sums if key[0] == "slide"]
    if driven_only:
        free = len(unknowns)
        rotations, slides = [each for each in rotations if not each[:free].any()], []
    change = _change(mechanism, unknowns, rotations, slides, duration)
    if change is None:
        return None
    return np.array(rotations) @ change / (2.0 * np.pi), np.array(slides).reshape(-1, len(columns)) @ change


def _change(
    mechanism: Mechanism, unknowns: list[Key], rotations: list[Floats], slides: list[Floats], duration: float
) -> Floats | None:
    """What unknowns and drivers gain; not of unknowns on which no wheels hang."""
    ends = [driver.law.coordinate(np.array([0.0, duration]))[0] for driver in mechanism.drivers.values()]
    gained = np.array([0.0] * len(unknowns) + [float(end[1] - end[0]) for end in ends])
    count = len(unknowns)
    turning = np.array(rotations)[:, :count]
    sliding = np.array(slides).reshape(-1, len(gained))[:, :count]
    uneven = np.abs(turning - np.round(turning)).max(axis=0, initial=0.0)
    wanted = np.flatnonzero(np.maximum(uneven, np.abs(sliding).max(axis=0, initial=0.0)) > FULL_TURN)
    if not len(wanted):
        return gained
    solver = MotionSolver(mechanism)
    tracked = solver.track(at_times(mechanism, [0.0, duration]))
    if tracked is None:
        return _by_places(solver, unknowns, wanted, gained, duration)
    if not np.isfinite(tracked.coordinates).all():
        return None
    known = tracked.tracker.named(tracked.coordinates)
    for i in wanted:
        if unknowns[i] in known:
            gained[i] = float(np.diff(known[unknowns[i]])[0])
    return gained


def _by_places(
    solver: MotionSolver, unknowns: list[Key], wanted: Indices, gained: Floats, duration: float
) -> Floats | None:
    """The same from the places of slides at both times, where rotations cannot be tracked; None for rotations."""
    names = [unknowns[i][1] for i in wanted if unknowns[i][0] == "slide"]
    if len(names) < len(wanted):
        return None
    outputs = tuple(row_name("displacement", name) for name in names)
    positions = at_times(solver.mechanism, [0.0, duration])
    *places, outcomes = solver.evaluate((*outputs, "outcome"), positions, {}, {})
    if outcomes.any():
        return None
    for i, place in zip(wanted, places, strict=True):
        gained[i] = float(np.diff(place)[0])
    return gained
