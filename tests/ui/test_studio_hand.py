"""The studio's tools in a hand that slips: clicks, what is written, what is drawn, what the page says."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.ui.browser import browser, needs_chromium
from tests.ui.studio import serving
from tests.ui.test_studio_drawing import FOURBAR

import linkwright as lw
from linkwright.server.files import Files

Place = tuple[float, float]
NASTY = "<img src=x onerror=window.bad=1><script>window.bad=2</script>"


class Hand:
    """A hand on the drawing paper; places are shares of it."""

    def __init__(self, tab: Any) -> None:
        self.tab = tab
        self.errors: list[str] = []
        tab.on("pageerror", lambda error: self.errors.append(str(error)))

    def at(self, x: float, y: float) -> Place:
        """A place on the screen."""
        box = self.tab.locator("svg.drafting").bounding_box()
        return box["x"] + x * box["width"], box["y"] + y * box["height"]

    def point(self, name: str) -> Place:
        """Where a point is drawn on the screen."""
        box = self.tab.locator(f'svg.drafting [data-point="{name}"]').bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def click(self, *places: Place) -> None:
        """Clicks on the paper."""
        for place in places:
            self.tab.mouse.click(*self.at(*place))

    def press(self, name: str, exact: bool = True) -> None:
        """A button."""
        self.tab.get_by_role("button", name=name, exact=exact).first.click()

    def tool(self, name: str, value: str = "") -> None:
        """Takes a tool, with a value."""
        self.tab.get_by_role("toolbar").get_by_role("button", name=name, exact=True).click()
        if value:
            self.tab.get_by_label("Value").fill(value)

    def settle(self) -> None:
        """Waits until what was drawn is in the text, and that is solved and drawn."""
        done = "() => !desk.pending && desk.text.value && desk.solved.value.text === desk.text.value"
        self.tab.wait_for_function(done)
        self.tab.evaluate("() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))")

    def tells(self, words: str) -> None:
        """Waits for a sentence at the foot of the page."""
        self.tab.locator(".said", has_text=words).wait_for()

    @property
    def text(self) -> str:
        """The model file as the page has it."""
        found: str = self.tab.evaluate("() => desk.text.value")
        return found

    def picture(self) -> None:
        """Draws the four-bar of the tests."""
        self.tool("Fixed point")
        self.click((0.25, 0.7), (0.65, 0.7))
        self.tool("Link")
        for way in (((0.25, 0.7), (0.32, 0.58)), ((0.32, 0.58), (0.58, 0.25)), ((0.58, 0.25), (0.65, 0.7))):
            self.click(*way)
            self.tab.keyboard.press("Enter")
        self.tool("Drive")
        self.click((0.285, 0.64))
        self.settle()


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """One browser for all tests of this file."""
    with browser() as started:
        yield started


@contextmanager
def hand(chromium: Any, folder: Path, file: str | None = None) -> Iterator[Hand]:
    """A hand in a studio of a folder."""
    with serving(folder, file) as studio:
        found = Hand(chromium.new_page(viewport={"width": 1360, "height": 900}))
        found.tab.set_default_timeout(20_000)
        found.tab.goto(studio.url)
        found.tab.wait_for_selector("svg.drafting" if file is None else "textarea")
        found.settle()
        yield found
        found.tab.close()
        assert found.errors == []


@needs_chromium
def test_a_stray_click_leaves_nothing_and_run_says_what_is_missing(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.press("Run")
        drawn.tells("It cannot run yet: the model has no frame")
        before = drawn.text
        drawn.tool("Link")
        drawn.click((0.9, 0.9))
        assert drawn.tab.locator(".lw-pin").count() == 1
        drawn.tab.keyboard.press("Escape")
        assert drawn.tab.locator(".lw-pin").count() == 0
        drawn.click((0.9, 0.9))
        drawn.tool("Fixed point")
        assert drawn.tab.locator(".lw-pin").count() == 0
        assert drawn.text == before
        drawn.picture()
        drawn.tool("Drive")
        drawn.click((0.45, 0.415))
        drawn.tells("bar1 has no fixed point")
        drawn.tool("Remove")
        drawn.click((0.58, 0.25))
        drawn.settle()
        drawn.tells("bar1, arm2 are no longer joined there")
        assert len(yaml.safe_load(drawn.text)["links"]) == 3
        drawn.press("Run")
        drawn.tells("nothing determines the motion of 'bar1', 'arm2'")
        assert drawn.tab.locator("svg.drafting").is_visible()
        for left in (["O1", "O2"], ["O1"]):
            drawn.tool("Remove")
            drawn.click((0.65, 0.7))
            drawn.settle()
            assert list(yaml.safe_load(drawn.text)["frame"]["points"]) == left
        for _ in range(3):
            drawn.press("Undo")
            drawn.settle()
        drawn.press("Run")
        drawn.tab.wait_for_selector(".plot")


@needs_chromium
def test_loads_go_where_the_hand_points_and_can_be_taken_away(chromium: Any, tmp_path: Path) -> None:
    """On the link under the pointer, in the direction of the second click; wrong values are not written."""
    with hand(chromium, tmp_path) as drawn:
        drawn.picture()
        drawn.tool("Mass", "3 kg")
        drawn.click((0.615, 0.475))
        drawn.tells("m·l²/12")
        drawn.settle()
        arm = lw.loads(drawn.text).link("arm2")
        assert (arm.mass, arm.inertia) == (3.0, pytest.approx(3 * arm.reach**2 / 12, rel=1e-3))
        before = drawn.text
        drawn.tool("Load", "250 N, 180 deg")
        drawn.click((0.6, 0.38), (0.9, 0.38))
        drawn.tells("unknown unit")
        assert drawn.text == before
        drawn.tab.get_by_label("Value").fill("250 N")
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
        drawn.tool("Move")
        drawn.tab.mouse.click(x + 35, y)
        drawn.tells("load1: 250 N on bar1 B")
        drawn.tab.keyboard.press("Delete")
        drawn.tells("Load load1 removed")
        drawn.settle()
        drawn.tool("Remove")
        drawn.tab.mouse.click(x - 35, y)
        drawn.tells("Load load3 removed")
        drawn.settle()
        drawn.tab.get_by_label("Remove load2").click()
        drawn.tells("Load load2 removed")
        drawn.settle()
        assert drawn.text.rstrip() == before.rstrip()


@needs_chromium
def test_a_new_drawing_saved_under_the_name_of_the_first_keeps_both(chromium: Any, tmp_path: Path) -> None:
    """The page asks; the first one has a new name then, and is opened by it. Notes change with the language."""
    with hand(chromium, tmp_path) as drawn:
        drawn.picture()
        first = drawn.text
        drawn.press("New")
        drawn.tab.wait_for_function("() => desk.name.value === 'machine2.yaml'")
        drawn.tool("Fixed point")
        drawn.click((0.3, 0.3))
        drawn.settle()
        second = drawn.text
        drawn.tab.get_by_label("File name").fill("machine.yaml")
        drawn.press("Save")
        drawn.tab.locator(".banner", has_text="machine.yaml is there already").wait_for()
        assert not list(tmp_path.glob("*.yaml"))
        drawn.press("Overwrite")
        drawn.tells("The unsaved drawing that was called machine.yaml is now machine3.yaml")
        assert (tmp_path / "machine.yaml").read_text() == second
        drawn.tab.get_by_label("Open", exact=True).select_option("machine3.yaml")
        drawn.tab.wait_for_function("text => desk.text.value === text", arg=first)
        drawn.press("Save")
        drawn.tells("Saved.")
        assert (tmp_path / "machine3.yaml").read_text() == first
        drawn.press("中文")
        drawn.tab.wait_for_function("() => !document.querySelector('.said').textContent.includes('Saved')")


@needs_chromium
def test_what_is_changed_just_before_another_file_is_opened_is_a_draft(chromium: Any, tmp_path: Path) -> None:
    """The server is slow with the first change: the second one goes to its own file all the same."""
    (tmp_path / "a.yaml").write_text(FOURBAR)
    (tmp_path / "b.yaml").write_text("# another\n" + FOURBAR)
    slow = """() => {
      const ask = window.fetch, late = () => new Promise((go) => setTimeout(go, 400));
      window.fetch = async (to, asked) => (String(to).endsWith("/keep") && (await late()), ask(to, asked));
    }"""
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        drawn.tab.evaluate(slow)
        drawn.tab.locator("textarea").fill(FOURBAR + "# one\n")
        drawn.tab.locator("textarea").fill(FOURBAR + "# two\n")
        drawn.tab.get_by_label("Open", exact=True).select_option("b.yaml")
        drawn.tab.wait_for_function("() => desk.name.value === 'b.yaml'")
        drawn.tab.get_by_label("Open", exact=True).select_option("a.yaml")
        drawn.tab.wait_for_function("() => desk.name.value === 'a.yaml'")
        assert drawn.text == FOURBAR + "# two\n"


@needs_chromium
def test_a_file_that_two_windows_have_changed_is_not_left_before_one_text_is_chosen(
    chromium: Any, tmp_path: Path
) -> None:
    """The other window's change came through another server of the folder; mine is stored once it is chosen."""
    for name in ("a.yaml", "b.yaml"):
        (tmp_path / name).write_text(FOURBAR)
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        Files(tmp_path).keep("a.yaml", FOURBAR + "# theirs\n", "another window", 0)
        drawn.tab.locator("textarea").fill(FOURBAR + "# mine\n")
        drawn.tab.locator(".banner", has_text="Another window has changed this file").wait_for()
        drawn.tab.get_by_label("Open", exact=True).select_option("b.yaml")
        drawn.tab.wait_for_timeout(300)
        assert drawn.text == FOURBAR + "# mine\n"
        drawn.press("Keep mine")
        drawn.tab.locator(".banner").wait_for(state="detached")
        drawn.tab.get_by_label("Open", exact=True).select_option("b.yaml")
        drawn.tab.wait_for_function("() => desk.name.value === 'b.yaml'")
        assert Files(tmp_path).open("a.yaml")["text"] == FOURBAR + "# mine\n"


