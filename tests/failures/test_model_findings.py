"""What a model file must be refused for: the place, the key, the code and the values of every finding."""

import json
from pathlib import Path

import pytest
from tests import refusals
from tests.refusals import checked, faulty, refused, said

from linkwright import Finding, ModelError, check, load, loads
from linkwright.cli import main

MODEL = """\
format: 1
name: four-bar
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 3 m}
driver: {turn: crank, about: O1, speed: 10 rpm}
"""


def findings(text: str) -> list[Finding]:
    """Of a text, which is a machine where none is an error."""
    found = refusals.findings(text, "m.yaml")
    if any(each.severity == "error" for each in found):
        with pytest.raises(ModelError):
            loads(text, "m.yaml")
    else:
        loads(text, "m.yaml")
    return found


def changed(old: str, new: str) -> str:
    assert old in MODEL
    return MODEL.replace(old, new, 1)


def test_the_model_that_the_cases_change_is_right() -> None:
    assert findings(MODEL) == []


ONE_CHANGE = [
    ("length: 1 m", "lenght: 1 m", "5:28", "links.crank.lenght", "unknown-key", {"offer": "length"}),
    ("length: 1 m", "length: 1", "5:36", "links.crank.length", "missing-unit", {"right": "1 mm", "text": "1"}),
    (
        "length: 1 m",
        "length: 10%",
        "5:36",
        "links.crank.length",
        "wrong-dimension",
        {"wrong": "a dimensionless number", "noun": "a length", "text": "10%"},
    ),
    ("driver: {turn", "drivers: {turn", "8:10", "drivers", "choice", {"message": "the driver has no name"}),
    ("length: 1 m", "length: 1 kg", "5:36", "links.crank.length", "wrong-dimension", {"wrong": "a mass"}),
    ("length: 1 m", "length: 60,5 mm", "5:36", "links.crank.length", "decimal-comma", {"right": "60.5 mm"}),
    ("length: 1 m", 'length: "60,5 mm"', "5:37", "links.crank.length", "decimal-comma", {"right": "60.5 mm"}),
    (
        "[4 m, 0 m]",
        "[4,5 m, 0 m]",
        "3:38",
        "frame.points.O2",
        "decimal-comma",
        {"form": "[60.5 mm, 60.5 mm]", "found": 3},
    ),
    ("  rocker:", "  crank:", "7:3", "links.crank", "duplicate-key", {"line": 5}),
    (
        "[O2, B], length: 3 m",
        "[B]",
        "7:11",
        "links.rocker",
        "one-point",
        {"name": "rocker", "message": 'the link "{name}" has one point and is in no prismatic joint'},
    ),
    ("1 m}", "1 m, mass: -3 kg}", "5:47", "links.crank.mass", "range", {"fault": "negative", "shown": "-3 kg"}),
    ("1 m}", "1 m, inertia: 3 kg*m}", "5:50", "links.crank.inertia", "wrong-dimension", {"noun": "an inertia"}),
    ("length: 1 m", "length: 0 m", "5:36", "links.crank.length", "range", {"fault": "zero", "shown": "0 m"}),
    ("length: 1 m", "length: 0", "5:36", "links.crank.length", "range", {"fault": "zero", "shown": "0"}),
    ("length: 1 m", "length: -1 m", "5:36", "links.crank.length", "range", {"fault": "negative", "shown": "-1 m"}),
    ("length: 1 m", "length: .nan", "5:36", "links.crank.length", "not-finite", {"text": ".nan"}),
    ("length: 1 m", "length: .inf m", "5:36", "links.crank.length", "not-finite", {"text": ".inf m"}),
    ("length: 1 m", "length: 1e999 m", "5:36", "links.crank.length", "not-finite", {"text": "1e999 m"}),
    ("length: 1 m", "length: [1 m]", "5:36", "links.crank.length", "type", {"node": "a list"}),
    ("length: 1 m", "length:", "5:35", "links.crank.length", "type", {"node": "nothing"}),
    (
        ", length: 1 m",
        "",
        "5:10",
        "links.crank",
        "missing-key",
        {"message": "the link has no dimensions, and the drawing no place of {missing}", "missing": ("A",)},
    ),
    (
        "[A, B]",
        "[A, B, P]",
        "6:40",
        "links.coupler.length",
        "geometry",
        {"message": "{count} points, but one length", "count": 3},
    ),
    (
        "[O1, A]",
        "[O1, O1]",
        "5:24",
        "links.crank.points",
        "duplicate",
        {"message": 'the point "{name}" is listed twice', "name": "O1"},
    ),
    (
        "[O1, A]",
        "O1",
        "5:19",
        "links.crank.points",
        "type",
        {"message": "expected a list, not {node}", "form": "[A, B]"},
    ),
    (
        "[O1, A]",
        "[O1 A]",
        "5:20",
        "links.crank.points.0",
        "name",
        {"message": '"{text}" cannot be the name of a {what}', "right": "O1_A"},
    ),
    (
        "{points: [O1, A], length: 1 m}",
        "",
        "5:9",
        "links.crank",
        "type",
        {"message": "expected a mapping (key: value), not {node}"},
    ),
    (
        "about: O1",
        "about: B",
        "8:30",
        "driver.about",
        "reference",
        {"message": 'the link "{link}" has no pin at "{pin}"', "pins": ("O1", "A")},
    ),
    ("about: O1", "about: Q", "8:30", "driver.about", "unknown-name", {"names": ("O1", "O2", "A", "B")}),
    ("turn: crank", "turn: crnk", "8:16", "driver.turn", "unknown-name", {"offer": "crank"}),
    ("turn: crank", "turn: frame", "8:16", "driver.turn", "reference", {"message": "the frame does not move"}),
    ("10 rpm", "460 rmp", "8:45", "driver.speed", "unknown-unit", {"offer": "rpm"}),
    ("10 rpm", "10 Hz", "8:41", "driver.speed", "wrong-dimension", {"wrong": "a frequency"}),
    (", speed: 10 rpm", "", "8:9", "driver", "choice", {"message": "the driver has no law", "speed": "170 rpm"}),
    (
        "speed: 10 rpm",
        "speed: 10 rpm, position: 3 deg",
        "8:9",
        "driver",
        "choice",
        {"message": "{laws} are both present", "first": ("position",), "last": "speed"},
    ),
    ("speed: 10 rpm", "position: 30 deg*sin(om*t)", "8:55", "driver.position", "unknown-name", {"name": "om"}),
    ("format: 1", "format: 2", "1:9", "format", "version", {"key_": "format", "only": 1}),
    ("format: 1\n", "", "1:1", "format", "missing-key", {"message": 'the key "{key_}" is missing', "key_": "format"}),
    (
        "{points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}",
        "{points: [O1]}",
        "3:17",
        "frame.points",
        "type",
        {"message": "the frame's points have no coordinates"},
    ),
    (
        "name: four-bar",
        "name: !!python/object/apply:os.system [ls]",
        "2:7",
        "name",
        "tag",
        {"shown": "!!python/object/apply:os.system"},
    ),
    (
        "length: 1 m",
        "length: *x",
        "5:36",
        "",
        "alias",
        {"message": 'the alias "*{name}" has no anchor "&{name}" before it', "name": "x"},
    ),
    (
        "links:\n",
        "links: &l\n  loop: *l\n",
        "4:8",
        "links.loop",
        "alias",
        {"message": 'the alias "*{name}" is inside its own anchor', "name": "l"},
    ),
    ("name: four-bar", "expected: " + "[" * 60 + "]" * 60, "2:50", "", "depth", {"most": 40}),
    ("  crank:", "\tcrank:", "5:1", "", "tab", {"sign": "\t", "character": "U+0009"}),
    ("[O1, A]", "[O1, A", "5:38", "", "syntax", {"sign": "}"}),
    ("four-bar", '"four-bar', "2:7", "", "syntax", {"sign": '"'}),
    ("four-bar", "four: bar", "2:11", "", "syntax", {"sign": ":"}),
    ("four-bar", "four\x07bar", "2:11", "", "syntax", {"sign": "\u0007"}),
    ("driver:", "---\nformat: 1\n", "8:1", "", "documents", {}),
    ("crank:", "1:", "5:3", "links.1", "name", {"message": '"{text}" cannot be the name of a {what}', "right": "l1"}),
    ("crank:", "[a, b]:", "5:3", "links", "key", {}),
    (
        "driver:",
        "  spare: {points: [X, Y], length: 1 m}\ndriver:",
        "8:10",
        "links.spare",
        "unused",
        {"name": "spare", "points": "X, Y"},
    ),
]


