"""``linkwright machine``: motor and flywheel for steady running, of a mechanism or of torque curves."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import RESULTS, Options, argument, count, fields, force, output
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.base import file_keys
from linkwright.machine.drive_options import DriveOptions
from linkwright.words import _

CURVE_OPTIONS = ("scale", "load", "period", "speed", "inertia", "mass", "gyration")
NO_INPUT = _(
    "name a model file, or give a torque diagram with --areas or --torque; see linkwright machine --help",
    code="machine.nothing_given",
)
OUTPUT_NEEDS_FILE = _("--output writes the cycle of a mechanism; name a model file", code="machine.output_needs_file")
NOT_WITH_FILE = _(
    "{option} describes a torque diagram; it cannot be used together with a model file", code="machine.not_with_file"
)
NO_SCALE = _('--areas needs the scales of the diagram: --scale "5 N·m/mm, 1 deg/mm"', code="machine.no_scale")
MASS_AND_GYRATION = _(
    "--mass and --gyration belong together; give both, or --inertia", code="machine.mass_and_gyration"
)
FIELDS = file_keys(DriveOptions)
#: Options that say the same, or of which one says nothing of the other's diagram.
EXCLUSIVE = (
    *(("areas", "load"), ("areas", "period"), ("torque", "scale")),
    *(("inertia", "mass"), ("inertia", "gyration")),
)


@command(
    _("motor and flywheel for steady running, and the speed that results"),
    _(
        """\
Finds what a machine needs to run steadily: mean torque and motor, energy
fluctuation, flywheel for a required coefficient of speed fluctuation (by the usual
formula and exactly), and the true speed over the cycle. Instead of a machine, a
torque diagram can be given by its areas or a torque as an expression of theta."""
    ),
    """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m""",
    exclusive=[("disk", "rim"), ("areas", "torque"), *EXCLUSIVE],
)
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
@count("--steps", STEPS, help=_("positions over the cycle (default 360); what lies between them is found exactly"))
@output(RESULTS, _("write curves to a .csv file, or all numbers to a .json, .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Lays out motor and flywheel and prints them."""
    from linkwright.cli.files import present, read_model
    from linkwright.machine.drive_design import of_diagram, of_mechanism

    _refuse_contradictions(options)
    values = {name: getattr(options, name) for name in FIELDS}
    flywheel = DriveOptions(**{name: each for name, each in values.items() if each is not None})
    if options.file is None:
        flywheel.require_speed()
        session.show_result(of_diagram(flywheel, session.translate))
        return 0
    mechanism, _findings = read_model(options.file, session)
    present(of_mechanism(mechanism, flywheel, options.steps), options, session)
    return 0


def _refuse_contradictions(options: Options) -> None:
    """Raises UsageError for options that belong together, or exclude each other or a model file."""
    diagram = next((f"--{each}" for each in ("areas", "torque") if getattr(options, each) is not None), None)
    if options.file is None:
        if diagram is None:
            raise UsageError(NO_INPUT)
        if options.output is not None:
            raise UsageError(OUTPUT_NEEDS_FILE)
    else:
        of_curves = [f"--{name}" for name in CURVE_OPTIONS if getattr(options, name) is not None]
        if diagram or of_curves:
            raise UsageError(NOT_WITH_FILE.format(option=diagram or of_curves[0]))
    if options.areas is not None and options.areas[1] is None:
        raise UsageError(NO_SCALE)
    if (options.mass is None) != (options.gyration is None):
        raise UsageError(MASS_AND_GYRATION)
