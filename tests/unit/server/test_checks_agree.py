"""The library, the command ``check`` and the studio find the same in the same file, good or damaged."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tests import store
from tests.cli.commands import data
from tests.course_sheets import FOUR_BAR

import linkwright as lw
from linkwright import gallery
from linkwright.cli import main
from linkwright.server.files import Files
from linkwright.server.unfinished import unfinished
from linkwright.server.work import Work, solved
from linkwright.words import LANGUAGES

BAR = FOUR_BAR.partition("course:")[0]
BEAM = gallery.content("cantilever").decode().partition("report:")[0]
#: Sections behind a four-bar, with the key at which each is wrong; good ones with none.
SECTIONS = {
    "course: {tolerance: 2 %, vary: {crank.length: 8 %}}": "",
    "course: {tolerance: nan %, vari: {}}": "course.tolerance",
    "course: {ask: [nope]}": "course.ask.0",
    "optimize: {vary: {coupler.length: [3 m, 4 m]}, maximize: transmission_angle}": "",
    "optimize: {vary: {coupler.length: [3 m]}, maximise: transmission_angle}": "optimize.vary.coupler.length",
    "optimize: {vary: {coupler.length: 3..4 m}, minimize: nonsense}": "optimize",
    "report: {title: Four-bar, sections: [task, {title: Own, text: Words}]}": "",
    "report: {titel: Four-bar, sections: [tusk], errata: [{where: p. 3}]}": "report.titel",
    "report: {zh: {text: {no_chapter: x}}, positions: 1, fluctuation: 2}": "report.positions",
    "sheet: {size: A2, positions: [60 deg]}": "",
    "sheet: {size: A7, positions: [60 mm], panels: {}}": "sheet.size",
    "synthesis: {task: slider_crank, stroke: 30 mm, time_ratio: 1.2}": "",
    "synthesis: {task: slider_crank, strok: 30 mm}": "synthesis.strok",
    "synthesis: {task: nope}\noptimize: {vari: {}, minimize: 3}": "optimize.vari",
    "loads: {push: {kind: torque, on: rocker, torque: 1 N·m, phase: {of: crank, from: min, to: max}}}": "loads.push",
}
#: Whole files.
FILES = {
    "format: 1\nsynthesis: {task: slider_crank, stroke: 30 mm}\nreprot: {}\n": "reprot",
    "format: 1\nsynthesis: [1]\n": "synthesis",
    "format: 1\nsynthesis: {task: slider_crank, stroke: 30 mm}\nreport: {titel: x}\n": "report.titel",
    "format: 1\nname: [1]\nsynthesis: {task: slider_crank, stroke: 30 mm}\n": "name",
    BEAM: "",
    BEAM.replace("length: ", "length: 3 kg #"): "length",
    BEAM + "report: {titel: Beam, positions: 1}\n": "report.titel",
    BEAM.replace("length: ", "length: 3 kg #") + "report: {titel: Beam}\n": "report.titel",
    BAR.replace("length", "lenght", 1): "",
    BAR.replace("length", "lenght", 1) + "course: {vari: {}}\nreport: {cover: {logo: no.png}}\n": "course.vari",
    BAR + "a: [\n": "",
    "": "",
}


@pytest.mark.parametrize(
    ("text", "key"), [*((f"{BAR}\n{each}\n", key) for each, key in SECTIONS.items()), *FILES.items()]
)
def test_every_way_finds_the_same(text: str, key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    found = lw.check(path)
    keys = [each.key for each in found if each.severity == "error"]
    assert any(each.startswith(key) for each in keys) if key else True
    main(["check", "--json", str(path)])
    (told,) = json.loads(capsys.readouterr().out)["files"]
    assert [(each["key"], each["code"], each["where"]) for each in told["findings"]] == [
        (each.key, each.code, each.where) for each in found
    ]
    found = [each for each in found if not unfinished(each.code, each.key)]
    for language in LANGUAGES:
        shown = solved(text, language, str(tmp_path))["findings"]
        assert [(each["key"], each["code"]) for each in shown] == [(each.key, each.code) for each in found]
        own = [each.translate(language) for each in found]
        assert all(each["sentence"] in said for each, said in zip(shown, own, strict=True)), own
        assert [each["line"] for each in shown] == [_line(each) for each in found]


def _line(found: lw.Finding) -> int:
    place = found.where.removesuffix("machine.yaml").rsplit("machine.yaml:", 1)
    return int(place[1].split(":")[0]) if len(place) == 2 else 0


def test_a_section_is_read_whatever_is_wrong_with_the_others() -> None:
    """Every finding at once, each at the column of its key."""
    text = f"{BAR.replace('length', 'lenght', 1)}\nreport: {{titel: x}}\noptimize: {{vari: {{}}, seed: x}}\n"
    found = {each["key"]: each["line"] for each in solved(text, "en")["findings"]}
    last = text.count("\n")
    assert {key: last - line for key, line in found.items() if not key.startswith("links")} == {
        "report.titel": 1,
        "optimize.vari": 0,
        "optimize.seed": 0,
    }


@pytest.mark.parametrize("section", ["optimize", "course", "report", "sheet", "synthesis"])
def test_nobody_is_told_more_than_300_findings(section: str, tmp_path: Path) -> None:
    """Three hundred keys that no section has ended in an error of the program."""
    more = "".join(f"  k{number}: 1\n" for number in range(400))
    task = "  task: path\n" if section == "synthesis" else ""
    path = tmp_path / "many.yaml"
    path.write_text(f"{BAR}\n{section}:\n{task}{more}", encoding="utf-8")
    codes = [each.code for each in lw.check(path)]
    assert codes.count("unknown-demand" if task else "unknown-key") == 300 and codes.count("many") == 1


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "printing_press", "crank_rocker"])
def test_the_same_is_found_in_the_gallery(name: str) -> None:
    found = solved(store.text(name), "en")["findings"]
    assert [each["code"] for each in found] == [each.code for each in lw.check(f"gallery:{name}")]


@pytest.mark.parametrize(
    ("section", "command"),
    [
        ("report: {title: , titel: x, zh: {sections: [tusk]}}", ["report", "--output", "bar.html"]),
        ("course: {ask: [nope], at: , vari: {}}", ["variants"]),
        ("sheet: {size: A7}", ["sheet"]),
        ("optimize: {vari: {}, minimize: travel, seed: x}", ["optimize"]),
    ],
)
def test_commands_find_the_same_at_the_same_places(
    section: str, command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bar.yaml").write_text(f"{BAR}\n{section}\n", encoding="utf-8")
    found = {(each.where, each.key, each.code) for each in lw.check("bar.yaml") if each.severity == "error"}
    told = data(command[0], "bar.yaml", *command[1:], code=1)["findings"]
    assert found == {(each["where"], each["key"], each["code"]) for each in told}
    assert all(each["where"].count(":") == 2 for each in told)


def test_files_that_a_model_names_lie_beside_it(tmp_path: Path) -> None:
    """The studio looked for them in its own folder, where a model lies in one below."""
    folder = tmp_path / "presses"
    folder.mkdir()
    (folder / "logo.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>', "utf-8")
    text = f"{BAR}\nreport: {{cover: {{logo: logo.svg}}}}\n"
    (folder / "bar.yaml").write_text(text, encoding="utf-8")
    assert lw.check(folder / "bar.yaml") == []
    solve = Work(Files(tmp_path)).answers["solve"]
    assert solve({"text": text, "name": "presses/bar.yaml"})["findings"] == []
    assert [each["code"] for each in solve({"text": text})["findings"]] == ["wrong-picture"]
