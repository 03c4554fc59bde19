"""Angles of links over the input, with their rates."""

from __future__ import annotations

from functools import partial

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.errors import RequestError
from linkwright.kinematics.motion import Motion
from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.marks import Curve
from linkwright.plot.diagrams.outputs import known_link, main_output, turning_links
from linkwright.plot.diagrams.panels import OverInput, Panel, look
from linkwright.plot.diagrams.source import TURN, Source


@DIAGRAMS.register("angles")
class Angles(OverInput):
    """Angle, angular velocity and angular acceleration of several links, each link a curve."""

    options = ("of",)

    def output(self, source: Source, request: Request) -> Output | None:
        if len(request.of) == 1:
            return Output("angle", request.of[0])
        return None if request.of else main_output(source.motion)

    def panels(self, source: Source, request: Request) -> list[Panel]:
        motion, say = source.motion, request.say
        links = [known_link(motion.mechanism, name) for name in request.of] or turning_links(motion)
        if not links:
            raise RequestError("picture.none_turns", name=motion.mechanism.name)
        shown = [source.closed(motion.link(name).angle, turns=True) for name in links]
        change = _flat(shown)
        omega = [source.closed(motion.link(name).angular_velocity) for name in links]
        alpha = [source.closed(motion.link(name).angular_acceleration) for name in links]
        angle = [
            values - values[np.isfinite(values)][0] if change else _near_zero(values) for values in shown
        ]
        return [
            Panel(say("angle_change") if change else f"{say('angle')} θ", "angle",
                  _curves(source, links, angle, "angle")),
            Panel(f"{say('angular_velocity')} ω", "angular_velocity",
                  _curves(source, links, omega, "angular_velocity")),
            Panel(f"{say('angular_acceleration')} α", "angular_acceleration",
                  _curves(source, links, alpha, "angular_acceleration")),
        ]  # fmt: skip


def _curves(source: Source, links: list[str], values: list[Floats], quantity: str) -> tuple[Curve, ...]:
    if len(links) > 1:
        pairs = enumerate(zip(links, values, strict=True))
        return tuple(Curve(name, each, "", *look(number)) for number, (name, each) in pairs)
    signal = partial(_of_link, name=links[0], quantity=quantity)
    exact = source.angle_extremes(signal, values[0]) if quantity == "angle" else source.extremes(signal)
    return (Curve(links[0], values[0], "both", *look(0), extremes=exact),)


def _of_link(motion: Motion, name: str, quantity: str) -> Floats:
    """Angle of a link or a rate of it, (n,)."""
    return np.asarray(getattr(motion.link(name), quantity))


def _flat(angles: list[Floats]) -> bool:
    """Whether the angles lie so far apart that their changes would not be seen in one panel."""
    placed = [_near_zero(each)[np.isfinite(each)] for each in angles]
    every = np.concatenate(placed)
    return len(angles) > 1 and max(float(np.ptp(each)) for each in placed) < 0.25 * float(np.ptp(every))


def _near_zero(angle: Floats) -> Floats:
    """An angle moved by whole turns so that its middle lies within half a turn of zero."""
    good = angle[np.isfinite(angle)]
    if not len(good):
        return angle
    middle = 0.5 * (good.min() + good.max())
    return np.asarray(angle - TURN * np.round(middle / TURN * (1 - 1e-12)))
