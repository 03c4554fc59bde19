"""A hand on the studio's page: tools, clicks, what is written, what the page says."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.ui.browser import Worded
from tests.ui.studio import serving

Place = tuple[float, float]
DESK = {"width": 1360, "height": 900}
#: The text is solved and drawn.
AGREED = "() => desk.session.value?.data.text === desk.text.value"
#: Elements that only markup in a name could have made, and what its script would have left.
FOREIGN = "() => [window.bad ?? 0, document.querySelectorAll('img, #page script').length]"

#: Makes the page's drafts come to the server late, ms.
SLOW_TO_KEEP = """late => {
  const ask = window.fetch, wait = () => new Promise((go) => setTimeout(go, late));
  window.fetch = async (to, asked) => (String(to).endsWith("/keep") && (await wait()), ask(to, asked));
}"""


class Hand(Worded):
    """A hand on the drawing paper; places are shares of it."""

    def __init__(self, tab: Any) -> None:
        super().__init__(tab)
        self.errors: list[str] = []
        tab.on("pageerror", lambda error: self.errors.append(str(error)))
        tab.set_default_timeout(20_000)

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

    def press(self, key: str, **values: str) -> None:
        """A button, by the key of its words."""
        self.button(key, **values).click()

    def tool(self, key: str, value: str = "") -> None:
        """Takes a tool, with a value."""
        name = self.translate(f"studio.{key}")
        self.tab.get_by_role("toolbar").get_by_role("button", name=name, exact=True).click()
        if value:
            self.labelled("studio.value").fill(value)

    def settle(self) -> None:
        """Waits until what was drawn is in the text, and that is solved and drawn."""
        done = "() => !desk.pending && desk.text.value && desk.solved.value.text === desk.text.value"
        self.tab.wait_for_function(done)
        self.tab.evaluate("() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))")

    def solved(self) -> None:
        """Waits until the machine on the page is that of the text."""
        self.tab.wait_for_function(AGREED)

    def tells(self, key: str, **values: str) -> None:
        """Waits for a sentence at the foot of the page, by its key and values."""
        self.tab.locator(".said", has_text=self.pattern(key, **values)).wait_for()

    def mentions(self, *words: str) -> None:
        """Waits for a sentence of the server at the foot of the page that names these."""
        said = self.tab.locator(".said")
        for word in words:
            said = said.filter(has_text=word)
        said.wait_for()

    @property
    def area(self) -> Any:
        """The text field of the model file."""
        return self.tab.locator("textarea")

    @property
    def text(self) -> str:
        """The model file as the page has it."""
        found: str = self.tab.evaluate("() => desk.text.value")
        return found

    def becomes(self, what: str, text: str) -> None:
        """Waits until the text is, is not (``!==``) or holds (``includes``) a text."""
        wanted = "desk.text.value.includes(text)" if what == "includes" else f"desk.text.value {what} text"
        self.tab.wait_for_function(f"text => {wanted}", arg=text)

    def pull(self, key: str, right: float, down: float, steps: int = 3) -> None:
        """Pulls a joint of the machine over the screen, by its handle."""
        handle = self.tab.locator(f'.handle[data-key="{key}"]')
        handle.scroll_into_view_if_needed()
        box = handle.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.tab.mouse.move(x, y)
        self.tab.mouse.down()
        self.tab.mouse.move(x + right, y + down, steps=steps)
        self.tab.mouse.up()

    def picture(self) -> None:
        """Draws the four-bar of the tests."""
        self.tool("fixed")
        self.click((0.25, 0.7), (0.65, 0.7))
        self.tool("link")
        for way in (((0.25, 0.7), (0.32, 0.58)), ((0.32, 0.58), (0.58, 0.25)), ((0.58, 0.25), (0.65, 0.7))):
            self.click(*way)
            self.tab.keyboard.press("Enter")
        self.tool("driver")
        self.click((0.285, 0.64))
        self.settle()


@contextmanager
def hand(chromium: Any, folder: Path, file: str | None = None, *, bypass_csp: bool = False) -> Iterator[Hand]:
    """A hand in a studio of a folder, with a window of its own; ``bypass_csp``: the page's policy is off."""
    with serving(folder, file) as studio:
        context = chromium.new_context(viewport=DESK, bypass_csp=bypass_csp)
        found = Hand(context.new_page())
        found.tab.goto(studio.url)
        found.tab.wait_for_selector("svg.drafting" if file is None else "textarea")
        found.settle()
        yield found
        context.close()
        assert found.errors == []
