"""Answer keys, sheets, kept searches, settings and folders that are damaged: a sentence with place and remedy."""

from __future__ import annotations

import copy
import csv
import json
import sqlite3
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.course_sheets import FOUR_BAR

import linkwright as lw
from linkwright.cli import main
from linkwright.files.source import read_source

CRANK = "gallery:crank_rocker"
SEARCH = ["--vary", "coupler.length=3.2..3.8m", "--maximize", "transmission_angle"]
Said = Callable[..., str]


@pytest.fixture(scope="module")
def key() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(lw.variants(lw.loads(FOUR_BAR), 2, seed=3).key_text())
    return found


@pytest.fixture
def said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Said:
    """Runs a command in an empty folder; gives what it says where it fails with the code that is expected."""
    monkeypatch.chdir(tmp_path)

    def run(code: int, *words: str) -> str:
        assert main(list(words)) == code, words
        told = capsys.readouterr().err
        assert told and "should not have happened" not in told
        return told

    return run


def sheet(key: dict[str, Any], cell: str = "1") -> str:
    names = [each["name"] for each in key["questions"]]
    with Path("answers.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([["student", "variant", *names], ["Li", "1", *[cell] * len(names)]])
    return "answers.csv"


GONE = object()


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("tolerance",), GONE), (("tolerance",), "ten"), (("tolerance",), float("nan")), (("tolerance",), -1),
        (("questions",), GONE), (("questions",), []), (("questions",), "x"), (("questions", 0, "name"), []),
        (("questions", 0, "unit"), 3), (("questions", 0, "unit"), GONE), (("variants",), []), (("variants",), {}),
        (("variants", 0), 1), (("variants", 0, "number"), GONE), (("variants", 0, "answers"), GONE),
        (("variants", 0, "answers", 0), GONE), (("variants", 0, "answers", 0), None),
        (("variants", 0, "answers", 0), "a"), (("variants", 0, "answers", 0), 10**400),
        (("variants", 0, "answers", 0), float("inf")), (("variants", 0, "mistakes"), None),
        (("variants", 0, "mistakes", 0, "mistake"), "bogus"), (("variants", 0, "mistakes", 0, "mistake"), []),
        (("variants", 0, "mistakes", 0, "where"), GONE), (("variants", 0, "mistakes", 0, "answers", 0), GONE),
    ],
)  # fmt: skip
def test_a_damaged_key_says_where(
    key: dict[str, Any], said: Said, place: tuple[Any, ...], value: Any
) -> None:
    damaged = copy.deepcopy(key)
    inner: Any = damaged
    for step in place[:-1]:
        inner = inner[step]
    if value is GONE:
        del inner[place[-1]]
    else:
        inner[place[-1]] = value
    Path("key.json").write_text(json.dumps(damaged), encoding="utf-8")
    told = said(2, "grade", "key.json", sheet(key))
    where = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in place)[1:]
    said_place = told.partition("key.json: ")[2].partition(" is missing")[0]
    assert said_place and where.startswith(said_place) and "write the key again" in told


@pytest.mark.parametrize("text", ["", "[]", "null", '{"a":', "[" * 100_000])
def test_what_is_no_key(key: dict[str, Any], said: Said, text: str) -> None:
    Path("key.json").write_text(text, encoding="utf-8")
    assert "key.json" in said(2, "grade", "key.json", sheet(key))


@pytest.mark.parametrize(
    ("text", "code", "words"),
    [
        ("", 2, 'no column "variant"'),
        ("student,variant\n", 2, 'no column "coupler.angle"'),
        ('"unclosed,variant\n1,2', 2, 'no column "variant"'),
        ("x" * 200_000 + "\n1", 2, "cannot be read"),
        ("NAMES,coupler.angle\nLi,1\n", 2, 'more than one column "coupler.angle"'),
        (
            "NAMES\nLi,1,1,5,2,5,3,5,4,5,5,5,6,5,7,5,8,5,9,5\n",
            1,
            "line 2: there are more values than columns",
        ),
        ("NAMES\nLi,1,nan\n", 1, '"nan" is no number'),
        ("NAMES\nLi,1,1e999\n", 1, '"1e999" is no number'),
        ("NAMES\nLi,1," + "9" * 5000 + "\n", 1, "is no number"),
    ],
)
def test_a_damaged_sheet_says_what_is_the_matter(
    key: dict[str, Any], said: Said, text: str, code: int, words: str
) -> None:
    names = ",".join(["student", "variant", *(each["name"] for each in key["questions"])])
    Path("key.json").write_text(json.dumps(key), encoding="utf-8")
    Path("answers.csv").write_text(text.replace("NAMES", names), encoding="utf-8")
    told = said(code, "grade", "key.json", "answers.csv")
    assert words in told and len(told) < 400


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ("course: 5", "course"),
        ("course: {ask: 5}", 'course.ask: "5" is no list of results'),
        ("course: {ask: []}", "is no list of results"),
        ("course: {ask: rocker.angle}", "is no list of results"),
        ("course: {ask: [nope]}", 'no result "nope"'),
        ("course: {at: 5 m}", "course.at"),
        ("course: {vary: {crank.length: 1e400 %}}", "no range"),
        ("course: {vary: {crank.length: [1 kg, 2 kg]}}", "course.vary.crank.length"),
        ("course: {tolerance: nan %}", "no tolerance"),
    ],
)
def test_damaged_sections_of_a_course(said: Said, section: str, words: str) -> None:
    Path("bar.yaml").write_text(FOUR_BAR.partition("course:")[0] + section + "\n", encoding="utf-8")
    assert words in said(1, "variants", "bar.yaml", "--count", "1", "--to", "key")
    assert not Path("bar-variants").exists()


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ("5", "optimize"),
        ("{vary: {coupler.length: [3 m]}, maximize: transmission_angle}", "optimize.vary.coupler.length"),
        (
            "{vary: {coupler.length: {from: 3 m}}, maximize: transmission_angle}",
            "optimize.vary.coupler.length",
        ),
        (
            "{vary: {coupler.length: [3.2 m, nan m]}, maximize: transmission_angle}",
            "optimize.vary.coupler.length",
        ),
    ],
)
def test_damaged_sections_of_a_search(said: Said, section: str, words: str) -> None:
    text = f"{read_source(CRANK)[0]}\noptimize: {section}\n"
    Path("crank.yaml").write_text(text, encoding="utf-8")
    assert words in said(1, "optimize", "crank.yaml", "--evaluations", "12")


