"""What a synthesis found: target, candidates and their curves, and the construction with ruler and compasses."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from linkwright.analysis.coupler_curve import CouplerCurve
from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import significant
from linkwright.errors import speaker
from linkwright.pictures.diagram import COLOURS, FAINT, INK, Axes, Figure, new_figure
from linkwright.pictures.drawing import BLUE, GREEN, GROUND, ORANGE, Drawing, Sketch, arrow_rules
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.diagrams.axes import Legend, make_plane, unit_of
from linkwright.plotting.diagrams.base import Request, framed, result_diagram
from linkwright.plotting.diagrams.marks import draw_support
from linkwright.plotting.diagrams.scaled_page import (
    BAR,
    MILLIMETRE,
    Cell,
    key,
    page,
    scale_of_picture,
    scale_title,
    units,
)
from linkwright.synthesis.motion_generation.generate import MotionDerivation
from linkwright.synthesis.requirements.crank_rocker import CrankRockerDerivation, QuickReturnDerivation
from linkwright.synthesis.requirements.slider_crank import SliderCrankDerivation
from linkwright.synthesis.result import Candidate, Synthesis, title_text
from linkwright.words import Translate, _, pgettext, translate

SHOWN = 4
#: What the output of a task's curve is, where it is not that of a function.
OUTPUTS = {"slider_crank": "place", "toggle": "ratio", "dwell": "angle"}
#: Curves of the plane, by their names.
CURVES = {"circle_points": _("circle points"), "centre_points": pgettext("synthesize", "centre points")}
#: What a function gives, by its kind: the factor to the unit of its axis, and the label of that.
AXES = {
    "angle": (float(np.degrees(1.0)), _("output (°)")),
    "place": (1e3, _("place of the slider (mm)")),
    "ratio": (1.0, _("force ratio P/F")),
}


@result_diagram("synthesis", _("synthesis"), Synthesis)
def draw_synthesis(result: Synthesis, request: Request) -> Figure:
    """The best candidates in their first pose with the curves they draw, the target, and Burmester's curves.

    Functions are drawn next to them over the input.
    """
    function = any(each.curve is not None and each.curve.ndim == 2 for each in result.candidates)
    figure = new_figure(request.size or ((11, 5.2) if function else (7.5, 6)))
    axes, legend = figure.subplots(1, 2 if function else 1, squeeze=False)[0], Legend()
    _plane(axes[0], result, request.language, legend)
    if function:
        _function(axes[1], result, request.language)
    return framed(figure, title_text(result, speaker(request.language)), request, legend)


def _plane(axes: Axes, result: Synthesis, language: str, legend: Legend) -> None:
    for name, curve in result.curves.items():
        colour = FAINT if "centre" in name else "#d9a13b"
        (dots,) = axes.plot(*_places(curve), ".", ms=2.5, color=colour)
        legend.add(translate(CURVES[name], language), dots)
    for number, each in enumerate(result.candidates[:SHOWN]):
        colour = COLOURS[number % len(COLOURS)]
        label = _("candidate {number}", number=number + 1).translate(language)
        if each.curve is not None and each.curve.ndim == 1:
            (line,) = axes.plot(*_places(each.curve), color=colour, lw=1)
            legend.add(label, line)
        if result.task != "free_curve" or not number:
            legend.add(label, _links(axes, each, colour))
    target = result.target
    if target is not None and np.iscomplexobj(target):
        places = _places(target if target.ndim == 1 else target[0])
        mark = "--" if result.task == "free_curve" else "o"
        (marks,) = axes.plot(*places, mark, ms=4, mfc="none", color=INK)
        legend.add(_("target").translate(language), marks)
        if target.ndim == 2:
            axes.quiver(*places, target[1].real, target[1].imag, color=INK, width=0.003)
    make_plane(axes, 0.08)


def _places(numbers: Complexes) -> tuple[Floats, Floats]:
    """Places x and y, mm."""
    return 1e3 * numbers.real, 1e3 * numbers.imag


def _function(axes: Axes, result: Synthesis, language: str) -> None:
    """Functions of the candidates over the input, and the pairs; angles in degrees, places in mm."""
    kind = OUTPUTS.get(result.task, "place" if result.error_name == "length" else "angle")
    factor, label = AXES[kind]
    factors = np.array([[np.degrees(1.0)], [factor]])
    for number, each in enumerate(result.candidates[:SHOWN]):
        if each.curve is not None and each.curve.ndim == 2:
            axes.plot(*(factors * each.curve), color=COLOURS[number % len(COLOURS)])
    target = result.target
    if target is not None and not np.iscomplexobj(target):
        axes.plot(*(factors * target), "o", ms=4, mfc="none", color=INK)
    axes.set(xlabel=_("input (°)").translate(language), ylabel=label.translate(language))


def _links(axes: Axes, each: Candidate, colour: str) -> Any:
    """The links of a candidate and its pins, those of the frame on supports; one of its lines."""
    points, line = each.linkage.points, None
    for names in each.linkage.links.values():
        if len(names) > 1:
            ring = [*names, names[0]] if len(names) > 2 else list(names)
            x, y = _places(np.array([points[name] for name in ring]))
            (line,) = axes.plot(x, y, "-o", ms=4.2, mfc="white", color=colour, lw=1.8, zorder=2.5)
            if len(names) > 2:
                axes.fill(x, y, color=colour, alpha=0.1, linewidth=0)
    for name in each.linkage.frame:
        draw_support(axes, np.ravel(_places(np.array([points[name]]))))
    return line


#: Share of an angle (rad) or of a length (m) below which deviations are rounding.
ROUNDING = 1e-11
#: Error names whose deviations are angles.
ANGLES = ("angle", "rest")


def has_deviations(result: Synthesis) -> bool:
    """Whether the first candidate deviates anywhere."""
    off = result.best.deviations if len(result) else np.empty(0)
    return bool(off.size and np.abs(off).max() > ROUNDING * max(result.extent, 1e-3))


@result_diagram(
    "structural_error", _("deviation at every demanded position"), Synthesis, usual=False, when=has_deviations
)
def draw_structural_error(result: Synthesis, request: Request) -> Figure:
    """The error curve: over the input of a function, else over the number of the position."""
    figure = new_figure(request.size or (7.2, 3.2))
    axes = figure.subplots()
    off, angles = result.best.deviations, result.error_name in ANGLES
    factor = np.degrees(1.0) if angles else 1e3
    x, label = _abscissa(result, request.language)
    axes.axhline(0.0, color=FAINT, linewidth=0.8)
    axes.vlines(x, 0.0, factor * off, color=COLOURS[0], linewidth=1.0)
    order = np.argsort(x)
    axes.plot(x[order], factor * off[order], "o-", color=COLOURS[0], ms=4, linewidth=0.8)
    if result.error_name not in ("angle", "length"):
        axes.locator_params(axis="x", integer=True)
    axes.set(xlabel=label, ylabel=request.translate(_("deviation (°)") if angles else _("deviation (mm)")))
    axes.margins(x=0.05, y=0.15)
    return framed(figure, title_text(result, speaker(request.language)), request)


def _abscissa(result: Synthesis, language: str) -> tuple[Floats, str]:
    """Where the deviations are drawn, and the label of that axis."""
    target = result.target
    if target is not None and not np.iscomplexobj(target):
        return np.degrees(target[0]), _("input (°)").translate(language)
    return np.arange(1.0, len(result.best.deviations) + 1), _("position").translate(language)


@result_diagram("coupler_curve", _("coupler curve"), CouplerCurve)
def draw_coupler_curve(result: CouplerCurve, request: Request) -> Figure:
    """The path, both axes to one scale; double points ringed, cusps as diamonds; length and area in the title."""
    unit, legend = unit_of("length"), Legend()
    figure = new_figure(request.size or (6.2, 5.2))
    axes = figure.subplots()
    x, y = (np.concatenate([result.path, result.path[:1]]) * unit.factor).T
    axes.plot(x, y, color=COLOURS[0])
    doubles = [spot for spot, _unused in result.double_points]
    cusps = [spot for spot, _unused in result.cusps]
    if request.marks:
        for name, spots, sign in ((_("double point"), doubles, "o"), (_("cusp"), cusps, "D")):
            if spots:
                (dots,) = axes.plot(
                    *(np.array(spots).T * unit.factor),
                    sign,
                    color=COLOURS[1],
                    markersize=7,
                    fillstyle="none",
                    markeredgewidth=1.4,
                )
                legend.add(request.translate(name), dots)
    make_plane(axes, 0.1)
    length, area = unit.text(result.length, 6), unit_of("area").text(result.area, 6)
    return framed(
        figure,
        request.translate(
            _("coupler curve of {point}, length {length}, area {area}", point=result.point, length=length, area=area)
        ),
        request,
        legend,
    )


#: Longest extent of a construction, mm; size of posed axes, as a share of the poses' extent.
EXTENT, AXIS_LENGTH = 130.0, 0.18
#: How far curves are drawn, in units of the distance of the farthest point from the middle.
ROOM = 1.2
#: A circle this many times as large as what it is for is drawn as an arc.
LARGE = 3.0
#: Places of a pin up to which each is named.
MOST_NAMES = 3
#: Colours, widths and dashes of lines: links and what guides them, the locus of a pivot, Burmester's curves.
LOOKS = {
    "first": (BLUE, 2.4, ""),
    "first-thin": (BLUE, 1.2, ""),
    "first-ray": (BLUE, 1.2, "6 3"),
    "second": (ORANGE, 2.4, ""),
    "second-thin": (ORANGE, 1.2, ""),
    "second-ray": (ORANGE, 1.2, "6 3"),
    "locus": (GREEN, 1.2, "6 3"),
    "circle_points": ("#d9a13b", 2.2, ""),
    "centre_points": (GROUND, 2.2, ""),
}
CSS = "".join(arrow_rules(name, *look) for name, look in LOOKS.items())
CSS += ".lw-circle_points-line,.lw-centre_points-line{stroke-linecap:round}"
#: Classes of lines: a helping line, an axis of symmetry or the path of a slider, a body, its first position.
HELPING, CHAIN, BODY, FIRST = "lw-dimension", "lw-pitch", "lw-strand", "lw-bar"


class Construction:
    """A construction in the making: lines, points and angles of a plane in m, drawn when its scale is known."""

    def __init__(self) -> None:
        self.lines: list[tuple[Complexes, str]] = []
        self.angles: list[tuple[str, complex, complex, complex, float]] = []
        self.pivots: list[complex] = []
        self.names: list[tuple[str, complex, str]] = []

    def line(self, *places: complex, style: str = HELPING) -> None:
        """A broken line."""
        self.lines.append((np.array(places, dtype=complex), style))

    def circle(
        self, centre: complex, radius: float, style: str = HELPING, ends: tuple[float, float] | None = None
    ) -> None:
        """A circle, or its arc between two angles (rad)."""
        angle = np.linspace(*(ends or (0.0, 2 * math.pi)), 361)
        self.line(*(centre + radius * np.exp(1j * angle)), style=style)

    def locus(self, centre: complex, through: Complexes) -> None:
        """The circle through points with its centre M; an arc where it is large."""
        radius = abs(complex(through[0]) - centre)
        if radius < LARGE * float(np.abs(through - through.mean()).max()):
            self.circle(centre, radius, "lw-locus-line")
            self.points({"M": centre}, "lw-locus")
        else:
            angle = np.unwrap(np.angle(through - centre))
            beyond = 0.3 * float(np.ptp(angle))
            self.circle(centre, radius, "lw-locus-line", (angle.min() - beyond, angle.max() + beyond))

    def points(self, places: Mapping[str, complex], style: str = "lw") -> None:
        """Points with their names."""
        self.names += [(name, complex(place), style) for name, place in places.items()]

    def pivot(self, name: str, place: complex) -> None:
        """A fixed pivot on its support."""
        self.pivots.append(place)
        self.points({name: place})

    def angle(self, at: complex, first: complex, last: complex, name: str, radius: float) -> None:
        """The angle between two rays from a point."""
        self.angles.append((name, at, first, last, radius))

    def cell(self, translate: Translate) -> Cell:
        """All of it to a round scale."""
        every = np.concatenate([line for line, _ in self.lines])
        scale = scale_of_picture(_flat(every[np.isfinite(every)]), EXTENT)
        sketch = Sketch()

        def paper(places: complex | Complexes) -> Floats:
            return units(_flat(np.asarray(places)) / scale)

        for name, at, first, last, radius in self.angles:
            start, turn = float(np.angle(first)), float(np.angle(last / first))
            size = radius / scale / MILLIMETRE
            sketch.put("dimension_arc", at=vec(paper(at)), radius=size, first=-start, sweep=-turn)
            middle = at + radius * complex(np.exp(1j * (start + 0.5 * turn)))
            sketch.name(name, paper(middle), style="lw-value", clearance=4.0)
        for place in self.pivots:
            sketch.put("fixed_pivot", at=vec(paper(place)))
        for line, style in self.lines:
            sketch.line(paper(line), style)
        for name, place, style in self.names:
            sketch.put("pin", at=vec(paper(place)), radius=4.0)
            sketch.name(name, paper(place), style=f"{style}-name")
        sketch.write_names()
        title = scale_title(translate(_("construction")), "l", f"{significant(scale * 1e3)} mm/mm")
        return Cell(sketch, (title,), f"{significant(scale * BAR * MILLIMETRE * 1e3)} mm")


def _flat(places: Complexes) -> Floats:
    """Places as x and y."""
    return np.stack([places.real, places.imag], axis=-1)


def slider_crank(plane: Construction, d: SliderCrankDerivation, result: Synthesis) -> None:
    """The triangle of the crank's pivot and both limit positions, and the circle through them."""
    near, far = (math.sqrt(max((d.rod + s * d.crank) ** 2 - d.offset**2, 0.0)) for s in (-1, 1))
    b1, b2 = complex(far, d.offset), complex(near, d.offset)
    plane.line(b2 - 0.3 * d.stroke, b1 + 0.2 * d.stroke, style=CHAIN)
    plane.circle(0, d.crank)
    if d.offset:
        up = (abs(b1) ** 2 - 2 * b1.real * (b1.real + b2.real) / 2) / (2 * d.offset)
        centre = complex((b1.real + b2.real) / 2, up)
        plane.locus(centre, np.array([0j, b1, b2]))
    for place, pin in ((b1, d.crank * b1 / abs(b1)), (b2, -d.crank * b2 / abs(b2))):
        plane.line(0, pin, style="lw-first-line")
        plane.line(pin, place, style="lw-first-thin-line")
    plane.points({"B1": b1, "B2": b2, "A1": d.crank * b1 / abs(b1), "A2": -d.crank * b2 / abs(b2)})
    plane.pivot("O", 0j)
    if d.offset:
        plane.angle(0, b1, b2, "θ", 1.2 * d.crank)


