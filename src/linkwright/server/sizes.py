"""Lengths, angles and coordinates as they are written: as typed, or measured and rounded."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterable, Mapping
from itertools import combinations
from typing import Any

from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Scalar, Sequence
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft, coordinates, length
from linkwright.server.entries import texts
from linkwright.server.geometry import Shape, Values, plain, shape
from linkwright.units import number
from linkwright.words import _

#: Angles are written in such steps, deg.
ANGLES = 1e-3
#: Units of numbers that are typed without one.
UNITS = {"length": "mm", "angle": "deg", "mass": "kg", "force": "N"}
_NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE)
_DECIMAL = re.compile(r"([+-]?\d*)[,，](\d+)((?:\s*[^\W\d_][^,，]*)?)")


def typed(asked: Mapping[str, Any], key: str, dimension: str) -> str | None:
    """A quantity as it was typed, with its unit; None where none was. Raises QuantityError for what is none."""
    value = asked.get(key)
    if value is None or value == "":
        return None
    return quantity(value, dimension, key)


def quantity(value: Any, dimension: str, key: str = "length") -> str:
    """A typed text with its unit: decimal commas are points, a bare number has the usual unit; a number is SI."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        size = request.number({key: value}, key)
        return f"{number(size * 1e3, 12)} mm" if dimension == "length" else f"{number(size, 12)} {UNITS[dimension]}"
    text = tidy(request.line({key: value}, key))
    if _NUMBER.fullmatch(text):
        text = f"{text} {UNITS[dimension]}"
    size = amount(text, dimension)
    if size <= 0 and dimension == "length":
        raise LinkwrightError(_("a length is above zero: {text!r}", code="studio.no_length", text=text))
    return text


def tidy(text: str) -> str:
    """A typed value as a file has it: a decimal comma between a number's digits is a point."""
    found = _DECIMAL.fullmatch(text.strip())
    return f"{found[1]}.{found[2]}{found[3]}" if found else text.strip()


def angle(value: float) -> str:
    """An angle (rad)."""
    text = number(round(math.degrees(value) / ANGLES) * ANGLES, 9)
    return f"{'0' if text == '-0' else text} deg"


def in_axes(points: Iterable[str], at: Mapping[str, complex]) -> dict[str, complex]:
    """Places in axes from the first point to the second."""
    first, second, *_unused = names = list(points)
    axis = at[second] - at[first]
    if not abs(axis):
        raise LinkwrightError(
            _(
                "{first} and {second} are at one place; a link needs two",
                code="studio.no_distance",
                first=first,
                second=second,
            )
        )
    return {name: (at[name] - at[first]) * abs(axis) / axis for name in names}


def remeasure(draft: Draft, link: str, at: Mapping[str, complex]) -> None:
    """Writes the sizes of a link that its drawn points have now; expressions, and what differs by less than a step
    of drawing, stay."""
    old = shape(Values(draft.root), draft.link(link))
    if old is None or len(old.points) < 2 or any(point not in at for point in old.points):
        return
    new = _posed(old, at)
    for point, place in new.items():
        if abs(place - old.points[point]) > 0.6 * draft.step:
            _write(draft, link, old, point, place)


def _posed(old: Shape, at: Mapping[str, complex]) -> dict[str, complex]:
    """The drawn places in the link's axes: where its coordinates are given, in those that fit them best."""
    if old.form != "coordinates":
        if old.form == "point":
            return dict(old.points)
        return in_axes(old.points, at)
    first, second = _kept_pair(old.points, at) or next(iter(zip(old.points, list(old.points)[1:], strict=False)))
    turn = (at[second] - at[first]) / (old.points[second] - old.points[first] or 1.0)
    turn = turn / abs(turn) if abs(turn) else 1.0
    return {name: (at[name] - at[first]) / turn + old.points[first] for name in old.points}


def _kept_pair(points: Mapping[str, complex], at: Mapping[str, complex]) -> tuple[str, str] | None:
    """The two points farthest apart whose distance is drawn as it is written."""
    apart = {(a, b): abs(points[a] - points[b]) for a, b in combinations(points, 2)}
    kept = [pair for pair, size in apart.items() if abs(abs(at[pair[0]] - at[pair[1]]) - size) <= 1e-3 * size]
    return max(kept, key=apart.__getitem__, default=None)


def _write(draft: Draft, link: str, old: Shape, point: str, place: complex) -> None:
    """Writes the sizes that place a point in a link's axes."""
    entry = draft.link(link)
    listed = texts(entry.get("points"))
    if point in listed:
        number_of = listed.index(point)
        if old.form == "bent":
            sides, turn = entry.get("lengths"), entry.get("angle")
            if isinstance(sides, Sequence) and plain(sides.items[number_of - 1]):
                draft.write(sides.items[number_of - 1], length(abs(place), draft.step))
            turn = draft.link(link).get("angle")
            if number_of == 2 and turn is not None and plain(turn):
                draft.write(turn, angle(cmath.phase(place)))
        elif (size := entry.get("length")) is not None and plain(size):
            draft.write(size, length(place.real, draft.step))
        return
    for key in ("also", "points"):
        table = entry.get(key)
        node = table.get(point) if isinstance(table, MappingNode) else None
        if node is not None and not isinstance(node, Scalar) and plain(node):
            draft.write(node, flow(coordinates(place, draft.step)))
