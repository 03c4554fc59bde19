"""Lengths of drawn links: written as typed, rounded where measured, true in the solved machine, held or followed."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
import yaml
from tests.refusals import refused
from tests.unit.server.drawing import FOURBAR, NEW, PIVOTS, bar, done, metres

import linkwright as lw
from linkwright.server.work import solved
from linkwright.words.message import code_of

#: Jansen's proportions, mm: links between joints, in the order of drawing, from rough places (m).
JANSEN = (
    ("m", "Z", "X", 15),
    ("j", "X", "W", 50),
    ("b", "W", "Y", 41.5),
    ("d", "Y", "U", 40.1),
    ("e", "U", "W", 55.8),
    ("k", "X", "V", 61.9),
    ("c", "V", "Y", 39.3),
    ("f", "U", "S", 39.4),
    ("g", "S", "V", 36.7),
    ("i", "V", "T", 49),
    ("h", "T", "S", 65.7),
)
ROUGH = {"X": [52, 12], "W": [10, 45], "U": [-38, 12], "V": [-8, -36], "S": [-34, -25], "T": [-5, -85]}


def sides(text: str, ends: dict[str, tuple[str, str]]) -> dict[str, float]:
    """Distances of points in the solved motion, m, each the same at all positions."""
    motion, found = lw.solve_motion(lw.loads(text), steps=24), {}
    for name, (a, b) in ends.items():
        apart = np.hypot(*(motion.point(a).position - motion.point(b).position).T)
        assert np.ptp(apart) < 1e-12
        found[name] = float(apart[0])
    return found


def test_jansens_lengths_typed_while_drawn_come_out_true() -> None:
    """Every triangle closes onto joints that are there; points move, pivots stay; the machine solves at once."""
    pivots = {"Y": [0.0, 0.0], "Z": [0.038, 0.0078]}
    text = done(NEW, *({"do": "point", "name": n, "at": at, "fixed": True} for n, at in pivots.items())).text
    for name, a, b, size in JANSEN:
        places = {each: [1e-3 * x for x in ROUGH[each]] for each in (a, b) if each in ROUGH}
        now = done(text, bar([a, b], str(size), name=name, places=places))
        assert now.picture["unmet"] == []
        assert f"  {name}: {{points: [{a}, {b}], length: {size} mm}}\n" in now.text
        text = now.text
    text = done(text, {"do": "driver", "link": "m"}).text
    assert "Y: [0 mm, 0 mm], Z: [38 mm, 7.8 mm]" in text
    found = sides(text, {name: (a, b) for name, a, b, _size in JANSEN})
    assert found == pytest.approx({name: 1e-3 * size for name, _a, _b, size in JANSEN}, rel=1e-10)
    answer = solved(text, "en")
    assert answer["model"] is not None
    assert [each for each in answer["findings"] if each["severity"] == "error"] == []
    drawn, motion = answer["picture"]["points"], lw.solve_motion(lw.loads(text), steps=720)
    off = np.max([np.hypot(*(motion.point(n).position - drawn[n]).T) for n in ROUGH], axis=0)
    assert off.min() < 3e-4  # as drawn, one of the positions every half degree


def test_a_typed_length_stays_as_it_was_typed() -> None:
    for typed, written in (("140", "140 mm"), ("4 in", "4 in"), ("0,12 m", "0.12 m"), ("140 mm", "140 mm")):
        text = done(NEW, *PIVOTS, bar(["O1", "A"], typed, places={"A": [0.05, 0.05]})).text
        assert f"link1: {{points: [O1, A], length: {written}}}" in text
        x, y = (float(each.split()[0]) for each in yaml.safe_load(text)["drawing"]["A"])
        assert math.hypot(x, y) == pytest.approx(1e3 * metres(written), abs=0.02)
        assert x == pytest.approx(y, abs=0.02)
    for wrong in ("0", "-3 mm", "3 kg", "x", "1e400"):
        with pytest.raises(lw.LinkwrightError):
            done(NEW, *PIVOTS, bar(["O1", "A"], wrong, places={"A": [0.05, 0.05]}))


def test_measured_lengths_have_no_float_noise() -> None:
    now = done(NEW, *FOURBAR)
    assert re.findall(r"length: ([^}]*)}", now.text) == ["50 mm", "152.6 mm", "126.5 mm"]
    assert now.made == ["O1", "O2", "A", "crank", "B", "coupler", "rocker"]
    small = done(NEW, PIVOTS[0], bar(["O1", "A"], places={"A": [0.00312345, 0.0]}))
    assert "A: [3.12 mm, 0 mm]" in small.text
    assert "length: 3.12 mm" in small.text


def test_lengths_that_no_places_meet_stay_and_are_told() -> None:
    """A rocker of 20 mm cannot reach: the text has it, the picture says which, the others stay as they were."""
    before = done(NEW, *FOURBAR[:4])
    after = done(before.text, bar(["B", "O2"], "20 mm", name="rocker"))
    assert "rocker: {points: [B, O2], length: 20 mm}" in after.text
    assert after.picture["unmet"] == []  # B comes nearer
    far = done(after.text, bar(["O1", "O2"], "3 m", name="tie"))
    assert far.picture["unmet"] == ["tie"]
    assert far.picture["points"] == after.picture["points"]
    impossible = done(before.text, bar(["B", "O2"], "900 mm", name="rocker"))
    assert impossible.picture["unmet"] == ["rocker"]
    assert [code_of(each) for each in impossible.notes] == ["studio.unmet"]
    assert "length: 900 mm" in impossible.text
    healed = done(impossible.text, bar(["B", "O2"], "100 mm", name="rocker"))
    assert healed.picture["unmet"] == []


def test_a_plate_has_lengths_or_typed_sides() -> None:
    """Coordinates beside a length as drawn; three typed sides make a triangle that is true, either way round."""
    drawn = done(
        NEW, *PIVOTS, bar(["A", "B", "C"], name="plate", places={"A": [0, 0.1], "B": [0.1, 0.1], "C": [0.04, 0.15]})
    )
    assert "plate: {points: [A, B], length: 100 mm, also: {C: [40 mm, 50 mm]}}" in drawn.text
    for y in (0.15, 0.05):
        places = {"B": [0.08, 0.1], "C": [0.04, y]}
        crank = bar(["O1", "A"], "100", name="crank", places={"A": [0.0, 0.1]})
        plate = {**bar(["A", "B", "C"], name="plate", places=places), "sides": ["41.5", "55.8", "40.1"]}
        text = done(
            NEW, *PIVOTS, crank, plate, bar(["B", "O2"], name="rocker"), {"do": "driver", "link": "crank"}
        ).text
        assert "lengths: [41.5 mm, 40.1 mm]" in text
        assert lw.loads(text).dimension("plate.lengths.0") == pytest.approx(0.0415)
        local = lw.loads(text).link("plate").points
        found = [math.dist(local[a], local[b]) for a, b in ("AB", "BC", "CA")]
        assert found == pytest.approx([0.0415, 0.0558, 0.0401], rel=1e-12)
        assert (local["C"][1] > 0) == (y > 0.1)
    with refused("studio.no_triangle"):
        done(
            NEW,
            {**bar(["A", "B", "C"], places={"A": [0, 0], "B": [0.1, 0], "C": [0, 0.1]}), "sides": ["1", "9", "2"]},
        )
    four = {"A": [0, 0], "B": [0.1, 0], "C": [0.1, 0.1], "D": [0, 0.1]}
    text = done(NEW, {**bar([*four], name="plate", places=four), "sides": ["90", "80", None, "70"]}).text
    plate = yaml.safe_load(text)["links"]["plate"]
    c, d = (complex(*(float(each.split()[0]) for each in plate["also"][name])) for name in "CD")
    assert plate["length"] == "90 mm"
    assert (abs(c - 90), abs(d)) == pytest.approx((80, 70), abs=2e-3)


def test_a_dragged_joint_takes_lengths_along_and_locked_ones_hold() -> None:
    text = done(NEW, *FOURBAR).text
    free = done(text, {"do": "move", "points": {"A": [0.0, 0.06]}})
    assert "A: [0 mm, 60 mm]" in free.text
    assert "crank: {points: [O1, A], length: 60 mm}" in free.text
    coupler = math.dist((0, 60), (160, 120))
    assert f"coupler: {{points: [A, B], length: {coupler:.1f} mm}}" in free.text
    assert "rocker: {points: [B, O2], length: 126.5 mm}" in free.text
    locked = ["crank.length", "coupler.length", "rocker.length"]
    held = done(text, {"do": "move", "points": {"A": [0.0, 0.06]}, "locked": locked})
    assert re.findall(r"length: ([^}]*)}", held.text) == ["50 mm", "152.6 mm", "126.5 mm"]
    (ax, ay), (bx, by) = (held.picture["points"][name] for name in "AB")
    assert math.hypot(ax, ay) == pytest.approx(0.05, abs=1e-4)
    assert abs(ax) < 0.001 and ay > 0
    assert math.dist((ax, ay), (bx, by)) == pytest.approx(0.1526, abs=1e-4)
    assert held.picture["unmet"] == []
    one = done(text, {"do": "move", "points": {"B": [0.2, 0.1]}, "locked": ["coupler.length"]})
    assert "coupler: {points: [A, B], length: 152.6 mm}" in one.text
    assert one.picture["points"]["B"] == [0.2, 0.1]


def test_points_are_added_fixed_and_freed() -> None:
    text = done(NEW, *FOURBAR).text
    more = done(text, {"do": "add_point", "link": "coupler", "at": [0.095, 0.15]})
    assert more.made == ["C"]
    mechanism = lw.loads(more.text)
    along = complex(0.13, 0.08)
    place = complex(0.065, 0.11) * along.conjugate() / abs(along)
    assert mechanism.dimension("coupler.C.x") == pytest.approx(place.real, abs=6e-5)
    assert mechanism.dimension("coupler.C.y") == pytest.approx(place.imag, abs=6e-5)
    fixed = done(text, {"do": "fix", "point": "B", "fixed": True}).text
    assert lw.loads(fixed).frame.points["B"] == (0.16, 0.12)
    freed = done(fixed, {"do": "fix", "point": "B", "fixed": False}).text
    assert lw.structure(lw.loads(freed)).mobility == 1
    loose = done(text, {"do": "fix", "point": "O1", "fixed": False})
    assert "driver" not in loose.text
    assert loose.picture["points"]["O1"] == [0, 0]


def test_the_ends_of_a_typed_length_move_alone_where_that_is_no_farther() -> None:
    """The crank stays where it is drawn; the joint of coupler and rocker goes where both are as long as typed."""
    text = done(
        NEW,
        *PIVOTS,
        bar(["O1", "A"], "50", places={"A": [0.03, 0.04]}),
        bar(["A", "B"], "150", places={"B": [0.16, 0.12]}),
        bar(["B", "O2"], "125"),
    )
    places = text.picture["points"]
    assert places["A"] == [0.03, 0.04]
    apart = math.dist(places["A"], places["B"]), math.dist(places["B"], places["O2"])
    assert apart == pytest.approx((0.15, 0.125), abs=2e-5)
    longer = done(text.text, {"do": "set", "path": ["links", "link1", "length"], "value": "60 mm"})
    x, y = longer.picture["points"]["A"]
    assert math.atan2(y, x) == pytest.approx(math.atan2(4, 3), abs=0.06)  # it hardly turns


def test_blocks_stay_on_their_guides_and_in_their_slots() -> None:
    """Whatever length is set or joint dragged; the solved slider is where (l² - (y - e)²)^½ says."""
    text = done(
        NEW,
        PIVOTS[0],
        bar(["O1", "A"], "50", places={"A": [0.03, 0.04]}),
        bar(["A", "B"], "150", places={"B": [0.17, 0.011]}),
        {"do": "guide", "at": "B", "angle": 0},
        {"do": "driver", "link": "link1"},
    ).text
    e = metres(yaml.safe_load(text)["frame"]["points"]["G1"][1])
    held = ["crank.length", "coupler.length"]
    changed = done(
        text,
        {"do": "set", "path": ["links", "coupler", "length"], "value": "160 mm"},
        {"do": "move", "points": {"B": [0.18, 0.05]}, "locked": held},
    )
    places = changed.picture["points"]
    assert places["B"] == pytest.approx([0.18, e], abs=1e-3)
    assert places["B"][1] == pytest.approx(e, abs=1e-4)
    assert re.findall(r"length: ([^}]*)}", changed.text) == ["50 mm", "160 mm"]
    motion = lw.solve_motion(lw.loads(changed.text), steps=36)
    a, b = motion.point("A").position, motion.point("B").position
    assert b[:, 0] == pytest.approx(a[:, 0] + np.sqrt(0.16**2 - (a[:, 1] - e) ** 2), rel=1e-12)
    slotted = done(
        NEW,
        PIVOTS[0],
        {"do": "point", "name": "O2", "at": [0.0, -0.2], "fixed": True},
        bar(["O1", "A"], "60", places={"A": [0.05, 0.033]}, name="crank"),
        bar(["O2", "B"], "300", places={"B": [0.07, 0.09]}, name="lever"),
        {"do": "slot", "along": "lever", "at": "A"},
        {"do": "set", "path": ["links", "crank", "length"], "value": "80 mm"},
    )
    offset = metres(yaml.safe_load(slotted.text)["joints"]["slot1"]["offset"])
    o, a, b = (complex(*slotted.picture["points"][each]) for each in ("O2", "A", "B"))
    assert ((b - o).conjugate() * (a - o)).imag / abs(b - o) == pytest.approx(offset, abs=1.5e-4)
    assert (abs(a), abs(b - o)) == pytest.approx((0.08, 0.3), abs=5e-5)
    assert slotted.picture["unmet"] == []