@pytest.mark.parametrize(("old", "new", "place", "key", "code", "values"), ONE_CHANGE)
def test_one_wrong_thing_is_found_at_its_place(
    old: str, new: str, place: str, key: str, code: str, values: dict[str, object]
) -> None:
    found = next(each for each in findings(changed(old, new)) if each.code == code)
    assert found.where == f"m.yaml:{place}"
    assert key in (found.key, "") or found.key.startswith(key)
    said([found], code, **values)
    assert found.remedy


ADDED = [
    ("gravity: 9.81 m/s²", "gravity", "type", {"message": "expected a list, not {node}", "form": "[0, -9.81 m/s²]"}),
    (
        "gravity: [0 m/s²， -9.81 m/s²]",
        "gravity",
        "count",
        {"message": "expected {count} values, found {found}", "form": "[0, -9.81 m/s²]", "found": 1},
    ),
    ("gravity: [0, -9.81]", "gravity.y", "missing-unit", {"right": "-9.81 m/s²", "text": "-9.81"}),
    (
        "assembly: {B: links}",
        "assembly.B",
        "unknown-word",
        {"text": "links", "names": ("left", "right", "forward", "backward")},
    ),
    ("assembly: {b: left}", "assembly.b", "unknown-name", {"offer": "B"}),
    (
        "joints: {g: {kind: prismatic, guide: frame, through: O1, block: rocker, at: B}}",
        "joints.g.direction",
        "missing-key",
        {"message": 'the key "{key_}" is missing', "key_": "direction"},
    ),
    ("joints: {g: {kind: prismatik}}", "joints.g.kind", "unknown-word", {"offer": "prismatic"}),
    ("joints: {g: {guide: frame}}", "joints.g.kind", "missing-key", {"message": "the joint has no kind"}),
    ("joints: {C: {kind: revolute}}", "joints.C", "unknown-name", {"names": ("O1", "O2", "A", "B")}),
    (
        "joints: {B: {kind: revolute, friction: -0.1}}",
        "joints.B.friction",
        "range",
        {"fault": "negative", "shown": "-0.1"},
    ),
    (
        "joints: {crank: {kind: weld, links: [crank, coupler], at: A}}",
        "joints.crank",
        "duplicate",
        {"message": 'a link has the name "{name}" already', "name": "crank"},
    ),
    (
        "joints: {w: {kind: weld, links: [crank, rocker], at: A}}",
        "joints.w.at",
        "unknown-name",
        {"others": ("crank", "coupler")},
    ),
    ("loads: {l: {kind: forse}}", "loads.l.kind", "unknown-word", {"offer": "force"}),
    (
        "loads: {l: {kind: force, on: rocker, at: B, direction: 0, magnitude: 5 Nm}}",
        "loads.l.magnitude",
        "unknown-unit",
        {"offer": "N·m"},
    ),
    (
        "loads: {l: {kind: force, on: rocker, at: A, direction: 0, magnitude: 5 N}}",
        "loads.l.at",
        "unknown-name",
        {"points": ("O2", "B")},
    ),
    (
        "loads: {l: {kind: force, on: rocker, at: B, magnitude: 5 N}}",
        "loads.l",
        "choice",
        {"message": "none of {words} is set"},
    ),
    (
        "loads: {l: {kind: force, on: rocker, at: B, direction: 0, ramp: [0 N, 5 N]}}",
        "loads.l.ramp",
        "load",
        {"message": "a ramp needs a phase, and there is none"},
    ),
    (
        "loads: {l: {kind: force, on: rocker, at: B, in_link: 0, table: {over: rockr, x: [], y: []}}}",
        "loads.l.table.over",
        "unknown-name",
        {"text": "rockr", "offer": "rocker"},
    ),
    (
        "parameters: {a: b*2, b: 1 m}",
        "parameters.a",
        "unknown-name",
        {"message": '"{name}" is defined below', "name": "b"},
    ),
    ("parameters: {e: 1/0}", "parameters.e", "not-finite", {"message": '"{text}" divides by zero', "text": "1/0"}),
    (
        "parameters: {crank: 1 m}",
        "parameters.crank",
        "duplicate",
        {"message": 'a link or joint has the name "{name}" already', "name": "crank"},
    ),
    (
        "cycle: {from: 90 deg, to: 0 deg}",
        "cycle",
        "range",
        {
            "message": "the driver does not move from the first value to the last",
            "remedy": "exchange from and to, or turn the sign of the speed",
        },
    ),
    ("cycle: {duration: -1 s}", "cycle.duration", "range", {"fault": "negative", "shown": "-1 s"}),
    ("drawing: {Q: [1 m, 0 m]}", "drawing.Q", "unknown-name", {"names": ("O1", "O2", "A", "B"), "name": "Q"}),
    ("drivers: {}", "drivers", "choice", {"message": "driver and drivers are both present"}),
    ("speed: 3 rpm", "speed", "unknown-key", {"key_": "speed"}),
]


