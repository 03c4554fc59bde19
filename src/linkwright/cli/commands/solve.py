"""``linkwright solve``: motion and forces over a cycle."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.errors import NOT_TOGETHER, UsageError
from linkwright.cli.options import TABLES, Options, count, flag, force, model, option, output, positions, switch
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("motion, joint forces and drive effort over the cycle"),
    _(
        """\
Solves a mechanism over one cycle, or at the inputs or times that you name, and
prints a table: the input, angle, velocity and acceleration of the links, and what
the driver must supply. Beneath it stand the largest force in every joint and the
checks of the result. Angles are in degrees (--si: rad), counter-clockwise positive."""
    ),
    _(
        """\
linkwright solve gallery:jaw_crusher_sixbar
linkwright solve crusher.yaml --at 0..90deg:10        every 10° of the input
linkwright solve crusher.yaml --at "0 deg, 30 deg" --points C jaw.D
linkwright solve crusher.yaml --columns "jaw.*" "O5 on jaw"
linkwright solve crusher.yaml --steps 360 --output crusher.csv
linkwright solve gallery:excavator --times "0..8 s:0.5" --json
linkwright solve crusher.yaml --free --at 30deg --worked    let go: accelerations, forces"""
    ),
    exclusive=[("steps", "at", "times"), ("worked", "output")],
)
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
@switch("--forces", None, help=_("joint forces and driver effort (default: where the model has masses or loads)"))
@flag("--static", help=_("forces without inertia"))
@flag("--mark", help=_("leave gaps where a position cannot be reached, and say why, instead of refusing"))
@flag("--prove", help=_("prove that the assembly mode does not change in any step, where groups have no closed form"))
@flag(
    "--worked",
    help=_(
        "the worked solution of the position (of each one named with --at or --times): every "
        "equation, the numbers put in, the result"
    ),
)
@flag("--free", help=_("nothing drives: accelerations and reactions from the forces alone, let go at rest"))
@option("--speed", "SPEED", help=_('with --free: rates at that moment: 2rad/s, or of drivers "NAME=…; NAME=…"'))
@flag("--si", help=_("angles in rad"))
@output(TABLES, _("write all columns in SI units to FILE.csv or FILE.json"))
@force
def run(options: Options, session: Session) -> int:
    """Solves a model and prints or writes the results; 1 where a position or the forces failed."""
    from linkwright.cli.files import read_model, write_table
    from linkwright.cli.solve_text import report, worked_pages
    from linkwright.cli.solving import data, named_columns, solve

    if options.static and options.forces is False:
        raise UsageError(NOT_TOGETHER.format(name="--static", other="--no-forces"))
    if options.speed is not None and not options.free:
        raise UsageError(
            _("--speed goes with --free: without it the drivers' laws say the rates", code="solve.speed")
        )
    if options.free:
        from linkwright.cli.releasing import free_run

        return free_run(*read_model(options.file, session), options, session)
    solved = solve(*read_model(options.file, session), options)
    if options.worked and solved.trouble is None:
        pages = worked_pages(solved, options, session)
        if session.json:
            session.show_data({"worked": [page.data() for page in pages]})
        else:
            session.show("\n\n\n".join(page.text() for page in pages))
        return 0
    if options.output is not None:
        write_table(options.output, named_columns(solved, options), data(solved, options), force=options.force)
    if session.json:
        session.show_data(data(solved, options))
    elif options.output is None:
        session.show(*report(solved, options, session))
    else:
        session.show_written(options.output)
    if solved.trouble is not None:
        session.tell_error(solved.trouble.translate(session.language))
    return int(solved.trouble is not None or not solved.motion.complete)