def test_damaged_states_of_a_search(said: Said) -> None:
    state = Path("search.state")
    words = ["optimize", CRANK, *SEARCH, "--state", str(state)]
    assert main([*words, "--evaluations", "12"]) == 0
    with sqlite3.connect(state) as parts:
        ((key, content),) = parts.execute("select * from parts where content like '%generation%'")
    kept = dict(json.loads(content)["pairs"])
    changes = [("x", None), ("x", []), ("x", -1), ("x", [[2.0]] * 12), ("generation", -1),
               ("evaluations", -1), ("history", "x"), ("history", [None] * 99), ("draw", {"pairs": []})]  # fmt: skip
    texts = [json.dumps({"pairs": [*{**kept, name: value}.items()]}) for name, value in changes]
    for text in ["", "[" * 100_000, "null", *texts]:
        with sqlite3.connect(state) as parts:
            parts.execute("update parts set content = ? where key = ?", (text, key))
        told = said(2, *words, "--evaluations", "60")
        assert "cannot be used" in told and "name another file" in told
    parts.close()
    state.write_text(json.dumps({"problem": "x", "judged": []}), encoding="utf-8")  # as it once was
    assert "cannot be used (file is not a database)" in said(2, *words, "--evaluations", "60")


@pytest.mark.parametrize("folder", ["file", "file/inner", "a" * 300, "a\0b"])
def test_folders_that_cannot_be_made(said: Said, folder: str) -> None:
    Path("file").write_text("x", encoding="utf-8")
    sweep = ["sweep", CRANK, "--vary", "coupler.length=3.2..3.8m:2", "--numbers", "rocker.angle range"]
    assert "cannot be made" in said(2, *sweep, "--steps", "12", "--folder", folder)
    Path("bar.yaml").write_text(FOUR_BAR, encoding="utf-8")
    told = said(2, "variants", "bar.yaml", "--count", "1", "--to", "key", "--output", folder)
    assert "cannot be made" in told or "is there already" in told


def test_seeds_that_are_negative(said: Said) -> None:
    vary = ["--vary", "coupler.length=3.2..3.8m", "--sampling", "sobol", "--numbers", "rocker.angle range"]
    assert "the seed is -1" in said(2, "sweep", CRANK, *vary, "--folder", "new", "--seed", "-1")
    assert "the seed is -1" in said(2, "variants", CRANK, "--seed", "-1")
    vary = ["--vary", "coupler.length=3.2..3.8m", "--minimize", "rocker.angle range"]
    assert "the seed is -1" in said(2, "optimize", CRANK, *vary, "--seed", "-1")


def test_a_folder_without_a_name(said: Said) -> None:
    sweep = ["sweep", CRANK, "--vary", "coupler.length=3.2..3.8m:2", "--numbers", "rocker.angle range"]
    assert "the folder has no name" in said(2, *sweep, "--steps", "12", "--folder", "")


def test_one_number_is_not_sought_twice() -> None:
    """Made least and greatest at once, every design would be as good as every other."""
    crank_rocker, vary = lw.load("gallery:crank_rocker"), {"coupler.length": "2..3 m"}
    for goals in ({"minimize": "travel", "maximize": "travel"}, {"minimize": ["travel", " travel"]}):
        with refused("optimize", lw.ModelError, text="travel"):
            lw.optimize(crank_rocker, vary=vary, **goals)


@pytest.mark.parametrize("given", ["3.8..3.2m", ["3.8 m", "3.2 m"], [3.8, 3.2], {"whole": "4..3m"}])
def test_bounds_that_fall(given: Any) -> None:
    with refused("optimize", lw.ModelError, address="coupler.length"):
        lw.optimize(lw.load(CRANK), vary={"coupler.length": given}, minimize="rocker.angle range")


def test_a_variable_without_effect_is_named_and_stays() -> None:
    machine, vary = lw.load(CRANK), {"coupler.P.x": "1..2m", "crank.length": "0.9..1.1m"}
    found = lw.optimize(machine, vary=vary, minimize="rocker.angle range")
    assert found.data()["without_effect"] == ["coupler.P.x"]
    assert "coupler.P.x changes none of these numbers" in found.text()
    assert found.best.values["coupler.P.x"] == 1.5
    assert not lw.optimize(machine, vary=vary, minimize="P.x range").without_effect


@pytest.mark.parametrize(
    "address", ["nope", "", "tcp://127.0.0.1:x", "tls://127.0.0.1:9", "http://x:1", "inproc://x"]
)
def test_addresses_of_no_scheduler(said: Said, monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("linkwright.study.cluster.PATIENCE", 0.3)
    sweep = ["sweep", CRANK, "--vary", "coupler.length=3.2..3.8m:2", "--numbers", "rocker.angle range"]
    told = said(1, *sweep, "--steps", "12", "--folder", "new", "--cluster", address)
    assert f'the scheduler "{address}" does not answer' in told
