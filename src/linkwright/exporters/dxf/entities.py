"""Documents of DXF, and what pictures consist of as their entities: lines, circles, texts with indices."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from typing import Any

from linkwright.exporters.export import package
from linkwright.pictures.fonts import needs_chinese
from linkwright.pictures.picture import CAPITAL, Circle, Item, Text
from linkwright.words import _
from linkwright.words.characters import one_line

STYLE = "LINKWRIGHT"
_ANCHORS = {"start": 0, "middle": 1, "end": 2}


def new_document(layers: Mapping[str, int], words: str = "", unit: int = 4) -> Any:
    """An empty document with layers of these colours (AutoCAD colour indices), and a text style for these words.

    ``unit``: DXF's number, millimetres unless given. Raises LinkwrightError where ezdxf is missing.
    """
    document = package("ezdxf", _("DXF drawings")).new("R2010", setup=["linetypes"])
    document.units = unit
    for name, colour in layers.items():
        document.layers.add(name, color=colour)
    document.styles.add(STYLE, font="simsun.ttc" if needs_chinese(words) else "arial.ttf")
    return document


def content_of(document: Any) -> bytes:
    """The file of a document."""
    stream = io.StringIO()
    document.write(stream)
    return bytes(document.encode(stream.getvalue()))


def add(space: Any, item: Item, layer: str, **attributes: str) -> None:
    """An item of a picture as a line, a polyline, a circle or a text on a layer."""
    dxf_attributes = {"layer": layer, **attributes}
    if isinstance(item, Text):
        _text(space, item, layer)
    elif isinstance(item, Circle):
        space.add_circle(tuple(item.at), item.radius, dxfattribs=dxf_attributes)
    elif len(item.points) == 2 and not item.closed:
        space.add_line(*item.points.tolist(), dxfattribs=dxf_attributes)
    elif len(item.points) > 1:
        space.add_lwpolyline(item.points.tolist(), close=item.closed, dxfattribs=dxf_attributes)


def _text(space: Any, item: Text, layer: str) -> None:
    """A line of text; with indices as multi-line text, where they are stacked."""
    height = item.size * CAPITAL
    attributes: dict[str, Any] = {"layer": layer, "style": STYLE, "rotation": item.turn}
    if all(level == 0 for _, level in item.runs):
        plain = one_line("".join(text for text, _ in item.runs)).replace("%%", "%%%%%%")
        attributes |= {"height": height, "width": item.squeeze, "oblique": 15.0 if item.symbol else 0.0}
        entity = space.add_text(plain, dxfattribs=attributes)
        from ezdxf.enums import TextEntityAlignment

        place = (TextEntityAlignment.LEFT, TextEntityAlignment.CENTER, TextEntityAlignment.RIGHT)
        entity.set_placement(tuple(item.at), align=place[_ANCHORS[item.anchor]])
        return
    attributes |= {
        "char_height": height,
        "attachment_point": 7 + _ANCHORS[item.anchor],
        "insert": tuple(item.at),
        "width": 2.0 * item.width,
    }
    space.add_mtext("".join(_stacked(item)), dxfattribs=attributes)


def _stacked(item: Text) -> Iterator[str]:
    """The parts of a text in the language of MTEXT."""
    if item.symbol:
        yield "{\\Q15;"
    waiting = ""
    for text, level in item.runs:
        plain = one_line(text).translate({ord(c): f"\\{c}" for c in "\\{};^#/"})
        if level > 0:
            waiting = plain
            continue
        if level < 0:
            yield f"{{\\H0.7x;\\S{waiting or ' '}^{plain};}}"
            waiting = ""
            continue
        if waiting:
            yield f"{{\\H0.7x;\\S{waiting}^ ;}}"
            waiting = ""
        yield plain
    if waiting:
        yield f"{{\\H0.7x;\\S{waiting}^ ;}}"
    if item.symbol:
        yield "}"
