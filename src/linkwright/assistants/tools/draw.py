"""A picture of a machine."""

from __future__ import annotations

import base64
from typing import Annotated, Literal

from pydantic import Field

from linkwright.assistants.answers import Answer, NextAction
from linkwright.assistants.failures import as_warnings, entries, of_notes
from linkwright.assistants.positions import positions_at
from linkwright.assistants.tool import Desk, Model
from linkwright.core.arguments import DRAWING_STEPS
from linkwright.errors import Finding, LinkwrightError, RequestError
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plotting.drawing.draw import draw
from linkwright.words import _
from linkwright.words.message import in_language

#: Characters of SVG that are given; dots per inch of curves.
LONGEST, DOTS = 120_000, 100.0


class DrawAnswer(Answer):
    """What the picture shows; the picture itself is the image beside this text."""

    width: int = Field(default=0, description="width of the PNG image, pixels")
    svg: str = Field(default="", description="the same picture as SVG text where it was asked for")


def draw_machine(
    desk: Desk,
    model: Model,
    at: Annotated[
        str,
        Field(
            description=(
                "Position that is drawn: an input of the first driver '30 deg', a time '0.5 s', or a limit position "
                "'rocker max'. Empty (default): the first position of the cycle that is reached."
            )
        ),
    ] = "",
    paths: Annotated[
        list[str], Field(description="Points whose paths over the cycle are drawn, such as ['P', 'rocker.D'].")
    ] = [],
    ghosts: Annotated[
        str,
        Field(
            description=(
                "Further positions beneath it: 'limits' (both limit positions of the last output), 'limits:rocker' "
                "(of a link or guide), 'faded:8' (eight over the cycle). Empty (default): none."
            )
        ),
    ] = "",
    velocities: Annotated[bool, Field(description="true: arrows of the velocities of all points.")] = False,
    forces: Annotated[
        bool, Field(description="true: arrows of joint forces and loads (needs masses or loads).")
    ] = False,
    dimensions: Annotated[
        bool, Field(description="true: dimension lines with lengths and angles of all links.")
    ] = False,
    curves: Annotated[
        Literal["none", "sva", "angles", "torque", "power", "reactions", "hodographs"],
        Field(
            description=(
                "Curves over the cycle as a second picture. sva: place, velocity and acceleration of the output; "
                "angles: of all links; torque, power: of the driver; reactions: joint forces; hodographs: of joint "
                "forces."
            )
        ),
    ] = "none",
    width: Annotated[int, Field(ge=200, le=1600, description="Width of the picture in pixels.")] = 800,
    svg: Annotated[bool, Field(description="true: the picture also as SVG text, for a file of your own.")] = False,
) -> DrawAnswer:
    """Draw a machine in the standard symbols of the theory of machines, as a PNG picture in the answer; with curves
    over the cycle as a second picture.

    Use it to see whether a model is the machine that is meant: wrong branch, crossed links, a gap, paths of points,
    limit positions. Do not read numbers off it: solve_machine and get_metrics give them. For a document use
    write_report.

    It also draws a machine that does not pass its whole cycle, at a position that it reaches, with a warning. No file
    is written. x points right, y up. Comes back: one or two PNG images, notes on what was asked for and cannot be
    seen; SVG if asked.
    """
    mechanism, findings = desk.source(model).mechanism()
    inputs, time = _place(mechanism, at)
    motion = solve_motion(mechanism, steps=DRAWING_STEPS, failures="mark")
    drawing = draw(
        motion,
        at=inputs,
        time=time,
        overlay=ghosts or (),
        paths=paths,
        velocities=velocities,
        forces=forces or None,
        dimensions=dimensions,
        language=desk.language,
    )
    findings = [*findings, *of_notes((*motion.notes, *drawing.notes))]
    if not motion.complete and motion.ok.any():
        findings += as_warnings(motion.refusal())
    images = [drawing.png(width=width)]
    if curves != "none":
        more, hindered = _curves(mechanism, curves, desk.language)
        images += more
        findings += hindered
    if svg and len(drawing.svg) > LONGEST:
        findings.append(
            Finding("warning", "", "svg", _("the SVG text is too long for an answer"), "", "assistants.long")
        )
    found = DrawAnswer(
        ok=True,
        summary=in_language(_("{name}, drawn {width} pixels wide", name=mechanism.name, width=width), desk.language),
        findings=entries(findings, desk.language),
        next=[NextAction(tool="solve_machine", why="the numbers of this position")],
        width=width,
        svg=drawing.svg if svg and len(drawing.svg) <= LONGEST else "",
    )
    found.pictures.extend(base64.b64encode(each).decode() for each in images)
    return found


def _curves(mechanism: Mechanism, kind: str, language: str) -> tuple[list[bytes], list[Finding]]:
    """The picture of curves over the cycle, or what hinders it."""
    from linkwright.plotting.diagrams.base import plot

    try:
        return [plot(mechanism, kind, language=language).content(".png", dpi=DOTS)], []
    except LinkwrightError as error:
        return [], as_warnings(error)


def _place(mechanism: Mechanism, at: str) -> tuple[dict[str, float] | None, float | None]:
    """The position that is drawn: inputs of several drivers, or a time, s; neither for the first one."""
    if not at.strip():
        return None, None
    motion = positions_at(mechanism, at)
    if motion.steps != 1:
        raise RequestError(_('"{text}" is more than one position; give one', code="draw.one_position", text=at))
    if "=" in at:
        return {name: float(values[0]) for name, values in motion.inputs.items()}, None
    return None, float(motion.time[0])
