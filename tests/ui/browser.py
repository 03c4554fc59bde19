"""A real Chromium that opens living pages from the disk, without a network."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)
try:
    from playwright import sync_api
except ImportError:
    sync_api = None
needs_chromium = pytest.mark.skipif(
    sync_api is None or CHROMIUM is None,
    reason="playwright is not installed" if sync_api is None else "no Chromium on this machine",
)


class Worded:
    """A tab whose page is known by the keys of its words, whatever these are in its language."""

    def __init__(self, tab: Any) -> None:
        self.tab = tab

    def translate(self, key: str, **values: str) -> str:
        """What the page says for a key of the catalogues (``page.undo``, ``studio.save``)."""
        script = """([key, values]) => {
          linkwright.words.language = linkwright.language.value;
          return linkwright.words.say(key, values);
        }"""
        said: str = self.tab.evaluate(script, [key, values])
        return said

    def pattern(self, key: str, **values: str) -> re.Pattern[str]:
        """A sentence of the page with these values, and any others."""
        words: str = self.tab.evaluate("key => linkwright.data.words[linkwright.language.value][key]", key)
        names = re.findall(r"\{(\w+)\}", words)
        said = self.translate(key, **{name: values.get(name, "\0") for name in names})
        return re.compile(re.escape(said).replace("\0", ".*"), re.DOTALL)

    def button(self, key: str, **values: str) -> Any:
        """The first button with the words of a key."""
        return self.tab.get_by_role("button", name=self.translate(key, **values), exact=True).first

    def labelled(self, key: str, **values: str) -> Any:
        """The element with the label of a key."""
        return self.tab.get_by_label(self.translate(key, **values), exact=True)

    def turn_over(self) -> None:
        """Chooses the other language."""
        self.tab.locator(".language").click()


class Opened(Worded):
    """A page of the browser with one living page in it; every error on it fails the test."""

    def __init__(self, tab: Any) -> None:
        super().__init__(tab)
        self.errors: list[str] = []
        self.requests: list[str] = []
        tab.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        tab.on("pageerror", lambda error: self.errors.append(str(error)))
        tab.on("request", lambda request: self.requests.append(request.url))

    def forget(self) -> None:
        """Errors and requests so far are those of another test."""
        self.errors.clear()
        self.requests.clear()

    def open(self, path: Path, hash: str = "") -> None:
        """Opens a file and waits until the machine is drawn."""
        self.tab.goto("about:blank")
        self.tab.goto(path.as_uri() + hash)
        self.tab.wait_for_selector(
            "svg.machine .lw-pins *, svg.machine .lw-bodies *", state="attached", timeout=10_000
        )
        assert self.errors == []

    def run(self, script: str, argument: Any = None) -> Any:
        """What a function of the page's first session gives: ``(session, argument) => ...``."""
        return self.tab.evaluate(f"argument => ({script})(linkwright.sessions[0], argument)", argument)

    def rows(self, names: list[str]) -> dict[str, list[float]]:
        """Outputs over all positions."""
        script = "(s, names) => Object.fromEntries(names.map(n => [n, [...s.model.main.row(n)]]))"
        found: dict[str, list[float]] = self.run(script, names)
        return found

    def values(self) -> dict[str, float]:
        """The changeable dimensions as they are."""
        script = "s => Object.fromEntries(s.data.dimensions.map(d => [d.address, s.model.values[d.address]]))"
        found: dict[str, float] = self.run(script)
        return found

    def middle(self, key: str) -> tuple[float, float]:
        """Where a joint's handle is on the screen."""
        box = self.tab.locator(f'.handle[data-key="{key}"]').bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, key: str, right: float, down: float, steps: int = 5) -> None:
        """Drags a joint over the screen."""
        x, y = self.middle(key)
        self.tab.mouse.move(x, y)
        self.tab.mouse.down()
        self.tab.mouse.move(x + right, y + down, steps=steps)
        self.tab.mouse.up()
        self.tab.evaluate("() => new Promise(requestAnimationFrame)")

    @property
    def status(self) -> str:
        """What the page says below the machine."""
        text: str = self.tab.locator(".status").first.inner_text()
        return text

    @property
    def notes(self) -> list[str]:
        """The notes beside the machine."""
        found: list[str] = self.tab.locator(".note").all_inner_texts()
        return found

    def wall(self) -> dict[str, Any] | None:
        """What stopped the last change, which stands below the machine as the page's sentence for it."""
        wall: dict[str, Any] | None = self.run("s => s.model.wall")
        if wall is not None:
            assert self.status == self.run("s => linkwright.wall(s, s.model.wall)") != ""
        return wall


@contextmanager
def browser(*arguments: str) -> Iterator[Any]:
    """A Chromium, started with further arguments."""
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", *arguments])
        yield started
        started.close()
