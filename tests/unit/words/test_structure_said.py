"""Sentences of the analysis in both languages: structure, rank of the Jacobian, outcomes, notes."""

import copy
import json
import pickle
import re
import subprocess
import sys
from math import hypot, radians
from pathlib import Path

import pytest

import linkwright as lw
from linkwright import gallery, words
from linkwright.cli import main
from linkwright.groups.base import DYADS
from linkwright.kinematics.outcome import Outcome
from linkwright.kinematics.rank import jacobian_rank, rank_from_drawing, rank_sentence
from linkwright.words.characters import cells
from linkwright.words.sentence import Sentence, in_language

CRUSHER = "gallery:jaw_crusher_sixbar"
SYMBOLS = {"F", "n", "p", "p_H", "w", "m"}
LATIN = re.compile(r"[A-Za-z]\w*")

FOURBAR = """
format: 1
name: linkage
frame: {{points: {{O1: [0 m, 0 m], O2: [4 m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: {crank} m}}
  coupler: {{points: [A, B], length: {coupler} m}}
  rocker: {{points: [O2, B], length: {rocker} m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O1, speed: 1 rad/s, start: {start} deg}}
"""

PARALLELOGRAM = FOURBAR.format(crank=1, coupler=4, rocker=1, start=20.5)

TWO_BARS = """
format: 1
name: bars
frame: {{points: {{O1: [0 m, 0 m], O2: [{span} m, 0 m]}}}}
links:
  left: {{points: [O1, A], length: 1 m}}
  right: {{points: [O2, A], length: 1 m}}
drawing: {{A: [{x} m, {y} m]}}
"""


def foreign(text: str, mechanism: lw.Mechanism) -> set[str]:
    """Latin words that are neither symbols of formulas nor names in the model nor signatures of its groups."""
    known = SYMBOLS | {*mechanism.links, *mechanism.joints, *mechanism.drivers}
    for train in lw.structure(mechanism).trains:
        known |= {train.carrier, *(f"n_{link}" for link in (train.carrier, *train.ratios))}
    for group in lw.structure(mechanism).groups:
        known |= set(LATIN.findall(group.signature))
    return set(LATIN.findall(text)) - known


def fourbar(crank: float, coupler: float, rocker: float, start: float = 0.0) -> lw.Mechanism:
    return lw.loads(FOURBAR.format(crank=crank, coupler=coupler, rocker=rocker, start=start))


def test_structure_of_the_crusher_in_chinese() -> None:
    """Five moving links, seven pins: 3·5 - 2·7 = 1; two dyads."""
    mechanism = lw.load(CRUSHER)
    text = lw.structure(mechanism).text("zh")
    for part in (
        "活动构件数 n = 5",
        "低副数 p = 7",
        "转动副 7 个",
        "移动副 0 个",
        "自由度 F = 3n - 2p = 3·5 - 2·7 = 1",
        "自由度等于原动件数（1）",
        "基本杆组",
        "机构 = 机架 + R(crank) + RRR(pitman, rocker) + RRR(toggle, jaw)",
        "机构级别：Ⅱ级机构",
    ):
        assert part in text
    assert text.count("Ⅱ级组") == 2
    assert foreign(text, mechanism) == set()


