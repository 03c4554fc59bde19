"""A DXF sheet: one position of a mechanism at true scale, in layers."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.errors import RequestError
from linkwright.export.base import package
from linkwright.export.results import Results
from linkwright.mechanism.mechanism import Link
from linkwright.plot.drawing.labels import Obstacles, link_labels, place, point_labels
from linkwright.plot.drawing.machine import Part
from linkwright.plot.drawing.scene import laid_out
from linkwright.plot.drawing.view import moved
from linkwright.plot.svg.element import Element
from linkwright.plot.symbols.base import PIN, Vec, points
from linkwright.words.characters import one_line

#: Layers with their colours (numbers of the AutoCAD colour index), each with a contrast of 3 or more on a white, a
#: dark grey and a black sheet; 7 is white or black, as the sheet demands.
LAYERS = {"frame": 8, "links": 150, "joints": 1, "paths": 92, "dimensions": 42, "text": 7}
#: Layer of each layer of the drawing on paper.
_OF_PART = {"ground": "frame", "bodies": "links", "blocks": "joints", "tops": "joints"}
STYLE = "LINKWRIGHT"


class Sheet:
    """The model space of a drawing; lengths in metres become units by ``factor``."""

    def __init__(self, document: Any, results: Results, index: int, factor: float) -> None:
        self.space = document.modelspace()
        self.results, self.index, self.factor = results, index, factor
        self.scene = laid_out(results.motion, index, inputs=False)
        self.unit = factor / self.scene.machine.view.scale
        self.height = 10.0 * self.unit
        self.ink: list[Floats] = []

    def machine(self) -> None:
        """Supports, links, blocks and pins."""
        for part in self.scene.parts:
            if part.layer in _OF_PART:
                for stroke in _strokes(part):
                    self._stroke(stroke, part.carrier, _OF_PART[part.layer])
        self._pins()

    def paths(self, names: Sequence[str] | None, *, spline: bool) -> None:
        """Paths of points, by default of all that move."""
        motion = self.results.motion
        for name in motion.point_names() if names is None else names:
            track = motion.point(name).position
            if names is None and not np.nanmax(np.ptp(track[motion.ok], axis=0), initial=0.0) > 0:
                continue
            closed = motion.positions.closed and motion.whole
            for piece in unbroken(track):
                self._path(self.factor * piece, closed, spline)

    def dimensions(self) -> None:
        """A dimension line for every length that the model gives."""
        for name, link in self.results.mechanism.links.items():
            for first, second in _lengths(link):
                a, b = _upright(self._world(name, first), self._world(name, second))
                side = 1.0 if self._side(a, b) >= 0 else -1.0
                line = self.space.add_aligned_dim(
                    p1=a,
                    p2=b,
                    distance=-side * 2.4 * self.height,
                    dimstyle=STYLE,
                    dxfattribs={"layer": "dimensions"},
                )
                line.render()
                self.ink.append(self._beside(a, b, -side * 2.4 * self.height))

    def labels(self) -> None:
        """Names of points and links clear of lines, and the name of the mechanism below."""
        wanted = [*point_labels(self.scene.machine, self.index), *link_labels(self.scene, self.index)]
        ink = [*self.scene.ink(self.index), *self.ink]
        for label, chosen in zip(wanted, place(wanted, Obstacles.of(ink)), strict=True):
            left, _, _, bottom = chosen.box
            self._text(label.text, (left, bottom - 0.15 * label.size), 0.7 * label.size * self.unit)
        cloud = np.concatenate(ink)
        corner = (float(cloud[:, 0].min()), float(cloud[:, 1].max()) + 60.0)
        self._text(self.results.mechanism.name, corner, 1.2 * self.height)

    def _text(self, text: str, paper: Vec, height: float) -> None:
        attributes = {
            "layer": "text",
            "style": STYLE,
            "height": height,
            "insert": self._units(points([paper]))[0],
        }
        self.space.add_text(one_line(text).replace("%%", "%%%%%%"), dxfattribs=attributes)

    def _units(self, paper: Floats) -> Floats:
        """Points of the paper in units of the drawing."""
        scaled: Floats = paper * (self.unit, -self.unit)
        return scaled

    def _stroke(self, stroke: Stroke, carrier: str, layer: str) -> None:
        machine = self.scene.machine
        at = self._units(moved(stroke.points, machine.view.transform(machine.placed[carrier], self.index)))
        if stroke.radius is not None:
            self.space.add_circle(at[0], stroke.radius * self.unit, dxfattribs={"layer": layer})
        elif len(at) == 2 and not stroke.closed:
            self.space.add_line(at[0], at[1], dxfattribs={"layer": layer})
        elif len(at) > 1:
            self.space.add_lwpolyline(at.tolist(), close=stroke.closed, dxfattribs={"layer": layer})

    def _pins(self) -> None:
        """Circles at pins, of the pin's radius where it is given; small ones at other points."""
        mechanism = self.results.mechanism
        for name, link in {"frame": mechanism.frame, **mechanism.links}.items():
            for point in link.points:
                pin = mechanism.pins.get(point)
                if pin is not None and name in pin.links:
                    if name != pin.links[0]:
                        continue
                    radius = pin.pin_radius * self.factor if pin.pin_radius else PIN * self.unit
                elif name == "frame":
                    continue
                else:
                    radius = 0.4 * PIN * self.unit
                self.space.add_circle(self._world(name, point), radius, dxfattribs={"layer": "joints"})

    def _world(self, link: str, point: str) -> Vec:
        local = self.results.mechanism.link(link).points[point]
        x, y = self.factor * self.scene.machine.placed[link].world(local)[self.index]
        return float(x), float(y)

    def _beside(self, a: Vec, b: Vec, distance: float) -> Floats:
        """A dimension line and the middle of its text, on the paper."""
        length = math.dist(a, b)
        left = np.array([a[1] - b[1], b[0] - a[0]]) / length
        ends = np.array([a, b]) + distance * left
        middle = ends.mean(axis=0)
        along = 1.5 * self.height * (ends[1] - ends[0]) / length
        text = [middle + shift * self.height * left for shift in (0.0, 0.7, 1.3)]
        rows = np.concatenate([ends, *([row - along, row + along] for row in text)])
        return points(rows) / (self.unit, -self.unit)

    def _path(self, track: Floats, closed: bool, spline: bool) -> None:
        attributes = {"layer": "paths"}
        if spline and len(track) > 3:
            through = np.vstack([track, track[:1]]) if closed else track
            self.space.add_spline([(x, y, 0.0) for x, y in through.tolist()], dxfattribs=attributes)
        else:
            self.space.add_lwpolyline(track.tolist(), close=closed, dxfattribs=attributes)

    def _side(self, a: Vec, b: Vec) -> float:
        """On which side of a line most of the machine is; left is positive."""
        cloud = self._units(np.concatenate(self.scene.ink(self.index)))
        x, y = cloud.mean(axis=0)
        return float((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]))


