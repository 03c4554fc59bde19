"""Trains of wheels on one carrier: the ratios of all wheels to the first one, with the carrier stopped."""

from __future__ import annotations

from typing import Any

from linkwright.core.dataclass import dataclass
from linkwright.mechanism.mechanism import Mechanism

#: Denominators up to this are shown as fractions.
LARGEST = 100000


@dataclass(frozen=True)
class GearTrain:
    """Wheels that mesh with each other (or share belts) on one ``carrier``.

    ``ratios``: (ω - ω_c) / (ω_1 - ω_c) of every wheel to the first one, by name, the method of the stopped carrier
    (Willis 1841): in any motion ω = ω_c + ratio (ω_1 - ω_c). ``pairs``: names of the joints. A pair that would give a
    wheel another ratio is in ``blocked``: then the wheels cannot turn against the carrier.
    """

    carrier: str
    ratios: dict[str, float]
    pairs: tuple[str, ...]
    blocked: tuple[str, ...] = ()

    @property
    def first(self) -> str:
        """The wheel to which the ratios are."""
        return next(iter(self.ratios))

    @property
    def planetary(self) -> bool:
        """Whether the carrier moves."""
        return self.carrier != "frame"


def gear_trains(mechanism: Mechanism) -> tuple[GearTrain, ...]:
    """The trains of a mechanism's gears, belts, chains and rolling wheels, by carrier in the order of the file."""
    pairs: list[Any] = [joint for joint in mechanism.joints.values() if joint.rotations_only]
    found: list[GearTrain] = []
    used: set[str] = set()
    for pair in pairs:
        if pair.name not in used:
            train = _from(pair, [each for each in pairs if each.carrier == pair.carrier])
            used.update(train.pairs)
            found.append(train)
    return tuple(found)


def _from(start: Any, pairs: list[Any]) -> GearTrain:
    """The train that a pair belongs to."""
    ratios, names, blocked = {start.links[0]: 1.0}, list[str](), list[str]()
    waiting = list(pairs)
    while step := next((p for p in waiting if set(p.links) & ratios.keys()), None):
        waiting.remove(step)
        names.append(step.name)
        a, b = step.links
        if a in ratios and b in ratios:
            if abs(ratios[b] - ratios[a] * step.transmission) > 1e-9 * abs(ratios[b]):
                blocked.append(step.name)
        elif a in ratios:
            ratios[b] = ratios[a] * step.transmission
        else:
            ratios[a] = ratios[b] / step.transmission
    return GearTrain(start.carrier, ratios, tuple(names), tuple(blocked))


def written(ratio: float) -> str:
    """A ratio as a fraction of whole numbers where it is one."""
    from fractions import Fraction

    part = Fraction(ratio).limit_denominator(LARGEST)
    return str(part) if abs(float(part) - ratio) <= 1e-12 * abs(ratio) else f"{ratio:.6g}"
