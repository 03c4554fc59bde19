"""Slips that are usual in YAML and in models: one finding, at the place of the slip, with what to write."""

import pytest
from tests.refusals import said

import linkwright as lw

MODEL = """\
format: 1
name: Crank-rocker
frame:
  points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}
links:
  crank:
    points: [O1, A]
    length: 1 m
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s}
"""
WIDE = "\u3000"
#: What is changed, into what, where the finding is; its key, code and values.
OF_YAML = [
    ("    length: 1 m", "\tlength: 1 m", "8:1", "", "tab", {"sign": "\t", "character": "U+0009"}),
    (
        "    length: 1 m",
        "    length:1 m",
        "8:5",
        "",
        "syntax",
        {"message": 'there is no space after the colon of "{key_}"', "key_": "length", "rest": "1 m"},
    ),
    (
        "about: O1",
        "about:O1",
        "12:23",
        "driver.about",
        "syntax",
        {"message": 'the key "{key_}" and its value stand together as one key', "key_": "about", "rest": "O1"},
    ),
    (
        "points: [O1, A]",
        "points:[O1, A]",
        "7:5",
        "",
        "syntax",
        {"message": 'there is no space after the colon of "{key_}"', "key_": "points", "rest": "[O1, A]"},
    ),
    (
        "assembly: {",
        "assembly:{",
        "11:1",
        "assembly",
        "syntax",
        {
            "message": 'the key "{key_}" and its value stand together as one key',
            "key_": "assembly",
            "rest": "{B: left}",
        },
    ),
    (
        "[O1, A]",
        "[O1, A",
        "8:11",
        "",
        "syntax",
        {"message": "a list in brackets is not closed or a comma is missing", "line": 7},
    ),
    (
        "speed: 10 rad/s}",
        "speed: 10 rad/s",
        "12:9",
        "",
        "syntax",
        {"message": "a mapping in braces is not closed or a comma is missing", "sign": "{"},
    ),
    ("length: 1 m", 'length: "1 m', "8:13", "", "syntax", {"message": "a quoted text is not closed", "sign": '"'}),
    ("name: Crank", "name: 'Crank", "2:7", "", "syntax", {"message": "a quoted text is not closed", "sign": "'"}),
    (
        "    length: 1 m",
        "   length: 1 m",
        "8:4",
        "",
        "syntax",
        {
            "message": ("the indentation does not fit the lines above, or a bracket is closed that was not opened"),
            "line": 6,
            "sign": "l",
        },
    ),
    (
        "    length: 1 m",
        "  length: 1 m",
        "8:3",
        "links.length",
        "misplaced",
        {"message": '"{key_}" is at the level of "{name}", not in it', "name": "crank"},
    ),
    ("  rocker:", "  coupler:", "10:3", "links.coupler", "duplicate-key", {"line": 9}),
    ("length: 3 m}", "length: 3 m, length: 4 m}", "10:42", "links.rocker.length", "duplicate-key", {"line": 10}),
    (
        "    length: 1 m",
        "    length：1 m",
        "8:11",
        "",
        "syntax",
        {"message": 'the full-width character "{wide}" is not punctuation of YAML', "half": ": ", "wide": "："},
    ),
    (
        "[O1, A]",
        "[O1，A]",
        "7:14",
        "links.crank.points.0",
        "name",
        {"message": '"{text}" cannot be the name of a {what}', "half": ",", "wide": "，"},
    ),
    ("    length: 1 m", f"{WIDE}{WIDE}length: 1 m", "8:1", "", "blank", {"character": "U+3000"}),
    (
        "    length: 1 m",
        f"    length:{WIDE}1 m",
        "8:5",
        "",
        "syntax",
        {"message": 'the blank after the colon of "{key_}" is not a space ({character})', "character": "U+3000"},
    ),
    (
        "length: 1 m",
        "length: （1 m）",
        "8:13",
        "links.crank.length",
        "expression",
        {"message": '"{text}" is not part of an expression', "half": "(", "wide": "（", "text": "（"},
    ),
    (
        "length: 1 m",
        "length: %1 m",
        "8:13",
        "",
        "syntax",
        {"message": 'the character "{sign}" cannot begin a value', "sign": "%"},
    ),
    ("format: 1", "%format: 1", "1:1", "", "syntax", {"message": 'a line cannot begin with "{sign}"', "sign": "%"}),
    (
        "    length: 1 m",
        "    @length: 1 m",
        "8:5",
        "",
        "syntax",
        {"message": 'the character "{sign}" cannot begin a value', "sign": "@"},
    ),
    (
        "name: Crank-",
        "name: *Crank* ",
        "2:7",
        "",
        "syntax",
        {"message": 'the character "{sign}" cannot begin a value', "sign": "*"},
    ),
    (
        "[O1, A]",
        "\n      - O1\n      -A",
        "9:7",
        "",
        "syntax",
        {"message": "there is no space after the dash of a list's item", "rest": "A"},
    ),
    (
        "length: 1 m",
        "length: - 1 m",
        "8:13",
        "",
        "syntax",
        {"message": "an item of a list cannot begin in the middle of a line", "sign": "-"},
    ),
    ("  crank:", "  - crank:", "9:3", "", "syntax", {"message": "an entry of a list has no dash", "line": 6}),
    (
        "length: 1 m",
        "length: “1 m”",
        "8:13",
        "links.crank.length",
        "expression",
        {"message": '"{text}" is not part of an expression', "wide": "“", "half": '"', "text": "“"},
    ),
    (
        "name: Crank-rocker",
        "name: “Crank: rocker”",
        "2:1",
        "",
        "syntax",
        {"message": "the quotation mark {sign} is none of YAML", "sign": "“"},
    ),
    (
        "    length: 1 m",
        "    length = 1 m",
        "8:5",
        "",
        "syntax",
        {"message": 'an equals sign follows the key "{key_}"', "key_": "length", "rest": "1 m"},
    ),
    ("    length: 1 m", "    length 1 m", "8:5", "", "syntax", {"message": "a key without a colon", "sign": "l"}),
    (
        "    length: 1 m",
        "    // long\n    length: 1 m",
        "8:5",
        "",
        "syntax",
        {"message": 'a line cannot begin with "{sign}"', "character": "U+002F", "sign": "//"},
    ),
]


