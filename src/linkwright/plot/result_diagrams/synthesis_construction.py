"""The construction by which a synthesis can be done with ruler and compasses, to scale."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.errors import speaker
from linkwright.pictures.diagram import COLOURS, FAINT, INK, Axes, Figure, new_figure
from linkwright.plot.diagrams.axes import Legend
from linkwright.plot.diagrams.base import Request, framed, result_diagram
from linkwright.plot.diagrams.names import draw_support
from linkwright.plot.result_diagrams.synthesis import CURVES
from linkwright.synthesis.motion_generation.generate import MotionDerivation
from linkwright.synthesis.requirements.crank_rocker import CrankRockerDerivation, QuickReturnDerivation
from linkwright.synthesis.requirements.slider_crank import SliderCrankDerivation
from linkwright.synthesis.result import Synthesis, title_said
from linkwright.words import Say, _

#: Points of a circle; size of posed axes, as a share of the poses' extent.
CIRCLE, AXES = 361, 0.18
THIN, THICK = 0.8, 1.8
#: How far curves are drawn, in units of the distance of the farthest point from the middle.
ROOM = 1.2
#: Places of a pin up to which each is named.
MOST_NAMES = 3


class Plane:
    """A plane in mm on which a construction is drawn."""

    def __init__(self, axes: Axes, say: Say) -> None:
        self.axes, self.say, self.legend = axes, say, Legend()
        self.named: list[tuple[str, complex, str]] = []

    def line(self, *places: complex, colour: str = INK, width: float = THIN, style: Any = "-") -> None:
        """A broken line."""
        z = 1e3 * np.array(places)
        self.axes.plot(z.real, z.imag, color=colour, lw=width, ls=style)

    def circle(
        self, centre: complex, radius: float, colour: str = FAINT, ends: tuple[float, float] | None = None,
        style: Any = "-",
    ) -> None:  # fmt: skip
        """A circle, or its arc between two angles (rad)."""
        first, last = ends or (0.0, 2 * math.pi)
        angle = np.linspace(first, last, CIRCLE)
        self.line(*(centre + radius * np.exp(1j * angle)), colour=colour, style=style)

    def points(self, places: Mapping[str, complex], colour: str = INK) -> None:
        """Points with their names."""
        for name, place in places.items():
            z = 1e3 * complex(place)
            self.axes.plot(z.real, z.imag, "o", ms=4.5, mfc="white", color=colour, zorder=3)
            self.named.append((name, z, colour))

    def label(self) -> None:
        """Writes the names beside their points, away from the middle of all of them."""
        middle = np.mean([z for _, z, _ in self.named])
        for name, z, colour in self.named:
            away = complex((z - middle) / (float(np.abs(z - middle)) or 1.0))
            shift = (math.copysign(max(10 * abs(away.real), 7), away.real), 9 * away.imag + 2)
            self.axes.annotate(
                name, (z.real, z.imag), shift, textcoords="offset points", color=colour, zorder=4,
                ha="left" if away.real >= 0 else "right", va="center",
            )  # fmt: skip

    def pivot(self, name: str, place: complex) -> None:
        """A fixed pivot on its support."""
        draw_support(self.axes, np.array([1e3 * place.real, 1e3 * place.imag]))
        self.points({name: place})

    def angle(self, at: complex, first: complex, last: complex, name: str, radius: float) -> None:
        """The angle between two rays from a point."""
        begin, turn = np.angle(first), np.angle(last / first)
        self.circle(at, radius, COLOURS[1], (float(begin), float(begin + turn)))
        place = 1e3 * (at + 1.15 * radius * np.exp(1j * (begin + turn / 2)))
        self.axes.annotate(name, (place.real, place.imag), color=COLOURS[1], ha="center", va="center")


def slider_crank(plane: Plane, d: SliderCrankDerivation, result: Synthesis) -> None:
    """The triangle of the crank's pivot and both limit positions, and the circle through them."""
    near, far = (math.sqrt(max((d.rod + s * d.crank) ** 2 - d.offset**2, 0.0)) for s in (-1, 1))
    b1, b2 = complex(far, d.offset), complex(near, d.offset)
    plane.line(b2 - 0.3 * d.stroke, b1 + 0.2 * d.stroke, colour=FAINT, style="-.")
    plane.circle(0, d.crank)
    if d.offset:
        up = (abs(b1) ** 2 - 2 * b1.real * (b1.real + b2.real) / 2) / (2 * d.offset)
        centre = complex((b1.real + b2.real) / 2, up)
        plane.circle(centre, abs(centre), COLOURS[2], style="--")
        plane.points({"M": centre}, COLOURS[2])
    for place, pin in ((b1, d.crank * b1 / abs(b1)), (b2, -d.crank * b2 / abs(b2))):
        plane.line(0, pin, colour=COLOURS[0], width=THICK)
        plane.line(pin, place, colour=COLOURS[0], width=THIN)
    plane.points({"B1": b1, "B2": b2, "A1": d.crank * b1 / abs(b1), "A2": -d.crank * b2 / abs(b2)})
    plane.pivot("O", 0j)
    if d.offset:
        plane.angle(0, b1, b2, "θ", 1.2 * d.crank)


