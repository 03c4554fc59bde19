"""What a DXF drawing holds, flat: lines, circles, arcs, points and texts with their layers, in drawing units."""

from __future__ import annotations

import io
import logging
import math
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from linkwright.exporters.export import package
from linkwright.importers.layout import Remarks
from linkwright.mechanism.link import Vec
from linkwright.words import _

Kind = Literal["line", "circle", "arc", "point", "text"]
#: Units by the number of ``$INSUNITS``.
UNITS_BY_NUMBER = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 14: "dm"}
#: Depth of blocks within blocks.
DEPTH = 20


@dataclass(frozen=True)
class Entity:
    """A line or polyline by its vertices, a circle or an arc by its centre, a point, or a text at its place."""

    kind: Kind
    layer: str
    places: tuple[Vec, ...]
    key: str
    radius: float = 0.0
    text: str = ""
    closed: bool = False


@dataclass(frozen=True)
class DrawingFile:
    """Entities, the unit that the file states (None: none), and colours of layers as #rrggbb ("": the usual one)."""

    entities: tuple[Entity, ...]
    unit: str | None
    colours: dict[str, str] = field(default_factory=dict)


def read_entities(content: bytes, remarks: Remarks) -> DrawingFile | None:
    """The entities of the model space; None, with an error among the remarks, for what is no DXF file.

    Raises LinkwrightError where ezdxf is missing.
    """
    document = open_document(content, remarks)
    if document is None:
        return None
    from ezdxf import colors

    colours = {}
    for layer in document.layers:
        known = layer.rgb or (colors.aci2rgb(layer.color) if 0 < layer.color < 256 and layer.color != 7 else None)
        colours[layer.dxf.name] = "#" + bytes(known).hex() if known else ""
    entities = tuple(_flat(document.modelspace(), remarks, 0))
    return DrawingFile(entities, UNITS_BY_NUMBER.get(document.units), colours)


def open_document(content: bytes, remarks: Remarks) -> Any | None:
    """The document of a file; None, with an error among the remarks, for what is no DXF file.

    Raises LinkwrightError where ezdxf is missing.
    """
    package("ezdxf", _("DXF drawings"))
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # what it cannot copy is none of the reader's matter
    from ezdxf.lldxf.const import DXFError

    try:
        return _document(content)
    except (DXFError, OSError, ValueError, LookupError) as error:
        message = _("this is no DXF drawing that can be read ({reason})", reason=error)
        remarks.remark("error", message, _("save it again as DXF, of any release"), "import.dxf.unreadable")
        return None


def _document(content: bytes) -> Any:
    """The document of a file; a binary one is read by way of the disk, as its reader wants."""
    from ezdxf import recover
    from ezdxf.filemanagement import readfile

    if not content.startswith(b"AutoCAD Binary DXF"):
        return recover.read(io.BytesIO(content))[0]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "drawing.dxf")
        path.write_bytes(content)
        return readfile(path)


def _flat(space: Any, remarks: Remarks, depth: int, inserted_on: str = "0") -> Iterator[Entity]:
    """Entities, those of blocks where they are inserted; a remark about each kind that says nothing here.

    What lies on layer 0 of a block takes the layer on which the block is inserted.
    """
    unread: dict[str, list[str]] = {}
    for each in space:
        kind, layer = each.dxftype(), each.dxf.get("layer", "0")
        layer = inserted_on if layer == "0" else layer
        key = f"{kind} #{each.dxf.get('handle') or '?'}, {layer}"
        if kind == "INSERT" and depth < DEPTH:
            sizes = {abs(each.dxf.get(f"{axis}scale", 1.0)) for axis in "xy"}
            if max(sizes) - min(sizes) > 1e-9 * max(sizes):
                message = _("the block {name} is inserted with different scales in x and y", name=each.dxf.name)
                remedy = _("its circles are read by their centres only")
                remarks.remark("warning", message, remedy, "import.dxf.scaled", key=key)
            yield from _flat(each.virtual_entities(), remarks, depth + 1, layer)
            continue
        found = _entity(each, kind, layer, key)
        if found is None:
            unread.setdefault(kind, []).append(layer)
        else:
            yield found
    for kind, layers in unread.items():
        message = _("{count} entities {kind} are not read", count=len(layers), kind=kind)
        remedy = _("draw lines, polylines, circles, points and texts; dimensions and hatches say nothing here")
        remarks.remark("note", message, remedy, "import.dxf.kind", key=", ".join(sorted(set(layers))))


def _entity(each: Any, kind: str, layer: str, key: str) -> Entity | None:
    """An entity in coordinates of the drawing; None for a kind that has no meaning here."""
    if kind == "LINE":
        return Entity("line", layer, (_place(each.dxf.start), _place(each.dxf.end)), key)
    if kind == "LWPOLYLINE":
        places = tuple(_place(each) for each in each.vertices_in_wcs())
        return Entity("line", layer, places, key, closed=bool(each.closed))
    if kind == "POLYLINE" and each.is_2d_polyline:
        places = tuple(_place(each.ocs().to_wcs(vertex.dxf.location)) for vertex in each.vertices)
        return Entity("line", layer, places, key, closed=bool(each.is_closed))
    if kind in ("CIRCLE", "ARC"):
        centre = _place(each.ocs().to_wcs(each.dxf.center))
        return Entity("circle" if kind == "CIRCLE" else "arc", layer, (centre,), key, radius=float(each.dxf.radius))
    if kind == "ELLIPSE" and math.isclose(each.dxf.ratio, 1.0):
        return Entity("circle", layer, (_place(each.dxf.center),), key, radius=float(each.dxf.major_axis.magnitude))
    if kind == "POINT":
        return Entity("point", layer, (_place(each.dxf.location),), key)
    if kind == "TEXT":
        return Entity("text", layer, (_place(each.ocs().to_wcs(each.dxf.insert)),), key, text=each.plain_text())
    if kind == "MTEXT":
        return Entity("text", layer, (_place(each.dxf.insert),), key, text=each.plain_text())
    return None


def _place(vector: Any) -> Vec:
    return float(vector.x), float(vector.y)


def scaled(each: Entity, factor: float) -> Entity:
    """An entity in other units."""
    places = tuple((x * factor, y * factor) for x, y in each.places)
    return replace(each, places=places, radius=each.radius * factor)


def extent(entities: Sequence[Entity]) -> float:
    """Diagonal of what is drawn, without texts."""
    places = [place for each in entities if each.kind != "text" for place in each.places] or [(0.0, 0.0)]
    xs, ys = zip(*places, strict=True)
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys)) or 1.0


def away_from(place: Vec, start: Vec, end: Vec) -> float:
    """Distance of a place from the line through two points."""
    length = math.dist(start, end) or 1.0
    return abs((end[0] - start[0]) * (place[1] - start[1]) - (end[1] - start[1]) * (place[0] - start[0])) / length


def crossing(one: Entity, other: Entity) -> bool:
    """Whether two straight lines cross within both, away from their ends."""
    if len(one.places) != 2 or len(other.places) != 2:
        return False
    (x0, y0), (x1, y1) = one.places
    (x2, y2), (x3, y3) = other.places
    dx, dy, ex, ey = x1 - x0, y1 - y0, x3 - x2, y3 - y2
    cross = dx * ey - dy * ex
    if abs(cross) < 1e-12 * math.hypot(dx, dy) * math.hypot(ex, ey):
        return False
    s = ((x2 - x0) * ey - (y2 - y0) * ex) / cross
    t = ((x2 - x0) * dy - (y2 - y0) * dx) / cross
    return 0.001 < s < 0.999 and 0.001 < t < 0.999
