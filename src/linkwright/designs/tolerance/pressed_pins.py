"""Clearances that follow the joint's own reaction: what a pin pressed against its hole does to positions.

The joint's force on the link with the hole, F, is that of the pin against the hole: the pin's centre lies at
r = c F/|F| from the hole's centre. To first order in c an output y(φ) changes by
Σ c (∂y/∂x_h F_x + ∂y/∂y_h F_y)/|F|, with exact derivatives at fixed input and the forces of the nominal mechanism;
:func:`exact` solves every position with the moved pin and its own force instead.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import PLACES
from linkwright.designs.tolerance.problem import Tolerances
from linkwright.errors import LinkwrightError
from linkwright.kinematics.names import output_meant
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.words import _

#: Rounds in which the force follows the moved pin.
ROUNDS = 3
#: A force below this share of the largest over the cycle has no direction.
FAINT = 1e-9


def directions(study: Tolerances, forces: Forces) -> dict[str, Floats]:
    """Where each pressed pin lies, as unit vectors (n, 2) in the axes of the hole's link; zero without a force."""
    found = {}
    for pin in study.holes("pressed"):
        on = study.clearances[pin].on
        force = forces.reaction(pin, on=on, axes="frame" if on == "frame" else on)
        size = np.hypot(*force.T)
        strong = size > FAINT * max(float(size.max()), 1e-300)
        found[pin] = np.where(strong[:, None], force / np.where(strong, size, 1.0)[:, None], 0.0)
    return found


def require_forces(study: Tolerances) -> Forces:
    """The nominal forces; LinkwrightError where a pressed pin carries none."""
    forces = solve_forces(study.prepared, steps=study.steps)
    for pin, way in directions(study, forces).items():
        if not way.any():
            raise LinkwrightError(
                _(
                    "the pin {pin} carries no force, so nothing presses it; give masses, gravity or loads",
                    code="tolerance.no_force",
                    pin=pin,
                )
            )
    return forces


def shifts(study: Tolerances, slopes: Callable[[str], Floats], forces: Forces) -> Floats:
    """Change (n,) of one output by all pressed pins to first order; ``slopes`` gives its derivatives (n,)."""
    total = np.zeros(forces.steps)
    for pin, way in directions(study, forces).items():
        along, across = study.holes("pressed")[pin]
        size = study.clearances[pin].clearance
        total += size * (slopes(along) * way[:, 0] + slopes(across) * way[:, 1])
    return total


def exact(study: Tolerances, output: str) -> Floats:
    """An angle, coordinate or displacement (n,) with all pressed pins moved, each position solved for itself."""
    from linkwright.designs.prepared import prepare

    holes = study.holes("pressed")
    addresses = [address for pair in holes.values() for address in pair]
    solver = prepare(study.prepared, vary=addresses, steps=study.steps)
    nominal = study.prepared.dimensions()
    forces = solver.solve({})
    ways = directions(study, forces)
    meant = output_meant(study.mechanism, output)
    found = np.empty(study.steps if forces.motion.positions.closed else forces.steps)
    for i in range(len(found)):
        here = {pin: way[i] for pin, way in ways.items()}
        for _unused in range(ROUNDS):
            solved = solver.solve(_moved(study, holes, nominal, here))
            here = {pin: way[i] for pin, way in directions(study, solved).items()}
        found[i] = solved.motion.read(meant)[i]
    return found


def _moved(
    study: Tolerances, holes: Mapping[str, tuple[str, str]], nominal: Mapping[str, float], ways: Mapping[str, Floats]
) -> dict[str, float]:
    changes = {}
    for pin, pair in holes.items():
        for address, part in zip(pair, ways[pin], strict=True):
            changes[address] = nominal[address] + study.clearances[pin].clearance * float(part)
    return changes


def is_position(study: Tolerances, output: str) -> bool:
    """Whether an output is an angle, a coordinate or a displacement."""
    return output_meant(study.mechanism, output).kind in PLACES
