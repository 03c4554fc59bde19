"""Slips that are usual in YAML and in models: one finding, at the place of the slip, with what to write."""

import re

import pytest

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
#: What is changed, into what, where the finding is, what it says.
OF_YAML = [
    ("    length: 1 m", "\tlength: 1 m", "8:1", "a tab in the indentation; indent with spaces"),
    ("    length: 1 m", "    length:1 m", "8:5", 'after the colon of "length"; write length: 1 m'),
    ("about: O1", "about:O1", "12:23", "write a colon and a space between them: about: O1"),
    ("points: [O1, A]", "points:[O1, A]", "7:5", "write points: [O1, A]"),
    ("assembly: {", "assembly:{", "11:1", "assembly: {B: left}"),
    ("[O1, A]", "[O1, A", "8:11", "(it began in line 7); separate entries by commas and close with ]"),
    ("speed: 10 rad/s}", "speed: 10 rad/s", "12:9", "separate entries by commas and close with }"),
    ("length: 1 m", 'length: "1 m', "8:13", "a quoted text is not closed; add the closing quote"),
    ("name: Crank", "name: 'Crank", "2:7", "a quoted text is not closed; add the closing quote"),
    ("    length: 1 m", "   length: 1 m", "8:4", "indent entries of one level by the same number of spaces"),
    ("    length: 1 m", "  length: 1 m", "8:3", 'indent it further than "crank:"'),
    ("  rocker:", "  coupler:", "10:3", "it stands in line 9 already; remove or rename one"),
    ("length: 3 m}", "length: 3 m, length: 4 m}", "10:42", "it stands in line 10 already"),
    ("    length: 1 m", "    length：1 m", "8:11", 'write ": " in place of "："'),
    ("[O1, A]", "[O1，A]", "7:14", 'write "," in place of "，"'),
    ("    length: 1 m", f"{WIDE}{WIDE}length: 1 m", "8:1", "(U+3000); indent with spaces"),
    ("    length: 1 m", f"    length:{WIDE}1 m", "8:5", "(U+3000); write a space there"),
    ("length: 1 m", "length: （1 m）", "8:13", 'write "(" in place of "（"'),
    (
        "length: 1 m",
        "length: %1 m",
        "8:13",
        'the character "%" cannot begin a value; put the value in quotes',
    ),
    ("format: 1", "%format: 1", "1:1", 'a line cannot begin with "%"'),
    ("    length: 1 m", "    @length: 1 m", "8:5", 'the character "@" cannot begin a value'),
    ("name: Crank-", "name: *Crank* ", "2:7", 'the character "*" cannot begin a value'),
    ("[O1, A]", "\n      - O1\n      -A", "9:7", "write - A"),
    ("length: 1 m", "length: - 1 m", "8:13", "a minus without a space behind it"),
    ("  crank:", "  - crank:", "9:3", "an entry without a dash stands in a list (it began in line 6)"),
    ("length: 1 m", "length: “1 m”", "8:13", 'write the quotation mark " in place of “, or none'),
    ("name: Crank-rocker", "name: “Crank: rocker”", "2:1", "the quotation mark “ is none of YAML"),
    ("    length: 1 m", "    length = 1 m", "8:5", "write length: 1 m"),
    ("    length: 1 m", "    length 1 m", "8:5", 'a key without a colon; write "key: value"'),
    ("    length: 1 m", "    // long\n    length: 1 m", "8:5", "begin a comment with #"),
]


def findings(text: str) -> tuple[lw.Finding, ...]:
    with pytest.raises(lw.ModelError) as caught:
        lw.loads(text, "m.yaml")
    return caught.value.findings


def the_one(old: str, new: str) -> lw.Finding:
    """The only finding about a change of the model, which is said in Chinese as well."""
    assert old in MODEL
    (found,) = findings(MODEL.replace(old, new, 1))
    said = found.say("zh")
    assert re.search("[\u4e00-\u9fff]", said) and not re.search("[a-z]{3,} [a-z]{3,} [a-z]{3,}", said)
    return found


def test_the_model_itself_is_right() -> None:
    assert lw.structure(lw.loads(MODEL)).mobility == 1


@pytest.mark.parametrize(("old", "new", "place", "words"), OF_YAML)
def test_a_slip_is_one_finding_at_its_place(old: str, new: str, place: str, words: str) -> None:
    found = the_one(old, new)
    assert found.where == f"m.yaml:{place}"
    assert words in str(found)


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
    assert str(the_one(old, new)).endswith(old.strip())


def test_values_that_stand_beside_their_element_are_read_in_it() -> None:
    load = "loads:\n  braking:\n    kind: torque\n  on: rocker\n  magnitude: 3 kg\n"
    told = [str(each) for each in findings(MODEL + load)]
    assert len(told) == 3
    assert 'loads.on: "on" stands beside "braking", not in it' in told[0]
    assert "loads.braking.magnitude" in told[2]  # its unit is looked at as well


@pytest.mark.parametrize(
    ("table", "keys", "remedy"),
    [
        ("O1: {kind: revolute, links: [frame, crank]}", "links", 'they have the point "O1" already'),
        ("O1: {kind: revolute, parent: frame, child: crank}", "parent, child", "remove it"),
        (
            "P: {kind: revolute, between: [frame, crank], at: O1}",
            "between, at",
            'name a point of frame and crank "P": points: [P, …]',
        ),
        ("O1: {kind: revolute, links: [frame, rocker]}", "links", 'name a point of rocker "O1"'),
    ],
)
def test_a_pin_is_said_to_join_the_links_that_have_its_point(table: str, keys: str, remedy: str) -> None:
    (found,) = findings(f"{MODEL}joints:\n  {table}\n")
    assert f"joins the links that have a point of its name, and takes no key {keys}" in str(found)
    assert remedy in str(found)


@pytest.mark.parametrize(
    ("driver", "remedy"),
    [
        ("turn: crank, joint: O1, ", 'unknown key "joint"; did you mean "about"?'),
        ("turn: crank, pivot: O, ", 'unknown key "pivot"; did you mean "about"?'),
        ("turn: crank, at: O1, ", 'unknown key "at"; did you mean "about"?'),
        ("joint: O1, ", "write turn: crank and about: O1"),
        ("joint: O, ", "add turn: LINK and about: PIN, or slide: JOINT"),
        ("link: crank, joint: O1, ", "write turn: crank and about: O1"),
    ],
)
def test_a_driver_in_other_words_is_one_finding(driver: str, remedy: str) -> None:
    assert remedy in str(the_one("turn: crank, about: O1, ", driver))


def test_a_key_that_says_something_else_takes_the_place_of_none() -> None:
    told = [str(each) for each in findings(MODEL.replace("about: O1", "colour: [1, 2, 3]"))]
    assert [("colour" in each, "about: the key" in each) for each in told] == [(True, False), (False, True)]


@pytest.mark.parametrize("twice", ["crank", "coupler"])
def test_nothing_follows_from_a_name_that_two_links_have(twice: str) -> None:
    load = "loads: {braking: {kind: torque, on: rocker, magnitude: 3 N*m}}\n"
    (found,) = findings(MODEL.replace("  rocker:", f"  {twice}:") + load)
    assert found.code == "duplicate-key"
