"""Tools that draw points, links and pairs, by pointer, finger and keys: what the file has, what Escape leaves."""

from __future__ import annotations

import cmath
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import PHONE, Hand, hand

pytestmark = needs_chromium

#: Two pivots with links, a wheel, a rod with a free end, a block that slides beside the crank.
PARTS = """\
format: 1
name: parts
frame:
  points: {O1: [0 mm, 0 mm], O2: [180 mm, -20 mm], O3: [120 mm, 0 mm], G1: [-40 mm, 30 mm]}
drawing:
  A: [30 mm, 40 mm]
  B: [150 mm, 90 mm]
  C: [240 mm, 40 mm]
  D: [0 mm, 120 mm]
  E: [140 mm, 30 mm]
  F: [-40 mm, 30 mm]
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 130 mm}
  arm: {points: [O2, C], length: 84.85 mm}
  wheel: {points: [O3, E], length: 36.06 mm}
  rod: {points: [A, D], length: 85.44 mm}
  block: {points: [F]}
joints:
  guide: {kind: prismatic, guide: frame, through: G1, direction: 90 deg, block: block, at: F}
"""
O1, O2, A, B, C, D, E, F = (0, 0), (180, -20), (30, 40), (150, 90), (240, 40), (0, 120), (140, 30), (-40, 30)
CRANK, COUPLER, ARM, WHEEL, NOWHERE = (15, 20), (90, 65), (210, 10), (130, 15), (-60, 100)
#: Tool, what is done with it (clicks in mm, values typed, keys), and what the file has then at which paths.
ROWS: list[tuple[str, list[Any], dict[str, Any]]] = [
    ("pivot", [NOWHERE], {"frame.points.O4": ["-60 mm", "100 mm"]}),
    ("pivot", [B], {"frame.points.B": ["150 mm", "90 mm"], "drawing.B": None}),
    ("link", [B, C, "Escape"], {"links.link1": {"points": ["B", "C"], "length": "103 mm"}}),
    (
        "link",
        [D, "=140|0"],
        {"links.link1": {"points": ["D", "G"], "length": "140 mm"}, "drawing.G": ["140 mm", "120 mm"]},
    ),
    ("link", [COUPLER, ARM], {"links.coupler.also.G": ["65 mm", "0 mm"], "links.link1.points": ["G", "H"]}),
    ("link", [B, "140", O2], {"links.link1": {"points": ["B", "O2"], "length": "140 mm"}}),
    (
        "plate",
        [D, NOWHERE, (-100, 140), D],
        {"links.link1.points": ["D", "G"], "links.link1.also": {"H": ["88.5 mm", "-50.6 mm"]}},
    ),
    (
        "slider",
        [D, (100, 124)],
        {"joints.guide1.direction": "0 deg", "joints.guide1.at": "D", "links.slider": {"points": ["D"]}},
    ),
    ("slider", [B, ARM], {"joints.slot1.guide": "arm", "joints.slot1.at": "B"}),
    ("slot", [ARM, B], {"joints.slot1.guide": "arm", "joints.slot1.at": "B"}),
    ("weld", [A], {"joints.weld1.at": "A"}),
    ("gears", [CRANK, WHEEL, (40, 4)], {"joints.mesh1.teeth": [20, 40]}),
    ("gears", [CRANK, WHEEL, "=20 : -60"], {"joints.mesh1.teeth": [20, 60], "joints.mesh1.mesh": "internal"}),
    ("rack", [CRANK, F], {"joints.rack1.rack": "block", "joints.rack1.radius": "40 mm"}),
    ("cam", [CRANK, F, "=20"], {"joints.cam1.cam": "crank", "joints.cam1.at": "F"}),
    ("dimension", [COUPLER, NOWHERE, "=140"], {"links.coupler.length": "140 mm"}),
    ("dimension", [O1, O2, (90, -60), "=200"], {"frame.points.O2": ["198.7767 mm", "-22.0863 mm"]}),
]

#: Jansen's proportions, mm; the crank is at (a, l) from the pivot of the leg.
JANSEN = {"a": 38, "l": 7.8, "m": 15, "j": 50, "k": 61.9, "b": 41.5, "c": 39.3, "d": 40.1, "e": 55.8, "f": 39.4} | {
    "g": 36.7, "h": 65.7, "i": 49,
}  # fmt: skip