def _strokes(part: Part) -> list[Stroke]:
    """Bars and plates from their exact lines, symbols from what they draw."""
    if part.layer == "bodies":
        return [Stroke(line) for line in part.shape.ink]
    return [stroke for element in part.shape.elements for stroke in strokes(element)]


def _upright(a: Vec, b: Vec) -> tuple[Vec, Vec]:
    """Ends of a dimension line in the order in which its text is read from below or from the right."""
    tilt = math.atan2(b[1] - a[1], b[0] - a[0])
    return (a, b) if -0.5 * math.pi + 1e-6 < tilt <= 0.5 * math.pi + 1e-6 else (b, a)


def _lengths(link: Link) -> list[tuple[str, str]]:
    """Pairs of points whose distance is a dimension of the link."""
    names = list(link.points)
    if link.geometry == "length":
        return [(names[0], names[1])]
    if link.geometry == "bent":
        return [(names[0], names[1]), (names[0], names[2])]
    return []


def check_unit(unit: str) -> tuple[float, int]:
    """Units per metre, and DXF's number of the unit; raises LinkwrightError."""
    known = {"mm": (1000.0, 4), "m": (1.0, 6)}
    if unit not in known:
        raise RequestError("export.bad_unit", unit=unit)
    return known[unit]


def new_document(layers: Mapping[str, int], unit: int = 4) -> Any:
    """An empty document with layers of these colours (numbers of the AutoCAD colour index); ``unit``: DXF's number,
    millimetres unless given. Raises LinkwrightError where ezdxf is missing."""
    document = package("ezdxf", "dxf_drawings").new("R2010", setup=["linetypes"])
    document.units = unit
    for name, colour in layers.items():
        document.layers.add(name, color=colour)
    return document


def content_of(document: Any) -> bytes:
    """The file of a document."""
    stream = io.StringIO()
    document.write(stream)
    return bytes(document.encode(stream.getvalue()))


def prepare(document: Any, height: float, text: str, decimals: int) -> None:
    """The styles of text and dimensions."""
    document.styles.add(STYLE, font="arial.ttf" if text.isascii() else "simsun.ttc")
    style = document.dimstyles.new(STYLE)
    for key, value in {"dimtxt": height, "dimasz": 0.8 * height, "dimexo": 0.4 * height, "dimexe": 0.5 * height,
                       "dimgap": 0.3 * height, "dimdec": decimals, "dimzin": 8, "dimtad": 1, "dimlfac": 1.0,
                       "dimscale": 1.0, "dimtxsty": STYLE}.items():  # fmt: skip
        style.set_dxf_attrib(key, value)


def decimals_for(factor: float) -> int:
    """Decimals of dimensions: to a thousandth of a millimetre."""
    return max(0, 6 - round(math.log10(factor)))


_NUMBER = r"(-?\d*\.?\d+)"
_MOVE = re.compile(rf"([ML]){_NUMBER} {_NUMBER}")


@dataclass(frozen=True)
class Stroke:
    """A polyline (k, 2) on the paper, or a circle where it has a ``radius`` (its centre is the only point)."""

    points: Floats
    closed: bool = False
    radius: float | None = None


def strokes(element: Element) -> Iterator[Stroke]:
    """What an element of a symbol draws; elements with curves other than circles are left out."""
    given = dict(element.attributes)
    if element.tag == "circle":
        yield Stroke(points([(float(given["cx"]), float(given["cy"]))]), radius=float(given["r"]))
    elif element.tag == "path" and re.fullmatch(r"[ML\d\s.,Z-]*", given["d"]):
        for part in filter(None, re.split(r"(?=M)", given["d"])):
            rows = [(float(x), float(y)) for _, x, y in _MOVE.findall(part)]
            if rows:
                yield Stroke(points(rows), closed=part.endswith("Z"))
    for inner in element.content:
        if isinstance(inner, Element):
            yield from strokes(inner)


def unbroken(track: Floats) -> Iterator[Floats]:
    """The pieces of a path between positions that were not reached."""
    good = np.asarray(np.isfinite(track).all(axis=1))
    for piece in np.split(np.arange(len(track)), np.flatnonzero(np.diff(good.astype(int))) + 1):
        if len(piece) > 1 and good[piece[0]]:
            yield track[piece]
