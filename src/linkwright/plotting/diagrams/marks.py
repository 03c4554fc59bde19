"""Marks on curves, and names in diagrams: limit positions, phases, extremes; labels where they overlap the least."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from linkwright.analysis.analysis import Kind
from linkwright.applied_loads.over_cycle import activity
from linkwright.applied_loads.phases import Always
from linkwright.core.arrays import Flags, Floats, largest, runs
from linkwright.core.outputs import Output
from linkwright.core.quantity import significant
from linkwright.core.search import first_largest
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import limit_positions
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.pictures.diagram import INK, Axes, Figure
from linkwright.pictures.labels import Label, Obstacles, place
from linkwright.pictures.picture import Circle, round_up
from linkwright.pictures.svg import split_index
from linkwright.pictures.symbols.base import SYMBOLS, vec
from linkwright.plotting.diagrams.axes import InputAxis, Unit
from linkwright.plotting.diagrams.source import Extremes, PlotInput
from linkwright.plotting.drawing.scene import laid_out, point_labels


@dataclass(frozen=True)
class Curve:
    """A curve: SI ``values`` (n,) over those of the axis, or over ``x``; colour and dash by its number unless given.

    ``peak``: what is marked on it: ``both`` extremes, ``max``, ``largest`` by size, or nothing where empty;
    ``extremes``: what they are between the positions, where that is known. ``marks``: places and values instead.
    """

    label: str
    values: Floats
    peak: str = ""
    colour: str = ""
    dash: str = ""
    x: Floats | None = None
    extremes: Extremes | None = None
    marks: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class LimitMark:
    """A limit position of an output: ``place`` on the axis (SI), ``kind`` max or min."""

    place: float
    kind: str


@dataclass(frozen=True)
class PhaseMark:
    """A stretch of the axis (SI) in which a load acts."""

    name: str
    begin: float
    end: float


def limit_marks(source: PlotInput, output: Output | None) -> list[LimitMark]:
    """Limit positions of an output; none for points, or where the motion follows no law in time."""
    if output is None or output.is_point or not source.motion.by_law:
        return []
    try:
        found = limit_positions(source.motion, output)
    except LinkwrightError:
        return []
    in_time = source.axis.dimension == "time"
    return [LimitMark(each.time if in_time else each.input, each.kind) for each in found]


def phase_marks(source: PlotInput, limits: list[LimitMark]) -> list[PhaseMark]:
    """Where loads with a phase act; ends next to a limit position lie on it."""
    found: list[PhaseMark] = []
    x = source.axis.values
    for name, where in acting(source).items():
        for first, last in runs(where):
            ends = (_snapped(x, first, limits), _snapped(x, last, limits))
            found.append(PhaseMark(name, *ends))
    return found


def acting(source: PlotInput) -> dict[str, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """Of every load with a phase: at which positions it acts, up to the cycle's end."""
    found: dict[str, np.ndarray[tuple[int], np.dtype[np.bool_]]] = {}
    if not source.motion.by_law:
        return found
    signals = MotionSignals(source.motion)
    for name, load in source.mechanism.loads.items():
        if isinstance(load.magnitude.phase, Always):
            continue
        try:
            where = activity(load, signals).where
        except LinkwrightError:
            continue
        found[name] = source.closed(where.astype(float)) > 0.5
    return found


def _snapped(x: np.ndarray[tuple[int], np.dtype[np.float64]], index: int, limits: list[LimitMark]) -> float:
    step = abs(float(x[1] - x[0])) * 1.01
    here = float(x[index])
    return min(
        (each.place for each in limits if abs(each.place - here) <= step), key=lambda p: abs(p - here), default=here
    )


