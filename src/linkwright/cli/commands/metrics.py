"""``linkwright metrics``: the metrics of a machine."""

from __future__ import annotations

from typing import Literal

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError, refuse_unknown
from linkwright.cli.options import RESULTS, Options, count, flag, force, model, option, output, switch
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.words import _

NO_NAMES = _('--names: "{text}" has an empty place between commas', code="metrics.no_names")


@command(
    _("metrics: transmission angle, strokes, peak torque and reactions, …"),
    _(
        """\
Prints all metrics of a machine that apply to it, each with its value, where
in the cycle it occurs, the recommended limit and a remark. Warnings stand beneath,
closeness to a singular position first."""
    ),
    """\
linkwright metrics gallery:jaw_crusher_sixbar
linkwright metrics press.yaml --names stroke,quick_return_ratio,transmission_angle
linkwright metrics crusher.yaml --output numbers.csv""",
)
@model
@option(
    "--names",
    "NAME,NAME",
    help=_("names of the numbers, separated by commas (default: all that apply; --json shows the names)"),
    several=True,
)
@count("--steps", STEPS, help=_("equal steps over the cycle (default 360); extreme values are refined between them"))
@switch(
    "--forces", None, help=_("joint forces and what follows from them (default: where the model has masses or loads)")
)
@flag("--mark", help=_("leave out positions that cannot be reached instead of refusing"))
@output(RESULTS, _("write the numbers to a .csv or .json file (SI units), or a .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Prints or writes the numbers; 1 where the joint forces failed that some of them need, 2 where some of those
    that are named do not apply."""
    from linkwright.analysis.base import METRICS
    from linkwright.analysis.evaluate import applicable_metrics
    from linkwright.cli.files import read_model, write_result

    names = None if options.names is None else [each.strip() for each in ",".join(options.names).split(",")]
    if not all(names or ()):
        raise UsageError(NO_NAMES.format(text=" ".join(options.names)))
    refuse_unknown(METRICS.__getitem__, "--names", names or ())
    mechanism, _findings = read_model(options.file, session)
    failures: Literal["mark", "raise"] = "mark" if options.mark else "raise"
    found = applicable_metrics(mechanism, names, forces=options.forces, steps=options.steps, failures=failures)
    errors = found.errors(session.language)
    write_result(found.table, options, session)
    if session.json:
        data = {"ok": not errors, **found.table.data(session.language)}
        session.show_data(data | ({"error": "\n".join(errors)} if errors else {}))
    else:
        session.show_tables(found.table)
        session.show_written(options.output, spaced=True)
    for each in errors:
        session.tell_error(each)
    return 2 if found.inapplicable else int(found.error is not None)
