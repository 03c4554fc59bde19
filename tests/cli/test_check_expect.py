"""``linkwright check --expect``."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.cli.commands import data, shown
from tests.features.piston import PISTON

CRANK = PISTON.replace("60 rpm", "1500 rpm") + "expect:\n  stroke: 120 mm ± 0.1 mm\n"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "piston.yaml"
    path.write_text(CRANK, "utf-8")
    return path


def test_what_holds_is_shown(file: Path) -> None:
    assert "its 1 expectations are not evaluated: add --expect" in shown("check", str(file))
    printed = shown("check", str(file), "--expect")
    assert "1 of 1 expectations hold" in printed and "holds" in printed and "120 mm ± 0.1 mm" in printed


def test_what_fails_is_an_error(file: Path) -> None:
    """The piston's acceleration at the outer dead centre is r ω² (1 + r/l)."""
    file.write_text(f"{CRANK}  peak_acceleration cylinder: at most 1000 m/s²\n", "utf-8")
    printed = shown("check", str(file), "--expect", code=1)
    assert "piston.yaml:14:31: expect.peak_acceleration cylinder: " in printed and "errors: 1" in printed
    (one,) = data("check", str(file), "--expect", code=1)["files"]
    assert [each["holds"] for each in one["expectations"]] == [True, False]
    omega = 1500 / 60 * 2 * 3.141592653589793
    assert one["expectations"][1]["value"] == pytest.approx(0.06 * omega**2 * (1 + 60 / 200), rel=1e-9)
    assert [each["code"] for each in one["findings"]] == ["not-met"]
    assert "expectations" not in data("check", str(file))["files"][0]
