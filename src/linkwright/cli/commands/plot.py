"""``linkwright plot``: diagrams of motion, forces and torque."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import ONE_VALUE, UsageError
from linkwright.cli.options import Options, argument, count, flag, fonts, force, option
from linkwright.cli.session import Session
from linkwright.core.arguments import CURVE_STEPS
from linkwright.errors import LinkwrightError, about
from linkwright.fields.base import Number
from linkwright.machine.flywheel import COEFFICIENT
from linkwright.plotting.diagrams.diagram_by_name import kinds
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.pictures.diagram import Diagram

SUMMARY = _("diagrams: motion, joint forces, torque, polygons")
DESCRIPTION = _(
    """\
Draws a diagram of a machine over its cycle, or a polygon to scale for one
position, and writes it as SVG, PDF or PNG. Several models are laid over each
other. Limit positions, peaks and phases are marked."""
)
EXAMPLES = _(
    """\
linkwright plot gallery:jaw_crusher_sixbar                 motion of the output
linkwright plot crusher.yaml --kind torque --output torque.pdf
linkwright plot crusher.yaml --kind hodograph --joint O5
linkwright plot crusher.yaml --kind force_polygon --at 30deg --lang zh
linkwright plot first.yaml second.yaml --kind reactions --joint O5"""
)

ENDINGS = (".svg", ".pdf", ".png")


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@argument(
    "files",
    "FILE",
    help=_("model files, or gallery:NAME; several are laid over each other"),
    nargs=-1,
    required=True,
    model=True,
)
@option(
    "--kind",
    "KIND",
    default="sva",
    help=_("kind of diagram: {kinds} (default: sva)", kinds=", ".join(kinds())),
)
@option(
    "--of",
    "NAME",
    default=[],
    help=_(
        "outputs, links or points that it is about: jaw, guide, C, jaw.D.x (default: the output)",
    ),
    several=True,
)
@option(
    "--joint",
    "JOINT",
    help=_("joint of reactions and hodographs (default: the one on the frame that carries most)"),
)
@option("--on", "LINK", help=_("link on which the joint's force acts"))
@option(
    "--axes", "LINK", help=_("frame, or a link in whose axes forces are resolved (hodograph: default both)")
)
@option(
    "--at",
    "INPUT",
    help=_(
        "input of a polygon: 30deg, 0.2m; 0.5s where a driver follows a law (default: the first position)",
    ),
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
    _require_kind(options)
    path = _path(options)
    motions = _solved(options, session)
    diagram = _drawn(options, session, motions)
    _write(diagram, path, options, session)
    return int(not all(motion.complete for motion in motions.values()))


def _require_kind(options: Options) -> None:
    from linkwright.plotting.diagrams.base import OPTIONS
    from linkwright.plotting.diagrams.diagram_by_name import require_kind, require_options

    with about("--kind", UsageError, LinkwrightError):
        require_kind(options.kind)
    for name in OPTIONS:
        if getattr(options, name):
            with about(f"--{name}", UsageError, LinkwrightError):
                require_options(options.kind, [name])


def _path(options: Options) -> Path:
    """Where the diagram goes; refused before any work is done."""
    from linkwright.cli.files import refuse_output

    source = options.files[0].removeprefix("gallery:")
    path = Path(options.output or f"{Path(source).stem}-{options.kind}.svg")
    refuse_output(str(path), ENDINGS, force=options.force)
    return path


def _solved(options: Options, session: Session) -> dict[str, Motion]:
    """The motion of every model by a name that tells it from the others; says how far the work is."""
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.kinematics.solve import solve_motion

    found: dict[str, Motion] = {}
    notes = []
    with progress(session, _("solving")) as report:
        for done, file in enumerate(options.files, 1):
            mechanism, _unused = read_model(file, session)
            motion = solve_motion(mechanism, steps=options.steps, failures="mark")
            failed = [outcome for outcome in motion.outcomes if not outcome.ok]
            if len(failed) == motion.steps:
                raise LinkwrightError(_("{name}: {cause}", name=file, cause=failed[0].sentence))
            if failed:
                notes.append(
                    session.say(
                        _(
                            "{file}: {count} of {of} positions are not reached and left blank: {sentence}",
                            file=file,
                            count=len(failed),
                            of=motion.steps,
                            sentence=failed[0].sentence,
                        )
                    )
                )
            found[mechanism.name if mechanism.name not in found else f"{mechanism.name} ({file})"] = motion
            if report is not None:
                report(done, len(options.files))
    for note in notes:
        session.tell(note)
    return found


def _drawn(options: Options, session: Session, motions: dict[str, Motion]) -> Diagram:
    from linkwright.plotting.diagrams.diagram_by_name import plot

    return plot(
        motions,
        options.kind,
        of=options.of,
        joint=options.joint,
        on=options.on,
        axes=options.axes,
        at=_place(options.at, motions, session),
        fluctuation=options.fluctuation,
        static=options.static,
        marks=not options.no_marks,
        title=options.title,
        language=session.language,
    )


def _place(text: str | None, motions: dict[str, Motion], session: Session) -> float | str | None:
    """The value of --at; raises UsageError. What has no driver says so itself."""
    from linkwright.plotting.diagrams.source import Source

    first = Source(next(iter(motions.values())))
    if text is None or not first.mechanism.drivers:
        return text
    from linkwright.cli.positions import places

    values = places(text, first.mechanism, first.input_dimension, "--at")
    if len(values) > 1:
        raise UsageError(ONE_VALUE.format(option="--at", text=text))
    return values[0]


def _write(diagram: Diagram, path: Path, options: Options, session: Session) -> None:
    from linkwright.cli.files import atomic_write

    content = diagram.content(path.suffix.lower(), dpi=options.dpi)
    atomic_write(path, content, force=options.force)
    if session.json:
        session.show_data({"ok": True, "kind": options.kind, "file": str(path)})
    else:
        session.show_written(path)
