"""The command ``sheet``."""

import json
from pathlib import Path

import pytest

from linkwright.cli import main


@pytest.mark.parametrize(("ending", "begins"), [("pdf", b"%PDF"), ("svg", b"<svg"), ("dxf", b"  0")])
def test_the_command_writes_a_sheet(
    ending: str, begins: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"crank.{ending}"
    assert main(["sheet", "gallery:slider_crank_offset", "--size", "A4", "--output", str(path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert path.read_bytes().startswith(begins)
    assert told["size"] == "A4" and "mechanism" in told["panels"] and told["notes"]


def test_other_endings_and_files_that_exist_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "crank.pdf"
    path.write_text("mine")
    assert main(["sheet", "gallery:slider_crank_offset", "--output", str(path)]) != 0
    assert path.read_text() == "mine"
    assert main(["sheet", "gallery:slider_crank_offset", "--output", str(tmp_path / "crank.png")]) == 2
