"""``linkwright animate``: a model's cycle as a moving picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import ONE_VALUE, UsageError
from linkwright.cli.options import Options, count, model, option, switch
from linkwright.cli.pictures import (
    arrows,
    cycle,
    cycle_steps,
    names,
    names_or_all,
    picture_file,
    refuse_unknown_marks,
    told,
)
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces

SUMMARY = _("the moving drawing, as SVG, GIF or MP4")
DESCRIPTION = _(
    """\
Shows one cycle of a mechanism as a moving drawing, with traces of points, arrows
and curves whose cursor runs along. An open cycle runs to and fro. A moving SVG
runs by itself in browsers and readme files."""
)
EXAMPLES = """\
linkwright animate gallery:theo_jansen_leg --paths leg.T --output leg.svg
linkwright animate crusher.yaml --paths C --curves jaw.angle --output crusher.gif
linkwright animate crusher.yaml --forces --curves driver.effort --seconds 4 --output crusher.mp4"""

ENDINGS = (".svg", ".gif", ".mp4")
FRAMES = 60
WIDTH = 640


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@model
@cycle_steps(STEPS)
@option(
    "--paths",
    "POINT",
    "--traces",
    help=_("paths of points with a dot that runs along: C,jaw.D"),
    several=True,
)
@option(
    "--curves",
    "RESULT",
    help=_("results drawn below: jaw.angle, C.velocity.x; with --forces also driver.effort"),
    several=True,
)
@arrows
@switch("--labels", True, help=_("names of points"))
@option(
    "--seconds", "TIME", help=_("time of one cycle on the screen (default: the true one, within 2 to 6 s)")
)
@count("--frames", FRAMES, help=_("positions shown in one cycle (default: {frames})", frames=FRAMES))
@picture_file(_("write FILE.svg, FILE.gif or FILE.mp4"))
def run(options: Options, session: Session) -> int:
    """Writes the moving picture; 1 where positions of the cycle were left out."""
    from linkwright.cli.files import refuse_output
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.plotting.animation import animate

    refuse_output(options.output, ENDINGS, force=options.force)
    seconds = _seconds(options.seconds)
    mechanism, _unused = read_model(options.file, session)
    refuse_unknown_marks(mechanism, options)
    motion = cycle(mechanism, max(options.steps, options.frames), session)
    forces = _forces(motion, options)
    animation = animate(
        motion,
        paths=names(options.paths),
        velocities=names_or_all(options.velocities),
        accelerations=names_or_all(options.accelerations),
        forces=forces,
        reactions_of=names(options.forces) or None,
        curves=names(options.curves),
        seconds=seconds,
        frames=options.frames,
        centres=options.centres,
        labels=options.labels,
        size=options.width,
        language=session.language,
    )
    with progress(session, _("drawing")) as report:
        path = animation.save(options.output, width=options.width or WIDTH, progress=report, force=True)
    told(path, options, session)
    return int(not motion.complete)


def _forces(motion: Motion, options: Options) -> Forces | None:
    """Forces where arrows need them."""
    if options.forces is None:
        return None
    from linkwright.kinetostatics.run import solve_forces

    return solve_forces(motion, static=options.static)


def _seconds(text: str | None) -> float | None:
    """The time of one cycle; a bare number is in seconds."""
    if text is None:
        return None
    from linkwright.cli.positions import quantities

    try:
        return float(text)
    except ValueError:
        values = quantities(text, "time", "--seconds")
    if len(values) > 1:
        raise UsageError(ONE_VALUE.format(option="--seconds", text=text))
    return values[0]
