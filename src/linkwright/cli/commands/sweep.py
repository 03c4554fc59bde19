"""``linkwright sweep``: numbers of very many designs, part by part, on this machine or a cluster."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from linkwright.cli.commands.study import ranges_of
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.export.sweep_parts import SweepParts


def arguments(option: Options) -> None:
    option.model()
    option("--vary", "RANGE", nargs="+", required=True, words="study.vary_help")
    option("--numbers", "NUMBER", nargs="+", required=True)
    option("--folder", "FOLDER", required=True)
    option("--sampling", choices=("grid", "sobol"), default="grid", words="study.sampling_help")
    option.count("--samples", 65536, words="study.samples_help")
    option("--seed", "N", type=int, default=0, words="study.seed_help")
    option.count("--steps", 360, words="study.steps_help")
    option.count("--part", 16384)
    option("--cluster", "ADDRESS")
    option("--best", "NUMBER")


def run(options: argparse.Namespace, session: Session) -> int:
    """Computes the missing parts and says what lies in the folder."""
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.export.sweep_parts import sweep_parts

    vary = ranges_of(options.vary)
    mechanism, _unused = read_model(options.file, session)
    with progress(session.say, "sweep.computing") as report:
        found = sweep_parts(
            mechanism, vary, options.folder, outputs=options.numbers, sampling=options.sampling,
            samples=options.samples, seed=options.seed, steps=options.steps, part=options.part,
            client=options.cluster, progress=report,
        )  # fmt: skip
    _show(found, options, session)
    return 0


def _show(found: SweepParts, options: argparse.Namespace, session: Session) -> None:
    from linkwright.core.table import Amount, Cell, Table
    from linkwright.words.sentence import in_language

    ranges = found.ranges()
    best = found.best(options.best) if options.best is not None else {}
    if session.json:
        data = found.data(session.language) | {"best": {name: each.tolist() for name, each in best.items()}}
        session.show_data({"ok": True, **data})
        return
    say = session.say
    session.show(
        say(
            _(
                "{designs} designs in {parts} parts in {folder} ({skipped} were there already); values in SI",
                designs=found.designs,
                parts=found.parts,
                skipped=found.skipped,
                folder=found.folder,
            )
        )
    )
    head = [say(f"sweep.column.{name}") for name in ("number", "least", "greatest", "designs")]
    rows: list[list[Cell]] = [
        [name, Amount(low), Amount(high), count] for name, (low, high, count) in ranges.items()
    ]
    session.show("\n" + "\n".join(Table(head, rows).lines()))
    for note in found.notes:
        session.show("\n" + say(_("Note: {text}", text=in_language(note, session.language))))
    if best:
        found_rows = [[Amount(float(value)) for value in row] for row in zip(*best.values(), strict=True)]
        session.show("\n" + say(_("Best {number}:", number=options.best)) + "\n")
        session.show("\n".join(Table(list(best), found_rows, ">" * len(best)).lines()))
