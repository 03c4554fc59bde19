"""Tables at the positions that a task asks for: the same words for report, solve and export."""

import csv
import json
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.cli.commands import data, is_refused
from tests.every import every
from tests.refusals import faulty

import linkwright as lw
from linkwright.cli import main
from linkwright.reports.document import Paragraph, Table, plain

#: The limit positions that the conveyor's report prints, degrees.
LIMITS = (231.6500775, 348.743)
ARMS = """
format: 1
name: two arms
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 2 m}
  coupler: {points: [A, B], length: 1.5 m}
  rocker: {points: [O2, B], length: 1.5 m}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""

RAM = """
format: 1
name: ram
frame: {points: {O: [0 m, 0 m], P: [0 m, -0.1 m]}}
links:
  ram: {points: [B]}
  rod: {points: [B, C], length: 0.3 m}
  arm: {points: [P, C], length: 0.25 m}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B}}
assembly: {C: left}
driver: {slide: guide, speed: 0.1 m/s}
cycle: {from: 0 mm, to: 200 mm}
"""


def tables(machine: object, positions: object, section: str = "tables") -> list[Table]:
    report = lw.report(machine, sections=[section], positions=positions)  # type: ignore[arg-type]
    return [block for block in report.document.blocks if isinstance(block, Table)]


def column(found: list[Table], head: str) -> list[float]:
    """The numbers of the first column whose head begins so."""
    for table in found:
        for k, each in enumerate(table.head):
            if plain(each).startswith(head):
                return [float(row[k].replace("−", "-")) if row[k] != "–" else math.nan for row in table.rows]
    raise AssertionError([table.head for table in found])


def test_the_conveyors_table_with_both_limit_positions() -> None:
    """Positions and rows as the source prints them; velocities are zero in the limit positions."""
    listed = ["0 deg", "60 deg", "120 deg", "180 deg", "240 deg", "300 deg", "rocker max", "rocker min"]
    found = tables("gallery:swing_conveyor", listed)
    assert column(found, "q ") == pytest.approx([0, 60, 120, 180, 240, 300, 231.65, 348.74])
    printed = [1.22361, 1.14343, 0.90679, 0.71922, 0.664279, 0.918551, 0.662387]
    assert np.array(column(found, "s_")[:7]) / 1e3 == pytest.approx(printed, abs=0.51e-5)
    assert column(found, "ṡ_")[6:] == [0.0, 0.0]
    assert column(found, "ω_3")[6:] == [0.0, 0.0]


def test_the_crushers_steps_backwards() -> None:
    """0, -15, … -360 degrees, forces and directions as the source prints them."""
    steps = {"from": "0 deg", "step": "-15 deg", "to": "-360 deg"}
    found = tables("gallery:jaw_crusher_sixbar_as_reported", steps)
    assert column(found, "q ") == list(range(0, -361, -15))
    assert column(found, "F_O5,5")[0] == pytest.approx(9904.580, abs=0.051)
    assert column(found, "β_O5,5")[:3] == pytest.approx([77.690, 82.670, 89.576], abs=0.51e-3)


@pytest.mark.parametrize(
    ("listed", "degrees"),
    [
        ("0..-90 deg:30 deg", [0, -30, -60, -90]),
        (["90..0 deg:45", "10 deg"], [90, 45, 0, 10]),
        ({"from": "0 deg", "step": "-15 deg", "count": 3}, [0, -15, -30]),
        ({"from": "0 deg", "to": "-90 deg", "count": 4}, [0, -30, -60, -90]),
        ({"from": "rocker min", "step": "-10 deg", "count": 3}, [33.557310, 23.557310, 13.557310]),
        (["20 deg", {"from": "0 deg", "to": "10 deg", "step": "5 deg"}], [20, 0, 5, 10]),
        (["0.05 s"], [28.647890]),
        ("0 deg", [0]),
    ],
)
def test_lists_starts_and_steps(listed: object, degrees: list[float]) -> None:
    found = tables("gallery:crank_rocker", listed)
    assert column(found, "q ") == pytest.approx(degrees, abs=0.0051)


def test_one_meaning_for_report_solve_and_export(tmp_path: Path) -> None:
    text = "60 deg, limits, 0..-30deg:-15, rocker max"
    shown = column(tables("gallery:crank_rocker", text), "q ")
    solved = data("solve", "gallery:crank_rocker", "--at", text)["columns"]
    assert np.degrees(solved["driver [rad]"]) == pytest.approx(shown, abs=0.0051)
    for ending in ("csv", "json", "parquet", "xlsx"):
        path = tmp_path / f"a.{ending}"
        assert main(["export", "gallery:crank_rocker", "--at", text, "--output", str(path)]) == 0
        for name in ("driver [rad]", "rocker.angle [rad]", "rocker.angular_velocity [rad/s]"):
            assert read(path, name) == pytest.approx(solved[name], rel=1e-12, abs=1e-12)
    limit = np.degrees(solved["driver [rad]"][1])
    assert limit == pytest.approx(33.5573098, abs=1e-6)


def read(path: Path, name: str) -> list[float]:
    """A column of an exported file."""
    if path.suffix == ".csv":
        return [float(row[name]) for row in csv.DictReader(path.read_text("utf-8").splitlines())]
    if path.suffix == ".json":
        found = json.loads(path.read_text("utf-8"))["tables"]
        return next(table[name]["values"] for table in found.values() if name in table)  # type: ignore[no-any-return]
    if path.suffix == ".parquet":
        parquet = pytest.importorskip("pyarrow.parquet")
        return parquet.read_table(path).column(name).to_pylist()  # type: ignore[no-any-return]
    openpyxl = pytest.importorskip("openpyxl")
    owner, _, rest = name.rpartition(" ")[0].partition(".")
    word = {"": "input", "angle": "angle", "angular_velocity": "angular velocity"}[rest]
    heading = f"{owner}\n{word}\n{name.rpartition(' ')[2]}"
    for sheet in openpyxl.load_workbook(path):
        heads = [cell.value for cell in sheet[1]]
        if heading in heads:
            return [row[heads.index(heading)] for row in sheet.iter_rows(min_row=2, values_only=True)]
    raise AssertionError(heading)


def test_positions_of_laws_in_time_and_of_several_drivers() -> None:
    """Times, and limit positions by their times; every driver's input once."""
    found = tables("gallery:excavator", ["0 s", "1 s", "boom max", "boom min"])
    assert column(found, "t") == pytest.approx([0, 1, 2, 6], abs=1e-6)
    lift = column(found, "boom_lift")
    motion = store.motion("excavator", 24)
    assert lift[2] == pytest.approx(1e3 * motion.inputs["boom_lift"].max(), abs=0.01)
    assert lift[3] == pytest.approx(1e3 * motion.inputs["boom_lift"].min(), abs=0.01)
    assert column(found, "ω_1")[2:] == [0.0, 0.0]


