"""A machine that cannot be assembled where it is drawn: the gap on the sheet, and its remedies by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import hand

pytestmark = needs_chromium

WIPER = """\
format: 1
name: Wiper
frame:
  points: {O1: [0 mm, 0 mm], O2: [220 mm, 0 mm]}
links:
  crank: {points: [O1, A], length: 60 mm}
  coupler: {points: [A, B], length: 110 mm}
  rocker: {points: [O2, B], length: 90 mm}
drawing: {A: [-20.5212 mm, 56.3816 mm], B: [100 mm, 60 mm]}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""


def inputs(drawn: Any) -> tuple[float, float]:
    """The smallest and the largest coordinate of the driver in the machine that is shown, deg."""
    low, high = drawn.tab.evaluate(
        "() => [Math.min, Math.max].map((pick) => pick(...bench.session.value.model.solver.inputs) * 180 / Math.PI)"
    )
    return low, high


def test_a_gap_is_drawn_and_mended_by_a_click(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "wiper.yaml").write_text(WIPER, encoding="utf-8")
    with hand(chromium, tmp_path, "wiper.yaml") as drawn:
        callout, rift = drawn.tab.locator(".gap-callout"), drawn.tab.locator("path.rift")
        assert callout.get_by_role("heading").inner_text().split() == ["Ends", "B", "stay", "47", "mm", "apart"]
        assert rift.is_visible()
        assert drawn.tab.locator(".machines").is_hidden()
        # both ends: at the coupler and at the rocker, 47 mm from each other
        ends = drawn.tab.evaluate(
            '() => ["coupler", "rocker"].map((name) => bench.sheet.value.scene.corners(name)[1])'
        )
        assert sum((a - b) ** 2 for a, b in zip(*ends, strict=True)) ** 0.5 == pytest.approx(0.047, abs=5e-4)
        # pointing at a remedy shows it and changes nothing
        ghosts = drawn.tab.locator(".above path.ghost:visible")
        callout.get_by_role("button", name="Lengthen the coupler").hover()
        drawn.frame()
        assert ghosts.count() == 3
        drawn.tab.mouse.move(5, 5)
        drawn.frame()
        assert ghosts.count() == 0
        assert drawn.text == WIPER
        # it plays within its limits all the while
        low, high = inputs(drawn)
        assert (low, high) == (pytest.approx(-61.7, abs=0.1), pytest.approx(61.7, abs=0.1))
        drawn.tab.evaluate("() => bench.page.play(true)")
        callout.wait_for(state="hidden")
        assert drawn.tab.locator(".machines").is_visible()
        drawn.tab.evaluate("() => bench.page.play(false)")
        drawn.tab.evaluate("() => bench.sheet.value.toDrawn()")
        callout.get_by_role("button", name="Lengthen the coupler").click()
        drawn.settle()
        assert drawn.entries["links"]["coupler"]["length"] == "200 mm"
        callout.wait_for(state="hidden")
        low, high = inputs(drawn)
        assert high - low > 350
        drawn.key("Control+z")
        drawn.settle()
        assert drawn.text == WIPER
        callout.get_by_role("button", name="Rock the crank").click()
        drawn.settle()
        assert drawn.entries["cycle"] == "rock"
        callout.wait_for(state="hidden")
        assert drawn.tab.locator(".machines").is_visible()
