"""No word of the workbench is cut: captions, buttons and labels in windows of three sizes and both languages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import Hand, hand

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
        "jaw_crusher_sixbar",
        pytest.param("printing_press", marks=pytest.mark.rotating),
        pytest.param("theo_jansen_leg", marks=pytest.mark.rotating),
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
