"""A picture of a machine."""

from __future__ import annotations

import base64
from typing import Annotated

from pydantic import Field

from linkwright.assistants.answers import Answer, NextAction
from linkwright.assistants.failures import entries
from linkwright.assistants.tool import Desk, Model
from linkwright.core.arguments import DRAWING_STEPS
from linkwright.errors import Finding, RequestError
from linkwright.events.position_list import known_outputs, of_text
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plotting.drawing.draw import draw
from linkwright.words import _
from linkwright.words.message import code_of, in_language

#: Characters of SVG that are given.
LONGEST = 120_000


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
    width: Annotated[int, Field(ge=200, le=1600, description="Width of the picture in pixels.")] = 800,
    svg: Annotated[bool, Field(description="true: the picture also as SVG text, for a file of your own.")] = False,
) -> DrawAnswer:
    """Draw a machine in the standard symbols of the theory of machines, as a PNG picture in the answer.

    Use it to see whether a model is the machine that is meant: wrong branch, crossed links, a gap, paths of points,
    limit positions. It also draws a model that does not pass its whole cycle, at a position that it reaches. Do not
    read numbers off it: solve_machine gives them. It reads only; no file is written.
    x points right, y up. Comes back: a PNG image, its width, notes on what was asked for and cannot be seen; SVG if
    asked.
    """
    mechanism, findings = desk.source(model).mechanism()
    motion = solve_motion(mechanism, steps=DRAWING_STEPS, failures="mark")
    drawing = draw(
        motion,
        time=_time(mechanism, at),
        overlay=ghosts or (),
        paths=paths,
        velocities=velocities,
        forces=forces or None,
        dimensions=dimensions,
        language=desk.language,
    )
    findings = [
        *findings,
        *(Finding("note", "", "", each, "", code_of(each)) for each in (*motion.notes, *drawing.notes)),
    ]
    if not motion.complete and motion.ok.any():
        refusal = motion.refusal()
        findings.append(Finding("warning", "", "", refusal.sentence, "", refusal.code))
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
    found.pictures.append(base64.b64encode(drawing.png(width=width)).decode())
    return found


def _time(mechanism: Mechanism, at: str) -> float | None:
    """When the position is passed that is drawn, s; None for the first one."""
    if not at.strip():
        return None
    if not mechanism.drivers:
        raise RequestError(_("the model has no driver, so there is no input to set", code="solve.no_input"))
    listed = of_text(at, (mechanism.across, "time"))
    known_outputs(mechanism, listed)
    motion = listed.solved(mechanism)
    if motion.steps != 1:
        raise RequestError(_('"{text}" is more than one position; give one', code="draw.one_position", text=at))
    return float(motion.time[0])
