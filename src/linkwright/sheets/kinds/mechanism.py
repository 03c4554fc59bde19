"""The sheet of a mechanism: positions, polygons, diagrams over the cycle and tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.core.quantity import significant
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinetostatics.forces import Forces, link_numbers, reaction_index, reaction_pairs
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.picture import Runs, Words, as_runs, indexed, joined
from linkwright.pictures.svg import split_index
from linkwright.plotting.diagrams.axes import SYMBOLS, InputAxis
from linkwright.plotting.diagrams.base import Request
from linkwright.plotting.diagrams.forces import Torque
from linkwright.plotting.diagrams.motion import Sva
from linkwright.plotting.diagrams.pages import link_forces, worth_drawing
from linkwright.plotting.diagrams.panels import Panel as Plotted
from linkwright.plotting.diagrams.source import PlotInput, main_output
from linkwright.sheets.diagrams import AccelerationPanel, CurvePanel, ForcePanel, VelocityPanel
from linkwright.sheets.layers import layer_panels
from linkwright.sheets.layout import Panel, TablePanel
from linkwright.sheets.machine import MachinePanel, Positions
from linkwright.sheets.settings import SHEETS, Content, Subject
from linkwright.words import _

#: Names of the diagrams of an output, with their ranks: where it is, its velocity, its acceleration.
_MOTION = (
    ("displacement", 3.0, _("Motion of {output}")),
    ("velocity", 3.5, _("Velocity of {output}")),
    ("acceleration", 4.0, _("Acceleration of {output}")),
)


@SHEETS.register("mechanism")
def mechanism(subject: Subject) -> Content:
    """Mechanism, polygons of the positions, force polygons, diagrams, tables; what a machine does not have is left
    out."""
    if not isinstance(subject.drawn, Mechanism):
        raise RequestError(
            _(
                "a sheet of the kind mechanism needs a mechanism; this file holds a calculation",
                code="sheet.no_mechanism",
            )
        )
    positions = Positions(subject)
    if not positions.shown:
        raise LinkwrightError(
            _(
                "{name}: none of the positions of the sheet is reached; choose others with `sheet: positions`",
                code="sheet.nothing_reached",
                name=subject.drawn.name,
            )
        )
    machine = MachinePanel("mechanism", positions)
    panels: list[Panel] = [machine]
    if subject.drawn.drivers:
        panels += _motion_polygons(positions)
    forces = positions.forces
    if forces is not None:
        panels += _force_polygons(positions, forces)
    panels += _curves(positions)
    panels += layer_panels(subject)
    panels += [data_table(positions), *motion_table(positions), *force_table(positions)]
    return Content(panels)


def _motion_polygons(positions: Positions) -> Iterator[Panel]:
    """Velocity and acceleration polygon of each position; left out where all is at rest."""
    for shown in positions.shown:
        later, number = (5.0, 2) if shown.number == "II" else (0.0, 1)
        for kind, name, rank in ((VelocityPanel, "velocity", 1.0), (AccelerationPanel, "acceleration", 1.5)):
            with suppress(LinkwrightError):
                yield kind(f"{name}_{number}", rank + later, positions, shown)


def _force_polygons(positions: Positions, forces: Forces) -> Iterator[Panel]:
    """The force polygons of the links in the order of statics, for each position."""
    for shown in positions.shown:
        rank = 5.0 if shown.number == "I" else 8.0
        found = link_forces(forces, shown.index)
        for link, acting in worth_drawing(found).items():
            if len(acting) > 2 or not positions.mechanism.drivers:
                yield ForcePanel(f"force_{len(shown.number)}_{link}", rank, positions, shown, link, acting)


def _curves(positions: Positions) -> Iterator[Panel]:
    """Displacement, velocity and acceleration of the main output, and the driving torque or force, over the cycle."""
    if not positions.mechanism.drivers or positions.case.motion.steps < 3:
        return
    subject = positions.subject
    request = Request("sva", language=subject.language)
    source = PlotInput(positions.case.motion)
    try:
        name = _moving(positions.mechanism, main_output(source.motion))
        for (word, rank, title), plotted in zip(_MOTION, Sva().panels(source, request), strict=False):
            yield _curve(word, rank, subject.words(title.format(output=name)), source.axis, plotted)
    except LinkwrightError as error:
        subject.note(_("No diagrams on the sheet: {sentence}", sentence=error.sentence))
    if positions.forces is None:
        return
    efforts = Torque().panels(PlotInput(positions.case.forces), request)
    for number, plotted in enumerate(efforts, 1):
        title = _("Driving torque") if plotted.dimension == "torque" else _("Driving force")
        key = "balance" if len(efforts) == 1 else f"balance_{number}"
        yield _curve(key, 4.5, subject.words(title), source.axis, plotted)


def _moving(mechanism: Mechanism, output: Output) -> str:
    """What an output is of: the block of a guide, a link, a point."""
    guide = mechanism.guides.get(output.owner)
    return output.owner if guide is None else guide.block


def _curve(name: str, rank: float, caption: str, axis: InputAxis, plotted: Plotted) -> CurvePanel:
    """The curves of a diagram's panel on the sheet."""
    symbols = {"torque": indexed("M", "b"), "force": indexed("F", "b")}
    symbol = symbols.get(plotted.dimension, as_runs(plotted.title.rpartition(" ")[2]))
    return CurvePanel(name, rank, caption, (as_runs(SYMBOLS[axis.dimension]), symbol), axis, plotted)


