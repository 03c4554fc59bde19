"""The command synthesize."""

import json
import math
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.cli import main

PRESS = ["synthesize", "slider_crank", "stroke=397.5 mm", "rod_ratio=3.55", "offset_ratio=0.305"]


def test_candidates_are_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(PRESS) == 0
    out = capsys.readouterr().out
    assert "slider-crank" in out and "68.43°" in out and "197.9511 mm" in out


def test_data_and_efforts(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*PRESS, "--json", "--mass", "2"]) == 0
    (each,) = json.loads(capsys.readouterr().out)["candidates"]
    assert each["crank [m]"] == pytest.approx(0.1979511, abs=1e-7)
    assert each["peak_input_torque"] > 0 and each["peak_reaction"] > 0


def test_files_are_written_and_can_be_solved(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["synthesize", "crank_rocker", "swing_angle=40 deg", "quick_return_ratio=1.2", "frame=300 mm"]
    assert main([*words, "--output", str(tmp_path)]) == 0
    files = sorted(tmp_path.glob("*.yaml"))
    assert len(files) == 3 and not [found for found in lw.check(files[0]) if found.severity == "error"]
    assert lw.solve_motion(lw.load(files[0]), steps=12).point("B").position.shape[1] == 2
    assert main([*words, "--output", str(tmp_path)]) == 2
    assert "written" in capsys.readouterr().out


def test_files_have_the_speed_asked_for(tmp_path: Path) -> None:
    words = ["synthesize", "quick_return", "quick_return_ratio=1.5", "frame=430 mm", "--speed", "50 rpm"]
    assert main([*words, "--output", str(tmp_path)]) == 0
    (turned,) = set(
        lw.solve_motion(lw.load(*tmp_path.glob("*.yaml")), steps=12).link("crank").angular_velocity
    )
    assert turned == pytest.approx(50 * 2 * math.pi / 60)


def test_a_file_with_a_section(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "line.yaml"
    file.write_text("format: 1\nsynthesis: {task: straight_line, length: 100 mm, kind: hoecken}\n")
    assert main(["synthesize", str(file), "--lang", "zh"]) == 0
    assert "曲柄摇杆" in capsys.readouterr().out


def test_a_demand_that_fails_shows_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["synthesize", "slider_crank", "stroke=40 mm", "rod_ratio=1.1", "offset_ratio=0.3"]) == 1
    told = capsys.readouterr()
    assert "λ = 1.1 is too small" in told.err and "slider-crank" in told.out


def test_picture(tmp_path: Path) -> None:
    picture = tmp_path / "path.svg"
    words = ["synthesize", "path", "unit=mm", "points=[[20, 20], [20, 30], [20, 40]]", "bound=90 mm"]
    assert main([*words, "--plot", str(picture)]) == 0
    assert picture.read_text().startswith("<?xml")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["synthesize", "nothing.yaml"], "no such file"),
        (["synthesize", "slider_crank", "stroke"], "is no demand"),
        ([*PRESS, "--mass", "x"], "mass per length"),
        ([*PRESS, "--speed", "50 mm"], "speed"),
        ([*PRESS, "--output", f"{__file__}/models"], f'"{__file__}" is a file'),
        ([*PRESS, "--output", "/proc/models"], "cannot be made"),
        ([*PRESS, "--plot", "/no/such/folder/a.svg"], 'there is no folder "/no/such/folder"'),
    ],
)
def test_misuse(words: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    assert told in capsys.readouterr().err


def test_folders_are_made_where_candidates_are_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "presses" / "first"
    assert main([*PRESS, "--output", str(folder)]) == 0
    models = sorted(folder.iterdir())
    assert models and all(lw.check(model) == [] for model in models)
    unmet = ["synthesize", "slider_crank", "stroke=1 m"]
    assert main([*unmet, "--output", str(tmp_path / "none")]) != 0
    assert not (tmp_path / "none").exists()


def test_what_cannot_be_written_is_told_before_anything_is_sought(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main([*PRESS, "--output", str(tmp_path)]) == 0

    def never(task: str, **demands: object) -> None:
        raise AssertionError(task)

    monkeypatch.setattr("linkwright.synthesis.tasks.synthesize", never)
    for folder, told in ((tmp_path, "exists"), (tmp_path / "slider_crank_1.yaml" / "deeper", "is a file")):
        assert main([*PRESS, "--output", str(folder)]) == 2
        assert told in capsys.readouterr().err


TASK = "format: 1\nsynthesis:\n  task: slider_crank\n  stroke: 40 mm\n  rod_ratio: 4\n"


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        (TASK, 0, ["fine", "slider_crank"]),
        (TASK.replace("stroke", "strok"), 1, ["synthesis.strok", "4:3"]),
        (TASK.replace("4\n", "4 m\n") + "sythesis: {}\n", 1, ["rod_ratio", "dimensionless", "sythesis"]),
        (TASK.replace("slider_crank", "slider_crnk"), 1, ["synthesis.task", "slider_crank"]),
        ("format: 1\nsynthesis: [1]\n", 1, ["synthesis"]),
    ],
)
def test_a_file_with_a_task_alone_is_checked(
    text: str, code: int, said: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "task.yaml"
    path.write_text(text, encoding="utf-8")
    assert main(["check", str(path)]) == code
    shown = capsys.readouterr().out
    assert all(word in shown for word in said), shown


def test_the_task_of_the_gallery_is_checked_listed_and_solved(capsys: pytest.CaptureFixture[str]) -> None:
    """The least sum of squares of the published case, 2.7108919e-7 m²."""
    name = "path_of_five_points"
    assert main(["check", f"gallery:{name}"]) == 0
    assert main(["gallery", "list", "path"]) == 0 and main(["gallery", "show", name]) == 0
    assert name in capsys.readouterr().out
    assert main(["synthesize", f"gallery:{name}", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["candidates"][0]["error"] == pytest.approx(2.7108919e-7, rel=1e-7)


def test_a_demand_of_the_wrong_form_is_said_in_chinese(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "task.yaml"
    path.write_text(TASK.replace("4\n", "[1, 2]\n").replace("40 mm", "{a: 1}"), encoding="utf-8")
    assert main(["check", str(path), "--lang", "zh"]) == 1
    said = capsys.readouterr().out
    assert "列表" in said and "映射" in said and "list" not in said and "mapping" not in said


def test_a_task_without_a_machine_is_sent_to_the_right_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:path_of_five_points"]) == 1
    (said,) = capsys.readouterr().err.splitlines()
    assert said.endswith(
        "the file holds a task of synthesis and no machine; linkwright synthesize finds machines for it"
    )


def test_what_is_met_but_for_rounding_has_no_error(capsys: pytest.CaptureFixture[str]) -> None:
    """Three points are met exactly; 8e-35 m² was shown."""
    assert main(["synthesize", "path", "points=[[20, 20], [20, 30], [20, 40]]", "unit=mm"]) == 0
    out = capsys.readouterr().out
    assert "crank-rocker      0      0  none" in out and "e-" not in out
