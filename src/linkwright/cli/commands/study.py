"""``linkwright study``: what becomes of a model's numbers when its dimensions vary."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import whole_number
from linkwright.cli.session import Session
from linkwright.words import Say

if TYPE_CHECKING:
    from linkwright.study.study import Study

ENDINGS = (".csv", ".json")


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    parser.add_argument("file", metavar="FILE", help=say("cli.file_help"))
    parser.add_argument("--vary", nargs="+", required=True, metavar="RANGE", help=say("study.vary_help"))
    parser.add_argument("--metrics", nargs="+", metavar="METRIC", help=say("study.metrics_help"))
    parser.add_argument(
        "--sampling", choices=("grid", "sobol"), default="grid", help=say("study.sampling_help")
    )
    parser.add_argument(
        "--samples", type=whole_number, default=64, metavar="N", help=say("study.samples_help")
    )
    parser.add_argument("--seed", type=int, default=0, metavar="N", help=say("study.seed_help"))
    parser.add_argument("--of", metavar="NAME", help=say("study.of_help"))
    parser.add_argument(
        "--fluctuation", type=float, default=0.02, metavar="δ", help=say("study.fluctuation_help")
    )
    parser.add_argument("--steps", type=whole_number, default=360, metavar="N", help=say("study.steps_help"))
    parser.add_argument("--rows", type=whole_number, default=40, metavar="N", help=say("study.rows_help"))
    parser.add_argument("--cluster", metavar="ADDRESS", help=say("sweep.cluster_help"))
    parser.add_argument("--output", metavar="FILE", help=say("study.output_help"))
    parser.add_argument("--plot", metavar="FILE", help=say("study.plot_help"))
    parser.add_argument("--force", action="store_true", help=say("cli.force_help"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Studies the designs and prints or writes what came out."""
    from linkwright.cli.source import read_model
    from linkwright.cli.tables import PICTURES, refuse_output
    from linkwright.study.cluster import on_cluster
    from linkwright.study.study import study

    refuse_output(options.output, ENDINGS, session.say, force=options.force)
    refuse_output(options.plot, PICTURES, session.say, force=options.force)
    vary = ranges_of(options.vary, session.say)
    mechanism, _ = read_model(options.file, session)
    with on_cluster(options.cluster):
        found = study(
            mechanism, vary, metrics=options.metrics, sampling=options.sampling, samples=options.samples,
            seed=options.seed, output=options.of, fluctuation=options.fluctuation, steps=options.steps,
        )  # fmt: skip
    _show(found, options, session)
    return 0


def ranges_of(texts: list[str], say: Say) -> dict[str, str]:
    """Ranges by address from texts ``ADDRESS=RANGE``."""
    found: dict[str, str] = {}
    for text in texts:
        address, sign, given = text.partition("=")
        if not sign or not address.strip() or not given.strip():
            raise UsageError(say("study.bad_vary", text=text))
        if address.strip() in found:
            raise UsageError(say("study.twice", name=address.strip()))
        found[address.strip()] = given.strip()
    return found


def _show(found: Study, options: argparse.Namespace, session: Session) -> None:
    from linkwright.cli.tables import write_diagram, write_table

    write_table(options.output, found.csv, found.data, force=options.force)
    write_diagram(options.plot, found, session, force=options.force)
    if session.json:
        session.show_data(found.data())
        return
    session.show("\n".join(session.table(found.text(session.language, max(2, options.rows)).splitlines())))
    for written in (options.output, options.plot):
        if written is not None:
            session.show()
            session.show(session.say("cli.written", path=written))
