"""What commands print, in process: their results, their help and their refusals."""

from __future__ import annotations

import io
import os
import shlex
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from unittest.mock import patch

from linkwright.cli import main

#: Neither the terminal nor the user's settings change what is printed.
PLAIN = {"COLUMNS": "100", "NO_COLOR": "1", "LINKWRIGHT_LANG": ""}


@contextmanager
def within(folder: Path) -> Iterator[None]:
    """Commands are run in a folder, with settings that are the same everywhere."""
    with chdir(folder), patch.dict(os.environ, PLAIN):
        yield


def printed(line: str, language: str, folder: Path) -> str:
    """What a command line prints, results before what goes to the standard error; without the folder's name."""
    out, err = io.StringIO(), io.StringIO()
    with within(folder), redirect_stdout(out), redirect_stderr(err):
        main(["--lang", language, *shlex.split(line)])
    return (out.getvalue() + "\n" + err.getvalue()).replace(str(folder), "FOLDER")


def commands() -> list[str]:
    """Names of all commands, as the program lists them."""
    listed = printed("--help", "en", Path.cwd()).partition("commands:\n")[2].partition("\n\n")[0]
    return [line.split()[0] for line in listed.splitlines()]
