"""The outline of a plate in a DXF drawing: one closed contour with those of openings in it.

``read_outline(path) -> (rings, findings)``: rings in m, the outer one first, none after an error among the findings.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.core.plane import area
from linkwright.errors import Finding
from linkwright.files.source import read_bytes
from linkwright.importers.dxf_entities import DEPTH, UNITS_BY_NUMBER, open_document
from linkwright.importers.layout import Remarks
from linkwright.mechanism.link import Vec
from linkwright.shapes.distance import contains
from linkwright.shapes.loop import Edge
from linkwright.shapes.shape import polygon
from linkwright.units import UNITS, number
from linkwright.words import Message, _

#: How far polygons may leave arcs, m.
SAGITTA = 0.9e-6
#: Distance of ends that are one, as a share of the drawing's size, and what of it is rounding.
ONE, ROUNDED = 1e-4, 1e-9


_OPEN = _("a contour is open at ({x}, {y}) {unit}")
_BRANCH = _("more than two lines meet at ({x}, {y}) {unit}")
_SECOND = _("a contour at ({x}, {y}) {unit} is not within the outer one, or is within an opening of it")
#: Code and remedy of each.
_ERRORS = {
    _OPEN: ("import.dxf.open", _("draw lines and arcs end to end, with object snap, or as a closed polyline")),
    _BRANCH: ("import.dxf.branches", _("leave only lines along which the plate is cut; hide the layers of others")),
    _SECOND: ("import.dxf.second", _("draw one plate in each file; hide the layers of what is not its outline")),
}


@dataclass(frozen=True)
class Contour:
    """Places along a line or curve, drawing units; ``key``: the entity."""

    places: Complexes
    key: str
    closed: bool = False


def read_outline(
    path: str | Path, *, unit: str | None = None
) -> tuple[tuple[tuple[Vec, ...], ...], tuple[Finding, ...]]:
    """Rings of a plate in a DXF file, m, in the drawing's axes, and what has to be said about the file.

    Closed polylines with arcs, circles, ellipses, splines, and chains of lines and arcs that meet end to end; arcs
    become chords that leave them by less than 1 µm. ``unit``: of lengths, where the file does not state it. The outer
    ring is the first one, counter-clockwise, all others lie in it, clockwise. After an error among the findings there
    are no rings.

    Raises LinkwrightError for a file that is not there, and where ezdxf is missing.
    """
    remarks = Remarks(Path(path).name)
    document = open_document(read_bytes(path), remarks)
    if document is None:
        return (), tuple(remarks.found)
    unit = unit or UNITS_BY_NUMBER.get(document.units)
    if unit is None:
        unit = "mm"
        message = _("the drawing does not state its unit; millimetres are taken")
        remarks.remark("warning", message, _("set its unit ($INSUNITS)"), "import.dxf.unit")
    factor = UNITS[unit][0]
    hidden = {layer.dxf.name for layer in document.layers if layer.is_off() or layer.is_frozen()}
    found = [each for each in _contours(document.modelspace(), SAGITTA / factor) if each[0] not in hidden]
    rings = _nested(_closed([each for _layer, each in found], unit, remarks), unit, remarks)
    if remarks.failed:
        return (), tuple(remarks.found)
    scaled = tuple(tuple((each.real * factor, each.imag * factor) for each in ring.tolist()) for ring in rings)
    return scaled, tuple(remarks.found)


def _contours(space: Any, sagitta: float, depth: int = 0, inserted_on: str = "0") -> Iterator[tuple[str, Contour]]:
    """Lines and curves with their layers, those of blocks where they are inserted."""
    for each in space:
        kind, layer = each.dxftype(), each.dxf.get("layer", "0")
        layer = inserted_on if layer == "0" else layer
        if kind == "INSERT" and depth < DEPTH:
            yield from _contours(each.virtual_entities(), sagitta, depth + 1, layer)
            continue
        found = _path(each, kind, sagitta)
        if found is not None and len(found[0]) > 1:
            key = f"{kind} #{each.dxf.get('handle') or '?'}, {layer}"
            yield layer, Contour(np.array([complex(at.x, at.y) for at in found[0]]), key, found[1])


def _path(each: Any, kind: str, sagitta: float) -> tuple[list[Any], bool] | None:
    """Places along an entity, and whether it is closed; None for what is no line or curve."""
    if kind == "LINE":
        return [each.dxf.start, each.dxf.end], False
    if kind == "LWPOLYLINE":
        return _polyline(each, list(each.get_points("xyb")), bool(each.closed), sagitta)
    if kind == "POLYLINE" and each.is_2d_polyline:
        vertices = [(*vertex.dxf.location.vec2, vertex.dxf.get("bulge", 0.0)) for vertex in each.vertices]
        return _polyline(each, vertices, bool(each.is_closed), sagitta)
    if kind in ("CIRCLE", "ARC", "ELLIPSE", "SPLINE"):
        places = list(each.flattening(sagitta))
        if not places:
            return None
        closed = places[0].isclose(places[-1], abs_tol=1e-9 * max(abs(places[0].x), abs(places[0].y), 1.0))
        return (places[:-1] if closed else places), closed
    return None


def _polyline(
    each: Any, vertices: Sequence[tuple[float, float, float]], closed: bool, sagitta: float
) -> tuple[list[Any], bool]:
    """Places along lines and arcs from vertex to vertex, from the entity's own axes."""
    from ezdxf.math import Vec3

    ways = [complex(x, y) for x, y, _bulge in vertices]
    after = [*ways[1:], *([ways[0]] if closed else [])]
    edges = [Edge(start, end, vertex[2]) for start, end, vertex in zip(ways, after, vertices, strict=False)]
    flat = [place for edge in edges for place in edge.points(sagitta)]
    flat += [] if closed else ways[-1:]
    ocs, height = each.ocs(), float(getattr(each.dxf, "elevation", 0.0) if each.dxftype() == "LWPOLYLINE" else 0.0)
    return [ocs.to_wcs(Vec3(place.real, place.imag, height)) for place in flat], closed


