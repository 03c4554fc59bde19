"""Answer keys, sheets, kept searches, settings and folders that are damaged: refused with their place."""

from __future__ import annotations

import copy
import csv
import json
import sqlite3
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests import store
from tests.course_sheets import FOUR_BAR
from tests.refusals import faulty, noted, refused

import linkwright as lw
from linkwright.cli import main

CRANK = "gallery:crank_rocker"
SEARCH = ["--vary", "coupler.length=3.2..3.8m", "--maximize", "transmission_angle"]
Fails = Callable[..., str]


@pytest.fixture(scope="module")
def key() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(lw.variants(lw.loads(FOUR_BAR), 2, seed=3).key_text())
    return found


@pytest.fixture
def fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Fails:
    """Runs a command in an empty folder; gives what it says where it fails with the code that is expected."""
    monkeypatch.chdir(tmp_path)

    def run(code: int, *words: str) -> str:
        assert main(list(words)) == code, words
        told = capsys.readouterr().err
        assert told
        return told

    return run


def sheet(key: dict[str, Any], cell: str = "1") -> str:
    names = [each["name"] for each in key["questions"]]
    with Path("answers.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([["student", "variant", *names], ["Li", "1", *[cell] * len(names)]])
    return "answers.csv"


def answers(key: dict[str, Any], text: str) -> None:
    """The key, and a sheet in which NAMES stands for the columns."""
    names = ",".join(["student", "variant", *(each["name"] for each in key["questions"])])
    Path("key.json").write_text(json.dumps(key), encoding="utf-8")
    Path("answers.csv").write_text(text.replace("NAMES", names), encoding="utf-8")


GONE = object()


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("tolerance",), GONE),
        (("tolerance",), "ten"),
        (("tolerance",), float("nan")),
        (("tolerance",), -1),
        (("questions",), GONE),
        (("questions",), []),
        (("questions",), "x"),
        (("questions", 0, "name"), []),
        (("questions", 0, "unit"), 3),
        (("questions", 0, "unit"), GONE),
        (("variants",), []),
        (("variants",), {}),
        (("variants", 0), 1),
        (("variants", 0, "number"), GONE),
        (("variants", 0, "answers"), GONE),
        (("variants", 0, "answers", 0), GONE),
        (("variants", 0, "answers", 0), None),
        (("variants", 0, "answers", 0), "a"),
        (("variants", 0, "answers", 0), 10**400),
        (("variants", 0, "answers", 0), float("inf")),
        (("variants", 0, "mistakes"), None),
        (("variants", 0, "mistakes", 0, "mistake"), "bogus"),
        (("variants", 0, "mistakes", 0, "mistake"), []),
        (("variants", 0, "mistakes", 0, "where"), GONE),
        (("variants", 0, "mistakes", 0, "answers", 0), GONE),
    ],
)
def test_a_damaged_key_says_where(key: dict[str, Any], fails: Fails, place: tuple[Any, ...], value: Any) -> None:
    damaged = copy.deepcopy(key)
    inner: Any = damaged
    for step in place[:-1]:
        inner = inner[step]
    if value is GONE:
        del inner[place[-1]]
    else:
        inner[place[-1]] = value
    Path("key.json").write_text(json.dumps(damaged), encoding="utf-8")
    fails(2, "grade", "key.json", sheet(key))
    where = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in place)[1:]
    with refused("course.damaged_key", path="key.json") as caught:
        lw.grade("key.json", "answers.csv")
    assert caught.value.values["place"] and where.startswith(str(caught.value.values["place"]))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "course.bad_key"),
        ("[]", "course.no_key"),
        ("null", "course.no_key"),
        ('{"a":', "course.bad_key"),
        ("[" * 100_000, "course.bad_key"),
    ],
)
def test_what_is_no_key(key: dict[str, Any], fails: Fails, text: str, code: str) -> None:
    Path("key.json").write_text(text, encoding="utf-8")
    assert "key.json" in fails(2, "grade", "key.json", sheet(key))
    with refused(code, path="key.json"):
        lw.grade("key.json", "answers.csv")


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("", "course.no_column", {"name": "variant"}),
        ("student,variant\n", "course.no_column", {"name": "coupler.angle"}),
        ('"unclosed,variant\n1,2', "course.no_column", {"name": "variant"}),
        ("x" * 200_000 + "\n1", "course.bad_answers", {"path": "answers.csv"}),
        ("NAMES,coupler.angle\nLi,1\n", "course.two_columns", {"name": "coupler.angle"}),
    ],
)
def test_a_damaged_sheet_is_refused(
    key: dict[str, Any], fails: Fails, text: str, code: str, values: dict[str, object]
) -> None:
    answers(key, text)
    assert len(fails(2, "grade", "key.json", "answers.csv")) < 400
    with refused(code, **values):
        lw.grade("key.json", "answers.csv")


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("NAMES\nLi,1,1,5,2,5,3,5,4,5,5,5,6,5,7,5,8,5,9,5\n", "course.long_row", {"line": 2}),
        ("NAMES\nLi,1,nan\n", "course.no_answer", {"line": 2, "name": "coupler.angle", "text": "nan"}),
        ("NAMES\nLi,1,1e999\n", "course.no_answer", {"text": "1e999"}),
        ("NAMES\nLi,1," + "9" * 5000 + "\n", "course.no_answer", {"name": "coupler.angle"}),
    ],
)
def test_a_damaged_line_of_a_sheet_has_its_fault(
    key: dict[str, Any], fails: Fails, text: str, code: str, values: dict[str, object]
) -> None:
    answers(key, text)
    assert len(fails(1, "grade", "key.json", "answers.csv")) < 400
    (grade,) = lw.grade("key.json", "answers.csv")
    noted([grade.fault], code, **values)
    assert not any(grade.right)


