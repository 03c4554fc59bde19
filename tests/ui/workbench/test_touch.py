"""Small windows: fingers reach what they press, nothing runs out, and low windows leave room to the sheet."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests import store
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import PHONE, hand

pytestmark = needs_chromium

#: Of everything that can be pressed in what is in front: how far from its middle it is reached, by its own picture or
#: its label, where that is less than wanted; what is cut or out of the window.
SMALL = """least => {
  const front = document.querySelector(".menu [role^=menuitem]")?.closest(".menu")
    ?? document.querySelector("dialog[open], .shared:not([hidden])") ?? document.body;
  const shown = each => each.checkVisibility({ opacityProperty: true, visibilityProperty: true })
    && each.getBoundingClientRect().width > 0;
  const wanted = "button, a[href], input, select, textarea, summary, [role=slider], [role=option], [role^=menuitem]";
  const found = [];
  for (const each of [...front.querySelectorAll(wanted)].filter(shown)) {
    if (each.disabled || each.closest("[aria-hidden=true]")) continue;
    each.scrollIntoView({ block: "center", inline: "center" });
    const own = (x, y) => {
      const hit = document.elementFromPoint(x, y);
      return hit !== null && (each.contains(hit) || hit.closest("label")?.control === each);
    };
    const { left, top, width, height } = each.getBoundingClientRect(), x = left + width / 2, y = top + height / 2;
    const reach = (dx, dy) => {
      let far = 0;
      while (far < least && own(x + dx * (far + 0.5), y + dy * (far + 0.5))) far += 0.5;
      return far;
    };
    const size = [reach(-1, 0) + reach(1, 0), reach(0, -1) + reach(0, 1)];
    const name = each.getAttribute("aria-label") || each.innerText || each.id || each.className;
    if (Math.min(...size) < least - 1) found.push(`${name}: ${size.join(" x ")} px`);
    if (left < -1 || left + width > innerWidth + 1) found.push(`${name}: out of the window`);
    const cut = getComputedStyle(each).overflowX !== "visible" && each.scrollWidth > each.clientWidth + 1;
    if (cut && each.matches("button")) found.push(`${name}: cut`);
  }
  const { scrollWidth, scrollHeight } = document.documentElement;
  return scrollWidth > innerWidth || scrollHeight > innerHeight ? [...found, "the page scrolls"] : found;
}"""
#: Opens the sections of the inspector.
UNFOLD = "() => document.querySelectorAll('.pane h3 [aria-expanded=false]').forEach(each => each.click())"
SELECTED = (("link", "crank"), ("point", "A"), ("pair", "cylinder"), ("load", "press"), ("driver", "driver"))
DIALOGS = ("palette", "open", "save", "link", "keys", "tools", "exercise")


@pytest.mark.parametrize("language", ["en", pytest.param("zh", marks=pytest.mark.rotating)])
def test_everything_on_a_phone_is_large_enough_for_a_finger(chromium: Any, tmp_path: Path, language: str) -> None:
    text = store.text("slider_crank_inline").rstrip()
    force = "press: {kind: force, on: piston, at: B, direction: 180 deg, magnitude: 100 N}"
    (tmp_path / "press.yaml").write_text(f"{text}\nloads:\n  {force}\n")
    with hand(chromium, tmp_path, "press.yaml", size=PHONE, touch=True) as shown:
        tab, small = shown.tab, {}
        tab.evaluate("language => bench.speak(language)", language)
        assert tab.evaluate("() => matchMedia('(pointer: coarse)').matches")

        def measure(name: str, script: str, argument: Any = None) -> None:
            tab.evaluate(script, argument)
            shown.settle()
            tab.evaluate(UNFOLD)
            shown.frame()
            if found := tab.evaluate(SMALL, 44):
                small[name] = found

        measure("handle", "() => { bench.drawer.value = 'handle'; }")
        measure("half", "() => { bench.drawer.value = 'half'; }")
        measure("full", "() => { bench.drawer.value = 'full'; }")
        for kind, name in SELECTED:
            measure(kind, "item => { bench.selection.value = [item]; }", {"kind": kind, "name": name})
        for name in ("numbers", "findings", "structure", "text"):
            measure(name, "name => { bench.tab.value = name; }", name)
        for name in ("curves", "sweep", "synthesis", "optimise", "compare"):
            measure(name, "name => { bench.dock.value = name; }", name)
        for name in DIALOGS:
            measure(f"dialog: {name}", "kind => { bench.dialog.value = { kind }; }", name)
        measure(
            "share",
            "() => { bench.dialog.value = null; document.querySelector('.top > button:last-child').click(); }",
        )
        shown.key("Escape")
        measure("menu", "() => document.querySelector('.top button').click()")
        assert small == {}


def test_a_window_at_200_percent_keeps_half_of_its_height_for_the_sheet(chromium: Any, tmp_path: Path) -> None:
    """The whole machine stands between the bar and what is at the foot of the sheet."""
    (tmp_path / "machine.yaml").write_text(store.text("crank_rocker"), encoding="utf-8")
    with hand(chromium, tmp_path, "machine.yaml", size={"width": 720, "height": 450}) as shown:
        for drawer, share in (("handle", 0.5), ("half", 0.3)):
            shown.tab.evaluate("drawer => { bench.drawer.value = drawer; }", drawer)
            shown.frame()
            shown.tab.evaluate("() => bench.view.fit()")
            sheet = shown.tab.locator(".paper").bounding_box()
            foot = shown.tab.locator(".sheet-foot").bounding_box()["y"]
            heights = [shown.at(*shown.point(name))[1] for name in ("O1", "O2", "A", "B", "P")]
            assert sheet["height"] >= share * 450
            assert sheet["y"] < min(heights) and max(heights) < foot
