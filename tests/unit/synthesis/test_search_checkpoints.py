"""Syntheses that are stopped go on from a file: to the bit where work is counted, with the time left where a clock
ends it; what a cluster finds for a free curve is what this machine finds."""

from __future__ import annotations

import json
import math
import sqlite3
from collections.abc import Callable
from itertools import count
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.designs import checkpoints
from linkwright.formula import machine_code
from linkwright.synthesis.free_curve import search as free_curve
from linkwright.synthesis.free_curve.search import Search, polished
from linkwright.synthesis.free_curve.target import Target
from linkwright.synthesis.free_curve.topology import FOUR_BAR, Design, flat

pytestmark = [
    pytest.mark.skipif(not machine_code.available(), reason="llvmlite does not run here"),
    pytest.mark.rotating,
]
FOUR = np.array([0.9, 0.9 + 1.7j, 0.6j, 1.3 + 0.6j])  # a figure 4 in one stroke
RING = [(20, 10), (17.66, 15.142), (11.736, 17.878), (5, 16.928), (0.6, 12.736), (1, 6), (6, 2), (14, 3), (18, 6)]
FREE = [math.nan] * 7
#: Tasks of counted work, and the piece of work of which many are done.
COUNTED = {
    "path": ("path_generation.search.CompiledPaths._computed", {"points": RING[:7]}),
    "exact_path": ("path_generation.tracking.spread_over", {"points": RING}),
    "motion": (
        "motion_generation.mixed_poses.carried",
        {"poses": [(x, y, a) for (x, y), a in zip(RING[:7], [0, 0.3, 0.5, *FREE], strict=False)]},
    ),
}


def counted(monkeypatch: pytest.MonkeyPatch, name: str, stop: list[int]) -> list[int]:
    """Calls of a function; the one of the number in ``stop`` is interrupted."""
    home, _, last = f"linkwright.synthesis.{name}".rpartition(".")
    original, calls = _found(home, last), list[int]()

    def call(*given: Any, **named: Any) -> object:
        calls.append(1)
        if len(calls) in stop:
            raise KeyboardInterrupt
        return original(*given, **named)

    monkeypatch.setattr(f"{home}.{last}", call)
    return calls


def _found(home: str, name: str) -> Callable[..., object]:
    from pkgutil import resolve_name

    return getattr(resolve_name(home), name)  # type: ignore[no-any-return]


@pytest.mark.parametrize("task", COUNTED)
def test_a_counted_search_goes_on_with_the_same_bits(
    task: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checkpoints, "MAX_BYTES_PER_SECOND", float("inf"))  # kept however fast it was found
    name, demands = COUNTED[task]
    whole, stop = _data(task, demands), list[int]()
    calls = counted(monkeypatch, name, stop)
    assert _data(task, demands) == whole
    every = len(calls)
    calls.clear()
    stop.append(max(1, every // 2))
    with pytest.raises(lw.Interrupted), lw.checkpointing(tmp_path / "a.state", task, demands):
        lw.synthesize(task, **demands)
    before = len(calls)
    stop.clear()
    with lw.checkpointing(tmp_path / "a.state", task, demands):
        assert _data(task, demands) == whole
    assert len(calls) == every + 1 and before == max(1, every // 2)


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock for free curves that every look at it moves by 40 ms, however busy the machine is."""
    looks = count()
    monkeypatch.setattr(free_curve, "time", SimpleNamespace(perf_counter=lambda: 0.04 * next(looks)))


def _data(task: str, demands: dict[str, Any]) -> str:
    try:
        return json.dumps(lw.synthesize(task, **demands).data())
    except lw.SynthesisError as error:
        return json.dumps(error.nearest and error.nearest.data())


def test_a_search_that_a_clock_ends_goes_on_with_the_time_that_is_left(tmp_path: Path, clock: None) -> None:
    shares = list[float]()

    def stop(done: int, total: int) -> None:
        shares.append(done / total)
        if shares[-1] > 0.5:
            raise KeyboardInterrupt

    def searched(progress: Callable[[int, int], None]) -> lw.Synthesis:
        with lw.checkpointing(tmp_path / "four.state"):
            return lw.free_curve(FOUR, joints=5, seconds=3.0, progress=progress)

    part = searched(stop)
    assert [note.code for note in part.notes if note.code == "study.interrupted"]
    onward = list[float]()
    whole = searched(lambda done, total: onward.append(done / total))
    assert shares[0] < 0.5 < shares[-1] < onward[0]
    assert "study.interrupted" not in [note.code for note in whole.notes]
    assert whole.counts["attempts"] > part.counts["attempts"] > 0
    assert whole.best.error < 1.02 * part.best.error  # what was found is there; demands are met more exactly
    assert json.dumps(searched(lambda *_: None).data()) == json.dumps(whole.data())  # the time is over


def test_the_command_says_where_a_free_curve_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, clock: None
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["synthesize", "free_curve", "points=[[9, 0], [9, 17], [0, 6], [13, 6]]", "unit=mm", "joints=5"]
    original, looks = Search._over, list[float]()

    def over(self: Search) -> float:
        looks.append(original(self))
        if len(looks) == 12:
            raise KeyboardInterrupt
        return looks[-1]

    monkeypatch.setattr(Search, "_over", over)
    assert main([*words, "seconds=1"]) == 0
    assert [each.name for each in tmp_path.iterdir()] == ["free_curve.state"]
    assert "--state free_curve.state" in capsys.readouterr().out
    assert main([*words, "seconds=1", "--state", "free_curve.state", "--lang", "zh"]) == 0
    assert "--state" not in capsys.readouterr().out
    assert main([*words, "seconds=2", "--state", "free_curve.state"]) == 2
    assert "free_curve.state" in capsys.readouterr().err
    with sqlite3.connect("free_curve.state") as parts:
        parts.execute("update parts set content = '[1]' where key <> 'work'")
    parts.close()
    assert main([*words, "seconds=1", "--state", "free_curve.state"]) == 2
    assert "free_curve.state" in capsys.readouterr().err


def test_a_cluster_finds_what_this_machine_finds(clock: None, monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    target, draw = Target(FOUR, False, math.radians(20), 6.0), np.random.default_rng(5)
    numbers = draw.normal(0.6, 0.5, (6, 6))
    designs = [Design(flat([*FOUR_BAR, (4, 1, 3, 1)]), np.append(x, (0.4, 1.2, 3.0)), False) for x in numbers]
    here = [polished(target, each) for each in designs]
    options = {"n_workers": 1, "threads_per_worker": 2, "dashboard_address": ":0", "processes": False}
    with (
        distributed.LocalCluster(**options) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
        lw.on_cluster(client),
    ):
        original, sent = client.submit, set[str]()

        def noted(timed: object, away: object, work: Callable[..., object], *rest: object, pure: bool) -> object:
            sent.add(work.__name__)
            return original(timed, away, work, *rest, pure=pure)

        monkeypatch.setattr(client, "submit", noted)
        search = Search(target, 5, 3.0, 3)
        found = search.run()
        there = search._each(designs, polished)
    assert sorted(each.value for each in there) == sorted(each.value for each in here)
    assert sorted(each.x.tobytes() for each in there) == sorted(each.x.tobytes() for each in here)
    assert sent == {"started", "tried", "each_of"} and min(each.value for each in found) < 0.3
