"""Outlines of the parts on the sheet: carried along with their links, red where they collide, the smallest gap."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import Hand, Place, hand

pytestmark = needs_chromium
FREE = """format: 1
name: four-bar
frame: {points: {O1: [0 mm, 0 mm], O2: [100 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 40 mm}
  coupler: {points: [A, B], length: 110 mm}
  rocker: {points: [O2, B], length: 70 mm}
driver: {turn: crank, about: O1, speed: 60 rpm}
construction:
  width: 16 mm
  thickness: 5 mm
  pin_radius: 3 mm
"""
FIXED = FREE + "  layers: {crank: 1, coupler: 2, rocker: 1}\n"
LINE = ".room-line button"


def outline(shown: Hand, name: str) -> list[Place]:
    """Where the ends of the edges of an outline are drawn, px of the screen."""
    found: list[list[float]] = shown.tab.evaluate(
        """name => {
          const path = document.querySelector(`.outline[data-name="${name}"]`), to = path.getScreenCTM();
          const ends = [...path.getAttribute("d").split("Z")[0].matchAll(/(-?[\\d.]+) (-?[\\d.]+)(?=[LA]|$)/g)];
          const places = ends.map(([, ...at]) => new DOMPoint(...at.map(Number)).matrixTransform(to));
          return places.map(({ x, y }) => [x, y]);
        }""",
        name,
    )
    return [(x, y) for x, y in found]


def is_about(shown: Hand, link: str, *points: str) -> bool:
    """The corners of a bar lie abreast of its points, 8 mm from them."""
    corners = outline(shown, link)
    for point in points:
        far = sorted(math.dist(shown.at(*shown.point(point)), corner) for corner in corners)
        assert far[:2] == pytest.approx([8e-3 * shown.scale] * 2, abs=0.2)
    return True


def red(shown: Hand) -> list[str]:
    found: list[str] = shown.tab.evaluate(
        "() => [...document.querySelectorAll('.outline.collides')].map((each) => each.dataset.name).sort()"
    )
    return found


def test_outlines_go_along_and_collide_and_parts_are_made_at_the_right(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_text(FIXED, encoding="utf-8")
    with hand(chromium, tmp_path, "m.yaml") as shown:
        tab = shown.tab
        assert tab.locator(".outline").count() == 0
        shown.button("studio.show.outlines").click()
        tab.wait_for_function("() => bench.room.value?.layered")
        shown.frame()
        assert red(shown) == []
        for phase in (0.0, 0.3):
            tab.evaluate("phase => { bench.page.phase.value = phase; }", phase)
            shown.frame()
            assert is_about(shown, "coupler", "A", "B") and is_about(shown, "crank", "O1", "A")
        tab.locator(LINE).first.click()
        shown.frame()
        assert red(shown) == ["coupler", "pin O1"]
        assert tab.evaluate("() => bench.page.phase.value") == pytest.approx(0.623, abs=0.01)
        tab.evaluate("text => desk.change(text)", FREE)
        shown.settle()
        tab.wait_for_function("() => bench.room.value.gap")
        shown.frame()
        assert red(shown) == []
        tab.evaluate("() => { bench.page.phase.value = 0.1; }")
        shown.frame()
        button = tab.locator(LINE)
        degrees = float(re.findall(r"(-?[\d.]+)°", button.inner_text())[0])
        assert tab.locator("circle.nearest:not([visibility=hidden])").count() == 0
        button.click()
        shown.frame()
        assert tab.evaluate("() => bench.page.phase.value") == pytest.approx(degrees % 360.0 / 360.0, abs=1e-3)
        assert tab.locator("circle.nearest:not([visibility=hidden])").count() == 1
        assert is_about(shown, "rocker", "O2", "B")

        is_made(shown)


def is_made(shown: Hand) -> None:
    """Shape, layer and mass are set at the right, the layers seen from the side."""
    tab, pane = shown.tab, shown.tab.locator(".pane")
    tab.evaluate("() => bench.select({ kind: 'link', name: 'crank' })")
    pane.get_by_role("button", name=shown.translate("studio.insp.shape")).click()
    for key, value in (("made_width", "20"), ("layer", "2")):
        field = pane.get_by_label(shown.translate(f"studio.insp.{key}"), exact=True)
        field.fill(value)
        field.press("Enter")
        shown.settle()
    pane.get_by_label(shown.translate("studio.insp.kind"), exact=True).select_option("plate")
    shown.settle()
    pane.get_by_role("switch", name=shown.translate("studio.insp.from_shape")).click()
    shown.settle()
    crank = shown.entries["links"]["crank"]
    assert crank["shape"] == {"kind": "plate", "width": "20 mm"} and crank["mass"] == "from shape"
    assert shown.entries["construction"]["layers"] == {"crank": 2}
    tab.evaluate("() => { bench.tab.value = 'structure'; }")
    picture = pane.locator("img.side")
    picture.wait_for()
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    assert axe.Axe().run(tab).response["violations"] == []
    assert picture.evaluate("async (image) => { await image.decode(); return image.naturalWidth; }") > 100
