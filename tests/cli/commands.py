"""Commands run in process: their exit code, what they print, their data, and the error that they tell."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from typing import Any

import pytest
from tests.refusals import agrees, values_of

from linkwright.cli import main
from linkwright.errors import LinkwrightError, ModelError

Translate = Callable[..., str]


@dataclass(frozen=True)
class Ended:
    """A command that has ended; ``told``: the error that it told last."""

    code: int
    out: str
    err: str
    told: LinkwrightError | None


def run(*arguments: str) -> Ended:
    """Runs a command."""
    out, err = StringIO(), StringIO()
    with redirect_stdout(out), redirect_stderr(err), errors_said() as said:
        code = main(list(arguments))
    return Ended(code, out.getvalue(), err.getvalue(), said[-1] if said else None)


class Terminal(StringIO):
    """An output that passes for a terminal."""

    def isatty(self) -> bool:
        return True


def on_terminal(*arguments: str, columns: int = 100, **environment: str) -> str:
    """What a command prints on a terminal of a width, with its colours."""
    out = Terminal()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(StringIO()):
        for name in ("NO_COLOR", "LINKWRIGHT_LANG"):
            patch.delenv(name, raising=False)
        for name, value in {"TERM": "xterm", "COLUMNS": str(columns), **environment}.items():
            patch.setenv(name, value)
        assert main(list(arguments)) in (0, 1)
    return out.getvalue()


def shown(*arguments: str, code: int = 0) -> str:
    """What a command prints as its result."""
    ended = run(*arguments)
    assert ended.code == code, ended.err
    return ended.out


def data(*arguments: str, code: int = 0) -> Any:
    """What a command gives with ``--json``."""
    return json.loads(shown(*arguments, "--json", code=code))


def finding_codes(*arguments: str, code: int = 1) -> list[tuple[str, str]]:
    """Key and code of every finding that a command gives with ``--json``, of all its files."""
    found = data(*arguments, code=code)
    listed = [each for file in found.get("files", [found]) for each in file["findings"]]
    return [(each["key"], each["code"]) for each in listed]


def is_refused(arguments: list[str], key: str, /, ends: int = 2, **values: object) -> LinkwrightError:
    """The error that a command tells in place of a result: its exit code, its code, and at least these values."""
    ended = run(*arguments)
    assert (ended.code, ended.out) == (ends, ""), ended.err or ended.out
    assert ended.told is not None and "Traceback" not in ended.err
    assert ended.told.code == key, f'{ended.told.code}: "{ended.told}"'
    agrees(values_of(ended.told), values)
    return ended.told


@contextmanager
def errors_said() -> Iterator[list[LinkwrightError]]:
    """The errors that are put into words inside, but for those that are part of another one."""
    said: list[LinkwrightError] = []
    depth = 0

    def noted(translate: Translate) -> Translate:
        def noting(error: LinkwrightError, language: str = "en") -> str:
            nonlocal depth
            depth += 1
            try:
                return translate(error, language)
            finally:
                depth -= 1
                if depth == 0:
                    said.append(error)

        return noting

    with pytest.MonkeyPatch.context() as patch:
        for kind in (LinkwrightError, ModelError):
            patch.setattr(kind, "translate", noted(kind.translate))
        yield said
