"""Paths of points: coupler curves, with the mechanism at its first position."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.kinematics.names import output_or_point
from linkwright.pictures.diagram import COLOURS, Figure, new_figure
from linkwright.plotting.diagrams.axes import Legend, make_plane
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request, framed
from linkwright.plotting.diagrams.marks import draw_curve, mark_inputs
from linkwright.plotting.diagrams.names import LINK, Names, draw_machine, write_names
from linkwright.plotting.diagrams.outputs import traced_points
from linkwright.plotting.diagrams.panels import DASHES
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.plotting.drawing.machine import extent_of
from linkwright.words import _


@DIAGRAMS.register("paths")
class Paths(Kind):
    """Curves that points describe, both axes to one scale; the free points of links unless others are named."""

    title = _("paths of points")
    options = ("of",)

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        single = len(sources) == 1
        curves = [_curves(source, request) for source in sources]
        tiny = single and not any(_worth_marks(sources[0], curve) for curve in curves[0].values())
        figure = new_figure(request.size or ((9.6, 5.2) if tiny else _room(sources, curves)))
        axes = list(figure.subplots(1, 2 if tiny else 1, squeeze=False)[0])
        legend = Legend()
        names = [Names(one) for one in axes]
        if single:
            motion = sources[0].motion
            draw_machine(names[0], motion, int(np.flatnonzero(motion.ok)[0]), factor=1e3)
        for number, (source, found) in enumerate(zip(sources, curves, strict=True)):
            for one in names:
                _draw(one, source, found, request, legend, None if single else number)
        for one in axes:
            make_plane(one, 0.1)
        framed(figure, request.titled(sources[0].label if single else ""), request, legend)
        write_names(figure, names)
        return figure


def _room(sources: Sequence[PlotInput], curves: Sequence[dict[str, Floats]]) -> tuple[float, float]:
    """Width and height of a figure that the machines and the paths fill, inches."""
    clouds = [each for found in curves for each in found.values()]
    for source in sources:
        frame = list(source.mechanism.frame.points.values())
        clouds.append(1e3 * np.array(frame, dtype=float).reshape(-1, 2))
        first = int(np.flatnonzero(source.motion.ok)[0])
        names = source.motion.point_names()
        clouds += [1e3 * source.motion.point_of(key).position[first : first + 1] for key in names]
    every = np.concatenate(clouds)
    every = every[np.isfinite(every).all(axis=1)]
    extent = np.ptp(every, axis=0) if len(every) else np.ones(2)
    share = float(extent[1] / extent[0]) if extent[0] > 0.0 else 1.0
    return 6.8, 1.4 + 5.6 * min(max(share, 0.35), 0.75)


def _curves(source: PlotInput, request: Request) -> dict[str, Floats]:
    """Paths (n, 2) of the points, mm."""
    keys = [_point(source, name) for name in request.of] or traced_points(source.mechanism)
    return {key: source.closed(source.motion.point(key).position) * 1e3 for key in keys}


def _draw(
    names: Names, source: PlotInput, curves: dict[str, Floats], request: Request, legend: Legend, number: int | None
) -> None:
    axes = names.axes
    for which, (key, curve) in enumerate(curves.items()):
        colour = COLOURS[(which if number is None else number) % len(COLOURS)]
        dash = "-" if number is None else DASHES[which % len(DASHES)]
        line = draw_curve(axes, curve, np.zeros(0), colour, dash)
        names.line(curve)
        legend.add(key if number is None else f"{source.label}: {key}", line)
        alone = not any(artist.get_color() == LINK for artist in axes.lines)
        if request.marks and number is None and source.mechanism.drivers and (alone or _worth_marks(source, curve)):
            mark_inputs(names, curve, source.axis, colour)


def _worth_marks(source: PlotInput, curve: Floats) -> bool:
    """Whether a path is long enough, beside the whole machine, for marks along it."""
    good = curve[np.isfinite(curve).all(axis=1)]
    return len(good) > 2 and float(np.ptp(good, axis=0).max()) > 0.12e3 * extent_of(source.motion)


def _point(source: PlotInput, name: str) -> str:
    found = output_or_point(source.mechanism, name)
    if not found.is_point:
        raise RequestError(
            _(
                '"{name}" is no point of a moving link, so it has no path; name a point, such as jaw.D',
                code="picture.no_path",
                name=name,
            )
        )
    return found.owner
