"""``linkwright interference``: what comes near to what, over the whole cycle."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import RESULTS, Options, flag, force, model, option, output
from linkwright.cli.session import Session
from linkwright.fields.base import Quantity
from linkwright.words import _


@command(
    _("what collides over the cycle: smallest gaps between links, pins and frame"),
    _(
        """\
Finds the smallest gap of every pair of links, pins, blocks, guides, wheels, cams
and the frame over the whole cycle, exact between the positions, seen along the
axes as if all were in one layer, and where in the cycle it is. Pairs that overlap
need different layers. End stops that the prescribed motion goes beyond are named."""
    ),
    """\
linkwright interference gallery:jaw_crusher_sixbar
linkwright interference press.yaml --clearance 2mm
linkwright interference press.yaml --all --output gaps.csv""",
)
@model
@option(
    "--clearance",
    "LENGTH",
    of=Quantity("length", minimum=0.0),
    help=_("smallest gap that is wanted (default: that of the section construction, else 0)"),
)
@flag("--all", help=_("show all pairs, also those that are joined"))
@output(RESULTS, _("write the pairs to a .csv or .json file (SI units), or a .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Prints or writes the smallest gaps; a collision is a finding, not an error."""
    from linkwright.cli.files import present, read_model
    from linkwright.collisions.result import interference

    mechanism, _findings = read_model(options.file, session)
    present(interference(mechanism, clearance=options.clearance), options, session, every=options.all)
    return 0
