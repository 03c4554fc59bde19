"""Trains of wheels on one carrier: the ratios of all wheels to the first one, with the carrier stopped."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from linkwright.joints.base import Joint, LackingError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.constraints import Classes

#: Denominators up to this are shown as fractions.
LARGEST = 100000
#: Sizes below this are zero, of rows whose largest factor is one.
STILL = 1e-9


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

    @property
    def speeds(self) -> dict[str, float]:
        """Speeds of all wheels and the carrier over that of the first one that turns, where a wheel belongs to the
        frame (i_1H = 1 - i_13 with the carrier stopped); empty where none does, or where the wheels block each
        other."""
        fixed = self.ratios.get("frame")
        if fixed is None or not self.planetary or self.blocked:
            return {}
        found = {wheel: ratio - fixed for wheel, ratio in self.ratios.items()} | {self.carrier: -fixed}
        first = next((each for each in found.values() if each), None)
        return {} if first is None else {name: each / first for name, each in found.items()}


def gear_trains(mechanism: Mechanism) -> tuple[GearTrain, ...]:
    """The trains of a mechanism's gears, belts, chains and rolling wheels, by carrier in the order of the file."""
    pairs = [_Mesh.of(joint, mechanism) for joint in mechanism.joints.values() if joint.rotations_only]
    found: list[GearTrain] = []
    used: set[str] = set()
    for pair in pairs:
        if pair.name not in used:
            train = _from(pair, [each for each in pairs if each.carrier == pair.carrier])
            used.update(train.pairs)
            found.append(train)
    return tuple(found)


@dataclass(frozen=True)
class _Mesh:
    """Wheels a and b on a carrier c, and their ratio (ω_b - ω_c) / (ω_a - ω_c)."""

    name: str
    a: str
    b: str
    carrier: str
    ratio: float

    @classmethod
    def of(cls, pair: Joint, mechanism: Mechanism) -> _Mesh:
        """From the sum of rotations that is a pair's row."""
        (a, b, carrier), factors = pair.turning, pair.sums(mechanism)[0]
        return cls(pair.name, a, b, carrier, -factors[a] / factors[b])


def _from(start: _Mesh, pairs: Iterable[_Mesh]) -> GearTrain:
    """The train that a pair belongs to."""
    ratios, names, blocked = {start.a: 1.0}, list[str](), list[str]()
    waiting = list(pairs)
    while step := next((p for p in waiting if p.a in ratios or p.b in ratios), None):
        waiting.remove(step)
        names.append(step.name)
        if step.a not in ratios:
            ratios[step.a] = ratios[step.b] / step.ratio
            continue
        follows = ratios[step.a] * step.ratio
        if abs(ratios.setdefault(step.b, follows) - follows) > 1e-9 * abs(follows):
            blocked.append(step.name)
    return GearTrain(start.carrier, ratios, tuple(names), tuple(blocked))


def blocking_pairs(mechanism: Mechanism) -> list[str]:
    """Names of higher pairs that hold a rotation or a displacement still between them, as few as do so; empty where
    none do. Rotations that guides and welds tie are one."""
    import numpy as np

    root = _tied(mechanism)
    rows: dict[str, dict[str, float]] = {}
    for name, joint in mechanism.joints.items():
        try:
            rotations, slides = joint.tied(mechanism) if joint.higher else ({}, {})
        except LackingError:
            continue
        row: dict[str, float] = {}
        turns = ((f"turn {root(link)}", factor) for link, factor in rotations.items())
        for each, factor in (*turns, *slides.items()):
            if each != f"turn {root('frame')}":
                row[each] = row.get(each, 0.0) + factor
        if row:
            rows[name] = row

    def hold(names: list[str]) -> bool:
        columns = sorted({each for name in names for each in rows[name]})
        matrix = np.array([[rows[name].get(each, 0.0) for each in columns] for name in names])
        matrix = matrix.reshape(len(names), len(columns)) / np.abs(matrix).max(initial=0.0, axis=-1, keepdims=True)
        _, sizes, ways = np.linalg.svd(matrix)
        free = ways[int((sizes > STILL).sum()) :]
        return bool((np.abs(free) < STILL).all(axis=0).any())

    found = list(rows)
    if not found or not hold(found):
        return []
    for name in list(rows):
        fewer = [each for each in found if each != name]
        if fewer and hold(fewer):
            found = fewer
    return found


def _tied(mechanism: Mechanism) -> Callable[[str], str]:
    """The representative of all links whose rotations are tied to that of a link."""
    ties = Classes()
    for joint in mechanism.joints.values():
        if joint.ties:
            ties.join(*joint.ties)
    return ties.root


def written(ratio: float) -> str:
    """A ratio as a fraction of integers where it is one."""
    from fractions import Fraction

    part = Fraction(ratio).limit_denominator(LARGEST)
    return str(part) if abs(float(part) - ratio) <= 1e-12 * abs(ratio) else f"{ratio:.6g}"
