"""``linkwright draw``: the kinematic drawing of a model."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import ONE_VALUE, UsageError
from linkwright.cli.options import Options, model, option, switch
from linkwright.cli.pictures import (
    arrows,
    cycle,
    cycle_steps,
    names,
    names_or_all,
    picture_file,
    refuse_unknown,
    refuse_unknown_marks,
    told,
)
from linkwright.cli.session import Session
from linkwright.core.arguments import DRAWING_STEPS
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces
    from linkwright.mechanism.mechanism import Mechanism
    from linkwright.plotting.drawing.dimensions import Dimension

SUMMARY = _("the kinematic drawing, as SVG, PNG or PDF")
DESCRIPTION = _(
    """\
Draws a mechanism in the standard symbols: at its first position, at an input or
time that you name, with limit positions, paths of points, velocities,
accelerations, forces and dimension lines."""
)
EXAMPLES = """\
linkwright draw gallery:jaw_crusher_sixbar --output crusher.svg
linkwright draw crusher.yaml --at "30 deg" --overlay limits --paths C,jaw.D --output crusher.pdf
linkwright draw crusher.yaml --overlay faded:8 --velocities A B C --output crusher.png --width 1600
linkwright draw crusher.yaml --forces --output crusher.svg --force
linkwright draw crusher.yaml --dimensions pitman jaw O1:O3 --output crusher.svg
linkwright draw gallery:excavator --time "2 s" --lang zh --output excavator.svg"""

ENDINGS = (".svg", ".png", ".pdf")
LABELS: dict[str, bool | str] = {"all": True, "points": "points", "none": False}


@command(SUMMARY, DESCRIPTION, EXAMPLES, exclusive=[("at", "time")])
@model
@cycle_steps(DRAWING_STEPS)
@option(
    "--at",
    "INPUTS",
    help=_('draw at this input of the first driver: "30 deg"; several drivers: "NAME=…; NAME=…"'),
)
@option("--time", "TIME", help=_('draw at this time: "0.5 s"'))
@option(
    "--overlay",
    "WHICH",
    default="",
    help=_(
        "positions beneath: limits (of the last output), limits:jaw (of a link or guide), "
        "faded:8 (as many over the cycle)",
    ),
)
@option("--paths", "POINT", "--traces", help=_("paths of points over the cycle: C,jaw.D"), several=True)
@arrows
@option(
    "--dimensions",
    "LENGTH",
    help=_("lengths and angles of links (pitman, frame), between points (O1:O3); default: of all"),
    several=True,
    optional=True,
)
@option("--labels", choices=tuple(LABELS), default="all", help=_("names of points and links (default: all)"))
@switch("--inputs", True, help=_("arrows at what is driven"))
@picture_file(_("write FILE.svg, FILE.png or FILE.pdf"))
def run(options: Options, session: Session) -> int:
    """Draws a model and writes the picture."""
    from linkwright.cli.files import refuse_output
    from linkwright.cli.source import read_model
    from linkwright.plotting.drawing.draw import draw

    refuse_output(options.output, ENDINGS, force=options.force)
    mechanism, _unused = read_model(options.file, session)
    dimensions = _dimensions(options.dimensions)
    _refuse_unknown_names(mechanism, options, dimensions)
    motion = cycle(mechanism, options.steps, session)
    drawing = draw(
        motion,
        at=_inputs(mechanism, options.at),
        time=_time(mechanism, options.time),
        overlay=options.overlay or (),
        paths=names(options.paths),
        velocities=names_or_all(options.velocities),
        accelerations=names_or_all(options.accelerations),
        forces=_forces(motion, options),
        reactions_of=names(options.forces) or None,
        dimensions=dimensions,
        centres=options.centres,
        inputs=options.inputs,
        labels=LABELS[options.labels],
        size=options.width if Path(options.output).suffix.lower() != ".png" else None,
        language=session.language,
    )
    for note in drawing.notes:
        session.tell(note)
    told(drawing.save(options.output, width=options.width, force=True), options, session)
    return 0


def _inputs(mechanism: Mechanism, text: str | None) -> dict[str, float] | None:
    """One coordinate for every driver that ``--at`` names."""
    if text is None:
        return None
    from linkwright.cli.positions import inputs

    given = inputs(text, mechanism)
    if any(len(values) > 1 for values in given.values()):
        raise UsageError(ONE_VALUE.format(option="--at", text=text))
    return {name: values[0] for name, values in given.items()}


def _time(mechanism: Mechanism, text: str | None) -> float | None:
    if text is None:
        return None
    from linkwright.cli.positions import places

    values = places(text, mechanism, "time", "--time")
    if len(values) > 1:
        raise UsageError(ONE_VALUE.format(option="--time", text=text))
    return values[0]


def _forces(motion: Motion, options: Options) -> Forces | bool | None:
    """Forces where they are asked for; static ones solved here, as a drawing solves with inertia."""
    if options.forces is None:
        return None
    if not options.static:
        return True
    from linkwright.kinetostatics.run import solve_forces

    return solve_forces(motion, static=True)


def _dimensions(words: list[str] | None) -> list[Dimension] | bool:
    """Links, pairs of points as ``O1:O3``, or all links."""
    if words is None:
        return False
    return [
        (first, last) if sign else name
        for name in names(words)
        for first, sign, last in [name.partition(":")]
    ] or True


def _refuse_unknown_names(mechanism: Mechanism, options: Options, dimensions: list[Dimension] | bool) -> None:
    from linkwright.kinematics.names import find_point, place_meant

    refuse_unknown_marks(mechanism, options)
    named = [] if isinstance(dimensions, bool) else dimensions
    links = [each for each in named if isinstance(each, str)]
    refuse_unknown(mechanism.link, "--dimensions", links)
    ends = [point for each in named if not isinstance(each, str) for point in each]
    refuse_unknown(lambda name: find_point(mechanism, name), "--dimensions", ends)
    word, _unused, output = options.overlay.partition(":")
    if word == "limits" and output:
        refuse_unknown(lambda name: place_meant(mechanism, name), "--overlay", [output])