@pytest.mark.parametrize(("line", "key", "code", "values"), ADDED)
def test_one_wrong_section_is_found(line: str, key: str, code: str, values: dict[str, object]) -> None:
    found = said(findings(f"{MODEL}{line}\n"), code, key, **values)
    assert found.where.startswith("m.yaml:9:")


def test_all_findings_come_at_once() -> None:
    text = (
        changed("length: 1 m", "lenght: 1 m")
        .replace("3.5 m", "3,5 m")
        .replace("10 rpm", "10")
        .replace("3 m}", "-3 m}")
    )
    codes = {each.code for each in findings(text)}
    assert {"unknown-key", "decimal-comma", "missing-unit", "range"} <= codes


def test_a_broken_link_brings_no_findings_about_what_refers_to_it() -> None:
    assert [each.key for each in findings(changed("[O1, A]", "O1"))] == ["links.crank.points"]


@pytest.mark.parametrize("text", ["", "# only a comment\n", "---\n", "\ufeff", "   \n\n"])
def test_an_empty_text_is_called_empty(text: str) -> None:
    assert [each.code for each in findings(text)] == ["empty"]


@pytest.mark.parametrize("text", ["- a\n- b\n", "hello\n", "a,b,c\n1,2,3\n", "<html></html>", "42"])
def test_what_is_no_mapping_is_refused(text: str) -> None:
    assert [each.code for each in findings(text)] == ["type"]


