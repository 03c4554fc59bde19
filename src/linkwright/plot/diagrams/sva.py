"""Displacement, velocity and acceleration of an output over the input."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.metrics.outputs import rate, second, value
from linkwright.model.signal_fields import Output
from linkwright.plot.diagrams.base import DIAGRAMS, Request
from linkwright.plot.diagrams.outputs import main_output, output_named
from linkwright.plot.diagrams.panels import Curve, OverInput, Panel
from linkwright.plot.diagrams.picture import COLOURS
from linkwright.plot.diagrams.source import Source
from linkwright.words import Say

ANGULAR = (("angle", "θ", "angle"), ("angular_velocity", "ω", "angular_velocity"),
           ("angular_acceleration", "α", "angular_acceleration"))  # fmt: skip
STRAIGHT = (
    ("displacement", "s", "length"),
    ("velocity", "v", "velocity"),
    ("acceleration", "a", "acceleration"),
)


@DIAGRAMS.register("sva")
class Sva(OverInput):
    """Three panels: angle or displacement, velocity, acceleration of an output; x and y of a point."""

    name = "sva"

    def output(self, source: Source, request: Request) -> Output | str | None:
        return output_named(source.mechanism, request.of[0]) if request.of else main_output(source.motion)

    def subject(self, sources: Sequence[Source], request: Request) -> str:
        return request.say("motion_of", output=str(self.output(sources[0], request)))

    def panels(self, source: Source, request: Request) -> list[Panel]:
        output = self.output(source, request)
        if isinstance(output, Output):
            return _of_output(source, output, request.say)
        assert output is not None
        return _of_point(source, output, request.say)


def course(motion: Motion, output: Output) -> tuple[Floats, Floats, Floats]:
    """Value, rate and second derivative of an output, (n,) each."""
    if output.kind in ("angle", "displacement"):
        return value(motion, output), rate(motion, output), second(motion, output)
    column = "xy".index(output.kind)
    point = motion.point(output.owner)
    return point.position[:, column], point.velocity[:, column], point.acceleration[:, column]


def _of_output(source: Source, output: Output, say: Say) -> list[Panel]:
    named = ANGULAR if output.kind == "angle" else STRAIGHT
    found = []
    for (word, symbol, dimension), values in zip(named, course(source.motion, output), strict=True):
        shown = source.closed(values, turns=word == "angle")
        found.append(Panel(f"{say(word)} {symbol}", dimension, (Curve("", shown),)))
    return found


def _of_point(source: Source, key: str, say: Say) -> list[Panel]:
    point = source.motion.point_of(key)
    found = []
    for word, symbol, dimension, values in (
        ("position", "r", "length", point.position),
        ("velocity", "v", "velocity", point.velocity),
        ("acceleration", "a", "acceleration", point.acceleration),
    ):
        shown = source.closed(values)
        curves = [Curve(axis, shown[:, i], "", COLOURS[i]) for i, axis in enumerate("xy")]
        if word != "position":
            length = np.hypot(shown[:, 0], shown[:, 1])
            curves.append(Curve(say("magnitude"), length, "max", COLOURS[2]))
        found.append(Panel(f"{say(word)} {symbol}", dimension, tuple(curves)))
    return found
