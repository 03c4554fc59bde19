"""``linkwright export``: results in files for other programs."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import whole_number
from linkwright.cli.session import Session
from linkwright.words import Say

NAMES = ("csv", "dxf", "html", "json", "mjcf", "modelica", "parquet", "pdf", "png", "svg", "xlsx")
#: Options of formats; one that a format lacks is refused with those that it has.
OPTIONS = (
    "degrees", "unit", "position", "paths", "curve", "dimensions", "labels", "accelerations", "form", "name",
    "timestep", "indent", "compression", "width", "size", "beside",
)  # fmt: skip


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    parser.add_argument("file", metavar="FILE", help=say("cli.file_help"))
    parser.add_argument(
        "--output", "--to", dest="output", metavar="FILE", required=True, help=say("export.output_help")
    )
    parser.add_argument(
        "--format", choices=NAMES, metavar="FORMAT", help=say("export.format_help", names=", ".join(NAMES))
    )
    parser.add_argument("--steps", type=whole_number, default=360, metavar="N", help=say("export.steps_help"))
    parser.add_argument("--degrees", action="store_true", default=None, help=say("export.degrees_help"))
    parser.add_argument("--unit", choices=("mm", "m"), help=say("export.unit_help"))
    parser.add_argument("--position", type=int, metavar="N", help=say("export.position_help"))
    parser.add_argument("--paths", nargs="+", metavar="POINT", help=say("export.paths_help"))
    parser.add_argument("--curve", choices=("polyline", "spline"), help=say("export.curve_help"))
    for name in ("dimensions", "labels", "accelerations"):
        parser.add_argument(
            f"--{name}", action=argparse.BooleanOptionalAction, default=None, help=say(f"export.{name}_help")
        )
    parser.add_argument("--form", choices=("rates", "positions"), help=say("export.form_help"))
    parser.add_argument("--name", metavar="NAME", help=say("export.name_help"))
    parser.add_argument("--timestep", type=float, metavar="S", help=say("export.timestep_help"))
    parser.add_argument("--indent", type=int, metavar="N", help=say("export.indent_help"))
    parser.add_argument("--compression", metavar="NAME", help=say("export.compression_help"))
    parser.add_argument("--width", type=whole_number, metavar="N", help=say("export.width_help"))
    parser.add_argument("--size", type=float, metavar="N", help=say("export.size_help"))
    parser.add_argument("--beside", nargs="+", metavar="FILE", help=say("export.beside_help"))
    parser.add_argument("--force", action="store_true", help=say("cli.force_help"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Solves a model and writes the file."""
    from linkwright.cli.files import refuse_existing
    from linkwright.cli.source import read_model
    from linkwright.export import export

    path = Path(options.output)
    chosen, form = _checked(path, options)
    refuse_existing(path, force=options.force)
    mechanism, _ = read_model(options.file, session)
    if chosen == "html":
        form |= _of_page(options.file, options.beside or ())
    export(
        mechanism,
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
        session.show(session.say("cli.written", path=path))
    return 0


def _of_page(file: str, beside: Sequence[str]) -> dict[str, Any]:
    """The text of the file, which the page gives back changed, and the files of the machines beside it."""
    from linkwright.files.model_file import read_document
    from linkwright.files.source import read_source

    return {"text": read_source(file)[0], "beside": [read_document(each) for each in beside]}


def _checked(path: Path, options: argparse.Namespace) -> tuple[str, dict[str, Any]]:
    """The format and its options; raises UsageError before any work is done."""
    from linkwright.errors import LinkwrightError
    from linkwright.export.base import FORMATS
    from linkwright.export.export import check_options, chosen_format

    given = {name: getattr(options, name) for name in OPTIONS}
    form = {name: value for name, value in given.items() if value is not None}
    try:
        chosen = chosen_format(path, options.format)
        check_options(chosen, FORMATS[chosen], form)
    except LinkwrightError as error:
        raise UsageError(error.sentence) from None
    return chosen, form
