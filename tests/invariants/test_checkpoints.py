"""Studies and tolerance runs that are stopped at any moment go on from a file, with results equal to the bit."""

from __future__ import annotations

import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from tests.store import machine

import linkwright as lw
from linkwright.cli import main

CRANK = "gallery:crank_rocker"
VARY = ["--vary", "coupler.length=3.2..3.8m:7"]  # so few that they are found one by one
STUDY = ["study", CRANK, *VARY, "--metrics", "travel", "transmission_angle", "--json"]
SPREAD = ["tolerance", "gallery:crank_rocker_tolerance", "--json"]


@pytest.mark.parametrize("stop", [1, 3, 6])
def test_an_interrupted_study_goes_on_from_its_file(
    stop: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    crank, vary = machine("crank_rocker"), {"coupler.length": np.linspace(3.2, 3.8, 7)}
    asked = {"metrics": ["travel", "transmission_angle"]}
    whole, calls = lw.study(crank, vary, **asked), 0

    def interrupt(done: int, total: int) -> None:
        nonlocal calls
        calls += 1
        if calls > stop:
            raise KeyboardInterrupt

    with pytest.raises(lw.Interrupted) as stopped, lw.checkpointing(None, crank.name, "asked"):
        lw.study(crank, vary, **asked, progress=interrupt)
    assert stopped.value.state.exists()
    with lw.checkpointing(stopped.value.state, crank.name, "asked"):
        resumed = lw.study(crank, vary, **asked)
    assert resumed.data() == whole.data() and resumed.text("zh") == whole.text("zh")


def test_a_killed_process_goes_on_with_the_same_bytes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(STUDY) == 0
    whole, state = capsys.readouterr().out, tmp_path / "parts.state"
    command = [sys.executable, "-m", "linkwright", *STUDY, "--state", str(state)]
    run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not state.exists() and run.poll() is None:
        time.sleep(0.01)
    run.kill()
    assert run.wait() in (0, -signal.SIGKILL) and state.exists()
    assert main([*STUDY, "--state", str(state)]) == 0
    assert capsys.readouterr().out == whole


def test_states_of_other_work_and_files_that_are_none_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    state = tmp_path / "parts.state"
    assert main([*STUDY, "--state", str(state)]) == 0
    assert main([*STUDY, "--steps", "180", "--state", str(state)]) == 2
    assert main([*SPREAD, "--state", str(state)]) == 2
    assert capsys.readouterr().err.count(str(state)) == 2
    with sqlite3.connect(state) as parts:
        parts.execute("update parts set content = '[' where key <> 'work'")
    parts.close()
    assert main([*STUDY, "--state", str(state)]) == 2
    state.write_text("no database, but a text of some length " * 9)
    assert main([*SPREAD, "--state", str(state), "--lang", "zh"]) == 2
    told = capsys.readouterr().err
    assert told.count(str(state)) == 2