@pytest.mark.parametrize("name", gallery.names())
def test_no_english_is_left_in_the_structure_of_any_model(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    found = lw.structure(mechanism)
    assert foreign(found.text("zh"), mechanism) == set()
    assert foreign(rank_sentence(mechanism, "zh"), mechanism) == set()
    assert found.text() == found.text("en")


def test_columns_stand_under_each_other_on_a_terminal() -> None:
    rows = [line for line in lw.structure(lw.load(CRUSHER)).text("zh").splitlines() if "外副" in line]
    assert len(rows) == 3
    assert len({cells(row[: row.index("外副")]) for row in rows}) == 1


def test_an_unknown_language_is_refused() -> None:
    with pytest.raises(KeyError):
        lw.structure(lw.load(CRUSHER)).text("de")
    with pytest.raises(KeyError):
        Outcome(True).say("de")


def test_rank_of_the_wedge_in_chinese() -> None:
    motion = lw.solve_motion(lw.load("gallery:wedge"), steps=5)
    report = jacobian_rank(motion)
    assert report.say() == report.sentence
    assert "自由度为 0" in report.say("zh") and "得 1" in report.say("zh")
    assert "column 处的转动约束" in report.say("zh")
    assert foreign(report.say("zh"), motion.mechanism) == set()


@pytest.mark.parametrize(
    ("span", "apex", "english", "chinese"),
    [
        (2.0, (1.0, 0.0), "special position", "特殊位置"),
        (5.0, (2.5, 0.0), "a gap of", "间隙"),
        (1.6, (0.8, 0.6), "confirmed", "图示位置雅可比矩阵的秩证实"),
    ],
)
def test_rank_of_a_drawing_in_both_languages(
    span: float, apex: tuple[float, float], english: str, chinese: str
) -> None:
    """Two bars of 1 m: in one line over 2 m, too short for 5 m, a truss over 1.6 m."""
    mechanism = lw.loads(TWO_BARS.format(span=span, x=apex[0], y=apex[1]))
    report = rank_from_drawing(mechanism)
    assert report is not None
    assert english in report.say("en") and chinese in report.say("zh")
    assert foreign(report.say("zh"), mechanism) == set()


def test_distance_that_is_missing_is_said_in_chinese() -> None:
    """At 120° the pins are hypot(5.5, 2.598) m apart, links of 2 m and 2.5 m reach 4.5 m."""
    mechanism = fourbar(3, 2, 2.5)
    outcome = lw.solve_motion(mechanism, at=[radians(120)], failures="mark").outcomes[0]
    assert outcome.say("en") == outcome.sentence
    said = outcome.say("zh")
    assert "RRR 杆组（coupler、rocker）无法装配" in said and "4.5 m" in said
    assert f"{hypot(5.5, 1.5 * 3**0.5) - 4.5:.5f}" in said
    assert foreign(said, mechanism) == set()


def test_singular_and_barred_positions_in_chinese() -> None:
    singular = lw.solve_motion(fourbar(1, 3, 2), steps=360, failures="mark").outcomes[180]
    assert "奇异位置" in singular.say("zh")
    motion = lw.solve_motion(fourbar(1 + 1e-7, 3, 2, 20.5), steps=360, failures="mark")
    with pytest.raises(lw.LinkwrightError) as refused:
        lw.solve_motion(motion.mechanism, steps=360)
    assert "通路被阻断" in in_language(refused.value.sentence, "zh")
    apart = lw.solve_motion(fourbar(3.75, 1.25, 3.5, 50.0), steps=72, failures="mark")
    assert any("途中" in outcome.say("zh") for outcome in apart.outcomes)
    notes = [in_language(note, "zh") for note in motion.notes]
    assert any("driver = 180°" in note and "不能通过" in note for note in notes)
    for note in notes:
        assert foreign(note, motion.mechanism) == set()


def test_notes_on_change_points_in_chinese() -> None:
    """A parallelogram passes the frame line at 180°."""
    motion = lw.solve_motion(lw.loads(PARALLELOGRAM), steps=360)
    notes = [in_language(note, "zh") for note in motion.notes]
    assert any("变点" in note and "driver = 180°" in note for note in notes)
    for note in notes:
        assert foreign(note, motion.mechanism) == set()


@pytest.mark.parametrize(
    ("signature", "facts", "number"),
    [
        ("RRR", {"distance²": 25.0, "first²": 1.0, "second²": 4.0}, "2 m"),
        ("RRR", {"distance²": 1.0, "first²": 1.0, "second²": 16.0}, "2 m"),
        ("RRP", {"height": -5.0, "length²": 4.0}, "3 m"),
        ("RPR", {"distance²": 4.0, "offset": -5.0}, "3 m"),
        ("RPP", {"sine": 2e-17}, "2.0e-17"),
        ("PRP", {"sine": 2e-17}, "2.0e-17"),
    ],
)
def test_every_dyad_says_what_is_missing(signature: str, facts: dict[str, float], number: str) -> None:
    reason = DYADS[signature]().explain(facts)
    assert isinstance(reason, Sentence)
    assert number in reason and number in reason.say("zh")
    assert set(LATIN.findall(reason.say("zh"))) <= {"m", "e"}


def test_sentences_survive_copies_and_processes() -> None:
    inner = Sentence("rank.rotation", joint="slot")
    outer = Sentence("rank.guide", guides=("slot",), redundant=(inner,))
    for again in (copy.deepcopy(outer), pickle.loads(pickle.dumps(outer))):
        assert again == outer
        assert again.say("zh") == outer.say("zh")
    assert "slot 处的转动约束" in outer.say("zh")
    assert in_language("as it is", "zh") == "as it is"


def test_commands_speak_chinese(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["structure", CRUSHER, "--lang", "zh"]) == 0
    shown = capsys.readouterr().out
    assert "机构级别" in shown and "雅可比矩阵的秩" in shown and "Mobility" not in shown
    path = tmp_path / "linkage.yaml"
    path.write_text(FOURBAR.format(crank=3, coupler=2, rocker=2.5, start=0), encoding="utf-8")
    assert main(["solve", str(path), "--mark", "--at", "0 deg, 120 deg", "--lang", "zh"]) == 1
    shown = capsys.readouterr().out
    assert "无法装配" in shown and "assembled" not in shown
    path.write_text(PARALLELOGRAM, encoding="utf-8")
    assert main(["solve", str(path), "--lang", "zh"]) == 0
    shown = capsys.readouterr().out
    assert "变点" in shown and "change point" not in shown


def test_data_for_programs_stay_english(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["structure", CRUSHER, "--json", "--lang", "zh"]) == 0
    rank = json.loads(capsys.readouterr().out)["rank"]
    assert rank == words.say("rank.confirmed", count=1)
    path = tmp_path / "linkage.yaml"
    path.write_text(PARALLELOGRAM, encoding="utf-8")
    assert main(["solve", str(path), "--json", "--lang", "zh"]) == 0
    assert any("change point" in note for note in json.loads(capsys.readouterr().out)["notes"])


def test_no_catalogue_is_loaded_before_a_sentence_is_said() -> None:
    program = (
        "import sys, linkwright as lw\n"
        "motion = lw.solve_motion(lw.load('gallery:jaw_crusher_sixbar'), steps=36)\n"
        "print(*[name for name in sys.modules if name.startswith(('linkwright.words.en', 'linkwright.words.zh'))])\n"
        "motion.outcomes\n"
        "print('linkwright.words.en.outcome' in sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["", "True"]
