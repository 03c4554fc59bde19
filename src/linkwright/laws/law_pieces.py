"""The law of a driver as polynomials of the time, for programs in which the time is traced."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.polynomial import chebyshev

from linkwright.core.arrays import Floats
from linkwright.curves.polynomials import NODES, PLACES, POINTS, SERIES
from linkwright.formula.recently_made import Recent
from linkwright.laws.traced import horner, row_at

if TYPE_CHECKING:
    from linkwright.formula.trace import Scalar

#: From coefficients of Chebyshev polynomials to those of powers of u, -1 to 1; from values at the nodes of a piece to
#: integrals from its middle, at the nodes.
_TO_POWERS = np.stack(
    [np.pad(chebyshev.cheb2poly([0.0] * k + [1.0]), (0, POINTS - 1 - k)) for k in range(POINTS)], axis=1
)
_ONCE, _TWICE = (chebyshev.chebvander(PLACES, POINTS - 1 + k) @ chebyshev.chebint(SERIES, k) for k in (1, 2))
#: How near polynomials come to the law and its rates, as shares of the largest; what is rounding in a coefficient;
#: the most halvings of a piece.
_FINE, _NOTHING, _HALVINGS = 2e-14, 2e-15, 10


class Law(Protocol):
    """A coordinate over time, as the laws of drivers are."""

    def coordinate(self, t: Floats) -> tuple[Floats, Floats, Floats]: ...
    def breaks(self, start: float, end: float) -> Floats: ...


@dataclass(frozen=True)
class LawPieces:
    """Pieces between ``edges`` (m + 1,), s, with ``rows`` (m, 4 + 16): scale and shift to u from -1 to 1, coordinate
    and rate in the middle, and the coefficients of the second derivative, Σ c[k] u^k."""

    edges: Floats
    rows: Floats

    @classmethod
    def of(cls, law: Law, start: float, end: float, fine: float = _FINE) -> LawPieces:
        """Those of a law, halved until they meet it between its breaks, to a share ``fine`` of the largest values."""
        inner = law.breaks(start, end)
        edges = np.concatenate([[start], inner[(inner > start) & (inner < end)], [end]])
        sizes = [max(float(np.abs(row).max()), 1e-300) for row in law.coordinate(np.linspace(start, end, 721))]
        waiting = [(a, b, 0) for a, b in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)]
        found: list[tuple[float, list[float]]] = []
        while waiting:
            a, b, halved = waiting.pop()
            row, off = _row(law, a, b, sizes)
            if off <= fine or halved == _HALVINGS:
                found.append((a, row))
            else:
                middle = 0.5 * (a + b)
                waiting += [(a, middle, halved + 1), (middle, b, halved + 1)]
        found.sort()
        return cls(np.array([*(a for a, _ in found), end]), np.array([row for _, row in found]))

    def traced(self, t: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        """Coordinate and rates at a traced time; beyond the ends those of the outermost pieces."""
        scale, shift, middle, rate, *second = row_at(t, self.edges, self.rows)
        u, half = t * scale + shift, 1.0 / scale
        once = horner([c * (1.0 / (k + 1)) for k, c in enumerate(second)], u) * u * half
        twice = horner([c * (1.0 / ((k + 1) * (k + 2))) for k, c in enumerate(second)], u) * (u * u) * half * half
        return middle + rate * (u * half) + twice, rate + once, horner(second, u)


def law_pieces(law: Law, start: float, end: float, fine: float = _FINE) -> LawPieces:
    """Those of a law from ``start`` to ``end``, s; what was found serves again."""
    return _cache.get(law, (start, end), lambda: LawPieces.of(law, start, end, fine))


_cache: Recent[Law, LawPieces] = Recent(16)


def _row(law: Law, a: float, b: float, sizes: list[float]) -> tuple[list[float], float]:
    """The row of one piece, and how far it is from the law, as share of the ``sizes``."""
    half = 0.5 * (b - a)
    q, rate, second = law.coordinate(a + (b - a) * NODES)
    orders = SERIES @ second
    orders[np.abs(orders) <= _NOTHING * sizes[2]] = 0.0
    once, twice = half * (_ONCE @ second), half * half * (_TWICE @ second)
    middle_rate = float(np.mean(rate - once))
    middle = float(np.mean(q - twice - middle_rate * half * PLACES))
    misses = (
        np.abs(rate - once - middle_rate).max() / sizes[1],
        np.abs(q - twice - middle_rate * half * PLACES - middle).max() / sizes[0],
    )
    powers, last = _TO_POWERS @ orders, np.abs(orders[-3:]).max() / sizes[2]
    return [1.0 / half, -(a + b) / (b - a), middle, middle_rate, *powers.tolist()], float(max(last, *misses))
