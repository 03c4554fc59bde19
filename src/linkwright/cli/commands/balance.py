"""``linkwright balance``: counterweights, and what they do to the shaking force."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, count, force, model, option
from linkwright.cli.session import Session
from linkwright.cli.usage import did_you_mean
from linkwright.core.arguments import STEPS
from linkwright.fields.base import Number, Quantity
from linkwright.fields.tables import ByAddress, Either
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.machine.balancing import Balancing
    from linkwright.mechanism.mechanism import Mechanism

SUMMARY = _("counterweights for a four-bar or slider-crank, and their effect")
DESCRIPTION = _(
    """\
Lays out counterweights for a four-bar or a slider-crank, for full or partial
balance of the shaking force, and shows the peaks of shaking force, shaking moment
and input torque without and with them. --output writes the balanced model."""
)
EXAMPLES = """\
linkwright balance gallery:jaw_crusher_fourbar --radius "crank=200 mm, jaw=500 mm"
linkwright balance press.yaml --radius 120mm --share 0.5
linkwright balance linkage.yaml --radius 80mm --output balanced.yaml"""

ENDINGS = (".yaml", ".yml")
RADIUS = Quantity("length", above=0.0)


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@model
@option(
    "--radius",
    "LENGTH",
    of=Either(RADIUS, ByAddress(RADIUS)),
    required=True,
    help=_(
        "distance of the counterweights from the pins that carry them, one (80mm) or by link "
        '("crank=80 mm, rod=40 mm")',
    ),
)
@option(
    "--share",
    "NUMBER",
    of=Number(minimum=0.0, maximum=1.0),
    default=1.0,
    help=_("share that is balanced, from 0 to 1 (default 1: the shaking force vanishes)"),
)
@count("--steps", STEPS, help=_("positions over the cycle for the comparison (default 360)"))
@option("--output", "FILE", help=_("write the balanced model to a .yaml file"))
@force
def run(options: Options, session: Session) -> int:
    """Prints the counterweights and their effect, and writes the balanced model."""
    from linkwright.cli.files import atomic_write, refuse_output
    from linkwright.cli.source import read_model
    from linkwright.machine.balancing import balance

    refuse_output(options.output, ENDINGS, force=options.force)
    mechanism, _unused = read_model(options.file, session)
    _require_links(options.radius, mechanism)
    found = balance(mechanism, radius=options.radius, share=options.share, steps=options.steps)
    if options.output is not None:
        atomic_write(Path(options.output), _model_text(found), force=options.force)
    session.show_result(found, options.output)
    return 0


def _require_links(radius: float | dict[str, float], mechanism: Mechanism) -> None:
    """Raises UsageError where a radius is of a link that there is not."""
    for link in radius if isinstance(radius, dict) else ():
        if link not in mechanism.links:
            told = _('--radius: there is no link "{link}"', code="balance.no_link", link=link)
            raise UsageError(did_you_mean(told, link, mechanism.links))


def _model_text(found: Balancing) -> str:
    """The balanced model; masses that were expressions become the new numbers."""
    from linkwright.files.write import dump

    changed = tuple(
        f"{weight.link}.{key}"
        for weight in found.counterweights
        for key in ("mass", "inertia", "mass_centre")
    )
    kept = {
        address: each
        for address, each in found.mechanism.expressions.items()
        if not any(address == name or address.startswith(f"{name}.") for name in changed)
    }
    return dump(replace(found.mechanism, expressions=kept))
