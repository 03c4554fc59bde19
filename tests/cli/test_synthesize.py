"""The command synthesize."""

import math
from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, run, shown
from tests.cli.tables import numbers, rows
from tests.every import every

import linkwright as lw
from linkwright import gallery
from linkwright.cli import main

PRESS = ["synthesize", "slider_crank", "stroke=397.5 mm", "rod_ratio=3.55", "offset_ratio=0.305"]


def test_candidates_are_shown() -> None:
    """Error, worst error, transmission angle, ratio and length of the longest link; then the lengths."""
    printed = shown(*PRESS)
    row = rows(printed)[-1]
    assert [row[0], row[2], row[3], *row[-3:]] == ["1", "0", "0", "68.43°", "3.55", "702.7 mm"]
    assert "197.9511 mm" in printed and "702.7263 mm" in printed


def test_data_and_efforts() -> None:
    (each,) = data(*PRESS, "--mass", "2")["candidates"]
    assert each["crank [m]"] == pytest.approx(0.1979511, abs=1e-7)
    assert each["peak_input_torque"] > 0 and each["peak_reaction"] > 0


def test_files_are_written_and_can_be_solved(tmp_path: Path) -> None:
    words = ["synthesize", "crank_rocker", "swing_angle=40 deg", "quick_return_ratio=1.2", "frame=300 mm"]
    printed = shown(*words, "--output", str(tmp_path))
    files = sorted(tmp_path.glob("*.yaml"))
    assert len(files) == 3 and not [found for found in lw.check(files[0]) if found.severity == "error"]
    assert lw.solve_motion(lw.load(files[0]), steps=12).point("B").position.shape[1] == 2
    assert all(str(file) in printed for file in files)
    is_refused([*words, "--output", str(tmp_path)], "file.exists", path=files[0])


def test_files_have_the_speed_asked_for(tmp_path: Path) -> None:
    words = ["synthesize", "quick_return", "quick_return_ratio=1.5", "frame=430 mm", "--speed", "50 rpm"]
    assert main([*words, "--output", str(tmp_path)]) == 0
    (turned,) = set(lw.solve_motion(lw.load(*tmp_path.glob("*.yaml")), steps=12).link("crank").angular_velocity)
    assert turned == pytest.approx(50 * 2 * math.pi / 60)


def test_a_file_with_a_section(tmp_path: Path) -> None:
    file = tmp_path / "line.yaml"
    file.write_text("format: 1\nsynthesis: {task: straight_line, length: 100 mm, kind: hoecken}\n")
    (found,) = data("synthesize", str(file))["candidates"]
    assert (found["kind"], found["type"]) == ("hoecken", "crank_rocker")
    lengths = found["lengths [m]"]
    assert lengths["coupler"] == pytest.approx(2.5 * lengths["crank"], rel=1e-9)
    assert found["error"] < 1e-4


def test_a_demand_that_fails_shows_the_nearest() -> None:
    """The smallest rod ratio with which the crank turns, 1 + ε."""
    asked = ["synthesize", "slider_crank", "stroke=40 mm", "rod_ratio=1.1", "offset_ratio=0.3"]
    ended = run(*asked)
    assert ended.code == 1 and ended.told is not None
    assert (ended.told.code, ended.told.values["value"], ended.told.values["minimum"]) == (
        "synthesize.slider_crank.ratio",
        "1.1",
        "1.3",
    )
    assert rows(ended.out)[-1][-3:] == ["0.00°", "1.3", "22.8 mm"]
    (nearest,) = data(*asked, code=1)["nearest"]["candidates"]
    assert nearest["link_ratio"] == pytest.approx(1.3, rel=1e-9)


def test_picture(tmp_path: Path) -> None:
    picture = tmp_path / "path.svg"
    words = ["synthesize", "path", "unit=mm", "points=[[20, 20], [20, 30], [20, 40]]", "bound=90 mm"]
    assert main([*words, "--plot", str(picture)]) == 0
    assert picture.read_text().startswith("<?xml")


@pytest.mark.parametrize(
    ("words", "code", "values"),
    [
        (["synthesize", "nothing.yaml"], "no-file", {}),
        (["synthesize", "slider_crank", "stroke"], "synthesize.bad_demand", {"text": "stroke"}),
        ([*PRESS, "--mass", "x"], "type", {"text": "x"}),
        ([*PRESS, "--speed", "50 mm"], "wrong-dimension", {"name": "speed", "text": "50 mm"}),
        ([*PRESS, "--output", f"{__file__}/models"], "file.no_folder_there", {"there": __file__}),
        ([*PRESS, "--output", "/proc/models"], "file.cannot_make", {"path": "/proc/models"}),
        ([*PRESS, "--plot", "/no/such/folder/a.svg"], "file.no_folder", {"path": "/no/such/folder"}),
    ],
)
def test_misuse(words: list[str], code: str, values: dict[str, object]) -> None:
    is_refused(words, code, **values)


