"""A curve from a file: two columns of numbers, or a path of an SVG."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.synthesis.result import FREE_CURVE_FILE, FREE_CURVE_NO_PATH, SynthesisError
from linkwright.words import _

_TOKEN = re.compile(r"([MmLlHhVvCcSsQqTtAaZz])|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([^\s,])")
#: What begins as a number does, and two numbers with commas between blanks.
_NUMBER, _EITHER = re.compile(r"[-+]?\.?\d"), re.compile(r"[-+]?\d+,\d+\s+[-+]?\d+,\d+$")
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}
#: Points of a curved piece.
PIECE = 24


def read_curve(path: Path) -> Complexes:
    """The curve of a file in the file's units; an SVG's y axis is turned upwards. Raises SynthesisError."""
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
