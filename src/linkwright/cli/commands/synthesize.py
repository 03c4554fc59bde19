"""``linkwright synthesize``: dimensions from what the machine must do."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import PICTURES, Options, argument, cluster, flag, fonts, force, option, output, state
from linkwright.cli.session import Session
from linkwright.fields.base import Number
from linkwright.synthesis.names import TASK_NAMES
from linkwright.words import _


@command(
    _("find dimensions from what the machine must do"),
    _(
        """\
Finds linkages for a task: a path, a free curve, poses, a function, or requirements such as
stroke and quick-return ratio. Shows every candidate with its error, Grashof
type, defects over the full range, smallest transmission angle and ratio of
longest to shortest link; writes each as a model file. The task is in the
section "synthesis" of a file, or on the command line as KEY=VALUE."""
    ),
    """\
linkwright synthesize slider_crank stroke="397.5 mm" rod_ratio=3.55 offset_ratio=0.305
linkwright synthesize crank_rocker swing_angle="40 deg" quick_return_ratio=1.2 frame="300 mm" --output designs
linkwright synthesize path points="[[20, 20], [20, 30], [20, 40]]" unit=mm --plot path.svg
linkwright synthesize free_curve file=letter.svg joints=10 --output designs --plot letter.png
linkwright synthesize press.yaml --json""",
)
@argument(
    "task",
    "FILE|TASK",
    help=_("a file with a section synthesis, or the name of a task: {tasks}", tasks=", ".join(TASK_NAMES)),
)
@argument(
    "demands",
    "KEY=VALUE",
    help=_('demands of the task, such as stroke="40 mm"; lists in brackets as in a file'),
    nargs=-1,
)
@option("--output", "FOLDER", help=_("write every candidate as a model file into this folder"))
@output(PICTURES, _("draw target, candidates and curves in a .svg, .pdf or .png file"), name="--plot")
@flag(
    "--worked", help=_("how the first candidate was found: given values, equations with their numbers, check, choice")
)
@option(
    "--mass",
    "KG/M",
    of=Number(above=0.0),
    help=_("also peak input torque and reaction, for links of this mass per length (kg/m)"),
)
@option(
    "--speed",
    "SPEED",
    default="60 rpm",
    help=_("speed of the input link in model files and for --mass (default 60 rpm)"),
)
@cluster
@state
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Runs the task and shows or writes its candidates; 1 where a demand cannot be met."""
    from linkwright.cli import candidates
    from linkwright.cli.session import resumable
    from linkwright.designs.cluster import on_cluster
    from linkwright.synthesis.linkage import input_speed
    from linkwright.synthesis.result import SynthesisError
    from linkwright.synthesis.tasks import synthesize

    input_speed(options.speed)
    task, demands = candidates.task_of(options.task, options.demands)
    candidates.refuse_folder(options.output, task, force=options.force)
    try:
        with resumable(options.state, task, (task, demands), session), on_cluster(options.cluster):
            found = synthesize(task, **demands)
    except SynthesisError as error:
        session.tell_unmet(error, error.nearest)
        if error.nearest is not None and not session.json:
            candidates.show(error.nearest, options, session)
        return 1
    candidates.show(found, options, session)
    return 0
