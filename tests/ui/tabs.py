"""One Chromium and one tab for all tests that a worker runs: fixtures, which `tests/conftest.py` names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from tests.ui.browser import Opened, browser

DESKTOP = {"width": 1280, "height": 900}


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """The browser."""
    with browser() as started:
        yield started


@pytest.fixture(scope="session")
def kept_open(chromium: Any) -> Iterator[Opened]:
    context = chromium.new_context(viewport=DESKTOP, offline=True)
    yield Opened(context.new_page())
    context.close()


@pytest.fixture
def opened(kept_open: Opened) -> Opened:
    """The tab, as if it were new: pages keep nothing in the browser."""
    kept_open.forget()
    return kept_open


@pytest.fixture
def fresh(chromium: Any) -> Iterator[Opened]:
    """A tab of its own, for what would stay in it."""
    context = chromium.new_context(viewport=DESKTOP, offline=True)
    yield Opened(context.new_page())
    context.close()