def findings(text: str) -> tuple[lw.Finding, ...]:
    with pytest.raises(lw.ModelError) as caught:
        lw.loads(text, "m.yaml")
    return caught.value.findings


def the_one(old: str, new: str) -> lw.Finding:
    """The only finding about a change of the model."""
    assert old in MODEL
    (found,) = findings(MODEL.replace(old, new, 1))
    return found


def test_the_model_itself_is_right() -> None:
    assert lw.structure(lw.loads(MODEL)).mobility == 1


@pytest.mark.parametrize(("old", "new", "place", "key", "code", "values"), OF_YAML)
def test_a_slip_is_one_finding_at_its_place(
    old: str, new: str, place: str, key: str, code: str, values: dict[str, object]
) -> None:
    found = the_one(old, new)
    said([found], code, key, **values)
    assert found.where == f"m.yaml:{place}"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("    length: 1 m", "    length:1 m"),
        ("points: [O1, A]", "points:[O1, A]"),
        ("    length: 1 m", "    length = 1 m"),
        ("assembly: {B: left}", "assembly:{B: left}"),
    ],
)
def test_what_to_write_is_what_stood_there_before(old: str, new: str) -> None:
    assert the_one(old, new).remedy.endswith(old.strip())


def test_values_that_stand_beside_their_element_are_read_in_it() -> None:
    load = "loads:\n  braking:\n    kind: torque\n  on: rocker\n  magnitude: 3 kg\n"
    told = findings(MODEL + load)
    assert len(told) == 3
    said(
        told,
        "misplaced",
        "loads.on",
        message='"{key_}" is at the level of "{name}", not in it',
        name="braking",
        key_="on",
    )
    said(told, "wrong-dimension", "loads.braking.magnitude", text="3 kg")


@pytest.mark.parametrize(
    ("table", "values"),
    [
        (
            "O1: {kind: revolute, links: [frame, crank]}",
            {"remedy": 'remove it: they have the point "{pin}" already', "pin": "O1", "keys": ("links",)},
        ),
        (
            "O1: {kind: revolute, parent: frame, child: crank}",
            {"remedy": 'remove it: they have the point "{pin}" already', "keys": ("parent", "child")},
        ),
        (
            "P: {kind: revolute, between: [frame, crank], at: O1}",
            {
                "remedy": 'remove it, and name a point of {links} "{pin}": points: [{pin}, …]',
                "pin": "P",
                "keys": ("between", "at"),
                "links": "frame and crank",
            },
        ),
        (
            "O1: {kind: revolute, links: [frame, rocker]}",
            {"remedy": 'remove it, and name a point of {links} "{pin}": points: [{pin}, …]', "links": "rocker"},
        ),
    ],
)
def test_a_pin_is_said_to_join_the_links_that_have_its_point(table: str, values: dict[str, object]) -> None:
    (found,) = findings(f"{MODEL}joints:\n  {table}\n")
    said(
        [found],
        "unknown-key",
        found.key,
        message="a pin joins the links that have a point of its name, and takes no key {keys}",
        **values,
    )


@pytest.mark.parametrize(
    ("driver", "values"),
    [
        ("turn: crank, joint: O1, ", {"key_": "joint", "offer": "about"}),
        ("turn: crank, pivot: O, ", {"key_": "pivot", "offer": "about"}),
        ("turn: crank, at: O1, ", {"key_": "at", "offer": "about"}),
        ("joint: O1, ", {"remedy": "write turn: {link} and about: {pin}", "link": "crank", "pin": "O1"}),
        ("joint: O, ", {"remedy": "add turn: LINK and about: PIN, or slide: JOINT, or between: [POINT, POINT]"}),
        ("link: crank, joint: O1, ", {"remedy": "write turn: {link} and about: {pin}", "link": "crank", "pin": "O1"}),
    ],
)
def test_a_driver_in_other_words_is_one_finding(driver: str, values: dict[str, object]) -> None:
    found = the_one("turn: crank, about: O1, ", driver)
    said([found], found.code, **values)


def test_a_key_that_says_something_else_takes_the_place_of_none() -> None:
    told = findings(MODEL.replace("about: O1", "colour: [1, 2, 3]"))
    assert [(each.key, each.code) for each in told] == [
        ("driver.colour", "unknown-key"),
        ("driver.about", "missing-key"),
    ]


@pytest.mark.parametrize("twice", ["crank", "coupler"])
def test_nothing_follows_from_a_name_that_two_links_have(twice: str) -> None:
    load = "loads: {braking: {kind: torque, on: rocker, magnitude: 3 N*m}}\n"
    (found,) = findings(MODEL.replace("  rocker:", f"  {twice}:") + load)
    assert found.code == "duplicate-key"
