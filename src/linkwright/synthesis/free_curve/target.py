"""The wanted curve: read from a file, even points, tables of nearest points, and how far a curve lies from it."""

from __future__ import annotations

import math
import re
import threading
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.filesystem import allowed
from linkwright.synthesis.free_curve.dyad_gain import NUMBERS, ROWS
from linkwright.synthesis.free_curve.placing import FAR
from linkwright.synthesis.free_curve.topology import Design, kernels, node_paths
from linkwright.synthesis.names import FREE_CURVE_FILE, FREE_CURVE_NO_PATH
from linkwright.synthesis.result import SynthesisError
from linkwright.words import _

#: Positions of a turn at which a design is examined; positions on the drawn part for each of a fine descent, points
#: of the curve where it is so much longer through them, and the largest share of it between two of them.
TURN = 360
BETWEEN, SOME, LONGER, STEP = 8, 400, 1.05, 0.1
#: Points of a curve as the measure says; of a line, of which one in EVERY is compared with all of the other line.
EVEN, EVERY = 2000, 4
LINE = EVEN * EVERY


class Fineness:
    """Positions on the drawn part and on the rest of the turn, points of the target, smoothing ε."""

    def __init__(self, drawn: int, rest: int, points: int, soft: float) -> None:
        self.drawn, self.rest, self.points, self.soft = drawn, rest, points, soft


#: A descent begins where the distances are smooth: their kinks slow it down (Nesterov 2005).
COARSE = Fineness(48, 24, 64, 0.04)
MIDDLE, FINE = Fineness(96, 48, 128, 2e-3), Fineness(192, 192, 400, 3e-4)


class _Room(threading.local):
    """Work space of one thread."""

    def __init__(self) -> None:
        self.array = np.zeros(60000)


_ROOM = _Room()


