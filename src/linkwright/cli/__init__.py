"""The command line: ``linkwright COMMAND``, also as a process of its own that may be interrupted at any moment."""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Sequence

#: Exit code of a process that was interrupted.
INTERRUPTED = 130

#: Seconds after which an interrupt that could not be raised comes again.
AGAIN = 0.01

#: Objects that are made before Python looks for cycles of references among them: with its own 700 it goes again and
#: again through what imports made, which stays.
COLLECT_AFTER = 200_000


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command. Exit code: 0 fine, 1 model or position at fault, 2 wrong usage, 130 interrupted.

    Without ``argv`` it owns the process: an interrupt ends it at any time without a traceback.
    """
    if argv is None:
        return _process()
    from linkwright.cli.program import run

    return run(argv)


def _process() -> int:
    """Runs the command of the process's arguments and returns its exit code."""
    signal.signal(signal.SIGINT, _leave)  # nothing to tidy up before the command runs
    gc.set_threshold(COLLECT_AFTER)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # our matrices are small, and threads that wait spin
    _open_streams()
    from linkwright.cli.program import run

    try:
        sys.unraisablehook = _interrupt_again
        signal.signal(signal.SIGINT, signal.default_int_handler)
        code = run(sys.argv[1:])
    except KeyboardInterrupt:
        code = INTERRUPTED
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # all is printed
        gc.freeze()  # no last search of all memory for cycles, which takes plot a fifth of its time
    if code == INTERRUPTED:
        _end()
    return code


def _end() -> None:
    """Ends an interrupted process: waiting for its threads could last for ever, where the interrupt came while one of
    their locks was being taken."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            continue  # nobody reads any more
    os._exit(INTERRUPTED)


def _leave(number: int, frame: object) -> None:
    os._exit(INTERRUPTED)


def _interrupt_again(problem: sys.UnraisableHookArgs) -> None:
    """An interrupt that hit a place from which nothing can be raised comes once more, where it can."""
    if issubclass(problem.exc_type, KeyboardInterrupt) and hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, signal.default_int_handler)
        signal.setitimer(signal.ITIMER_REAL, AGAIN)  # raised here, it would be lost in this very hook
    else:
        sys.__unraisablehook__(problem)


def _open_streams() -> None:
    """In place of streams closed before the start: one that cannot be written, and one that nobody reads."""
    if sys.stdout is None:
        sys.stdout = open(os.devnull, encoding="utf-8")  # noqa: SIM115
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