def meeting(a: Any, ra: float, b: Any, rb: float, side: float) -> Any:
    """Where two circles meet, to the left (1) or right (-1) of the way from a to b."""
    far = abs(b - a)
    along = (far**2 + ra**2 - rb**2) / (2 * far)
    return a + (along + 1j * side * np.sqrt(ra**2 - along**2)) * (b - a) / far


def leg(crank: Any) -> dict[str, Any]:
    """Joints of Jansen's leg (mm) at places of its crank's pin, by circles that meet."""
    n, pivot = JANSEN, 0j
    w = meeting(crank, n["j"], pivot, n["b"], -1)
    v = meeting(crank, n["k"], pivot, n["c"], 1)
    u = meeting(pivot, n["d"], w, n["e"], 1)
    s = meeting(v, n["g"], u, n["f"], 1)
    return {"A": crank, "B": w, "C": v, "D": u, "E": s, "F": meeting(v, n["i"], s, n["h"], 1)}


def place(z: complex) -> tuple[float, float]:
    """A place near one in mm, m."""
    return 1e-3 * z.real + 0.001, 1e-3 * z.imag - 0.0015


def mm(place: tuple[float, float]) -> tuple[float, float]:
    """A place in mm, m."""
    return place[0] / 1e3, place[1] / 1e3


def do(drawn: Hand, tool: str, steps: list[Any]) -> None:
    """Takes a tool and goes through steps with it."""
    drawn.take(tool)
    for step in steps:
        if isinstance(step, tuple):
            drawn.click(mm(step))
        elif step.startswith("="):
            drawn.type(*step[1:].split("|"))
        elif step[0].isdigit():
            drawn.tab.keyboard.type(step)
        else:
            drawn.key(step)


def found(entries: Any, path: str) -> Any:
    """What a file has at a path of keys; None where it has nothing."""
    for key in path.split("."):
        entries = entries.get(key) if isinstance(entries, dict) else None
    return entries


def test_every_tool_writes_what_was_drawn_and_escape_leaves_nothing(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "parts.yaml").write_text(PARTS, encoding="utf-8")
    with hand(chromium, tmp_path, "parts.yaml") as drawn:
        drawn.look(-0.12, -0.08, 0.26, 0.18)
        for tool, steps, wanted in ROWS:
            do(drawn, tool, [step for step in steps if step not in ("Escape", "Enter")][:-1])
            drawn.key(*["Escape"] * len(steps), "Escape")
            assert (drawn.text, drawn.tab.evaluate("bench.tool.value"), drawn.selected) == (PARTS, "move", []), steps
            do(drawn, tool, steps)
            drawn.tab.wait_for_function("text => desk.text.value !== text", arg=PARTS)
            drawn.settle()
            assert drawn.refusal == ""
            entries = drawn.entries
            assert {path: found(entries, path) for path in wanted} == wanted, (tool, steps)
            drawn.key(*["Escape"] * 4, "Control+z")
            drawn.settle()
            assert drawn.text == PARTS


def test_refused_clicks_say_what_is_missing_and_write_nothing(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "parts.yaml").write_text(PARTS, encoding="utf-8")
    with hand(chromium, tmp_path, "parts.yaml") as drawn:
        drawn.look(-0.12, -0.08, 0.26, 0.18)
        for tool, steps, key, values in (
            ("gears", [F], "gears_pivot", {"link": "block"}),
            ("rack", [CRANK, ARM], "rack_slider", {"link": "arm"}),
            ("cam", [CRANK, B], "cam_follower", {"point": "B"}),
            ("slider", [NOWHERE], "slider_point", {}),
        ):
            do(drawn, tool, steps)
            assert drawn.refusal == drawn.translate(f"studio.refuse.{key}", **values)
            assert drawn.tab.get_by_role("alert").get_by_text(drawn.refusal).is_visible()
        do(drawn, "link", [B, "12 kg"])
        assert drawn.tab.locator("[aria-invalid=true]").count() == 1
        assert drawn.text == PARTS


