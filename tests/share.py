"""Which tests a run holds: the fixed core with today's seventh of the rest, or more.

Tests marked ``rotating`` run on one day of seven, which their names choose: seven runs on days that follow each other
meet them all. Tests marked ``long`` run in the long run only (``python -m tests.long``). Where folders or files are
named all their tests but the long ones run, where a test is named it runs.
"""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from datetime import date
from typing import TypeVar

import pytest

SHARES = 7
OPTION = "--share"
#: All shares; these and the long tests.
WEEK, EVERYTHING = "week", "all"
#: The share of this run.
running = WEEK
Kind = TypeVar("Kind")


def today() -> str:
    """The share of this day: the days in order, 0 to 6."""
    return str(date.today().toordinal() % SHARES)


def share_of(name: str) -> str:
    """The share that a test belongs to by its name: the same on every machine."""
    return str(zlib.crc32(name.encode("utf-8")) % SHARES)


def asked_for(config: pytest.Config) -> str:
    """The share that a command means: what it says, or by what it names."""
    said: str | None = config.getoption(OPTION)
    if said is not None:
        return said
    if any("::" in argument for argument in config.args):
        return EVERYTHING
    return today() if config.args == config.getini("testpaths") else WEEK


def runs(item: pytest.Item, share: str) -> bool:
    """Whether a test runs in a share."""
    if share == EVERYTHING:
        return True
    if item.get_closest_marker("long"):
        return False
    return share in (WEEK, share_of(item.nodeid)) or not item.get_closest_marker("rotating")


def divided(items: Sequence[pytest.Item], share: str) -> tuple[list[pytest.Item], list[pytest.Item]]:
    """The tests of a share, and the others."""
    chosen = [item for item in items if runs(item, share)]
    kept = set(chosen)
    return chosen, [item for item in items if item not in kept]


def in_turn(kinds: Sequence[Kind], place: int, count: int) -> list[Kind]:
    """Those ``count`` of the kinds (of pictures, of formats) that the file at ``place`` of its gallery meets in this
    share; with everything, all: every file in every picture is a product without end."""
    if running == EVERYTHING or count >= len(kinds):
        return list(kinds)
    first = place * count + (int(running) if running.isdigit() else 0)
    return [kinds[(first + k) % len(kinds)] for k in range(count)]