SECTIONS = (
    "format",
    "name",
    "purpose",
    "source",
    "expected",
    "parameters",
    "frame",
    "links",
    "joints",
    "assembly",
    "drawing",
    "driver",
    "drivers",
    "cycle",
    "gravity",
    "loads",
)
WRONG = [
    "",
    "[]",
    "{}",
    "[[]]",
    "[{}]",
    "{a: }",
    "{a: []}",
    "{a: {}}",
    "{1: 2}",
    "{a: [1, 2]}",
    "{a: {b: {c: d}}}",
    "3",
    "true",
    "~",
    "[~]",
    "'x'",
    "{points: }",
    "{points: [~]}",
    "{points: {A: [~, {}]}}",
    "{a: {kind: force}}",
    "{a: {kind: [x]}}",
    "{a: {kind: prismatic, guide: [a], at: {}}}",
    "{turn: [], about: {}}",
    "{slide: []}",
    "{a: {points: [A], also: [3]}}",
    "{a: {kind: weld, links: {}, at: []}}",
    "2024-01-01",
    "!!binary aGk=",
    "!x {a: 1}",
    "{? [a] : b}",
    "{<<: 3}",
    "{<<: [1, {a: 2}]}",
]


@pytest.mark.rotating
@pytest.mark.parametrize("section", SECTIONS)
@pytest.mark.parametrize("value", WRONG)
def test_any_value_in_any_section_gives_findings_or_a_mechanism(section: str, value: str) -> None:
    lines = [line for line in MODEL.split("\n") if not line.startswith(section)]
    if section == "links":
        lines = [line for line in lines if not line.startswith("  ")]
    found = findings("\n".join([*lines, f"{section}: {value}"]))
    assert all(each.where.startswith("m.yaml:") and each.message for each in found)


