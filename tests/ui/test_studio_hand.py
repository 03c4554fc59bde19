"""The studio's tools in a hand that slips: clicks, what is written, what is drawn, what the page says."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.ui.browser import needs_chromium
from tests.ui.hand import FOREIGN, SLOW_TO_KEEP, hand
from tests.ui.studio import asked, serving
from tests.ui.texts import FOURBAR

import linkwright as lw

pytestmark = needs_chromium
NASTY = "<img src=x onerror=window.bad=1><script>window.bad=2</script>"


@pytest.mark.rotating
def test_a_stray_click_leaves_nothing_and_run_says_what_is_missing(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.press("studio.run")
        drawn.tells("studio.cannot_run")
        before = drawn.text
        drawn.tool("link")
        drawn.click((0.9, 0.9))
        assert drawn.tab.locator(".lw-pin").count() == 1
        drawn.tab.keyboard.press("Escape")
        assert drawn.tab.locator(".lw-pin").count() == 0
        drawn.click((0.9, 0.9))
        drawn.tool("fixed")
        assert drawn.tab.locator(".lw-pin").count() == 0
        assert drawn.text == before
        drawn.picture()
        drawn.tool("driver")
        drawn.click((0.45, 0.415))
        drawn.tells("studio.no_drive", link="bar1")
        drawn.tool("remove")
        drawn.click((0.58, 0.25))
        drawn.settle()
        drawn.mentions("Pin B removed: bar1, arm2 are no longer joined there")
        assert len(yaml.safe_load(drawn.text)["links"]) == 3
        drawn.press("studio.run")
        drawn.tells("studio.cannot_run")
        assert drawn.tab.locator("svg.drafting").is_visible()
        for left in (["O1", "O2"], ["O1"]):
            drawn.tool("remove")
            drawn.click((0.65, 0.7))
            drawn.settle()
            assert list(yaml.safe_load(drawn.text)["frame"]["points"]) == left
        for _ in range(3):
            drawn.press("page.undo")
            drawn.settle()
        drawn.press("studio.run")
        drawn.tab.wait_for_selector(".plot")


def test_loads_go_where_the_hand_points_and_can_be_taken_away(chromium: Any, tmp_path: Path) -> None:
    """On the link under the pointer, in the direction of the second click; wrong values are not written."""
    with hand(chromium, tmp_path) as drawn:
        drawn.picture()
        drawn.tool("mass", "3 kg")
        drawn.click((0.615, 0.475))
        drawn.mentions("arm2: moment of inertia")
        drawn.settle()
        arm = lw.loads(drawn.text).link("arm2")
        assert (arm.mass, arm.inertia) == (3.0, pytest.approx(3 * arm.reach**2 / 12, rel=1e-3))
        before = drawn.text
        drawn.tool("load", "250 N, 180 deg")
        drawn.click((0.6, 0.38), (0.9, 0.38))
        drawn.mentions("N, 180 deg")
        assert drawn.text == before
        drawn.labelled("studio.value").fill("250 N")
        for near, to in (((0.565, 0.27), (0.9, 0.25)), ((0.59, 0.31), (0.58, 0.6))):
            drawn.click(near)
            assert drawn.tab.locator(".lw-bar.chosen").count() == 1
            drawn.tab.mouse.move(*drawn.at(*to))
            assert drawn.tab.locator(".load.chosen .lw-load-head").count() == 1
            drawn.click(to)
            drawn.settle()
        x, y = drawn.point("B")
        drawn.tab.mouse.click(x, y)
        drawn.tab.mouse.click(x, y)
        drawn.tab.mouse.click(x - 90, y)
        drawn.settle()
        loads = lw.loads(drawn.text).loads.values()
        assert [(each.on, each.at) for each in loads] == [("bar1", "B"), ("arm2", "B"), ("arm2", "B")]
        assert [each.direction for each in loads] == pytest.approx([0, -math.pi / 2, math.pi])
        assert drawn.tab.locator("svg.drafting .load").count() == 3
        drawn.tool("select")
        drawn.tab.mouse.click(x + 35, y)
        drawn.tells("studio.load_chosen", name="load1", size="250 N", on="bar1", at="B")
        drawn.tab.keyboard.press("Delete")
        drawn.mentions("Load load1 removed.")
        drawn.settle()
        drawn.tool("remove")
        drawn.tab.mouse.click(x - 35, y)
        drawn.mentions("Load load3 removed.")
        drawn.settle()
        drawn.press("studio.remove_load", name="load2")
        drawn.mentions("Load load2 removed.")
        drawn.settle()
        assert drawn.text.rstrip() == before.rstrip()


@pytest.mark.rotating
def test_a_new_drawing_saved_under_the_name_of_the_first_keeps_both(chromium: Any, tmp_path: Path) -> None:
    """The page asks; the first one has a new name then, and is opened by it. Notes change with the language."""
    with hand(chromium, tmp_path) as drawn:
        drawn.picture()
        first = drawn.text
        drawn.press("studio.new")
        drawn.tab.wait_for_function("() => desk.name.value === 'machine2.yaml'")
        drawn.tool("fixed")
        drawn.click((0.3, 0.3))
        drawn.settle()
        second = drawn.text
        drawn.labelled("studio.name").fill("machine.yaml")
        drawn.press("studio.save")
        asks = drawn.translate("studio.there_already", name="machine.yaml")
        drawn.tab.locator(".banner", has_text=asks).wait_for()
        assert not list(tmp_path.glob("*.yaml"))
        drawn.press("studio.overwrite")
        drawn.tells("studio.set_aside", name="machine.yaml", aside="machine3.yaml")
        assert (tmp_path / "machine.yaml").read_text() == second
        drawn.labelled("studio.open").select_option("machine3.yaml")
        drawn.tab.wait_for_function("text => desk.text.value === text", arg=first)
        drawn.press("studio.save")
        drawn.tells("studio.saved")
        assert (tmp_path / "machine3.yaml").read_text() == first
        saved = drawn.translate("studio.saved")
        drawn.turn_over()
        drawn.tab.wait_for_function("said => document.querySelector('.said').textContent !== said", arg=saved)


@pytest.mark.rotating
def test_what_is_changed_just_before_another_file_is_opened_is_a_draft(chromium: Any, tmp_path: Path) -> None:
    """The server is slow with the first change: the second one goes to its own file all the same."""
    (tmp_path / "a.yaml").write_text(FOURBAR)
    (tmp_path / "b.yaml").write_text("# another\n" + FOURBAR)
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        drawn.tab.evaluate(SLOW_TO_KEEP, 400)
        drawn.tab.locator("textarea").fill(FOURBAR + "# one\n")
        drawn.tab.locator("textarea").fill(FOURBAR + "# two\n")
        drawn.labelled("studio.open").select_option("b.yaml")
        drawn.tab.wait_for_function("() => desk.name.value === 'b.yaml'")
        drawn.labelled("studio.open").select_option("a.yaml")
        drawn.tab.wait_for_function("() => desk.name.value === 'a.yaml'")
        assert drawn.text == FOURBAR + "# two\n"


@pytest.mark.rotating
def test_a_file_that_two_windows_have_changed_is_not_left_before_one_text_is_chosen(
    chromium: Any, tmp_path: Path
) -> None:
    """The other window's change came through another server of the folder; mine is stored once it is chosen."""
    for name in ("a.yaml", "b.yaml"):
        (tmp_path / name).write_text(FOURBAR)
    theirs = {"name": "a.yaml", "text": FOURBAR + "# theirs\n", "window": "another window", "serial": 0}
    with hand(chromium, tmp_path, "a.yaml") as drawn, serving(tmp_path) as other:
        assert asked(other, "keep", theirs)[0] == 200
        drawn.tab.locator("textarea").fill(FOURBAR + "# mine\n")
        drawn.tab.locator(".banner", has_text=drawn.translate("studio.elsewhere")).wait_for()
        drawn.labelled("studio.open").select_option("b.yaml")
        drawn.tab.wait_for_timeout(300)
        assert drawn.text == FOURBAR + "# mine\n"
        drawn.press("studio.keep_mine")
        drawn.tab.locator(".banner").wait_for(state="detached")
        drawn.labelled("studio.open").select_option("b.yaml")
        drawn.tab.wait_for_function("() => desk.name.value === 'b.yaml'")
        assert asked(other, "open", {"name": "a.yaml"})[1]["text"] == FOURBAR + "# mine\n"


def test_names_and_sizes_of_loads_are_text_on_the_paper(chromium: Any, tmp_path: Path) -> None:
    """Markup in a load's name, size or point, on the paper, in the list and in sentences, becomes no element."""
    loads = f'loads:\n  "{NASTY}": {{kind: force, on: rocker, at: B, direction: 0 deg, magnitude: "{NASTY}"}}\n'
    (tmp_path / "a.yaml").write_text(FOURBAR + loads)
    with hand(chromium, tmp_path, "a.yaml", bypass_csp=True) as found:
        found.tab.locator("svg.drafting .load").wait_for()
        found.tool("select")
        x, y = found.point("B")
        found.tab.mouse.click(x + 35, y)
        found.mentions("window.bad=2</script>")
        assert found.tab.locator(".loads li", has_text="window.bad=1").count() == 1
        found.press("studio.run")
        found.tells("studio.cannot_run")
        assert found.tab.evaluate(FOREIGN) == [0, 0]
