"""``linkwright animate``: a model's cycle as a moving picture."""

from __future__ import annotations

from linkwright.cli import pictures
from linkwright.cli.command import command
from linkwright.cli.options import Options, count, model, option, switch
from linkwright.cli.positions import duration
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.words import _

FRAMES = 60
WIDTH = 640


@command(
    _("the moving drawing, as SVG, GIF or MP4"),
    _(
        """\
Shows one cycle of a mechanism as a moving drawing, with traces of points, arrows
and curves whose cursor runs along. An open cycle runs to and fro. A moving SVG
runs by itself in browsers and readme files."""
    ),
    """\
linkwright animate gallery:theo_jansen_leg --paths leg.T --output leg.svg
linkwright animate crusher.yaml --paths C --curves jaw.angle --output crusher.gif
linkwright animate crusher.yaml --forces --curves driver.effort --seconds 4 --output crusher.mp4""",
)
@model
@pictures.cycle_steps(STEPS)
@pictures.paths(_("paths of points with a dot that runs along: C,jaw.D"))
@option(
    "--curves",
    "RESULT",
    several=True,
    help=_("results drawn below: jaw.angle, C.velocity.x; with --forces also driver.effort"),
)
@pictures.arrows
@switch("--labels", True, help=_("names of points"))
@option("--seconds", "TIME", help=_("time of one cycle on the screen (default: the true one, within 2 to 6 s)"))
@count("--frames", FRAMES, help=_("positions shown in one cycle (default: {frames})", frames=FRAMES))
@pictures.picture_file((".svg", ".gif", ".mp4"), _("write FILE.svg, FILE.gif or FILE.mp4"))
def run(options: Options, session: Session) -> int:
    """Writes the moving picture; 1 where positions of the cycle were left out."""
    from linkwright.cli.files import read_model
    from linkwright.cli.session import progress
    from linkwright.plotting.animation import animate

    seconds = duration(options.seconds, "--seconds")
    mechanism, _findings = read_model(options.file, session)
    pictures.refuse_unknown_points(mechanism, options)
    motion = pictures.cycle(mechanism, max(options.steps, options.frames), session)
    animation = animate(
        motion,
        curves=pictures.names(options.curves),
        seconds=seconds,
        frames=options.frames,
        size=options.width,
        labels=options.labels,
        language=session.language,
        **pictures.vectors(motion, options, solved=True),
    )
    with progress(session, _("drawing")) as report:
        path = animation.save(options.output, width=options.width or WIDTH, progress=report, force=True)
    session.show_written(path, data={"ok": True, "written": str(path)})
    return int(not motion.complete)
