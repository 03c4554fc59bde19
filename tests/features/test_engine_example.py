"""The example of the engine's page runs and prints what its closed form gives."""

from __future__ import annotations

import math
import runpy
from pathlib import Path

import pytest


def test_the_example_of_the_documentation_runs(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    page = Path(__file__).parents[2] / "docs" / "en" / "theory" / "engine.md"
    file = tmp_path / "example.py"
    file.write_text(page.read_text(encoding="utf-8").split("```python\n")[1].split("```")[0], encoding="utf-8")
    runpy.run_path(str(file))
    printed = capsys.readouterr().out
    assert printed.splitlines()[0] == "[3.96862697 5.        ]"
    assert f"{4.0 / math.sqrt(15.75):.8f}" in printed
