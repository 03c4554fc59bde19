"""Native charts of the Excel file: which cells they draw, under which titles, on a sheet of their own."""

import re
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import export

openpyxl = pytest.importorskip("openpyxl")
C = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"
A = "{http://schemas.openxmlformats.org/drawingml/2006/main}"


class Book:
    """An exported workbook: the charts as they stand in the file, and the cells that they refer to."""

    def __init__(self, path: Path) -> None:
        self.book = openpyxl.load_workbook(path)
        with zipfile.ZipFile(path) as archive:
            names = sorted((n for n in archive.namelist() if re.match(r"xl/charts/chart\d+\.xml", n)), key=number)
            self.charts = [ET.fromstring(archive.read(name)) for name in names]

    def cells(self, reference: str) -> list[float | None]:
        sheet, _, area = reference.rpartition("!")
        rows = self.book[sheet.strip("'")][area.replace("$", "")]
        return [cell.value for (cell,) in rows]


def number(name: str) -> int:
    return int(re.findall(r"\d+", name)[0])


def titles(chart: ET.Element) -> list[str]:
    """Titles of the chart and of its axes."""
    found = ["".join(text.text or "" for text in each.iter(f"{A}t")) for each in chart.iter(f"{C}title")]
    return [each for each in found if each]


def series(chart: ET.Element) -> list[tuple[str, str, str]]:
    """Name, and references of x and y of every curve."""
    found = []
    for each in chart.iter(f"{C}ser"):
        name = each.find(f"{C}tx/{C}v")
        assert name is not None
        x, y = (each.find(f"{C}{axis}/{C}numRef/{C}f") for axis in ("xVal", "yVal"))
        assert x is not None and y is not None
        found.append((name.text or "", x.text or "", y.text or ""))
    return found


def test_charts_of_the_crusher_draw_the_cells_of_the_tables(tmp_path: Path) -> None:
    forces = store.forces("jaw_crusher_sixbar_as_reported", 24)
    book = Book(export(forces, tmp_path / "a.xlsx", degrees=True))
    by_title = {titles(chart)[0]: chart for chart in book.charts}
    assert list(by_title)[:3] == ["jaw: angle", "jaw: angular velocity", "jaw: angular acceleration"]
    assert len(by_title) == 6
    assert titles(by_title["jaw: angular velocity"])[1:] == ["driver [°]", "angular velocity [°/s]"]
    ((_, x, y),) = series(by_title["jaw: angle"])
    assert book.cells(x) == pytest.approx(np.degrees(forces.motion.input))
    assert book.cells(y) == pytest.approx(np.degrees(forces.motion.link("jaw").angle))
    reactions = {name: y for name, _, y in series(by_title["joint forces"])}
    assert len(reactions) == 8
    assert book.cells(reactions["O5 on jaw"]) == pytest.approx(np.hypot(*forces.reaction("O5", on="jaw").T))
    ((_, _, torque),) = series(by_title["what the driver must supply"])
    assert book.cells(torque) == pytest.approx(forces.input_torque)
    ((name, x, y),) = series(list(by_title.values())[-1])
    joint, _, link = name.partition(" on ")
    assert book.cells(x) == pytest.approx(forces.reaction(joint, on=link)[:, 0])
    assert book.cells(y) == pytest.approx(forces.reaction(joint, on=link)[:, 1])


def test_charts_stand_on_a_sheet_of_their_own(tmp_path: Path) -> None:
    book = Book(export(store.forces("jaw_crusher_sixbar", 24), tmp_path / "a.xlsx")).book
    charts = {sheet.title: len(sheet._charts) for sheet in book}
    assert charts.pop("Charts") == 6 and set(charts.values()) == {0}


def test_charts_in_chinese(tmp_path: Path) -> None:
    book = Book(export(store.forces("swing_conveyor", 24), tmp_path / "a.xlsx", language="zh"))
    words = [word for chart in every(book.charts, least=6) for word in titles(chart)]
    assert all(re.search("[\u4e00-\u9fff]", word) for word in words if "[rad]" not in word)
    assert any(word.endswith("[m/s²]") for word in words)


def test_a_clockwise_crank_runs_from_left_to_right(tmp_path: Path) -> None:
    for name, backwards in (("jaw_crusher_sixbar", True), ("swing_conveyor", False)):
        book = Book(export(store.motion(name, 24), tmp_path / f"{name}.xlsx"))
        axes = list(book.charts[0].iter(f"{C}valAx"))
        senses = [each.find(f"{C}scaling/{C}orientation").get("val") for each in axes]  # type: ignore[union-attr]
        assert senses == (["maxMin", "minMax"] if backwards else ["minMax", "minMax"])


def test_a_hodograph_has_one_scale(tmp_path: Path) -> None:
    book = Book(export(store.forces("swing_conveyor", 90), tmp_path / "a.xlsx"))
    spans = []
    for axis in book.charts[-1].iter(f"{C}valAx"):
        low, high = (float(axis.find(f"{C}scaling/{C}{end}").get("val")) for end in ("min", "max"))  # type: ignore[union-attr, arg-type]
        spans.append(high - low)
    assert spans[0] == pytest.approx(spans[1], rel=1e-9)


def test_several_drivers_over_the_time_and_positions_in_no_order(tmp_path: Path) -> None:
    book = Book(export(store.forces("excavator", 12), tmp_path / "a.xlsx"))
    for chart in every(book.charts[:-1], least=4):
        assert titles(chart)[1] == "time [s]"
    (efforts,) = [chart for chart in book.charts if titles(chart)[0] == "what the driver must supply"]
    assert [name for name, *_ in series(efforts)] == ["boom_lift", "stick_swing", "bucket_curl"]
    motion = lw.solve_motion(store.machine("crank_rocker"), at=[0.0, 1.0, 0.5])
    for chart in every(Book(export(motion, tmp_path / "b.xlsx")).charts):
        assert chart.find(f".//{C}ser/{C}marker/{C}symbol").get("val") == "circle"  # type: ignore[union-attr]


def test_what_does_not_move_has_no_charts(tmp_path: Path) -> None:
    path = export(store.machine("truss"), tmp_path / "a.xlsx")
    assert not Book(path).charts and "Charts" not in openpyxl.load_workbook(path).sheetnames
