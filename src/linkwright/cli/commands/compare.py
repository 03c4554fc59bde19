"""``linkwright compare``: alternatives side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, argument, count, fonts, force, option
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.base import Number
from linkwright.fields.tables import ByAddress
from linkwright.machine.flywheel import COEFFICIENT, FLUCTUATION
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.designs.compare import Comparison

SUMMARY = _("alternatives side by side: numbers, ranking with reasons, evaluation")
DESCRIPTION = _(
    """\
Compares two or more machines by the motion of an output that they share and by
their design numbers: best values are marked, the ranking gives its reasons, and a
written evaluation is built from the numbers (motion, pivot reaction, balancing
torque, flywheel)."""
)
EXAMPLES = _(
    """\
linkwright compare gallery:jaw_crusher_sixbar gallery:jaw_crusher_fourbar
linkwright compare a.yaml b.yaml --metrics peak_input_torque flywheel
linkwright compare a.yaml b.yaml --weights flywheel=3 peak_reaction=0
linkwright compare a.yaml b.yaml --of jaw ram          the output of each"""
)

ENDINGS = (".csv", ".json")


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@argument(
    "files", "FILE", help=_("two or more model files, or gallery:NAME"), nargs=-1, required=True, model=True
)
@option(
    "--metrics",
    "METRIC",
    help=_(
        "what to compare by: design numbers, travel, output_velocity, output_acceleration, "
        'pivot_reaction, flywheel, or a summary of an output in quotes ("driver.effort rms")',
    ),
    several=True,
)
@option(
    "--weights",
    "NAME=NUMBER",
    of=ByAddress(Number()),
    default={},
    help=_("weights in the ranking, NAME=NUMBER each (1 where none is given)"),
    several=True,
)
@option(
    "--of",
    "NAME",
    help=_("the link or guide that does the work: one name for all, or one per file"),
    several=True,
)
@option(
    "--fluctuation",
    "δ",
    of=COEFFICIENT,
    default=FLUCTUATION,
    help=_("coefficient of speed fluctuation for the flywheels (default 0.02)"),
)
@count("--steps", STEPS, help=_("positions over the cycle (default 360)"))
@option("--output", "FILE", help=_("write the numbers to a .csv, .json, .xlsx, .md or .html file"))
@option("--curves", "FILE", help=_("write the curves to overlay to a .csv or .json file"))
@option("--plot", "FILE", help=_("draw the curves over each other in a .svg, .pdf or .png file"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Compares the machines and prints or writes what came out."""
    if len(options.files) < 2:
        raise UsageError(
            _(
                "{name}: {cause}",
                name="linkwright compare",
                cause=_("one file cannot be compared; name two or more", code="compare.too_few"),
            )
        )
    from linkwright.cli.files import PICTURES, RESULTS, refuse_output
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.designs.compare import compare

    refuse_output(options.output, RESULTS, force=options.force)
    refuse_output(options.curves, ENDINGS, force=options.force)
    refuse_output(options.plot, PICTURES, force=options.force)
    machines = [read_model(name, session)[0] for name in options.files]
    with progress(session, _("computing designs")):
        found = compare(
            machines,
            metrics=options.metrics,
            weights=options.weights,
            output=_outputs(options),
            fluctuation=options.fluctuation,
            steps=options.steps,
        )
    _show(found, options, session)
    return 0


def _outputs(options: Options) -> str | list[str] | None:
    if options.of is None or len(options.of) == 1:
        return None if options.of is None else str(options.of[0])
    if len(options.of) != len(options.files):
        raise UsageError(
            _(
                "--of: {count} names are given for {files} files; name one for all, or one per file",
                code="compare.bad_count",
                count=len(options.of),
                files=len(options.files),
            )
        )
    return list(options.of)


def _show(found: Comparison, options: Options, session: Session) -> None:
    from linkwright.cli.files import curve_columns, curve_data, write_diagram, write_result, write_table
    from linkwright.core.table import csv_text

    write_result(options.output, found, session, force=options.force)
    curves = options.curves
    write_table(
        curves, lambda: csv_text(curve_columns(found)), lambda: curve_data(found), force=options.force
    )
    write_diagram(options.plot, found, session, force=options.force)
    session.show_result(found, options.output, options.curves, options.plot, apart=False)
