"""Files that several writers write at once: whole, one after the other, none replaced unasked."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.at_once import at_once

from linkwright.errors import RequestError
from linkwright.filesystem import alone, atomic_write, write_new

ROUNDS, HANDS = 25, 4


def test_of_writers_that_may_not_replace_one_writes(tmp_path: Path) -> None:
    for k in range(ROUNDS):
        path = tmp_path / f"{k}.csv"
        found = at_once(*(lambda h=hand, p=path: atomic_write(p, b"%d" % h, force=False) for hand in range(HANDS)))
        (won,) = (place for place, each in enumerate(found) if isinstance(each, Path))
        assert path.read_bytes() == b"%d" % won
        assert all(isinstance(each, RequestError) for place, each in enumerate(found) if place != won)
    names = [tmp_path / f"new{k}.state" for k in range(HANDS)]
    found = at_once(*(lambda hand=hand: write_new(names, b"%d" % hand) for hand in range(HANDS)))
    assert sorted(found) == names
    assert [path.read_bytes() for path in found] == [b"%d" % hand for hand in range(HANDS)]
    assert not list(tmp_path.glob(".linkwright-*"))


COUNTS = """
import sys
from pathlib import Path
from linkwright.filesystem import alone
path, times = Path(sys.argv[1]), int(sys.argv[2])
for _ in range(times):
    with alone(path.with_suffix(".lock")):
        path.write_text(str(int(path.read_text()) + 1))
"""


def test_processes_are_kept_apart_while_they_read_and_write(tmp_path: Path) -> None:
    """A counter in a file, read and written by processes and threads: none of its steps is lost."""
    path = tmp_path / "count"
    path.write_text("0")
    command = [sys.executable, "-c", COUNTS, str(path), "100"]
    processes = [subprocess.Popen(command) for _ in range(2)]

    def count() -> None:
        for _ in range(100):
            with alone(path.with_suffix(".lock")):
                path.write_text(str(int(path.read_text()) + 1))

    at_once(count, count)
    assert [process.wait() for process in processes] == [0, 0]
    assert path.read_text() == "400"
