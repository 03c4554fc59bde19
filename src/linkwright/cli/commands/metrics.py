"""``linkwright metrics``: the design numbers of a machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, count, flag, force, model, option, switch
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.errors import LinkwrightError, about
from linkwright.words import _
from linkwright.words.sentence import in_language

if TYPE_CHECKING:
    from linkwright.analysis.table import MetricsTable
    from linkwright.kinematics.motion import Motion
    from linkwright.mechanism.mechanism import Mechanism

SUMMARY = _("design numbers: transmission angle, strokes, peak torque and reactions, …")
DESCRIPTION = _(
    """\
Prints all design numbers of a machine that apply to it, each with its value, where
in the cycle it occurs, the recommended limit and a remark. Warnings stand beneath,
closeness to a singular position first."""
)
EXAMPLES = """\
linkwright metrics gallery:jaw_crusher_sixbar
linkwright metrics press.yaml --names stroke,quick_return_ratio,transmission_angle
linkwright metrics crusher.yaml --output numbers.csv"""


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@model
@option(
    "--names",
    "NAME,NAME",
    help=_(
        "names of the numbers, separated by commas (default: all that apply; --json shows the names)",
    ),
    several=True,
)
@count(
    "--steps",
    STEPS,
    help=_("equal steps over the cycle (default 360); extreme values are refined between them"),
)
@switch(
    "--forces",
    None,
    help=_(
        "joint forces and what follows from them (default: where the model has masses or loads)",
    ),
)
@flag("--mark", help=_("leave out positions that cannot be reached instead of refusing"))
@option(
    "--output",
    "FILE",
    help=_("write the numbers to a .csv or .json file (SI units), or a .xlsx, .md or .html file"),
)
@force
def run(options: Options, session: Session) -> int:
    """Prints or writes the numbers; 1 where the joint forces failed that some of them need, 2 where some of those
    that are named do not apply."""
    from linkwright.cli.files import RESULTS, refuse_output, write_result
    from linkwright.cli.source import read_model

    refuse_output(options.output, RESULTS, force=options.force)
    names = _names(options.names)
    mechanism, _unused = read_model(options.file, session)
    table, refused, trouble = _evaluated(mechanism, names, options)
    troubles = [in_language(each, session.language) for each in refused]
    troubles += [] if trouble is None else [trouble.say(session.language)]
    data = {"ok": not troubles, **table.data(session.language)}
    data |= {"error": "\n".join(troubles)} if troubles else {}
    write_result(options.output, table, session, force=options.force)
    if session.json:
        session.show_data(data)
    else:
        session.show_tables(table)
        session.show_written(options.output, apart=True)
    for each in troubles:
        session.tell_error(each)
    return 2 if refused else int(trouble is not None)


def _names(texts: list[str] | None) -> list[str] | None:
    """Names that were asked for; raises UsageError for one that no number has, with the nearest."""
    if texts is None:
        return None
    from linkwright.analysis.base import METRICS

    names = [name.strip() for text in texts for name in text.split(",")]
    if not all(names):
        raise UsageError(
            _(
                '--names: "{text}" has an empty place between commas',
                code="metrics.no_names",
                text=" ".join(texts),
            )
        )
    for name in names:
        with about("--names", UsageError, LinkwrightError):
            METRICS[name]
    return names


def _evaluated(
    mechanism: Mechanism, names: list[str] | None, options: Options
) -> tuple[MetricsTable, list[str], LinkwrightError | None]:
    """The numbers, why some of the ``names`` do not apply, and why there are no forces where they failed.

    Raises RequestError where none applies.
    """
    from linkwright.analysis import Analysis, metrics
    from linkwright.analysis.evaluate import inapplicable, unloaded
    from linkwright.errors import RequestError
    from linkwright.kinematics.solve import solve_motion
    from linkwright.kinetostatics.run import solve_forces

    idle = {name: unloaded(mechanism, [name]) for name in names or () if options.forces is None}
    refused: dict[str, str] = {name: why for name, why in idle.items() if why is not None}
    if names and len(refused) == len({*names}):
        raise RequestError(unloaded(mechanism, names) or "")
    motion = solve_motion(mechanism, steps=options.steps, failures="mark" if options.mark else "raise")
    if names is None:
        return _all(motion, options)
    loaded = options.forces is not False and (options.forces or mechanism.has_loads)
    analysis = Analysis.of(solve_forces(motion) if loaded else motion)
    refused = inapplicable(analysis, names) | refused
    chosen = [name for name in names if name not in refused]
    if not chosen:
        raise RequestError(next(iter(refused.values())))
    return metrics(analysis, chosen), list(refused.values()), None


def _all(motion: Motion, options: Options) -> tuple[MetricsTable, list[str], LinkwrightError | None]:
    """All numbers that apply, those of the motion alone where the forces fail, and why they do."""
    from linkwright.analysis import metrics
    from linkwright.kinetostatics.run import solve_forces

    if options.forces is False or not (options.forces or motion.mechanism.has_loads):
        return metrics(motion), [], None
    try:
        forces = solve_forces(motion)
    except LinkwrightError as error:
        return metrics(motion), [], error
    return metrics(forces), [], None
