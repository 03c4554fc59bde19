"""Diagrams of forces: joint forces and their hodographs; effort, power, energy and speed of the input."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.analysis import Kind as SummaryKind
from linkwright.analysis.reactions import size as magnitude
from linkwright.analysis.true_speed import steady_cycle
from linkwright.core.arrays import Floats, largest
from linkwright.core.outputs import Output
from linkwright.core.quantity import significant
from linkwright.core.search import first_largest
from linkwright.cycle.summaries import SummaryValue
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinetostatics.forces import Forces, chosen_pairs
from linkwright.machine.equivalent import Equivalent, equivalent
from linkwright.machine.running import SteadyRunning
from linkwright.machine.speed import SpeedCurve
from linkwright.machine.torque_curve import EnergyFluctuation
from linkwright.pictures.diagram import COLOURS, FAINT, INK, Axes, Figure, new_figure
from linkwright.plotting.diagrams.axes import InputAxis, Legend, Unit, make_force_plane, unit_of
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request, framed
from linkwright.plotting.diagrams.marks import Curve, Names, draw_curve, jumps, mark_inputs, write_names
from linkwright.plotting.diagrams.panels import Level, OverInput, Panel, with_mean
from linkwright.plotting.diagrams.source import Extremes, PlotInput, joint_and_link, known_link, loaded, main_output
from linkwright.words import _


@DIAGRAMS.register("reactions")
class Reactions(OverInput):
    """Sizes of the forces in all joints, or in those that ``of`` names.

    Of one joint: size, and components in the frame's or a link's axes.
    """

    title = _("joint forces")
    options = ("of", "joint", "on", "axes", "static")

    def output(self, source: PlotInput, request: Request) -> Output | None:
        return main_output(source.motion)

    def subject(self, sources: Sequence[PlotInput], request: Request) -> str:
        if request.joint is None and request.on is None:
            return request.translate(self.title)
        joint, link = joint_and_link(sources[0].forces, request.joint, request.on)
        return request.translate(_("force of joint {joint} on {link}", joint=joint, link=link))

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        require_forces(source.forces)
        if request.joint is None and request.on is None:
            return [_of_all(source, request)]
        return _of_one(source, request)


def require_forces(forces: Forces) -> None:
    """Raises LinkwrightError where no joint carries anything."""
    if not loaded(forces):
        raise RequestError(
            _(
                'no joint of "{name}" carries a force: its links have no mass and there are no '
                "loads; give masses (mass: 5 kg) or loads (loads: …)",
                code="picture.no_forces",
                name=forces.mechanism.name,
            )
        )


def _of_all(source: PlotInput, request: Request) -> Panel:
    mechanism, sizes, signals = source.mechanism, {}, {}
    for joint, link in chosen_pairs(mechanism, request.of):
        force = source.closed(source.forces.reaction(joint, on=link))
        shared = len(mechanism.joints[joint].joined) > 2
        label = f"{joint} ({link})" if shared else joint
        sizes[label], signals[label] = np.hypot(force[:, 0], force[:, 1]), magnitude(joint, link)
    marked = list(sizes)[first_largest(np.array([largest(each) for each in sizes.values()]))]
    curves = []
    for label, values in sizes.items():
        exact = source.extremes(signals[label], "forces")
        curves.append(Curve(label, values, "max" if label == marked else "", extremes=exact))
    return Panel(request.translate(_("joint force")) + " F", "force", tuple(curves))


def _of_one(source: PlotInput, request: Request) -> list[Panel]:
    translate = request.translate
    joint, link = joint_and_link(source.forces, request.joint, request.on)
    axes = request.axes or "frame"
    force = source.closed(source.forces.reaction(joint, on=link, axes=axes))

    def exact(component: int) -> Extremes:
        return source.extremes(lambda f: f.reaction(joint, on=link, axes=axes)[:, component], "forces")

    named = "xy" if axes == "frame" else ("ξ", "η")
    parts = [
        Curve(f"F{name}", force[:, i], "largest", COLOURS[1 + i], extremes=exact(i)) for i, name in enumerate(named)
    ]
    exact_size = source.extremes(magnitude(joint, link), "forces")
    total = Curve("", np.hypot(force[:, 0], force[:, 1]), "max", extremes=exact_size)
    title = translate(_("components")) if axes == "frame" else translate(_("components in {link}", link=axes))
    return [Panel(translate(_("joint force")) + " F", "force", (total,)), Panel(title, "force", tuple(parts))]


@DIAGRAMS.register("shaking")
class Shaking(OverInput):
    """What the inertia of the moving links does to the frame: force with its components, moment about the origin."""

    title = _("shaking force and moment")
    options = ("static",)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        translate, forces = request.translate, source.forces
        require_forces(forces)
        force = source.closed(forces.shaking_force)
        size = source.extremes(lambda f: np.hypot(*f.shaking_force.T), "forces")
        curves = (
            Curve("Fx", force[:, 0], "", COLOURS[1]),
            Curve("Fy", force[:, 1], "", COLOURS[2]),
            Curve("F", np.hypot(*force.T), "max", COLOURS[0], extremes=size),
        )
        turning = source.extremes(lambda f: f.shaking_moment, "forces")
        moment = Curve("", source.closed(forces.shaking_moment), "both", extremes=turning)
        return [
            Panel(translate(_("shaking force")) + " F", "force", curves),
            Panel(translate(_("shaking moment")) + " M", "torque", (moment,)),
        ]


@DIAGRAMS.register("hodograph")
class Hodograph(Kind):
    """The end of the force that a joint exerts on a link, drawn from one origin over the cycle.

    Left in the frame's axes, right in the link's: where the force goes round in space, and on the link's own pin.
    With ``axes`` one of the two alone. Both scales of an axis pair are equal; inputs are marked along the curve.
    """

    title = _("hodograph of a joint force")
    options = ("joint", "on", "axes", "static")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        require_forces(sources[0].forces)
        joint, link = joint_and_link(sources[0].forces, request.joint, request.on)
        views = ("frame", link) if request.axes is None else (request.axes,)
        for view in views:
            known_link(sources[0].mechanism, view)
        figure = new_figure(request.size or (4.6 * len(views) + 0.8 * (len(views) == 1), 4.9))
        legend = Legend()
        names = [
            draw_hodograph(place, sources, (joint, link, view), request, legend)
            for place, view in zip(figure.subplots(1, len(views), squeeze=False)[0], views, strict=True)
        ]
        subject = request.translate(_("hodograph of the force of joint {joint} on {link}", joint=joint, link=link))
        framed(figure, request.titled(sources[0].label if len(sources) == 1 else "", subject), request, legend)
        write_names(figure, names)
        return figure


def draw_hodograph(
    axes: Axes,
    sources: Sequence[PlotInput],
    what: tuple[str, str, str],
    request: Request,
    legend: Legend,
    *,
    largest: bool = True,
) -> Names:
    """One hodograph, and what is to be named in it: ``what`` is the joint, the link on which it acts, and the link in
    whose axes it is drawn; ``largest``: whether the largest force is an arrow that the legend names."""
    view, noted = what[2], Names(axes)
    translate = request.translate
    curves = [_hodograph(source, what) for source in sources]
    unit = unit_of("force", curves)
    for number, (source, curve) in enumerate(zip(sources, curves, strict=True)):
        colour = COLOURS[number % len(COLOURS)]
        line = draw_curve(axes, curve * unit.factor, jumps(source), colour)
        noted.line(curve * unit.factor)
        if len(sources) > 1:
            legend.add(source.label, line)
        elif request.marks and curve.any():
            mark_inputs(noted, curve * unit.factor, source.axis, colour)
            if largest:
                _largest(axes, source, what, curve, unit, legend, request)
    axes.set_title(
        translate(_("in the axes of the frame"))
        if view == "frame"
        else translate(_("in the axes of {link}", link=view)),
        color=INK,
    )
    make_force_plane(axes, unit, "xy" if view == "frame" else "ξη")
    if not any(curve.any() for curve in curves):
        axes.update_datalim([(-1.0, -1.0), (1.0, 1.0)])
    return noted


def _hodograph(source: PlotInput, what: tuple[str, str, str]) -> Floats:
    """The joint force (n, 2) N, zero where a joint carries nothing but rounding."""
    joint, link, view = what
    found = source.closed(source.forces.reaction(joint, on=link, axes=view))
    return found if np.nanmax(np.abs(found), initial=0.0) > source.forces.rounding else np.zeros_like(found)


def _largest(
    axes: Axes,
    source: PlotInput,
    what: tuple[str, str, str],
    curve: Floats,
    unit: Unit,
    legend: Legend,
    request: Request,
) -> None:
    """The largest force as an arrow from the origin: between the positions, where it can be found there."""
    joint, link, view = what
    size = magnitude(joint, link)
    found = source.extremes(size, "forces")("max")
    if found is not None and np.isfinite(found.value):
        forces, (row,) = Analysis.of(source.forces).resolver.forces_at([(size, found.time, found.value)])
        force, length = forces.reaction(joint, on=link, axes=view)[row], found.value
    else:
        force = curve[first_largest(np.hypot(curve[:, 0], curve[:, 1]))]
        length = float(np.hypot(*force))
    x, y = force * unit.factor
    axes.annotate(
        "",
        (x, y),
        (0, 0),
        arrowprops={
            "arrowstyle": "-|>",
            "color": FAINT,
            "linewidth": 1.1,
            "mutation_scale": 11,
            "shrinkA": 0,
            "shrinkB": 0,
        },
        zorder=3,
    )
    legend.line(request.translate(_("largest force {value}", value=unit.text(length))), FAINT, "-")


#: Panels in a row, and inches of one.
ROW, WIDE, HIGH = 3, 3.3, 3.1


@DIAGRAMS.register("hodographs")
class Hodographs(Kind):
    """A hodograph of every joint force, or of the joints that ``of`` names, in the axes of the frame."""

    title = _("hodographs of all joint forces")
    options = ("of", "static")

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Figure:
        require_forces(sources[0].forces)
        pairs = chosen_pairs(sources[0].mechanism, request.of)
        columns = min(ROW, len(pairs))
        rows = -(-len(pairs) // columns)
        figure = new_figure(request.size or (WIDE * columns, HIGH * rows))
        places = list(figure.subplots(rows, columns, squeeze=False).flat)
        legend = Legend()
        names = []
        for place, (joint, link) in zip(places, pairs, strict=False):
            view = (joint, link, "frame")
            names.append(draw_hodograph(place, sources, view, request, legend, largest=False))
            place.set_title(request.translate(_("{joint}, force on {link}", joint=joint, link=link)), color=INK)
        for place in places[len(pairs) :]:
            place.set_axis_off()
        framed(figure, request.titled(sources[0].label if len(sources) == 1 else ""), request, legend)
        write_names(figure, names)
        return figure


@DIAGRAMS.register("torque")
class Torque(OverInput):
    """Driver effort from the joint forces: torque of a turning driver, force of a sliding one; one panel a driver."""

    title = _("what the driver must supply")
    options = ("static",)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        return main_output(source.motion)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        motion, forces, translate = source.motion, source.forces, request.translate
        if not motion.mechanism.drivers:
            raise RequestError(
                _(
                    '"{name}" has no driver, so it has no input torque',
                    code="picture.no_torque",
                    name=motion.mechanism.name,
                )
            )
        found = []
        several = len(motion.mechanism.drivers) > 1
        for name in motion.mechanism.drivers:
            turning = motion.positions.rotary[name]
            effort = forces.driver_effort(name)
            exact = source.extremes(partial(Forces.driver_effort, name=name), "forces")
            dimension = "torque" if turning else "force"
            word = translate(_("input torque") if turning else _("driving force"))
            title = f"{word} {'T' if turning else 'F'}{f' {name}' if several else ''}"
            curve = Curve("", source.closed(effort), "both", extremes=exact)
            mean = Analysis.of(forces).mean_of(partial(Forces.driver_effort, name=name))
            found.append(with_mean(title, dimension, curve, mean, request, f"{name}: " if several else ""))
        return found


@DIAGRAMS.register("power")
class Power(OverInput):
    """Power that all drivers supply together, from the powers of all forces."""

    title = _("power of the driver")
    options = ("static",)

    def output(self, source: PlotInput, request: Request) -> Output | None:
        return main_output(source.motion)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        power = source.forces.power
        curve = Curve("", source.closed(power), "both", extremes=source.extremes(_total, "forces"))
        mean = Analysis.of(source.forces).mean_of(_total)
        return [with_mean(request.translate(_("power")) + " P", "power", curve, mean, request)]


def _total(forces: Forces) -> Floats:
    return forces.power


@DIAGRAMS.register("energy")
class Energy(OverInput):
    """Torque at constant speed with its mean and the areas between, and the energy E(φ) that the areas leave.

    ΔE = max E - min E is what a flywheel has to take up. Angles are those turned from the cycle's begin.
    """

    title = _("energy over the cycle")
    options = ("static",)

    def axis(self, source: PlotInput) -> InputAxis:
        reduced, found = _reduced(source)
        return InputAxis("angle", reduced.start + reduced.direction * found.angle)

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        translate = request.translate
        reduced, found = _reduced(source)
        place = reduced.start + reduced.direction * np.append(reduced.angle, reduced.period)
        steady = reduced.torque + 0.5 * reduced.slope * reduced.speed**2
        torque = reduced.direction * np.append(steady, steady[0])
        mean = reduced.direction * reduced.load.mean
        title = translate(_("input torque")) + " T"
        curve = Curve("", torque, "both", x=place, extremes=_of_torque(reduced))
        change = translate(
            _("energy fluctuation ΔE = {value}", value=unit_of("energy", [found.energy]).text(found.value))
        )
        return [
            with_mean(title, "torque", curve, mean, request, fill=True),
            Panel(translate(_("energy")) + " E", "energy", (Curve(change, found.energy, "both"),)),
        ]


def _of_torque(reduced: Equivalent) -> Extremes | None:
    """Extremes of the driver's torque at constant speed."""
    forces = reduced.forces
    if forces.static:
        return None
    return lambda kind: Analysis.of(forces).extreme(lambda each: each.input_torque, kind, of="forces")


