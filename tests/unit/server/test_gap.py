"""Gaps of machines that cannot be assembled: distances and limits by triangles, remedies carried out and solved."""

from __future__ import annotations

from math import acos, asin, cos, degrees, hypot, radians, sin
from typing import Any

import pytest

import linkwright as lw
from linkwright.files.write import dump
from linkwright.kinematics.solver import MotionSolver
from linkwright.server.edits import edited
from linkwright.server.work import new_text, solved

FOUR_BAR = """
format: 1
name: Wiper
frame: {points: {O1: [0 mm, 0 mm], O2: [220 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 60 mm}
  coupler: {points: [A, B], length: 110 mm}
  rocker: {points: [O2, B], length: 90 mm}
drawing: {A: [PLACE], B: [100 mm, 60 mm]}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
DRAWN = radians(110)


def four_bar(coupler: float = 110.0, drawn: float = DRAWN, more: str = "") -> str:
    text = FOUR_BAR.replace("PLACE", f"{60 * cos(drawn)!r} mm, {60 * sin(drawn)!r} mm")
    return text.replace("110 mm", f"{coupler:g} mm") + more


def gap(text: str, language: str = "en") -> dict[str, Any]:
    found = solved(text, language)["gap"]
    assert isinstance(found, dict)
    return found


def test_the_gap_is_that_of_the_drawn_position() -> None:
    answer = solved(four_bar(), "en")
    found = answer["gap"]
    a, o2 = (60 * cos(DRAWN), 60 * sin(DRAWN)), (220.0, 0.0)
    distance = hypot(o2[0] - a[0], o2[1] - a[1])
    assert found["title"] == "Ends B stay 47 mm apart"
    assert (
        found["sentence"]
        == "At 110° the coupler and the rocker need 247 mm from A to O₂; together they reach 200 mm."
    )
    assert found["missing"] == pytest.approx((distance - 200) / 1e3)
    u = (o2[0] - a[0]) / distance, (o2[1] - a[1]) / distance
    ends = [[(a[0] + 110 * u[0]) / 1e3, (a[1] + 110 * u[1]) / 1e3], [(o2[0] - 90 * u[0]) / 1e3, -90 * u[1] / 1e3]]
    assert found["ends"][0] == pytest.approx(ends[0])
    assert found["ends"][1] == pytest.approx(ends[1])
    assert [(each["name"], each["radius"]) for each in found["reaches"]] == [("coupler", 0.11), ("rocker", 0.09)]
    assert found["points"]["A"] == pytest.approx([each / 1e3 for each in a])
    assert found["chains"] == [["coupler"], ["rocker"]]
    assert [(each["name"], round(each["length"], 9)) for each in found["lengths"]] == [
        ("crank", 0.06),
        ("coupler", 0.11),
        ("rocker", 0.09),
        ("frame", 0.22),
    ]
    assert found["lengths"][1]["wanted"] == pytest.approx(0.2)


def test_remedies_show_where_the_points_would_be() -> None:
    found = gap(four_bar())
    assert found["drawn"]
    assert found["way"] == {
        "centre": [0.0, 0.0],
        "radius": pytest.approx(0.06),
        "zero": pytest.approx(0.0, abs=1e-12),
    }
    longer, rocking, nearer = (each["places"] for each in found["remedies"])
    for places, coupler in ((longer, 0.2), (rocking, 0.11), (nearer, 0.11)):
        (ax, ay), (bx, by), (cx, cy) = places["A"], places["B"], places["O2"]
        assert hypot(bx - ax, by - ay) == pytest.approx(coupler)
        assert hypot(bx - cx, by - cy) == pytest.approx(0.09)
        assert hypot(ax, ay) == pytest.approx(0.06)
    assert nearer["O2"] == pytest.approx([0.13, 0.0])
    assert not gap(four_bar(drawn=0.0))["drawn"]


def test_the_machine_moves_as_far_as_it_goes() -> None:
    answer = solved(four_bar(), "en")
    limit = degrees(acos((60**2 + 220**2 - 200**2) / (2 * 60 * 220)))
    ((low, high),) = answer["gap"]["possible"]
    assert (low, high) == pytest.approx((-limit, limit), abs=1e-9)
    assert answer["model"]["positions"]["closed"]
    assert "cycle" not in answer["model"]["text"]
    assert [each for each in answer["findings"] if each["severity"] == "error"] == []
    assert answer["sentence"] == ""


def test_what_is_drawn_in_reach_shows_where_most_is_missing() -> None:
    """At 180° pin A is 280 mm from O2."""
    found = gap(four_bar(drawn=0.0))
    assert found["input"] == "180°"
    assert found["missing"] == pytest.approx(0.08)


def test_links_that_cannot_come_near_enough_are_shortened() -> None:
    """At 0° the pins are 160 mm apart, and 300 mm and 90 mm need 210 mm."""
    found = gap(four_bar(300.0, 0.0))
    assert found["missing"] == pytest.approx(0.05)
    assert found["sentence"].endswith("160 mm apart; the coupler and the rocker cannot come nearer than 210 mm.")
    assert found["remedies"][0]["title"] == "Shorten the coupler"


@pytest.mark.parametrize(
    ("coupler", "drawn"), [(110.0, DRAWN), (110.0, 0.0), (300.0, 0.0), (10.0, DRAWN), (640.0, 1.0)]
)
def test_every_remedy_lets_the_machine_move(coupler: float, drawn: float) -> None:
    text = four_bar(coupler, drawn)
    remedies = gap(text)["remedies"]
    assert remedies
    assert len(remedies) <= 3
    for remedy in remedies:
        machine = lw.loads(edited(text, remedy["actions"]).text)
        motion = lw.solve_motion(machine)
        assert motion.complete
        turns = "turns through" in remedy["note"]
        assert (motion.input[-1] - motion.input[0] > 6.0) == turns
        assert solved(edited(text, remedy["actions"]).text, "en")["gap"] is None
        assert left(machine) == left(lw.loads(text))
        known = {link: each.lengths for link, each in lw.loads(text).links.items()}
        changed = [link for link, each in machine.links.items() if each.lengths != known[link]]
        assert changed == (["coupler"] if "the coupler" in remedy["title"] else [])


def left(machine: lw.Mechanism) -> float:
    """Sign of the assembly of coupler and rocker, which a remedy leaves."""
    return MotionSolver(machine).assembly.modes["coupler+rocker"]


def test_a_parameter_is_changed_where_it_is_the_length() -> None:
    text = (
        four_bar().replace("length: 110 mm", "length: reach").replace("links:", "parameters: {reach: 110 mm}\nlinks:")
    )
    remedy = gap(text)["remedies"][0]
    assert remedy["actions"][:1] == [{"do": "set", "path": ["parameters", "reach"], "value": "200 mm"}]
    assert lw.solve_motion(lw.loads(edited(text, remedy["actions"]).text)).complete


def test_where_it_can_be_assembled_nowhere_there_is_no_range_and_no_model() -> None:
    answer = solved(four_bar(10.0), "en")
    found = answer["gap"]
    assert answer["model"] is None
    assert found["possible"] == []
    assert found["input"] == ""
    assert found["sentence"].startswith("At no position do the coupler and the rocker meet")
    assert [each["title"] for each in found["remedies"]] == ["Lengthen the coupler"]


def test_gaps_speak_chinese() -> None:
    found = gap(four_bar(), "zh")
    for text in (found["title"], found["sentence"], *(each["title"] for each in found["remedies"])):
        assert any("\u4e00" <= sign <= "\u9fff" for sign in text), text
    assert found["lengths"][-1]["name"] == "机架"


SLIDER_CRANK = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod: {points: [A, B], length: 60 mm}
  block: {points: [B]}
joints: {way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B, offset: 10 mm}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
"""


