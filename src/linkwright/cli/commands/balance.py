"""``linkwright balance``: counterweights, and what they do to the shaking force."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError, did_you_mean
from linkwright.cli.options import MODELS, Options, count, force, model, option, output
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.base import Number, Quantity
from linkwright.fields.tables import ByAddress, Either
from linkwright.words import _

RADIUS = Quantity("length", above=0.0)
SHARE = Number(minimum=0.0, maximum=1.0)
NO_LINK = _('--radius: there is no link "{link}"', code="balance.no_link")


@command(
    _("counterweights for a four-bar or slider-crank, and their effect"),
    _(
        """\
Lays out counterweights for a four-bar or a slider-crank, for full or partial
balance of the shaking force, and shows the peaks of shaking force, shaking moment
and input torque without and with them. --output writes the balanced model."""
    ),
    """\
linkwright balance gallery:jaw_crusher_fourbar --radius "crank=200 mm, jaw=500 mm"
linkwright balance press.yaml --radius 120mm --share 0.5
linkwright balance linkage.yaml --radius 80mm --output balanced.yaml""",
)
@model
@option(
    "--radius",
    "LENGTH",
    of=Either(RADIUS, ByAddress(RADIUS)),
    required=True,
    help=_(
        "distance of the counterweights from the pins that carry them, one (80mm) or by link "
        '("crank=80 mm, rod=40 mm")'
    ),
)
@option(
    "--share",
    "NUMBER",
    of=SHARE,
    default=1.0,
    help=_("share that is balanced, from 0 to 1 (default 1: the shaking force vanishes)"),
)
@count("--steps", STEPS, help=_("positions over the cycle for the comparison (default 360)"))
@output(MODELS, _("write the balanced model to a .yaml file"))
@force
def run(options: Options, session: Session) -> int:
    """Prints the counterweights and their effect, and writes the balanced model."""
    from linkwright.cli.files import atomic_write, read_model
    from linkwright.machine.balancing import balance

    mechanism, _findings = read_model(options.file, session)
    for link in options.radius if isinstance(options.radius, dict) else ():
        if link not in mechanism.links:
            raise UsageError(did_you_mean(NO_LINK.format(link=link), link, mechanism.links))
    found = balance(mechanism, radius=options.radius, share=options.share, steps=options.steps)
    if options.output is not None:
        atomic_write(Path(options.output), found.model_text(), force=options.force)
    session.show_result(found, options.output)
    return 0
