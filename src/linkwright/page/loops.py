"""The closed loops of groups without closed form as plain data, for the certificate that a page makes of them.

Arms are sums of places of points in the axes of their links, which a page reads from its own rows, and of offsets of
guides; angles of guides and welds turn arms and slides. All else holds for all dimensions but the ``fixed`` ones.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.json_data import Plain
from linkwright.errors import LinkwrightError
from linkwright.kinematics.closed_loops import ClosedLoops, Key, LoopBuilder, Terms, upstream
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.mechanism.mechanism import Mechanism

#: Relative and absolute change (m, rad) by which dimensions are tried.
TRIED = 1e-3, 1e-4
SAME = 1e-12


@dataclass(frozen=True)
class Linear:
    """Σ factor · place of a point in the axes of its link, by link and point; ``("", address)``: a dimension;
    ``("", "")``: a constant."""

    terms: dict[tuple[str, str], complex]

    @staticmethod
    def of(value: Linear | complex) -> Linear:
        return value if isinstance(value, Linear) else Linear({("", ""): complex(value)})

    def __add__(self, other: Linear | complex) -> Linear:
        found = dict(self.terms)
        for key, factor in Linear.of(other).terms.items():
            found[key] = found.get(key, 0j) + factor
        return Linear(found)

    __radd__ = __add__

    def __mul__(self, factor: complex) -> Linear:
        return Linear({key: factor * each for key, each in self.terms.items()})

    __rmul__ = __mul__

    def __sub__(self, other: Linear | complex) -> Linear:
        return self + Linear.of(other) * -1.0


class _Symbolic(LoopBuilder):
    """Writes down which points' places and which offsets an arm is made of."""

    def local(self, link: str, point: str) -> complex:
        return Linear({(link, point): 1.0 + 0j})  # type: ignore[return-value]

    def slide(self, place: Terms, key: Key, rotation: int, direction: complex, offset: float) -> None:
        kind, name = key
        joint = self.mechanism.drivers[name].joint if kind == "drive" else name
        super().slide(place, key, rotation, direction, Linear({("", f"{joint}.offset"): 1.0 + 0j}))  # type: ignore[arg-type]


@dataclass(frozen=True)
class _Loops:
    """Closed loops with their arms as a page has them: rotation, loop, link and key of a point ("" and an address: a
    dimension; "" twice: a constant), factor (real, imaginary)."""

    own: ClosedLoops
    arms: list[list[Any]]

    @staticmethod
    def of(mechanism: Mechanism, motion: Motion) -> _Loops:
        own = ClosedLoops(mechanism, motion.structure)
        return _Loops(own, _arms(mechanism, motion, own))

    @property
    def form(self) -> tuple[Any, ...]:
        """What the loops are made of."""
        return self.own.unknowns, self.own.b.shape, [arm[:4] for arm in self.arms]

    @property
    def factors(self) -> np.ndarray:
        """Those of the arms, then those of the slides in all loops, complex."""
        return np.array([complex(*arm[4:]) for arm in self.arms] + self.own.b.ravel().tolist())


def loops(motion: Motion, dimensions: Iterable[str]) -> Plain | None:
    """The loops of a motion's groups without closed form, and where they are at its first position; None where there
    are none, where a cam's lift moves them, or where it is not certified there."""
    followed = motion.followed
    if followed is None or not followed.certified[0] or followed.follower.loops.lifts:
        return None
    mechanism = motion.mechanism
    own = followed.follower.loops
    found = _Loops(own, _arms(mechanism, motion, own))
    turns = {each: _turns(mechanism, motion, found, each) for each in dimensions}
    columns = [*own.unknowns, *(("drive", name) for name in own.drivers)]
    return {
        "unknowns": [[kind, name] for kind, name in own.unknowns],
        "turning": own.turning.tolist(), "sliding": own.sliding.tolist(), "owner": own.owner.tolist(),
        "arms": found.arms, "slides": [[[z.real, z.imag] for z in row] for row in own.b.tolist()],
        "size": own.size, "fixed": [each for each, how in turns.items() if how is None],
        "turns": {each: how for each, how in turns.items() if how is not None and any(how)},
        "begin": followed.coordinates[0].tolist(), "drivers": [name for kind, name in columns if kind == "drive"],
    }  # fmt: skip


def _arms(mechanism: Mechanism, motion: Motion, own: ClosedLoops) -> list[list[Any]]:
    build = _Symbolic(mechanism)
    for group in upstream(motion.structure, mechanism):
        build.add(group)
    build.independent()
    found: list[list[Any]] = []
    for k, (_, terms) in enumerate(build.loops):
        for (c, j), value in terms.items():
            if j >= 0:
                continue
            for (link, point), factor in Linear.of(value).terms.items():
                turned = factor * _phase(own, build, c)
                key = canonical(mechanism, link, point) if link else point
                if abs(turned) > 0.0:
                    found.append([c, k, link, key, turned.real, turned.imag])
        for (c, j), value in terms.items():
            if j >= 0:
                shift = own.share(build.slides[j][0])[1] * complex(value) * _phase(own, build, c)
                if abs(shift) > 0.0:
                    found.append([c, k, "", "", shift.real, shift.imag])
    return found


def _phase(own: ClosedLoops, build: LoopBuilder, rotation: int) -> complex:
    """What a rotation that other rotations give is turned beyond them."""
    unknown, _ = build.rotations[rotation]
    return complex(np.exp(1j * own.share(("turn", unknown))[1])) if unknown else 1.0 + 0j


def _turns(mechanism: Mechanism, motion: Motion, found: _Loops, address: str) -> list[float] | None:
    """By how much of a dimension's change every arm, then every slide in every loop is turned; None where it changes
    more than that and places of points in the axes of their links."""
    change = abs(mechanism.dimension(address)) * TRIED[0] + TRIED[1]
    try:
        other = _Loops.of(mechanism.with_dimensions({address: mechanism.dimension(address) + change}), motion)
    except LinkwrightError:
        return None
    if found.form != other.form:
        return None
    a, b, before, after = found.own, other.own, found.factors, other.factors
    turns = np.round(np.angle(after * before.conj()) / change) + 0.0
    rows = [(a.turning, b.turning), (a.sliding, b.sliding), (before * np.exp(1j * turns * change), after)]
    same = all(np.abs(x - y).max(initial=0.0) <= SAME for x, y in rows)
    return [float(each) for each in turns] if same else None