def test_a_finger_draws_links_with_a_typed_length(chromium: Any, tmp_path: Path) -> None:
    begun = "format: 1\nname: begun\nframe:\n  points: {O1: [0 mm, 0 mm]}\n"
    (tmp_path / "begun.yaml").write_text(begun, encoding="utf-8")
    with hand(chromium, tmp_path, "begun.yaml", size=PHONE, touch=True) as drawn:
        drawn.look(-0.05, -0.05, 0.15, 0.15)
        for tool, places in (("pivot", [(100, 0)]), ("link", [(0, 0), (20, 60), (80, 90), (100, 0)])):
            drawn.tab.evaluate("tool => { bench.tool.value = tool; }", tool)
            for place in places:
                drawn.tap(mm(place))
                drawn.settle()
        links = drawn.entries["links"]
        assert [link["points"] for link in links.values()] == [["O1", "A"], ["A", "B"], ["B", "O2"]]
        drawn.tap(mm((100, 0)))
        drawn.tap(mm((50, -30)))
        drawn.tab.locator(".hand-panel input").first.fill("140")
        drawn.tab.locator(".hand-panel button").click()
        drawn.settle()
        assert drawn.entries["links"]["link4"]["length"] == "140 mm"


def test_keys_alone_draw_a_link_of_a_typed_length(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.take("pivot")
        drawn.key("Enter", "Enter", *["ArrowRight"] * 6, "Enter")
        drawn.settle()
        first, second = (complex(*drawn.point(name)) for name in ("O1", "O2"))
        assert second - first == pytest.approx(6 * drawn.tab.evaluate("bench.sheet.value.step"))
        drawn.take("link")
        drawn.key("Enter", *["ArrowUp"] * 4)
        drawn.type("140")
        drawn.settle()
        link = drawn.entries["links"]["link1"]
        assert link == {"points": ["O2", "A"], "length": "140 mm"}
        assert complex(*drawn.point("A")) - second == pytest.approx(0.14j, abs=1e-4)


def test_a_leg_of_true_proportions_is_typed_while_it_is_drawn(chromium: Any, tmp_path: Path) -> None:
    """The foot goes as circles that meet have it, at every position."""
    n, centre = JANSEN, complex(JANSEN["a"], JANSEN["l"])
    rough = {name: place(z) for name, z in leg(centre + n["m"] * cmath.exp(0.9j)).items()}
    with hand(chromium, tmp_path) as drawn:

        def to(name: str, *keys: str) -> None:
            """To a joint that is there, else near where it will be, with typed lengths."""
            there = drawn.tab.evaluate("name => bench.sheet.value.scene.points.has(name)", name)
            drawn.go(drawn.point(name) if there else rough[name])
            drawn.type(*(f"{n[key]}" for key in keys))
            drawn.settle()

        drawn.look(-0.08, -0.1, 0.08, 0.06)
        drawn.take("pivot")
        drawn.go((-0.05, 0.03))
        drawn.type("0", "0")
        drawn.type(f"{n['a']}", f"{n['l']}")
        drawn.settle()
        for tool, start, ways in (
            ("link", "O2", (("A", "m"), ("B", "j"))),
            ("link", "A", (("C", "k"), ("O1", "c"))),
            ("plate", "O1", (("B", "b"), ("D", "e", "d"))),
            ("link", "D", (("E", "f"),)),
            ("plate", "C", (("E", "g"), ("F", "h", "i"))),
        ):
            drawn.take(tool)
            drawn.click(drawn.point(start))
            for way in ways:
                to(*way)
            drawn.key("Enter")
            drawn.settle()
        links = list(drawn.entries["links"].values())
        written = [each.get("length") or each["lengths"] for each in links]
        assert written == [
            *(f"{n[key]} mm" for key in "mjkc"), [f"{n['b']} mm", f"{n['d']} mm"],
            f"{n['f']} mm", [f"{n['g']} mm", f"{n['i']} mm"],
        ]  # fmt: skip
        assert [
            each["angle"].count(f"{n[key]} mm") for each, key in zip((links[4], links[6]), "eh", strict=True)
        ] == [1, 1]
        drawn.take("drive")
        drawn.click(drawn.middle("O2", "A"))
        drawn.settle()
        rows = drawn.tab.evaluate("""() => ["A", "F"].map((name) => ["x", "y"].map((axis) => {
          const { scene } = bench.sheet.value, { main } = bench.session.value.model;
          return [...main.row(`p:${scene.points.get(name).key}.${axis}`)];
        }))""")
        crank, foot = (1e3 * (np.array(x) + 1j * np.array(y)) for x, y in rows)
        assert len(crank) > 100
        assert np.abs(crank - centre) == pytest.approx(n["m"])
        assert np.ptp(foot.imag) > 10
        assert foot == pytest.approx(leg(crank)["F"], abs=1e-6)