def test_positions_of_a_sliding_driver() -> None:
    """A block at constant speed: strokes in the order asked for, and the times at which they are reached."""
    listed = ["200 mm", "0..50 mm:25 mm", "0.1 s"]
    found = tables(lw.loads(RAM), listed)
    assert column(found, "q ") == [200.0, 0.0, 25.0, 50.0, 10.0]
    assert column(found, "x_B") == [200.0, 0.0, 25.0, 50.0, 10.0]


def test_positions_out_of_reach_have_a_sentence_and_no_number(tmp_path: Path) -> None:
    listed = ["0 deg", "20 deg", "180 deg"]
    report = lw.report(lw.loads(ARMS), sections=["tables"], positions=listed)
    found = [block for block in report.document.blocks if isinstance(block, Table)]
    said = [b.text for b in report.document.blocks if isinstance(b, Paragraph) and b.kind == "missing"]
    assert math.isnan(column(found, "φ_2")[2]) and not math.isnan(column(found, "φ_2")[1])
    assert any("180°" in each or "6000 mm" in each for each in said)
    path, model = tmp_path / "a.csv", tmp_path / "arms.yaml"
    model.write_text(ARMS, "utf-8")
    assert main(["export", str(model), "--at", *listed, "--output", str(path)]) == 1
    rows = list(csv.DictReader(path.read_text("utf-8").splitlines()))
    assert [row["coupler.angle [rad]"] == "" for row in rows] == [False, False, True]


