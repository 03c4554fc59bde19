"""The command line: ``linkwright COMMAND``."""

from __future__ import annotations

from collections.abc import Sequence


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command. Exit code: 0 fine, 1 model or position at fault, 2 wrong usage, 130 interrupted.

    Without ``argv`` it is the whole process: an interrupt ends it at any time without a word of Python's.
    """
    if argv is not None:
        from linkwright.cli.program import run

        return run(argv)
    from linkwright.cli import process

    return process.main()
