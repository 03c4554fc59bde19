"""``linkwright solve``: motion and forces over a cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, count, flag, force, model, option, positions, switch
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.cli.solving import Solved

SUMMARY = _("motion, joint forces and drive effort over the cycle")
DESCRIPTION = _(
    """\
Solves a mechanism over one cycle, or at the inputs or times that you name, and
prints a table: the input, angle, velocity and acceleration of the links, and what
the driver must supply. Beneath it stand the largest force in every joint and the
checks of the result. Angles are in degrees (--si: rad), counter-clockwise positive."""
)
EXAMPLES = _(
    """\
linkwright solve gallery:jaw_crusher_sixbar
linkwright solve crusher.yaml --at 0..90deg:10        every 10° of the input
linkwright solve crusher.yaml --at "0 deg, 30 deg" --points C jaw.D
linkwright solve crusher.yaml --columns "jaw.*" "O5 on jaw"
linkwright solve crusher.yaml --steps 360 --output crusher.csv
linkwright solve gallery:excavator --times "0..8 s:0.5" --json"""
)

ENDINGS = (".csv", ".json")


@command(SUMMARY, DESCRIPTION, EXAMPLES, exclusive=[("steps", "at", "times")])
@model
@count("--steps", help=_("equal steps over the cycle (default: 24)"))
@positions
@option(
    "--columns",
    "PATTERN",
    help=_('columns by name: "jaw.*", "C.velocity.x", "O5 on jaw"; --json shows all names'),
    several=True,
)
@option("--points", "POINT", help=_("position, velocity and acceleration of points: C, jaw.D"), several=True)
@switch(
    "--forces", None, help=_("joint forces and driver effort (default: where the model has masses or loads)")
)
@flag("--static", help=_("forces without inertia"))
@flag("--mark", help=_("leave gaps where a position cannot be reached, and say why, instead of refusing"))
@flag("--prove", help=_("prove that the assembly is kept in every step, where groups have no closed form"))
@flag(
    "--worked",
    help=_(
        "the worked solution of the position (of each one named with --at or --times): every "
        "equation, the numbers put in, the result",
    ),
)
@flag("--si", help=_("angles in rad"))
@option("--output", "FILE", help=_("write all columns in SI units to FILE.csv or FILE.json"))
@force
def run(options: Options, session: Session) -> int:
    """Solves a model and prints or writes the results; 1 where a position or the forces failed."""
    _refuse_contradictions(options)
    from linkwright.cli.solving import solve
    from linkwright.cli.source import read_model

    solved = solve(*read_model(options.file, session), options)
    if options.worked and solved.trouble is None:
        _show_worked(solved, options, session)
        return 0
    if options.output is not None:
        _write(solved, options, session)
    if session.json:
        from linkwright.cli.solve_remarks import data

        session.show_data(data(solved, options))
    elif options.output is None:
        from linkwright.cli.solve_text import report

        session.show(*report(solved, options, session))
    if solved.trouble is not None:
        session.tell_error(solved.trouble.say(session.language))
    return int(solved.trouble is not None or not solved.motion.complete)


def _show_worked(solved: Solved, options: Options, session: Session) -> None:
    """The worked solution of the positions that were named, or of the first one."""
    from linkwright.worked_solutions.solution import worked

    rows = solved.rows if options.at or options.times else solved.rows[:1]
    source = solved.motion if solved.forces is None else solved.forces
    pages = [worked(source, int(row), language=session.language) for row in rows]
    if session.json:
        session.show_data({"worked": [page.data() for page in pages]})
    else:
        session.show("\n\n\n".join(page.text() for page in pages))


def _refuse_contradictions(options: Options) -> None:
    if options.worked and options.output is not None:
        raise UsageError(
            _(
                "{name} cannot be used together with {other}",
                code="cli.not_together",
                name="--worked",
                other="--output",
            )
        )
    if options.static and options.forces is False:
        raise UsageError(
            _(
                "{name} cannot be used together with {other}",
                code="cli.not_together",
                name="--static",
                other="--no-forces",
            )
        )
    if options.output is not None:
        from linkwright.cli.files import refuse_output

        refuse_output(options.output, ENDINGS, force=options.force)


def _write(solved: Solved, options: Options, session: Session) -> None:
    from pathlib import Path

    from linkwright.cli.files import write_table
    from linkwright.cli.solve_remarks import data
    from linkwright.cli.solving import named_columns
    from linkwright.core.table import csv_text

    asked = solved, options
    write_table(
        options.output, lambda: csv_text(named_columns(*asked)), lambda: data(*asked), force=options.force
    )
    if not session.json:
        session.show_written(Path(options.output))
