"""The command optimize."""

import json
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.cli import main

SEARCH = [
    "optimize", "gallery:jaw_crusher_sixbar", "--vary", "pitman.length=1.15..1.35m", "crank.length=80..120mm",
    "--keep", "jaw.angle range=same within 1 %", "--evaluations", "200",
]  # fmt: skip


def test_the_better_machine_is_shown_and_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, picture = tmp_path / "better.yaml", tmp_path / "search.svg"
    words = ["--minimize", "peak_input_torque", "--output", str(file), "--plot", str(picture)]
    assert main([*SEARCH, *words]) == 0
    out = capsys.readouterr().out
    assert "least peak input torque" in out and "1633.67 N·m" in out and "made least" in out
    assert lw.load(file).dimension("crank.length") < 0.1
    assert "# a pin is implied" in file.read_text()
    assert picture.read_text().startswith("<?xml")
    assert main([*SEARCH, *words]) == 2


def test_tolerances_are_asked_for_in_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--define", "r=crank.length", "--minimize", "r", "--tolerance", "crank.length=0.5mm", "--robust"]
    assert main([*SEARCH, *words, "worst", "--json"]) == 0
    best = json.loads(capsys.readouterr().out)["designs"][0]
    assert best["worst"]["r"] == pytest.approx([best["values"]["crank.length"] + 5e-4])
    assert len(best["worst"]["jaw.angle range"]) == 2
    assert main([*SEARCH, *words, "yield", "--yield", "0.5"]) == 0
    assert "% of the machines made" in capsys.readouterr().out
    assert main([*SEARCH, *words, "often"]) == 1


def test_data_of_a_front(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SEARCH, "--minimize", "peak_input_torque", "flywheel", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["ok"] and 0 < found["hypervolume"] <= 1
    assert {"values", "numbers", "missed", "made"} <= set(found["designs"][0])


def test_what_cannot_be_met_and_misuse(capsys: pytest.CaptureFixture[str]) -> None:
    demand = ["--minimize", "flywheel", "--lang", "zh"]
    assert (
        main([*SEARCH[:5], "--keep", "jaw.angle range=at least 9 deg", "--evaluations", "60", *demand]) == 1
    )
    told = capsys.readouterr()
    assert "不能同时满足" in told.err and "不满足" in told.out
    assert main([*SEARCH, "--minimize", "flywheel", "--keep", "jaw"]) == 2
    assert main(["optimize", "gallery:jaw_crusher_sixbar"]) == 2
    assert (
        main([*SEARCH, "--minimize", "flywheel", "--vary", "crank.length=1..2m", "crank.length=2..3m"]) == 2
    )
    assert "crank.length is given twice" in capsys.readouterr().err


def test_an_interruption_before_the_first_population_leaves_a_file_to_go_on_from(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    asked = [*SEARCH, "--minimize", "flywheel", "--evaluations", "100"]
    with monkeypatch.context() as patched:
        patched.setattr("linkwright.optimisation.optimize.Task", stop)  # before anything has been measured
        assert main(asked) == 130
        (left,) = tmp_path.iterdir()
        assert f"--state {left.name}" in capsys.readouterr().err
        kept = left.read_bytes()
        assert main([*asked, "--state", left.name, "--lang", "zh"]) == 130
        assert left.name in capsys.readouterr().err
        assert left.read_bytes() == kept  # a file that is there already stays
        patched.setattr("linkwright.optimisation.optimize.read_document", stop)
        assert main(asked) == 130
        assert "Nothing new had been computed" in capsys.readouterr().err
    assert main([*asked, "--json"]) == 0
    whole = capsys.readouterr().out
    assert main([*asked, "--json", "--state", left.name]) == 0
    assert capsys.readouterr().out == whole


PRESS = """
format: 1
name: Press
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 60 mm}
  rod: {points: [A, B], length: 260 mm, mass: 2 kg, inertia: 0.02 kg·m²}
  ram: {points: [B], mass: 30 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: ram, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
optimize:
  vary:
    rod.length: 200..300 mm
  minimize: peak_reaction B
  keep:
    transmission_angle: at least 60 deg
"""
MISTAKES = [
    ("rod.length: 200", "rod.lenght: 200", "13:17: optimize.vary.rod.lenght: ", 'did you mean "rod.length"?'),
    ("200..300 mm", "200-300 mm", "13:17: optimize.vary.rod.length: ", "write 200..300 mm"),
    ("200..300 mm", "200 mm ~ 300 mm", "13:17: optimize.vary.rod.length: ", "write 200 mm..300 mm"),
    (
        "at least 60 deg",
        "at least 60",
        "16:25: optimize.keep.transmission_angle: ",
        "write its unit, as in 60 deg",
    ),
    ("at least 60 deg", "more than 60 deg", "16:25: optimize.keep.transmission_angle: ", "at least 40 deg"),
    ("at least 60 deg", "> 60 deg", "16:27: ", "at least 30 deg"),
    ("peak_reaction B", "peak_raction B", "12:3: optimize: ", 'did you mean "peak_reaction"?'),
    ("minimize", "minimise", "14:13: optimize.minimise: ", 'did you mean "minimize"?'),
]


@pytest.mark.parametrize(("right", "wrong", "place", "remedy"), MISTAKES)
def test_mistakes_in_the_section_are_found_at_their_lines(
    right: str, wrong: str, place: str, remedy: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "press.yaml"
    assert right in PRESS
    file.write_text(PRESS.replace(right, wrong).lstrip(), encoding="utf-8")
    assert main(["check", str(file)]) == 1
    told = capsys.readouterr().out
    assert f"press.yaml:{place}" in told and remedy in told


def test_what_the_command_asks_has_no_line_and_the_section_keeps_its(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "press.yaml"
    file.write_text(PRESS.lstrip().replace("at least 60 deg", "at least 60"), encoding="utf-8")
    assert main(["optimize", str(file)]) == 1
    assert "press.yaml:16:25: optimize.keep" in capsys.readouterr().err
    assert main(["optimize", str(file), "--vary", "rod.lenght=200..300mm"]) == 1
    told = capsys.readouterr().err
    assert "press.yaml: optimize.vary.rod.lenght: " in told
    file.write_text(PRESS.lstrip(), encoding="utf-8")
    assert main(["check", str(file)]) == 0
