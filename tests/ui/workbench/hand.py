"""A hand on the workbench: tools by their keys or on the rail, places in metres, values typed, the file then."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import yaml
from tests.ui.browser import Worded
from tests.ui.studio import serving

Place = tuple[float, float]
DESK = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
#: What was done is in the text, that is solved, and the sheet shows it.
SETTLED = """() => !desk.pending && desk.text.value && desk.solved.value.text === desk.text.value
  && (!desk.solved.value.model || bench.session.value?.data.text === desk.text.value)"""
#: The names of the keys that take tools.
KEYS = {
    "move": "v", "pivot": "p", "link": "l", "plate": "b", "slider": "s", "slot": "o", "weld": "w", "gears": "g",
    "rack": "r", "cam": "c", "drive": "d", "force": "f", "torque": "t", "spring": "k", "mass": "m",
    "dimension": "n", "target": "u", "photo": "i", "erase": "e",
}  # fmt: skip


class Hand(Worded):
    """A hand on the sheet; places are metres of the drawing."""

    def __init__(self, tab: Any) -> None:
        super().__init__(tab)
        self.errors: list[str] = []
        tab.on("pageerror", lambda error: self.errors.append(str(error)))
        tab.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        tab.set_default_timeout(20_000)

    # where things are

    def at(self, x: float, y: float) -> Place:
        """A place of the sheet (m) on the screen."""
        found: list[float] = self.tab.evaluate(
            """place => {
              const box = document.querySelector(".paper").getBoundingClientRect();
              const [x, y] = bench.sheet.value.camera.screen(place);
              return [box.left + x, box.top + y];
            }""",
            [x, y],
        )
        return found[0], found[1]

    def point(self, name: str) -> Place:
        """Where a point stands on the sheet, m."""
        found: list[float] = self.tab.evaluate("name => bench.sheet.value.scene.at(name)", name)
        return found[0], found[1]

    def middle(self, *names: str) -> Place:
        """The middle of points, m."""
        places = [self.point(name) for name in names]
        return sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places)

    def look(self, left: float, low: float, right: float, high: float) -> None:
        """Puts a box (m) into the sheet."""
        script = "box => { bench.sheet.value.camera.fit(box); bench.sheet.value.zoom(1); }"
        self.tab.evaluate(script, [left, low, right, high])
        self.frame()

    @property
    def scale(self) -> float:
        """Pixels for a metre."""
        return float(self.tab.evaluate("() => bench.sheet.value.camera.scale"))

    @property
    def step(self) -> float:
        """The spacing of the grid, m."""
        return float(self.tab.evaluate("() => bench.sheet.value.step"))

    @property
    def cross(self) -> Place:
        """Where the cross of the keyboard is, m."""
        x, y = self.tab.evaluate("() => bench.sheet.value.cross")
        return float(x), float(y)

    # what it does

    def take(self, tool: str) -> None:
        """Takes a tool by its key."""
        self.tab.keyboard.press(KEYS[tool])

    def rail(self, tool: str) -> None:
        """Takes a tool on the rail."""
        self.tab.locator(f'[data-tool="{tool}"]:not(main)').first.click()

    def click(self, *places: Place, keys: str = "") -> None:
        """Clicks on the sheet, the pointer moving there first; ``keys``: held meanwhile."""
        for place in places:
            self.go(place)
            if keys:
                self.tab.keyboard.down(keys)
            self.tab.mouse.down()
            self.tab.mouse.up()
            if keys:
                self.tab.keyboard.up(keys)

    def go(self, place: Place) -> None:
        """Moves the pointer."""
        self.tab.mouse.move(*self.at(*place))

    def drag(self, start: Place, end: Place, steps: int = 4) -> None:
        """Drags over the sheet."""
        self.go(start)
        self.tab.mouse.down()
        self.tab.mouse.move(*self.at(*end), steps=steps)
        self.tab.mouse.up()

    def tap(self, *places: Place) -> None:
        """Taps on the sheet with a finger."""
        for place in places:
            self.tab.touchscreen.tap(*self.at(*place))

    def pinch(self, about: Place, before: float, after: float) -> None:
        """Moves two fingers apart, or together, about a place of the screen (px)."""
        client = self.tab.context.new_cdp_session(self.tab)

        def send(kind: str, apart: float | None) -> None:
            sides = [] if apart is None else [-0.5, 0.5]
            points = [{"x": about[0] + side * (apart or 0), "y": about[1]} for side in sides]
            client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        send("touchStart", before)
        for k in range(1, 6):
            send("touchMove", before + (after - before) * k / 5)
        send("touchEnd", None)
        self.frame()

    def key(self, *keys: str) -> None:
        """Presses keys, one after the other."""
        for key in keys:
            self.tab.keyboard.press(key)

    def type(self, *values: str) -> None:
        """Types values in hand, one field after the other, and sets them."""
        for k, value in enumerate(values):
            if k:
                self.tab.keyboard.press("Tab")
            self.tab.keyboard.type(value)
        self.tab.keyboard.press("Enter")

    def draw(self, *links: tuple[Place, Place]) -> None:
        """Draws links from place to place."""
        self.take("link")
        for link in links:
            self.click(*link)
            self.settle()
            self.tab.keyboard.press("Escape")

    def settle(self) -> None:
        """Waits until what was done is in the text, solved and drawn."""
        self.tab.wait_for_function(SETTLED)
        self.frame()

    def frame(self) -> None:
        """Waits for the next picture."""
        self.tab.evaluate("() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))")

    # what the page has

    @property
    def text(self) -> str:
        """The model file as the page has it."""
        found: str = self.tab.evaluate("() => desk.text.value")
        return found

    @property
    def entries(self) -> dict[str, Any]:
        """The same as data."""
        found: dict[str, Any] = yaml.safe_load(self.text) or {}
        return found

    @staticmethod
    def metres(text: str) -> float:
        """A length of the file."""
        number, unit = text.split()
        return float(number) * {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}[unit]

    @property
    def selected(self) -> list[str]:
        """Names of what is selected."""
        found: list[str] = self.tab.evaluate("() => bench.selection.value.map(({ name }) => name)")
        return found

    @property
    def refusal(self) -> str:
        """Why the last click was refused, "": it was not."""
        found: str = self.tab.evaluate("() => bench.refusal.value?.sentence ?? ''")
        return found


@contextmanager
def hand(
    chromium: Any,
    folder: Path,
    file: str | None = None,
    *,
    size: dict[str, int] | None = None,
    touch: bool = False,
    bypass_csp: bool = False,
) -> Iterator[Hand]:
    """A hand on the workbench of a folder, in a window of its own; errors on the page fail the test."""
    with serving(folder, file) as studio:
        context = chromium.new_context(
            viewport=size or DESK, has_touch=touch, reduced_motion="reduce", bypass_csp=bypass_csp
        )
        found = Hand(context.new_page())
        found.tab.goto(f"{studio.url}")
        found.tab.wait_for_function("() => globalThis.bench?.sheet.value && desk.solved.value.text !== undefined")
        found.settle()
        yield found
        context.close()
        assert found.errors == [], found.errors
