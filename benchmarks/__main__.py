"""``python -m benchmarks``: measures all candidates in turns and writes the tables of the documentation."""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence
from dataclasses import replace

from benchmarks import machine
from benchmarks.report import PAGE, Section, summary, write_page
from benchmarks.sections import QUICK, SECTIONS, Size, missing_compiler


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="small sizes; the page is not written")
    parser.add_argument("--only", nargs="+", choices=list(SECTIONS), metavar="NAME", help=", ".join(SECTIONS))
    parser.add_argument("--rounds", type=int, help="times that every candidate has its turn")
    parser.add_argument("--no-page", action="store_true", help=f"leave {PAGE.name} as it is")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the sections asked for; the page is written when all of them ran."""
    options = _options(arguments)
    size: Size = QUICK if options.quick else Size()
    if options.rounds:
        size = replace(size, rounds=options.rounds, starts=options.rounds)
    warnings.simplefilter("ignore")
    sections: list[Section] = []
    heads = [f"- {line}" for line in [*machine.description(), *missing_compiler()]]
    heads.append(f"- {size.rounds} rounds; {machine.load():.1f} processes at work in the minute before, on average")
    print("\n".join(heads), flush=True)
    for name in options.only or SECTIONS:
        sections.append(SECTIONS[name](size))
        print(f"\n{sections[-1].text()}", flush=True)
    goals = f"### What must be reached\n\n{summary(sections)}\n"
    print(goals)
    if not (options.quick or options.only or options.no_page):
        write_page("\n".join(["\n".join(heads) + "\n", goals, *(section.text() for section in sections)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
