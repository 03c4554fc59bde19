"""The structure in a line, with its count: of the gallery by Grübler's formula, of drawings that are not finished."""

from __future__ import annotations

import pytest

import linkwright as lw
from linkwright import gallery
from linkwright.errors import ModelError
from linkwright.server.structure import structure_of
from linkwright.server.work import new_text

FRAME = "format: 1\nframe: {points: {O1: [0 mm, 0 mm], O2: [D mm, 0 mm]}}\n"
LINKS = """links:
  crank: {points: [O1, A], length: a mm}
  coupler: {points: [A, B], length: b mm}
  rocker: {points: [O2, B], length: c mm}
"""


def four_bar(a: float, b: float, c: float, d: float) -> str:
    text = FRAME.replace("D mm", f"{d} mm") + LINKS
    for letter, length in (("a", a), ("b", b), ("c", c)):
        text = text.replace(f"{letter} mm", f"{length} mm")
    return text + "assembly: {B: left}\n"


@pytest.mark.parametrize("name", gallery.names())
def test_counts_of_the_gallery(name: str) -> None:
    try:
        document = lw.read_document(f"gallery:{name}")
        known = lw.structure(document.mechanism)
    except ModelError:
        pytest.skip("no mechanism")
    found = structure_of(document.text, document.mechanism, "en")
    assert found["mobility"] == known.mobility
    counted = found["formula"].split("; ")[0].rpartition("= ")[2]
    assert int(counted.replace("−", "-")) == known.grubler
    assert [each["signature"] for each in found["groups"]] == [each.signature for each in known.groups]


@pytest.mark.parametrize(
    ("lengths", "said"),
    [
        ((60, 181, 140, 118), "Four-bar, 1 degree of freedom; the crank can turn through: 60 + 181 < 118 + 140 mm"),
        ((60, 110, 90, 220), "Four-bar, 1 degree of freedom; no link can turn through: 60 + 220 > 90 + 110 mm"),
        (
            (100, 90, 80, 40),
            "Four-bar, 1 degree of freedom; both links on the frame can turn through: 40 + 100 < 80 + 90 mm",
        ),
        (
            (80, 40, 90, 100),
            "Four-bar, 1 degree of freedom; only the coupler can turn through: 40 + 100 < 80 + 90 mm",
        ),
        ((40, 80, 40, 80), "Four-bar, 1 degree of freedom; it has change points: 40 + 80 = 40 + 80 mm"),
    ],
)
def test_four_bars_say_what_turns(lengths: tuple[float, float, float, float], said: str) -> None:
    text = four_bar(*lengths)
    found = structure_of(text, lw.loads(text), "en")
    assert found["headline"] == said
    assert found["formula"] == "3·n − 2·p_L − p_H = 3·3 − 2·4 − 0 = 1"
    assert found["class"] == "class II"
    assert [(each["signature"], each["links"]) for each in found["groups"]] == [
        ("R", ["crank"]),
        ("RRR", ["coupler", "rocker"]),
    ]


@pytest.mark.parametrize(
    ("text", "said", "mobility"),
    [
        ("", "Empty sheet", 0),
        (new_text(), "Empty sheet", 0),
        ("format: 1\nframe: {points: {O: [0 m, 0 m]}}\n", "Points without links", 0),
        ("format: 1\nlinks: {a: {points: [A, B], length: 1 m}}\n", "Free link, 3 degrees of freedom", 3),
        (
            "format: 1\nframe: {points: {O: [0 m, 0 m]}}\nlinks: {a: {points: [O, B]}, b: {points: [B, C]}}\n",
            "Open chain, 2 degrees of freedom",
            2,
        ),
        ("links: [", "Empty sheet", 0),
    ],
)
def test_what_is_not_finished_has_a_structure_too(text: str, said: str, mobility: int) -> None:
    found = structure_of(text, None, "en")
    assert found["headline"] == said
    assert found["mobility"] == mobility
    assert found["groups"] == []


def test_welded_links_are_one() -> None:
    text = (
        "format: 1\nframe: {points: {O: [0 m, 0 m], Q: [2 m, 0 m]}}\n"
        "links: {a: {points: [O, A]}, b: {points: [A, B]}, c: {points: [B, C]}, d: {points: [Q, C]}}\n"
        "joints: {weld1: {kind: weld, links: [a, b], at: A}}\n"
    )
    found = structure_of(text, None, "en")
    assert found["formula"].startswith("3·n − 2·p_L − p_H = 3·3 − 2·4 − 0 = 1")


def test_headlines_speak_chinese() -> None:
    text = four_bar(60, 181, 140, 118)
    found = structure_of(text, lw.loads(text), "zh")
    assert "四杆" in found["headline"]