def quick_return(plane: Construction, d: QuickReturnDerivation, result: Synthesis) -> None:
    """The circle of the crank pin with the lever's tangents, the arm's arc and the guide."""
    pivot = -1j * d.frame
    plane.circle(0, d.crank)
    length = d.arm if d.stroke else d.frame
    rays = [np.exp(1j * (math.pi / 2 + s * d.theta / 2)) for s in (1, -1)]
    for number, ray in enumerate(rays, 1):
        touch = pivot + d.frame * math.cos(d.theta / 2) * ray
        plane.line(pivot, pivot + length * ray, style="lw-first-line")
        plane.line(0, touch, style="lw-first-ray-line")
        plane.points({f"A{number}": touch, f"E{number}": pivot + length * ray})
    plane.line(pivot, 0.6j * d.crank, style=CHAIN)
    if d.stroke:
        half = d.theta / 2
        plane.circle(pivot, d.arm, ends=(math.pi / 2 - half, math.pi / 2 + half))
        guide = pivot + 1j * d.height
        plane.line(guide - 0.8 * d.stroke, guide + 0.8 * d.stroke + d.rod, style=CHAIN)
    plane.pivot("O1", 0j)
    plane.pivot("O3", pivot)
    plane.angle(pivot, rays[1], rays[0], "θ", 0.35 * d.frame)


