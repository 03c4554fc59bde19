"""``linkwright study``: what becomes of a model's numbers when its dimensions vary."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.designs.study import Study

ENDINGS = (".csv", ".json")


def arguments(option: Options) -> None:
    option.model()
    option("--vary", "RANGE", nargs="+", required=True)
    option("--metrics", "METRIC", nargs="+")
    option("--sampling", choices=("grid", "sobol"), default="grid")
    option.count("--samples", 64)
    option("--seed", "N", type=int, default=0)
    option("--of", "NAME")
    option("--fluctuation", "δ", type=float)
    option.count("--steps", 360)
    option.count("--rows", 40)
    option("--cluster", "ADDRESS", words="sweep.cluster_help")
    option("--state", "FILE")
    option("--output", "FILE")
    option("--plot", "FILE")
    option.fonts()
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Studies the designs and prints or writes what came out."""
    from linkwright.cli.files import PICTURES, refuse_output
    from linkwright.cli.progress import kept
    from linkwright.cli.source import read_model
    from linkwright.designs.cluster import on_cluster
    from linkwright.designs.study import study
    from linkwright.files.write import dump
    from linkwright.machine.flywheel import FLUCTUATION

    refuse_output(options.output, ENDINGS, force=options.force)
    refuse_output(options.plot, PICTURES, force=options.force)
    vary = ranges_of(options.vary)
    mechanism, _unused = read_model(options.file, session)
    settings = {
        "metrics": options.metrics, "sampling": options.sampling, "samples": options.samples, "seed": options.seed,
        "output": options.of, "steps": options.steps,
        "fluctuation": FLUCTUATION if options.fluctuation is None else options.fluctuation,
    }  # fmt: skip
    asked = dump(mechanism), vary, settings
    with kept(options.state, mechanism.name, asked, session) as report, on_cluster(options.cluster):
        _show(study(mechanism, vary, progress=report, **settings), options, session)
    return 0


def ranges_of(texts: list[str]) -> dict[str, str]:
    """Ranges by address from texts ``ADDRESS=RANGE``."""
    found: dict[str, str] = {}
    for text in texts:
        address, sign, given = text.partition("=")
        if not sign or not address.strip() or not given.strip():
            raise UsageError(
                _(
                    '--vary: "{text}" says no range; write ADDRESS=FROM..TO UNIT:NUMBER, such as '
                    '"crank.length=20..30 mm:11"',
                    code="study.bad_vary",
                    text=text,
                )
            )
        if address.strip() in found:
            raise UsageError(
                _(
                    "--vary: {name} is given twice; give one range for it",
                    code="study.twice",
                    name=address.strip(),
                )
            )
        found[address.strip()] = given.strip()
    return found


def _show(found: Study, options: argparse.Namespace, session: Session) -> None:
    from linkwright.cli.files import write_diagram, write_table

    write_table(options.output, found.csv, found.data, force=options.force)
    write_diagram(options.plot, found, session, force=options.force)
    text = found.text(session.language, max(2, options.rows), session.room)
    session.show_result(found, options.output, options.plot, text=text)
