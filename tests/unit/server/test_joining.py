"""Joints made of what is there, names, drives, masses of sections, removal of several things at once."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import yaml
from tests import store
from tests.refusals import refused
from tests.unit.server.drawing import FOURBAR, NEW, PIVOTS, bar, done, metres

import linkwright as lw

LOOSE = (
    *PIVOTS,
    bar(["O1", "A"], places={"A": [0.03, 0.04]}),
    bar(["A", "B"], places={"B": [0.16, 0.12]}),
    bar(["C", "O2"], places={"C": [0.17, 0.13]}),
)


def test_a_free_end_dropped_on_a_joint_is_a_pin() -> None:
    text = done(NEW, *LOOSE, {"do": "merge", "from": "C", "into": "B"}, {"do": "driver", "link": "link1"})
    assert "C" not in text.picture["points"]
    assert [(each["from"], each["to"]) for each in text.renamed] == [
        ("link1", "crank"),
        ("link2", "coupler"),
        ("link3", "rocker"),
    ]
    assert "rocker: {points: [B, O2], length: 126.5 mm}" in text.text  # hypot(40, 120)
    assert lw.structure(lw.loads(text.text)).mobility == 1
    assert yaml.safe_load(text.text)["driver"] == {"turn": "crank", "about": "O1", "speed": "60 rpm"}
    onto = done(NEW, *LOOSE, {"do": "merge", "from": "O2", "into": "B"})
    assert onto.picture["points"]["O2"] == [0.2, 0.0]
    assert "link2: {points: [A, O2]" in onto.text
    with refused("studio.one_link"):
        done(NEW, *LOOSE, {"do": "merge", "from": "A", "into": "B"})


def test_links_welded_at_a_joint_turn_as_one() -> None:
    """The angle between the two stays over the motion; without the weld it is a pin again."""
    arm = bar(["O1", "D"], name="arm", places={"D": [-0.03, 0.05]})
    text = done(NEW, *FOURBAR, arm, {"do": "weld", "point": "O1", "on": True}).text
    motion = lw.solve_motion(lw.loads(text), steps=12)
    one, two = (motion.point(each).position @ [1, 1j] for each in "AD")
    assert np.angle(two / one) == pytest.approx(math.atan2(50, -30) - math.atan2(40, 30), abs=2e-5)
    pinned = done(text, {"do": "weld", "point": "O1", "on": False}).text
    assert "weld" not in pinned
    assert pinned.rstrip() == done(NEW, *FOURBAR, arm).text.rstrip()
    moved = done(text, {"do": "set", "path": ["links", "arm", "length"], "value": "100 mm"})
    x, y = moved.picture["points"]["D"]
    assert math.atan2(y, x) == pytest.approx(math.atan2(50, -30), abs=2e-3)
    assert "assembly" not in done(store.text("kite"), {"do": "weld", "point": "B", "on": True}).text
    stuck = done(NEW, *FOURBAR, {"do": "weld", "point": "O2", "on": True})
    assert lw.loads(stuck.text).joints["weld1"].joined == ("frame", "rocker")
    with refused("studio.no_weld", point="O9"):
        done(NEW, *FOURBAR, {"do": "point", "name": "O9", "at": [1, 1], "fixed": True}, {"do": "weld", "point": "O9"})


def test_a_bar_is_split_with_its_mass_and_its_loads() -> None:
    mass = {"do": "mass", "link": "coupler", "mass": "3 kg"}
    load = {"do": "load", "link": "coupler", "at": "B", "force": "10 N", "angle": 0}
    now = done(NEW, *FOURBAR, mass, load, {"do": "split", "link": "coupler", "at": [0.095, 0.08]})
    assert now.made[-2:] == ["C", "link1"]
    data = yaml.safe_load(now.text)
    assert data["links"]["coupler"]["points"] == ["A", "C"]
    assert data["links"]["link1"]["points"] == ["C", "B"]
    assert lw.loads(now.text).loads["load1"].on == "link1"
    sizes = [metres(data["links"][each]["length"]) for each in ("coupler", "link1")]
    assert sizes == pytest.approx([math.hypot(0.065, 0.04)] * 2, abs=6e-5)
    masses = [float(data["links"][each]["mass"].split()[0]) for each in ("coupler", "link1")]
    assert masses == pytest.approx([1.5, 1.5], rel=1e-3)
    with refused("studio.split_guide", link="lever", name="slot"):
        done(store.text("shaper_quick_return"), {"do": "split", "link": "lever", "at": [0, 0.1]})
    with refused("studio.no_bar", link="plate"):
        done(
            NEW,
            bar(["A", "B", "C"], name="plate", places={"A": [0, 0], "B": [1, 0], "C": [0, 1]}),
            {"do": "split", "link": "plate", "at": [0, 0]},
        )


@pytest.mark.parametrize(
    ("what", "old", "new"),
    [("link", "rocker", "lever"), ("point", "B", "K"), ("load", "load1", "pull"), ("driver", "driver", "motor")],
)
def test_a_name_changes_wherever_it_is_mentioned(what: str, old: str, new: str) -> None:
    """The machine is the same one: its numbers by the new names."""
    load = {"do": "load", "link": "rocker", "at": "B", "force": "10 N", "angle": 0}
    wish = {"do": "optimize", "section": {"vary": {"rocker.length": "100..150 mm"}, "maximize": "transmission_angle"}}
    text = done(NEW, *FOURBAR, load, wish).text
    named = done(text, {"do": "rename", "what": what, "from": old, "to": new}).text
    before, after = (lw.solve_motion(lw.loads(each), steps=12) for each in (text, named))
    if what == "link":
        assert "lever.length: 100..150 mm" in named
        assert after.link("lever").angle == pytest.approx(before.link("rocker").angle)
    elif what == "point":
        assert np.allclose(after.point("K").position, before.point("B").position)
        assert "[A, K]" in named and "[K, O2]" in named and "at: K" in named
    assert list(lw.loads(named).loads) == [new if what == "load" else "load1"]
    assert list(lw.loads(named).drivers) == [new if what == "driver" else "driver"]
    with refused("studio.name_taken"):
        done(text, {"do": "rename", "what": "link", "from": "rocker", "to": "crank"})
    with refused("studio.no_name"):
        done(text, {"do": "rename", "what": "point", "from": "B", "to": "1 x"})


@pytest.mark.parametrize("name", ["slider_crank_offset", "toggle_press", "geared_fivebar", "stephenson_sixbar"])
def test_links_and_points_of_any_machine_are_renamed(name: str) -> None:
    text = store.text(name)
    machine = lw.loads(text)
    for link in machine.links:
        renamed = lw.loads(done(text, {"do": "rename", "what": "link", "from": link, "to": "zz"}).text)
        assert {"zz" if each == link else each for each in machine.links} == {*renamed.links}
        assert len(renamed.dimensions()) == len(machine.dimensions())
    for point in machine.frame.points:
        text = done(text, {"do": "rename", "what": "point", "from": point, "to": f"{point}z"}).text
    a, b = (lw.solve_motion(each, steps=8) for each in (machine, lw.loads(text)))
    for link in machine.links:
        assert b.link(link).angle == pytest.approx(a.link(link).angle, abs=1e-12)


def test_mass_and_inertia_of_a_bar_of_steel_by_hand() -> None:
    """ρ A l and m (l² + b²)/12 of a flat bar 20 × 5, length 152.6; of a round one and a tube about their middle."""
    size, rho = 0.1526, 7850.0
    cases: dict[str, tuple[list[str], float, float]] = {
        "flat": (["20 mm", "5"], 0.02 * 0.005, 0.02**2 / 12),
        "round": (["12 mm"], math.pi * 0.006**2, 0.006**2 / 4),
        "tube": (["20 mm", "16 mm"], math.pi * (0.01**2 - 0.008**2), (0.01**2 + 0.008**2) / 4),
    }
    for shape, (typed, area, square) in cases.items():
        section = {"shape": shape, "size": typed, "density": "7850 kg/m³"}
        link = lw.loads(done(NEW, *FOURBAR, {"do": "mass", "link": "coupler", "section": section}).text).link(
            "coupler"
        )
        assert link.mass == pytest.approx(rho * area * size, rel=1e-3)
        assert link.inertia == pytest.approx(rho * area * size * (size**2 / 12 + square), rel=1e-3)
        assert link.mass_centre is None
    with refused("studio.no_tube"):
        done(NEW, *FOURBAR, {"do": "mass", "link": "coupler", "section": {**section, "size": ["1 mm", "2 mm"]}})


def test_mass_of_a_plate_along_its_sides() -> None:
    """Three bars along a right triangle 30, 40, 50: centre by their middles, inertia by Steiner."""
    places = {"A": [0.0, 0.0], "B": [0.4, 0.0], "C": [0.0, 0.3]}
    section = {"shape": "round", "size": ["10 mm"], "density": "1000 kg/m³"}
    text = done(
        NEW, bar([*places], name="plate", places=places), {"do": "mass", "link": "plate", "section": section}
    ).text
    entry = yaml.safe_load(text)["links"]["plate"]
    line = 1000 * math.pi * 0.005**2
    ends = [(0.0, 0.0), (0.4, 0.0), (0.0, 0.3)]
    parts = [
        (line * math.dist(a, b), np.add(a, b) / 2, math.dist(a, b))
        for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)
    ]
    mass = sum(m for m, _c, _l in parts)
    centre = sum(m * c for m, c, _l in parts) / mass
    inertia = sum(m * (long**2 / 12 + 0.005**2 / 4 + sum((c - centre) ** 2)) for m, c, long in parts)
    assert float(entry["mass"].split()[0]) == pytest.approx(mass, rel=1e-3)
    assert float(entry["inertia"].split()[0]) == pytest.approx(inertia, rel=1e-3)
    assert [metres(each) for each in entry["mass_centre"]] == pytest.approx(list(centre), abs=1e-4)


def test_several_things_are_removed_in_one_step() -> None:
    load = {"do": "load", "link": "rocker", "at": "B", "force": "10 N", "angle": 0}
    text = done(NEW, *FOURBAR, load, {"do": "guide", "at": "B", "angle": 0}).text
    assert "slider: {points: [B]}" in text

    def gone(*items: tuple[str, str]) -> Any:
        return done(text, {"do": "remove", "items": [{"kind": kind, "name": name} for kind, name in items]})

    assert gone(("pair", "guide1")).text == done(NEW, *FOURBAR, load).text
    assert "load1" not in gone(("load", "load1")).text
    assert "driver" not in gone(("driver", "driver")).text
    left = gone(("link", "rocker"), ("load", "load1"), ("point", "O2"), ("pair", "guide1"))
    assert set(left.picture["links"]) == {"crank", "coupler"}
    assert set(left.picture["points"]) == {"O1", "A", "B"}
    free = gone(("point", "A"), ("pair", "guide1"))
    assert free.picture["links"]["crank"] == ["O1", "A"]
    assert free.picture["links"]["coupler"] == ["P1", "B"]
    assert free.picture["points"]["P1"] == free.picture["points"]["A"]
    plate = done(NEW, bar(["A", "B", "C"], name="plate", places={"A": [0, 0], "B": [0.1, 0], "C": [0.0, 0.1]}))
    less = done(plate.text, {"do": "remove", "items": [{"kind": "point", "name": "A"}]})
    assert "plate: {points: [B, C], length: 141.4 mm}" in less.text
    shaper = done(store.text("shaper_course"), {"do": "remove", "items": [{"kind": "point", "name": "S6"}]}).text
    assert "mass_centre: S6" not in shaper
    with refused("studio.no_load", name="x"):
        gone(("load", "x"))


def test_what_slides_is_driven_along_its_guide_and_a_law_stays() -> None:
    chain = (
        PIVOTS[0],
        bar(["O1", "A"], name="crank", places={"A": [0.03, 0.04]}),
        bar(["A", "B"], name="rod", places={"B": [0.2, 0.0]}),
    )
    text = done(NEW, *chain, {"do": "guide", "at": "B", "angle": 0}, {"do": "driver", "slide": "guide1"}).text
    assert yaml.safe_load(text)["driver"] == {"slide": "guide1", "speed": "0.1 m/s"}
    assert lw.structure(lw.loads(text)).mobility == 1
    turned = done(
        text, {"do": "driver", "link": "crank"}, {"do": "set", "path": ["driver", "speed"], "value": "90 rpm"}
    )
    again = done(turned.text, {"do": "driver", "link": "crank", "about": "O1"})
    assert yaml.safe_load(again.text)["driver"] == {"turn": "crank", "about": "O1", "speed": "90 rpm"}
    by_block = done(text, {"do": "driver", "link": "slider"})
    assert yaml.safe_load(by_block.text)["driver"]["slide"] == "guide1"
    with refused("studio.no_drive", name="rod"):
        done(text, {"do": "driver", "link": "rod"})
    gears = (*PIVOTS, bar(["O1", "A"], places={"A": [0.03, 0.04]}), bar(["O2", "B"], places={"B": [0.25, 0.0]}))
    inside = done(
        NEW,
        *gears,
        {"do": "gear", "links": ["link1", "link2"], "teeth": "20:60", "inside": True},
        {"do": "driver", "link": "link1"},
    )
    freed = {"do": "fix", "point": "O1", "fixed": False}
    with refused("studio.no_gears"):
        done(NEW, *gears, freed, {"do": "gear", "links": ["link1", "link2"], "teeth": "20:60"})
    motion = lw.solve_motion(lw.loads(inside.text), steps=8)
    assert motion.link("link2").angular_velocity == pytest.approx(motion.link("crank").angular_velocity / 3)
