"""``linkwright optimize``: the dimensions that make a number least, within what must be kept."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.words import Say, _

if TYPE_CHECKING:
    from linkwright.designs.optimise.optimum import OptimizeError, Optimum

ENDINGS = (".yaml", ".yml", ".json")


def arguments(option: Options) -> None:
    option("file", "FILE")
    option("--vary", "RANGE", nargs="+")
    option("--minimize", "NUMBER", nargs="+")
    option("--maximize", "NUMBER", nargs="+")
    option("--keep", "DEMAND", nargs="+")
    option("--define", "NAME", nargs="+")
    option("--tolerance", "DEVIATION", nargs="+")
    option("--robust", "worst|yield")
    option("--yield", "SHARE", dest="least_yield")
    option.count("--evaluations")
    option("--seed", "N", type=int)
    option("--state", "FILE")
    option("--output", "FILE")
    option("--plot", "FILE")
    option("--cluster", "ADDRESS", words="sweep.cluster_help")
    option.fonts()
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Optimises and prints or writes what came out."""
    try:
        return _searched(options, session)
    except KeyboardInterrupt as stopped:
        session.tell(_stopped(stopped, session.say))
        raise


def _searched(options: argparse.Namespace, session: Session) -> int:
    from linkwright.cli.files import PICTURES, refuse_output
    from linkwright.cli.progress import progress
    from linkwright.designs.cluster import on_cluster
    from linkwright.designs.optimise.optimize import optimize
    from linkwright.designs.optimise.optimum import OptimizeError

    refuse_output(options.output, ENDINGS, force=options.force)
    refuse_output(options.plot, PICTURES, force=options.force)
    if options.seed is not None and options.seed < 0:
        raise UsageError(
            _(
                "the seed is {seed}; give a whole number that is not negative",
                code="study.bad_seed",
                seed=options.seed,
            )
        )
    settings = {
        "vary": _pairs(options.vary),
        "keep": _pairs(options.keep),
        "define": _pairs(options.define),
        "tolerance": _pairs(options.tolerance),
        "robust": options.robust,
        "yield": options.least_yield,
        "minimize": options.minimize,
        "maximize": options.maximize,
        "evaluations": options.evaluations,
        "seed": options.seed,
    }
    try:
        with on_cluster(options.cluster), progress(session.say, "optimize.searching") as report:
            found = optimize(options.file, state=options.state, progress=report, **settings)
    except OptimizeError as error:
        return _unmet(error, session)
    _show(found, options, session)
    return 0


def _pairs(texts: list[str] | None) -> dict[str, str] | None:
    """``NAME=TEXT`` by name; None where nothing is given."""
    if texts is None:
        return None
    found: dict[str, str] = {}
    for text in texts:
        name, sign, value = text.partition("=")
        if not sign or not name.strip() or not value.strip():
            raise UsageError(
                _(
                    '"{text}" is no setting; write NAME=VALUE, such as crank.length=80..120mm',
                    code="optimize.bad_pair",
                    text=text,
                )
            )
        if name.strip() in found:
            raise UsageError(
                _(
                    "{name} is given twice; write one setting for it, such as {name}=90..100mm",
                    code="optimize.given_twice",
                    name=name.strip(),
                )
            )
        found[name.strip()] = value.strip()
    return found


def _stopped(stopped: KeyboardInterrupt, say: Say) -> str:
    """What an interruption before the first population leaves."""
    from linkwright.designs.finished_parts import Interrupted

    if isinstance(stopped, Interrupted):
        return say(_("Interrupted; run the same command with --state {path} to go on.", path=stopped.state))
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


def _show(found: Optimum, options: argparse.Namespace, session: Session) -> None:
    from linkwright.cli.files import write_diagram, write_whole

    written: list[str] = []
    if options.output is not None:
        path = Path(options.output)
        targets = [path]
        if len(found) > 1:
            targets += [path.with_name(f"{path.stem}_{k}{path.suffix}") for k in range(2, len(found) + 1)]
        for index, target in enumerate(targets):
            write_whole(target, found.model_text(index), force=options.force)
        written.append(str(path) if len(targets) == 1 else f"{path} … {targets[-1]}")
    write_diagram(options.plot, found, session, force=options.force)
    session.show_result(found, *written, options.plot, apart=False)
