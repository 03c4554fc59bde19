"""``linkwright check``, ``structure`` and ``gallery``."""

from pathlib import Path

import pytest
from tests import store
from tests.cli.commands import data, finding_codes, is_refused, run, shown
from tests.cli.tables import numbers
from tests.every import every

from linkwright import gallery
from linkwright.cli import main

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


def test_check_of_good_models() -> None:
    models = ["jaw_crusher_sixbar", "slider_crank_inline", "jaw_crusher_sixbar_as_reported"]
    asked = ["check", *(f"gallery:{name}" for name in models)]
    for line, name, links in zip(shown(*asked).splitlines(), models, (5, 3, 5), strict=True):
        assert line.startswith(f"gallery:{name}: ")
        assert numbers(line) == [links, 1]
    files = data(*asked)["files"]
    assert [(each["ok"], each["links"], each["mobility"], each["findings"]) for each in files] == [
        (True, 5, 1, []),
        (True, 3, 1, []),
        (True, 5, 1, []),
    ]


def test_check_lists_findings_of_every_file(tmp_path: Path) -> None:
    wrong, loose = tmp_path / "wrong.yaml", tmp_path / "loose.yaml"
    wrong.write_text(WRONG)
    loose.write_text(LOOSE)
    printed = shown("check", str(wrong), str(loose), code=1)
    first, second = data("check", str(wrong), str(loose), code=1)["files"]
    assert not first["ok"] and not second["ok"]
    slip = first["findings"][0]
    assert (slip["key"], slip["code"]) == ("links.crank.lenght", "unknown-key")
    assert slip["where"].startswith("wrong.yaml:6:") and '"length"' in slip["remedy"]
    (free,) = second["findings"]
    assert (free["code"], free["where"]) == ("mobility.free_idle", str(loose)) and "'loose'" in free["message"]
    for each in [*first["findings"], *second["findings"]]:
        assert f"{each['where']}: " in printed and each["message"] in printed


ROLLER = """
  roller: {points: {HUB: [0 mm, 0 mm], RIM: [10 mm, 0 mm]}}
"""


@pytest.mark.parametrize(("hub", "idle"), [("B", True), ("O", False)])
def test_check_tells_a_local_freedom(hub: str, idle: bool, tmp_path: Path) -> None:
    """A wheel that is pinned to a moving link alone is an idle freedom; one on the frame may lack a driver."""
    text = store.text("slider_crank_inline")
    model = tmp_path / "roller.yaml"
    model.write_text(text.replace("links:\n", f"links:{ROLLER.replace('HUB', hub).rstrip()}\n"))
    code = "mobility.free_idle" if idle else "mobility.free"
    is_refused(["solve", str(model)], code, ends=1, links={"'roller'"})
    assert finding_codes("check", str(model)) == [("", code)]


def test_check_names_the_place_of_every_assembly_word(tmp_path: Path) -> None:
    text = store.text("slider_crank_inline").replace("assembly: {B: forward}\n", "")
    path = tmp_path / "words.yaml"
    path.write_text(text + "assembly:\n  B: left\n  A: forward\n")
    (file,) = data("check", str(path), code=1)["files"]
    last = len(text.splitlines())
    assert [(each["where"], each["key"], each["code"]) for each in file["findings"]] == [
        (f"words.yaml:{last + 2}:6", "", "motion.no_mode"),
        (f"words.yaml:{last + 3}:6", "", "motion.not_inner"),
    ]
    assert [each["message"].split(": ")[0] for each in file["findings"]] == ["assembly.B", "assembly.A"]


def test_check_of_a_missing_file_is_wrong_usage(tmp_path: Path) -> None:
    assert run("check", str(tmp_path / "nothing.yaml")).code == 2


def test_structure_of_the_crusher() -> None:
    printed = shown("structure", "gallery:jaw_crusher_sixbar")
    assert "3·5 - 2·7 = 1" in printed
    assert "RRR(pitman, rocker) + RRR(toggle, jaw)" in printed
    found = data("structure", "gallery:jaw_crusher_sixbar")
    assert found["mobility"] == 1 and [group["signature"] for group in found["groups"]] == ["R", "RRR", "RRR"]


def test_structure_of_a_wrong_model(tmp_path: Path) -> None:
    path = tmp_path / "loose.yaml"
    path.write_text(LOOSE)
    is_refused(["structure", str(path)], "mobility.free_idle", ends=1, mobility=2, links={"'loose'"})


@pytest.mark.parametrize("forces", [[], ["--forces"]])
def test_program_counts_are_those_of_its_lines(forces: list[str]) -> None:
    program = data("structure", "gallery:jaw_crusher_sixbar", "--program", *forces)["program"]
    counted = sum(sum(level.values()) for level in program["operations"].values())
    computed = [line for line in program["lines"] if line.startswith("v") and _computes(line.split(" = ")[1])]
    assert counted == len(computed)
    if not forces:
        assert program["operations"]["position"]["sqrt"] == 2  # one root per dyad
    assert any("output effort:" in line for line in program["lines"]) == bool(forces)


def _computes(right: str) -> bool:
    return "(" in right or len(right.split()) == 3


def test_gallery_lists_every_model_with_its_title() -> None:
    entries = data("gallery", "list")
    assert [entry["name"] for entry in entries] == [*gallery.names(), *gallery.calculations(), *gallery.tasks()]
    assert all(entry["title"] and entry["purpose"] for entry in every(entries, least=50))
    assert "jaw_crusher_sixbar " in shown("gallery", "list", "crusher")


def test_gallery_shows_a_file_that_can_be_used(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(shown("gallery", "show", "kite"), encoding="utf-8")
    assert main(["check", str(path)]) == 0


def test_gallery_copies_once(tmp_path: Path) -> None:
    asked = ["gallery", "copy", "gallery:kite", str(tmp_path)]
    assert main(asked) == 0
    copy = tmp_path / "kite.yaml"
    assert copy.read_bytes() == gallery.file("kite").read_bytes()
    is_refused(asked, "file.exists", path=copy)
    assert main([*asked, "--force"]) == 0
    nowhere = tmp_path / "nowhere"
    is_refused(["gallery", "copy", "kite", str(nowhere)], "file.no_folder", path=nowhere)


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
    told: str, open_groups: list[str], tmp_path: Path
) -> None:
    path = tmp_path / "model.yaml"
    path.write_text(HALF_DRAWN + told + "\n", encoding="utf-8")
    (file,) = data("check", str(path))["files"]
    noted = [each["message"] + each["remedy"] for each in file["findings"] if each["code"] == "assembly"]
    assert [next(joint for joint in "BC" if f"{{{joint}: left}}" in text) for text in noted] == open_groups