def test_angles_of_positions_far_apart() -> None:
    """A driven link has the input's angle, others that of their time, in whatever order they are asked for."""
    degrees = [0.0, 270.0, 33.0, 216.0, 60.0, 360.0, -30.0]
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"), at=np.radians(degrees))
    assert np.degrees(motion.link("crank").angle) == pytest.approx(degrees)
    whole = lw.solve_motion(lw.load("gallery:crank_rocker"), steps=360)
    rocker = np.degrees(whole.link("rocker").angle)[[0, 270, 33, 216, 60, 0, 330]]
    assert np.degrees(motion.link("rocker").angle) == pytest.approx(rocker, abs=1e-9)


@pytest.mark.parametrize(
    ("listed", "code", "values"),
    [
        (["0 deg", "rokcer min"], "study.no_such_output", {"name": "rokcer"}),
        (["0 deg", "60"], "missing-unit", {"text": "60"}),
        ({"from": "0 deg", "step": "15 deg"}, "solve.step_keys", {}),
        ({"from": "0 deg", "to": "90 deg", "step": "-15 deg"}, "solve.step_away", {}),
        ({"from": "0 deg", "to": "90 deg", "count": "many"}, "solve.bad_count", {"text": "many"}),
        ({"from": "limits", "step": "5 deg", "count": 3}, "solve.step_from_limit", {"text": "limits"}),
        ([], "solve.empty_value", {}),
        ("30 mm", "wrong-dimension", {"text": "30 mm"}),
        (1, "bad-positions", {}),
        ("-24", "bad-positions", {}),
    ],
)
def test_positions_that_make_no_sense(listed: object, code: str, values: Mapping[str, object]) -> None:
    with faulty(code, "report.positions", **values):
        lw.report("gallery:crank_rocker", sections=["tables"], positions=listed)  # type: ignore[arg-type]


def test_a_key_that_positions_do_not_have_is_told_at_its_place() -> None:
    listed = {"from": "0 deg", "step": "15 deg", "until": "1 deg"}
    with faulty("unknown-key", "report.positions.until", offer="count"):
        lw.report("gallery:crank_rocker", sections=["tables"], positions=listed)


def test_inputs_of_laws_in_time_are_refused() -> None:
    with faulty("wrong-dimension", "report.positions"):
        lw.report("gallery:excavator", sections=["tables"], positions=["2.2 m"])
    is_refused(["solve", "gallery:crank_rocker", "--at", "coupler mxa"], "quantity")
    is_refused(["solve", "gallery:crank_rocker", "--at", "0..90deg:-15"], "solve.step_away")
    is_refused(["solve", "gallery:dyad_rrr", "--at", "limits"], "solve.no_limits")
    is_refused(["solve", "gallery:parallelogram", "--at", "rocker min"], "picture.no_limit_positions")
    is_refused(["export", "gallery:crank_rocker", "--at", "x min", "--output", "a.csv"], "study.no_such_output")


def test_every_table_has_the_listed_positions() -> None:
    """Forces, effort and appendix too."""
    for section in ("tables", "torque", "appendix"):
        for table in every(tables("gallery:swing_conveyor", "0..90 deg:30 deg, limits", section)):
            assert len(table.rows) == 6