@pytest.mark.parametrize(
    ("section", "code", "key", "values"),
    [
        ("course: 5", "type", "course", {}),
        ("course: {ask: 5}", "type", "course.ask", {}),
        ("course: {ask: []}", "no-list", "course.ask", {"given": "[]"}),
        ("course: {ask: rocker.angle}", "type", "course.ask", {}),
        ("course: {ask: [nope]}", "no-number", "course.ask.0", {"name": "nope"}),
        ("course: {at: 5 m}", "wrong-dimension", "course.at", {"text": "5 m"}),
        ("course: {vary: {crank.length: 1e400 %}}", "bad-range", "course.vary.crank.length", {}),
        ("course: {tolerance: nan %}", "bad-tolerance", "course.tolerance", {}),
    ],
)
def test_damaged_sections_of_a_course(
    fails: Fails, section: str, code: str, key: str, values: dict[str, object]
) -> None:
    Path("bar.yaml").write_text(FOUR_BAR.partition("course:")[0] + section + "\n", encoding="utf-8")
    assert key in fails(1, "variants", "bar.yaml", "--count", "1", "--to", "key")
    assert not Path("bar-variants").exists()
    with faulty(code, key, **values):
        lw.variants("bar.yaml", 1)


def test_both_ends_of_a_damaged_range_of_a_course_are_told(fails: Fails) -> None:
    section = "course: {vary: {crank.length: [1 kg, 2 kg]}}"
    Path("bar.yaml").write_text(FOUR_BAR.partition("course:")[0] + section + "\n", encoding="utf-8")
    assert "course.vary.crank.length" in fails(1, "variants", "bar.yaml", "--count", "1", "--to", "key")
    with pytest.raises(lw.ModelError) as caught:
        lw.variants("bar.yaml", 1)
    assert [each.values["text"] for each in caught.value.findings] == ["1 kg", "2 kg"]


@pytest.mark.parametrize(
    ("section", "code", "key", "values"),
    [
        ("5", "type", "optimize", {}),
        (
            "{vary: {coupler.length: [3 m]}, maximize: transmission_angle}",
            "optimize.no_bounds",
            "optimize.vary.coupler.length",
            {"given": "[3 m]"},
        ),
        (
            "{vary: {coupler.length: {from: 3 m}}, maximize: transmission_angle}",
            "unknown-key",
            "optimize.vary.coupler.length.from",
            {"key_": "from"},
        ),
        (
            "{vary: {coupler.length: [3.2 m, nan m]}, maximize: transmission_angle}",
            "study.no_quantity",
            "optimize.vary.coupler.length",
            {"part": "nan m"},
        ),
    ],
)
def test_damaged_sections_of_a_search(
    fails: Fails, section: str, code: str, key: str, values: dict[str, object]
) -> None:
    text = f"{store.text('crank_rocker')}\noptimize: {section}\n"
    Path("crank.yaml").write_text(text, encoding="utf-8")
    assert key in fails(1, "optimize", "crank.yaml", "--evaluations", "12")
    with faulty(code, key, **values):
        lw.optimize("crank.yaml", evaluations=12)


def search(state: Path, evaluations: int = 60) -> None:
    """A search whose state is kept."""
    vary = {"coupler.length": "3.2..3.8m"}
    aim = {"maximize": "transmission_angle", "evaluations": evaluations}
    lw.optimize(store.machine("crank_rocker"), vary=vary, state=state, **aim)


