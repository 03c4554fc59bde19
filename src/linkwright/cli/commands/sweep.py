"""``linkwright sweep``: numbers of very many designs, part by part, on this machine or a cluster."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from linkwright.cli.commands.study import ranges_of
from linkwright.cli.parser import whole_number
from linkwright.cli.session import Session
from linkwright.words import Say

if TYPE_CHECKING:
    from linkwright.export.sweep_parts import SweepParts


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    parser.add_argument("file", metavar="FILE", help=say("cli.file_help"))
    parser.add_argument("--vary", nargs="+", required=True, metavar="RANGE", help=say("study.vary_help"))
    parser.add_argument(
        "--numbers", nargs="+", required=True, metavar="NUMBER", help=say("sweep.numbers_help")
    )
    parser.add_argument("--folder", required=True, metavar="FOLDER", help=say("sweep.folder_help"))
    parser.add_argument(
        "--sampling", choices=("grid", "sobol"), default="grid", help=say("study.sampling_help")
    )
    parser.add_argument(
        "--samples", type=whole_number, default=65536, metavar="N", help=say("study.samples_help")
    )
    parser.add_argument("--seed", type=int, default=0, metavar="N", help=say("study.seed_help"))
    parser.add_argument("--steps", type=whole_number, default=360, metavar="N", help=say("study.steps_help"))
    parser.add_argument("--part", type=whole_number, default=16384, metavar="N", help=say("sweep.part_help"))
    parser.add_argument("--cluster", metavar="ADDRESS", help=say("sweep.cluster_help"))
    parser.add_argument("--best", metavar="NUMBER", help=say("sweep.best_help"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Computes the missing parts and says what lies in the folder."""
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.export.sweep_parts import sweep_parts

    vary = ranges_of(options.vary, session.say)
    mechanism, _ = read_model(options.file, session)
    with progress(session.say("sweep.computing")) as report:
        found = sweep_parts(
            mechanism, vary, options.folder, outputs=options.numbers, sampling=options.sampling,
            samples=options.samples, seed=options.seed, steps=options.steps, part=options.part,
            client=options.cluster, progress=report,
        )  # fmt: skip
    _show(found, options, session)
    return 0


def _show(found: SweepParts, options: argparse.Namespace, session: Session) -> None:
    from linkwright.words.width import aligned

    ranges = found.ranges()
    best = found.best(options.best) if options.best is not None else {}
    if session.json:
        columns = {
            name: {"least": low, "greatest": high, "designs": count}
            for name, (low, high, count) in ranges.items()
        }
        data = {"folder": str(found.folder), "designs": found.designs, "parts": found.parts, "skipped": found.skipped,
                "columns": columns, "best": {name: column.tolist() for name, column in best.items()}}  # fmt: skip
        session.show_data(data)
        return
    say = session.say
    session.show(
        say(
            "sweep.done", designs=found.designs, parts=found.parts, skipped=found.skipped, folder=found.folder
        )
    )
    rows = [[say(f"sweep.column.{name}") for name in ("number", "least", "greatest", "designs")]]
    rows += [[name, f"{low:.6g}", f"{high:.6g}", str(count)] for name, (low, high, count) in ranges.items()]
    session.show("\n" + "\n".join(aligned(rows, "<>>>")))
    if best:
        rows = [list(best)] + [[f"{value:.6g}" for value in row] for row in zip(*best.values(), strict=True)]
        session.show("\n" + say("sweep.best", number=options.best) + "\n")
        session.show("\n".join(aligned(rows, ">" * len(rows[0]))))