@needs_chromium
def test_names_and_sizes_of_loads_are_text_on_the_paper(chromium: Any, tmp_path: Path) -> None:
    """Markup in a load's name, size or point, on the paper, in the list and in sentences, becomes no element."""
    loads = (
        f'loads:\n  "{NASTY}": {{kind: force, on: rocker, at: B, direction: 0 deg, magnitude: "{NASTY}"}}\n'
    )
    (tmp_path / "a.yaml").write_text(FOURBAR + loads)
    with serving(tmp_path, "a.yaml") as studio:
        found = Hand(
            chromium.new_context(viewport={"width": 1360, "height": 900}, bypass_csp=True).new_page()
        )
        found.tab.set_default_timeout(20_000)
        found.tab.goto(studio.url)
        found.tab.locator("svg.drafting .load").wait_for()
        found.tool("Move")
        x, y = found.point("B")
        found.tab.mouse.click(x + 35, y)
        found.tells("window.bad=2</script>: ")
        assert found.tab.locator(".loads li", has_text="window.bad=1").count() == 1
        found.press("Run")
        found.tells("It cannot run yet")
        foreign = "() => [window.bad ?? 0, document.querySelectorAll('img, #page script').length]"
        assert found.tab.evaluate(foreign) == [0, 0]
        found.tab.close()
    assert found.errors == []
