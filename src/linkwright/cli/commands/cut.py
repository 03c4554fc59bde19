"""``linkwright cut``: the parts of a machine, drawn to be cut."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.options import Options, force, model, option
from linkwright.cli.session import Session
from linkwright.fields.base import Quantity
from linkwright.fields.sheet_size import SheetSize
from linkwright.words import _

FORMS = ("dxf", "svg", "stl", "3mf", "step")


@command(
    _("parts to make: plates as DXF and SVG, nested on sheets, pins, spacers, parts list"),
    _(
        """\
Prints the list of parts of a machine: plates with their holes, pins, spacers and
washers, with sizes, material, layer and mass. --output writes a drawing of every
plate, 1:1 in mm, with holes and engraved names in layers of their own, sheets with
all plates nested on them, and the list of parts as CSV and XLSX; --format stl, 3mf
or step writes all parts as solids, each by itself and together. The section
"construction" of the model says of what and how the parts are made."""
    ),
    """\
linkwright cut gallery:theo_jansen_leg
linkwright cut leg.yaml --output leg-parts --sheet 600x400 --kerf 0.2mm
linkwright cut press.yaml --output press-parts --format dxf --lang zh
linkwright cut press.yaml --output press-parts --format stl step""",
)
@model
@option("--output", "FOLDER", help=_("folder for the drawings, sheets and the list of parts"))
@option(
    "--format",
    several=True,
    choices=FORMS,
    default=("dxf", "svg"),
    help=_("forms of the files (default: dxf svg); stl, 3mf and step have all parts as solids"),
)
@option(
    "--sheet",
    "WxH",
    of=SheetSize(),
    help=_("width and height of the sheets, in mm unless said: 600x400 (default: what the file says, or by rule)"),
)
@option(
    "--kerf",
    "LENGTH",
    of=Quantity("length", minimum=0),
    help=_(
        "width that the cut takes: outlines are drawn outside by half of it (default: what the file says, else 0)"
    ),
)
@force
def run(options: Options, session: Session) -> int:
    """Prints the list of parts and writes the files that are asked for."""
    from linkwright.cli.files import read_model
    from linkwright.fabrication.cut_parts import cut_parts
    from linkwright.fabrication.files import save

    mechanism, _findings = read_model(options.file, session)
    found = cut_parts(mechanism)
    written: list[Path] = []
    if options.output is not None:
        written = save(
            found,
            options.output,
            options.format,
            session.language,
            kerf=options.kerf,
            sheet=options.sheet,
            force=options.force,
            remedy="--force",
        )
    session.show_result(found, *written, data={"files": [str(path) for path in written]}, spaced=False)
    return 0