_HALO = {"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}


def mark_peaks(axes: Axes, curves: Iterable[Curve], axis: InputAxis, unit: Unit) -> None:
    """Dots with values at the extremes of the curves that ask for it."""
    for curve in curves:
        if np.isfinite(curve.values).any():
            _mark(axes, curve, axis, unit)


def _mark(axes: Axes, curve: Curve, axis: InputAxis, unit: Unit) -> None:
    values = curve.values
    if np.nanmax(values) - np.nanmin(values) <= 1e-9 * largest(values) + 1e-12:
        return
    places = (axis.values if curve.x is None else curve.x) * axis.unit.factor
    left, right = float(np.min(places)), float(np.max(places))
    for x_at, value, above in _peaks(curve, axis):
        x, y = x_at * axis.unit.factor, value * unit.factor
        share = (x - left) / (right - left) if right > left else 0.5
        if places[-1] < places[0]:
            share = 1.0 - share
        if np.isinf(value):
            axes.annotate(
                "∞" if value > 0.0 else "-∞",
                (x, float(value > 0.0)),
                (0, -4 if value > 0.0 else 4),
                xycoords=axes.get_xaxis_transform(),
                textcoords="offset points",
                ha="center",
                va="top" if value > 0.0 else "bottom",
                fontsize=9,
                color=INK,
                bbox=_HALO,
            )
            continue
        side = "left" if share < 0.12 else "right" if share > 0.88 else "center"
        axes.plot([x], [y], "o", color=curve.colour, markersize=3.6, zorder=4)
        axes.annotate(
            unit.text(value),
            (x, y),
            (0, 4 if above else -4),
            textcoords="offset points",
            ha=side,
            va="bottom" if above else "top",
            fontsize=7.5,
            color=INK,
            bbox=_HALO,
            zorder=5,
        )


def _peaks(curve: Curve, axis: InputAxis) -> list[tuple[float, float, bool]]:
    """Place and value of the extremes that are marked, and whether their texts stand above."""
    if not curve.peak:
        minimum = float(np.nanmin(curve.values)) + 1e-9 * largest(curve.values)
        return [(place, value, value > minimum) for place, value in curve.marks]
    high, low = _extreme(curve, axis, "max"), _extreme(curve, axis, "min")
    if curve.peak == "largest":
        first, last = sorted([(*high, True), (*low, False)])
        return [(first, last)[first_largest(np.abs([first[1], last[1]]))]]
    return [(*high, True)] if curve.peak == "max" else [(*high, True), (*low, False)]


def through_peaks(curve: Curve, axis: InputAxis) -> tuple[Floats, Floats]:
    """Places and values of a curve with the extremes that are marked on it, so that the line passes them."""
    x, values = (axis.values if curve.x is None else curve.x), curve.values
    if not curve.peak or not np.isfinite(values).any():
        return x, values
    way = -1.0 if x[-1] < x[0] else 1.0
    for x_at, value, _ in _peaks(curve, axis):
        if np.isfinite(value):
            at = int(np.searchsorted(way * x, way * x_at))
            x, values = np.insert(x, at, x_at), np.insert(values, at, value)
    return x, values


def _extreme(curve: Curve, axis: InputAxis, kind: Kind) -> tuple[float, float]:
    """Place on the axis and value: between the positions where the curve knows its extremes, else at one of them."""
    found = curve.extremes(kind) if curve.extremes is not None else None
    if found is not None and not np.isnan(found.value):
        return (found.time if axis.dimension == "time" else found.input), found.value
    index = first_largest(curve.values if kind == "max" else -curve.values)
    return float((axis.values if curve.x is None else curve.x)[index]), float(curve.values[index])


def jumps(source: PlotInput) -> Floats:
    """Indices i such that a load begins or ends to act between positions i and i + 1 of the closed cycle."""
    found: set[int] = set()
    for where in acting(source).values():
        found |= set(np.flatnonzero(np.diff(where.astype(int))).tolist())
    return np.array(sorted(found), dtype=float)


def draw_curve(axes: Axes, curve: Floats, breaks: Floats, colour: str, dash: str = "-") -> Any:
    """A curve (n, 2); dotted where a load jumps. Returns its line."""
    line = None
    starts = [0, *(int(i) + 1 for i in breaks)]
    ends = [*(int(i) + 1 for i in breaks), len(curve)]
    for start, end in zip(starts, ends, strict=True):
        (line,) = axes.plot(curve[start:end, 0], curve[start:end, 1], color=colour, linestyle=dash)
    for i in breaks.astype(int):
        axes.plot(curve[i : i + 2, 0], curve[i : i + 2, 1], color=colour, linestyle=":", linewidth=1.0)
    return line


def mark_inputs(names: Names, curve: Floats, axis: InputAxis, colour: str) -> None:
    """Dots at round values of the input, which are named where there is room, and an arrow."""
    good = np.asarray(np.isfinite(curve).all(axis=1))
    if good.sum() < 3:
        return
    for index, text in _round_places(axis, good):
        names.axes.plot(*curve[index], "o", color=colour, markersize=2.8, zorder=4)
        names.names.append(Name(text, curve[index], spare=True))
    _arrow(names.axes, curve, good, colour)


def _round_places(axis: InputAxis, good: Flags) -> list[tuple[int, str]]:
    """Indices nearest to round values of the axis, each once, with their texts."""
    shown = axis.values * axis.unit.factor
    span = float(np.ptp(shown[np.isfinite(shown)]))
    if span == 0.0:
        return []
    step = 30.0 if axis.dimension == "angle" and 90 <= span <= 400 else round_up(span / 12.0)
    first, last = np.ceil(shown.min() / step - 1e-9), np.floor(shown.max() / step + 1e-9)
    found, values_found = [], set()
    values = np.arange(first, last + 1) * step
    for value in values[::-1] if axis.backwards else values:
        index = int(np.nanargmin(np.abs(shown - value)))
        turned = round(value % 360.0, 6) if axis.dimension == "angle" else value
        if good[index] and turned not in values_found:
            values_found.add(turned)
            suffix = "°" if axis.dimension == "angle" else f" {axis.unit.name}"
            found.append((index, f"{significant(float(value), 6)}{suffix}"))
    return found


def _arrow(axes: Axes, curve: Floats, good: Flags, colour: str) -> None:
    """One arrow head where the curve is long, in the direction of the motion."""
    steps = np.hypot(*np.diff(curve, axis=0).T)
    steps = np.where(good[1:] & good[:-1], steps, 0.0)
    if not steps.sum() > 0:
        return
    usual = np.where(steps < 6 * np.median(steps[steps > 0]), steps, 0.0)
    index = int(np.searchsorted(np.cumsum(usual), 0.08 * usual.sum()))
    index = min(max(index, 1), len(curve) - 3)
    if not good[index - 1 : index + 2].all() or (curve[index - 1] == curve[index + 1]).all():
        return
    axes.annotate(
        "",
        tuple(curve[index + 1]),
        tuple(curve[index - 1]),
        arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 11, "shrinkA": 0, "shrinkB": 0},
    )


LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
SIZE, CLEARANCE, CORNERS = 7.5, 3.5, 180
#: Two spare names nearer to each other than this, across and up, are not both written, points.
NEAR = np.array([20.0, 10.0])
_NAME_HALO: dict[str, Any] = {"boxstyle": "round,pad=0.08", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}


@dataclass(frozen=True)
class Name:
    """A text for a place of the axes; a ``spare`` one is left out where another one is near."""

    text: str
    place: Floats
    spare: bool = False


@dataclass
class Names:
    """What is to be named in axes; names keep clear of ``lines`` (n, 2)."""

    axes: Axes
    names: list[Name] = field(default_factory=list)
    lines: list[Floats] = field(default_factory=list)

    def line(self, places: Floats) -> None:
        """A line that is drawn; of a curve with very many corners some are enough."""
        self.lines.append(places[:: max(1, len(places) // CORNERS)])


def write_names(figure: Figure, every: Sequence[Names]) -> None:
    """Writes all names of a figure to which nothing else is added."""
    figure.draw_without_rendering()
    for each in every:
        _write(each, 72.0 / figure.dpi)


def _write(names: Names, scale: float) -> None:
    axes = names.axes

    def paper(places: Floats) -> Floats:
        return np.asarray(axes.transData.transform(places) * (scale, -scale))

    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    edges = np.array([(left, high), (left, low), (right, low)])
    shown = _with_room(names.names, [paper(each.place[None])[0] for each in names.names])
    labels = [Label(each.text, (vec(at),), "", SIZE, CLEARANCE, leader=False) for each, at in shown]
    places = place(labels, Obstacles.of([paper(line) for line in (*names.lines, edges)]))
    for (each, at), chosen in zip(shown, places, strict=True):
        box = np.array(chosen.box)
        offset = (0.5 * (box[:2] + box[2:]) - at) * (1.0, -1.0)
        axes.annotate(
            with_index(each.text),
            vec(each.place),
            vec(offset),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=SIZE,
            color=INK,
            zorder=5,
            bbox=_NAME_HALO if each.spare else None,
        ).set_in_layout(False)


def _with_room(names: Sequence[Name], places: Sequence[Floats]) -> list[tuple[Name, Floats]]:
    """Names with their places on the paper, without spare ones for which there is no room."""
    found: list[tuple[Name, Floats]] = []
    for name, at in zip(names, places, strict=True):
        if not name.spare or not any((np.abs(at - other) < NEAR).all() for each, other in found if each.spare):
            found.append((name, at))
    return found


def with_index(name: str) -> str:
    """A point's name with its number as an index: ``O₁``."""
    stem, index = split_index(name.rpartition(".")[2] if name.count(".") == 1 else name)
    owner = f"{name.rpartition('.')[0]}." if name.count(".") == 1 else ""
    return f"{owner}{stem}{index.translate(LOW)}"


#: Colour of links; diagonal of a machine in units of symbols; points of a support per unit of its symbol.
LINK, DIAGONAL, SUPPORT = "#7a828c", 950.0, 0.36
#: What closed shapes are filled with, by their style: colour and opacity.
_FILLS = {"lw-plate": (LINK, 0.12), "lw-point": (INK, 1.0), "lw-weld": (INK, 1.0), "lw-gear": (LINK, 0.06)}


def draw_machine(names: Names, motion: Motion, index: int, *, factor: float) -> None:
    """The machine at one position, places times a factor, with the names of its points."""
    scene, axes = laid_out(motion, index, inputs=False, diagonal=DIAGONAL), names.axes
    to_axes = np.array([1.0, -1.0]) * factor / scene.machine.view.scale
    for number, (_, item) in enumerate(scene.items(index)):
        line, order = item.outline * to_axes, 1.5 + 1e-4 * number
        thick = item.style in ("lw-bar", "lw-plate")
        own = "" if isinstance(item, Circle) else item.colour
        if item.style == "lw-pitch":
            dash: tuple[int, tuple[float, ...]] = (0, (8, 2, 1.5, 2))
        else:
            dash = (0, ())
        if isinstance(item, Circle) or item.closed:
            colour, alpha = _FILLS.get(item.style, ("white", 1.0))
            colour = own or colour
            if item.style != "lw-pitch":
                axes.fill(*line.T, color=colour, alpha=alpha, linewidth=0, zorder=order)
        axes.plot(
            *line.T,
            color=own or (LINK if thick else INK),
            linewidth=1.6 if thick else 0.7,
            linestyle=dash,
            solid_capstyle="round",
            zorder=order,
        )
        names.lines.append(line)
    labels = point_labels(scene.machine, index)
    names.names += [Name(label.text, np.array(label.anchors[0]) * to_axes) for label in labels]


def draw_support(axes: Axes, at: Floats, colour: str = INK) -> None:
    """The support of a pin of the frame below a place of the axes."""
    from matplotlib.path import Path

    items = SYMBOLS["fixed_pivot"]().elements
    strokes = [item.placed(np.zeros(2), scale=(SUPPORT, -SUPPORT)).outline for item in items]
    shape = Path.make_compound_path(*(Path(list(map(vec, stroke))) for stroke in strokes))
    size = 2.0 * float(np.abs(np.concatenate(strokes)).max())
    axes.plot(
        *at[:, None],
        marker=shape,
        markersize=size,
        markerfacecolor="none",
        markeredgecolor=colour,
        markeredgewidth=0.8,
        linestyle="",
        zorder=2.4,
    )
