"""``linkwright machine``: motor and flywheel for steady running, of a mechanism or of torque curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import PICTURES, RESULTS, Options, argument, count, fields, flag, force, option, output
from linkwright.cli.session import Session, progress
from linkwright.core.arguments import STEPS
from linkwright.fields.base import Quantity, file_keys
from linkwright.machine.drive_options import OF_SHAFT, DriveOptions
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism

OUTPUT_NEEDS_FILE = _("--output writes the cycle of a mechanism; name a model file", code="machine.output_needs_file")
#: Positions over the cycle at which motors are tried, at most.
MOST_OF_MOTORS = 720
#: Questions about a machine and its actuators, each in place of the layout of motor and flywheel.
QUESTIONS = ("start", "duty", "catalogue", "brake")
NEEDS_FILE = _("{option} is about a machine; name a model file", code="machine.question_needs_file")
NO_PLOT = _("--plot draws what --start, --duty and --catalogue find; add one of them", code="machine.plot_of_nothing")
NONE_TO_DRAW = _("no motor does, so there are no operating points to draw", code="machine.none_to_draw")
FIELDS = file_keys(DriveOptions)
METAVARS = {
    **{"fluctuation": "δ", "ratio": "i", "efficiency": "η", "margin": "NUMBER"},
    **{"disk": "KEY=VALUE,…", "rim": "KEY=VALUE,…", "areas": "MM²,…", "torque": "EXPRESSION"},
    **{name: name.upper() for name in OF_SHAFT},
}
#: Options that say the same, or of which one says nothing of the other's diagram.
OTHERS = ("fluctuation", "disk", "rim", "ratio", "efficiency", "areas", "torque")
EXCLUSIVE = "disk rim, areas torque, areas load, areas period, torque scale, inertia mass, inertia gyration"
NOT_TOGETHER = [
    *(pair.split() for pair in EXCLUSIVE.split(", ")),
    QUESTIONS,
    *((question, other) for question in QUESTIONS for other in OTHERS),
]


@command(
    _("motor and flywheel for steady running, and the speed that results"),
    _(
        """\
Finds what a machine needs to run steadily: mean torque and motor, energy
fluctuation, flywheel for a required coefficient of speed fluctuation (by the usual
formula and exactly), and the true speed over the cycle. Instead of a machine, a
torque diagram can be given by its areas or a torque as an expression of theta.
Of a machine with actuators it says instead, as asked: whether it starts, and with what
margin (--start); what its motor has to do (--duty); which is the smallest motor of a
catalogue that starts it, runs it and survives (--catalogue); and how far it runs on
when it is switched off and braked (--brake)."""
    ),
    """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine crusher.yaml --start --plot start.svg
linkwright machine crusher.yaml --catalogue motors.yaml --margin 1.3
linkwright machine crusher.yaml --brake "400 N·m"
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m""",
    exclusive=NOT_TOGETHER,
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
@flag("--duty", help=_("torque and speed of its motor over the cycle, RMS and peak, energy per cycle, run-up"))
@option(
    "--catalogue",
    "FILE",
    help=_(
        "the smallest motor of a catalogue (.yaml, .csv; example: the one that comes along), started with --margin"
    ),
)
@option(
    "--brake",
    "TORQUE",
    of=Quantity("torque", minimum=0.0),
    help=_("time and angle until it rests, with its brakes and one of this torque on the driver (0 N·m: its own)"),
)
@output(PICTURES, _("draw the torques, or the operating points, in a .svg, .pdf or .png file"), name="--plot")
@output(RESULTS, _("write curves to a .csv file, or all numbers to a .json, .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Lays out motor and flywheel and prints them."""
    from linkwright.cli.files import present, read_model
    from linkwright.machine.drive_design import of_diagram, of_mechanism

    question = next((each for each in QUESTIONS if getattr(options, each) not in (None, False)), None)
    if question is not None:
        return _answer(question, options, session)
    if options.plot is not None:
        raise UsageError(NO_PLOT)
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


def _answer(question: str, options: Options, session: Session) -> int:
    """Answers a question about a machine and its actuators; 1 where it does not start, or a motor does not do."""
    from linkwright.cli.files import present, read_model
    from linkwright.dynamics.verdicts.braking import braking
    from linkwright.dynamics.verdicts.drive_margin import drive_margin
    from linkwright.dynamics.verdicts.motor_duty import motor_duty

    if options.file is None:
        raise UsageError(NEEDS_FILE.format(option=f"--{question}"))
    mechanism, _findings = read_model(options.file, session)
    if question == "catalogue":
        return _choose(mechanism, options, session)
    if question == "brake":
        if options.plot is not None:
            raise UsageError(NO_PLOT)
        present(braking(mechanism, torque=options.brake or None), options, session)
        return 0
    if question == "duty":
        duty = motor_duty(mechanism, steps=options.steps)
        present(duty, options, session)
        return int(not duty.suffices)
    margin = drive_margin(mechanism, steps=options.steps)
    present(margin, options, session)
    return int(bool(margin.stretches))


def _choose(mechanism: Mechanism, options: Options, session: Session) -> int:
    """The smallest motor of a catalogue; 1 where none does."""
    from linkwright.cli.files import write_diagram, write_result
    from linkwright.dynamics.verdicts.motor_choice import choose_motor

    source = None if options.catalogue == "example" else options.catalogue
    with progress(session, _("trying motors")):
        found = choose_motor(
            mechanism, source, margin=options.margin or 1.0, steps=min(options.steps, MOST_OF_MOTORS)
        )
    write_result(found, options, session)
    if options.plot is not None:
        if found.best is None or found.best.duty is None:
            raise UsageError(NONE_TO_DRAW)
        write_diagram(found.best.duty, options, session)
    session.show_result(found, options.output, options.plot)
    return int(found.best is None)