def test_anchors_aliases_and_merge_keys_are_read() -> None:
    text = changed("crank: {points: [O1, A], length: 1 m}", "crank: &c {points: [O1, A], length: &l 1 m}")
    text = text.replace("coupler: {points: [A, B], length: 3.5 m}", "coupler: {<<: *c, points: [A, B]}")
    assert loads(text).links["coupler"].lengths == (1.0,)


def test_an_exploding_alias_is_stopped() -> None:
    lines = ["a: &a [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"{chr(98 + i)}: &{chr(98 + i)} [{', '.join(['*' + chr(97 + i)] * 10)}]" for i in range(9)]
    assert "size" in {each.code for each in findings("\n".join(lines))}


@pytest.mark.parametrize(
    ("content", "code", "data"),
    [
        ("# caf\xe9\n".encode("latin-1"), "encoding", "5"),
        (MODEL.replace("four", "b\x96r").encode("cp1252", "replace").replace(b"?", b"\x96"), "encoding", "0x96"),
        (MODEL.encode("utf-16"), "encoding", "UTF-16"),
        (bytes(range(256)), "encoding", ""),
        (b"x" * 5_000_001, "size", "5 MB"),
    ],
)
def test_a_file_that_is_no_utf8_text_is_refused(tmp_path: Path, content: bytes, code: str, data: str) -> None:
    path = tmp_path / "m.yaml"
    path.write_bytes(content)
    (found,) = check(path)
    assert found.code == code and data in found.message + found.remedy


def test_a_missing_file_offers_the_nearest(tmp_path: Path) -> None:
    (tmp_path / "press.yaml").write_text(MODEL)
    for missing, offer, around in (
        (tmp_path / "pres.yaml", "press.yaml", ()),
        (tmp_path / "press", "press.yaml", ("presses",)),
        ("gallery:jaw_crusher_sixba", "gallery:jaw_crusher_sixbar", ()),
    ):
        for folder in around:
            (tmp_path / folder).mkdir()
        with pytest.raises(ModelError) as caught:
            load(missing)
        said(caught.value.findings, "no-file", offer=offer)
    with refused("not-a-file", ModelError):
        load(tmp_path)


@pytest.mark.parametrize("text", [MODEL.replace("\n", "\r\n"), "\ufeff" + MODEL, MODEL.replace("crank", "曲柄")])
def test_line_ends_marks_and_scripts_do_not_matter(text: str) -> None:
    assert findings(text) == []


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("format：1\nname：x\nframe：{points: {O: [0 m, 0 m]}}\n", ["1:7 ：", "2:5 ：", "3:6 ："]),
        ("format: 1\nframe: {points: {O: [0 m，0 m]}}\nlinks:\n  crank： {points: [O, A]}\n", ["2:25 ，", "4:8 ："]),
        ("format: 1\nname: 牛头刨床：导杆（一）  # ：，\nframe: {points: {O: [0 m, 0 m]}｝\n", ["3:32 ｝"]),
    ],
)
def test_full_width_punctuation_is_named_where_it_stands(text: str, places: list[str]) -> None:
    """As a Chinese keyboard writes it; in titles, quotes and remarks it is no matter."""
    found = refusals.findings(text, "m.yaml")
    assert [
        f"{each.where.partition(':')[2]} {place[-1]}" for each, place in zip(found, places, strict=True)
    ] == places
    assert [each.values["wide"] for each in found] == [place[-1] for place in places]