def _closed(contours: Sequence[Contour], unit: str, remarks: Remarks) -> list[Contour]:
    """Closed contours, open ones chained; remarks about those that stay open."""
    if not contours:
        message = _("the drawing holds no lines or curves")
        remarks.remark("error", message, _("draw the closed outline of the plate in it"), "import.dxf.no_outline")
        return []
    every = np.concatenate([each.places for each in contours])
    size = abs(complex(np.ptp(every.real), np.ptp(every.imag))) or 1.0
    chains = _Chains(_once([each for each in contours if not each.closed], ONE * size), ONE * size)
    found = [each for each in contours if each.closed]
    for chain, faults in chains.all():
        for message, place in faults:
            _say(remarks, message, place, unit, chain.key)
        found.append(chain)
    if chains.widest > ROUNDED * size:
        message = _("ends up to {away} {unit} apart are taken as one place", away=number(chains.widest, 3), unit=unit)
        remarks.remark("note", message, _("draw them at one place, with object snap"), "import.dxf.apart")
    return found


def _once(contours: Sequence[Contour], near: float) -> list[Contour]:
    """Contours that are longer than a distance, without those that are drawn a second time."""
    found: list[Contour] = []
    for each in contours:
        ends = {each.places[0], each.places[-1]}
        same = (other for other in found if {other.places[0], other.places[-1]} == ends)
        twice = any(np.abs(each.places.mean() - other.places.mean()) <= near for other in same)
        if not twice and np.abs(each.places - each.places[0]).max() > near:
            found.append(each)
    return found


class _Chains:
    """Open contours put together end to end; ``widest``: distance of ends that were taken as one."""

    def __init__(self, contours: Sequence[Contour], near: float) -> None:
        self.contours, self.near = contours, near
        self.tips = np.array([[each.places[0], each.places[-1]] for each in contours]).reshape(-1, 2)
        self.free = np.ones(len(contours), dtype=np.bool_)
        self.widest = 0.0

    def all(self) -> Iterator[tuple[Contour, list[tuple[Message, complex]]]]:
        """Chains, each with what is wrong with it and where."""
        while self.free.any():
            first = int(np.argmax(self.free))
            self.free[first] = False
            yield self._chain(self.contours[first])

    def _chain(self, first: Contour) -> tuple[Contour, list[tuple[Message, complex]]]:
        parts, faults = [first.places], []
        while (apart := abs(parts[-1][-1] - parts[0][0])) > self.near:
            end = parts[-1][-1]
            away = np.where(self.free[:, None], np.abs(self.tips - end), math.inf)
            closest = int(np.argmin(away)) if away.size else -1
            if closest < 0 or away.flat[closest] > self.near:
                faults.append((_OPEN, end))
                break
            if np.count_nonzero((away <= self.near).any(axis=1)) > 1:
                faults.append((_BRANCH, end))
            contour, backward = divmod(closest, 2)
            self.free[contour] = False
            self.widest = max(self.widest, float(away.flat[closest]))
            places = self.contours[contour].places
            parts.append(places[::-1] if backward else places)
        else:
            self.widest = max(self.widest, apart)
        return Contour(np.concatenate([each[:-1] for each in parts]), first.key, closed=True), faults


def _nested(contours: Sequence[Contour], unit: str, remarks: Remarks) -> list[Complexes]:
    """The outer ring counter-clockwise, then those within it clockwise; a remark about each that is not."""
    rings = [(each, area(each.places)) for each in contours if len(each.places) > 2]
    rings.sort(key=lambda each: -abs(each[1]))
    found: list[Complexes] = []
    for contour, size in rings:
        outer = not found
        if not outer:
            at = contour.places[:1]
            around = [bool(contains(polygon(ring), at)[0]) for ring in found]
            if not around[0] or any(around[1:]):
                _say(remarks, _SECOND, complex(at[0]), unit, contour.key)
                continue
        found.append(contour.places if (size > 0.0) == outer else contour.places[::-1])
    return found


def _say(remarks: Remarks, message: Message, place: complex, unit: str, key: str) -> None:
    """An error at a place of the drawing."""
    code, remedy = _ERRORS[message]
    text = message.format(x=number(place.real, 6), y=number(place.imag, 6), unit=unit)
    remarks.remark("error", text, remedy, code, key=key)
