"""The wording is that of the snapshots, which ``python -m tests.words`` writes and people read in review."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_wording_is_that_of_the_snapshots() -> None:
    command = [sys.executable, "-m", "tests.words", "--check"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"if this is meant, write it with python -m tests.words:\n{done.stdout}{done.stderr}"
