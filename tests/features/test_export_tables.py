"""CSV, XLSX, JSON and Parquet hold the results with units; files are written whole or not at all."""

import csv
import io
import json
import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright import Forces, export
from linkwright.errors import LinkwrightError, RequestError

FORMULA = '=HYPERLINK("http://example.org","x")'


@pytest.fixture(scope="module")
def forces() -> Forces:
    return store.forces("jaw_crusher_sixbar", 24)


def rows_of(path: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))


def unreachable() -> lw.Motion:
    model = lw.Model("two arms")
    model.frame(O1=(0.0, 0.0), O2=(4.0, 0.0))
    model.link("crank", ["O1", "A"], length=2.0)
    model.link("coupler", ["A", "B"], length=1.5)
    model.link("rocker", ["O2", "B"], length=1.5)
    model.drive("crank", about="O1", speed=1.0)
    return lw.solve_motion(model.build(), steps=36, failures="mark")


def test_csv_has_every_column_with_all_digits(forces: Forces, tmp_path: Path) -> None:
    path = export(forces, tmp_path / "a.csv")
    rows = rows_of(path)
    assert len(rows) == forces.steps
    for name, values in every(forces.columns().items()):
        assert [float(row[name]) for row in rows] == values.tolist()
    load = [float(row["crushing.force.magnitude [N]"]) for row in rows]
    assert load == forces.load("crushing").magnitude.tolist()


def test_csv_in_degrees(forces: Forces, tmp_path: Path) -> None:
    rows = rows_of(export(forces, tmp_path / "a.csv", degrees=True))
    assert [float(row["jaw.angle [°]"]) for row in rows] == pytest.approx(
        np.degrees(forces.motion.link("jaw").angle), rel=1e-14
    )
    assert float(rows[0]["driver [°]"]) == 0.0 and float(rows[6]["driver [°]"]) == pytest.approx(-90.0)


def test_positions_not_reached_are_empty(tmp_path: Path) -> None:
    motion = unreachable()
    assert 0 < motion.ok.sum() < motion.steps
    rows = rows_of(export(motion, tmp_path / "a.csv"))
    assert [row["rocker.angle [rad]"] != "" for row in rows] == motion.ok.tolist()
    found = json.loads(export(motion, tmp_path / "a.json").read_text(encoding="utf-8"))
    values = found["tables"]["links"]["rocker.angle [rad]"]["values"]
    assert [value is not None for value in values] == motion.ok.tolist()
    assert [each["ok"] for each in found["outcomes"]] == motion.ok.tolist()


def test_json_has_units_structure_and_a_model_that_loads(forces: Forces, tmp_path: Path) -> None:
    found = json.loads(export(forces, tmp_path / "a.json").read_text(encoding="utf-8"))
    effort = found["tables"]["forces"]["driver.effort [N·m]"]
    assert effort["owner"] == "driver" and effort["unit"] == "N·m"
    assert effort["values"] == forces.input_torque.tolist()
    assert found["structure"]["mobility"] == 1 and found["positions"] == 24
    assert lw.loads(found["model"]["text"]).dimensions() == forces.mechanism.dimensions()
    assert {row["metric"] for row in found["metrics"]} == {row.metric for row in lw.metrics(forces)}


