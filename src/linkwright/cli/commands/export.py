"""``linkwright export``: results in files for other programs."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces

NAMES = ("csv", "dxf", "html", "json", "mjcf", "modelica", "parquet", "pdf", "png", "python", "svg", "xlsx")
#: Options of formats; one that a format lacks is refused with those that it has.
OPTIONS = (
    "degrees", "unit", "position", "paths", "curve", "dimensions", "labels", "accelerations", "form", "name",
    "timestep", "indent", "compression", "width", "size", "beside",
)  # fmt: skip


def arguments(option: Options) -> None:
    option.model()
    option("--output", "FILE", "--to", required=True)
    option(
        "--format",
        "FORMAT",
        choices=NAMES,
        help=option.say(_("the format, where the ending does not say it: {names}", names=", ".join(NAMES))),
    )
    where = option.exclusive()
    where.count("--steps", 360)
    where("--at", "INPUTS", nargs="+", words="solve.at_help")
    where("--times", "TIMES", nargs="+", words="solve.times_help")
    option("--degrees", action="store_true", default=None)
    option("--unit", choices=("mm", "m"))
    option("--position", "N", type=int)
    option("--paths", "POINT", nargs="+")
    option("--curve", choices=("polyline", "spline"))
    for name in ("dimensions", "labels", "accelerations"):
        option.either(f"--{name}", None)
    option("--form", choices=("rates", "positions"))
    option("--name", "NAME")
    option("--timestep", "S", type=float)
    option("--indent", "N", type=int)
    option("--compression", "NAME")
    option.count("--width")
    option("--size", "N", type=float)
    option("--beside", "FILE", nargs="+")
    option.fonts()
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Solves a model and writes the file."""
    from linkwright.cli.files import refuse_existing
    from linkwright.cli.solving import chosen_motion
    from linkwright.cli.source import read_model
    from linkwright.export import export

    path = Path(options.output)
    chosen, form = _checked(path, options)
    refuse_existing(path, force=options.force)
    mechanism, _unused = read_model(options.file, session)
    motion = chosen_motion(mechanism, options, "mark")
    if chosen == "html":
        form |= _of_page(options.file, options.beside or ())
    if chosen == "python":
        form["model"] = str(options.file)
    export(
        mechanism if motion is None else _with_forces(motion),
        path,
        format=chosen,
        force=options.force,
        steps=options.steps,
        language=session.language,
        **form,
    )
    if session.json:
        session.show_data({"ok": True, "path": str(path), "format": chosen})
    else:
        session.show_written(path)
    return 0 if motion is None else _told(motion, session)


def _with_forces(motion: Motion) -> Motion | Forces:
    """The motion with its forces where there is anything to carry."""
    from linkwright.kinetostatics.run import solve_forces

    return solve_forces(motion) if motion.mechanism.has_loads else motion


def _told(motion: Motion, session: Session) -> int:
    """Says why positions have no numbers; 1 where there are some."""
    from linkwright.cli.solve_remarks import input_text

    for number, outcome in enumerate(motion.outcomes):
        if not outcome.ok:
            session.tell(f"{input_text(motion, number, degrees=True)}: {outcome.say(session.language)}")
    return int(not motion.whole)


def _of_page(file: str, beside: Sequence[str]) -> dict[str, Any]:
    """The text of the file, which the page gives back changed, and the files of the machines beside it."""
    from linkwright.files.model_file import read_document
    from linkwright.files.source import read_source

    return {"text": read_source(file)[0], "beside": [read_document(each) for each in beside]}


def _checked(path: Path, options: argparse.Namespace) -> tuple[str, dict[str, Any]]:
    """The format and its options; raises UsageError before any work is done."""
    from linkwright.errors import LinkwrightError
    from linkwright.export.export import FORMATS, check_options, chosen_format

    given = {name: getattr(options, name) for name in OPTIONS}
    form = {name: value for name, value in given.items() if value is not None}
    try:
        chosen = chosen_format(path, options.format)
        check_options(chosen, FORMATS[chosen], form)
    except LinkwrightError as error:
        raise UsageError(error.sentence) from None
    return chosen, form
