"""``linkwright run``: the motion of a machine under its loads and actuators."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.errors import NOT_TOGETHER, UsageError
from linkwright.cli.options import PICTURES, RESULTS, Options, count, flag, fonts, force, model, option, output
from linkwright.cli.session import Session
from linkwright.fields.base import Number
from linkwright.fields.tables import PAIRS
from linkwright.words import _


@command(
    _("motion under forces: run-up, coasting, stopping, free motion"),
    _(
        """\
Lets loads, weights and actuators move a machine: the drivers are free but for
those in --prescribed. Prints how it ended, what happened (reversals, impacts at stops,
friction that holds or gives way, loads that switch), its course over time, and what
energy is missing. How it begins and ends is in the section run of the file, before
which options go. Ctrl-C ends it and keeps what was found."""
    ),
    _(
        """\
linkwright run gallery:watt_sixbar --for 2s
linkwright run crusher.yaml --until steady --plot runup.svg --of crank.angular_velocity
linkwright run press.yaml --from rest --at 30deg --until rest --output press.csv
linkwright run fivebar.yaml --at "one=90deg; two=20deg" --for 5s --animate fivebar.svg
linkwright run press.yaml --turns 5 --speed 170rpm --steps 100 --columns "jaw.*"
linkwright run crusher.yaml --vary actuators.motor.torque=2..6N·m:200 --output runs.csv"""
    ),
    exclusive=[("for_time", "turns", "until"), ("from_rest", "speed"), ("vary", "plot"), ("vary", "animate")],
)
@model
@option("--for", "TIME", "for_time", help=_("how long it runs: 10s"))
@option("--turns", "N", of=Number(above=0.0), help=_("how many turns of the first driver it runs"))
@option(
    "--until",
    choices=("steady", "rest"),
    help=_("until each turn is as the one before, or until nothing moves any more"),
)
@option("--at-most", "TIME", "at_most", help=_("with --turns or --until: how long at most (default: 600 s)"))
@option("--from", "rest", "from_rest", choices=("rest",), help=_("rest: without the speed of the file"))
@option("--at", "INPUT", help=_('where it begins: 30deg, or of drivers "NAME=…; NAME=…" (default: as drawn)'))
@option("--speed", "SPEED", help=_('with which rates it begins: 170rpm, or of drivers "NAME=…; NAME=…"'))
@option("--prescribed", "DRIVER", several=True, help=_("drivers whose laws hold, whatever forces that needs"))
@option("--tolerance", "NUMBER", of=Number(above=0.0, maximum=1e-2), help=_("relative error of a step"))
@flag("--stiff", help=_("implicit steps, for stiff springs and motors"))
@count("--steps", help=_("equal steps of the time in table and files (default: 24)"))
@option("--columns", "PATTERN", several=True, help=_('columns by name: "jaw.*", "C.velocity.x", "O5 on jaw"'))
@option("--points", "POINT", several=True, help=_("position, velocity and acceleration of points: C, jaw.D"))
@flag("--si", help=_("angles in rad"))
@option(
    "--vary",
    "RANGE",
    of=PAIRS,
    several=True,
    help=_('run many designs side by side: "ADDRESS=FROM..TO UNIT:NUMBER"; several make a grid'),
)
@output(RESULTS, _("write the course over time to a .csv, .json, .xlsx, .md or .html file (SI units)"))
@output(PICTURES, _("draw curves over time in a .svg, .pdf or .png file"), name="--plot")
@option("--kind", "KIND", default="sva", help=_("kind of diagram, as for linkwright plot (default: sva)"))
@option("--of", "NAME", several=True, default=[], help=_("outputs, links or points of the curves: jaw, guide, C"))
@output((".svg", ".gif", ".mp4"), _("show it in true time in a .svg, .gif or .mp4 file"), name="--animate")
@option("--paths", "POINT", several=True, help=_("paths of points in the moving drawing: C, jaw.D"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Runs the machine and prints or writes the result; 1 where it did not come to its end."""
    from linkwright.cli.running import run_alone, run_many

    if options.at_most is not None and options.for_time is not None:
        raise UsageError(NOT_TOGETHER.format(name="--at-most", other="--for"))
    return run_alone(options, session) if options.vary is None else run_many(options, session)
