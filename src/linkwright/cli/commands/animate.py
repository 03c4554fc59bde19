"""``linkwright animate``: a model's cycle as a moving picture."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.pictures import (
    cycle,
    file_arguments,
    names,
    names_or_all,
    refuse_unknown_marks,
    source_arguments,
    told,
    vector_arguments,
)
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces

ENDINGS = (".svg", ".gif", ".mp4")
STEPS = 360
FRAMES = 60
WIDTH = 640


def arguments(option: Options) -> None:
    source_arguments(option, steps=STEPS)
    what = option.group("draw.what_title")
    what("--paths", "POINT", "--traces", nargs="+")
    what("--curves", "RESULT", nargs="+")
    vector_arguments(what)
    what.either("--labels", True)
    pace = option.group("pace_title")
    pace("--seconds", "TIME")
    pace.count(
        "--frames",
        FRAMES,
        help=option.say(_("positions shown in one cycle (default: {frames})", frames=FRAMES)),
    )
    file_arguments(option)


def run(options: argparse.Namespace, session: Session) -> int:
    """Writes the moving picture; 1 where positions of the cycle were left out."""
    from linkwright.cli.files import refuse_output
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.plot.animation import animate

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
    with progress(session.say, "animate.drawing") as report:
        path = animation.save(options.output, width=options.width or WIDTH, progress=report, force=True)
    told(path, options, session)
    return int(not motion.whole)


def _forces(motion: Motion, options: argparse.Namespace) -> Forces | None:
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
        raise UsageError(
            _(
                '{option}: "{text}" is more than one value; give one',
                code="draw.one_position",
                option="--seconds",
                text=text,
            )
        )
    return values[0]
