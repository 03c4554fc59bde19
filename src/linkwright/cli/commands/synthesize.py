"""``linkwright synthesize``: dimensions from what the machine must do."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, argument, cluster, flag, fonts, force, option, state
from linkwright.cli.session import Session
from linkwright.core.table import Amount, Cell, Table
from linkwright.fields.base import Number
from linkwright.synthesis.names import TASK_NAMES
from linkwright.words import _, pgettext

if TYPE_CHECKING:
    from linkwright.synthesis.result import Synthesis, SynthesisError

SUMMARY = _("find dimensions from what the machine must do")
DESCRIPTION = _(
    """\
Finds linkages for a task: a path, a free curve, poses, a function, or requirements such as
stroke and quick-return ratio. Shows every candidate with its error, Grashof
type, defects over the whole range, smallest transmission angle and ratio of
longest to shortest link; writes each as a model file. The task stands in the
section "synthesis" of a file, or on the command line as KEY=VALUE."""
)
EXAMPLES = """\
linkwright synthesize slider_crank stroke="397.5 mm" rod_ratio=3.55 offset_ratio=0.305
linkwright synthesize crank_rocker swing_angle="40 deg" quick_return_ratio=1.2 frame="300 mm" --output designs
linkwright synthesize path points="[[20, 20], [20, 30], [20, 40]]" unit=mm --plot path.svg
linkwright synthesize free_curve file=letter.svg joints=10 --output designs --plot letter.png
linkwright synthesize press.yaml --json"""


@command(SUMMARY, DESCRIPTION, EXAMPLES)
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
@option("--plot", "FILE", help=_("draw target, candidates and curves in a .svg, .pdf or .png file"))
@flag(
    "--worked",
    help=_(
        "how the first candidate was found: given values, equations with their numbers, check, choice",
    ),
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
    """Runs the task and shows or writes its candidates."""
    from linkwright.cli.files import PICTURES, refuse_output
    from linkwright.synthesis.linkage import input_speed
    from linkwright.synthesis.result import SynthesisError

    refuse_output(options.plot, PICTURES, force=options.force)
    input_speed(options.speed)
    task, demands = _asked(options, session)
    if options.output is not None:
        _refuse_folder(Path(options.output), task, force=options.force)
    try:
        found = _solve(task, demands, options, session)
    except SynthesisError as error:
        return _unmet(error, options, session)
    _show(found, options, session)
    return 0


def _refuse_folder(folder: Path, task: str, *, force: bool) -> None:
    """Raises RequestError, before anything is sought, where models cannot be written into a folder."""
    from linkwright.cli.files import refuse_existing
    from linkwright.filesystem import refuse_folder

    refuse_folder(folder)
    if folder.is_dir():
        refuse_existing(_model_file(folder, task, 0), force=force)


def _model_file(folder: Path, task: str, index: int) -> Path:
    return folder / f"{task}_{index + 1}.yaml"


def _solve(task: str, demands: dict[str, Any], options: Options, session: Session) -> Synthesis:
    from linkwright.cli.progress import resumable
    from linkwright.designs.cluster import on_cluster
    from linkwright.synthesis.tasks import synthesize

    with resumable(options.state, task, (task, demands), session), on_cluster(options.cluster):
        return synthesize(task, **demands)


def _asked(options: Options, session: Session) -> tuple[str, dict[str, Any]]:
    """The task and its demands, from a file or the command line."""
    from linkwright.files.source import GALLERY
    from linkwright.synthesis.tasks import asked_in, asked_of

    if options.task not in TASK_NAMES and not options.demands:
        near = Path(options.task)
        if not near.suffix and not near.exists() and not options.task.startswith(GALLERY):
            return options.task, {}
        return asked_of(options.task)
    for text in options.demands:
        if not text.partition("=")[1]:
            raise UsageError(
                _(
                    '"{text}" is no demand; write KEY=VALUE, such as stroke="40 mm"',
                    code="synthesize.bad_demand",
                    text=text,
                )
            )
    pairs = (text.partition("=") for text in options.demands)
    lines = [f"  {key.strip()}: {value.strip()}" for key, _unused, value in pairs]
    return asked_in("\n".join(["synthesis:", f"  task: {options.task}", *lines]), "synthesize")


def _unmet(error: SynthesisError, options: Options, session: Session) -> int:
    """Says which demand fails, and shows the nearest solution."""
    sentence = error.say(session.language)
    session.tell_error(sentence)
    if session.json:
        nearest = None if error.nearest is None else error.nearest.data()
        session.show_data({"ok": False, "error": sentence, "nearest": nearest})
    elif error.nearest is not None:
        _show(error.nearest, options, session)
    return 1


def _show(found: Synthesis, options: Options, session: Session) -> None:
    from linkwright.cli.files import atomic_write, write_diagram
    from linkwright.filesystem import make_folder

    mass, speed = options.mass, options.speed
    efforts = [] if mass is None else [each.loads(mass, speed=speed) for each in found]
    written = []
    if options.output is not None:
        folder = make_folder(options.output)
        for index in range(len(found)):
            path = _model_file(folder, found.task, index)
            text = found.model_text(index, language=session.language, speed=options.speed)
            atomic_write(path, text, force=options.force)
            written.append(path)
    if options.plot is not None:
        write_diagram(options.plot, found, session, force=options.force)
        written.append(Path(options.plot))
    worked = found.worked(session.language) if options.worked else None
    if session.json:
        data = found.data() | ({} if worked is None else {"worked": worked.data()})
        for each, effort in zip(data["candidates"], efforts, strict=False):
            each |= effort
        session.show_data({"ok": True, **data})
        return
    if worked is None:
        session.show_tables(found)
    else:
        session.show(worked.text())
    if efforts:
        session.show("\n" + "\n".join(_effort_table(efforts).lines(session.language)))
    session.show_written(*written)


def _effort_table(efforts: list[dict[str, float]]) -> Table:
    head = (_("no."), _("peak torque"), pgettext("synthesize", "peak reaction"))
    rows: list[list[Cell]] = [
        [number, Amount(each["peak_input_torque"], "torque", 5), Amount(each["peak_reaction"], "force", 5)]
        for number, each in enumerate(efforts, 1)
    ]
    return Table(head, rows, ">>>")