def test_a_rod_that_does_not_come_to_its_guide() -> None:
    """At −90° A is 110 mm below the way of B; the rod is 60 mm long."""
    found = gap(SLIDER_CRANK)
    assert found["sentence"] == "At −90° the rod needs 110 mm from A to the guide of the block; it reaches 60 mm."
    assert found["missing"] == pytest.approx(0.05)
    assert found["ends"] == [pytest.approx([0.0, -0.04], abs=1e-12), pytest.approx([0.0, 0.01], abs=1e-12)]
    low, high = degrees(asin(-0.5)), degrees(asin(0.7))
    assert found["possible"][0] == pytest.approx([low, high])
    assert found["possible"][1] == pytest.approx([180 - high, 180 - low])
    for remedy in found["remedies"]:
        assert lw.solve_motion(lw.loads(edited(SLIDER_CRANK, remedy["actions"]).text)).complete


@pytest.mark.rotating
def test_a_triad_says_how_far_its_driver_goes() -> None:
    """A group without closed form has no ends that could be drawn, but places before it, a range, and rocking."""
    machine = lw.load("gallery:triad")
    text = dump(machine.with_dimensions({"crank.A.x": 2.2 * machine.dimension("crank.A.x")}))
    answer = solved(text, "en")
    found = answer["gap"]
    assert found["ends"] is None
    assert {"O1", "O2", "O3", "A"} <= set(found["points"])
    ((low, high),) = found["possible"]
    assert answer["model"] is not None
    assert found["sentence"].startswith(f"The crank goes from −{abs(low):.4g}° to {high:.4g}°")
    (remedy,) = found["remedies"]
    assert lw.solve_motion(lw.loads(edited(text, remedy["actions"]).text)).complete


