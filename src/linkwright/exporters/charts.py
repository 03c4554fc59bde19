"""Native charts of a workbook: motion of the outputs, joint forces, driving effort over the input, a hodograph."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats, largest
from linkwright.core.table import Column
from linkwright.exporters.results import QUANTITIES, Results
from linkwright.kinetostatics.forces import reaction_pairs
from linkwright.pictures.diagram import COLOURS
from linkwright.pictures.picture import round_up
from linkwright.plotting.diagrams.base import title_of
from linkwright.plotting.diagrams.source import joint_and_link, loaded, main_outputs
from linkwright.words import Message, _
from linkwright.words.characters import printable

#: Pixels of a chart over the input and of a square one, and between them.
WIDE, TALL, SQUARE, GAP = 560, 320, 460, 16
#: Curves of one chart, at most.
MOST = 12
#: Angles between labels over a turn, degrees.
_TURN_STEPS = (15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0)
#: Titles of vectors with two components.
VECTORS = {"position": _("position"), "velocity": _("velocity"), "acceleration": _("acceleration")}


@dataclass(frozen=True)
class Place:
    """Place of a column: its sheet, the number of the column, and the column itself as written."""

    sheet: str
    index: int
    column: Column


#: Places of columns by subject, owner and quantity.
Places = Mapping[tuple[str, str, str], Place]


@dataclass(frozen=True)
class Curve:
    """A column over another one, under a name."""

    name: str
    x: Place
    y: Place


@dataclass(frozen=True)
class Chart:
    """Curves of one dimension with the titles of chart and axes; ``square``: both axes to one scale."""

    title: str
    x_title: str
    y_title: str
    curves: tuple[Curve, ...]
    square: bool = False


class Charts:
    """The charts of one result, of the columns that stand at ``places``."""

    def __init__(self, results: Results, places: Places) -> None:
        self.results, self.places = results, places
        self.mechanism, self.language = results.mechanism, results.language

    def all(self) -> list[list[Chart]]:
        """Rows of charts; empty where nothing moves or fewer than two positions were reached."""
        if not self.mechanism.drivers or self.results.motion.ok.sum() < 2:
            return []
        rows = [*self._motion(), self._reactions(), [*self._efforts(), *self._hodograph()]]
        return [row for row in rows if row]

    def translate(self, message: Message) -> str:
        """A message in the language of the results."""
        return message.translate(self.language)

    @property
    def _input(self) -> Place:
        """The column that curves are drawn over: the first driver's input, or the time."""
        if not self.mechanism.steady:
            return self.places["positions", "", "time"]
        return self.places["positions", next(iter(self.mechanism.drivers)), ""]

    @property
    def _input_title(self) -> str:
        place = self._input
        word = self.translate(_("time")) if place.column.quantity else place.column.owner
        return f"{word} [{place.column.unit}]"

    def _motion(self) -> Iterator[list[Chart]]:
        """A row of displacement, velocity and acceleration for every main output."""
        for output in main_outputs(self.results.motion)[:4]:
            subject = {"angle": "links", "position": "points"}.get(output.kind, "joints")
            axes = "xy" if output.is_point else ("",)
            kinds = [[replace(each, component=axis).quantity for axis in axes] for each in output.course]
            yield [
                chart
                for each in kinds
                if (chart := self._of_kind(subject, output.owner, each, str(output))) is not None
            ]

    def _of_kind(self, subject: str, owner: str, quantities: Sequence[str], name: str) -> Chart | None:
        found = [self.places.get((subject, owner, quantity)) for quantity in quantities]
        places = [each for each in found if each is not None]
        if not places:
            return None
        words = [self.translate(QUANTITIES[each.column.quantity]) for each in places]
        curves = tuple(Curve(word, self._input, each) for word, each in zip(words, places, strict=True))
        word = words[0] if len(words) == 1 else self.translate(VECTORS[quantities[0].partition(".")[0]])
        return Chart(f"{name}: {word}", self._input_title, f"{word} [{places[0].column.unit}]", curves)

    def _reactions(self) -> list[Chart]:
        """Sizes of all joint forces, as many in a chart as can be distinguished."""
        forces = self.results.forces
        if forces is None or not loaded(forces):
            return []
        word, curves = self.translate(_("joint forces")), []
        for joint, link in reaction_pairs(self.mechanism):
            if largest(forces.reaction(joint, on=link)) > forces.rounding:
                name = f"{joint} on {link}"
                curves.append(Curve(name, self._input, self.places["forces", name, "magnitude"]))
        parts = [tuple(curves[k : k + MOST]) for k in range(0, len(curves), MOST)]
        axis = f"{self.translate(QUANTITIES['magnitude'])} [N]"
        return [Chart(word, self._input_title, axis, part) for part in parts]

    def _efforts(self) -> Iterator[Chart]:
        """What the drivers supply: torques and forces separately."""
        by_unit: dict[str, list[Curve]] = {}
        for name in self.mechanism.drivers:
            place = self.places.get(("forces", name, "effort"))
            if place is not None:
                by_unit.setdefault(place.column.unit, []).append(Curve(name, self._input, place))
        for unit, curves in by_unit.items():
            word = self.translate(_("what the driver must supply"))
            axis = f"{self.translate(QUANTITIES['effort'])} [{unit}]"
            yield Chart(word, self._input_title, axis, tuple(curves[:MOST]))

    def _hodograph(self) -> Iterator[Chart]:
        """The force of the joint on the frame that carries most, its end over the cycle."""
        forces = self.results.forces
        if forces is None or not loaded(forces):
            return
        joint, link = joint_and_link(forces, None, None)
        name = f"{joint} on {link}"
        if ("forces", name, "x") not in self.places:
            return
        x, y = (self.places["forces", name, axis] for axis in "xy")
        right, up = (f"{self.translate(QUANTITIES[axis])} [N]" for axis in "xy")
        yield Chart(f"{self.translate(title_of('hodograph'))}, {name}", right, up, (Curve(name, x, y),), square=True)


