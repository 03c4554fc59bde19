"""Joints whose coordinates are linear functions of another one, as gears, racks and parallelograms make them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.mjcf.couplings import Coupling, values_with

#: Error (rad or m) up to which a coordinate is an exact linear function, and the motion of it that must be there.
EXACT, MOVES = 1e-9, 1e-6
#: Fewest positions that say so, and the largest denominator of a ratio that is written as such.
FEWEST, DENOMINATOR = 8, 1000


@dataclass(frozen=True)
class Mimic:
    """y - y0 = ``multiplier`` (x - x0) from the start on."""

    follower: str
    leader: str
    multiplier: float


def moved(chains: Chains) -> dict[str, Floats]:
    """Coordinates less that of the start, (n,), by their names: those of a URDF robot, whose start is 0."""
    return {each.name: each.values - each.values[chains.index] for each in chains.coordinates}


def mimics(chains: Chains) -> dict[str, Mimic]:
    """Joints that follow a driven one, or another one that follows none, over all positions that were reached.

    Riders on cut guides are no joints of the tree, and follow nothing.
    """
    reached: Flags = chains.motion.ok
    values = {name: each[reached] for name, each in moved(chains).items()}
    hung = [body.coordinate for body in chains.bodies if body.link is not None and body.coordinate is not None]
    leaders = [each.name for each in hung if each.driver is not None]
    found: dict[str, Mimic] = {}
    if int(reached.sum()) < FEWEST:
        return found
    for each in hung:
        if each.driver is not None:
            continue
        fitting = (_linear(each.name, leader, values) for leader in leaders)
        mimic = next((each for each in fitting if each is not None), None)
        if mimic is None:
            leaders.append(each.name)
        else:
            found[each.name] = mimic
    return found


def _linear(follower: str, leader: str, values: Mapping[str, Floats]) -> Mimic | None:
    """One joint as a multiple of another one; None: it is none, or one of them does not move."""
    x, y = values[leader], values[follower]
    if min(float(np.ptp(x)), float(np.ptp(y))) < MOVES:
        return None
    factor = float(x @ y / (x @ x))
    near = float(Fraction(factor).limit_denominator(DENOMINATOR))
    factor = near if abs(near - factor) < EXACT else factor
    return Mimic(follower, leader, factor) if float(np.abs(y - factor * x).max()) <= EXACT else None


def with_mimics(chains: Chains, found: Mapping[str, Mimic]) -> dict[str, Floats]:
    """Coordinates at all positions, with those that mimic taken from their leaders."""
    couplings = [Coupling(each.follower, each.leader, (0.0, each.multiplier)) for each in found.values()]
    return values_with(chains, couplings, {each.name: each.values for each in chains.coordinates})