def test_folders_are_made_where_candidates_are_found(tmp_path: Path) -> None:
    folder = tmp_path / "presses" / "first"
    assert main([*PRESS, "--output", str(folder)]) == 0
    models = sorted(folder.iterdir())
    assert models and all(lw.check(model) == [] for model in models)
    unmet = ["synthesize", "slider_crank", "stroke=1 m", "--output", str(tmp_path / "none")]
    is_refused(unmet, "synthesize.slider_crank.demands", ends=1, value="stroke")
    assert not (tmp_path / "none").exists()


def test_what_cannot_be_written_is_told_before_anything_is_sought(tmp_path: Path) -> None:
    """Demands that nothing meets are not even looked at."""
    assert main([*PRESS, "--output", str(tmp_path)]) == 0
    unmet = ["synthesize", "slider_crank", "stroke=1 m"]
    written = tmp_path / "slider_crank_1.yaml"
    is_refused([*unmet, "--output", str(tmp_path)], "file.exists", path=written)
    is_refused([*unmet, "--output", str(written / "deeper")], "file.no_folder_there", there=written)


TASK = "format: 1\nsynthesis:\n  task: slider_crank\n  stroke: 40 mm\n  rod_ratio: 4\n"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (TASK, []),
        (TASK.replace("stroke", "strok"), [("4:3", "synthesis.strok", "unknown-demand")]),
        (
            TASK.replace("4\n", "4 m\n") + "sythesis: {}\n",
            [("6:1", "sythesis", "unknown-key"), ("5:14", "synthesis.rod_ratio", "wrong-dimension")],
        ),
        (TASK.replace("slider_crank", "slider_crnk"), [("3:9", "synthesis.task", "unknown-task")]),
        ("format: 1\nsynthesis: [1]\n", [("2:12", "synthesis", "type")]),
        (
            TASK.replace("4\n", "[1, 2]\n").replace("40 mm", "{a: 1}"),
            [("4:11", "synthesis.stroke", "type"), ("5:14", "synthesis.rod_ratio", "type")],
        ),
    ],
)
def test_a_file_with_a_task_alone_is_checked(text: str, found: list[tuple[str, str, str]], tmp_path: Path) -> None:
    path = tmp_path / "task.yaml"
    path.write_text(text, encoding="utf-8")
    (file,) = data("check", str(path), code=int(bool(found)))["files"]
    assert file["kind"].startswith("synthesis") and file["ok"] == (not found)
    assert [(each["where"], each["key"], each["code"]) for each in file["findings"]] == [
        (f"task.yaml:{place}", key, code) for place, key, code in found
    ]


def test_the_task_of_the_gallery_is_checked_listed_and_solved() -> None:
    """The least sum of squares of the published case, 2.7108919e-7 m²."""
    name = "path_of_five_points"
    assert main(["check", f"gallery:{name}"]) == 0
    assert name in shown("gallery", "list", "path")
    assert shown("gallery", "show", name).rstrip() == gallery.content(name).decode().rstrip()
    found = data("synthesize", f"gallery:{name}")
    assert found["candidates"][0]["error"] == pytest.approx(2.7108919e-7, rel=1e-7)


def test_a_task_without_a_machine_is_sent_to_the_right_command() -> None:
    told = is_refused(["solve", "gallery:path_of_five_points"], "kind", ends=1)
    assert isinstance(told, lw.ModelError)
    (finding,) = told.findings
    assert finding.key == "synthesis" and "linkwright synthesize" in str(finding)


def test_what_is_met_but_for_rounding_has_no_error() -> None:
    """Three points are met exactly; 8e-35 m² was shown."""
    printed = shown("synthesize", "path", "points=[[20, 20], [20, 30], [20, 40]]", "unit=mm")
    table = [row for row in rows(printed) if row[0].isdigit()]
    assert all(row[2:4] == ["0", "0"] for row in every(table, least=2))
    assert not [line for line in printed.splitlines() if any(0 < abs(each) < 1e-9 for each in numbers(line))]


def test_the_worked_solution() -> None:
    """Every formula with its numbers; in data beside the candidates."""
    printed = shown(*PRESS, "--worked")
    assert "397.5/(√((3.55 + 1)² - 0.305²) - √((3.55 - 1)² - 0.305²))" in printed and "= 197.951 mm" in printed
    found = data(*PRESS, "--worked")
    (line,) = [item for step in found["worked"]["steps"] for item in step["items"] if item.get("symbol") == "r"]
    assert line["value"] == pytest.approx(197.9511, abs=5e-5)
    assert found["candidates"][0]["crank [m]"] == pytest.approx(0.1979511, abs=1e-7)


def test_a_curve_beside_its_task(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The file that a task names lies beside the task, wherever the program runs."""
    folder, elsewhere = tmp_path / "task", tmp_path / "elsewhere"
    folder.mkdir()
    elsewhere.mkdir()
    task = folder / "curve.yaml"
    task.write_text("format: 1\nsynthesis: {task: free_curve, file: letter.csv, joints: 5, seconds: 0.1}\n")
    monkeypatch.chdir(elsewhere)
    is_refused(["synthesize", str(task)], "synthesize.free_curve.file", ends=1, path=str(folder / "letter.csv"))
    (folder / "letter.csv").write_text("7,7\n7,7\n")
    is_refused(["synthesize", str(task)], "synthesize.path.one_place", ends=1)
