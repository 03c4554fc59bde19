"""From a drawing to exercises to grades: machines whose sizes all follow from where their points were drawn."""

import cmath
import csv
import json
import math
from pathlib import Path

import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.cli import main

LEG = """\
format: 1
name: leg
frame: {points: {O1: [40 mm, 160 mm], O2: [-80 mm, 140 mm]}}
drawing:
  A: [80 mm, 160 mm]
  B: [-40 mm, 240 mm]
  C: [-180 mm, 180 mm]
  D: [-40 mm, 20 mm]
  E: [-140 mm, 80 mm]
  F: [-100 mm, -120 mm]
links:
  arm1: {points: [O1, A]}
  bar1: {points: [A, B]}
  arm2: {points: [O2, B, C]}
  bar2: {points: [A, D]}
  arm3: {points: [O2, D]}
  bar3: {points: [C, E]}
  bar4: {points: [D, E, F]}
driver: {turn: arm1, about: O1, speed: 30 rpm}
"""
FOUR_BAR = """\
format: 1
name: four-bar
frame: {points: {O1: [-140 mm, -120 mm], O2: [294.3 mm, -94.27 mm]}}
drawing: {A: [-80 mm, -20 mm], B: [255.410009 mm, 182.3092085 mm]}
links:
  arm1: {points: [O1, A]}
  bar1: {points: [A, B]}
  arm2: {points: [B, O2]}
driver: {turn: arm1, about: O1, speed: 60 rpm}
"""
SLIDER = """\
format: 1
name: slider
frame: {points: {O1: [-300 mm, 40 mm], G1: [100 mm, 40 mm]}}
drawing: {A: [-240 mm, 140 mm], B: [100 mm, 40 mm]}
links:
  arm1: {points: [O1, A]}
  bar1: {points: [A, B]}
  slider1: {points: [B]}
joints:
  guide1: {kind: prismatic, guide: frame, through: G1, direction: 0 deg, block: slider1, at: B}
driver: {turn: arm1, about: O1, speed: 60 rpm}
loads:
  load2: {kind: force, on: slider1, at: B, opposes: velocity, magnitude: 250 N}
"""


@pytest.mark.parametrize("text", [LEG, FOUR_BAR, SLIDER], ids=["leg", "four-bar", "slider"])
def test_a_drawing_gives_exercises_and_their_sheets_grades(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("drawn.yaml").write_text(text, encoding="utf-8")
    assert main(["check", "drawn.yaml"]) == 0
    assert main(["variants", "drawn.yaml", "--count", "4", "--to", "key", "--output", "set"]) == 0
    key = json.loads(Path("set/key.json").read_text("utf-8"))
    names = [each["name"] for each in key["questions"]]
    assert len(key["variants"]) == 4 and names
    assert len({json.dumps(each["answers"]) for each in key["variants"]}) == 4
    rows = [["student", "variant", *names]]
    rows += [[f"S{each['number']}", each["number"], *each["answers"]] for each in key["variants"]]
    rows[2][2] = "twelve"
    rows[3][2] = float(rows[3][2]) * 1.3 + 7.0
    with Path("answers.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([*rows[:2], [], *rows[2:]])
    capsys.readouterr()
    assert main(["grade", "set/key.json", "answers.csv", "--json"]) == 1
    first, second, third, fourth = json.loads(capsys.readouterr().out)["sheets"]
    assert all(every(first["right"])) and all(every(fourth["right"]))
    assert "4" in second["fault"] and "twelve" in second["fault"] and not second["right"]
    assert third["right"][0] is False and all(third["right"][1:])
    assert main(["grade", "set/key.json", "answers.csv"]) == 1


def left_crossing(a: complex, r: float, b: complex, s: float) -> complex:
    """Where a circle of radius r about a and one of radius s about b meet, to the left of the ray from a to b."""
    d = abs(b - a)
    along = (d * d + r * r - s * s) / (2 * d)
    return a + (b - a) / d * complex(along, math.sqrt(r * r - along * along))


def test_the_answers_are_those_of_the_sizes_on_the_sheet() -> None:
    """The four-bar's angles from the crossing of two circles about A and O2, in the assembly of the drawing."""
    found = lw.variants(lw.loads(FOUR_BAR), 3)
    asked = [question.name for question in found.task.questions]
    for each in every(found.variants):
        size = each.mechanism.dimensions()
        turn = found.task.at
        a = complex(-0.14, -0.12) + size["arm1.A.x"] * complex(math.cos(turn), math.sin(turn))
        o = complex(0.2943, -0.09427)
        b = left_crossing(a, size["bar1.B.x"], o, size["arm2.O2.x"])
        answers = dict(zip(asked, each.answers, strict=True))
        off = answers["bar1.angle"] - math.degrees(cmath.phase(b - a))
        assert math.remainder(off, 360.0) == pytest.approx(0.0, abs=1e-9)
        assert {"arm1.A.x", "bar1.B.x", "arm2.O2.x"} == set(each.dimensions)
        assert all(float(f"{value:.3g}") == value for value in each.dimensions.values())


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("name", "found", "vary"),
    [
        ("parallelogram", 0, ("crank.length", "coupler.length", "rocker.length")),
        ("tangent_mechanism", 1, ("arm.length",)),
    ],
)
def test_what_stands_in_the_way_is_said(name: str, found: int, vary: tuple[str, ...]) -> None:
    """Sizes that must fit each other; sizes on which no answer depends."""
    with refused("course.too_few", found=found, count=2, tried=120, vary=vary):
        lw.variants(store.machine(name), 2)
