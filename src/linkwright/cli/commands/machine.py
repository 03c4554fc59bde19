"""``linkwright machine``: motor and flywheel for steady running, of a mechanism or of torque curves."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.machine_options import Wanted
from linkwright.cli.options import Options, argument, count, fields, force, option
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.core.rows import Block
from linkwright.fields.base import file_keys
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.cli.machine_rows import Layout

SUMMARY = _("motor and flywheel for steady running, and the speed that results")
DESCRIPTION = _(
    """\
Finds what a machine needs to run steadily: mean torque and motor, energy
fluctuation, flywheel for a required coefficient of speed fluctuation (by the usual
formula and exactly), and the true speed over the cycle. Instead of a machine, a
torque diagram can be given by its areas or a torque as an expression of theta."""
)
EXAMPLES = """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m"""

FIELDS = file_keys(Wanted)
CURVE_OPTIONS = ("scale", "load", "period", "speed", "inertia", "mass", "gyration")
#: Options that say the same, or of which one says nothing of the other's diagram.
APART = (
    ("areas", "load"), ("areas", "period"), ("torque", "scale"), ("inertia", "mass"), ("inertia", "gyration"),
)  # fmt: skip


@command(SUMMARY, DESCRIPTION, EXAMPLES, exclusive=[("disk", "rim"), ("areas", "torque"), *APART])
@argument(
    "file",
    "FILE",
    help=_("model file, or gallery:NAME; leave it out with --areas or --torque"),
    required=False,
    model=True,
)
@fields(FIELDS, {"fluctuation": "δ", "ratio": "i", "efficiency": "η", "margin": "NUMBER"})
@fields(FIELDS, {"disk": "KEY=VALUE,…", "rim": "KEY=VALUE,…"})
@fields(FIELDS, {"areas": "MM²,…", "torque": "EXPRESSION"})
@fields(FIELDS, {name: name.upper() for name in CURVE_OPTIONS})
@count(
    "--steps",
    STEPS,
    help=_("positions over the cycle (default 360); what lies between them is found exactly"),
)
@option(
    "--output",
    "FILE",
    help=_("write curves to a .csv file, or all numbers to a .json, .xlsx, .md or .html file"),
)
@force
def run(options: Options, session: Session) -> int:
    """Lays out motor and flywheel and prints them."""
    _refuse_contradictions(options)
    texts = {name: getattr(options, name) for name in FIELDS}
    asked = Wanted(**{name: each for name, each in texts.items() if each is not None})
    if options.file is not None:
        return _mechanism(options, asked, session)
    if asked.speed is None and (asked.fluctuation is not None or asked.present):
        raise UsageError(
            _(
                "a flywheel or a speed fluctuation needs the mean speed; add --speed, such as --speed 180rpm",
                code="machine.needs_speed",
            )
        )
    if asked.size is not None and asked.fluctuation is None:
        raise UsageError(
            _(
                "the dimensions of a flywheel need to know how even the speed must be; add "
                "--fluctuation, such as --fluctuation 0.01",
                code="machine.shape_needs_fluctuation",
            )
        )
    session.show_result(_curves(options, asked, session))
    return 0


def _refuse_contradictions(options: Options) -> None:
    curves = "--areas" if options.areas is not None else "--torque" if options.torque is not None else None
    if options.file is None and curves is None:
        raise UsageError(
            _(
                "name a model file, or give a torque diagram with --areas or --torque; see "
                "linkwright machine --help",
                code="machine.nothing_given",
            )
        )
    from_curves = [f"--{name}" for name in CURVE_OPTIONS if getattr(options, name) is not None]
    if options.file is not None and (curves or from_curves):
        raise UsageError(
            _(
                "{option} describes a torque diagram; it cannot be used together with a model file",
                code="machine.not_with_file",
                option=curves or from_curves[0],
            )
        )
    if options.file is None and options.output is not None:
        raise UsageError(
            _("--output writes the cycle of a mechanism; name a model file", code="machine.output_needs_file")
        )
    if options.areas is not None and options.areas[1] is None:
        raise UsageError(
            _(
                '--areas needs the scales of the diagram: --scale "5 N·m/mm, 1 deg/mm"',
                code="machine.no_scale",
            )
        )
    if (options.mass is None) != (options.gyration is None):
        raise UsageError(
            _(
                "--mass and --gyration belong together; give both, or --inertia",
                code="machine.mass_and_gyration",
            )
        )


def _mechanism(options: Options, asked: Wanted, session: Session) -> int:
    from linkwright.cli.files import RESULTS, refuse_output, write_result
    from linkwright.cli.machine_rows import Layout, dimensions
    from linkwright.cli.source import read_model
    from linkwright.kinetostatics.run import solve_forces
    from linkwright.machine.flywheel import FLUCTUATION
    from linkwright.machine.running import steady_running

    refuse_output(options.output, RESULTS, force=options.force)
    mechanism, _unused = read_model(options.file, session)
    forces = solve_forces(mechanism, steps=options.steps)
    running = steady_running(
        forces,
        fluctuation=FLUCTUATION if asked.fluctuation is None else asked.fluctuation,
        ratio=asked.ratio,
        efficiency=asked.efficiency,
        margin=asked.margin,
    )
    sized = Block("dimensions", "", dimensions(running.exact_flywheel, running.equivalent.speed, asked))
    found = Layout(mechanism.name, lambda say: [*running.blocks(say), sized], running)
    write_result(options.output, found, session, force=options.force)
    session.show_result(found, options.output)
    return 0


def _curves(options: Options, asked: Wanted, session: Session) -> Layout:
    from linkwright.cli.machine_rows import Layout, of_areas, of_curves
    from linkwright.machine.energy import fluctuation_from_areas

    say = session.say
    if asked.areas is not None:
        given, scales = asked.areas
        torque, angle = scales or (1.0, 1.0)
        energy = fluctuation_from_areas(given, torque_scale=torque, angle_scale=angle)
        title = say(_("Torque diagram of {count} areas", count=len(given)))
        return Layout(title, partial(of_areas, energy, asked))
    assert asked.torque is not None
    text, driver = asked.torque
    against, load = asked.load or (say(_("its mean")), None)
    title = say(_("T = {torque}, against {load}", torque=text, load=against))
    return Layout(title, partial(of_curves, driver, load, asked))
