"""The closed loops of groups without closed form as plain data, for the certificate that a page makes of them.

Arms are sums of places of points in the axes of their links, which a page reads from its own rows; turns and slides
hold for all dimensions but the ``fixed`` ones.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.errors import LinkwrightError
from linkwright.kinematics.closed_loops import ClosedLoops, LoopBuilder, upstream
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.mechanism.mechanism import Mechanism

Plain = dict[str, Any]
#: Relative and absolute change (m, rad) by which dimensions are tried.
TRIED = 1e-3, 1e-4
SAME = 1e-12


@dataclass(frozen=True)
class Linear:
    """Σ factor · place of a point in the axes of its link, by link and point; ``("", "")``: a constant."""

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
    """Writes down which points' places an arm is made of."""

    def local(self, link: str, point: str) -> complex:
        return Linear({(link, point): 1.0 + 0j})  # type: ignore[return-value]


def loops(motion: Motion, dimensions: Iterable[str]) -> Plain | None:
    """The loops of a motion's groups without closed form, and where they are at its first position; None where there
    are none, or where it is not certified there."""
    followed = motion.followed
    if followed is None or not followed.certified[0]:
        return None
    mechanism, own = motion.mechanism, followed.follower.loops
    arms = _arms(mechanism, motion, own)
    changeable = [each for each in dimensions if _bends(mechanism, motion, own, each)]
    columns = [*own.unknowns, *(("drive", name) for name in own.drivers)]
    return {
        "unknowns": [[kind, name] for kind, name in own.unknowns],
        "turning": own.turning.tolist(), "sliding": own.sliding.tolist(), "owner": own.owner.tolist(),
        "arms": arms, "slides": [[[z.real, z.imag] for z in row] for row in own.b.tolist()],
        "size": own.size, "fixed": changeable, "begin": followed.coordinates[0].tolist(),
        "drivers": [name for kind, name in columns if kind == "drive"],
    }  # fmt: skip


def _arms(mechanism: Mechanism, motion: Motion, own: ClosedLoops) -> list[list[Any]]:
    """Rotation, loop, link and key of a point ("": a constant), factor (real, imaginary) of every part of an arm."""
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
                key = canonical(mechanism, link, point) if link else ""
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


def _bends(mechanism: Mechanism, motion: Motion, own: ClosedLoops, address: str) -> bool:
    """Whether a dimension changes more than places of points in the axes of their links."""
    value = mechanism.dimension(address)
    try:
        changed = mechanism.with_dimensions({address: value * (1.0 + TRIED[0]) + TRIED[1]})
        other = ClosedLoops(changed, motion.structure)
        if other.unknowns != own.unknowns or other.b.shape != own.b.shape:
            return True
        rows = [(own.turning, other.turning), (own.sliding, other.sliding), (own.b, other.b)]
        same = all(np.abs(a - b).max(initial=0.0) <= SAME for a, b in rows)
        return not same or not _alike(_arms(mechanism, motion, own), _arms(changed, motion, other))
    except LinkwrightError:
        return True


def _alike(a: list[list[Any]], b: list[list[Any]]) -> bool:
    return len(a) == len(b) and all(
        x[:4] == y[:4] and abs(x[4] - y[4]) + abs(x[5] - y[5]) <= SAME for x, y in zip(a, b, strict=True)
    )
