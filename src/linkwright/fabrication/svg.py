"""Plates as SVG: millimetres, 1 : 1, outlines with true arcs, holes as circles, in groups named as DXF's layers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from linkwright.fabrication.cut_lines import CutLines, box_of
from linkwright.fabrication.engraving import CAPITAL, Engraving
from linkwright.pictures.svg import FAMILY_LIST, Element, element, group
from linkwright.shapes.loop import Edge, Loop

#: Colours by which cutters tell their steps apart, and the width of lines, mm.
COLOURS = {"engrave": "#0000ff", "holes": "#00a000", "cut": "#ff0000", "sheet": "#909090"}
LINE = "0.1"
#: Room around everything, mm.
MARGIN = 2.0
MM = 1e3


def svg_of(lines: Iterable[CutLines], title: str, sheet: Loop | None = None) -> bytes:
    """The file of some plates; ``sheet``: the edge of the sheet on which they lie. y points up in the machine and
    down in SVG."""
    found = list(lines)
    box = box_of([*(loop for each in found for loop in each.outer), *([] if sheet is None else [sheet])])
    left, right = MM * box[0].real - MARGIN, MM * box[1].real + MARGIN
    top, bottom = -MM * box[1].imag - MARGIN, -MM * box[0].imag + MARGIN
    groups = [
        _layer("engrave", (_text(name) for each in found for name in each.names)),
        _layer("holes", (node for each in found for node in _holes(each))),
        _layer("cut", (_path(loop) for each in found for loop in each.outer)),
    ]
    if sheet is not None:
        groups.insert(0, _layer("sheet", [_path(sheet)]))
    root = element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "width": f"{_number(right - left)}mm",
            "height": f"{_number(bottom - top)}mm",
            "viewBox": " ".join(map(_number, (left, top, right - left, bottom - top))),
        },
        element("title", None, title),
        *groups,
    )
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{root}\n'.encode()


def _layer(name: str, content: Iterable[Element]) -> Element:
    if name == "engrave":
        return group(content, id=name, fill=COLOURS[name], **{"font-family": FAMILY_LIST})
    return group(content, id=name, fill="none", stroke=COLOURS[name], **{"stroke-width": LINE})


def _holes(lines: CutLines) -> Iterator[Element]:
    for centre, radius in lines.holes:
        x, y = _place(centre)
        yield element("circle", {"cx": x, "cy": y, "r": _number(MM * radius)})
    yield from map(_path, lines.inner)


def _path(loop: Loop) -> Element:
    return element("path", {"d": path_of(loop)})


def path_of(loop: Loop) -> str:
    """The path data of an outline, mm, y downwards."""
    start = " ".join(_place(loop.edges[0].start))
    return f"M{start}{''.join(map(_edge, loop.edges))}Z"


def _edge(edge: Edge) -> str:
    """A line or an arc of at most a full turn; the two flags say whether it is longer than a half one, and clockwise
    as seen."""
    end = " ".join(_place(edge.end))
    if not edge.bulge:
        return f"L{end}"
    radius = _number(MM * edge.radius)
    return f"A{radius} {radius} 0 {int(abs(edge.bulge) > 1.0)} {int(edge.bulge < 0.0)} {end}"


def _text(text: Engraving) -> Element:
    x, y = _place(text.at)
    size = MM * text.height / CAPITAL
    attributes = {"x": x, "y": y, "dy": _number(0.5 * MM * text.height), "text-anchor": "middle"}
    turn = f"rotate({_number(-math.degrees(text.turn))} {x} {y})" if text.turn else None
    return element("text", {**attributes, "font-size": _number(size), "transform": turn}, text.text)


def _place(place: complex) -> tuple[str, str]:
    return _number(MM * place.real), _number(-MM * place.imag)


def _number(value: float) -> str:
    """A length in mm to a nanometre."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
