"""The link-freedom/constraint graph of a mechanism, and the trains of wheels on one carrier in it.

Unknowns are the three freedoms of every moving link and the two of every pin that joins three links
or more; equations are what joints and drivers demand. A guide's demand on the rotation touches only
rotations, so a loop of guides that fixes a rotation twice is found here and counted once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

from linkwright.core.linear_sums import SMALL, LinearSums
from linkwright.joints.base import Joint, LackingError
from linkwright.mechanism.mechanism import Mechanism

FRAME = "frame"
#: Prefix of a driver's name where it is the source of a demand.
DRIVER = "driver "


@dataclass(frozen=True)
class Equation:
    """One demand: its source (joint or driver), the bodies it touches, and whether only rotations."""

    source: str
    bodies: tuple[str, ...]
    rotation_only: bool = False


class Classes:
    """Links whose rotations are tied to each other (union-find)."""

    def __init__(self) -> None:
        self.parent: dict[str, str] = {}

    def root(self, name: str) -> str:
        while (above := self.parent.get(name, name)) != name:
            self.parent[name] = self.parent.get(above, above)
            name = above
        return name

    def join(self, a: str, b: str) -> bool:
        """Ties two rotations; False if they already were."""
        a, b = self.root(a), self.root(b)
        self.parent[a] = b
        return a != b


@dataclass
class ConstraintGraph:
    """Bodies (links and shared pins) with their freedoms, and the equations between them."""

    freedoms: dict[str, int]
    equations: list[Equation]
    redundant: list[str] = field(default_factory=list)
    rotations: Classes = field(default_factory=Classes)
    sums: LinearSums[str] = field(default_factory=LinearSums)

    @classmethod
    def of(cls, mechanism: Mechanism) -> ConstraintGraph:
        """The graph of a mechanism with its drivers."""
        graph = cls(dict.fromkeys(mechanism.links, 3), [])
        for joint in sorted(mechanism.joints.values(), key=lambda each: not each.ties):
            graph.add(joint, mechanism)
        for driver in mechanism.drivers.values():
            turning = mechanism.joints[driver.joint].coordinate == "turn"
            if turning:
                graph.rotations.join(driver.link, driver.relative_to)
            graph.demand(f"{DRIVER}{driver.name}", (driver.link, driver.relative_to), rotation_only=turning)
        return graph

    def add(self, joint: Joint, mechanism: Mechanism) -> None:
        """The demands of a joint: a sum of rotations, the one row of another higher pair, or those of a lower pair on
        rotations and places of its links. A pin of three links or more is a body of its own."""
        name, links = joint.name, joint.joined
        if joint.rotations_only:
            self.sum_rotations(name, joint.sums(mechanism)[0])
        elif joint.higher:
            self.demand(name, links)
        elif len(links) > 2:
            self.freedoms[pin := f"pin {name}"] = 2
            for link in links:
                self.demand(name, (link, pin), 2)
        else:
            if joint.ties:
                self.hold_rotation(name, *joint.ties)
            self.demand(name, links, 3 - joint.freedoms - bool(joint.ties))

    def hold_rotation(self, source: str, a: str, b: str) -> None:
        """The demand that two links keep their angle to each other, noted as redundant if others hold it already."""
        if self.rotations.join(a, b):
            self.sums.add({link: sign for link, sign in ((a, 1.0), (b, -1.0)) if link != FRAME})
            self.demand(source, (a, b), rotation_only=True)
        else:
            self.redundant.append(source)

    def sum_rotations(self, source: str, factors: Mapping[str, float]) -> None:
        """The demand that Σ factor · rotation of a link is constant; redundant if others hold it already."""
        nonzero = {link: factor for link, factor in factors.items() if link != FRAME and abs(factor) > SMALL}
        if self.sums.add(nonzero):
            self.demand(source, tuple(nonzero), rotation_only=True)
        else:
            self.redundant.append(source)

    def demand(self, source: str, bodies: tuple[str, ...], times: int = 1, *, rotation_only: bool = False) -> None:
        """Adds a demand of a joint or driver on bodies; ``rotation_only``: it touches only their rotations."""
        moving = tuple(body for body in bodies if body != FRAME)
        self.equations.extend([Equation(source, moving, rotation_only)] * times)

    def places(self) -> tuple[dict[str, int], list[str]]:
        """First place (column) of every body, and the body of every place."""
        first: dict[str, int] = {}
        owners: list[str] = []
        for body, count in self.freedoms.items():
            first[body] = len(owners)
            owners += [body] * count
        return first, owners

    def choices(self) -> list[list[int]]:
        """The places that every equation may determine; the last place of a link is its rotation."""
        first, _ = self.places()
        rows = []
        for equation in self.equations:
            row: list[int] = []
            for body in equation.bodies:
                span = range(first[body], first[body] + self.freedoms[body])
                row += [span[-1]] if equation.rotation_only else list(span)
            rows.append(row)
        return rows


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