def _reduced(source: PlotInput) -> tuple[Equivalent, EnergyFluctuation]:
    if source.result_running is not None:
        return source.result_running.equivalent, source.result_running.energy
    reduced = source.once("energy", lambda: equivalent(source.forces))
    return reduced, reduced.energy


@DIAGRAMS.register("speed")
class Speed(OverInput):
    """ω(φ) of steady running under a constant motor torque: with the flywheel for a required δ, and without any."""

    title = _("speed over the cycle")
    options = ("fluctuation", "static")

    def axis(self, source: PlotInput) -> InputAxis:
        if source.result_running is None:
            return source.axis
        reduced = source.result_running.equivalent
        return InputAxis("angle", reduced.start + reduced.direction * np.array([0.0, reduced.period]))

    def panels(self, source: PlotInput, request: Request) -> list[Panel]:
        running = source.once(f"running {request.fluctuation}", lambda: source.running(request.fluctuation))
        translate, mean = request.translate, running.equivalent.speed
        title = translate(_("speed of the input")) + " ω"
        level = Level(translate(_("mean {value}", value=f"{significant(mean)} rad/s")), mean)
        first = _speed_curve(
            running, running.exact_speed, running.exact_flywheel, translate(_("with flywheel")), COLOURS[0]
        )
        found = [Panel(title, "angular_velocity", (first,), (level,))]
        alone = _alone(running) if running.exact_flywheel > 0 else None
        if alone is not None:
            bare = _speed_curve(running, alone, 0.0, translate(_("without flywheel")), COLOURS[4])
            found.append(Panel(title, "angular_velocity", (bare,), (level,)))
        return found


def _speed_curve(running: SteadyRunning, speed: SpeedCurve, flywheel: float, name: str, colour: str) -> Curve:
    inertia = f", J = {significant(flywheel)} kg·m²" if flywheel else ""
    label = f"{name}{inertia}: δ = {significant(speed.fluctuation, 3)}"
    reduced = running.equivalent

    def exact(kind: SummaryKind) -> SummaryValue:
        angle, value = speed.fastest if kind == "max" else speed.slowest
        return SummaryValue(value, angle / reduced.speed, reduced.input_at(angle), True)

    x = reduced.start + reduced.direction * speed.angle
    return Curve(label, speed.speed, "both", colour, x=x, extremes=exact)


def _alone(running: SteadyRunning) -> SpeedCurve | None:
    """The speed without a flywheel; None where the machine would stop within its cycle."""
    try:
        return steady_cycle(running.equivalent.forces)[1].curve(motor_torque=running.mean_torque)
    except LinkwrightError:
        return None
