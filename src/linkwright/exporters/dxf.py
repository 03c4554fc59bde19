"""DXF: documents and entities of pictures, and the sheet of a mechanism at one position, to true scale, in layers."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.exporters.export import package
from linkwright.exporters.results import Results
from linkwright.fields.colour import as_rgb
from linkwright.pictures.fonts import needs_chinese
from linkwright.pictures.labels import Candidate, Label, Obstacles, place, text_of
from linkwright.pictures.picture import CAPITAL, Circle, Inked, Item, Line, Outline, Text, Vec, unbroken
from linkwright.pictures.symbols.base import PIN, points
from linkwright.plotting.drawing.dimensions import Dimensioned, dimension_lines
from linkwright.plotting.drawing.scene import body_labels, laid_out, point_labels
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


def add(space: Any, item: Item, layer: str, **attributes: str | int) -> None:
    """An item of a picture as a line, a polyline, a circle or a text on a layer."""
    dxf_attributes = {"layer": layer, **attributes}
    if isinstance(item, Text):
        _text(space, item, layer)
    elif isinstance(item, Circle):
        space.add_circle(tuple(item.at), item.radius, dxfattribs=dxf_attributes)
    elif isinstance(item, Outline):
        for corners, bulges in item.loops:
            rows = np.column_stack([corners, bulges]).tolist()
            space.add_lwpolyline(rows, format="xyb", close=True, dxfattribs=dxf_attributes)
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


#: Layers with their colours (numbers of the AutoCAD colour index), each with a contrast of 3 or more on a white, a
#: dark grey and a black sheet; 7 is white or black, as the sheet demands.
LAYERS = {"frame": 8, "links": 150, "joints": 1, "paths": 92, "dimensions": 42, "text": 7}
#: Layer of each layer of the drawing on paper.
_OF_PART = {"ground": "frame", "bodies": "links", "blocks": "joints", "tops": "joints"}
#: The same of outlines, those of the frame in its own.
_OF_OUTLINE = {"ground": "links", "bodies": "links", "blocks": "links", "pins": "joints"}
#: Size of the numbers of dimensions on the paper.
VALUE_SIZE = 12.0


class Sheet:
    """The model space of a drawing; lengths in metres become units by ``factor``."""

    def __init__(self, document: Any, results: Results, index: int, factor: float, *, outlines: bool = False) -> None:
        self.space = document.modelspace()
        self.results, self.index, self.factor, self.outlines = results, index, factor, outlines
        self.scene = laid_out(results.motion, index, inputs=False, outlines=outlines)
        self.unit = factor / self.scene.machine.view.scale
        self.height = CAPITAL * VALUE_SIZE * self.unit
        self.ink: list[Floats] = []
        self.measures: list[Dimensioned] = []

    def machine(self) -> None:
        """Supports, links, blocks and pins."""
        if self.outlines:
            self._outlines()
            return
        for part in self.scene.parts:
            if part.layer == "bodies":  # exact lines
                colour = as_rgb(self.results.mechanism.link(part.carrier).colour)
                items: Iterable[Inked] = [Line(line, colour=colour) for line in part.shape.ink]
            elif part.layer in _OF_PART:
                items = part.shape.elements
            else:
                continue
            for item in items:
                self._item(item, part.carrier, _OF_PART[part.layer])
        self._pins()

    def _outlines(self) -> None:
        """The parts as they are made, with pitch circles, strands and crosses of pins."""
        for part in self.scene.parts:
            layer = "frame" if part.carrier == "frame" and part.layer == "ground" else _OF_OUTLINE[part.layer]
            for item in part.shape.elements:
                self._item(item, part.carrier, layer)

    def paths(self, names: Sequence[str] | None, *, spline: bool) -> None:
        """Paths of points, by default of all that move."""
        motion = self.results.motion
        for name in motion.point_names() if names is None else names:
            track = motion.point(name).position
            if names is None and not np.nanmax(np.ptp(track[motion.ok], axis=0), initial=0.0) > 0:
                continue
            self.ink.append(self.scene.trace(name))
            closed = motion.positions.closed and motion.complete
            for piece in unbroken(track):
                self._path(self.factor * piece, closed, spline)

    def dimensions(self) -> None:
        """What places the points of all links and of the frame: dimension lines, and arcs of angles."""
        ink = [*self.scene.ink(self.index), *self.ink]
        self.measures = dimension_lines(self.scene.machine, True, self.index, ink)
        self.ink += [line for each in self.measures for line in each.shape.ink]

    def labels(self, *, names: bool) -> None:
        """Values of the dimensions and names of points and links, clear of lines; the name of the mechanism below."""
        values = [self._value(each) for each in self.measures]
        wanted = [*point_labels(self.scene.machine, self.index), *body_labels(self.scene, self.index)]
        ink = [*self.scene.ink(self.index), *self.ink]
        places = place([*values, *(wanted if names else ())], Obstacles.of(ink))
        for measure, chosen in zip(self.measures, places, strict=False):
            (self._line if measure.line else self._arc)(measure, chosen)
        if not names:
            return
        for label, chosen in zip(wanted, places[len(values) :], strict=True):
            self._text(replace(text_of(label, chosen), runs=((label.text, 0),)))
        cloud = np.concatenate(ink)
        corner = (float(np.nanmin(cloud[:, 0])), float(np.nanmax(cloud[:, 1])) + 60.0)
        self._text(Text(corner, ((self.results.mechanism.name, 0),), "", 1.5 * VALUE_SIZE))

    def _value(self, measure: Dimensioned) -> Label:
        """The label of a dimension with the number that DXF shows, without a unit."""
        if measure.line is None:
            return measure.label
        length = math.dist(*measure.line) * self.unit
        return replace(measure.label, text=f"{length:.{decimals_for(self.factor)}f}".rstrip("0").rstrip("."))

    def _line(self, measure: Dimensioned, chosen: Candidate) -> None:
        """A length with its number at the chosen place, to be read from below or from the right."""
        assert measure.ends is not None and measure.line is not None
        (a, b), (base, end) = self._units(points(measure.ends)), self._units(points(measure.line))
        self.space.add_linear_dim(
            base=base,
            p1=a,
            p2=b,
            location=self._middle(chosen),
            angle=math.degrees(math.atan2(*(end - base)[::-1])),
            text_rotation=-chosen.turned,
            dimstyle=STYLE,
            dxfattribs={"layer": "dimensions"},
        ).render()

    def _arc(self, measure: Dimensioned, chosen: Candidate) -> None:
        """An angle with its number at the chosen place."""
        assert measure.arc is not None
        arc, ends = measure.arc, (measure.arc.first, measure.arc.first + measure.arc.sweep)
        first, last = sorted(-math.degrees(each) for each in ends)
        self.space.add_angular_dim_cra(
            center=self._units(points([arc.at]))[0],
            radius=0.3 * arc.radius * self.unit,
            start_angle=first,
            end_angle=last,
            distance=0.7 * arc.radius * self.unit,
            location=self._middle(chosen),
            text_rotation=0.0,
            dimstyle=STYLE,
            dxfattribs={"layer": "dimensions"},
        ).render()

    def _middle(self, chosen: Candidate) -> Floats:
        left, top, right, bottom = chosen.box
        return np.asarray(self._units(points([((left + right) / 2, (top + bottom) / 2)]))[0])

    def _text(self, text: Text) -> None:
        add(self.space, text.placed(np.zeros(2), scale=(self.unit, -self.unit)), "text")

    def _units(self, paper: Floats) -> Floats:
        """Points of the paper in units of the drawing."""
        scaled: Floats = paper * (self.unit, -self.unit)
        return scaled

    def _item(self, item: Inked, carrier: str, layer: str) -> None:
        machine = self.scene.machine
        x, y, turn = machine.view.transform(machine.placed[carrier], self.index)
        at = item.placed(np.array([x, y]), math.radians(turn)).placed(np.zeros(2), scale=(self.unit, -self.unit))
        colour = "" if isinstance(at, Circle) else at.colour
        add(self.space, at, layer, **({"true_color": int(colour[1:], 16)} if colour else {}))

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
                add(self.space, Circle(self._world(name, point), radius), "joints")

    def _world(self, link: str, point: str) -> Vec:
        local = self.results.mechanism.link(link).points[point]
        x, y = self.factor * self.scene.machine.placed[link].world(local)[self.index]
        return float(x), float(y)

    def _path(self, track: Floats, closed: bool, spline: bool) -> None:
        if spline and len(track) > 3:
            through = np.vstack([track, track[:1]]) if closed else track
            self.space.add_spline([(x, y, 0.0) for x, y in through.tolist()], dxfattribs={"layer": "paths"})
        else:
            add(self.space, Line(track, closed=closed), "paths")


def check_unit(unit: str) -> tuple[float, int]:
    """Units per metre, and DXF's number of the unit; raises LinkwrightError."""
    known = {"mm": (1000.0, 4), "m": (1.0, 6)}
    if unit not in known:
        raise RequestError(_('a drawing is in mm or m, not in "{unit}"', code="export.bad_unit", unit=unit))
    return known[unit]


def set_dimension_style(document: Any, height: float, decimals: int) -> None:
    """The style of dimensions."""
    style = document.dimstyles.new(STYLE)
    for key, value in {
        "dimtxt": height,
        "dimasz": 0.8 * height,
        "dimexo": 0.4 * height,
        "dimexe": 0.5 * height,
        "dimgap": 0.3 * height,
        "dimdec": decimals,
        "dimadec": 4,
        "dimzin": 8,
        "dimazin": 2,
        "dimdsep": ord("."),
        "dimtad": 1,
        "dimlfac": 1.0,
        "dimscale": 1.0,
        "dimtxsty": STYLE,
    }.items():
        style.set_dxf_attrib(key, value)


def decimals_for(factor: float) -> int:
    """Decimals of dimensions: to a thousandth of a millimetre."""
    return max(0, 6 - round(math.log10(factor)))
