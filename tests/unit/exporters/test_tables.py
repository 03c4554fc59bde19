"""Formats of exported tables: endings, sizes of sheets, formats of numbers."""

from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

from linkwright.errors import RequestError
from linkwright.exporters.export import FORMATS, chosen_format, export
from linkwright.exporters.formats import xlsx
from linkwright.exporters.formats.xlsx import number_format


def test_number_formats_show_six_digits() -> None:
    assert number_format(np.array([0.0, np.nan])) == "0.000"
    assert number_format(np.array([123.456, -5.0])) == "0.000"
    assert number_format(np.array([2e9])) == "0.00000E+00"
    assert number_format(np.array([54321678.0])) == "0"


def test_a_sheet_that_would_not_hold_all_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("xlsxwriter")
    monkeypatch.setattr(xlsx, "MOST_ROWS", 23)
    with refused("export.sheet_full", RequestError, rows=23):
        export(store.forces("jaw_crusher_sixbar", 24), tmp_path / "a.xlsx")
    assert list(tmp_path.iterdir()) == []


def test_every_format_has_an_ending_of_its_own() -> None:
    endings = every((suffix for form in FORMATS.values() for suffix in form.suffixes), least=10)
    assert len(endings) == len(set(endings))
    assert all(chosen_format(Path(f"a{suffix.upper()}"), None) in FORMATS for suffix in endings)
