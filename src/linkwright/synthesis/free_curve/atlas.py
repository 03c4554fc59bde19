"""The atlas: curves of many random linkages, made once and cached, and how a wanted curve is looked up in it.

A curve is M points even in arc length, centred, rms radius 1. The look-up is the normalised cross-correlation by fast
Fourier transform with the wanted curve at several window lengths, forwards and backwards, mirrored or not: every
start, direction and part of every curve is tried, and place, size and turn do not matter. Four-bars, which cannot
follow strokes in their order, are looked up by the mean nearest distance of their parts (``likeness.py``).
"""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Complexes, Floats, Indices, Integers
from linkwright.formula.machine_code import folder
from linkwright.formula.threads import cores, spread_over
from linkwright.synthesis.free_curve.atlas_kernels import ANGLES, LANDMARKS, POINTS, REACH, RINGS, TURNS
from linkwright.synthesis.free_curve.target import Target, even_points, normal
from linkwright.synthesis.free_curve.topology import Design, Draw, kernels, node_paths, random_structure, turned_paths

#: Points of a curve; lengths of the parts tried for open curves; steps of one byte in a coordinate.
M, WINDOWS, STEP = 64, (16, 23, 33, 46, 64), 1 / 36
#: Minimum sin² of a transmission angle in the atlas, positions of a draw, minimum radius of a curve in cranks.
LIMIT, POSITIONS, RADIUS = 0.08, 72, 0.15
BLOCK = 4096
#: So many curves nearest to a target come first; of the next so many are about as likely.
NEAREST, EVENLY = 200, 1000
#: Parts tried by distance, steps from one to the next; span of the crank where a complete curve is compared.
PARTS, FULL_SPAN = ((15, 4), (22, 4), (32, 6), (45, 8), (64, 64)), 6.27
#: Positions of a turn from which a part's crank angles are read, round to the first one; their angles, rad.
CRANK = 144
RING = np.arange(CRANK + 1) % CRANK
ANGLE = np.linspace(0, 2 * np.pi, CRANK + 1)
#: First point and number of a part's steps; with the image it lies on and the turn of the picture.
Part = tuple[int, int]
Laid = tuple[Part, bool, float]
#: Joints of each atlas, and whether its dyads slide (1); numbers of dyads in it, with the structures of each and the
#: draws of each structure.
LEVELS = (
    (5, 0, ((1, 1, 40000),)),
    (8, 0, ((2, 100, 960),)),
    (10, 0, ((3, 300, 400), (4, 200, 300))),
    (8, 0, ((3, 200, 400),)),
    (5, 1, ((1, 2, 15000),)),
)
EDITION = 5


@dataclass(frozen=True, eq=False)
class Atlas:
    """Curves (N, M, 2) as bytes with their linkages: structure and row of ``x`` of each."""

    structures: tuple[Integers, ...]
    x: tuple[Floats, ...]
    which: NDArray[np.int32]
    curves: NDArray[np.int8]

    def matches(self, target: Target) -> Matches:
        """How well each curve, or the best part of it, follows the target."""
        wanted = list(_windows(target))
        filters = [np.conj(np.fft.fft(np.pad(each, (0, M - len(each))))).astype(np.complex64) for _, each in wanted]
        best = np.zeros((3, len(self.curves)), np.float32)

        def match(first: int, last: int) -> None:
            best[:, first:last] = _match(self.curves[first:last], wanted, filters, target.closed)

        def laid(i: int) -> Laid:
            (mirror, window), lag = wanted[int(best[1, i])], int(best[2, i])
            part = _complex(self.curves[i, (lag + np.arange(len(window))) % M])
            return (lag, len(window)), mirror, float(np.angle(np.sum(np.conj(part) * window)))

        spread_over(len(self.curves), BLOCK, cores(), match)
        return Matches(self, -best[0], laid)

    def nearest(self, target: Target) -> Matches:
        """How near each curve, or the best part of it, comes to the target in any order of its strokes."""
        tried = parts(target.closed)
        points = np.array([places(*each) for each in tried], dtype=np.int64)
        tables, landmarks = _tables(target)
        found = np.zeros((len(self.curves), 2))

        def match(first: int, last: int) -> None:
            curves, room = _complex(self.curves[first:last]), np.zeros(1024)
            arrays = [each.ctypes.data for each in (tables, landmarks, room, found[first:last])]
            kernels()("likeness", curves.ctypes.data, last - first, M, points.ctypes.data, len(tried), *arrays)

        def laid(i: int) -> Laid:
            part, image, turn = np.unravel_index(int(found[i, 1]), (len(tried), 2, TURNS))
            return tried[part], bool(image), 2 * np.pi * float(turn) / TURNS

        spread_over(len(self.curves), BLOCK, cores(), match)
        return Matches(self, found[:, 0], laid)

    def design(self, i: int, laid: Laid) -> Design:
        """A linkage laid on a target by a part of its curve."""
        (lag, length), mirror, turn = laid
        structure, row = self.which[i]
        nodes, x = self.structures[structure], self.x[structure][row].astype(float)
        paths = turned_paths(nodes, x, CRANK)
        if paths is None:
            paths = node_paths(nodes, x, ANGLE[:-1])[0]
        ring = paths[-1, RING]
        along = np.zeros(CRANK + 1)
        np.cumsum(np.abs(ring[1:] - ring[:-1]), out=along[1:])
        ends = np.array([lag, (lag + length) % M]) * (along[-1] / M)
        first, last = (np.interp(ends, along, ANGLE)).tolist()
        span = max((last - first) % (2 * np.pi), 0.35) if length < M else FULL_SPAN
        return Design(nodes, np.append(x, (turn, first, span)), mirror)