def test_damaged_states_of_a_search(fails: Fails) -> None:
    state = Path("search.state")
    search(state, evaluations=12)
    with sqlite3.connect(state) as parts:
        ((key, content),) = parts.execute("select * from parts where content like '%generation%'")
    kept = dict(json.loads(content)["pairs"])
    changes = [
        ("x", None),
        ("x", []),
        ("x", -1),
        ("x", [[2.0]] * 12),
        ("generation", -1),
        ("evaluations", -1),
        ("history", "x"),
        ("history", [None] * 99),
        ("draw", {"pairs": []}),
    ]
    texts = [json.dumps({"pairs": [*{**kept, name: value}.items()]}) for name, value in changes]
    for text in ["", "[" * 100_000, "null", *texts]:
        with sqlite3.connect(state) as parts:
            parts.execute("update parts set content = ? where key = ?", (text, key))
        with refused("study.bad_state", path=state):
            search(state)
    parts.close()
    state.write_text(json.dumps({"problem": "x", "judged": []}), encoding="utf-8")  # as it once was
    assert str(state) in fails(2, "optimize", CRANK, *SEARCH, "--state", str(state), "--evaluations", "60")
    with refused("study.bad_state", path=state):
        search(state)


@pytest.mark.parametrize("folder", ["file", "file/inner", "a" * 300, "a\0b"])
def test_folders_that_cannot_be_made(fails: Fails, folder: str) -> None:
    Path("file").write_text("x", encoding="utf-8")
    sweep = ["sweep", CRANK, "--vary", "coupler.length=3.2..3.8m:2", "--numbers", "rocker.angle range"]
    fails(2, *sweep, "--steps", "12", "--folder", folder)
    vary = {"coupler.length": "3.2..3.8m:2"}
    with refused("file.cannot_make") as caught:
        lw.sweep_parts(store.machine("crank_rocker"), vary, folder, outputs=["rocker.angle range"], steps=12)
    assert str(caught.value.values["path"])[:100] == folder[:100]
    Path("bar.yaml").write_text(FOUR_BAR, encoding="utf-8")
    told = fails(2, "variants", "bar.yaml", "--count", "1", "--to", "key", "--output", folder)
    assert folder.partition("\0")[0][:100] in told


def test_seeds_that_are_negative(fails: Fails) -> None:
    vary = ["--vary", "coupler.length=3.2..3.8m", "--sampling", "sobol", "--numbers", "rocker.angle range"]
    assert "-1" in fails(2, "sweep", CRANK, *vary, "--folder", "new", "--seed", "-1")
    assert "-1" in fails(2, "variants", CRANK, "--seed", "-1")
    vary = ["--vary", "coupler.length=3.2..3.8m", "--minimize", "rocker.angle range"]
    assert "-1" in fails(2, "optimize", CRANK, *vary, "--seed", "-1")


def test_a_folder_without_a_name(fails: Fails) -> None:
    sweep = ["sweep", CRANK, "--vary", "coupler.length=3.2..3.8m:2", "--numbers", "rocker.angle range"]
    fails(2, *sweep, "--steps", "12", "--folder", "")
    with refused("study.no_folder"):
        lw.sweep_parts(store.machine("crank_rocker"), {"coupler.length": "3.2..3.8m:2"}, "", outputs=["B.x range"])


def test_one_number_is_not_sought_twice() -> None:
    """Made least and greatest at once, every design would be as good as every other."""
    crank_rocker, vary = store.machine("crank_rocker"), {"coupler.length": "2..3 m"}
    for goals in ({"minimize": "travel", "maximize": "travel"}, {"minimize": ["travel", " travel"]}):
        with refused("goal-twice", lw.ModelError, text="travel"):
            lw.optimize(crank_rocker, vary=vary, **goals)


@pytest.mark.parametrize("given", ["3.8..3.2m", ["3.8 m", "3.2 m"], [3.8, 3.2], {"whole": "4..3m"}])
def test_bounds_that_fall(given: Any) -> None:
    with faulty("optimize.falling", "optimize.vary.coupler.length"):
        lw.optimize(store.machine("crank_rocker"), vary={"coupler.length": given}, minimize="rocker.angle range")


def test_a_variable_without_effect_is_named_and_stays() -> None:
    machine, vary = store.machine("crank_rocker"), {"coupler.P.x": "1..2m", "crank.length": "0.9..1.1m"}
    found = lw.optimize(machine, vary=vary, minimize="rocker.angle range")
    assert found.data()["without_effect"] == ["coupler.P.x"]
    assert "coupler.P.x" in found.text()
    assert found.best.values["coupler.P.x"] == 1.5
    assert not lw.optimize(machine, vary=vary, minimize="P.x range").without_effect
