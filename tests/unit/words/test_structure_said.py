"""Sentences of the analysis in both languages: structure, rank of the Jacobian, outcomes, notes."""

import copy
import json
import pickle
import re
from math import hypot, radians
from pathlib import Path

import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import gallery, words
from linkwright.cli import main
from linkwright.groups.base import DYADS
from linkwright.kinematics.motion import Outcome
from linkwright.kinematics.rank import rank_from_drawing
from linkwright.kinematics.rank_of_motion import jacobian_rank, rank_sentence
from linkwright.words import Message, _
from linkwright.words.characters import cells
from linkwright.words.message import code_of, in_language, values_of

CRUSHER = "jaw_crusher_sixbar"
SYMBOLS = {"F", "n", "p", "p_H", "w", "m", "mm"}
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


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_structure_of_the_crusher(language: str) -> None:
    """Five moving links, seven pins: 3·5 - 2·7 = 1; two dyads."""
    text = lw.structure(store.machine(CRUSHER)).text(language)
    for part in (
        "n = 5",
        "p = 7",
        "F = 3n - 2p = 3·5 - 2·7 = 1",
        "R(crank) + RRR(pitman, rocker) + RRR(toggle, jaw)",
    ):
        assert part in text


@pytest.mark.parametrize("name", gallery.names())
def test_no_english_is_left_in_the_structure_of_any_model(name: str) -> None:
    mechanism = store.machine(name)
    found = lw.structure(mechanism)
    assert foreign(found.text("zh"), mechanism) == set()
    assert foreign(rank_sentence(mechanism, "zh"), mechanism) == set()
    assert found.text() == found.text("en")


def test_columns_stand_under_each_other_on_a_terminal() -> None:
    outer = _("outer joints {outer}", outer="").translate("zh").strip()
    rows = [line for line in lw.structure(store.machine(CRUSHER)).text("zh").splitlines() if outer in line]
    assert len(rows) == 3
    assert len({cells(row[: row.index(outer)]) for row in rows}) == 1


def test_an_unknown_language_is_refused() -> None:
    with pytest.raises(KeyError):
        lw.structure(store.machine(CRUSHER)).text("de")
    with pytest.raises(KeyError):
        Outcome(True).translate("de")


def test_rank_of_the_wedge_in_chinese() -> None:
    motion = store.motion("wedge", 5)
    report = jacobian_rank(motion)
    assert report.translate() == report.sentence
    assert code_of(report.sentence) == "rank.differs"
    assert re.findall(r"\d+", report.translate("zh")) == re.findall(r"\d+", report.translate("en"))
    assert foreign(report.translate("zh"), motion.mechanism) == set()


@pytest.mark.parametrize(
    ("span", "apex", "code"),
    [
        (2.0, (1.0, 0.0), "rank.differs_drawn"),
        (5.0, (2.5, 0.0), "rank.gaping"),
        (1.6, (0.8, 0.6), "rank.confirmed_drawn"),
    ],
)
def test_rank_of_a_drawing_in_both_languages(span: float, apex: tuple[float, float], code: str) -> None:
    """Two bars of 1 m: in one line over 2 m, too short for 5 m, a truss over 1.6 m."""
    mechanism = lw.loads(TWO_BARS.format(span=span, x=apex[0], y=apex[1]))
    report = rank_from_drawing(mechanism)
    assert report is not None
    assert code_of(report.sentence) == code
    assert foreign(report.translate("zh"), mechanism) == set()


def test_distance_that_is_missing_is_said_in_chinese() -> None:
    """At 120° the pins are hypot(5.5, 2.598) m apart, links of 2 m and 2.5 m reach 4.5 m."""
    mechanism = fourbar(3, 2, 2.5)
    outcome = lw.solve_motion(mechanism, at=[radians(120)], failures="mark").outcomes[0]
    assert outcome.translate("en") == outcome.sentence
    said = outcome.translate("zh")
    assert (code_of(outcome.sentence), values_of(outcome.sentence)["signature"]) == ("outcome.apart", "RRR")
    assert "4500 mm" in said
    assert f"{1e3 * (hypot(5.5, 1.5 * 3**0.5) - 4.5):.3f} mm" in said
    assert foreign(said, mechanism) == set()