@dataclass(frozen=True, eq=False)
class Matches:
    """How far the curves of an atlas are from a target, each ``laid`` on it as well as it goes."""

    atlas: Atlas
    distances: NDArray[np.floating[Any]]
    laid: Callable[[int], Laid]

    def order(self, draw: Draw, most: int) -> Indices:
        """Linkages with at most so many joints: the nearest, then all others drawn, the nearer the likelier early."""
        joints = np.array([len(each) // 4 for each in self.atlas.structures])
        order = np.argsort(self.distances, kind="stable")
        rows = order[joints[self.atlas.which[order, 0]] <= most]
        drawn = draw.exponential(size=len(rows)) * (EVENLY + np.arange(len(rows)))
        drawn[:NEAREST] = 0.0
        return np.asarray(rows[np.argsort(drawn, kind="stable")])

    def design(self, i: int) -> Design:
        """A linkage laid on the target."""
        return self.atlas.design(i, self.laid(i))


def parts(closed: bool) -> list[Part]:
    """First point and number of steps of every part that is tried."""
    return [(0, M)] if closed else [(at, length) for length, step in PARTS for at in range(0, M, step)]


def places(first: int, length: int) -> Indices:
    """Points of a part."""
    last = length * (POINTS - 1) / POINTS if length == M else length
    return np.round(first + np.linspace(0, last, POINTS)).astype(int) % M


def _tables(target: Target) -> tuple[Floats, Floats]:
    """Distances from the target and from its mirror image on rings, and points of both."""
    from scipy.spatial import cKDTree

    ring, angle = (np.arange(RINGS) + 0.5) * (REACH / RINGS), np.arange(ANGLES) * (2 * np.pi / ANGLES)
    grid = np.multiply.outer(ring, np.exp(1j * angle))
    # a row holds the angles of one remainder by ANGLES / TURNS after each other, twice
    order = (np.arange(4)[:, None] + 4 * (np.arange(2 * TURNS) % TURNS)).ravel()
    tables, landmarks = [], []
    for points in (target.points, target.points.conj()):
        tree = cKDTree(np.column_stack([points.real, points.imag]))
        far = tree.query(np.stack([grid.real, grid.imag], axis=-1))[0]
        some = even_points(points, LANDMARKS, target.closed)
        tables.append(far[:, order].ravel())
        landmarks += [some.real, some.imag]
    return np.concatenate(tables), np.concatenate(landmarks)


def _windows(target: Target) -> Iterator[tuple[bool, Complexes]]:
    """The target at each window length, mirrored and backwards."""
    for length in (M,) if target.closed else WINDOWS:
        points = normal(even_points(target.points, length, target.closed))
        for mirror in (False, True):
            oriented = points.conj() if mirror else points
            yield mirror, oriented
            yield mirror, oriented[::-1]


def _match(curves: NDArray[np.int8], wanted: list[Any], filters: list[Any], closed: bool) -> NDArray[np.float32]:
    """Largest correlation of each curve, the number of its window, and its first point, (3, N)."""
    from scipy import fft

    z = _complex(curves).astype(np.complex64)
    spectra = fft.fft(z, axis=1)
    best = np.zeros((3, len(z)), np.float32)
    rows = np.arange(len(z))
    weights: dict[int, Any] = {M: 1.0} if closed else _energies(z)
    for number, ((_, window), one) in enumerate(zip(wanted, filters, strict=True)):
        product = fft.ifft(spectra * one, axis=1)
        value = (product.real**2 + product.imag**2) * weights[len(window)]
        at = value.argmax(1)
        better = value[rows, at] > best[0]
        best[:, better] = np.stack([value[rows, at], np.full(len(z), number), at])[:, better]
    return best


def _energies(z: Any) -> dict[int, Any]:
    """One over the energy of every window about its mean, from running sums, for every length of a window."""
    double = np.concatenate([np.zeros((len(z), 1), np.complex64), z, z], 1)
    sums, squares = np.cumsum(double, 1), np.cumsum(double.real**2 + double.imag**2, 1)
    found = {}
    for length in WINDOWS:
        part = sums[:, length : length + M] - sums[:, :M]
        energy = (squares[:, length : length + M] - squares[:, :M]) * length - part.real**2 - part.imag**2
        found[length] = 1 / np.maximum(energy, 1e-3 * length * length)
    return found


def _complex(curves: NDArray[np.int8]) -> Complexes:
    return np.asarray(STEP * (curves[..., 0] + 1j * curves[..., 1]))


def make(level: int) -> Atlas:
    """The atlas of a level, from its own seed: the same everywhere."""
    joints, slides, kinds = LEVELS[level]
    draw = np.random.default_rng(level + 1)
    found = [
        (nodes, draws) for dyads, count, draws in kinds for nodes in _structures(dyads, joints, slides, count, draw)
    ]
    signatures: list[tuple[Floats, NDArray[np.int8]] | None] = [None] * len(found)
    seeds = draw.integers(1 << 60, size=len(found))

    def work(first: int, last: int) -> None:
        for number in range(first, last):
            signatures[number] = _draws(*found[number], np.random.default_rng(seeds[number]))

    spread_over(len(found), 1, cores(), work)
    parts = [each for each in signatures if each is not None]
    which = np.concatenate(
        [np.column_stack([np.full(len(x), k), np.arange(len(x))]) for k, (x, _) in enumerate(parts)]
    )
    curves = np.concatenate([curve for _, curve in parts])
    return Atlas(tuple(nodes for nodes, _ in found), tuple(x for x, _ in parts), which.astype(np.int32), curves)


def _structures(dyads: int, joints: int, slides: int, count: int, draw: Draw) -> list[Integers]:
    """So many different structures."""
    found: dict[bytes, Integers] = {}
    while len(found) < count:
        nodes = random_structure(dyads, joints, draw, slides=slides)
        found.setdefault(nodes.tobytes(), nodes)
    return list(found.values())


def _draws(nodes: Integers, draws: int, draw: np.random.Generator) -> tuple[Floats, NDArray[np.int8]]:
    """Linkages of one structure that turn fully, and their curves."""
    joints = len(nodes) // 4
    size = 2 * (joints - 2)
    numbers = draw.uniform(size=(draws, size))
    x, z, radius = np.zeros((draws, size)), np.zeros((draws, M, 2)), np.zeros(draws)
    room = np.zeros(2 * joints * POSITIONS + 16)
    kernels()(
        "draw_linkages",
        nodes.ctypes.data,
        joints,
        POSITIONS,
        x.ctypes.data,
        numbers.ctypes.data,
        LIMIT,
        M,
        z.ctypes.data,
        room.ctypes.data,
        draws,
        radius.ctypes.data,
    )
    good = radius > RADIUS
    return x[good].astype(np.float32), np.clip(np.round(z[good] / STEP), -127, 127).astype(np.int8)


@cache
def atlas(level: int) -> Atlas:
    """The atlas of a level: from memory, from the cache folder, or made."""
    path = _path(level)
    if path is not None and path.is_file():
        with suppress(OSError, ValueError, KeyError):
            return _read(path, level)
    made = make(level)
    if path is not None:
        with suppress(OSError):
            _write(path, made)
    return made


def _path(level: int) -> Path | None:
    base = folder()
    name = "-".join(re.findall(r"\d+", str((EDITION, *LEVELS[level]))))
    return None if base is None else base / f"free_curves-{name}.npz"


def _read(path: Path, level: int) -> Atlas:
    with np.load(path, allow_pickle=False) as file:
        which, curves, structures, numbers = (file[key] for key in ("which", "curves", "structures", "x"))
    count, joints = sum(each[1] for each in LEVELS[level][2]), structures[:, 0]
    nodes = tuple(np.ascontiguousarray(row[1 : 1 + 4 * row[0]]) for row in structures)
    rows = np.bincount(which[:, 0], minlength=count)
    ends = np.cumsum(rows * 2 * (joints - 2))
    if len(nodes) != count or len(curves) != len(which) or curves.shape[1:] != (M, 2) or ends[-1] != len(numbers):
        raise ValueError(path)
    parts = np.split(numbers, ends[:-1])
    x = tuple(part.reshape(int(row), -1) for part, row in zip(parts, rows, strict=True))
    return Atlas(nodes, x, which, curves)


def _write(path: Path, atlas: Atlas) -> None:
    """Writes a temporary file next to it, then renames it."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    widest = max(map(len, atlas.structures))
    structures = np.zeros((len(atlas.structures), 1 + widest), np.int64)
    for row, nodes in zip(structures, atlas.structures, strict=True):
        row[0], row[1 : 1 + len(nodes)] = len(nodes) // 4, nodes
    numbers = np.concatenate([each.ravel() for each in atlas.x])
    handle, name = tempfile.mkstemp(dir=path.parent, suffix=".npz")
    with os.fdopen(handle, "wb") as file:
        np.savez(file, structures=structures, x=numbers, which=atlas.which, curves=atlas.curves)
    os.replace(name, path)
