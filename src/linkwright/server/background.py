"""Long work of the studio: in a thread of its own, one at a time, with what it has found so far at any time."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from typing import Any

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.words import _
from linkwright.words.message import in_language


class Stopped(Exception):
    """Other work has begun, or this one was ended."""


class Job:
    """One piece of work: it says what it has found, and asks whether it is still wanted."""

    def __init__(self, background: Background, number: int, language: str) -> None:
        self._background, self._number, self.language = background, number, language

    def alive(self, *done: float) -> None:
        """Raises Stopped where it is not wanted any more; ``done``: pieces done and the most there will be."""
        self._background.add(self._number, {"done": list(done)} if done else {})

    def tell(self, candidates: list[Plain], **more: Any) -> None:
        """What is found so far, best first."""
        self._background.add(self._number, {"candidates": candidates, **more})


class Background:
    """At most one job at a time; a new one ends the one before."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._number = 0
        self._found = _beginning(0, "")

    def begin(self, kind: str, work: Callable[[Job], None], language: str) -> Plain:
        """Starts work; gives its number."""
        with self._lock:
            self._number += 1
            number = self._number
            self._found = _beginning(number, kind)
        threading.Thread(target=self._run, args=(number, work, language), daemon=True).start()
        return {"number": number}

    def end(self) -> Plain:
        """Ends the work; what was found stays."""
        with self._lock:
            self._number += 1
            self._found = {**self._found, "running": False}
        return {}

    def state(self) -> Plain:
        """What is found so far."""
        with self._lock:
            return self._found

    def add(self, number: int, found: Plain) -> None:
        """Takes what a job has found; raises Stopped for one that is not the present one."""
        with self._lock:
            if number != self._number:
                raise Stopped
            self._found = {**self._found, **found}

    def _run(self, number: int, work: Callable[[Job], None], language: str) -> None:
        try:
            try:
                work(Job(self, number, language))
            except LinkwrightError as error:
                self.add(number, {"sentence": error.translate(language)})
            except Stopped:
                raise
            except Exception as error:
                self.add(number, {"sentence": unexpected(error, language)})
            finally:
                self.add(number, {"running": False})
        except Stopped:
            return


def _beginning(number: int, kind: str) -> Plain:
    return {"number": number, "kind": kind, "running": number > 0, "candidates": [], "sentence": "", "done": []}


def unexpected(error: Exception, language: str) -> str:
    """The sentence for a fault of the program; where it arose is written to the terminal."""
    traceback.print_exception(error)
    return in_language(
        _(
            "this should not have happened ({kind}: {message}); please report it with the text "
            "of the model; the terminal of the studio shows where it arose",
            kind=type(error).__name__,
            message=str(error),
        ),
        language,
    )