def crank_rocker(plane: Construction, d: CrankRockerDerivation, result: Synthesis) -> None:
    """The rocker's limit positions, the circle of the crank's pivots, and the pivot that was taken."""
    c = d.rocker_length
    limits = c * np.exp(1j * (math.pi / 2 + np.array([-0.5, 0.5]) * d.swing_angle))
    pivot = c * d.pivot
    if d.centre is not None:
        centre = c * d.centre
        plane.locus(centre, np.array([*limits, pivot]))
    far, near = sorted(limits, key=lambda place: -abs(place - pivot))
    crank = 0.5 * (abs(far - pivot) - abs(near - pivot))
    plane.circle(pivot, crank)
    plane.line(limits[0], limits[1])
    plane.line(0, pivot, style=CHAIN)
    pins = []
    for place, sign in ((far, 1), (near, -1)):
        along = (place - pivot) / abs(place - pivot)
        pins.append(pivot + sign * crank * along)
        plane.line(pivot, pins[-1], style="lw-second-line")
        plane.line(pins[-1], place, style="lw-first-thin-line")
        plane.line(0, place, style="lw-first-line")
    plane.points({"B1": limits[0], "B2": limits[1], "A1": pins[0], "A2": pins[1]})
    plane.pivot("O1", pivot)
    plane.pivot("O2", 0j)
    plane.angle(0, limits[0], limits[1], "ψ", 0.3 * c)
    if d.theta:
        plane.angle(pivot, limits[0] - pivot, limits[1] - pivot, "θ", 0.5 * abs(near - pivot))


