"""``linkwright draw``: the kinematic drawing of a model."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli import pictures
from linkwright.cli.command import command
from linkwright.cli.options import Options, model, option, switch
from linkwright.cli.positions import one_input, one_place
from linkwright.cli.session import Session
from linkwright.core.arguments import DRAWING_STEPS
from linkwright.words import _

LABELS: dict[str, bool | str] = {"all": True, "points": "points", "none": False}


@command(
    _("the kinematic drawing, as SVG, PNG or PDF"),
    _(
        """\
Draws a mechanism in the standard symbols: at its first position, at an input or
time that you name, with limit positions, paths of points, velocities,
accelerations, forces and dimension lines."""
    ),
    """\
linkwright draw gallery:jaw_crusher_sixbar --output crusher.svg
linkwright draw crusher.yaml --at "30 deg" --overlay limits --paths C,jaw.D --output crusher.pdf
linkwright draw crusher.yaml --overlay faded:8 --velocities A B C --output crusher.png --width 1600
linkwright draw crusher.yaml --forces --output crusher.svg --force
linkwright draw crusher.yaml --dimensions pitman jaw O1:O3 --output crusher.svg
linkwright draw gallery:excavator --time "2 s" --lang zh --output excavator.svg""",
    exclusive=[("at", "time")],
)
@model
@pictures.cycle_steps(DRAWING_STEPS)
@option(
    "--at", "INPUTS", help=_('draw at this input of the first driver: "30 deg"; several drivers: "NAME=…; NAME=…"')
)
@option("--time", "TIME", help=_('draw at this time: "0.5 s"'))
@option(
    "--overlay",
    "WHICH",
    default="",
    help=_(
        "positions beneath: limits (of the last output), limits:jaw (of a link or guide), "
        "faded:8 (as many over the cycle)"
    ),
)
@pictures.paths(_("paths of points over the cycle: C,jaw.D"))
@pictures.arrows
@option(
    "--dimensions",
    "LENGTH",
    several=True,
    optional=True,
    help=_("lengths and angles of links (pitman, frame), between points (O1:O3); default: of all"),
)
@option("--labels", choices=tuple(LABELS), default="all", help=_("names of points and links (default: all)"))
@switch("--inputs", True, help=_("arrows at what is driven"))
@pictures.picture_file((".svg", ".png", ".pdf"), _("write FILE.svg, FILE.png or FILE.pdf"))
def run(options: Options, session: Session) -> int:
    """Draws a model and writes the picture."""
    from linkwright.cli.files import read_model
    from linkwright.plotting.drawing.draw import draw

    mechanism, _findings = read_model(options.file, session)
    dimensions = pictures.dimensions(options.dimensions)
    pictures.refuse_unknown_names(mechanism, options, dimensions)
    motion = pictures.cycle(mechanism, options.steps, session)
    drawing = draw(
        motion,
        at=one_input(options.at, mechanism),
        time=one_place(options.time, mechanism, "time", "--time"),
        overlay=options.overlay or (),
        dimensions=dimensions,
        inputs=options.inputs,
        labels=LABELS[options.labels],
        size=options.width if Path(options.output).suffix.lower() != ".png" else None,
        language=session.language,
        **pictures.vectors(motion, options, solved=False),
    )
    for note in drawing.notes:
        session.tell(note)
    path = drawing.save(options.output, width=options.width, force=True)
    session.show_written(path, data={"ok": True, "written": str(path)})
    return 0