def quick_return(plane: Plane, d: QuickReturnDerivation, result: Synthesis) -> None:
    """The circle of the crank pin with the lever's tangents, the arm's arc and the guide."""
    pivot = -1j * d.frame
    plane.circle(0, d.crank)
    length = d.arm if d.stroke else d.frame
    rays = [np.exp(1j * (math.pi / 2 + s * d.theta / 2)) for s in (1, -1)]
    for number, ray in enumerate(rays, 1):
        touch = pivot + d.frame * math.cos(d.theta / 2) * ray
        plane.line(pivot, pivot + length * ray, colour=COLOURS[0], width=THICK)
        plane.line(0, touch, colour=COLOURS[0], style="--")
        plane.points({f"A{number}": touch, f"E{number}": pivot + length * ray})
    plane.line(pivot, 0.6j * d.crank, colour=FAINT, style="-.")
    if d.stroke:
        half = d.theta / 2
        plane.circle(pivot, d.arm, ends=(math.pi / 2 - half, math.pi / 2 + half))
        guide = pivot + 1j * d.height
        plane.line(guide - 0.8 * d.stroke, guide + 0.8 * d.stroke + d.rod, colour=FAINT, style="-.")
    plane.pivot("O1", 0j)
    plane.pivot("O3", pivot)
    plane.angle(pivot, rays[1], rays[0], "θ", 0.35 * d.frame)


def crank_rocker(plane: Plane, d: CrankRockerDerivation, result: Synthesis) -> None:
    """The rocker's limit positions, the circle of the crank's pivots, and the pivot that was taken."""
    c = d.rocker_length
    limits = c * np.exp(1j * (math.pi / 2 + np.array([-0.5, 0.5]) * d.swing_angle))
    pivot = c * d.pivot
    if d.centre is not None:
        centre = c * d.centre
        plane.circle(centre, abs(centre - limits[0]), COLOURS[2], style="--")
        plane.points({"M": centre}, COLOURS[2])
    far, near = sorted(limits, key=lambda place: -abs(place - pivot))
    crank = 0.5 * (abs(far - pivot) - abs(near - pivot))
    plane.circle(pivot, crank)
    plane.line(limits[0], limits[1], colour=FAINT)
    plane.line(0, pivot, colour=FAINT, style="-.")
    pins = []
    for place, sign in ((far, 1), (near, -1)):
        along = (place - pivot) / abs(place - pivot)
        pins.append(pivot + sign * crank * along)
        plane.line(pivot, pins[-1], colour=COLOURS[1], width=THICK)
        plane.line(pins[-1], place, colour=COLOURS[0])
        plane.line(0, place, colour=COLOURS[0], width=THICK)
    plane.points({"B1": limits[0], "B2": limits[1], "A1": pins[0], "A2": pins[1]})
    plane.pivot("O1", pivot)
    plane.pivot("O2", 0j)
    plane.angle(0, limits[0], limits[1], "ψ", 0.3 * c)
    if d.theta:
        plane.angle(pivot, limits[0] - pivot, limits[1] - pivot, "θ", 0.5 * abs(near - pivot))


def motion(plane: Plane, d: MotionDerivation, result: Synthesis) -> None:
    """The poses, the places of both pins with their circles, the bisectors of three poses, curves of four."""
    best, shapes = result.best, result.curves
    pivots = [best.linkage.points[name] for name in best.linkage.frame]
    corners = np.concatenate([d.p, *best.positions.values(), pivots])
    middle = corners.mean()
    reach = ROOM * float(np.abs(corners - middle).max())
    for name, whole in shapes.items():
        curve = whole[np.abs(whole - middle) <= reach]
        colour = FAINT if "centre" in name else "#d9a13b"
        (dots,) = plane.axes.plot(1e3 * curve.real, 1e3 * curve.imag, ".", ms=2, color=colour)
        plane.legend.add(plane.say(CURVES[name]), dots)
    size = AXES * max(result.extent, 1e-9)
    for number, (place, angle) in enumerate(zip(d.p, d.phi, strict=True), 1):
        if not math.isnan(angle):
            turn = size * np.exp(1j * angle)
            plane.line(place + turn, place, place + 1j * turn, colour=INK, width=1.2)
        plane.points({f"P{number}": place})
    for pin, pivot, colour in (("A", "O1", COLOURS[0]), ("B", "O2", COLOURS[1])):
        _pin(plane, best.positions[pin], best.linkage.points.get(pivot), (pin, pivot), colour, len(d.p) == 3)
    a, b = best.positions["A"], best.positions["B"]
    for j in range(len(d.p)):
        plane.line(a[j], b[j], colour=INK, width=THICK if j == 0 else THIN)


def _pin(
    plane: Plane,
    places: Complexes,
    centre: complex | None,
    names: tuple[str, str],
    colour: str,
    bisectors: bool,
) -> None:
    """A pin's places with their circle, or line, its centre, and the bisectors."""
    pin, pivot = names
    if centre is None:
        plane.line(*places, colour=colour, style="-.")
    else:
        angle = np.unwrap(np.angle(places - centre))
        ends = float(angle.min()) - 0.2, float(angle.max()) + 0.2
        plane.circle(centre, float(np.abs(places - centre).mean()), colour, ends)
        plane.line(centre, places[0], colour=colour, width=THICK)
        if bisectors:
            for first, last in pairwise(places):
                middle = (first + last) / 2
                away = middle + 0.25 * (middle - centre)
                plane.line(centre + 0.15 * (centre - middle), away, colour=FAINT, style="--")
        plane.pivot(pivot, centre)
    shown = range(len(places)) if len(places) <= MOST_NAMES else (0, len(places) - 1)
    plane.points({f"{pin}{j + 1}": complex(places[j]) for j in shown}, colour)


DRAWN: Mapping[type, Callable[[Plane, Any, Synthesis], None]] = {
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
    when=lambda found: type(found.derivation) in DRAWN,
)
def draw_construction(result: Synthesis, request: Request) -> Figure:
    """The construction of the first candidate."""
    figure = new_figure(request.size or (7.5, 6))
    axes = figure.subplots()
    plane = Plane(axes, speaker(request.language))
    DRAWN[type(result.derivation)](plane, result.derivation, result)
    plane.label()
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    axes.margins(0.08)
    framed(figure, title_said(result, plane.say), request, plane.legend)
    return figure
