"""The state of behaviour: every public number and finding as data, and what differs between two states.

    python -m tests.state dump before.state
    python -m tests.state dump after.state --only forces metrics
    python -m tests.state compare before.state after.state
    python -m tests.state count --rooms

``dump`` writes the rows of all parts, or of some, into one file: machines of the gallery, random mechanisms,
calculations, syntheses, references, findings of damaged files. ``compare`` prints what differs by more than the
tolerance (see `tests/state/comparing.py`), and a line for every part. What was renamed on purpose between the two is
no difference with ``--renamed``: a regular expression that the names of the first have, and what stands in its place.
``count`` prints how many files and functions of the package some calls run through (see `tests/state/counting.py`).

Exit code: 0 equal (or written), 1 different, 2 wrong use, 130 interrupted.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from tests.state import comparing


def main(given: Sequence[str] | None = None) -> int:
    """Reads the options."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.state", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    dump = commands.add_parser("dump", help="write the state of the product into a file")
    dump.add_argument("file", type=Path, metavar="FILE")
    dump.add_argument("--workers", type=int, default=2, help="processes (default 2)")
    dump.add_argument("--only", nargs="+", default=[], metavar="PART", help="parts (default all)")
    dump.set_defaults(run=_dump)
    compare = commands.add_parser("compare", help="print what differs between two files")
    compare.add_argument("first", type=Path, metavar="A")
    compare.add_argument("second", type=Path, metavar="B")
    compare.add_argument("--only", nargs="+", default=[], metavar="PART", help="parts (default all)")
    compare.add_argument("--tolerance", type=float, default=comparing.TOLERANCE, help="(default 1e-10)")
    compare.add_argument("--most", type=int, default=50, help="differences shown of a part (default 50)")
    compare.add_argument(
        "--renamed",
        nargs=2,
        action="append",
        default=[],
        metavar=("PATTERN", "NEW"),
        help="names of A that B has not",
    )
    compare.set_defaults(run=_compare)
    count = commands.add_parser("count", help="print how many files and functions some calls run through")
    count.add_argument("--rooms", action="store_true", help="with the functions of every room")
    count.set_defaults(run=_count)
    options = parser.parse_args(given)
    found: int = options.run(parser, options)
    return found


def _dump(parser: argparse.ArgumentParser, options: argparse.Namespace) -> int:
    from tests.state import dumping

    unknown = [part for part in options.only if part not in dumping.PARTS]
    if unknown:
        parser.error(f"no part {', '.join(unknown)}; there are {', '.join(dumping.PARTS)}")
    if options.workers < 1:
        parser.error("--workers is a number above zero")
    if not options.file.resolve().parent.is_dir():
        parser.error(f"{options.file}: no such folder")
    began = time.monotonic()
    try:
        number = dumping.dump(options.file, options.only, options.workers)
    except KeyboardInterrupt:
        print("\ninterrupted; nothing is written", file=sys.stderr)
        return 130
    size = options.file.stat().st_size / 1e6
    print(f"{options.file}: {number} rows, {size:.1f} MB, {time.monotonic() - began:.0f} s")
    return 0


def _compare(parser: argparse.ArgumentParser, options: argparse.Namespace) -> int:
    try:
        first, second = comparing.read(options.first), comparing.read(options.second)
    except comparing.NotAState as error:
        parser.error(str(error))
    first = comparing.renamed(first, options.renamed)
    if options.only:
        first, second = (
            {key: row for key, row in each.items() if key[0] in options.only} for each in (first, second)
        )
    found = comparing.compared(first, second, options.tolerance)
    for line in comparing.report(found, options.most):
        print(line)
    return int(any(each.differences for each in found.values()))


def _count(parser: argparse.ArgumentParser, options: argparse.Namespace) -> int:
    from tests.state import counting

    for line in counting.report(options.rooms):
        print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
