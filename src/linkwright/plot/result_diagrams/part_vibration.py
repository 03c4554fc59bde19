"""Diagrams of vibration: responses over frequency and time, followers, machines on mounts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from linkwright.parts.vibration.follower import FollowerVibration
from linkwright.parts.vibration.mounts import TITLES, Shaken
from linkwright.parts.vibration.system import Vibration
from linkwright.plot.diagrams.base import RESULT_DIAGRAMS, Request, ResultKind
from linkwright.plot.result_diagrams.part_axes import Line, Pane, panes

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@RESULT_DIAGRAMS.register("vibration_response")
class VibrationDiagram(ResultKind):
    """Amplitudes over frequency, displacements over time, or the modes."""

    name = "vibration_response"
    takes = Vibration

    def draw(self, result: Vibration, request: Request) -> Figure:
        names = list(result.system.masses)
        title = request.titled(result.title, request.say("kind.vibration_response"))
        length = "angle" if result.system.turning else "length"
        if result.in_time:
            time, moved = result.response()
            lines = tuple(Line(time, moved[:, i], name) for i, name in enumerate(names))
            return panes(title, (request.say("time"), "time"), [Pane("x", length, lines)], request)
        if result.harmonic:
            frequency, amplitudes = result.sweep()
            hertz = frequency / (2 * math.pi)
            size = tuple(Line(hertz, np.abs(amplitudes[:, i]), name) for i, name in enumerate(names))
            turn = tuple(
                Line(hertz, np.unwrap(np.angle(amplitudes[:, i])), name) for i, name in enumerate(names)
            )
            passed = (Line(hertz, result.transmissibility(frequency)),)
            given = [
                Pane("|X|", length, size, log=True),
                Pane("∠X", "angle", turn),
                Pane("T", "", passed, log=True),
            ]
            return panes(title, (request.say("frequency"), "frequency"), given, request, logx=True)
        place = np.arange(1.0, len(names) + 1)
        shapes = tuple(
            Line(place, result.shapes[:, i], f"{f / (2 * math.pi):.4g} Hz")
            for i, f in enumerate(result.frequencies)
        )
        return panes(title, (", ".join(names), ""), [Pane("φ", "", shapes)], request)


@RESULT_DIAGRAMS.register("follower_vibration")
class FollowerDiagram(ResultKind):
    """Cam and follower over time, and the residual spectrum of the law."""

    name = "follower_vibration"
    takes = FollowerVibration

    def draw(self, result: FollowerVibration, request: Request) -> Figure:
        time, cam, follower = result.curves
        given = [
            Pane("s, x", "length", (Line(time, cam, "s"), Line(time, follower, "x", dash="--"))),
            Pane("x − s", "length", (Line(time, follower - cam),)),
        ]
        title = request.titled(result.title, request.say("kind.follower_vibration"))
        return panes(title, (request.say("time"), "time"), given, request)


@RESULT_DIAGRAMS.register("residual_spectrum")
class ResidualDiagram(ResultKind):
    """Residual amplitude over the ratio of rise time and natural period."""

    name = "residual_spectrum"
    takes = FollowerVibration
    usual = False

    def draw(self, result: FollowerVibration, request: Request) -> Figure:
        n = np.linspace(0.2, max(6.0, 1.3 * result.ratio), 1200)
        pane = Pane("A", "length", (Line(n, result.residual(n)),), log=True)
        title = request.titled(result.title, request.say("kind.residual_spectrum"))
        return panes(title, ("n = T/Tₙ", ""), [pane], request)


@RESULT_DIAGRAMS.register("mounts")
class MountsDiagram(ResultKind):
    """Shaking force, motion of the machine and force on the ground over a cycle."""

    name = "mounts"
    takes = Shaken

    def draw(self, result: Shaken, request: Request) -> Figure:
        columns = result.columns()
        time = columns["time [s]"]
        given = [
            Pane(symbol, dimension, tuple(Line(time, columns[name.format(axis)], axis) for axis in "xy"))
            for symbol, name, dimension in (
                ("F", "shaking force {} [N]", "force"),
                ("X", "machine {} [m]", "length"),
                ("G", "force on ground {} [N]", "force"),
            )
        ]
        for symbol, (name, dimension) in (
            zip("MθG", TITLES["turn"], strict=True) if "turn" in result.axes else ()
        ):
            given.append(Pane(symbol, dimension, (Line(time, columns[name]),)))
        title = request.titled(result.title, request.say("kind.mounts"))
        return panes(title, (request.say("time"), "time"), given, request)
