"""Joint forces, and what the inertia of the links does to the frame, over the input."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import largest
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.errors import RequestError
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.force_names import chosen_pairs
from linkwright.metrics.reactions import size as magnitude
from linkwright.pictures.diagram import COLOURS
from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.marks import Curve
from linkwright.plot.diagrams.outputs import joint_and_link, loaded, main_output
from linkwright.plot.diagrams.panels import OverInput, Panel, look
from linkwright.plot.diagrams.source import Extremes, Source


@DIAGRAMS.register("reactions")
class Reactions(OverInput):
    """Sizes of the forces in all joints, or in those that ``of`` names.

    Of one joint: size, and components in the frame's or a link's axes.
    """

    options = ("of", "joint", "on", "axes", "static")

    def output(self, source: Source, request: Request) -> Output | None:
        return main_output(source.motion)

    def subject(self, sources: Sequence[Source], request: Request) -> str:
        if request.joint is None and request.on is None:
            return request.say("kind.reactions")
        joint, link = joint_and_link(sources[0].forces, request.joint, request.on)
        return request.say("reaction_on", joint=joint, link=link)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        require_forces(source.forces)
        if request.joint is None and request.on is None:
            return [_of_all(source, request)]
        return _of_one(source, request)


def require_forces(forces: Forces) -> None:
    """Raises LinkwrightError where no joint carries anything."""
    if not loaded(forces):
        raise RequestError("picture.no_forces", name=forces.mechanism.name)


def _of_all(source: Source, request: Request) -> Panel:
    mechanism, sizes, signals = source.mechanism, {}, {}
    for joint, link in chosen_pairs(mechanism, request.of):
        force = source.closed(source.forces.reaction(joint, on=link))
        shared = len(mechanism.joints[joint].joined) > 2
        label = f"{joint} ({link})" if shared else joint
        sizes[label], signals[label] = np.hypot(force[:, 0], force[:, 1]), magnitude(joint, link)
    marked = list(sizes)[first_largest(np.array([largest(each) for each in sizes.values()]))]
    curves = []
    for number, (label, values) in enumerate(sizes.items()):
        exact = source.extremes(signals[label], "forces")
        curves.append(Curve(label, values, "max" if label == marked else "", *look(number), extremes=exact))
    return Panel(f"{request.say('joint_force')} F", "force", tuple(curves))


def _of_one(source: Source, request: Request) -> list[Panel]:
    say = request.say
    joint, link = joint_and_link(source.forces, request.joint, request.on)
    axes = request.axes or "frame"
    force = source.closed(source.forces.reaction(joint, on=link, axes=axes))

    def exact(component: int) -> Extremes:
        return source.extremes(lambda f: f.reaction(joint, on=link, axes=axes)[:, component], "forces")

    named = "xy" if axes == "frame" else ("ξ", "η")
    parts = [
        Curve(f"F{name}", force[:, i], "largest", COLOURS[1 + i], extremes=exact(i))
        for i, name in enumerate(named)
    ]
    exact_size = source.extremes(magnitude(joint, link), "forces")
    total = Curve("", np.hypot(force[:, 0], force[:, 1]), "max", extremes=exact_size)
    title = say("components") if axes == "frame" else say("components_in", link=axes)
    return [
        Panel(f"{say('joint_force')} F", "force", (total,)),
        Panel(title, "force", tuple(parts)),
    ]


@DIAGRAMS.register("shaking")
class Shaking(OverInput):
    """What the inertia of the moving links does to the frame: force with its components, moment about the origin."""

    options = ("static",)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        say, forces = request.say, source.forces
        require_forces(forces)
        force = source.closed(forces.shaking_force)
        size = source.extremes(lambda f: np.hypot(*f.shaking_force.T), "forces")
        curves = (
            Curve("Fx", force[:, 0], "", COLOURS[1]),
            Curve("Fy", force[:, 1], "", COLOURS[2]),
            Curve("F", np.hypot(*force.T), "max", COLOURS[0], extremes=size),
        )
        turning = source.extremes(lambda f: f.shaking_moment, "forces")
        moment = Curve("", source.closed(forces.shaking_moment), extremes=turning)
        return [
            Panel(f"{say('shaking_force')} F", "force", curves),
            Panel(f"{say('shaking_moment')} M", "torque", (moment,)),
        ]
