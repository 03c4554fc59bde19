"""Diagrams of motion: displacement, velocity and acceleration, angles, transmission angles, paths of points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from operator import methodcaller

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import NAMED, PLACES, Output
from linkwright.errors import RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_or_point
from linkwright.pictures.diagram import COLOURS, Figure, new_figure
from linkwright.plotting.diagrams.axes import Legend, make_plane
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request, framed
from linkwright.plotting.diagrams.marks import LINK, Curve, Names, draw_curve, draw_machine, mark_inputs, write_names
from linkwright.plotting.diagrams.panels import DASHES, OverInput, Panel
from linkwright.plotting.diagrams.source import TURN, PlotInput, known_link, main_output, traced_points, turning_links
from linkwright.plotting.drawing.machine import extent_of
from linkwright.words import Translate, _

ANGULAR = (
    (_("angle"), "θ", "angle"),
    (_("angular velocity"), "ω", "angular_velocity"),
    (_("angular acceleration"), "α", "angular_acceleration"),
)
STRAIGHT = (
    (_("displacement"), "s", "length"),
    (_("velocity"), "v", "velocity"),
    (_("acceleration"), "a", "acceleration"),
)


@DIAGRAMS.register("sva")
class Sva(OverInput):
    """Three panels: angle or displacement, velocity, acceleration of an output; x and y of a point; one panel of a
    force or of a rate that is named."""

    title = _("displacement, velocity, acceleration")
    options = ("of",)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        first, *more = _asked(source, request)
        return first if first.kind in PLACES and not more else None

    def subject(self, sources: Sequence[PlotInput], request: Request) -> str:
        return request.translate(_("motion of {output}", output=", ".join(map(str, _asked(sources[0], request)))))

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        asked = _asked(source, request)
        parts = [_panels(source, each, request.translate) for each in asked]
        if len(asked) == 1:
            return parts[0]
        return _together([(str(each), panels) for each, panels in zip(asked, parts, strict=True)])


def _asked(source: PlotInput, request: Request) -> list[Output]:
    """The outputs and points that are named, each once; else the main output."""
    mechanism, named = source.mechanism, dict[Output, Output]()
    for name in request.of:
        meant = output_or_point(mechanism, name)
        named.setdefault(meant, replace(meant, written=name) if name in mechanism.links else meant)
    return list(named.values()) or [main_output(source.motion)]


def _together(parts: list[tuple[str, list[Panel]]]) -> list[Panel]:
    """Panels of several outputs, each in its colour: those of one quantity hold the curves of all that have it."""
    found: dict[str, Panel] = {}
    for number, (name, panels) in enumerate(parts):
        for panel in panels:
            curves = list(found[panel.title].curves) if panel.title in found else []
            for which, curve in enumerate(panel.curves):
                label = " ".join(filter(None, (name, curve.label)))
                colour, dash = COLOURS[number % len(COLOURS)], DASHES[which % len(DASHES)]
                curves.append(replace(curve, label=label, peak="", colour=colour, dash=dash))
            found[panel.title] = replace(panel, curves=tuple(curves))
    return list(found.values())


def _panels(source: PlotInput, output: Output, translate: Translate) -> list[Panel]:
    if output.kind in NAMED:
        return _of_named(source, output)
    if output.kind not in PLACES:
        return [_of_result(source, output)]
    if output.is_point:
        return _of_point(source, output.owner, translate)
    named = ANGULAR if output.kind == "angle" else STRAIGHT
    found = []
    for (word, symbol, dimension), each in zip(named, output.course, strict=True):
        shown = source.closed(source.motion.read(each), turns=dimension == "angle")
        read = methodcaller("read", each)
        exact = source.angle_extremes(read, shown) if dimension == "angle" else source.extremes(read)
        found.append(Panel(f"{translate(word)} {symbol}", dimension, (Curve("", shown, "both", extremes=exact),)))
    return found


def _of_named(source: PlotInput, output: Output) -> list[Panel]:
    """An output that the model names, with those of its rates that are known."""
    own = source.mechanism.outputs[output.owner].outputs
    return [
        Panel(each.name, each.dimension, (Curve("", source.ended(read), "both", extremes=source.extremes(read)),))
        for each in own[NAMED.index(output.kind) :]
        for read in [methodcaller("read", each)]
    ]


def _size(motion: Motion, key: str, word: str) -> Floats:
    """Size of the velocity or acceleration of a point, (n,)."""
    return np.asarray(np.hypot(*getattr(motion.point_of(key), word).T))


def _of_result(source: PlotInput, output: Output) -> Panel:
    """A force, or a rate that is named alone."""
    solved, read, of = source.course_of(output)
    values = source.closed(read(solved))
    if output.kind != "reaction_direction":
        curve = Curve("", values, "max", extremes=source.extremes(read, of))
        return Panel(output.name, output.dimension, (curve,))
    over = np.abs(np.diff(values, prepend=values[0])) > np.pi  # from -180 to 180 degrees: no line is drawn
    return Panel(output.name, output.dimension, (Curve("", np.where(over, np.nan, values), "both"),))


def _of_point(source: PlotInput, key: str, translate: Translate) -> list[Panel]:
    point = source.motion.point_of(key)
    found = []
    for word, title, symbol, dimension in (
        ("position", _("position"), "r", "length"),
        ("velocity", _("velocity"), "v", "velocity"),
        ("acceleration", _("acceleration"), "a", "acceleration"),
    ):
        shown = source.closed(getattr(point, word))
        curves = [Curve(axis, shown[:, i]) for i, axis in enumerate("xy")]
        if word != "position":
            length = np.hypot(shown[:, 0], shown[:, 1])
            exact = source.extremes(partial(_size, key=key, word=word))
            curves.append(Curve(translate(_("magnitude")), length, "max", extremes=exact))
        found.append(Panel(f"{translate(title)} {symbol}", dimension, tuple(curves)))
    return found


@DIAGRAMS.register("angles")
class Angles(OverInput):
    """Angle, angular velocity and angular acceleration of several links, each link a curve."""

    title = _("angles of the links")
    options = ("of",)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        if len(request.of) == 1:
            return Output("angle", request.of[0])
        return None if request.of else main_output(source.motion)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        motion, translate = source.motion, request.translate
        links = [known_link(motion.mechanism, name) for name in request.of] or turning_links(motion)
        if not links:
            raise RequestError(
                _(
                    'no link of "{name}" turns, so there are no angle curves; draw its sva',
                    code="picture.none_turns",
                    name=motion.mechanism.name,
                )
            )
        shown = [source.closed(motion.link(name).angle, turns=True) for name in links]
        change = _flat(shown)
        omega = [source.closed(motion.link(name).angular_velocity) for name in links]
        alpha = [source.closed(motion.link(name).angular_acceleration) for name in links]
        angle = [values - values[np.isfinite(values)][0] if change else _near_zero(values) for values in shown]
        return [
            Panel(
                translate(_("angle from the start θ − θ₀")) if change else translate(_("angle")) + " θ",
                "angle",
                _curves(source, links, angle, "angle"),
            ),
            Panel(
                translate(_("angular velocity")) + " ω",
                "angular_velocity",
                _curves(source, links, omega, "angular_velocity"),
            ),
            Panel(
                translate(_("angular acceleration")) + " α",
                "angular_acceleration",
                _curves(source, links, alpha, "angular_acceleration"),
            ),
        ]


def _curves(source: PlotInput, links: list[str], values: list[Floats], quantity: str) -> tuple[Curve, ...]:
    if len(links) > 1:
        return tuple(map(Curve, links, values))
    signal = partial(_of_link, name=links[0], quantity=quantity)
    exact = source.angle_extremes(signal, values[0]) if quantity == "angle" else source.extremes(signal)
    return (Curve(links[0], values[0], "both", extremes=exact),)


def _of_link(motion: Motion, name: str, quantity: str) -> Floats:
    """Angle of a link or a rate of it, (n,)."""
    return np.asarray(getattr(motion.link(name), quantity))


def _flat(angles: list[Floats]) -> bool:
    """Whether the angles differ so much that their changes would be invisible in one panel."""
    placed = [_near_zero(each)[np.isfinite(each)] for each in angles]
    every = np.concatenate(placed)
    return len(angles) > 1 and max(float(np.ptp(each)) for each in placed) < 0.25 * float(np.ptp(every))


def _near_zero(angle: Floats) -> Floats:
    """An angle moved by full turns so that its middle lies within half a turn of zero."""
    good = angle[np.isfinite(angle)]
    if not len(good):
        return angle
    middle = 0.5 * (good.min() + good.max())
    return np.asarray(angle - TURN * np.round(middle / TURN * (1 - 1e-12)))


@DIAGRAMS.register("paths")
class Paths(Kind):
    """Curves that points describe, both axes to one scale; the free points of links unless others are named."""

    title = _("paths of points")
    options = ("of",)

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        single = len(sources) == 1
        curves = [_path_curves(source, request) for source in sources]
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


def _path_curves(source: PlotInput, request: Request) -> dict[str, Floats]:
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
    """Whether a path is long enough, relative to the machine, for marks along it."""
    good = curve[np.isfinite(curve).all(axis=1)]
    return len(good) > 2 and float(np.ptp(good, axis=0).max()) > 0.12e3 * extent_of(source.motion)


def _point(source: PlotInput, name: str) -> str:
    found = output_or_point(source.mechanism, name)
    if not found.is_point:
        raise RequestError(
            _(
                '"{name}" is not a point of a moving link, so it has no path; name a point, such as jaw.D',
                code="picture.no_path",
                name=name,
            )
        )
    return found.owner