def test_singular_and_barred_positions_in_chinese() -> None:
    singular = lw.solve_motion(fourbar(1, 3, 2), steps=360, failures="mark").outcomes[180]
    assert code_of(singular.sentence) == "outcome.singular"
    motion = lw.solve_motion(fourbar(1 + 1e-7, 3, 2, 20.5), steps=360, failures="mark")
    with pytest.raises(lw.LinkwrightError) as refused:
        lw.solve_motion(motion.mechanism, steps=360)
    assert refused.value.code == "motion.not_passed"
    apart = lw.solve_motion(fourbar(3.75, 1.25, 3.5, 50.0), steps=72, failures="mark")
    assert "outcome.barred" in {code_of(outcome.sentence) for outcome in apart.outcomes}
    notes = [in_language(note, "zh") for note in motion.notes]
    assert "cycle.gap" in map(code_of, motion.notes) and any("driver = 180°" in note for note in notes)
    for note in every(notes):
        assert foreign(note, motion.mechanism) == set()


def test_notes_on_change_points_in_chinese() -> None:
    """A parallelogram passes the frame line at 180°."""
    motion = lw.solve_motion(lw.loads(PARALLELOGRAM), steps=360)
    notes = [in_language(note, "zh") for note in motion.notes]
    assert "cycle.change" in map(code_of, motion.notes) and any("driver = 180°" in note for note in notes)
    for note in every(notes):
        assert foreign(note, motion.mechanism) == set()


@pytest.mark.parametrize(
    ("signature", "facts", "number"),
    [
        ("RRR", {"distance²": 25.0, "first²": 1.0, "second²": 4.0}, "2000 mm"),
        ("RRR", {"distance²": 1.0, "first²": 1.0, "second²": 16.0}, "2000 mm"),
        ("RRP", {"height": -5.0, "length²": 4.0}, "3000 mm"),
        ("RPR", {"distance²": 4.0, "offset": -5.0}, "3000 mm"),
        ("RPP", {"sine": 2e-17}, "2.0e-17"),
        ("PRP", {"sine": 2e-17}, "2.0e-17"),
    ],
)
def test_every_dyad_says_what_is_missing(signature: str, facts: dict[str, float], number: str) -> None:
    reason = DYADS[signature]().explain(facts)
    assert isinstance(reason, Message)
    assert number in reason and number in reason.translate("zh")
    assert set(LATIN.findall(reason.translate("zh"))) <= {"mm", "e"}


def test_sentences_survive_copies_and_processes() -> None:
    inner = _("rotation at {joint}", code="rank.rotation", joint="slot")
    outer = _(
        "the guide {guides} closes a loop in which rotation is already prevented ({redundant})",
        code="rank.guide",
        guides=("slot",),
        redundant=(inner,),
    )
    for again in (copy.deepcopy(outer), pickle.loads(pickle.dumps(outer))):
        assert again == outer
        assert again.translate("zh") == outer.translate("zh")
    assert inner.translate("zh") in outer.translate("zh")
    assert in_language("as it is", "zh") == "as it is"


def test_data_for_programs_stay_english(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["structure", f"gallery:{CRUSHER}", "--json", "--lang", "zh"]) == 0
    rank = json.loads(capsys.readouterr().out)["rank"]
    assert rank == words.translate(_("Grübler's mobility {count} is confirmed by the rank of the Jacobian", count=1))
    path = tmp_path / "linkage.yaml"
    path.write_text(PARALLELOGRAM, encoding="utf-8")
    assert main(["solve", str(path), "--json", "--lang", "zh"]) == 0
    notes = json.loads(capsys.readouterr().out)["notes"]
    assert notes == list(lw.solve_motion(lw.loads(PARALLELOGRAM), steps=360).notes)
