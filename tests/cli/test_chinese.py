"""What a reader of Chinese sees holds no English besides identifiers; the sentences stand in `tests/words/`."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests import store
from tests.cli.commands import data, run, shown
from tests.cli.tables import cells
from tests.every import every

import linkwright as lw
from linkwright import gallery
from linkwright.words import Message, _

CHINESE = re.compile("[一-鿿]")
LATIN = re.compile(r"[A-Za-z][A-Za-z']{2,}")
#: Words of a sentence, which identifiers, units and symbols never are.
ENGLISH = re.compile(r"[a-z]{3,} [a-z]{2,} [a-z]{2,}")


def said(*arguments: str) -> str:
    """All that a command prints in Chinese."""
    ended = run(*arguments, "--lang", "zh")
    return ended.out + ended.err


def latin(text: str) -> set[str]:
    return {word.lower() for word in LATIN.findall(text)}


def test_every_title_of_the_gallery_is_chinese() -> None:
    """In the list and above every result; in English and in data the titles are those of the files."""
    own = {entry["name"]: entry["title"] for entry in data("gallery", "list")}
    english, chinese = (
        dict(row[:2] for row in map(cells, shown("gallery", "list", "--lang", language).splitlines()) if len(row) > 1)
        for language in ("en", "zh")
    )
    for name in every([*gallery.names(), *gallery.calculations(), *gallery.tasks()], least=80):
        assert english[name] == own[name]
        assert CHINESE.search(chinese[name]) and not ENGLISH.search(chinese[name]), name
    for command, name in (("beam", "propped_cantilever"), ("solve", "jaw_crusher_sixbar"), ("structure", "kite")):
        for language, titles in (("en", english), ("zh", chinese)):
            first = shown(command, f"gallery:{name}", "--lang", language).splitlines()[0]
            assert first.startswith(titles[name])


def test_frame_and_driver_have_their_words() -> None:
    asked = ["metrics", "gallery:jaw_crusher_sixbar", "--names", "instant_centre", "peak_input_torque"]
    english, chinese = shown(*asked), said(*asked)
    for noun in ("frame", "driver"):
        assert re.search(rf"\b{noun}\b", english) and not re.search(rf"\b{noun}\b", chinese)
        assert _(noun).translate("zh") in chinese


def test_the_driver_without_a_name_has_its_word() -> None:
    """Files with one driver give it no name; names that a file gives stay as they are."""
    assert "driver" not in said("structure", "gallery:jaw_crusher_sixbar")
    several = said("structure", "gallery:excavator")
    assert all(name in several for name in every(store.machine("excavator").drivers, least=2))


FOURBAR = """\
format: 1
name: Four-bar
frame: {points: {O1: [0 mm, 0 mm], O2: [400 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 100 mm}
  coupler: {points: [A, B], length: 350 mm, mass: 2 kg}
  rocker: {points: [O2, B], length: 250 mm}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s}
"""
DAMAGES = [
    ("length", "lenght"),
    ("mm", "mn"),
    (" rad/s", ""),
    ("links:", "links: 3\nlinkz:"),
    ("[O1, A]", "[O1]"),
    ("[A, B]", "[A, A]"),
    ("about: O1", "about: O9"),
    ("turn: crank", "turn: crnk"),
    ("turn: crank", "turn: crank, slide: x"),
    ("assembly: {B: left}", "assembly: {B: lft}"),
    ("format: 1", "format: 7"),
    ("frame:", "fram:"),
    ("driver:", "drivr:"),
    ("{", "{{"),
    ("  crank: ", "\tcrank: "),
    (": ", ":"),
]


def identifiers(schema: object) -> Iterator[str]:
    """Keys and words of model files."""
    if isinstance(schema, dict):
        for key, value in schema.items():
            if key in ("enum", "const"):
                yield from map(str, value if isinstance(value, list) else [value])
            elif key != "description":
                yield key
                yield from identifiers(value)
    elif isinstance(schema, list):
        for each in schema:
            yield from identifiers(each)


KEYS = latin(" ".join(identifiers(json.loads(json.dumps(lw.json_schema()))))) | {"yaml", "rpm"}


@pytest.mark.parametrize(("right", "wrong"), DAMAGES)
def test_findings_of_damaged_files_hold_no_english(right: str, wrong: str, tmp_path: Path) -> None:
    """Besides what the file itself holds, and the keys that it may hold."""
    assert right in FOURBAR
    path = tmp_path / "damaged.yaml"
    text = FOURBAR.replace(right, wrong, 1)
    path.write_text(text, encoding="utf-8")
    (file,) = data("check", str(path), code=1)["files"]
    lines = [line for line in said("check", str(path)).splitlines() if line.startswith("damaged.yaml:")]
    assert len(lines) == len(every(file["findings"]))
    for line in lines:
        told = line.removeprefix("damaged.yaml:")
        assert CHINESE.search(told), line
        assert latin(told) <= latin(text) | KEYS, line


def plain(value: object) -> Iterator[str]:
    """The texts among a value that are no sentences: names, paths, what was asked."""
    if isinstance(value, tuple | list):
        for each in value:
            yield from plain(each)
    elif type(value) is str:
        yield value


@pytest.mark.parametrize(
    "arguments",
    [
        ["solve", "gallery:crank_rocker", "--at", "30"],
        ["solve", "gallery:crank_rocker", "--at", "30 kg"],
        ["solve", "gallery:crank_rocker", "--columns", "xyz"],
        ["solve", "gallery:crank_rocker", "--steps", "0"],
        ["solve", "gallery:nothing_like_it"],
        ["study", "gallery:crank_rocker", "--vary", "crank.lenth=1..2 m:2"],
        ["study", "gallery:crank_rocker", "--vary", "crank.length=1..2 kg:2"],
        ["metrics", "gallery:crank_rocker", "--names", "peak_torque"],
        ["compare", "gallery:crank_rocker", "gallery:kite", "--of", "jaw"],
        ["export", "gallery:crank_rocker", "--output", "a.xyz"],
        ["export", "gallery:crank_rocker", "--output", "a.csv", "--curve", "spline"],
        ["machine", "gallery:crank_rocker", "--fluctuation", "0"],
        ["balance", "gallery:excavator", "--radius", "10mm"],
        ["draw", "gallery:crank_rocker", "--paths", "Q", "--output", "a.svg"],
        ["draw", "gallery:crank_rocker", "--overlay", "limitz", "--output", "a.svg"],
        ["draw", "gallery:crank_rocker", "--output", "a.svg", "--width", "3"],
        ["plot", "gallery:crank_rocker", "--kind", "torqe", "--output", "a.svg"],
        ["plot", "gallery:crank_rocker", "--kind", "reactions", "--output", "a.svg"],
        ["animate", "gallery:crank_rocker", "--output", "a.xyz"],
        ["grade", "no/key.json", "no.csv"],
        ["study", "gallery:slider_crank_offset", "--vary", "rod.length=0.01..0.2m:2", "--steps", "4"],
        ["draw", "gallery:crank_rocker", "--output", "d.xyz"],
        ["studio", "--no-browser", "--port", "99999"],
        ["optimize", "gallery:crank_rocker"],
        ["gallery", "shw"],
        ["solve", "gallery:crank_rocker", "--at", "1,5 deg"],
    ],
    ids=" ".join,
)
def test_refusals_hold_no_english(arguments: list[str]) -> None:
    """Besides the names in them, and what stands in the Chinese sentence of their code."""
    ended = run(*arguments, "--lang", "zh")
    assert ended.code in (1, 2) and ended.told is not None
    left = ended.err
    assert CHINESE.search(left)
    assert not ENGLISH.search(left)
    given = {text for value in ended.told.values.values() for text in plain(value) if LATIN.search(text)}
    for text in sorted({*given, *arguments, *gallery.names()}, key=len, reverse=True):
        left = left.replace(text, "")
    told = ended.told.sentence
    own = latin(Message(told.msgid).translate("zh")) if isinstance(told, Message) else set()
    assert latin(left) <= own | {"help", "crank", "slider", "cycle", "from", "rock"}, left


#: Units and symbols of results, roots of names.
SYMBOLS = {"rad", "mm", "min"}


@pytest.mark.parametrize(
    "task",
    [
        ["gallery:function_of_three_pairs"],
        ["slider_crank", "stroke=397.5 mm", "rod_ratio=3.55", "offset_ratio=0.305", "--mass", "2"],
        ["quick_return", "quick_return_ratio=1.5", "frame=300 mm", "stroke=400 mm", "rod=300 mm"],
        ["drag_link", "quick_return_ratio=1.8", "frame=100 mm"],
        ["toggle", "force_ratio=20", "distance=5 mm", "stroke=100 mm"],
        ["straight_line", "length=100 mm"],
        ["motion", "unit=mm", "angle_unit=deg", "poses=[[0, 0, 0], [40, 10, 30], [60, 40, 50], [70, 70, 80]]"],
    ],
    ids=lambda task: task[0].removeprefix("gallery:"),
)
def test_synthesis_is_chinese(task: list[str]) -> None:
    printed = said("synthesize", *task)
    assert CHINESE.search(printed) and set(LATIN.findall(printed)) <= SYMBOLS, printed


MISSING = """format: 1
frame: {points: {O1: [0 m, 0 m]}}
links: {crank: {length: 1 m}}
joints: {g: {kind: prismatic, guide: frame}, c: {kind: cam}, w: {kind: weld}, r: {kind: rack}}
loads: {s: {kind: spring}, f: {kind: force}}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""


@pytest.mark.parametrize("text", [MISSING, *(f"format: 1\nkind: {kind}\n" for kind in ("beam", "belt", "mounts"))])
def test_missing_keys_are_said_in_chinese(text: str, tmp_path: Path) -> None:
    """The key with YAML's colon, its quantity or form, and an example; the English description stays English."""
    path = tmp_path / "missing.yaml"
    path.write_text(text, encoding="utf-8")
    (file,) = data("check", str(path), code=1)["files"]
    printed = said("check", str(path)).splitlines()
    for found in every([each for each in file["findings"] if each["code"] == "missing-key"]):
        place = f"{found['where']}: {found['key']}: " if found["key"] else f"{found['where']}: "
        (key,) = re.findall(r'"(.*?)"', found["message"])
        (line,) = [each for each in printed if each.startswith(place) and f"{key}: " in each.removeprefix(place)]
        assert CHINESE.search(line) and not re.search("[A-Za-z]{2,} [a-z]{2,}", line.removeprefix(place)), line


@pytest.mark.parametrize(
    "arguments",
    [["validate", "--case", "conveyor"], ["metrics", "gallery:change_point_fourbar", "--steps", "6"]],
    ids=lambda arguments: arguments[0],
)
def test_results_are_chinese(arguments: list[str]) -> None:
    printed = said(*arguments)
    assert CHINESE.search(printed) and not ENGLISH.search(printed), printed