def test_an_assembly_that_nothing_says_is_noted(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    for line, noted in (("", True), ("assembly: {B: left}\n", False), ("drawing: {B: [3 m, 2 m]}\n", False)):
        file.write_text(MODEL + line, encoding="utf-8")
        code, found = checked(file)
        assert code == 0 and [each.severity for each in found] == ["note"] * noted
        assert all("coupler, rocker" in each.message for each in found)


def test_a_wheel_on_the_frame_needs_no_mass_beside_its_inertia() -> None:
    """Its mass centre stands still; a link whose mass centre moves has a mass as well."""
    wheel = MODEL.replace("  crank:", "  wheel: {points: [O1], inertia: 0.01 kg·m²}\n  crank:")
    assert not [each for each in refusals.findings(wheel) if each.code == "unlikely"]
    massless = findings(changed("length: 1 m}", "length: 1 m, inertia: 0.01 kg·m²}"))
    said(massless, "unlikely", "links.crank.inertia", message="a link without mass has a moment of inertia")


def test_a_crank_driven_about_the_wrong_pin_is_asked_about() -> None:
    """About its outer pin a crank is driven against the coupler, which is seldom meant; said, it is taken."""
    text = """
format: 1
frame: {points: {O: [0 mm, 0 mm], Q: [300 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 80 mm}
  coupler: {points: [A, B], length: 280 mm}
  rocker: {points: [Q, B], length: 200 mm}
driver: {turn: crank, about: A, speed: 90 rpm}
"""
    found = said(findings(text), "doubtful", "driver.about", link="crank", pin="A", other="coupler", held="O")
    assert found.where == "m.yaml:8:30" and found.severity == "warning"
    for meant in ("about: A, relative_to: coupler", "about: O"):
        told = findings(text.replace("about: A", meant))
        assert all(each.code != "doubtful" for each in told)


@pytest.mark.parametrize(
    ("length", "code", "values"),
    [
        (
            "“1 m”",
            "expression",
            {"remedy": "write the quotation mark {half} in place of {wide}, or none", "text": "“", "half": '"'},
        ),
        (
            "1_000 mm",
            "quantity",
            {"message": '"{plain}" has a separator inside the number', "digits": "1", "rest": "000 mm"},
        ),
        ("1,000 mm", "decimal-comma", {"right": "1.000 mm", "without_comma": "1000 mm"}),
        ("1,000,000 mm", "decimal-comma", {"remedy": 'write "{without_comma}"', "without_comma": "1000000 mm"}),
        ("1，5 m", "decimal-comma", {"remedy": 'write a point: "{right}"', "right": "1.5 m"}),
        ("25 mm ± 0.1 mm", "quantity", {"message": '"{plain}" holds a tolerance'}),
        ("5 ㎜", "unknown-unit", {"offer": "mm"}),
        ("5 ｋｍ", "unknown-unit", {"offer": "km"}),
    ],
)
def test_a_length_as_it_is_found_elsewhere_is_told_how_it_is_written(
    length: str, code: str, values: dict[str, object]
) -> None:
    written = f'length: "{length}"' if "," in length else f"length: {length}"
    (found,) = findings(MODEL.replace("length: 1 m", written))
    said([found], code, "links.crank.length", **values)


def test_parameters_that_need_one_another_are_told_once_with_their_circle() -> None:
    told = findings(MODEL.replace("links:", "parameters: {a: d, b: a*2, d: e + 1 m, e: a, f: f}\nlinks:"))
    said(told, "circle", "parameters.a", name="a", ring="a → d → e → a")
    said(told, "circle", "parameters.f", name="f", ring="f → f")
    assert not [each for each in told if each.severity == "error" and each.code != "circle"]


@pytest.mark.parametrize("joined", ["length:1 m", "length=1 m", "length = 1 m"])
def test_a_value_that_stands_with_its_key_as_one_word_is_told(joined: str) -> None:
    (found,) = findings(MODEL.replace("length: 1 m", joined))
    said([found], "syntax", "links.crank.length", key_="length", rest="1 m")


def test_an_unfinished_merge_is_told_at_its_marks() -> None:
    text = MODEL.replace("links:", "<<<<<<< HEAD\nlinks:\n=======\nlinks:\n>>>>>>> other branch\n")
    begin = MODEL.index("links:")
    first = MODEL.count("\n", 0, begin) + 1
    assert [(each.where, each.code) for each in findings(text)] == [
        (f"m.yaml:{first + more}:1", "conflict") for more in (0, 2, 4)
    ]
    assert findings(MODEL.replace("name: ", "name: about ======= and <<<<<<< ")) == []


@pytest.mark.parametrize("blank", ["\u00a0\u00a0", "\u3000", " \u00a0", "\u200b  "])
def test_blanks_in_the_indentation_that_are_no_spaces_are_told(blank: str) -> None:
    """As copying from web pages and Chinese keyboards make them; text may begin its paragraphs with them."""
    lines = MODEL.split("\n")
    numbers = [at + 1 for at, line in enumerate(lines) if line.startswith("  ") and line[2] != " "]
    text = "\n".join(blank + line[2:] if at + 1 in numbers else line for at, line in enumerate(lines))
    assert [each.where.split(":")[1] for each in findings(text)] == [str(each) for each in numbers][:10]
    assert {each.code for each in findings(text)} == {"blank"}
    assert findings(f"{MODEL}report:\n  text:\n    task: |\n      \u3000\u3000本设计的要求：\n") == []


@pytest.mark.parametrize("command", ["tolerance", "beam", "trajectory"])
def test_a_model_is_no_calculation_and_told_so(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "press.yaml"
    messages = []
    for text in (MODEL, "format: 1\nname: x\n"):
        path.write_text(text)
        assert main([command, str(path), "--json"]) == 1
        (found,) = json.loads(capsys.readouterr().out)["findings"]
        assert (found["key"], found["code"]) == ("kind", "kind")
        messages.append(found["message"])
    assert messages[0] != messages[1]


@pytest.mark.parametrize("weight", ["200 N", "0.2 kN", "2*100 N"])
def test_a_weight_is_told_how_it_is_written_as_a_mass(weight: str) -> None:
    (found,) = findings(changed("length: 1 m", f"length: 1 m, mass: {weight}, inertia: 0"))
    assert found.key == "links.crank.mass" and found.code == "wrong-dimension"
    right = found.remedy.split('"')[1]
    model = loads(changed("length: 1 m", f"length: 1 m, mass: {right}, inertia: 0"))
    assert model.links["crank"].mass == pytest.approx(200 / 9.81, rel=1e-12)


@pytest.mark.parametrize(("weight", "newtons"), [("50 kg", 490.5), ("2 lb", 8.896443230521), ("3 kgf", 29.41995)])
def test_a_mass_is_told_how_it_is_written_as_a_weight(weight: str, newtons: float) -> None:
    load = "loads: {{push: {{kind: force, on: crank, at: A, direction: 0 deg, magnitude: {}}}}}\n".format
    right = weight
    if not weight.endswith("kgf"):
        (found,) = findings(MODEL + load(weight))
        assert found.key == "loads.push.magnitude" and found.code == "wrong-dimension"
        right = found.remedy.split('"')[1]
    (force,) = loads(MODEL + load(right)).loads.values()
    assert force.magnitude.size.value == pytest.approx(newtons, rel=1e-12)  # type: ignore[attr-defined, union-attr]


def test_a_parameter_without_its_unit_is_named_as_the_place_to_mend() -> None:
    (found,) = findings(changed("length: 1 m", "length: r").replace("links:", "parameters: {r: 1}\nlinks:"))
    said(
        [found],
        "wrong-dimension",
        "links.crank.length",
        remedy='give the parameter "{name}" its unit under parameters',
        name="r",
    )


@pytest.mark.parametrize(
    ("joint", "severity", "data"),
    [
        ("A: {kind: revolute, friction: 0.1}", "error", "pin_radius"),
        ("A: {kind: revolute, friction: 5, pin_radius: 5 mm}", "warning", "5"),
    ],
)
def test_check_finds_friction_that_gives_no_forces(joint: str, severity: str, data: str, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(f"{MODEL}assembly: {{B: left}}\njoints:\n  {joint}\n", encoding="utf-8")
    code, found = checked(path)
    (told,) = (each for each in found if each.key == "joints.A.friction")
    assert code == int(severity == "error") and told.severity == severity
    assert told.where.startswith("m.yaml:11:") and data in told.message + told.remedy


def test_of_a_block_without_its_guide_no_inertia_is_missed() -> None:
    told = findings(
        "format: 1\nframe: {points: {O: [0 m, 0 m]}}\n"
        "links:\n  crank: {points: [O, A], length: 1 m}\n  rod: {points: [A, B], length: 3 m}\n"
        "  piston: {points: [B], mass: 2 kg}\ndriver: {turn: crank, about: O, speed: 10 rpm}\n"
    )
    assert [each.code for each in told] == ["one-point"]


def test_coordinates_for_the_name_of_a_point_are_one_finding() -> None:
    load = "loads: {push: {kind: force, on: crank, at: [1 m, 0 m], direction: 0 deg, magnitude: 3 N}}\n"
    (found,) = findings(MODEL + load)
    said(
        [found],
        "type",
        "loads.push.at",
        message="coordinates stand where the name of a point is needed",
        link="crank",
    )


def test_a_frame_among_the_links_is_one_finding() -> None:
    frame = "frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}\n"
    (found,) = findings(MODEL.replace(frame, "").replace("links:\n", f"links:\n  {frame}"))
    said([found], "name", "links.frame", message="the frame is listed among the links")
    assert found.where == "m.yaml:4:3" and "frame: {" in found.remedy
    (twice,) = findings(MODEL.replace("links:\n", "links:\n  frame: {points: [O1]}\n"))
    assert twice.key == "links.frame"


@pytest.mark.parametrize("driver", ["{crank: 10 rpm}", "{link: crank, speed: 10 rpm}", "{joint: O1}"])
def test_a_driver_told_in_other_words_is_shown_how_it_is_written(driver: str) -> None:
    found = findings(changed("{turn: crank, about: O1, speed: 10 rpm}", driver))
    said(found, "missing-key", "driver", remedy="write turn: {link} and about: {pin}", link="crank", pin="O1")


@pytest.mark.parametrize("section", ["optimize", "report", "course", "expected", "cycle", "loads"])
def test_a_section_with_nothing_in_it_is_told(section: str) -> None:
    (found,) = findings(f"{MODEL}{section}:\n")
    said([found], "type", section, node="nothing")


def test_a_calculation_of_the_gallery_is_told_to_be_one() -> None:
    assert check("gallery:cantilever") == []
    with faulty("kind", "kind", kind="beam", command="beam") as caught:
        load("gallery:cantilever")
    assert caught.value.findings[0].where == "cantilever.yaml:2:7"


@pytest.mark.parametrize(("points", "warned"), [("O1, M, A", True), ("O1, A, M", False)])
def test_a_mass_centre_that_is_not_the_middle_is_asked_for(points: str, warned: bool) -> None:
    """A bar with a pin in its middle has its default centre there only where its ends are named first."""
    places = {"O1": "[0 m, 0 m]", "M": "[0.5 m, 0 m]", "A": "[1 m, 0 m]"}
    bar = ", ".join(f"{name}: {places[name]}" for name in points.split(", "))
    found = findings(
        changed("{points: [O1, A], length: 1 m}", f"{{points: {{{bar}}}, mass: 2 kg, inertia: 0.2 kg·m²}}")
    )
    assert [each.key for each in found] == ["links.crank.mass_centre"] * warned
    assert all((each.values["first"], each.values["second"]) == ("O1", "M") for each in found)


@pytest.mark.parametrize(
    ("right", "given", "key", "values"),
    [
        (
            "length: 1 m",
            "length 1 m",
            "links.crank.length",
            {"remedy": "write a colon and a space between them: {key_}: {rest}", "rest": "1 m"},
        ),
        (
            "speed: 10 rpm",
            "speed: 10 rpm ccw",
            "driver.speed",
            {"remedy": ("the sign says the sense: positive is counter-clockwise, negative (-120 rpm) clockwise")},
        ),
        (
            "speed: 10 rpm",
            "speed: 10 rpm clockwise",
            "driver.speed",
            {"remedy": ("the sign says the sense: positive is counter-clockwise, negative (-120 rpm) clockwise")},
        ),
        (
            "speed: 10 rpm",
            "speed: 10 rpm, start: up",
            "driver.start",
            {
                "remedy": (
                    "a direction is an angle, counter-clockwise from x: right 0 deg, up 90 deg, left 180 "
                    "deg, down -90 deg"
                )
            },
        ),
    ],
)
def test_slips_of_students_are_one_finding_that_says_what_to_write(
    right: str, given: str, key: str, values: dict[str, object]
) -> None:
    """A colon left out was two findings; a sense was a misspelt unit; "up" was taken for "pi"."""
    (found,) = findings(MODEL.replace(right, given))
    said([found], found.code, key, **values)