def motion(plane: Construction, d: MotionDerivation, result: Synthesis) -> None:
    """The poses, the places of both pins with their circles, the bisectors of three poses, curves of four."""
    best, shapes = result.best, result.curves
    pivots = [best.linkage.points[name] for name in best.linkage.frame]
    corners = np.concatenate([d.p, *best.positions.values(), pivots])
    middle = corners.mean()
    reach = ROOM * float(np.abs(corners - middle).max())
    for name, points in shapes.items():
        curve = points[np.abs(points - middle) <= reach]
        dot = 1e-3 * reach  # points of one curve, each a short stroke
        plane.line(
            *np.stack([curve, curve + dot, np.full(len(curve), np.nan)], axis=1).ravel(), style=f"lw-{name}-line"
        )
    size = AXIS_LENGTH * max(result.extent, 1e-9)
    for number, (place, angle) in enumerate(zip(d.p, d.phi, strict=True), 1):
        if not math.isnan(angle):
            turn = size * np.exp(1j * angle)
            plane.line(place + turn, place, place + 1j * turn, style=BODY)
        plane.points({f"P{number}": place})
    for pin, pivot, style in (("A", "O1", "lw-first"), ("B", "O2", "lw-second")):
        _pin(plane, best.positions[pin], best.linkage.points.get(pivot), (pin, pivot), style, len(d.p) == 3)
    a, b = best.positions["A"], best.positions["B"]
    for j in range(len(d.p)):
        plane.line(a[j], b[j], style=BODY if j else FIRST)


