"""The flow chart of a solution: its calls in the order of the solution, its symbols clear of each other."""

import re
from collections import Counter
from itertools import combinations, pairwise
from typing import NamedTuple
from xml.etree import ElementTree

import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw

SVG = "{http://www.w3.org/2000/svg}"
CALLS = {
    "swing_conveyor": "bark rrrk rrpk bark rrpf rrrf barf",
    "jaw_crusher_sixbar": "bark rrrk rrrk bark rrrf rrrf barf",
    "shaper_quick_return": "bark rprk rrpk bark rrpf rprf barf",
    "dyad_rpp": "bark rppk bark rppf barf",
    "dyad_prp": "bark prpk prpf barf barf",
    "crank_rocker": "bark rrrk bark",
    "truss": "rrpk rrrk bark rrrf rrpf",
    "excavator": "rrrk bark rrrf",
    "triad": "bark bark barf",
}
RUBBING = """
format: 1
name: slider-crank with friction
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.3 m, mass: 1 kg}
  slider: {points: [B], mass: 3 kg}
joints:
  O: {kind: revolute, friction: 0.1, pin_radius: 20 mm}
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B, friction: 0.2}
driver: {turn: crank, about: O, speed: 20 rad/s, start: 50 deg}
"""


class Chart(NamedTuple):
    """What a picture holds: texts with their places, boxes (left, top, right, bottom), lines, circles' letters."""

    texts: list[tuple[str, float, float, str]]
    boxes: list[tuple[float, float, float, float]]
    lines: list[list[tuple[float, float]]]
    letters: list[str]


def chart(name: str, language: str = "en") -> Chart:
    """The flow chart of a machine, read from its picture."""
    return chart_of(store.machine(name), language)


def chart_of(machine: lw.Mechanism, language: str = "en") -> Chart:
    """The same of any machine."""
    motion = lw.solve_motion(machine, steps=24, failures="mark")
    root = ElementTree.fromstring(lw.plot(motion, "flow_chart", language=language, title="").svg())
    texts, boxes, lines, letters = [], [], [], []
    for each in root.iter():
        style = each.get("class", "")
        if each.tag == f"{SVG}text":
            place = (float(each.get("x", "0")), float(each.get("y", "0")))
            texts.append(("".join(each.itertext()), *place, style))
        elif style == "lw-flow" and each.tag == f"{SVG}rect":
            x, y, wide, tall = (float(each.get(key, "0")) for key in ("x", "y", "width", "height"))
            boxes.append((x, y, x + wide, y + tall))
        elif style == "lw-flow" and each.tag == f"{SVG}path":
            corners = _corners(each.get("d", ""))
            xs, ys = zip(*corners, strict=True)
            boxes.append((min(xs), min(ys), max(xs), max(ys)))
        elif style == "lw-flow" and each.tag == f"{SVG}circle":
            x, y, r = (float(each.get(key, "0")) for key in ("cx", "cy", "r"))
            boxes.append((x - r, y - r, x + r, y + r))
        elif style == "lw-flow-line":
            lines.append(_corners(each.get("d", "")))
    middles = [(0.5 * (a + c), 0.5 * (b + d)) for a, b, c, d in boxes if abs(c - a - 20.0) < 0.1]
    letters = [text for text, x, y, _ in texts for mx, my in middles if abs(x - mx) < 1 and abs(y - my) < 9]
    return Chart(texts, boxes, lines, letters)


def _corners(data: str) -> list[tuple[float, float]]:
    found = re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", data)
    return [(float(x), float(y)) for x, y in found]


@pytest.mark.parametrize("name", CALLS)
def test_the_calls_stand_in_the_order_of_the_solution(name: str) -> None:
    calls = [text for text, _, _, style in chart(name).texts if "call" in style]
    assert calls == CALLS[name].split()


def test_the_loop_steps_over_the_input() -> None:
    texts = [text for text, *_ in chart("swing_conveyor").texts]
    assert "i = 1; N = 24" in texts
    assert "q = 0°; Δq = 15°" in texts
    assert "i > N?" in texts


def test_the_step_is_that_of_the_tables_where_these_begin_at_a_limit() -> None:
    """Twelve positions from 343.17°: the second is at 13.17°, a step of 30° further."""
    found = lw.report("gallery:shaper_course", sections=["flow"]).document.blocks
    pictures = " ".join(svg for block in found for svg, _ in getattr(block, "pictures", ()))
    assert "Δq = 30°" in pictures


@pytest.mark.parametrize("name", ["dyad_rrr", "gear_differential", "double_slider"])
def test_several_drivers_and_laws_go_over_the_time(name: str) -> None:
    texts = [text for text, *_ in chart(name).texts]
    assert any(text.startswith("t = 0") for text in texts)


def test_friction_is_a_loop_of_its_own() -> None:
    found = chart_of(lw.loads(RUBBING))
    words = " ".join(text for text, *_ in found.texts)
    assert "Friction settled?" in words
    assert "friction of O, guide" in words
    _require_clear(found)


def test_a_structure_at_rest_has_no_loop() -> None:
    texts = [text for text, *_ in chart("truss").texts]
    assert not any("N =" in text or "i > N" in text for text in texts)


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("name", ["swing_conveyor", "printing_press", "truss"])
def test_nothing_overlaps(name: str, language: str) -> None:
    _require_clear(chart(name, language))


@pytest.mark.rotating
@pytest.mark.parametrize("name", store.names())
def test_every_machine_has_a_chart(name: str) -> None:
    found = chart(name)
    _require_clear(found)
    signatures = [group.signature for group in lw.structure(store.machine(name)).groups]
    words = " ".join(text for text, *_ in found.texts)
    for signature in every(signatures):
        assert signature in words or signature in ("R", "P")


def _require_clear(found: Chart) -> None:
    """Boxes stand apart, lines touch no box but at their ends, letters of connectors come in pairs."""
    boxes = every(found.boxes, least=3)
    for one, other in combinations(boxes, 2):
        apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
        assert apart, (one, other)
    for line in found.lines:
        for a, b in pairwise(line):
            bars = a[0] == b[0] and any(box[0] < a[0] < box[2] and box[1] == a[1] for box in boxes)
            if bars and any(box[3] == b[1] for box in boxes):
                continue
            for share in (0.1, 0.4, 0.7):
                x, y = a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
                inside = [box for box in boxes if box[0] + 0.1 < x < box[2] - 0.1 and box[1] + 0.1 < y < box[3] - 0.1]
                assert not inside, (line, inside)
    counted = Counter(found.letters)
    assert set(counted.values()) <= {2}, counted
    for text, x, y, _ in found.texts:
        half = 0.5 * 13.0 * 0.56 * sum(2 if ord(c) > 0x2E7F else 1 for c in text)
        holders = [b for b in boxes if b[0] < x < b[2] and b[1] < y - 4 < b[3]]
        assert not holders or min(b[2] - b[0] for b in holders) > 1.6 * half, text


def test_only_one_machine_is_shown() -> None:
    with refused("picture.one_flow_chart"):
        lw.plot([store.machine("crank_rocker"), store.machine("swing_conveyor")], "flow_chart")
