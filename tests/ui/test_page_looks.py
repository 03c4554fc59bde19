"""How living pages look: names clear of the drawing, nothing cut on a phone, words in the language that is chosen."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import Opened, browser, needs_chromium

import linkwright as lw
from linkwright.mechanism.mechanism import Mechanism

pytestmark = needs_chromium
WINDOWS = {"wide": (1440, 900), "phone": (390, 844)}
#: Boxes of the names that are shown, and of the paper.
BOXES = """() => [...document.querySelectorAll(".lw-name")].filter(e => e.getAttribute("visibility") !== "hidden")
    .map(e => e.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom])"""
PAPER = "() => (b => [b.left, b.top, b.right, b.bottom])(document.querySelector('.paper').getBoundingClientRect())"
#: Elements whose words are wider than they are.
CUT = """names => [...document.querySelectorAll(names)].filter(e => e.scrollWidth > e.clientWidth + 1)
    .map(e => e.value ?? e.textContent)"""


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with browser() as started:
        yield started


@pytest.fixture(params=WINDOWS)
def opened(chromium: Any, request: pytest.FixtureRequest) -> Iterator[Opened]:
    wide, high = WINDOWS[request.param]
    context = chromium.new_context(viewport={"width": wide, "height": high}, offline=True)
    yield Opened(context.new_page())
    context.close()


def page_of(model: lw.Document | Mechanism, folder: Path, language: str = "en") -> Path:
    path = folder / "page.html"
    lw.living_page(model, steps=72, language=language).save(path)
    return path


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "theo_jansen_leg", "crank_rocker"])
def test_names_overlap_neither_each_other_nor_the_edge(opened: Opened, tmp_path: Path, name: str) -> None:
    opened.open(page_of(lw.read_document(f"gallery:{name}"), tmp_path))
    left, top, right, bottom = opened.tab.evaluate(PAPER)
    points = opened.tab.locator(".lw-name").count()
    for place in range(0, 72, 12):
        opened.tab.locator(".transport input").fill(str(place))
        opened.tab.evaluate("() => new Promise(requestAnimationFrame)")
        boxes = opened.tab.evaluate(BOXES)
        assert len(boxes) == points
        assert all(a >= left and b >= top and c <= right and d <= bottom for a, b, c, d in boxes)
        # The boxes of letters have room above and below them.
        for k, (a, b, c, d) in enumerate(boxes):
            for e, f, g, h in boxes[:k]:
                assert min(c, g) - max(a, e) < 2 or min(d, h) - max(b, f) < 0.5 * (d - b)


def test_points_are_named_as_in_drawings(opened: Opened, tmp_path: Path) -> None:
    """The crusher's point D of the jaw is D, and the number of O1 stands below the line."""
    opened.open(page_of(lw.read_document("gallery:jaw_crusher_sixbar"), tmp_path))
    names = opened.tab.locator(".lw-name").all_text_contents()
    assert sorted(names) == ["A", "B", "C", "D", "O1", "O3", "O5"]
    assert opened.tab.locator(".lw-name tspan").all_text_contents() == ["1", "3", "5"]


def test_no_number_and_no_column_is_cut(opened: Opened, tmp_path: Path) -> None:
    """Six digits in the fields of a machine with lengths such as -236.803 mm; the last column on a phone."""
    opened.open(page_of(lw.read_document("gallery:printing_press"), tmp_path))
    assert opened.tab.evaluate(CUT, '.dimension input[type="number"], .dimension .name, .scroll') == []
    wide = opened.tab.evaluate("() => document.documentElement.scrollWidth - innerWidth")
    assert wide <= 0


def test_title_and_purpose_follow_the_language(opened: Opened, tmp_path: Path) -> None:
    """A name in two languages; a purpose whose Chinese words stand in the report's."""
    path = tmp_path / "rocker.yaml"
    text = lw.read_document("gallery:crank_rocker").text
    path.write_text(text.replace("name: Crank", "name:\n  zh: 曲柄摇杆\n  en: Crank", 1), encoding="utf-8")
    opened.open(page_of(lw.read_document(path), tmp_path, language="zh"))
    shown = [opened.tab.locator(each) for each in ("h1", ".purpose", ".source")]
    chinese = [each.inner_text() for each in shown]
    assert chinese[:2] == ["曲柄摇杆", "最简单的曲柄摇杆机构，求连杆上一点的轨迹。"]
    opened.tab.locator(".language").click()
    assert shown[0].inner_text() == "Crank-rocker four-bar with a coupler point"
    assert shown[1].inner_text().startswith("The plainest crank-rocker")
    assert all(each.inner_text() != before for each, before in zip(shown, chinese, strict=True))


def test_paper_has_no_controls(opened: Opened, tmp_path: Path) -> None:
    """What is printed has dimensions, curves and numbers, and nothing that can only be clicked."""
    opened.open(page_of(lw.read_document("gallery:crank_rocker"), tmp_path))
    opened.tab.get_by_text("Show", exact=True).click()
    opened.tab.locator(".checks").first.wait_for()
    opened.tab.emulate_media(media="print")
    for each in ("header", ".tools", ".checks", ".choice", ".lock", ".more"):
        assert not any(found.is_visible() for found in opened.tab.locator(each).all()), each
    assert opened.tab.locator('.dimension input[type="number"]').first.is_visible()
    assert opened.tab.locator(".plot").first.is_visible()
