"""Finished parts in one file that several processes share."""

import time
from pathlib import Path

from linkwright.designs.checkpoints import Checkpoints


def test_processes_that_share_checkpoints_do_not_wait_for_each_other(tmp_path: Path) -> None:
    """One has found a part and goes on for long; the other one stores its own meanwhile, and both are there."""
    first, second = (Checkpoints(tmp_path / "parts.state", "machine", "work") for _ in range(2))
    first.add("a", 1.0)
    first.written = -1e9
    first.add("b", 2.0)
    first.add("c", 3.0)
    begun = time.monotonic()
    second.add("d", 4.0)
    second.close()
    assert time.monotonic() - begun < 2
    assert first.part("c") == (3.0,)
    first.close()
    again = Checkpoints(tmp_path / "parts.state", "machine", "work")
    assert [again.part(key) for key in "abcd"] == [(1.0,), (2.0,), (3.0,), (4.0,)]
    again.close()
