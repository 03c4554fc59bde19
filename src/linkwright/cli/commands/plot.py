"""``linkwright plot``: diagrams of motion, forces and torque."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.files import atomic_write, default_path, refuse_output
from linkwright.cli.options import PICTURES, Options, argument, count, flag, fonts, force, option
from linkwright.cli.pictures import cycles, diagram_position, refuse_diagram
from linkwright.cli.session import Session
from linkwright.core.arguments import CURVE_STEPS
from linkwright.fields.base import Number
from linkwright.machine.flywheel import COEFFICIENT
from linkwright.plotting.diagrams.base import kinds
from linkwright.words import _

SETTINGS = ("of", "joint", "on", "axes", "fluctuation", "static", "title")


@command(
    _("diagrams: motion, joint forces, torque, polygons"),
    _(
        """\
Draws a diagram of a machine over its cycle, or a polygon to scale for one
position, and writes it as SVG, PDF or PNG. Several models are laid over each
other. Limit positions, peaks and phases are marked."""
    ),
    _(
        """\
linkwright plot gallery:jaw_crusher_sixbar                 motion of the output
linkwright plot crusher.yaml --kind torque --output torque.pdf
linkwright plot crusher.yaml --kind hodograph --joint O5
linkwright plot crusher.yaml --kind force_polygon --at 30deg --lang zh
linkwright plot first.yaml second.yaml --kind reactions --joint O5"""
    ),
)
@argument(
    "files",
    "FILE",
    help=_("model files, or gallery:NAME; several are laid over each other"),
    nargs=-1,
    required=True,
    model=True,
)
@option("--kind", "KIND", default="sva", help=_("kind of diagram: {kinds} (default: sva)", kinds=", ".join(kinds())))
@option(
    "--of",
    "NAME",
    default=[],
    help=_("outputs, links or points that it is about: jaw, guide, C, jaw.D.x (default: the output)"),
    several=True,
)
@option(
    "--joint", "JOINT", help=_("joint of reactions and hodographs (default: the one on the frame that carries most)")
)
@option("--on", "LINK", help=_("link on which the joint's force acts"))
@option("--axes", "LINK", help=_("frame, or a link in whose axes forces are resolved (hodograph: default both)"))
@option(
    "--at",
    "INPUT",
    help=_("input of a polygon: 30deg, 0.2m; 0.5s where a driver follows a law (default: the first position)"),
)
@count("--steps", CURVE_STEPS, help=_("equal steps over the cycle (default: 720)"))
@option(
    "--fluctuation",
    "δ",
    of=COEFFICIENT,
    help=_("speed fluctuation that the flywheel of --kind speed allows (default: 0.02)"),
)
@flag("--static", help=_("leave the inertia forces out"))
@flag("--no-marks", help=_("leave out limit positions, peaks, phases and inputs along curves"))
@option("--title", "TEXT", help=_('a title of your own; "" for none'))
@option(
    "--dpi",
    "N",
    of=Number(minimum=10.0, maximum=2400.0),
    default=200.0,
    help=_("dots per inch of a PNG (default: 200)"),
)
@option("--output", "FILE", help=_("file to write: .svg, .pdf or .png (default: MODEL-KIND.svg here)"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Draws a diagram and writes it; 1 where a position is not reached."""
    from linkwright.plotting.diagrams.base import plot

    refuse_diagram(options)
    path = Path(options.output) if options.output else default_path(options.files[0], f"-{options.kind}.svg")
    refuse_output(path, PICTURES, force=options.force)
    motions = cycles(options.files, options.steps, session)
    settings = {name: getattr(options, name) for name in SETTINGS}
    diagram = plot(
        motions,
        options.kind,
        at=diagram_position(options.at, motions),
        marks=not options.no_marks,
        language=session.language,
        **settings,
    )
    atomic_write(path, diagram.content(path.suffix.lower(), dpi=options.dpi), force=options.force)
    session.show_written(path, data={"ok": True, "kind": options.kind, "file": str(path)})
    return int(not all(motion.complete for motion in motions.values()))
