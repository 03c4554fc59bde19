"""``linkwright check``, ``structure`` and ``gallery``."""

import json
from pathlib import Path

import pytest

from linkwright import gallery
from linkwright.cli import main
from linkwright.files.model_file import read_document

WRONG = """\
format: 1
name: Wrong
frame:
  points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}
links:
  crank: {points: [O1, A], lenght: 1 m}
"""
LOOSE = """\
format: 1
name: Loose
frame:
  points: {O1: [0 m, 0 m]}
links:
  crank: {points: [O1, A], length: 1 m}
  loose: {points: [A, B], length: 1 m}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""


def test_check_of_good_models(capsys: pytest.CaptureFixture[str]) -> None:
    models = ["jaw_crusher_sixbar", "slider_crank_inline", "jaw_crusher_sixbar_as_reported"]
    assert main(["check", *(f"gallery:{name}" for name in models)]) == 0
    shown = capsys.readouterr().out
    assert "gallery:jaw_crusher_sixbar: fine (5 moving links, mobility 1)" in shown
    assert "gallery:slider_crank_inline: fine (3 moving links, mobility 1)" in shown


def test_check_lists_findings_of_every_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong, loose = tmp_path / "wrong.yaml", tmp_path / "loose.yaml"
    wrong.write_text(WRONG)
    loose.write_text(LOOSE)
    assert main(["check", str(wrong), str(loose)]) == 1
    shown = capsys.readouterr().out
    assert "wrong.yaml:6:" in shown and 'did you mean "length"?' in shown
    assert "nothing determines the motion of 'loose'" in shown
    assert main(["check", str(wrong), str(loose), "--json"]) == 1
    files = json.loads(capsys.readouterr().out)["files"]
    assert [entry["ok"] for entry in files] == [False, False]
    assert files[0]["findings"][0]["where"].startswith("wrong.yaml:6:")


ROLLER = """
  roller: {points: {HUB: [0 mm, 0 mm], RIM: [10 mm, 0 mm]}}
"""


@pytest.mark.parametrize(("hub", "idle"), [("B", True), ("O", False)])
def test_check_tells_a_local_freedom(
    hub: str, idle: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A wheel that is pinned to a moving link alone is an idle freedom; one on the frame may lack a driver."""
    text = read_document("gallery:slider_crank_inline").text
    model = tmp_path / "roller.yaml"
    model.write_text(text.replace("links:\n", f"links:{ROLLER.replace('HUB', hub).rstrip()}\n"))
    assert main(["check", str(model)]) == 1
    shown = capsys.readouterr().out
    assert "nothing determines the motion of 'roller'" in shown
    assert ("a local freedom" in shown) is idle


def test_check_names_the_place_of_every_assembly_word(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = read_document("gallery:slider_crank_inline").text.replace("assembly: {B: forward}\n", "")
    path = tmp_path / "words.yaml"
    path.write_text(text + "assembly:\n  B: left\n  A: forward\n")
    assert main(["check", str(path)]) == 1
    shown, last = capsys.readouterr().out.splitlines(), len(text.splitlines())
    assert shown[0].startswith(f"words.yaml:{last + 2}:6: assembly.B: 'left' is no assembly mode")
    assert shown[1].startswith(f"words.yaml:{last + 3}:6: assembly.A: this is not the inner joint")


def test_check_of_a_missing_file_is_wrong_usage(tmp_path: Path) -> None:
    assert main(["check", str(tmp_path / "nothing.yaml")]) == 2


def test_structure_of_the_crusher(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["structure", "gallery:jaw_crusher_sixbar"]) == 0
    shown = capsys.readouterr().out
    assert "Mobility F = 3n - 2p = 3·5 - 2·7 = 1" in shown
    assert "RRR(pitman, rocker) + RRR(toggle, jaw)" in shown
    assert main(["structure", "gallery:jaw_crusher_sixbar", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["mobility"] == 1 and [group["signature"] for group in data["groups"]] == ["R", "RRR", "RRR"]


def test_structure_of_a_wrong_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "loose.yaml"
    path.write_text(LOOSE)
    assert main(["structure", str(path)]) == 1
    assert "nothing determines" in capsys.readouterr().err


@pytest.mark.parametrize("forces", [[], ["--forces"]])
def test_program_counts_are_those_of_its_lines(forces: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["structure", "gallery:jaw_crusher_sixbar", "--program", "--json", *forces]) == 0
    program = json.loads(capsys.readouterr().out)["program"]
    counted = sum(sum(level.values()) for level in program["operations"].values())
    computed = [line for line in program["lines"] if line.startswith("v") and _computes(line.split(" = ")[1])]
    assert counted == len(computed)
    if not forces:
        assert program["operations"]["position"]["sqrt"] == 2  # one root per dyad
    assert any("output effort:" in line for line in program["lines"]) == bool(forces)


def _computes(right: str) -> bool:
    return "(" in right or len(right.split()) == 3


def test_gallery_lists_every_model_with_its_title(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["gallery", "list", "--json"]) == 0
    entries = json.loads(capsys.readouterr().out)
    assert [entry["name"] for entry in entries] == [
        *gallery.names(),
        *gallery.calculations(),
        *gallery.tasks(),
    ]
    assert all(entry["title"] and entry["purpose"] for entry in entries)
    assert main(["gallery", "list", "crusher"]) == 0
    assert "jaw_crusher_sixbar " in capsys.readouterr().out


def test_gallery_shows_a_file_that_can_be_used(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["gallery", "show", "kite"]) == 0
    path = tmp_path / "mine.yaml"
    path.write_text(capsys.readouterr().out, encoding="utf-8")
    assert main(["check", str(path)]) == 0


def test_gallery_copies_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["gallery", "copy", "gallery:kite", str(tmp_path)]
    assert main(asked) == 0
    copy = tmp_path / "kite.yaml"
    assert copy.read_bytes() == gallery.file("kite").read_bytes()
    assert main(asked) == 2
    assert "exists" in capsys.readouterr().err
    assert main([*asked, "--force"]) == 0
    assert main(["gallery", "copy", "kite", str(tmp_path / "nowhere")]) == 2


HALF_DRAWN = """\
format: 1
name: Two dyads
frame: {points: {O: [0 m, 0 m], P: [1 m, 0 m], Q: [2 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.3 m}
  coupler: {points: [A, B], length: 0.9 m}
  rocker: {points: [P, B], length: 0.7 m}
  rod: {points: [B, C], length: 1.2 m}
  lever: {points: [Q, C], length: 0.7 m}
driver: {turn: crank, about: O, speed: 60 rpm}
"""


@pytest.mark.parametrize(
    ("told", "open_groups"),
    [
        ("", ["B", "C"]),
        ("drawing: {A: [0.3 m, 0 m]}", ["B", "C"]),
        ("drawing: {B: [0.9 m, 0.7 m]}", ["C"]),
        ("drawing: {C: [1.8 m, 0.7 m]}\nassembly: {B: left}", []),
    ],
)
def test_dyads_of_which_nothing_tells_the_assembly_are_noted(
    told: str, open_groups: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "model.yaml"
    path.write_text(HALF_DRAWN + told + "\n", encoding="utf-8")
    assert main(["check", str(path), "--json"]) == 0
    (file,) = json.loads(capsys.readouterr().out)["files"]
    noted = [each["message"] + each["remedy"] for each in file["findings"] if each["code"] == "assembly"]
    assert [next(joint for joint in "BC" if f"{{{joint}: left}}" in text) for text in noted] == open_groups
