"""One table, many media: a terminal, Markdown, HTML, CSV and Excel have the same cells; so results are written."""

import csv
import io
import json
import re
from pathlib import Path

import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.core.table import PERCENT, Amount, Table

TABLE = Table(
    ("name", "value", "share"),
    [["a|b", Amount(0.25, "length"), Amount(0.5, scale=PERCENT)], ["c", Amount(1.0, "angle", end=2.0), None]],
    title="Title",
    notes=["said *below*"],
)


def test_the_same_cells_in_every_medium() -> None:
    cells = [["a|b", "250 mm", "50 %"], ["c", "57.2958 … 114.592°", ""]]
    assert TABLE.texts()[1:] == cells
    title, _, head, *rows, _, note = TABLE.lines()
    assert (title, note, len(rows)) == ("Title", "said *below*", 2) and head.split() == list(TABLE.head)
    assert all(cell in row for row, texts in zip(rows, cells, strict=True) for cell in texts)
    marked = TABLE.markdown().split("\n\n")
    assert marked[0] == "**Title**" and marked[2] == r"said \*below\*"
    assert marked[1].splitlines()[1:3] == ["| --- | --: | --: |", r"| a\|b | 250 mm | 50 % |"]
    assert re.findall("<td[^>]*>([^<]*)</td>", TABLE.html()) == [cell for row in cells for cell in row]


@pytest.fixture(scope="module")
def results() -> dict[str, lw.Tabular]:
    machine = store.machine("jaw_crusher_sixbar")
    return {
        "study": lw.study(machine, {"pitman.length": "1.2..1.3 m:3"}, steps=24),
        "slopes": lw.sensitivity(machine, of=["jaw.angle range"], by=["pitman.length"], steps=24),
        "metrics": lw.metrics(store.motion("crank_rocker", 24)),
        "structure": lw.structure(machine),
        "beam": lw.parts.load("gallery:simple_beam").solve(),
        "balance": lw.balance(store.machine("jaw_crusher_fourbar"), radius=0.2, steps=24),
    }


@pytest.mark.parametrize("name", ["study", "slopes", "metrics", "structure", "beam", "balance"])
def test_every_result_is_written_by_its_tables(results: dict[str, lw.Tabular], name: str, tmp_path: Path) -> None:
    found = results[name]
    written = {ending: lw.export(found, tmp_path / f"a.{ending}") for ending in ("csv", "json", "md", "html")}
    shown = [cell.strip() for table in found.tables() for row in table.texts()[1:] for cell in row]
    marked = re.sub(r"\\(.)", r"\1", written["md"].read_text("utf-8"))
    assert shown and all(cell in marked for cell in shown)
    assert written["html"].read_text("utf-8").count("<tr>") == sum(len(t.rows) + 1 for t in found.tables() if t.rows)
    data = json.loads(written["json"].read_text("utf-8"))
    assert set(data) == set(found.data())
    columns, rows = found.columns(), list(csv.reader(io.StringIO(written["csv"].read_text("utf-8"))))
    assert rows[0] == list(columns) if columns else len([row for row in rows if row]) >= len(found.tables()[-1].rows)
    with refused("export.no_tables", name="dxf"):
        lw.export(found, tmp_path / "a.dxf")


def test_numbers_of_excel_files_are_numbers_in_the_shown_unit(results: dict[str, lw.Tabular], tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    pytest.importorskip("xlsxwriter")
    balance = results["balance"]
    sheets = openpyxl.load_workbook(lw.export(balance, tmp_path / "a.xlsx")).worksheets
    assert len(sheets) == sum(bool(table.rows) for table in balance.tables())
    peak = balance.data()["peaks"]["shaking_force [N]"]["without"]
    cells = {row[0].value: row for row in sheets[1].iter_rows()}
    assert cells["shaking force"][2].value == pytest.approx(peak, rel=1e-12)
    assert cells["shaking force"][4].number_format == 'General" %"'
