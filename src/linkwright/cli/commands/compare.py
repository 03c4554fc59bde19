"""``linkwright compare``: alternatives side by side."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import PICTURES, RESULTS, TABLES, Options, argument, count, fonts, force, option, output
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.base import Number
from linkwright.fields.tables import ByAddress
from linkwright.machine.flywheel import COEFFICIENT, FLUCTUATION
from linkwright.words import _

TOO_FEW = _(
    "{name}: {cause}",
    name="linkwright compare",
    cause=_("one file cannot be compared; name two or more", code="compare.too_few"),
)
BAD_COUNT = _(
    "--of: {count} names are given for {files} files; name one for all, or one per file", code="compare.bad_count"
)


@command(
    _("alternatives side by side: numbers, ranking with reasons, evaluation"),
    _(
        """\
Compares two or more machines by the motion of an output that they share and by
their metrics: best values are marked, the ranking gives its reasons, and a
written evaluation is built from the numbers (motion, pivot reaction, balancing
torque, flywheel)."""
    ),
    _(
        """\
linkwright compare gallery:jaw_crusher_sixbar gallery:jaw_crusher_fourbar
linkwright compare a.yaml b.yaml --metrics peak_input_torque flywheel
linkwright compare a.yaml b.yaml --weights flywheel=3 peak_reaction=0
linkwright compare a.yaml b.yaml --of jaw ram          the output of each"""
    ),
)
@argument("files", "FILE", nargs=-1, required=True, model=True, help=_("two or more model files, or gallery:NAME"))
@option(
    "--metrics",
    "METRIC",
    several=True,
    help=_(
        "what to compare by: metrics, travel, output_velocity, output_acceleration, "
        'pivot_reaction, flywheel, or a summary of an output in quotes ("driver.effort rms")'
    ),
)
@option(
    "--weights",
    "NAME=NUMBER",
    of=ByAddress(Number()),
    several=True,
    default={},
    help=_("weights in the ranking, NAME=NUMBER each (1 where none is given)"),
)
@option(
    "--of", "NAME", several=True, help=_("the link or guide that does the work: one name for all, or one per file")
)
@option(
    "--fluctuation",
    "δ",
    of=COEFFICIENT,
    default=FLUCTUATION,
    help=_("coefficient of speed fluctuation for the flywheels (default 0.02)"),
)
@count("--steps", STEPS, help=_("positions over the cycle (default 360)"))
@output(RESULTS, _("write the numbers to a .csv, .json, .xlsx, .md or .html file"))
@output(TABLES, _("write the curves to overlay to a .csv or .json file"), name="--curves")
@output(PICTURES, _("draw the curves over each other in a .svg, .pdf or .png file"), name="--plot")
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Compares the machines and prints or writes what came out."""
    from linkwright.cli.files import present, read_model, write_table
    from linkwright.cli.session import progress
    from linkwright.designs.compare import compare, overlay_columns, overlay_data

    if len(options.files) < 2:
        raise UsageError(TOO_FEW)
    of = options.of or []
    if len(of) not in (0, 1, len(options.files)):
        raise UsageError(BAD_COUNT.format(count=len(of), files=len(options.files)))
    machines = [read_model(name, session)[0] for name in options.files]
    with progress(session, _("computing designs")):
        found = compare(
            machines,
            metrics=options.metrics,
            weights=options.weights,
            output=of if len(of) > 1 else of[0] if of else None,
            fluctuation=options.fluctuation,
            steps=options.steps,
        )
    if options.curves is not None:
        curves = found.curves
        write_table(options.curves, overlay_columns(curves), overlay_data(curves), force=options.force)
    present(found, options, session, options.curves, spaced=False)
    return 0
