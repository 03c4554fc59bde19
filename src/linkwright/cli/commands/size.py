"""``linkwright size``: widths of links, diameters of pins and the thickness of plates from the largest forces."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.options import MODELS, Options, count, flag, force, model, option, output
from linkwright.cli.session import Session
from linkwright.fields.base import Number, Quantity
from linkwright.mechanism.construction import MATERIALS
from linkwright.words import _

LENGTH = Quantity("length", above=0.0)
PRESSURE = Quantity("pressure", above=0.0)


@command(
    _("sizes of links and pins from the largest forces"),
    _(
        """\
Sizes links by their eyes, stress and buckling, pins by pressure, bending, shear and
their seat, from the largest forces over the cycle with a safety factor, and takes
preferred sizes and the thinnest plate that fits. Sizes that the file gives stay as
they are. --worked shows the way to every size; --output writes the model file
with the sizes and everything else as it was."""
    ),
    """\
linkwright size gallery:jaw_crusher_sixbar
linkwright size press.yaml --material aluminium --safety 3 --worked
linkwright size press.yaml --thickness 8mm --output press_sized.yaml""",
)
@model
@option(
    "--material",
    "NAME",
    choices=tuple(MATERIALS),
    help=_("material of the links (default: that of the construction, else steel)"),
)
@option(
    "--safety",
    "NUMBER",
    of=Number(minimum=1.0),
    help=_("safety factor against yield (default: that of the construction, else 2)"),
)
@option("--thickness", "LENGTH", of=LENGTH, help=_("thickness of the plates (default: the thinnest that fits)"))
@option(
    "--pressure",
    "PRESSURE",
    of=PRESSURE,
    help=_("allowed pressure of links that turn on pins (default: 8 MPa, less for plastics and wood)"),
)
@flag("--worked", _("print the worked solution as well"))
@count("--steps", help=_("positions over the cycle (default 180)"))
@output(MODELS, _("write the model file with the sizes"))
@force
def run(options: Options, session: Session) -> int:
    """Prints the sizes, and writes the model file with them."""
    from linkwright.cli.files import atomic_write
    from linkwright.files.model_file import read_document
    from linkwright.sizing.size_links import POSITIONS, size_links

    document = read_document(options.file)
    mechanism = document.mechanism if session.json else document.mechanism.translate(session.language)
    found = size_links(
        mechanism,
        material=options.material,
        safety=options.safety,
        thickness=options.thickness,
        pressure=options.pressure,
        steps=options.steps or POSITIONS,
    )
    if options.output is not None:
        atomic_write(Path(options.output), found.model_text(document), force=options.force)
    language = session.language
    worked = f"{found.text(language)}\n\n{found.worked(language)}" if options.worked else ""
    session.show_result(found, options.output, text=worked)
    return 0
