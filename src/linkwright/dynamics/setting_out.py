"""How a mechanism sets out from one position: what moves, rests, sticks or jams."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal, NamedTuple

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.dynamics.description import Description
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.integration import Piece
from linkwright.dynamics.samples import Part, Samples
from linkwright.dynamics.settling import settle_anew
from linkwright.dynamics.singular import Stretch
from linkwright.dynamics.states import motion_at
from linkwright.dynamics.system import System
from linkwright.errors import LinkwrightError
from linkwright.kinematics.positions import Positions
from linkwright.words import _

#: An acceleration (of the largest) that is zero but for rounding.
NO_ACCELERATION = 1e-11
#: What is left of M, as share of its diagonal, below which some inputs together move nothing that has inertia.
NO_INERTIA = 1e-12
#: What becomes of a mechanism let go at rest.
Outcome = Literal["moves", "rests", "sticks", "jams"]


class SetOut(NamedTuple):
    """The moment in which a mechanism sets out, what becomes of it, and accelerations (free,) each way, where these
    differ by friction."""

    moment: Samples
    outcome: Outcome
    ways: list[Floats]


def set_out(equation: EquationOfMotion, start: Positions) -> SetOut:
    """What becomes of a mechanism at a position and rates.

    Raises:
        LinkwrightError: a position that is not reached or singular, an input without inertia.
    """
    tracked = equation.solver.track(start, separate=True)
    states = {} if tracked is None else dict(tracked.states)
    system, t, y = _system(equation, states), float(start.time[0]), _state(equation, start)
    motion = motion_at(_moment(system, t, y, states))
    if not motion.ok[0]:
        raise motion.refusal()
    if system.free:
        _require_inertia(system, t, y)
    y = settle_anew(system, t, y, ())
    outcome, ways = _outcome(system, t, y)
    return SetOut(_moment(system, t, y, states), outcome, ways)


def _system(equation: EquationOfMotion, states: Mapping[str, Floats]) -> System:
    begin = {name: float(row[0]) for name, row in states.items()}
    description = Description.of(equation)
    return System(Stretch(replace(description, states=begin) if begin else description))


def _state(equation: EquationOfMotion, start: Positions) -> Floats:
    """(free coordinates, their rates, no work)."""
    course = [start.coordinates[name] for name in equation.free]
    return np.array([*(q[0] for q, _w, _a in course), *(w[0] for _q, w, _a in course), 0.0])


def _moment(system: System, t: float, y: Floats, states: Mapping[str, Floats]) -> Samples:
    part = Part(system.equation, Piece.resting(system, t, y), np.array([t]))
    return Samples(system.equation, [part], cycle=False, states=states)


def _outcome(system: System, t: float, y: Floats) -> tuple[Outcome, list[Floats]]:
    """What becomes of it, and the accelerations each way; where it jams the system goes the first one."""
    n = len(system.free)
    slips = system.slipping(t, y)
    ways, found = [each.accelerations for each in slips], system(t, y)[n : 2 * n]
    small = NO_ACCELERATION * float(np.abs([found, *ways]).max(initial=1.0))
    still = not y[n : 2 * n].any()
    if n and still and all((np.abs(each) <= small).all() for each in (found, *ways)):
        return "rests", []
    going = [each for each in slips if each.goes_on and (np.abs(each.accelerations) > small).any()]
    if any(not np.allclose(each.accelerations, going[0].accelerations) for each in going):
        system.hold(going[0].holding)
        return "jams", ways
    sticks = system.holding.stick and (np.abs(found) <= small).all()
    return "sticks" if sticks else "moves", ways


def _require_inertia(system: System, t: float, y: Floats) -> None:
    """Refuses inputs without inertia."""
    matrix = system.mass(system.outputs(t, y))
    sizes = np.sqrt(np.maximum(np.diag(matrix), 0.0))
    places = dict(zip(system.free, y.tolist(), strict=False))
    for name, size in zip(system.free, sizes.tolist(), strict=True):
        if not size > 0.0:
            _refuse_without_inertia(system.equation, name, places)
    if not np.linalg.eigvalsh(matrix / np.outer(sizes, sizes))[0] > NO_INERTIA:
        _refuse_without_inertia(system.equation, system.free[-1], places)


def _refuse_without_inertia(equation: EquationOfMotion, name: str, places: Mapping[str, float]) -> None:
    where = shown(places[name], "angle" if equation.rotary[name] else "length")
    raise LinkwrightError(
        _(
            "nothing that input {name!r} moves has mass or inertia at {where}, so forces give it no finite "
            "acceleration; give links mass and inertia",
            code="dynamics.no_inertia",
            name=name,
            where=where,
        )
    )