def test_parquet_keeps_numbers_and_units(forces: Forces, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(export(forces, tmp_path / "a.parquet"))
    for name, values in every(forces.columns().items()):
        assert np.array_equal(table[name].to_numpy(), values)
    field = table.schema.field("jaw.angular_velocity [rad/s]")
    assert field.metadata[b"unit"] == b"rad/s" and field.metadata[b"owner"] == b"jaw"


def test_parquet_holds_nulls_where_a_position_was_not_reached(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    motion = unreachable()
    table = parquet.read_table(export(motion, tmp_path / "a.parquet"))
    assert table["rocker.angle [rad]"].null_count == int((~motion.ok).sum())


def test_xlsx_has_a_sheet_per_subject_with_headings(forces: Forces, tmp_path: Path) -> None:
    pytest.importorskip("xlsxwriter")
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.load_workbook(export(forces, tmp_path / "a.xlsx"))
    assert len(book.sheetnames) == 9
    links = book.worksheets[2]
    heads = [cell.value for cell in links[1]]
    (place,) = [k for k, head in enumerate(heads) if re.fullmatch(r"jaw\n.*\n\[rad/s\]", head)]
    column = [row[place].value for row in links.iter_rows(min_row=2)]
    assert column == pytest.approx(forces.motion.link("jaw").angular_velocity.tolist(), rel=1e-14)
    assert heads[0].endswith("\n[s]") and heads[1].startswith("driver\n") and heads[1].endswith("\n[rad]")
    assert links.freeze_panes == "C2"
    assert links.cell(2, place + 1).number_format.startswith("0.0")


def test_xlsx_in_chinese(forces: Forces, tmp_path: Path) -> None:
    pytest.importorskip("xlsxwriter")
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.load_workbook(export(forces, tmp_path / "a.xlsx", language="zh"))
    assert len(book.sheetnames) == 9 and all("\u4e00" <= name[0] <= "\u9fff" for name in book.sheetnames)
    heads = [cell.value for cell in book.worksheets[2][1]]
    assert [head for head in heads if re.fullmatch(r"jaw\n[\u4e00-\u9fff]+\n\[rad/s\]", head)]


def test_texts_stay_texts_in_excel(tmp_path: Path) -> None:
    pytest.importorskip("xlsxwriter")
    openpyxl = pytest.importorskip("openpyxl")
    mechanism = replace(store.machine("crank_rocker"), name=FORMULA, source="+1+2")
    book = openpyxl.load_workbook(export(mechanism, tmp_path / "a.xlsx", steps=12))
    cells = [cell for sheet in book for row in sheet for cell in row]
    assert FORMULA in [cell.value for cell in cells] and "+1+2" in [cell.value for cell in cells]
    assert {cell.data_type for cell in cells} <= {"s", "n"}
    assert not any(cell.hyperlink for cell in cells)


def test_files_that_exist_are_kept(forces: Forces, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("mine", encoding="utf-8")
    with refused("file.exists", RequestError, path=path, remedy="force=True"):
        export(forces, path)
    assert path.read_text(encoding="utf-8") == "mine"
    export(forces, path, force=True)
    assert path.read_text(encoding="utf-8").startswith("time [s],")


def test_nothing_is_left_behind_when_writing_fails(tmp_path: Path) -> None:
    with refused("picture.no_position", RequestError, position=99, last=11):
        export(store.machine("crank_rocker"), tmp_path / "a.svg", position=99, steps=12)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "options", "code", "values"),
    [
        ("a.xslx", {}, "export.no_ending", {"suffix": ".xslx", "offer": ".xlsx"}),
        ("a.iges", {}, "export.no_ending", {"suffix": ".iges"}),
        ("a", {}, "export.no_ending", {"suffix": ""}),
        ("a.csv", {"format": "exel"}, "names.no_such", {"name": "exel", "offer": "xlsx"}),
        ("a.csv", {"degree": True}, "export.no_option", {"option": "degree", "offer": "degrees", "name": "csv"}),
        ("missing/a.csv", {}, "file.no_folder", {}),
        ("a.csv", {"language": "de"}, "names.no_language", {"language": "de"}),
        ("a.dxf", {"unit": "inch"}, "export.bad_unit", {"unit": "inch"}),
        ("a.dxf", {"curve": "arc"}, "export.bad_curve", {"curve": "arc"}),
    ],
)
def test_mistakes_are_named(
    forces: Forces, tmp_path: Path, name: str, options: dict[str, object], code: str, values: dict[str, object]
) -> None:
    with refused(code, LinkwrightError, **values):
        export(forces, tmp_path / name, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("name", "module", "command"),
    [
        ("a.xlsx", "xlsxwriter", "pip install XlsxWriter"),
        ("a.parquet", "pyarrow", "pip install pyarrow"),
        ("a.dxf", "ezdxf", "pip install ezdxf"),
    ],
)
def test_a_missing_package_is_named_with_its_command(
    forces: Forces, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, module: str, command: str
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with refused("export.needs_package", RequestError, command=command):
        export(forces, tmp_path / name)


def test_only_results_are_exported(tmp_path: Path) -> None:
    with refused("given_instead.needed", RequestError, text="gallery:crank_rocker"):
        export("gallery:crank_rocker", tmp_path / "a.csv")  # type: ignore[arg-type]


def test_pictures(forces: Forces, tmp_path: Path) -> None:
    text = export(forces, tmp_path / "a.svg", position=3, paths=["C"]).read_text(encoding="utf-8")
    assert text.startswith("<svg") and "lw-trace" in text
    pytest.importorskip("resvg_py")
    pillow = pytest.importorskip("PIL.Image")
    data = export(forces, tmp_path / "a.png", width=300).read_bytes()
    assert pillow.open(io.BytesIO(data)).size[0] == 300