class Target:
    """A curve (complex, at least two different points), closed or open, as the search sees it.

    Args:
        min_angle: minimum transmission angle, rad.
        largest: maximum distance of a node from the curve's centroid, in its rms radii.
        turning: both hold over a full turn of the crank; without it an open curve's hold on the drawn part.
    """

    def __init__(
        self, curve: Complexes, closed: bool, min_angle: float, largest: float, turning: bool = True
    ) -> None:
        self.arguments = curve, closed, min_angle, largest, turning
        even = even_points(curve, LINE, closed)
        self.closed, self.min_angle, self.largest, self.turning = closed, min_angle, largest, turning or closed
        self.centre = complex(even.mean())
        self.radius = float(np.sqrt(np.mean(np.abs(even - self.centre) ** 2)))
        self.points = (even - self.centre) / self.radius
        self._points: dict[tuple[int, bool], Floats] = {}
        for count in {each.points for each in (COARSE, MIDDLE, FINE)}:
            some = even_points(self.points, count, closed)
            for mirror, oriented in ((False, some), (True, some.conj())):
                self._points[count, mirror] = np.concatenate([oriented.real, oriented.imag, [0.0]])

    def __reduce__(self) -> tuple[type[Target], tuple[object, ...]]:
        """Pickled by its arguments, which are short."""
        return Target, self.arguments

    def descend(
        self, design: Design, iterations: int, fineness: Fineness = MIDDLE, *, weight: float = 1.0, more: float = 0.0
    ) -> Design:
        """The design after a descent.

        ``weight``: of the penalties; ``more``: angle (rad) above the minimum.
        """
        points = self._points[fineness.points, design.mirror]
        x = design.x.copy()
        limits = [np.sin(self.min_angle + more) ** 2, self.largest * (1 - 2 * more), weight, fineness.soft**2]
        options = np.array(limits)
        arrays = [each.ctypes.data for each in (x, points, options, _ROOM.array)]
        value = kernels()(
            "descend",
            design.nodes.ctypes.data,
            design.joints,
            fineness.drawn,
            self._poses(fineness),
            int(self.closed),
            *arrays[:2],
            fineness.points,
            *arrays[2:],
            iterations,
        )
        return replace(design, x=x, value=value)

    def misses(self, design: Design) -> Floats:
        """Where the curve misses the target, as a unit vector: designs with similar errors have a product near 1."""
        points = self._points[COARSE.points, design.mirror]
        found = np.zeros(2 * COARSE.points)
        arrays = [each.ctypes.data for each in (design.x, points)]
        kernels()(
            "misses",
            design.nodes.ctypes.data,
            design.joints,
            MIDDLE.drawn,
            int(self.closed),
            *arrays,
            COARSE.points,
            _ROOM.array.ctypes.data,
            found.ctypes.data,
        )
        if design.mirror:
            found[COARSE.points :] *= -1
        return np.asarray(found / (np.linalg.norm(found) + 1e-300))

    def grown(self, design: Design, numbers: Floats, most: int) -> list[Design]:
        """Designs with one more dyad after rows of nine uniform numbers, the most promising first."""
        draws, points = len(numbers), self._points[COARSE.points, design.mirror]
        options = np.array([np.sin(self.min_angle) ** 2])
        made, x = np.zeros((draws, ROWS), np.int64), np.zeros((draws, NUMBERS))
        counts, gains, own = np.zeros(draws, np.int64), np.zeros(draws), design.x.copy()
        arrays = [each.ctypes.data for each in (options, _ROOM.array)]
        results = [each.ctypes.data for each in (made, x, counts, gains)]
        kernels()(
            "promises",
            design.nodes.ctypes.data,
            design.joints,
            MIDDLE.drawn,
            self._poses(MIDDLE),
            int(self.closed),
            own.ctypes.data,
            points.ctypes.data,
            COARSE.points,
            *arrays,
            draws,
            numbers.ctypes.data,
            most,
            *results,
        )
        return [
            Design(made[k, : 4 * counts[k]].copy(), x[k, : 2 * counts[k] - 1].copy(), design.mirror)
            for k in np.argsort(-gains, kind="stable")
            if gains[k] > 0
        ]

    def checked(self, design: Design, weight: float = 1.0) -> Design:
        """The design with the objective at fine positions; FAR where it does not close well there."""
        if design.value >= FAR:
            return design
        fine = self.descend(design, 0, FINE, weight=weight)
        nodes, x, room = (each.ctypes.data for each in (design.nodes, design.x, _ROOM.array))
        joints, full_turn = design.joints, int(self.turning)
        smallest = kernels()("place", nodes, joints, TURN, TURN, full_turn, x, room, room + 8 * TURN * joints)
        if smallest < np.sin(self.min_angle / 2) ** 2:
            return replace(fine, value=FAR)
        fine = replace(fine, value=max(fine.value, self._unseen(design)))
        return replace(fine, misses=self.misses(design))

    def _unseen(self, design: Design) -> float:
        """The deviation where fine positions do not see the curve, FAR where nothing does, else 0.

        A pin that passes a block's pivot closely turns it between two of them.
        """
        count, room = BETWEEN * FINE.drawn, _ROOM.array
        nodes, x, places = (each.ctypes.data for each in (design.nodes, design.x, room))
        own, other = (design.joints - 1) * count, design.joints * count
        kernels()("place", nodes, design.joints, count, count, int(self.closed), x, places, places + 8 * other)
        curve = room[own : own + count] + 1j * room[other + own : other + own + count]
        steps = np.abs(np.diff(curve))
        if steps.max() > STEP * steps.sum():
            return FAR
        if steps.sum() < LONGER * np.abs(np.diff(curve[::BETWEEN])).sum():
            return 0.0
        drawn = normal(even_points(curve, SOME, self.closed)) * np.exp(1j * design.x[-3])
        points = self.points[:: LINE // SOME]
        return symmetric_distance(drawn, points.conj() if design.mirror else points)

    def _poses(self, fineness: Fineness) -> int:
        """Positions at which the demands hold."""
        return fineness.drawn + (fineness.rest if self.turning and not self.closed else 0)

    def judged(self, design: Design, count: int) -> Floats:
        """Crank angles over which the demands hold."""
        first, span = (0.0, 2 * np.pi) if self.turning else design.x[-2:]
        return np.linspace(first, first + span, count)

    def curve(self, design: Design, count: int = LINE) -> Complexes:
        """The drawn curve at even crank angles, in units of the crank."""
        paths, _ = node_paths(design.nodes, design.x, self.crank(design, count))
        return np.asarray(paths[-1])

    def crank(self, design: Design, count: int) -> Floats:
        """Crank angles of the drawn part."""
        if self.closed:
            return np.linspace(0, 2 * np.pi, count + 1)[:-1]
        return np.linspace(design.x[-2], design.x[-2] + design.x[-1], count)

    def deviation(self, design: Design) -> tuple[float, float]:
        """Mean nearest distance of the lines, there and back, and the largest one, at the design's own turn."""
        if design.value >= FAR:
            return FAR, FAR
        curve = normal(even_points(self.curve(design), LINE, self.closed)) * np.exp(1j * design.x[-3])
        target_points = self.points.conj() if design.mirror else self.points
        there, back = _to_line(curve, target_points, self.closed), _to_line(target_points, curve, self.closed)
        return float(there.mean() + back.mean()), float(max(there.max(), back.max()))


def even_points(curve: Complexes, count: int, closed: bool) -> Complexes:
    """Points even in arc length on the polyline through a curve's points."""
    ring = np.append(curve, curve[0]) if closed else curve
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(ring)))])
    wanted = np.linspace(0, along[-1], count + 1)[:-1] if closed else np.linspace(0, along[-1], count)
    return np.asarray(np.interp(wanted, along, ring.real) + 1j * np.interp(wanted, along, ring.imag))


