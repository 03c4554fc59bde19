"""``linkwright optimize``: the dimensions that make a number least, within what must be kept."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.options import Options, argument, cluster, fields, fonts, force, option
from linkwright.cli.session import Session
from linkwright.designs.optimise.problem import SECTION
from linkwright.words import Say, _

if TYPE_CHECKING:
    from linkwright.designs.optimise.optimum import OptimizeError, Optimum

SUMMARY = _("make a number of the machine least, within what must be kept")
DESCRIPTION = _(
    """\
Varies dimensions within bounds so that one number or several become least (or
greatest) while others are kept: a global search that judges all designs of a
generation in one sweep, then exact gradients. The settings stand in the file's
section "optimize", or here. Prints the design beside the start and writes the
model file with everything else as it was. Several objectives give a front."""
)
EXAMPLES = """\
linkwright optimize crusher.yaml --output better.yaml
linkwright optimize gallery:jaw_crusher_sixbar --vary pitman.length=1.1..1.4m toggle.length=1..1.3m \\
    --minimize peak_input_torque --keep "jaw.angle range=same within 1 %"
linkwright optimize crusher.yaml --minimize peak_input_torque flywheel --plot front.svg --state front.state"""

ENDINGS = (".yaml", ".yml", ".json")
SETTINGS = {
    "vary": "ADDRESS=RANGE", "minimize": "NUMBER", "maximize": "NUMBER", "keep": "NUMBER=DEMAND",
    "define": "NAME=NUMBER", "tolerance": "ADDRESS=VALUE", "robust": "worst|yield", "least_yield": "SHARE",
    "evaluations": "N", "seed": "N",
}  # fmt: skip


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@argument("file", "FILE", help=_("a model file, or gallery:NAME"), model=True)
@fields(SECTION.fields, SETTINGS)
@option("--state", "FILE", help=_("keep the search's state in this file, and go on from it where it exists"))
@option("--output", "FILE", help=_("write the model file with the best values (a front: NAME_2 … as well)"))
@option("--plot", "FILE", help=_("draw the front, or the search's progress, in a .svg, .pdf or .png file"))
@cluster
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Optimises and prints or writes what came out."""
    try:
        return _searched(options, session)
    except KeyboardInterrupt as stopped:
        session.tell(_stopped(stopped, session.say))
        raise


def _searched(options: Options, session: Session) -> int:
    from linkwright.cli.files import PICTURES, refuse_output
    from linkwright.cli.progress import progress
    from linkwright.designs.cluster import on_cluster
    from linkwright.designs.optimise.optimize import optimize
    from linkwright.designs.optimise.optimum import OptimizeError

    refuse_output(options.output, ENDINGS, force=options.force)
    refuse_output(options.plot, PICTURES, force=options.force)
    settings = {"yield" if key == "least_yield" else key: getattr(options, key) for key in SETTINGS}
    try:
        with on_cluster(options.cluster), progress(session, _("searching")) as report:
            found = optimize(options.file, state=options.state, progress=report, **settings)
    except OptimizeError as error:
        return _unmet(error, session)
    _show(found, options, session)
    return 0


def _stopped(stopped: KeyboardInterrupt, say: Say) -> str:
    """What an interruption before the first population leaves."""
    from linkwright.designs.finished_parts import RESUME, Interrupted

    if isinstance(stopped, Interrupted):
        return say(RESUME.format(path=stopped.state))
    return say(_("Nothing new had been computed; run the same command again."))


def _unmet(error: OptimizeError, session: Session) -> int:
    """Says which demand fails, and shows the nearest design."""

    sentence = error.say(session.language)
    session.tell_error(sentence)
    if session.json:
        session.show_data({"ok": False, "error": sentence, "nearest": error.nearest.data()})
    else:
        session.show(error.nearest.text(session.language))
    return 1


def _show(found: Optimum, options: Options, session: Session) -> None:
    from linkwright.cli.files import atomic_write, write_diagram

    written: list[str] = []
    if options.output is not None:
        path = Path(options.output)
        targets = [path]
        if len(found) > 1:
            targets += [path.with_name(f"{path.stem}_{k}{path.suffix}") for k in range(2, len(found) + 1)]
        for index, target in enumerate(targets):
            atomic_write(target, found.model_text(index), force=options.force)
        written.append(str(path) if len(targets) == 1 else f"{path} … {targets[-1]}")
    write_diagram(options.plot, found, session, force=options.force)
    session.show_result(found, *written, options.plot, apart=False)
