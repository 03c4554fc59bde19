"""`tests.state` finds what differs between two states, and nothing where only rounding does."""

import gzip
import json
import math
from pathlib import Path

import pytest
from tests.state.__main__ import main
from tests.state.counting import counted
from tests.state.dumping import lines
from tests.state.rows import Row, leaves, rows

import linkwright as lw

FORCES = [
    Row("forces", "press", "A on rod.x", "N", [1000.0, -2000.0]),
    Row("forces", "press", "A on rod.y", "N", [0.0, 3e-14]),
    Row("forces", "press", "driver.effort", "N·m", {"every": 2, "size": 4, "values": [3.0, 4.0], "mean": 3.5}),
    Row("metrics", "press", "stroke", "m", 0.4),
    Row("metrics", "press", "jam", "", math.nan),
    Row("findings", "cuts: press", "149", "", ["error syntax 3:1 links"]),
]


def written(path: Path, found: list[Row]) -> str:
    path.write_bytes(gzip.compress("".join(lines(sorted(found))).encode("utf-8"), mtime=0))
    return str(path)


def with_value(name: str, value: object) -> list[Row]:
    assert any(row.name == name for row in FORCES)
    return [row._replace(value=value) if row.name == name else row for row in FORCES]


@pytest.fixture
def before(tmp_path: Path) -> str:
    return written(tmp_path / "before", FORCES)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("A on rod.x", [1000.0 + 1e-10, -2000.0]),
        ("A on rod.y", [1e-13, -2e-8]),
        ("driver.effort", {"every": 2, "size": 4, "values": [3.0, 4.0], "mean": 3.5 * (1 + 1e-13)}),
        ("stroke", 0.4 * (1 + 1e-13)),
    ],
)
def test_rounding_is_no_difference(before: str, tmp_path: Path, name: str, value: object) -> None:
    """A component that is zero but for rounding is judged beside the largest force of its machine."""
    assert main(["compare", before, written(tmp_path / "after", with_value(name, value))]) == 0


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("A on rod.x", [1000.0 + 1e-5, -2000.0]),
        ("A on rod.x", [1000.0, 2000.0]),
        ("A on rod.x", [1000.0, -2000.0, 0.0]),
        ("A on rod.y", [1e-6, 0.0]),
        ("driver.effort", {"every": 2, "size": 4, "values": [3.0, 4.0], "mean": 3.5 + 1e-8}),
        ("driver.effort", {"every": 2, "size": 5, "values": [3.0, 4.0], "mean": 3.5}),
        ("stroke", math.nan),
        ("stroke", "refused: metrics.does_not_apply"),
        ("stroke", None),
        ("jam", 0.0),
        ("149", ["error syntax 3:2 links"]),
        ("149", ["error unknown-key 3:1 links"]),
        ("149", []),
    ],
)
def test_a_change_is_shown_with_its_place(
    before: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, value: object
) -> None:
    after = written(tmp_path / "after", with_value(name, value))
    assert main(["compare", before, after]) == main(["compare", after, before]) == 1
    row = next(each for each in FORCES if each.name == name)
    assert f"{row.part}/{row.subject}/{name}: " in capsys.readouterr().out


def test_a_row_that_is_missing_or_new_is_shown(
    before: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    after = written(tmp_path / "after", [*FORCES[1:], FORCES[0]._replace(name="A on rod.z")])
    assert main(["compare", before, after]) == 1
    shown = capsys.readouterr().out
    assert shown.count("/A on rod.x: ") == 1 and shown.count("/A on rod.z: ") == 1


def test_the_tolerance_may_be_given(before: str, tmp_path: Path) -> None:
    after = written(tmp_path / "after", with_value("stroke", 0.4001))
    assert main(["compare", before, after, "--tolerance", "1e-3"]) == 0
    assert main(["compare", before, after, "--tolerance", "1e-4"]) == 1


def test_what_is_renamed_on_purpose_is_no_difference(before: str, tmp_path: Path) -> None:
    after = [
        FORCES[0]._replace(name="A on connecting rod.x"),
        *FORCES[1:-1],
        FORCES[-1]._replace(value=["error yaml-syntax 3:1 links"]),
    ]
    words = ["compare", before, written(tmp_path / "after", after)]
    renamed = ["--renamed", r"\brod\.x", "connecting rod.x", "--renamed", "error syntax", "error yaml-syntax"]
    assert main(words) == 1 and main([*words, *renamed]) == 0


@pytest.mark.parametrize(
    "words",
    [
        ["compare", "before"],
        ["compare", "before", "nowhere"],
        ["compare", "before", "text"],
        ["compare", "before", "other"],
        ["dump"],
        ["dump", "out", "--only", "nothing"],
        ["dump", "nowhere/out"],
        ["dump", "out", "--workers", "0"],
    ],
)
def test_wrong_use_is_told_apart(
    before: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("text").write_text("no state", encoding="utf-8")
    Path("other").write_bytes(gzip.compress(json.dumps({"state": 0}).encode()))
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2


def test_an_error_is_a_row() -> None:
    def entries():  # type: ignore[no-untyped-def]
        yield "a", "m", 1.0
        raise ZeroDivisionError

    assert [row.value for row in rows("motion", "press", entries())] == [1.0, "refused: ZeroDivisionError"]


def test_leaves_of_data_have_units_and_no_sentences() -> None:
    data = {
        "size": {"value": 2.0, "unit": "m", "note": "at 3°"},
        "v [m/s]": [1.0, 2.0],
        "say": "this is a whole sentence",
    }
    assert list(leaves(data)) == [("size", "m", 2.0), ("v", "m/s", [1.0, 2.0])]


@pytest.mark.long
def test_two_dumps_are_equal(tmp_path: Path) -> None:
    """In one process and in two, to the bit."""
    parts = ["structure", "motion", "forces", "limits", "gears", "programs"]
    paths = [tmp_path / name for name in ("first", "second")]
    for path, workers in zip(paths, ("1", "2"), strict=True):
        assert main(["dump", str(path), "--workers", workers, "--only", *parts]) == 0
    assert paths[0].read_bytes() == paths[1].read_bytes()
    assert main(["compare", *map(str, paths)]) == 0


@pytest.mark.long
def test_an_interruption_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> object:
        raise KeyboardInterrupt

    monkeypatch.setattr("tests.state.dumping.finished", interrupted)
    assert main(["dump", str(tmp_path / "out"), "--only", "gears"]) == 130
    assert not list(tmp_path.iterdir())


def test_count_of_files_and_functions() -> None:
    files, functions, rooms = counted(lambda: lw.load("gallery:crank_rocker"))
    assert functions > files > 5
    assert sum(rooms.values()) == functions
    assert counted(lambda: None) == (0, 0, {})
