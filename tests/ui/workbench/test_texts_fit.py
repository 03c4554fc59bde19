"""No word of the workbench is cut: captions, buttons and labels in windows of three sizes and both languages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import PHONE, Hand, hand

import linkwright as lw

pytestmark = needs_chromium
WINDOWS = ((1440, 900), (1280, 800), (390, 844))
#: Elements with words of their own that are wider than they are, and do not scroll.
CUT = """() => [...document.querySelectorAll(".room *")]
  .filter((e) => e instanceof HTMLElement && e.clientWidth > 1 && e.scrollWidth > e.clientWidth + 1)
  .filter((e) => [...e.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.data.trim()))
  .filter((e) => !/auto|scroll/.test(getComputedStyle(e).overflowX))
  .map((e) => e.innerText)"""


def cut(found: Hand) -> list[str]:
    """What is cut in any of the tabs of dock and inspector, and while tools with long names are taken."""
    words: list[str] = []
    tabs = found.tab.locator('.room [role="tab"]')
    for k in range(tabs.count()):
        if tabs.nth(k).is_visible() and tabs.nth(k).get_attribute("aria-selected") != "true":
            tabs.nth(k).click()
            found.frame()
            words += found.tab.evaluate(CUT)
    for tool in ("target", "dimension", "move"):
        found.tab.evaluate("tool => { bench.tool.value = tool; }", tool)
        found.frame()
        words += found.tab.evaluate(CUT)
    return words


@pytest.mark.parametrize(
    "name",
    [
        "theo_jansen_leg",
        pytest.param("printing_press", marks=pytest.mark.rotating),
        pytest.param("jaw_crusher_sixbar", marks=pytest.mark.rotating),
    ],
)
def test_no_word_is_cut(chromium: Any, tmp_path: Path, name: str) -> None:
    (tmp_path / "machine.yaml").write_text(lw.read_document(f"gallery:{name}").text, encoding="utf-8")
    with hand(chromium, tmp_path, "machine.yaml") as found:
        for language in ("en", "zh"):
            found.tab.evaluate("language => { bench.page.language.value = language; }", language)
            for wide, high in WINDOWS:
                found.tab.set_viewport_size({"width": wide, "height": high})
                found.frame()
                # The curves again, which the tabs before have covered.
                found.tab.evaluate("() => { bench.dock.value = 'curves'; bench.drawer.value = 'half'; }")
                found.frame()
                assert found.tab.evaluate(CUT) == [], (language, wide)
                assert cut(found) == [], (language, wide)


#: A bar that the file gives 140 mm, drawn a little shorter: nothing drives it.
BARS = """format: 1
name: bars
frame:
  points: {O1: [0 mm, 0 mm], O2: [160 mm, 0 mm]}
links:
  crank: {points: [O1, A], length: 60.25 mm}
  coupler: {points: [A, B], length: 140 mm}
  rocker: {points: [B, O2], length: 100 mm}
drawing:
  A: [0 mm, 60.2 mm]
  B: [133.9 mm, 100.1 mm]
"""


@pytest.mark.rotating
def test_loads_with_their_labels_are_on_the_phone_and_lengths_are_those_of_the_file(
    chromium: Any, tmp_path: Path
) -> None:
    (tmp_path / "crusher.yaml").write_text(lw.read_document("gallery:jaw_crusher_sixbar").text, encoding="utf-8")
    with hand(chromium, tmp_path, "crusher.yaml", size=PHONE) as found:
        found.tab.wait_for_function("() => bench.session.value && document.querySelector('.over-texts .load')")
        found.frame()
        left, right = found.tab.evaluate(
            """() => {
              const edges = (e) => { const b = e.getBoundingClientRect(); return [b.left, b.right]; };
              const paper = edges(document.querySelector(".paper"));
              const texts = [...document.querySelectorAll(".over-texts .load")]
                .filter((e) => e.checkVisibility({ visibilityProperty: true })).map(edges);
              return [Math.min(...texts.map((e) => e[0])) - paper[0], paper[1] - Math.max(...texts.map((e) => e[1]))];
            }"""
        )
        assert left >= 0
        assert right >= 0
    (tmp_path / "bars.yaml").write_text(BARS, encoding="utf-8")
    with hand(chromium, tmp_path, "bars.yaml") as found:
        found.tab.evaluate("() => bench.set({ shown: { ...bench.settings.value.shown, dimensions: true } })")
        found.frame()
        shown = found.tab.locator(".over-texts .dim:visible").all_text_contents()
        assert {"60.25 mm", "140 mm", "100 mm"} <= set(shown)
