"""``linkwright compensate``: a cam that keeps an output constant in a zone of the cycle."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import MODELS, Options, argument, count, force, model, option, output
from linkwright.cli.positions import zone_of
from linkwright.cli.session import Session
from linkwright.errors import about
from linkwright.words import _


@command(
    _("a cam that keeps an output constant in a zone, such as a bed in step with its cylinder"),
    _(
        """\
Finds the lift of a cam of the machine so that an output is constant while the input
goes through a zone: what the follower at rest leaves is made good exactly; outside the
zone the follower returns smoothly, with a dwell. The output is one that the model
names (outputs: {lead: bed_guide - 180 mm*cylinder}), a coordinate, an angle or a
displacement. --span looks for the zone of that length that needs the smallest lift."""
    ),
    """\
linkwright compensate gallery:printing_press lead --zone "-882.734..-1449.5665 deg"
linkwright compensate press.yaml lead --span "567 deg" --output press_with_cam.yaml""",
    exclusive=[("zone", "span")],
)
@model
@argument("of", "OUTPUT", help=_("what is to be constant: an output of the model"))
@option("--joint", "NAME", default="", help=_("the cam (needed where the machine has several)"))
@option("--zone", "FROM..TO", help=_("values of the input between which it is to be constant"))
@option("--span", "WAY", help=_("how long the zone is to be, of the input; its place is found"))
@count("--steps", 1440, help=_("positions over the cycle (default 1440)"))
@output((*MODELS, ".csv"), _("write the model with the cam to a .yaml file, or the table of lifts to a .csv file"))
@force
def run(options: Options, session: Session) -> int:
    """Finds the cam, shows what it does, and writes the model with it, or the table of its lift."""
    from linkwright.cams.compensating_cam import compensating_cam
    from linkwright.cli.files import atomic_write, read_model
    from linkwright.core.expressions import amount
    from linkwright.core.table import csv_text
    from linkwright.files.write import dump

    mechanism, _findings = read_model(options.file, session)
    with about("--zone", UsageError):
        zone = None if options.zone is None else zone_of(options.zone, mechanism.across)
    with about("--span", UsageError):
        span = None if options.span is None else amount(options.span, mechanism.across)
    found = compensating_cam(mechanism, options.of, joint=options.joint, zone=zone, span=span, steps=options.steps)
    if options.output is not None:
        path = Path(options.output)
        text = csv_text(found.columns()) if path.suffix.lower() == ".csv" else dump(found.mechanism)
        atomic_write(path, text, force=options.force)
    session.show_result(found, options.output)
    return 0
