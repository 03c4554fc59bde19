"""``linkwright machine``: motor and flywheel for steady running, of a mechanism or of torque curves."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import PICTURES, RESULTS, Options, argument, count, fields, flag, force, output
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.base import file_keys
from linkwright.machine.drive_options import OF_SHAFT, DriveOptions
from linkwright.words import _

OUTPUT_NEEDS_FILE = _("--output writes the cycle of a mechanism; name a model file", code="machine.output_needs_file")
START_NEEDS_FILE = _("--start is about a machine; name a model file", code="machine.start_needs_file")
PLOT_NEEDS_START = _("--plot draws what --start finds; add --start", code="machine.plot_needs_start")
FIELDS = file_keys(DriveOptions)
METAVARS = {
    **{"fluctuation": "δ", "ratio": "i", "efficiency": "η", "margin": "NUMBER"},
    **{"disk": "KEY=VALUE,…", "rim": "KEY=VALUE,…", "areas": "MM²,…", "torque": "EXPRESSION"},
    **{name: name.upper() for name in OF_SHAFT},
}
#: Options that say the same, or of which one says nothing of the other's diagram.
OF_START = "start fluctuation, start disk, start rim, start ratio, start areas, start torque"
EXCLUSIVE = (
    f"{OF_START}, disk rim, areas torque, areas load, areas period, torque scale, inertia mass, inertia gyration"
)


@command(
    _("motor and flywheel for steady running, and the speed that results"),
    _(
        """\
Finds what a machine needs to run steadily: mean torque and motor, energy
fluctuation, flywheel for a required coefficient of speed fluctuation (by the usual
formula and exactly), and the true speed over the cycle. Instead of a machine, a
torque diagram can be given by its areas or a torque as an expression of theta.
With --start it says instead whether the machine starts with its actuators, and with
what margin, position by position."""
    ),
    """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine crusher.yaml --start --plot start.svg
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m""",
    exclusive=[pair.split() for pair in EXCLUSIVE.split(", ")],
)
@argument(
    "file",
    "FILE",
    help=_("model file, or gallery:NAME; leave it out with --areas or --torque"),
    required=False,
    model=True,
)
@fields(FIELDS, METAVARS)
@count("--steps", STEPS, help=_("positions over the cycle (default 360); what lies between them is found exactly"))
@flag(
    "--start", help=_("whether the machine starts with its actuators from every position; 1 as exit code where not")
)
@output(
    PICTURES, _("draw the torque needed and available (with --start) in a .svg, .pdf or .png file"), name="--plot"
)
@output(RESULTS, _("write curves to a .csv file, or all numbers to a .json, .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Lays out motor and flywheel and prints them."""
    from linkwright.cli.files import present, read_model
    from linkwright.machine.drive_design import of_diagram, of_mechanism

    if options.start:
        return _start(options, session)
    if options.plot is not None:
        raise UsageError(PLOT_NEEDS_START)
    values = {name: getattr(options, name) for name in FIELDS}
    asked = DriveOptions(**{name: each for name, each in values.items() if each is not None})
    asked.require_consistent(of_machine=options.file is not None)
    if options.file is None:
        if options.output is not None:
            raise UsageError(OUTPUT_NEEDS_FILE)
        session.show_result(of_diagram(asked, session.translate))
    else:
        mechanism, _findings = read_model(options.file, session)
        present(of_mechanism(mechanism, asked, options.steps), options, session)
    return 0


def _start(options: Options, session: Session) -> int:
    """Whether the machine starts; 1 where it does not from every position."""
    from linkwright.cli.files import present, read_model
    from linkwright.dynamics.verdicts.drive_margin import drive_margin

    if options.file is None:
        raise UsageError(START_NEEDS_FILE)
    mechanism, _findings = read_model(options.file, session)
    found = drive_margin(mechanism, steps=options.steps)
    present(found, options, session)
    return int(bool(found.stretches))
