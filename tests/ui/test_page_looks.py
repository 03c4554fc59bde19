"""How living pages look: names clear of the drawing, nothing cut on a phone, words in the language that is chosen."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.every import every
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import page

import linkwright as lw

pytestmark = needs_chromium
WINDOWS = {"wide": (1440, 900), "phone": (390, 844)}
#: Boxes of the names that are shown, and of the paper.
BOXES = """() => [...document.querySelectorAll(".lw-name")].filter(e => e.getAttribute("visibility") !== "hidden")
    .map(e => e.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom])"""
PAPER = "() => (b => [b.left, b.top, b.right, b.bottom])(document.querySelector('.paper').getBoundingClientRect())"
#: Elements whose words are wider than they are.
CUT = """names => [...document.querySelectorAll(names)].filter(e => e.scrollWidth > e.clientWidth + 1)
    .map(e => e.value ?? e.textContent)"""


@pytest.fixture(params=["wide", pytest.param("phone", marks=pytest.mark.rotating)])
def window(chromium: Any, request: pytest.FixtureRequest) -> Iterator[Opened]:
    wide, high = WINDOWS[request.param]
    context = chromium.new_context(viewport={"width": wide, "height": high}, offline=True)
    yield Opened(context.new_page())
    context.close()


@pytest.mark.parametrize(
    "name",
    [
        "jaw_crusher_sixbar",
        pytest.param("theo_jansen_leg", marks=pytest.mark.rotating),
        pytest.param("crank_rocker", marks=pytest.mark.rotating),
    ],
)
def test_names_overlap_neither_each_other_nor_the_edge(window: Opened, name: str) -> None:
    window.open(page(name))
    left, top, right, bottom = window.tab.evaluate(PAPER)
    points = window.tab.locator(".lw-name").count()
    for place in range(0, 72, 12):
        window.tab.locator(".transport input").fill(str(place))
        window.tab.evaluate("() => new Promise(requestAnimationFrame)")
        boxes = window.tab.evaluate(BOXES)
        assert len(boxes) == points
        assert all(a >= left and b >= top and c <= right and d <= bottom for a, b, c, d in boxes)
        # The boxes of letters have room above and below them.
        for k, (a, b, c, d) in enumerate(boxes):
            for e, f, g, h in boxes[:k]:
                assert min(c, g) - max(a, e) < 2 or min(d, h) - max(b, f) < 0.5 * (d - b)


def test_points_are_named_as_in_drawings(window: Opened) -> None:
    """The crusher's point D of the jaw is D, and the number of O1 stands below the line."""
    window.open(page("jaw_crusher_sixbar"))
    names = window.tab.locator(".lw-name").all_text_contents()
    assert sorted(names) == ["A", "B", "C", "D", "O1", "O3", "O5"]
    assert window.tab.locator(".lw-name tspan").all_text_contents() == ["1", "3", "5"]


@pytest.mark.rotating
def test_no_number_and_no_column_is_cut(window: Opened) -> None:
    """Six digits in the fields of a machine with lengths such as -236.803 mm; the last column on a phone."""
    window.open(page("printing_press"))
    assert window.tab.evaluate(CUT, '.dimension input[type="number"], .dimension .name, .scroll') == []
    wide = window.tab.evaluate("() => document.documentElement.scrollWidth - innerWidth")
    assert wide <= 0


def test_title_and_purpose_follow_the_language(opened: Opened, tmp_path: Path) -> None:
    document = lw.read_document("gallery:crank_rocker")
    opened.open(lw.living_page(document, steps=36, language="zh").save(tmp_path / "page.html"))
    shown = [opened.tab.locator(each) for each in ("h1", ".purpose", ".source")]
    chinese = [each.inner_text() for each in shown]
    assert chinese[0] == lw.load("gallery:crank_rocker").translate("zh").name
    assert chinese == opened.run("s => [s.data.name.zh, s.data.purpose.zh, s.data.source.zh]")
    opened.turn_over()
    assert shown[0].inner_text() == lw.load("gallery:crank_rocker").name
    assert all(each.inner_text() != before for each, before in zip(shown, chinese, strict=True))


@pytest.mark.rotating
def test_paper_has_no_controls(window: Opened) -> None:
    """What is printed has dimensions, curves and numbers, and nothing that can only be clicked."""
    window.open(page("crank_rocker"))
    window.tab.locator("summary", has_text=window.translate("page.show")).click()
    window.tab.locator(".checks").first.wait_for()
    window.tab.emulate_media(media="print")
    for each in ("header", ".tools", ".checks", ".choice", ".lock", ".more"):
        assert not any(found.is_visible() for found in every(window.tab.locator(each).all())), each
    assert window.tab.locator('.dimension input[type="number"]').first.is_visible()
    assert window.tab.locator(".plot").first.is_visible()
