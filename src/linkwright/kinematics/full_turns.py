"""How many turns of the drivers it takes until all wheels are back: the cycle of a mechanism with gears or belts."""

from __future__ import annotations

from math import lcm

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.outputs import row_name
from linkwright.kinematics.positions import at_times
from linkwright.kinematics.rotation_sums import Key, RotationSums, Terms
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure

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
