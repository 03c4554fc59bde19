"""What the elements of a drawing draw, as polylines and circles with their classes."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.pictures.svg.element import Element

_PATH = re.compile(r"[MLHVhvAZ]|-?\d*\.?\d+")
_MOVE = re.compile(r"(translate|rotate)\(([^)]*)\)")
#: Numbers behind each command of a path.
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "h": 1, "v": 1, "A": 7, "Z": 0}
#: Turn of an arc from one place to the next, rad.
_STEP = 0.15


@dataclass(frozen=True)
class Stroke:
    """A polyline (k, 2) on the paper, or a circle where it has a ``radius`` (its centre is the only point)."""

    points: Floats
    closed: bool = False
    radius: float | None = None
    style: str = ""


def strokes(elements: Iterable[Element], shift: Floats | None = None, turn: float = 0.0) -> Iterator[Stroke]:
    """The strokes of elements and of those within them, in their order; ``shift`` and ``turn`` (rad, clockwise on the
    paper) of the axes in which they stand; text has none."""
    origin = np.zeros(2) if shift is None else shift
    for each in elements:
        given = dict(each.attributes)
        if each.tag == "g":
            at, angle = _moved(given.get("transform", ""), origin, turn)
            yield from strokes((inner for inner in each.content if isinstance(inner, Element)), at, angle)
            continue
        style = given.get("class", "")
        if each.tag == "circle":
            centre = np.array([[float(given["cx"]), float(given["cy"])]])
            yield Stroke(_placed(centre, origin, turn), radius=float(given["r"]), style=style)
        elif each.tag == "path":
            for points, closed in _pieces(given["d"]):
                yield Stroke(_placed(points, origin, turn), closed, style=style)


def _placed(points: Floats, origin: Floats, turn: float) -> Floats:
    c, s = math.cos(turn), math.sin(turn)
    return np.asarray(origin + points @ np.array([(c, s), (-s, c)]))


def _moved(transform: str, origin: Floats, turn: float) -> tuple[Floats, float]:
    """The axes of a group: its shift and turn behind those of what holds it."""
    for kind, text in _MOVE.findall(transform):
        numbers = [float(each) for each in re.split(r"[\s,]+", text.strip())]
        if kind == "translate":
            origin = _placed(np.array([[numbers[0], numbers[1]]]), origin, turn)[0]
        else:
            turn += math.radians(numbers[0])
    return origin, turn


def _pieces(text: str) -> Iterator[tuple[Floats, bool]]:
    """The polylines of a path's text; arcs of circles become polylines."""
    words = _PATH.findall(text)
    rows: list[tuple[float, float]] = []
    k, command = 0, "M"
    while k < len(words):
        if words[k] in _TAKES:
            command = words[k]
            k += 1
        if command == "Z":
            if len(rows) > 1:
                yield np.array(rows), True
            rows = rows[:1]
            continue
        numbers = [float(each) for each in words[k : k + _TAKES[command]]]
        k += _TAKES[command]
        if command == "M":
            if len(rows) > 1:
                yield np.array(rows), False
            rows, command = [(numbers[0], numbers[1])], "L"
        else:
            rows += _onwards(rows[-1], command, numbers)
    if len(rows) > 1:
        yield np.array(rows), False


def _onwards(last: tuple[float, float], command: str, numbers: list[float]) -> list[tuple[float, float]]:
    x, y = last
    if command in "HVhv":
        step = numbers[0] - (x if command == "H" else y if command == "V" else 0.0)
        return [(x + step, y)] if command in "Hh" else [(x, y + step)]
    if command == "A":
        return _arc(
            last, (numbers[5], numbers[6]), numbers[0], large=bool(numbers[3]), sweep=bool(numbers[4])
        )
    return [(numbers[0], numbers[1])]


def _arc(
    start: tuple[float, float], end: tuple[float, float], radius: float, *, large: bool, sweep: bool
) -> list[tuple[float, float]]:
    """Places on an arc of a circle behind its start (SVG 2, appendix B.2.4)."""
    a, b = complex(*start), complex(*end)
    half = abs(b - a) / 2
    if half < 1e-9:
        return [end]
    radius = max(radius, half)
    side = 1.0 if large != sweep else -1.0
    middle = (a + b) / 2 + side * 1j * (b - a) / abs(b - a) * math.sqrt(radius**2 - half**2)
    first, last = (math.atan2((p - middle).imag, (p - middle).real) for p in (a, b))
    turn = (last - first) % (2 * math.pi) if sweep else -((first - last) % (2 * math.pi))
    count = max(2, math.ceil(abs(turn) / _STEP))
    angles = first + turn * np.arange(1, count + 1) / count
    return [(middle.real + radius * math.cos(t), middle.imag + radius * math.sin(t)) for t in angles]