def data_table(positions: Positions) -> TablePanel:
    """The links with their numbers, distances of their points in mm, masses and inertias."""
    mechanism, words = positions.mechanism, positions.subject.words
    heavy = any(link.mass or link.inertia for link in mechanism.links.values())
    head: list[Words] = [words(_("No.")), words(_("Link")), words(_("Distances/mm"))]
    head += [joined(_italic("m"), "/kg"), joined(_italic("J"), "/(kg·m²)")] if heavy else []
    rows: list[list[Words]] = []
    for name, number in link_numbers(mechanism).items():
        link = mechanism.link(name)
        mass = [_number(link.mass), _number(link.inertia)] if heavy and name != "frame" else ["–", "–"]
        for k, text in enumerate(_lengths(link.points)):
            first = [str(number), name if name != "frame" else words(_("frame"))] if k == 0 else ["", ""]
            rows.append([*first, text, *((mass if k == 0 else ["", ""]) if heavy else [])])
    return TablePanel("table_data", 2.5, head, rows, words(_("Data of the links")))


def _italic(letter: str) -> Runs:
    return as_runs(letter)


def _number(value: float) -> str:
    return significant(value) if value else "–"


def _lengths(points: Mapping[str, tuple[float, float]]) -> Iterator[Runs]:
    """Distances of a link's other points from its first one, two on a line; a dash where there are none."""
    places = list(points.items())
    found: list[Runs] = []
    for name, at in places[1:]:
        length = 1e3 * math.dist(places[0][1], at)
        pair = joined(_point(places[0][0]), _point(name))
        found.append(joined(pair, f" {significant(length)}"))
    if not found:
        yield as_runs("–")
    for k in range(0, len(found), 2):
        yield joined(found[k], *(("; ", found[k + 1]) if k + 1 < len(found) else ()))


def _point(name: str) -> Runs:
    stem, index = split_index(name)
    return as_runs(((stem, 0), (index, -1)))


def motion_table(positions: Positions) -> Iterator[TablePanel]:
    """Velocities and accelerations of points and links at the positions."""
    if not positions.mechanism.drivers:
        return
    words, motion = positions.subject.words, positions.motion
    numbers = link_numbers(positions.mechanism)
    rows: list[list[Words]] = []
    tabulated: list[Floats] = []
    for key in motion.point_names():
        point = motion.point_of(key)
        track = np.hstack([point.position, point.velocity])
        same = any(np.allclose(track, other, atol=1e-9, equal_nan=True) for other in tabulated)
        if same or not float(np.nanmax(np.abs(point.velocity), initial=0.0)) > 1e-9:
            continue
        tabulated.append(track)
        name = key.rpartition(".")[2] if key.count(".") == 1 else key
        rows.append(_row(indexed("v", name), "m/s", np.hypot(*point.velocity.T), positions))
        rows.append(_row(indexed("a", name), "m/s²", np.hypot(*point.acceleration.T), positions))
    for link, number in numbers.items():
        if link == "frame":
            continue
        state = motion.link(link)
        if float(np.nanmax(np.abs(state.angular_velocity), initial=0.0)) > 1e-9:
            rows.append(_row(indexed("ω", str(number)), "rad/s", state.angular_velocity, positions))
            rows.append(_row(indexed("α", str(number)), "rad/s²", state.angular_acceleration, positions))
    if rows:
        yield TablePanel("table_motion", 7.0, _head(positions), rows, words(_("Velocities and accelerations")))


def force_table(positions: Positions) -> Iterator[TablePanel]:
    """Joint forces with their directions and what the drivers supply at the positions."""
    forces = positions.forces
    if forces is None:
        return
    words, mechanism = positions.subject.words, positions.mechanism
    rows: list[list[Words]] = []
    for joint, link in reaction_pairs(mechanism):
        force = forces.reaction(joint, on=link)
        symbol = indexed("F", reaction_index(mechanism, joint, link))
        size = np.hypot(*force.T)
        cells: list[Words] = [
            f"{significant(float(size[each.index]))} ∠ {_direction(force[each.index]):.1f}°"
            if size[each.index] > 1e-9
            else "0"
            for each in positions.shown
        ]
        rows.append([symbol, "N", *cells])
    for name in mechanism.drivers:
        turning = mechanism.joints[mechanism.drivers[name].joint].coordinate == "turn"
        letter = indexed("M" if turning else "F", "b" if len(mechanism.drivers) == 1 else f"b,{name}")
        rows.append(_row(letter, "N·m" if turning else "N", forces.driver_effort(name), positions))
    if rows:
        yield TablePanel(
            "table_forces", 7.5, _head(positions), rows, words(_("Joint forces (size ∠ direction) and drive"))
        )


def _direction(force: Floats) -> float:
    """Direction of a force, degrees from the x axis, counter-clockwise."""
    return float(np.degrees(np.arctan2(force[1], force[0]))) % 360.0


def _head(positions: Positions) -> list[Words]:
    words = positions.subject.words
    places = [
        joined(each.number, f" ({positions.place(each)})") if positions.place(each) else each.number
        for each in positions.shown
    ]
    return [words(_("Quantity")), words(_("Unit")), *places]


def _row(symbol: Runs, unit: str, values: Floats, positions: Positions) -> list[Words]:
    return [symbol, unit, *(significant(float(values[each.index])) for each in positions.shown)]