def _pin(
    plane: Construction,
    places: Complexes,
    centre: complex | None,
    names: tuple[str, str],
    style: str,
    bisectors: bool,
) -> None:
    """A pin's places with their circle, or line, its centre, and the bisectors."""
    pin, pivot = names
    if centre is None:
        plane.line(*places, style=f"{style}-ray-line")
    else:
        angle = np.unwrap(np.angle(places - centre))
        ends = float(angle.min()) - 0.2, float(angle.max()) + 0.2
        plane.circle(centre, float(np.abs(places - centre).mean()), f"{style}-thin-line", ends)
        plane.line(centre, places[0], style=f"{style}-line")
        if bisectors:
            for first, last in pairwise(places):
                middle = (first + last) / 2
                away = middle + 0.25 * (middle - centre)
                plane.line(centre + 0.15 * (centre - middle), away, style=CHAIN)
        plane.pivot(pivot, centre)
    shown = range(len(places)) if len(places) <= MOST_NAMES else (0, len(places) - 1)
    plane.points({f"{pin}{j + 1}": complex(places[j]) for j in shown}, style)


DRAWN: Mapping[type, Callable[[Construction, Any, Synthesis], None]] = {
    SliderCrankDerivation: slider_crank,
    QuickReturnDerivation: quick_return,
    CrankRockerDerivation: crank_rocker,
    MotionDerivation: motion,
}


@result_diagram(
    "construction",
    _("construction"),
    Synthesis,
    usual=False,
    to_scale=True,
    when=lambda found: type(found.derivation) in DRAWN,
)
def draw_construction(result: Synthesis, request: Request) -> Drawing:
    """The construction of the first candidate."""
    plane, translate = Construction(), request.translate
    DRAWN[type(result.derivation)](plane, result.derivation, result)
    curves = key([(translate(CURVES[name]), f"lw-{name}") for name in result.curves])
    title = title_text(result, translate)
    return page([plane.cell(translate)], 1, [curves] if curves else [], request.heading(title), title, CSS)