def normal(curve: Complexes) -> Complexes:
    """The curve with its centroid in the origin and rms radius 1."""
    moved = curve - curve.mean()
    return np.asarray(moved / np.sqrt(np.mean(np.abs(moved) ** 2)))


def _to_line(points: Complexes, line: Complexes, closed: bool) -> Floats:
    """Distances of every ``EVERY``-th point from a line of many points: from its segments next to the nearest one."""
    from scipy.spatial import cKDTree

    some = points[::EVERY]
    nearest = cKDTree(columns(line)).query(columns(some))[1]
    found = np.full(len(some), np.inf)
    for side in (-1, 1):
        other = np.mod(nearest + side, len(line)) if closed else np.clip(nearest + side, 0, len(line) - 1)
        way, off = line[other] - line[nearest], some - line[nearest]
        share = (off * way.conj()).real / np.maximum(np.abs(way) ** 2, 1e-300)
        found = np.minimum(found, np.abs(off - np.clip(share, 0.0, 1.0) * way))
    return found


def symmetric_distance(a: Complexes, b: Complexes) -> float:
    """Mean nearest distance from points of a to points of b plus that from b to a."""
    from scipy.spatial import cKDTree

    there, back = (cKDTree(columns(to)).query(columns(of))[0].mean() for of, to in ((a, b), (b, a)))
    return float(there + back)


def columns(points: Complexes) -> Floats:
    """Coordinates, (n, 2)."""
    return np.column_stack([points.real, points.imag])


_TOKEN = re.compile(r"([MmLlHhVvCcSsQqTtAaZz])|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([^\s,])")
#: What begins as a number does, and two numbers with commas between blanks.
_NUMBER, _EITHER = re.compile(r"[-+]?\.?\d"), re.compile(r"[-+]?\d+,\d+\s+[-+]?\d+,\d+$")
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}
#: Points of a curved piece.
PIECE = 24


def read_curve(path: Path) -> Complexes:
    """The curve of a file in the file's units; an SVG's y axis is turned up. Raises SynthesisError, RequestError."""
    allowed(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError):
        raise SynthesisError(FREE_CURVE_FILE.format(path=path)) from None
    return _svg(text, path) if path.suffix.lower() == ".svg" else _columns(text, path)


def _columns(text: str, path: Path) -> Complexes:
    """Two numbers a line, between commas, semicolons or blanks; lines of words before the first are headings.

    Between semicolons or tabs a comma is a decimal comma, as spreadsheets write it; two numbers with commas between
    blanks may mean either and are refused.
    """
    found: list[complex] = []
    for number, line in enumerate(text.splitlines(), 1):
        plain = line.strip().replace('"', "")
        decimal = ";" in plain or "\t" in plain
        parts = re.split(r"[\s;]+", plain.replace(",", ".")) if decimal else re.split(r"[\s,]+", plain)
        parts = [part for part in parts if part]
        if not parts or parts[0].startswith("#"):
            continue
        point = _point(parts)
        if point is None and not found and not _NUMBER.match(plain):
            continue
        if point is None or (not decimal and _EITHER.match(plain)):
            raise SynthesisError(
                _(
                    '{path}, line {line}: "{text}" are not two numbers; give x and y, such as 1.5, 2.0',
                    code="synthesize.free_curve.line",
                    path=path,
                    line=number,
                    text=line.strip()[:40],
                )
            )
        found.append(point)
    if len(found) < 2:
        raise SynthesisError(
            _(
                '"{path}" has fewer than two points; give x and y on each line',
                code="synthesize.free_curve.few",
                path=path,
            )
        )
    return np.array(found)


def _point(parts: list[str]) -> complex | None:
    """The point of the first two numbers; None where they are none."""
    try:
        x, y = (float(part) for part in parts[:2])
    except ValueError:
        return None
    return complex(x, y) if math.isfinite(x) and math.isfinite(y) else None


