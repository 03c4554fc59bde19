"""``linkwright layers``: in which layer every link goes."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import PICTURES, RESULTS, Options, fonts, force, model, option, output
from linkwright.cli.session import Session
from linkwright.fields.base import Quantity
from linkwright.fields.tables import PAIRS
from linkwright.words import _

NO_LAYER = _(
    '--fix {plate}: "{layer}" is not a layer; write an integer from 0, the layer of the frame, or all',
    code="layers.no_number",
)


@command(
    _("the fewest layers of links, pins and frame in which nothing collides"),
    _(
        """\
Finds in which layer every link, wheel, cam and guide goes so that nothing collides
over the whole cycle: the fewest layers, then the shortest pins, with the heads of
the pins and the frame on one side or on both. Where there are no layers, it names
the pairs that contradict, where in the cycle they meet, and what would help."""
    ),
    """\
linkwright layers gallery:theo_jansen_leg
linkwright layers press.yaml --supports both --ends flush
linkwright layers press.yaml --fix crank=2 --output layers.csv
linkwright layers gallery:theo_jansen_leg --plot side.svg --exploded exploded.svg""",
)
@model
@option(
    "--supports",
    choices=("cantilevered", "both"),
    help=_("the frame on one side (cantilevered) or on both sides (default: that of the section construction)"),
)
@option("--ends", choices=("heads", "flush"), help=_("ends of the pins (default: those of the section construction)"))
@option(
    "--fix",
    "PLATE=LAYER",
    of=PAIRS,
    several=True,
    default={},
    help=_("plates whose layer is fixed, 0 the frame's; frame=all: the frame in all layers"),
)
@option(
    "--clearance",
    "LENGTH",
    of=Quantity("length", minimum=0.0),
    help=_("smallest gap within a layer (default: that of the section construction, else 0)"),
)
@output(RESULTS, _("write the layers to a .csv or .json file (SI units), or a .xlsx, .md or .html file"))
@output(PICTURES, _("draw the section through the pins in a .svg, .pdf or .png file"), name="--plot")
@output(PICTURES, _("draw the parts taken apart in a .svg, .pdf or .png file"), name="--exploded")
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Prints or writes the layers; 1 where there are none."""
    from linkwright.cli.files import present, read_model, write_diagram
    from linkwright.layering.layers_of import layers

    mechanism, _findings = read_model(options.file, session)
    found = layers(
        mechanism,
        supports=options.supports,
        ends=options.ends,
        fixed=_layers(options.fix),
        clearance=options.clearance,
    )
    if found.conflicts:
        options.plot = options.exploded = None
    write_diagram(found, options, session, kind="exploded", name="exploded")
    present(found, options, session, options.exploded)
    return 1 if found.conflicts else 0


def _layers(fixed: Mapping[str, str]) -> Mapping[str, int | None] | None:
    """Layers of plates by name, None for all."""
    for plate, text in fixed.items():
        if text != "all" and not (text.isascii() and text.isdigit() and len(text) < 4):
            raise UsageError(NO_LAYER.format(plate=plate, layer=text))
    return {plate: None if text == "all" else int(text) for plate, text in fixed.items()} or None