def write_charts(sheet: Any, book: Any, rows: Sequence[Sequence[Chart]]) -> None:
    """Puts rows of charts on a sheet of a workbook."""
    top = GAP
    for row in rows:
        left, tall = GAP, 0
        for chart in row:
            width, height = (SQUARE, SQUARE) if chart.square else (WIDE, TALL)
            sheet.insert_chart(0, 0, _drawn(book, chart), {"x_offset": left, "y_offset": top, "object_position": 3})
            left, tall = left + width + GAP, max(tall, height)
        top += tall + GAP


def _drawn(book: Any, chart: Chart) -> Any:
    """The chart, with lines where its positions follow each other, else with marks alone."""
    along = all(_follows(curve.x.column.values) for curve in chart.curves) or chart.square
    drawn = book.add_chart({"type": "scatter", "subtype": "straight"} if along else {"type": "scatter"})
    for number, curve in enumerate(chart.curves):
        colour = COLOURS[number % len(COLOURS)]
        dash = ("solid", "dash", "round_dot")[number // len(COLOURS) % 3]
        look: dict[str, Any] = {"line": {"color": colour, "width": 1.5, "dash_type": dash}}
        if not along:
            fill = {"color": colour}
            look = {"line": {"none": True}, "marker": {"type": "circle", "size": 5, "fill": fill, "border": fill}}
        drawn.add_series(
            {"name": printable(curve.name), "categories": _cells(curve.x), "values": _cells(curve.y), **look}
        )
    drawn.set_title({"name": printable(chart.title), "overlay": False, "name_font": {"size": 12}})
    x, y = _scales(chart)
    grid = {"visible": True, "line": {"color": "#E3E6EA", "width": 0.75}}
    font = {"name_font": {"bold": False, "size": 10}}
    drawn.set_x_axis(
        {"name": printable(chart.x_title), "label_position": "low", "major_gridlines": grid, **font, **x}
    )
    drawn.set_y_axis(
        {"name": printable(chart.y_title), "label_position": "low", "major_gridlines": grid, **font, **y}
    )
    drawn.set_legend({"position": "bottom"} if len(chart.curves) > 1 else {"none": True})
    drawn.set_size({"width": SQUARE if chart.square else WIDE, "height": SQUARE if chart.square else TALL})
    drawn.show_blanks_as("gap")
    return drawn


def _cells(place: Place) -> list[str | int]:
    """The cells of a column beneath its heading."""
    return [place.sheet, 1, place.index, len(place.column.values), place.index]


def _follows(values: Floats) -> bool:
    """Whether positions go one way."""
    steps = np.diff(values)
    return not ((steps > 0.0).any() and (steps < 0.0).any())


def _scales(chart: Chart) -> tuple[dict[str, Any], dict[str, Any]]:
    """Limits of the axes: the full input from left to right in the order of time; a hodograph to one scale."""
    x = _known([curve.x.column.values for curve in chart.curves])
    y = _known([curve.y.column.values for curve in chart.curves])
    if chart.square:
        span = max(float(np.ptp(np.append(x, 0.0))), float(np.ptp(np.append(y, 0.0))), 1e-9)
        step = round_up(span / 4.0)
        return tuple(_square(each, step, span) for each in (x, y))  # type: ignore[return-value]
    low, high = float(x.min()), float(x.max())
    if not high > low:
        return {}, {}
    step = round_up((high - low) / 8.0)
    if chart.curves[0].x.column.unit == "°":
        step = next((each for each in _TURN_STEPS if (high - low) / each <= 12.0), step)
    ends = {"min": math.floor(low / step + 1e-9) * step, "max": math.ceil(high / step - 1e-9) * step}
    found: dict[str, Any] = {**ends, "major_unit": step}
    values = chart.curves[0].x.column.values
    reverse = bool(values[-1] < values[0]) and _follows(values)
    found |= {"reverse": True, "crossing": "max"} if reverse else {"crossing": "min"}
    return found, {"crossing": "min"}


def _square(values: Floats, step: float, span: float) -> dict[str, Any]:
    """An axis of a hodograph, zero on it, as many steps long as the other one."""
    count = math.ceil(span / step) + 1
    low = math.floor(min(float(values.min()), 0.0) / step) * step
    return {"min": low, "max": low + count * step, "major_unit": step, "crossing": 0.0}


def _known(rows: Sequence[Floats]) -> Floats:
    values = np.concatenate(rows)
    return values[np.isfinite(values)]
