"""Where links are in the axes of others over a cycle, as polynomials of its pieces."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from linkwright.collisions.cycle_pieces import CyclePieces
from linkwright.core.arrays import Complexes, Flags, Floats, Indices
from linkwright.curves.polynomials import POINTS, SERIES, SLOPE
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements

#: Poses nearer to each other than this share of the size are one, so that nothing jumps between two pieces.
SAME = 1e-6
#: Signals of a pair of links: place, turn, place the other way (two components each), and the place's square.
_OF_PAIR = 7
_CURVATURE: Floats = (SLOPE @ SLOPE)[: POINTS - 2] @ SERIES


class RelativePaths:
    """Poses of the second link of some ``pairs`` in the axes of the first (pose 2k) and the other way (2k + 1).

    A pose is a place z, m, and a turn u = exp(iφ): the point w of one link is at z + u·w in the axes of the other.
    ``place``, ``turn``: Chebyshev coefficients (poses, pieces, orders) over places -1 to 1 of a piece;
    ``place_curvature``, ``turn_curvature``, ``square_curvature`` (of |z|²): those of second derivatives by these.
    ``fresh``: pieces that do not go on from the one before.
    """

    def __init__(self, motion: Motion, pairs: Sequence[tuple[str, str]]) -> None:
        self.motion, self.pairs = motion, [*pairs]
        self.size = motion.mechanism.size
        self.carriers = [*dict.fromkeys(link for pair in pairs for link in pair)]
        self.pieces = CyclePieces(motion, self._signals, self._count)
        self.count, self.exact = self.pieces.count, self.pieces.exact
        self._build(self.pieces.values)

    @property
    def _count(self) -> int:
        return _OF_PAIR * len(self.pairs) + 4 * len(self.carriers)

    def _signals(self, motion: Motion) -> Floats:
        """Relative poses, and those of the links in the frame, (signals, n), in shares of the size."""
        placed = placements(motion)
        own = {
            name: (each.origin[:, 0] + 1j * each.origin[:, 1], each.direction[:, 0] + 1j * each.direction[:, 1])
            for name in self.carriers
            for each in (placed[name],)
        }
        rows: list[Floats] = []
        for first, second in self.pairs:
            (place_a, turn_a), (place_b, turn_b) = own[first], own[second]
            place, turn = turn_a.conj() * (place_b - place_a) / self.size, turn_a.conj() * turn_b
            back = -turn.conj() * place
            rows += [place.real, place.imag, turn.real, turn.imag, back.real, back.imag, np.abs(place) ** 2]
        for place, turn in own.values():
            rows += [place.real / self.size, place.imag / self.size, turn.real, turn.imag]
        return np.stack(rows)

    def _build(self, values: Floats) -> None:
        count = len(self.pairs)
        series, curvature = values @ SERIES.T, values[: _OF_PAIR * count] @ _CURVATURE.T
        self.place, self.turn = self._poses(series[: _OF_PAIR * count])
        self.place_curvature, self.turn_curvature = self._poses(curvature)
        self.square_curvature: Floats = self.size**2 * curvature[_OF_PAIR - 1 :: _OF_PAIR]
        own = series[_OF_PAIR * count :].reshape(len(self.carriers), 4, self.count, POINTS)
        self._own_place, self._own_turn = self.size * (own[:, 0] + 1j * own[:, 1]), own[:, 2] + 1j * own[:, 3]

    def _poses(self, rows: Floats) -> tuple[Complexes, Complexes]:
        """Places and turns (poses, pieces, orders) from the rows of pairs."""
        of_pairs = rows.reshape(len(self.pairs), _OF_PAIR, *rows.shape[1:])
        place, turn, back = (of_pairs[:, k] + 1j * of_pairs[:, k + 1] for k in (0, 2, 4))
        shape = 2 * len(self.pairs), *rows.shape[1:]
        places, turns = np.stack([place, back], axis=1), np.stack([turn, turn.conj()], axis=1)
        return np.asarray(self.size * places.reshape(shape)), turns.reshape(shape)

    @cached_property
    def ends(self) -> tuple[Complexes, Complexes]:
        """Places and turns (poses, pieces, 2) at both ends of the pieces."""
        signs = np.stack([(-1.0) ** np.arange(POINTS), np.ones(POINTS)], axis=1)
        return self.place @ signs, self.turn @ signs

    @cached_property
    def fresh(self) -> Flags:
        """Pieces (pieces,) that do not go on from the one before, as the first one."""
        place, turn = self.ends
        jump = np.abs(place[:, 1:, 0] - place[:, :-1, 1]) / self.size + np.abs(turn[:, 1:, 0] - turn[:, :-1, 1])
        return np.append(True, (jump > SAME).any(axis=0))[: self.count]

    def pose(self, pose: Indices, piece: Indices, x: Floats) -> tuple[Complexes, Complexes]:
        """Places and turns (n,) of some poses at places ``x`` of pieces."""
        basis = _basis(x)
        return (self.place[pose, piece] * basis).sum(axis=-1), (self.turn[pose, piece] * basis).sum(axis=-1)

    def in_frame(self, carriers: Sequence[str], piece: Indices, x: Floats) -> tuple[Complexes, Complexes]:
        """Places and turns (n,) of links in the frame."""
        number, basis = np.array([self.carriers.index(each) for each in carriers], dtype=np.intp), _basis(x)
        place, turn = self._own_place[number, piece], self._own_turn[number, piece]
        return (place * basis).sum(axis=-1), (turn * basis).sum(axis=-1)


def _basis(x: Floats) -> Floats:
    return np.cos(np.arange(POINTS) * np.arccos(np.clip(x, -1.0, 1.0))[..., None])
