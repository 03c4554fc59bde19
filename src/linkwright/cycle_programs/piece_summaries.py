"""Means, extremes and excess of integrals of many designs' signals at Gauss points: by arrays, or compiled."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache, cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats, Whole
from linkwright.core.dataclass import dataclass
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
from linkwright.cycle.summary import Summary
from linkwright.cycle_programs import piece_kernels
from linkwright.engine.call_block import address_of
from linkwright.engine.kernel_writer import LANES
from linkwright.engine.llvm_backend import CompiledProgram
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.stage import Run, code_for

#: Sides of a signal on which its summaries lie, and the two extremes of the integral of its lack of the mean.
SIDES: Mapping[str, tuple[str, ...]] = {
    "max": ("max",),
    "min": ("min",),
    "range": ("max", "min"),
    "peak": ("max", "min"),
    "excess": ("gained", "lost"),
}
#: Kinds of summaries of a root that its square gives as exactly.
_OF_SQUARES = ("max", "peak", "rms")
#: From values times widths at the Gauss points to the integral from the piece's beginning up to each of them.
UP_TO = weights_up_to(NODES) / WEIGHTS
_SIGNS = {"max": 1.0, "min": -1.0, "gained": 1.0, "lost": -1.0}
#: Designs whose signals are kept at the same time by arrays.
BLOCK = 256
#: Designs whose contenders for extremes are kept at the same time.
CHUNK = 256
#: Compiled, every second look is enough: all pieces that may hold an extreme are looked at.
_LOOKS = 2
#: Contenders for extremes that find room, for each extreme.
_ROOM = 3


@dataclass(frozen=True)
class Reduced:
    """What is found of signals, (designs,) each.

    ``bounds``: the largest and the smallest value at the Gauss points, and the size of the last orders in the piece
    that is met worst; ``powers``: means of signal and square, which Gauss points give for twice the orders that they
    meet; ``peaks`` by output and side: the piece, the place in it, the value (negative for smallest ones), and the
    size of the last orders.
    """

    bounds: Mapping[str, tuple[Floats, Floats, Floats]]
    powers: Mapping[str, tuple[Floats, Floats]]
    peaks: Mapping[tuple[str, str], Peak]


class PieceSummaries:
    """What a program's outputs at Gauss points are reduced to; ``share``: the output that is the width of a point;
    ``alone``: outputs of which only the bounds are asked."""

    def __init__(
        self, program: Program, summaries: Iterable[Summary], pieces: int, share: str, alone: Sequence[str]
    ) -> None:
        self.pieces, self.share = pieces, share
        asked = list(summaries)
        plain = {each.output for each in asked if each.kind not in _OF_SQUARES}.union(alone, [share])
        self.program, self.squared = _squared(program, plain)
        first = {place: name for name, place in reversed(self.program.outputs)}
        #: Outputs with the first ones that are the same signals, which alone are reduced.
        self.same = {name: first[place] for name, place in self.program.outputs}
        wanted = [replace(each, output=self.same[each.output]) for each in asked]
        self.excess = tuple(dict.fromkeys(each.output for each in wanted if each.kind == "excess"))
        means = [each.output for each in wanted if each.kind in ("mean", "rms")]
        self.powers = tuple(dict.fromkeys([*means, *self.excess]))
        self.sides = tuple(
            dict.fromkeys((each.output, side) for each in wanted for side in SIDES.get(each.kind, ()))
        )
        self.signals = tuple(dict.fromkeys(self.same[name] for name in [*(e.output for e in asked), *alone]))

    def reduced(self, table: Floats, fields: Mapping[str, Floats], run: Run) -> Reduced:
        """Of the designs with these parameters, and fields (designs, n)."""
        enough = self.pieces >= LANES  # the kernels take whole vectors of pieces
        code = code_for(self.program, None, run, len(table)) if enough else None
        given = {name: fields[name] for name in self.program.fields}
        found = (
            self._by_arrays(table, given, run) if code is None else self._compiled(code, table, given, run)
        )
        return self._rooted(self._of_all(found))

    def _of_all(self, found: Reduced) -> Reduced:
        """The same for outputs that are the same signals."""
        return Reduced(
            {name: found.bounds[one] for name, one in self.same.items() if one in found.bounds},
            {name: found.powers[one] for name, one in self.same.items() if one in found.powers},
            {
                (name, side): found.peaks[one, side]
                for name, one in self.same.items()
                for side in _SIGNS
                if (one, side) in found.peaks
            },
        )

    def _rooted(self, found: Reduced) -> Reduced:
        """The same of roots where their squares were reduced; roughness stays a share of the size."""
        bounds, powers, peaks = dict(found.bounds), dict(found.powers), dict(found.peaks)
        with np.errstate(invalid="ignore", divide="ignore"):
            for name in self.squared:
                top, bottom, rough = found.bounds[name]
                size = np.sqrt(np.where(top > 0.0, top, 1.0))
                bounds[name] = np.sqrt(top), np.sqrt(bottom), rough / size
                if name in powers:
                    powers[name] = np.full(len(top), np.nan), found.powers[name][0]
                for side in ("max", "min"):
                    if (name, side) in peaks:
                        piece, place, value, last = found.peaks[name, side]
                        root = np.sign(value) * np.sqrt(np.abs(value))
                        peaks[name, side] = piece, place, root, last / size
        return Reduced(bounds, powers, peaks)

    # by arrays --------------------------------------------------------------------------------------
    def _by_arrays(self, table: Floats, fields: Mapping[str, Floats], run: Run) -> Reduced:
        parts = [slice(k, k + BLOCK) for k in range(0, max(1, len(table)), BLOCK)]
        blocks = [self._block(table[each], _of(fields, each), run) for each in parts]
        return Reduced(
            _joined([each.bounds for each in blocks]),
            _joined([each.powers for each in blocks]),
            _joined([each.peaks for each in blocks]),
        )

    def _block(self, table: Floats, fields: Mapping[str, Floats], run: Run) -> Reduced:
        found = numpy_program(self.program).run_designs(
            table, run.positions, fields, length=run.length, tables=run.tables
        )
        names = self.program.output_names
        rows = {name: found[:, k].reshape(-1, POINTS, self.pieces) for k, name in enumerate(names)}
        bounds = {
            name: (rows[name].max(axis=(1, 2)), rows[name].min(axis=(1, 2)), _roughest(rows[name]))
            for name in self.signals
        }
        powers = {name: _powers(rows[name], rows[self.share]) for name in self.powers}
        peaks = {}
        for name, side in self.sides:
            signal = rows[name]
            if side in SIDES["excess"]:
                signal = integral(signal, rows[self.share], powers[name][0])
            signal = _SIGNS[side] * signal
            peaks[name, side] = _peak(signal)
        return Reduced(bounds, powers, peaks)

    # compiled ---------------------------------------------------------------------------------------
    @cached_property
    def _jobs(self) -> tuple[Whole, tuple[str, ...], tuple[tuple[str, str], ...]]:
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

    def _compiled(
        self, code: CompiledProgram, table: Floats, fields: Mapping[str, Floats], run: Run
    ) -> Reduced:
        jobs, names, owners = self._jobs
        room = _Room(self, len(jobs), len(owners), len(table))
        room.fill(code, table, fields, run, jobs)
        found = {name: room.numbers[k, :, : len(table)] for k, name in enumerate(names) if name}
        piece, place, value, rough = room.best[..., : len(table)]
        return Reduced(
            {name: tuple(found[name][:3]) for name in self.signals},
            {name: tuple(found[name][3:]) for name in self.powers},
            {
                owner: (piece[k].astype(np.intp), place[k], value[k], rough[k])
                for k, owner in enumerate(owners)
            },
        )


class _Room:
    """Arrays that the kernels write; what is found of one design lies ``apart`` from the next number of it, so that
    these do not meet in the cache."""

    def __init__(self, of: PieceSummaries, jobs: int, extremes: int, designs: int) -> None:
        self.of, self.extremes, self.apart = of, extremes, designs + 8
        self.capacity = -(-extremes * max(of.pieces, _ROOM * min(CHUNK, designs)) // 8) * 8 + 8
        self.signals = np.empty((len(of.program.outputs), POINTS * of.pieces))
        self.numbers = np.empty((jobs, piece_kernels.FOUND, self.apart))
        self.best = np.empty((4, extremes, self.apart))
        self.best[2], self.best[3] = -np.inf, 0.0

    def fill(
        self, code: CompiledProgram, table: Floats, fields: Mapping[str, Floats], run: Run, jobs: Whole
    ) -> None:
        """Signals of one design after another, and what is asked of them."""
        kernels, tables, pieces, capacity = piece_kernels.kernels(), _tables(), self.of.pieces, self.capacity
        work, ids = np.empty((2 * POINTS + 3) * pieces), np.empty(2 * capacity + 1, dtype=np.int64)
        rows, looked, vectors = (
            np.empty((POINTS + 1, capacity)),
            np.empty((3, capacity)),
            np.empty((4 * POINTS, 8)),
        )
        share = self.signals[self.of.program.output_names.index(self.of.share)]
        entry, block, carried = code.one_by_one(
            table, run.positions, self.signals, fields=fields, tables=run.tables
        )
        design = table.strides[0], address_of(carried), len(carried)
        program = (entry, address_of(block), *design, address_of(self.signals), address_of(share))
        given = (pieces, address_of(jobs), len(jobs), self.extremes, address_of(tables), address_of(work))
        at_rows, at_ids, at_looked = address_of(rows), address_of(ids), address_of(looked)
        polynomials = (at_rows, capacity, address_of(tables), address_of(vectors), at_looked)
        numbers, best, total = address_of(self.numbers), address_of(self.best), self.extremes * self.apart
        done = 0
        while done < len(table):
            count = kernels(
                "reduced", min(CHUNK, len(table) - done), *program, *given, numbers + 8 * done, self.apart, at_rows,
                capacity, at_ids,
            )  # fmt: skip
            if count:
                kernels("peaks", count, *polynomials)
                kernels("gathered", count, at_ids, at_rows, at_looked, capacity, total, best + 8 * done)
            done += int(ids[2 * capacity])


@cache
def _tables() -> Floats:
    """The numbers that the kernels take."""
    orders = np.arange(POINTS)
    half, left = POINTS // 2, TO_PLACES[:, : LOOKS // 2 + 1 : _LOOKS]
    opposite = left[::-1][:half]
    looked = np.stack([0.5 * (left[:half] + opposite), 0.5 * (left[:half] - opposite)]).reshape(POINTS, -1).T
    forward, backward = (2 * orders + 1) / (orders + 1), -(orders + 1) / (orders + 2)
    parts = (
        TO_LAST,
        UP_TO,
        TO_LEGENDRE[:half].T,
        looked,
        PLACES[: LOOKS // 2 + 1 : _LOOKS],
        forward,
        backward,
    )
    assert LOOKS == 2 * _LOOKS * piece_kernels.HALF_LOOKS + 1 and POINTS == piece_kernels.POINTS
    return np.concatenate([np.ascontiguousarray(part, dtype=float).ravel() for part in parts])


def _squared(program: Program, plain: Collection[str]) -> tuple[Program, tuple[str, ...]]:
    """The program with the squares of outputs that are roots or sizes, but for ``plain`` ones; which these are.

    Squares cost nothing, and are smooth where roots of sums come near zero, and where what has a size changes its
    sign.
    """
    entries, outputs, squared = list(program.entries), [], []
    for name, i in program.outputs:
        op, args, *_, varies = program.entries[i]
        if name not in plain and op in ("sqrt", "abs"):
            squared.append(name)
            if op == "abs":
                entries.append(("mul", (args[0], args[0]), 0.0, "", varies))
            i = args[0] if op == "sqrt" else len(entries) - 1
        outputs.append((name, i))
    found = Program(tuple(entries), tuple(outputs))
    return found.only(list(program.output_names)), tuple(squared)


def _of(fields: Mapping[str, Floats], designs: slice) -> dict[str, Floats]:
    """The fields of some designs."""
    return {name: rows[designs] for name, rows in fields.items()}


def _joined(parts: Sequence[Mapping[Any, Any]]) -> dict[Any, Any]:
    """The same of all designs from those of some after others."""
    return {
        key: tuple(map(np.concatenate, zip(*(part[key] for part in parts), strict=True))) for key in parts[0]
    }


def _powers(signal: Floats, share: Floats) -> tuple[Floats, Floats]:
    weighted = share * signal
    return weighted.sum(axis=(1, 2)), np.einsum("dip,dip->d", weighted, signal)


def _peak(signal: Floats) -> Peak:
    """The largest values; their roughness is that of all pieces that may hold them."""
    tops, last = signal.max(axis=1), np.abs(TO_LAST.T @ signal).max(axis=1)
    piece, place, value, rough = largest(signal, tops)
    near = tops + piece_kernels.REACH * last >= value[:, None]
    return piece, place, value, np.maximum(rough, np.where(near, last, 0.0).max(axis=1))


def integral(signal: Floats, share: Floats, mean: Floats) -> Floats:
    """The integral over the cycle of what a signal (designs, POINTS, pieces) lacks of its mean, up to every Gauss
    point; the cycle's length is 1."""
    gained = (mean[:, None, None] - signal) * share
    whole = gained.sum(axis=1)
    return np.asarray((np.cumsum(whole, axis=1) - whole)[:, None, :] + UP_TO @ gained)


def _roughest(signal: Floats) -> Floats:
    """Size of the last orders, (designs,), in the piece that is met worst."""
    return np.asarray(np.abs(TO_LAST.T @ signal).max(axis=(1, 2)))
