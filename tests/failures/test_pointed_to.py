"""What is asked for under another name, in another form, or together with what does not apply: pointed to what is
meant, and the rest is not lost."""

import json
import math
import re
from pathlib import Path

import pytest
from tests import store
from tests.refusals import checked, findings, refused, said

import linkwright as lw
from linkwright import gallery, parts
from linkwright.cli import main

FOUR_BAR = """\
format: 1
name: four-bar
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m, mass: 1 kg, inertia: 1 kg·m²}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rpm}
"""
Captured = pytest.CaptureFixture[str]


@pytest.mark.parametrize(
    ("section", "kind", "meant"),
    [
        ("loads", "gas_spring", "spring"),
        ("loads", "气弹簧", "spring"),
        ("loads", "cylinder", "pressure"),
        ("joints", "cylinder", "prismatic"),
        ("joints", "hydraulic_cylinder", "prismatic"),
    ],
)
def test_a_part_by_its_usual_name_is_pointed_to_its_kind(section: str, kind: str, meant: str) -> None:
    told = findings(f"{FOUR_BAR}{section}:\n  x: {{kind: {kind}, between: [rocker.B, frame.O1]}}\n")
    said(told, "unknown-word", f"{section}.x.kind", text=kind, offer=meant)
    assert not [each for each in told if each.code == "misplaced"]


def test_a_table_of_lifts_is_pointed_to_the_program_of_a_cam() -> None:
    text = gallery.content("cam_lecture").decode()
    assert text.count("\nprogram:") == 1
    with pytest.raises(lw.ModelError) as caught:
        parts.loads(text.replace("\nprogram:", "\nlifts:"))
    said(caught.value.findings, "unknown-key", "lifts", offer="program")


@pytest.mark.parametrize("option", ["--times", "--at"])
def test_values_that_are_words_of_their_own_are_one_list(option: str, capsys: Captured) -> None:
    values = ["0 s", "5 s"] if option == "--times" else ["10 deg", "20 deg"]
    assert main(["solve", "gallery:crank_rocker", option, *values, "--json"]) == 0
    apart = json.loads(capsys.readouterr().out)
    assert main(["solve", option, ", ".join(values), "gallery:crank_rocker", "--json"]) == 0
    assert apart["columns"] == json.loads(capsys.readouterr().out)["columns"] and apart["positions"] == 2


def test_a_demand_of_another_task_is_told_with_all_demands(capsys: Captured) -> None:
    assert main(["synthesize", "slider_crank", "stroke=0.3 m", "link_ratio=3"]) != 0
    told = capsys.readouterr().err
    assert all(name in told for name in ("link_ratio", "offset_ratio", "quick_return_ratio"))


def test_numbers_that_apply_are_shown_beside_one_that_does_not(capsys: Captured) -> None:
    names = ["--names", "stroke", "swing_angle", "peak_reaction"]
    assert main(["metrics", "gallery:crank_rocker", *names]) == 2
    shown = capsys.readouterr()
    assert "rocker" in shown.out and all(name in shown.err for name in ('"stroke"', "peak_reaction"))
    assert main(["metrics", "gallery:crank_rocker", *names, "--json"]) == 2
    data = json.loads(capsys.readouterr().out)
    assert not data["ok"] and [each["metric"] for each in data["metrics"]] == ["swing_angle"]
    assert main(["metrics", "gallery:crank_rocker", "--names", "stroke"]) == 2
    assert "rocker" not in capsys.readouterr().out


def test_a_text_for_a_number_is_told_with_the_number() -> None:
    machine = store.machine("crank_rocker")
    for given in (["200 deg"], "200 deg"):
        with refused("motion.text_for_number", text="200 deg", right=f"{math.radians(200):.6g}"):
            lw.solve_motion(machine, at=given)  # type: ignore[arg-type]


def test_units_of_different_dimensions_make_no_range() -> None:
    machine = store.machine("crank_rocker")
    for text, first, second in (("1 m..2 kg", "m", "kg"), ("1 m, 2 kg", "m", "kg"), ("1 deg..2 m", "deg", "m")):
        with refused("study.units_differ", address="crank.length", text=text, first=first, second=second):
            lw.study(machine, {"crank.length": text})


SECTIONS = {
    "report: {position: [60 deg, 999 furlong]}": "report.position",
    "report: {position: 60 furlong}": "report.position",
    "report: {zh: {position: 60 mm}}": "report.zh.position",
    "report: {title: {de: a}}": "report.title",
    "report: {positions: [2]}": "report.positions",
    "report: {fluctuation: {a: b}}": "report.fluctuation",
    "report: {sections: [task, tsak]}": "report.sections.1",
    "report: {text: {tsak: x}}": "report.text.tsak",
    "report: {numbered_from: roker min}": "report.numbered_from",
    "report: {numbered_from: rocker middle}": "report.numbered_from",
    "report: {errata: [{where: a}]}": "report.errata.0.printed",
    "course: {at: [1, 2]}": "course.at",
    "course: {at: 5 m}": "course.at",
    "course: {vary: {crank.length: [1 kg, 2 m]}}": "course.vary.crank.length",
    "course: {vary: {crank.lenth: 8 %}}": "course.vary.crank.lenth",
    "course: {vary: {crank.length: {a: b}}}": "course.vary.crank.length",
    "course: {ask: [rocker.angle, nope]}": "course.ask.1",
    "course: {tolerance: [1]}": "course.tolerance",
    "optimize: {vary: {crank.length: [1 m, 2 kg]}, maximize: transmission_angle}": "optimize.vary.crank.length",
    "optimize: {vary: {crank.length: {a: 1}}, maximize: transmission_angle}": "optimize.vary.crank.length.a",
    "optimize: {vary: {crank.length: [1 m, 2 m]}, maximize: transmission_angel}": "optimize",
    "optimize: {vary: {crank.length: [1 m, 2 m]}, maximize: transmission_angle, steps: [3]}": "optimize.steps",
    "synthesis: {task: slider_crank, strok: 3 m}": "synthesis.strok",
    "synthesis: {task: slider_crank, stroke: [3 m, 4]}": "synthesis.stroke",
}


@pytest.mark.parametrize(("section", "key"), SECTIONS.items(), ids=list(SECTIONS))
def test_what_a_section_cannot_be_is_told_when_the_file_is_checked(section: str, key: str, tmp_path: Path) -> None:
    """At its line, and without a list or a mapping as Python writes them."""
    path = tmp_path / "m.yaml"
    path.write_text(f"{FOUR_BAR}{section}\n", encoding="utf-8")
    code, found = checked(path)
    assert code == 1
    told = [each for each in found if each.key == key]
    assert told and all(each.where.startswith("m.yaml:10:") for each in told), found
    assert not re.search(r"\['|\{'", "".join(each.message + each.remedy for each in found))


def test_all_that_is_wrong_with_the_sections_is_told_at_once(tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    text = "report: {position: 60 furlong, positions: 1, title: [a]}\ncourse: {at: 5 m, tolerance: nan, foo: 1}\n"
    path.write_text(FOUR_BAR + text, encoding="utf-8")
    code, found = checked(path)
    keys = {"report.position", "report.positions", "report.title", "course.at", "course.tolerance", "course.foo"}
    assert code == 1 and keys <= {each.key for each in found}
