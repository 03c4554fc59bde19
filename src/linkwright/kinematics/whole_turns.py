"""How many turns of the drivers it takes until all wheels are back: the cycle of a mechanism with gears or belts."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

import numpy as np

from linkwright.kinematics.closed_loops import Floats, LoopBuilder
from linkwright.model.mechanism import Mechanism
from linkwright.structure.group import Structure

#: Cycles of more turns are not looked for.
MOST = 1000
#: A rotation this near (turns) to a whole number of turns is one.
WHOLE = 1e-9


def whole_turns(mechanism: Mechanism, duration: float) -> int | None:
    """After how many times ``duration`` (s), after which the drivers are back, all links are; None: never, or not
    within 1000 times."""
    if not any(joint.higher for joint in mechanism.joints.values()):
        return 1
    from linkwright.kinematics.rank import analysed

    structure = analysed(mechanism)
    gained = _gained(mechanism, structure, duration)
    if gained is None:
        return None
    turns, slides = gained
    if np.abs(slides).max(initial=0.0) > WHOLE:
        return None
    count = 1
    for turn in turns:
        part = Fraction(float(turn)).limit_denominator(MOST)
        count = lcm(count, part.denominator)
        if abs(turn - float(part)) > WHOLE or count > MOST:
            return None
    return count


def _gained(mechanism: Mechanism, structure: Structure, duration: float) -> tuple[Floats, Floats] | None:
    """By how many turns every link turns, and by how many metres wheels move slides, while the drivers come back."""
    build = LoopBuilder(mechanism, gains=True)
    for group in structure.groups:
        build.add(group)
    unknowns, sums = build.independent()
    columns = {key: i for i, key in enumerate([*unknowns, *(("drive", name) for name in mechanism.drivers)])}

    def row(terms: dict[tuple[str, str], float]) -> Floats:
        found = np.zeros(len(columns))
        for key, factor in terms.items():
            for each, share in sums.get(key, ({key: 1.0}, 0.0))[0].items():
                found[columns[each]] += factor * share
        return found

    rotations = [
        row({("turn", unknown): 1.0} if unknown else {})
        + row({("drive", name): sign for name, sign in turns})
        for unknown, turns in build.rotations
    ]
    slides = [row({key: 1.0}) for key in sums if key[0] == "slide"]
    change = _change(mechanism, unknowns, rotations, slides, duration)
    if change is None:
        return None
    return np.array(rotations) @ change / (2.0 * np.pi), np.array(slides).reshape(-1, len(columns)) @ change


def _change(
    mechanism: Mechanism,
    unknowns: list[tuple[str, str]],
    rotations: list[Floats],
    slides: list[Floats],
    duration: float,
) -> Floats | None:
    """What unknowns and drivers gain; of unknowns on which no wheels hang, nothing is said."""
    ends = [driver.law.coordinate(np.array([0.0, duration]))[0] for driver in mechanism.drivers.values()]
    gained = np.array([0.0] * len(unknowns) + [float(end[1] - end[0]) for end in ends])
    count = len(unknowns)
    turning = np.array(rotations)[:, :count]
    sliding = np.array(slides).reshape(-1, len(gained))[:, :count]
    uneven = np.abs(turning - np.round(turning)).max(axis=0, initial=0.0)
    wanted = np.flatnonzero(np.maximum(uneven, np.abs(sliding).max(axis=0, initial=0.0)) > WHOLE)
    if not len(wanted):
        return gained
    from linkwright.kinematics.cycle import at_times
    from linkwright.kinematics.solver import MotionSolver

    solver = MotionSolver(mechanism)
    followed = solver.follow(at_times(mechanism, [0.0, duration]))
    if followed is None or not np.isfinite(followed.coordinates).all():
        return None
    loops = followed.follower.loops
    y = np.concatenate([followed.coordinates, followed.inputs], axis=1)
    known = {key: loops.value(key, y) for key in {*loops.unknowns, *loops.sums}}
    for i in wanted:
        if unknowns[i] in known:
            gained[i] = float(np.diff(known[unknowns[i]])[0])
    return gained
