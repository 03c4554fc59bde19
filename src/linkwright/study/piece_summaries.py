"""Means, extremes and excess of integrals of many designs' signals at Gauss points: by arrays, or compiled."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.piecewise import (
    LOOKS,
    NODES,
    PLACES,
    POINTS,
    TO_LAST,
    TO_LEGENDRE,
    TO_PLACES,
    WEIGHTS,
    Peak,
    largest,
    weights_up_to,
)
from linkwright.engine.call_block import address_of
from linkwright.engine.llvm_backend import CompiledProgram
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.stage import Run, code_for
from linkwright.metrics.summary import Summary
from linkwright.study import piece_kernels

Floats = NDArray[np.float64]
Wholes = NDArray[np.int64]

#: Sides of a signal on which its summaries lie, and the two extremes of the integral of its lack of the mean.
SIDES: Mapping[str, tuple[str, ...]] = {
    "max": ("max",),
    "min": ("min",),
    "range": ("max", "min"),
    "peak": ("max", "min"),
    "excess": ("gained", "lost"),
}
#: From values times widths at the Gauss points to the integral from the piece's beginning up to each of them.
UP_TO = weights_up_to(NODES) / WEIGHTS
_SIGNS = {"max": 1.0, "min": -1.0, "gained": 1.0, "lost": -1.0}
#: Designs whose signals are kept at the same time by arrays.
BLOCK = 256
#: Contenders for extremes that find room, for each extreme.
_ROOM = 3


@dataclass(frozen=True)
class Reduced:
    """What is found of signals, (designs,) each.

    ``bounds``: the largest and the smallest value at the Gauss points; ``powers``: means of signal and square, and
    the size of the last orders of both; ``peaks`` by output and side: the piece, the place in it, the value (negative
    for smallest ones), and the size of the last orders.
    """

    bounds: Mapping[str, tuple[Floats, Floats]]
    powers: Mapping[str, tuple[Floats, Floats, Floats, Floats]]
    peaks: Mapping[tuple[str, str], Peak]


class PieceSummaries:
    """What a program's outputs at Gauss points are reduced to; ``share``: the output that is the width of a point;
    ``alone``: outputs of which only the bounds are asked."""

    def __init__(
        self, program: Program, summaries: Iterable[Summary], pieces: int, share: str, alone: Sequence[str]
    ) -> None:
        self.program, self.pieces, self.share = program, pieces, share
        asked = list(summaries)
        self.excess = tuple(dict.fromkeys(each.output for each in asked if each.kind == "excess"))
        means = [each.output for each in asked if each.kind in ("mean", "rms")]
        self.powers = tuple(dict.fromkeys([*means, *self.excess]))
        self.sides = tuple(
            dict.fromkeys((each.output, side) for each in asked for side in SIDES.get(each.kind, ()))
        )
        self.signals = tuple(dict.fromkeys([*(each.output for each in asked), *alone]))

    def reduced(self, table: Floats, run: Run) -> Reduced:
        """Of the designs with these parameters."""
        code = code_for(self.program, None, run, len(table))
        return self._by_arrays(table, run) if code is None else self._compiled(code, table, run)

    # by arrays --------------------------------------------------------------------------------------
    def _by_arrays(self, table: Floats, run: Run) -> Reduced:
        blocks = [self._block(table[k : k + BLOCK], run) for k in range(0, max(1, len(table)), BLOCK)]
        return Reduced(
            _joined([each.bounds for each in blocks]),
            _joined([each.powers for each in blocks]),
            _joined([each.peaks for each in blocks]),
        )

    def _block(self, table: Floats, run: Run) -> Reduced:
        found = numpy_program(self.program).run_designs(
            table, run.positions, {}, length=run.length, tables=run.tables
        )
        names = self.program.output_names
        rows = {name: found[:, k].reshape(-1, POINTS, self.pieces) for k, name in enumerate(names)}
        bounds = {name: (rows[name].max(axis=(1, 2)), rows[name].min(axis=(1, 2))) for name in self.signals}
        powers = {name: _powers(rows[name], rows[self.share]) for name in self.powers}
        peaks = {}
        for name, side in self.sides:
            signal = rows[name]
            if side in SIDES["excess"]:
                signal = _integral(signal, rows[self.share], powers[name][0])
            signal = _SIGNS[side] * signal
            peaks[name, side] = largest(signal, signal.max(axis=1))
        return Reduced(bounds, powers, peaks)

    # compiled ---------------------------------------------------------------------------------------
    @cached_property
    def _jobs(self) -> tuple[Wholes, tuple[str, ...], tuple[tuple[str, str], ...]]:
        """The jobs of the kernels, the signals that they begin with, and the extremes in their order."""
        jobs: list[list[int]] = []
        owners: list[tuple[str, str]] = []
        for name in (*(n for n in self.signals if n not in self.excess), *self.excess):
            place = self.program.output_names.index(name)
            passes: list[tuple[int, tuple[str, str]]] = [(place, ("max", "min"))]
            passes += [(-1, ("gained", "lost"))] if name in self.excess else []
            for signal, sides in passes:
                mine = [(name, side) for side in sides if (name, side) in self.sides]
                wanted = [int((name, side) in mine) for side in sides]
                first = signal >= 0
                jobs.append(
                    [
                        signal,
                        first and name in self.powers,
                        first and name in self.excess,
                        *wanted,
                        len(owners),
                    ]
                )
                owners += mine
        names = [self.program.output_names[job[0]] if job[0] >= 0 else "" for job in jobs]
        return np.array(jobs, dtype=np.int64), tuple(names), tuple(owners)

    def _compiled(self, code: CompiledProgram, table: Floats, run: Run) -> Reduced:
        jobs, names, owners = self._jobs
        numbers = np.zeros((len(table), len(jobs), piece_kernels.FOUND))
        peaks = np.empty((4, len(table), max(1, len(owners))))
        done = 0
        while done < len(table):
            done += self._chunk(code, table[done:], run, numbers[done:], peaks[:, done:])
        found = {name: numbers[:, k] for k, name in enumerate(names) if name}
        return Reduced(
            {name: (found[name][:, 0], found[name][:, 1]) for name in self.signals},
            {name: tuple(found[name][:, 2:].T) for name in self.powers},
            {
                owner: (peaks[0, :, k].astype(np.intp), peaks[1, :, k], peaks[2, :, k], peaks[3, :, k])
                for k, owner in enumerate(owners)
            },
        )

    def _chunk(self, code: CompiledProgram, table: Floats, run: Run, numbers: Floats, peaks: Floats) -> int:
        """Some designs from the first on, as many as find room; how many."""
        jobs, _, owners = self._jobs
        kernels, tables = piece_kernels.kernels(), _tables()
        extremes, size = len(owners), POINTS * self.pieces
        capacity = -(-extremes * max(self.pieces, _ROOM * len(table)) // 8) * 8 + 8
        signals = np.empty((len(self.program.outputs), size))
        room = np.empty(size * 2 + 3 * self.pieces)
        rows, ids = np.empty((POINTS, capacity)), np.empty(2 * capacity + 1, dtype=np.int64)
        address, block = code.one_by_one(table, run.positions, signals, tables=run.tables)
        share = signals[self.program.output_names.index(self.share)]
        count = kernels(
            "reduced", len(table), address, address_of(block), table.strides[0], address_of(signals),
            address_of(share), self.pieces, address_of(jobs), len(jobs), extremes, address_of(tables),
            address_of(room), address_of(numbers), address_of(rows), capacity, address_of(ids),
        )  # fmt: skip
        done = int(ids[2 * capacity])
        if count:
            looked, polynomial = np.empty((3, capacity)), np.empty((3, POINTS, 8))
            kernels(
                "peaks", count, address_of(rows), capacity, address_of(tables), address_of(polynomial),
                address_of(looked),
            )  # fmt: skip
            owner, piece = ids[: 2 * count].reshape(count, 2).T
            best = np.full(done * extremes, -np.inf)
            with np.errstate(invalid="ignore"):
                np.maximum.at(best, owner, looked[1, :count])
            chosen = np.empty(done * extremes, dtype=np.intp)
            mine = np.flatnonzero(~(looked[1, :count] < best[owner]))
            chosen[owner[mine]] = mine
            peaks[0, :done] = piece[chosen].reshape(done, extremes)
            peaks[1:, :done] = looked[:, chosen].reshape(3, done, extremes)
        return done


@cache
def _tables() -> Floats:
    """The numbers that the kernels take."""
    orders = np.arange(POINTS)
    forward, backward = (2 * orders + 1) / (orders + 1), -(orders + 1) / (orders + 2)
    parts = (TO_LAST, UP_TO, TO_LEGENDRE.T, TO_PLACES.T, PLACES, forward, backward)
    assert LOOKS == piece_kernels.LOOKS and POINTS == piece_kernels.POINTS
    return np.concatenate([np.ascontiguousarray(part, dtype=float).ravel() for part in parts])


def _joined(parts: Sequence[Mapping[Any, Any]]) -> dict[Any, Any]:
    """The same of all designs from those of some after others."""
    return {
        key: tuple(map(np.concatenate, zip(*(part[key] for part in parts), strict=True))) for key in parts[0]
    }


def _powers(signal: Floats, share: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    square = signal * signal
    mean, both = (np.einsum("dip,dip->d", share, each) for each in (signal, square))
    return mean, both, _roughest(signal), _roughest(square)


def _integral(signal: Floats, share: Floats, mean: Floats) -> Floats:
    """The integral of what a signal lacks of its mean, up to every Gauss point."""
    gained = (mean[:, None, None] - signal) * share
    whole = gained.sum(axis=1)
    return np.asarray((np.cumsum(whole, axis=1) - whole)[:, None, :] + UP_TO @ gained)


def _roughest(signal: Floats) -> Floats:
    """Size of the last orders, (designs,), in the piece that is met worst."""
    return np.asarray(np.abs(TO_LAST.T @ signal).max(axis=(1, 2)))
