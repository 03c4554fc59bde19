"""A sheet as SVG and as DXF, in millimetres."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.exporters.dxf import add, content_of, new_document
from linkwright.pictures.picture import Circle, Inked, Item, Line, Outline, Text
from linkwright.pictures.svg import FAMILY_LIST, element, number
from linkwright.sheets.paper import Paper

#: Dashes and gaps of the kinds of lines in widths of a thin line (GB/T 17450, shortened for small pictures).
DASHES = {"dashed": (12.0, 3.0), "chain": (24.0, 3.0, 0.5, 3.0), "double_chain": (24.0, 3.0, 0.5, 3.0, 0.5, 3.0)}


def width_of(pen: str, paper: Paper) -> float:
    """Width of a line, mm."""
    return paper.thick if pen in ("frame", "thick") else paper.thick / 2


def svg(items: Iterable[Item], paper: Paper, title: str) -> str:
    """The document, one unit a millimetre."""
    root = element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "viewBox": f"0 0 {number(paper.width)} {number(paper.height)}",
            "width": f"{number(paper.width)}mm",
            "height": f"{number(paper.height)}mm",
            "role": "img",
        },
        element("title", None, title),
        element("style", None, _style(paper)),
        element("rect", {"fill": "#fff", "x": 0, "y": 0, "width": paper.width, "height": paper.height}),
        *(item.placed(np.array([0.0, paper.height]), scale=(1.0, -1.0)) for item in items),
    )
    return str(root)


def _style(paper: Paper) -> str:
    rules = [
        f".{pen}{{stroke-width:{number(width_of(pen, paper))}" + _dash(pen, paper) + "}"
        for pen in ("frame", "thick", "thin", "dashed", "chain", "double_chain")
    ]
    shapes = "path,circle{fill:none;stroke:#000;stroke-linejoin:round;stroke-linecap:round}"
    chains = ".dashed,.chain,.double_chain{stroke-linecap:butt}"
    fills = ".paper{fill:#fff}.ink{fill:#000}"
    return f"{shapes}{''.join(rules)}{chains}{fills}text{{font-family:{FAMILY_LIST};fill:#000}}"


def _dash(pen: str, paper: Paper) -> str:
    """The dashes of a kind of line."""
    if pen not in DASHES:
        return ""
    unit = 0.25 if paper.thick < 0.6 else 0.3
    return ";stroke-dasharray:" + " ".join(number(max(each * unit, 0.3)) for each in DASHES[pen])


#: Layers with their colour (7: black or white, as the ground demands), type of line and pattern, mm.
_TYPES = {
    "frame": "CONTINUOUS",
    "thick": "CONTINUOUS",
    "thin": "CONTINUOUS",
    "dashed": "SHEET_DASHED",
    "chain": "SHEET_CHAIN",
    "double_chain": "SHEET_DOUBLE_CHAIN",
}
_COLOURS = {"frame": 7, "thick": 7, "thin": 3, "dashed": 2, "chain": 1, "double_chain": 6, "text": 7}
#: Patterns: their full length, then dashes and gaps (negative), mm.
_PATTERNS = {
    "SHEET_DASHED": [4.5, 3.5, -1.0],
    "SHEET_CHAIN": [9.0, 7.0, -0.9, 0.2, -0.9],
    "SHEET_DOUBLE_CHAIN": [10.1, 7.0, -0.9, 0.2, -0.9, 0.2, -0.9],
}


def dxf(items: Iterable[Item], paper: Paper) -> bytes:
    """The file: model space in millimetres, the lower left corner of the paper at the origin.

    What a filled outline hides is cut away, as DXF has no order of painting that all programs keep. Raises
    LinkwrightError where ezdxf is missing.
    """
    rows = list(items)
    words = "".join(text for item in rows if isinstance(item, Text) for text, _ in item.runs)
    document = new_document(_COLOURS, words)
    for name, pattern in _PATTERNS.items():
        document.linetypes.add(name, pattern)
    for name, kind in _TYPES.items():
        layer = document.layers.get(name)
        layer.dxf.linetype = kind
        layer.dxf.lineweight = round(100 * width_of(name, paper))
    space = document.modelspace()
    document.header["$LTSCALE"] = 1.0
    document.header["$EXTMIN"], document.header["$EXTMAX"] = (0, 0, 0), (paper.width, paper.height, 0)
    _limits(document, paper)
    for place, item in enumerate(rows):
        if isinstance(item, Text):
            add(space, item, "text")
        else:
            covers = [each for each in rows[place + 1 :] if not isinstance(each, Text) and each.fill == "paper"]
            _shape(space, item, covers)
    return content_of(document)


def _limits(document: Any, paper: Paper) -> None:
    """The limits of the drawing, and the view with which it opens: the full paper."""
    document.header["$LIMMIN"], document.header["$LIMMAX"] = (0, 0), (paper.width, paper.height)
    document.set_modelspace_vport(height=1.05 * paper.height, center=(paper.width / 2, paper.height / 2))


def _shape(space: Any, item: Inked, covers: list[Inked]) -> None:
    if item.fill == "ink":
        hatch = space.add_hatch(color=7, dxfattribs={"layer": item.style})
        if isinstance(item, Line):
            hatch.paths.add_polyline_path(item.points.tolist(), is_closed=True)
            return
        if isinstance(item, Outline):
            for corners, bulges in item.loops:
                hatch.paths.add_polyline_path(np.column_stack([corners, bulges]).tolist(), is_closed=True)
            return
        hatch.paths.add_edge_path().add_arc(tuple(item.at), radius=item.radius, start_angle=0, end_angle=360)
    low, high = item.cloud.min(axis=0), item.cloud.max(axis=0)
    near = [each for each in covers if _touches(each, low, high)]
    visible_parts = map(Line, visible(item.outline, near)) if near else (item,)
    for each in visible_parts:
        add(space, each, item.style)


def _touches(cover: Inked, low: Floats, high: Floats) -> bool:
    cloud = cover.cloud
    return bool((cloud.min(axis=0) <= high).all() and (cloud.max(axis=0) >= low).all())


def visible(outline: Floats, covers: Iterable[Inked]) -> Iterator[Floats]:
    """The pieces (k, 2) of a polyline that lie outside of circles and convex polygons."""
    shapes = list(covers)
    piece: list[Floats] = []
    for start, end in pairwise(outline):
        for first, last in _outside(start, end, shapes):
            a, b = start + first * (end - start), start + last * (end - start)
            if piece and np.allclose(piece[-1], a, atol=1e-9):
                piece.append(b)
                continue
            if piece:
                yield np.array(piece)
            piece = [a, b]
    if piece:
        yield np.array(piece)


def _outside(start: Floats, end: Floats, shapes: list[Inked]) -> list[tuple[float, float]]:
    """The shares of the way from start to end that no shape covers."""
    free = [(0.0, 1.0)]
    for shape in shapes:
        inside = _in_circle(start, end, shape) if isinstance(shape, Circle) else _in_polygon(start, end, shape.points)
        if inside is None:
            continue
        low, high = inside
        parts = [((a, min(b, low)), (max(a, high), b)) for a, b in free]
        free = [part for pair in parts for part in pair if part[1] - part[0] > 1e-6]
    return free


def _in_circle(start: Floats, end: Floats, circle: Circle) -> tuple[float, float] | None:
    way, off = end - start, start - circle.at
    a, b, c = float(way @ way), 2 * float(way @ off), float(off @ off) - (circle.radius - 1e-6) ** 2
    root = b * b - 4 * a * c
    if a == 0.0 or root <= 0.0:
        return None
    first, last = (-b - root**0.5) / (2 * a), (-b + root**0.5) / (2 * a)
    return (max(first, 0.0), min(last, 1.0)) if first < 1.0 and last > 0.0 else None


def _in_polygon(start: Floats, end: Floats, corners: Floats) -> tuple[float, float] | None:
    """The stretch within a polygon, by clipping at the sides of its convex hull (Cyrus and Beck)."""
    nexts = np.roll(corners, -1, axis=0)
    area = float(np.sum(corners[:, 0] * nexts[:, 1] - corners[:, 1] * nexts[:, 0]))
    first, last = 0.0, 1.0
    for corner, other in zip(corners, nexts, strict=True):
        side = (other - corner) * (1.0 if area > 0 else -1.0)
        inward = np.array([-side[1], side[0]])
        begin, rate = float(inward @ (start - corner)) - 1e-6, float(inward @ (end - start))
        if abs(rate) < 1e-12:
            if begin < 0:
                return None
            continue
        share = -begin / rate
        first, last = (max(first, share), last) if rate > 0 else (first, min(last, share))
    return (first, last) if last - first > 1e-6 else None