def _svg(text: str, path: Path) -> Complexes:
    """The first path, polyline or polygon."""
    from xml.etree import ElementTree

    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError:
        raise SynthesisError(FREE_CURVE_FILE.format(path=path)) from None
    for element in root.iter():
        name = str(element.tag).rpartition("}")[2]
        if name == "path" and element.get("d"):
            return path_points(str(element.get("d")), path).conj()
        if name in ("polyline", "polygon") and element.get("points"):
            end = "Z" if name == "polygon" else ""
            return path_points(f"M {element.get('points')} {end}", path).conj()
    raise SynthesisError(FREE_CURVE_NO_PATH.format(path=path))


def path_points(text: str, path: Path) -> Complexes:
    """Points along the first subpath of an SVG path's data."""
    tokens = [match.groups() for match in _TOKEN.finditer(text)]
    if not tokens or any(wrong for _, _, wrong in tokens) or tokens[0][0] not in ("M", "m"):
        raise SynthesisError(FREE_CURVE_NO_PATH.format(path=path))
    pen = _Pen()
    command, numbers = "", [float("nan")] * 0
    for letter, number, _unused in [*tokens, ("Z" if tokens[-1][0] in ("Z", "z") else "", "", "")]:
        if number:
            numbers.append(float(number))
            takes = _TAKES.get(command.upper(), 0)
            if takes and len(numbers) == takes:
                pen.piece(command, numbers)
                command, numbers = {"M": "L", "m": "l"}.get(command, command), []
            continue
        if letter in ("M", "m") and pen.points:
            break
        if letter in ("Z", "z") and len(pen.points) > 1:
            pen.points.append(pen.points[0])
            break
        command, numbers = letter, []
    if len(pen.points) < 2:
        raise SynthesisError(FREE_CURVE_NO_PATH.format(path=path))
    return np.array(pen.points)


class _Pen:
    """The points so far, and the last control point."""

    def __init__(self) -> None:
        self.points: list[complex] = []
        self.control: complex | None = None
        self.before = ""

    def piece(self, command: str, n: list[float]) -> None:
        """One piece with its numbers."""
        at = self.points[-1] if self.points else 0j
        base = at if command.islower() else 0j
        kind = command.upper()
        if kind == "H":
            ends = [complex(n[0] + base.real, at.imag)]
        elif kind == "V":
            ends = [complex(at.real, n[0] + base.imag)]
        elif kind == "A":
            ends = [complex(n[5], n[6]) + base]
        else:
            ends = [complex(x, y) + base for x, y in zip(n[::2], n[1::2], strict=True)]
        smooth = self.control if self.control is not None and self.before in _FAMILY.get(kind, "") else at
        if kind in ("S", "T"):
            ends = [2 * at - smooth, *ends]
        self.control, self.before = (ends[-2] if kind in "CSQT" else None), kind
        t = np.linspace(0, 1, PIECE + 1)[1:]
        if kind == "A":
            self.points += list(_arc(at, ends[-1], n))
        elif kind in "CSQT":
            self.points += list(_bezier(t, [at, *ends]))
        else:
            self.points.append(ends[-1])


_FAMILY = {"S": "CS", "T": "QT"}


def _bezier(t: np.ndarray[tuple[int, ...], np.dtype[np.float64]], controls: list[complex]) -> Complexes:
    """De Casteljau's points of a Bézier curve."""
    layer: list[Complexes] = [np.full(len(t), each) for each in controls]
    while len(layer) > 1:
        layer = [(1 - t) * a + t * b for a, b in pairwise(layer)]
    return layer[0]


def _arc(start: complex, end: complex, n: list[float]) -> Complexes:
    """An elliptic arc from its end points (SVG 1.1, F.6.5)."""
    rx, ry, tilt = abs(n[0]), abs(n[1]), np.exp(1j * np.radians(n[2]))
    if start == end or not rx or not ry:
        return np.array([end])

    def unit(z: complex) -> complex:
        turned = z / tilt
        return complex(turned.real / rx, turned.imag / ry)

    half = unit((start - end) / 2)
    grow = max(1.0, abs(half))
    half /= grow
    side = 1.0 if bool(n[3]) != bool(n[4]) else -1.0
    centre = side * np.sqrt(max(1 / abs(half) ** 2 - 1, 0.0)) * complex(half.imag, -half.real)
    first, last = np.angle(half - centre), np.angle(-half - centre)
    sweep = (last - first) % (2 * np.pi) if n[4] else -((first - last) % (2 * np.pi))
    on = np.exp(1j * (first + sweep * np.linspace(0, 1, 2 * PIECE + 1)[1:])) + centre
    place: Callable[[Complexes], Complexes] = lambda z: grow * tilt * (rx * z.real + 1j * ry * z.imag)  # noqa: E731
    return np.asarray(place(on) + (start + end) / 2)
