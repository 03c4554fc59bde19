"""A real Chromium that opens living pages from the disk, without a network."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))),
    None,
)
sync_api: Any = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")


class Opened:
    """A page of the browser with one living page in it; every error on it fails the test."""

    def __init__(self, tab: Any) -> None:
        self.tab = tab
        self.errors: list[str] = []
        self.requests: list[str] = []
        tab.on(
            "console", lambda message: self.errors.append(message.text) if message.type == "error" else None
        )
        tab.on("pageerror", lambda error: self.errors.append(str(error)))
        tab.on("request", lambda request: self.requests.append(request.url))

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


@contextmanager
def browser(*arguments: str) -> Iterator[Any]:
    """A Chromium, started with further arguments."""
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", *arguments])
        yield started
        started.close()