def test_a_slider_that_is_driven_goes_to_and_fro() -> None:
    text = """
format: 1
frame: {points: {O: [0 mm, 0 mm], P: [300 mm, 0 mm]}}
links:
  block: {points: [A]}
  rod: {points: [A, B], length: 250 mm}
  lever: {points: [P, B], length: 150 mm}
joints: {way: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: block, at: A}}
assembly: {B: left}
driver: {slide: way, speed: 50 mm/s}
"""
    answer = solved(text, "en")
    assert answer["gap"] is None
    assert answer["model"]["positions"]["closed"]
    assert [each for each in answer["findings"] if each["severity"] == "error"] == []


def sheet(*actions: dict[str, Any]) -> dict[str, Any]:
    answer = solved(edited(new_text(), actions).text, "en")
    assert isinstance(answer, dict)
    return answer


def pivot(name: str, x: float, y: float = 0.0) -> dict[str, Any]:
    return {"do": "point", "name": name, "at": [x, y], "fixed": True}


def point(name: str, x: float, y: float) -> dict[str, Any]:
    return {"do": "point", "name": name, "at": [x, y], "fixed": False}


def link(name: str, *points: str) -> dict[str, Any]:
    return {"do": "link", "name": name, "points": list(points)}


CRANK = (pivot("O1", 0.0), point("A", 0.06, 0.0), link("crank", "O1", "A"))


@pytest.mark.parametrize(
    "actions",
    [
        (),
        (pivot("O1", 0.0),),
        (point("A", 0.0, 0.0), point("B", 0.1, 0.0), link("bar", "A", "B")),
        CRANK,
        (*CRANK, point("B", 0.1, 0.1), link("coupler", "A", "B")),
        (*CRANK, point("B", 0.1, 0.1), link("coupler", "A", "B"), {"do": "driver", "link": "crank", "about": "O1"}),
    ],
)
def test_what_is_not_finished_is_no_error(actions: tuple[dict[str, Any], ...]) -> None:
    answer = sheet(*actions)
    assert answer["findings"] == []
    assert answer["sentence"] == ""
    assert answer["gap"] is None


def test_what_is_driven_moves_while_other_links_hang_loose() -> None:
    """A link with a free end, one that hangs on it, and one that lies apart: the four-bar turns."""
    links = "  extra: {points: [B, Y], length: 90 mm}\n  more: {points: [Y, Z]}\n  island: {points: [P, Q]}\n"
    places = ", Y: [190 mm, 60 mm], Z: [250 mm, 0 mm], P: [0 mm, -80 mm], Q: [80 mm, -80 mm]}\ndriver"
    text = four_bar(180.0).replace("drawing:", links + "drawing:").replace("}\ndriver", places)
    text = text.replace("length: 90 mm}\n  extra", "length: 140 mm}\n  extra")
    answer = solved(text, "en")
    assert answer["findings"] == []
    assert answer["gap"] is None
    assert sorted(answer["picture"]["loose"]) == ["extra", "island", "more"]
    model = answer["model"]
    assert {each["key"] for each in model["points"]} == {"O1", "O2", "A", "B"}
    assert model["positions"]["closed"]
    assert model["text"] == text
    assert answer["structure"]["headline"].startswith("Four-bar, 1 degree of freedom; the crank can turn through")
    lengths = {each["address"]: each["written"] for each in model["dimensions"]}
    first, last, *_unused = lengths["coupler.length"]
    assert text[first:last] == "180"
    alone = solved(four_bar(180.0).replace("90 mm", "140 mm"), "en")
    assert model["values"] == alone["model"]["values"]
    assert alone["picture"]["loose"] == []


def test_what_holds_a_link_twice_stays_an_error() -> None:
    answer = sheet(pivot("O1", 0.0), pivot("O2", 0.1), link("bar", "O1", "O2"))
    assert [each["code"] for each in answer["findings"]] == ["mobility.excess"]
