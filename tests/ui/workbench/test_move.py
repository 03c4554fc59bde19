"""Joints and links dragged on the sheet, the machine between its positions, what is cut and pasted."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import Hand, hand

import linkwright as lw

pytestmark = needs_chromium
O1, O2, A, B = (0.0, 0.0), (0.16, -0.02), (0.04, 0.06), (0.16, 0.1)


def chain(drawn: Hand) -> None:
    """Pivots with two links from the first, and one from the second whose end is free."""
    drawn.take("pivot")
    drawn.click(O1, O2)
    drawn.settle()
    drawn.take("link")
    drawn.click(O1, A, B)
    drawn.key("Escape", "Escape")
    drawn.settle()
    drawn.take("link")
    drawn.click(O2, (0.2, 0.04))
    drawn.settle()
    drawn.key("Escape")
    drawn.take("move")


def between(drawn: Hand, a: str, b: str) -> float:
    return math.dist(drawn.point(a), drawn.point(b))


def test_a_free_end_dropped_on_a_joint_is_that_joint_and_the_crank_is_turned_by_hand(
    chromium: Any, tmp_path: Path
) -> None:
    with hand(chromium, tmp_path) as drawn:
        chain(drawn)
        drawn.drag(drawn.point("C"), drawn.point("B"))
        drawn.settle()
        joined = [entry["points"] for entry in drawn.entries["links"].values()]
        assert joined == [["O1", "A"], ["A", "B"], ["O2", "B"]]
        drawn.take("drive")
        drawn.click(drawn.middle("O1", "A"))
        drawn.settle()
        for name, place in (("A", A), ("B", B)):
            assert drawn.point(name) == pytest.approx(place, abs=1e-4)
        before, text = [between(drawn, *ends) for ends in (("O1", "A"), ("A", "B"), ("O2", "B"))], drawn.text
        drawn.take("move")
        x, y = drawn.middle("O1", "A")
        drawn.drag((x, y), (-y, x), steps=12)
        drawn.frame()
        assert drawn.text == text
        turned = math.atan2(drawn.point("A")[1], drawn.point("A")[0]) - math.atan2(A[1], A[0])
        assert turned == pytest.approx(math.pi / 2, abs=0.03)
        # Between two positions of the machine it is as exact as at them.
        for phase in (0.1234, 0.5678):
            drawn.tab.evaluate("phase => (linkwright.phase.value = phase)", phase)
            drawn.frame()
            after = [between(drawn, *ends) for ends in (("O1", "A"), ("A", "B"), ("O2", "B"))]
            assert after == pytest.approx(before, abs=2e-4)
            x, y = drawn.point("A")
            assert math.remainder(math.atan2(y, x) - 2 * math.pi * phase, 2 * math.pi) == pytest.approx(0, abs=1e-9)


def test_a_length_that_is_locked_stays_while_a_joint_is_dragged(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_text(lw.read_document("gallery:crank_rocker").text, encoding="utf-8")
    with hand(chromium, tmp_path, "m.yaml") as drawn:
        drawn.tab.evaluate("() => bench.lock(['coupler.length'], true)")
        before = {name: drawn.metres(link["length"]) for name, link in drawn.entries["links"].items()}
        x, y = drawn.point("B")
        drawn.drag((x, y), (x + 0.3, y - 0.4))
        drawn.settle()
        after = {name: drawn.metres(link["length"]) for name, link in drawn.entries["links"].items()}
        assert after["coupler"] == before["coupler"]
        assert after["rocker"] != before["rocker"]
        assert between(drawn, "A", "B") == pytest.approx(after["coupler"], rel=1e-9)
        assert between(drawn, "O2", "B") == pytest.approx(after["rocker"], rel=1e-9)
        drawn.key("Control+z")
        drawn.settle()
        assert drawn.point("B") == pytest.approx((x, y))


@pytest.mark.rotating
def test_a_box_to_the_left_takes_what_it_touches_which_is_cut_and_pasted(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        chain(drawn)
        links = len(drawn.entries["links"])
        drawn.drag((0.02, 0.12), (-0.02, 0.05))
        assert drawn.selected == []
        # To the right it takes only what is all inside.
        drawn.drag((0.01, 0.03), (0.05, 0.01))
        assert drawn.selected == []
        drawn.drag((0.03, 0.01), (-0.02, 0.05))
        assert len(drawn.selected) == 1
        drawn.key("Control+x")
        drawn.settle()
        assert len(drawn.entries["links"]) == links - 1
        drawn.key("Control+v")
        drawn.settle()
        entry = drawn.entries["links"][next(name for name in drawn.selected if name in drawn.entries["links"])]
        assert drawn.metres(entry["length"]) == pytest.approx(math.dist(O1, A), abs=1e-4)
        before = {name: drawn.point(name) for name in entry["points"]}
        step = drawn.step
        drawn.key("ArrowRight", "Alt+ArrowUp")
        drawn.settle()
        for name, (x, y) in before.items():
            assert drawn.point(name) == pytest.approx((x + step, y + step / 10), abs=1e-4)
