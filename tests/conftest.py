"""Which tests run, compiled code outside the user's cache, and what was left out with its reason."""

import gc
import os
import sys
import tempfile
from collections import Counter
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = str(Path(__file__).resolve().parents[1])
if ROOT not in sys.path:
    sys.path.insert(0, ROOT)

from hatch_build import compile_translations  # noqa: E402
from tests import share  # noqa: E402

pytest_plugins = ["tests.ui.tabs"] if find_spec("playwright") else []

os.environ.setdefault("LINKWRIGHT_CACHE", str(Path(tempfile.gettempdir()) / "linkwright-tests-cache"))
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # workers share the cores; threads that wait spin
compile_translations(Path(ROOT) / "src")
gc.set_threshold(50_000)  # with Python's own 700 the collector takes a seventh of the tests' time


def pytest_addoption(parser: pytest.Parser) -> None:
    """``--share``, of the tests marked ``rotating``."""
    parser.addoption(
        share.OPTION,
        choices=[*map(str, range(share.SHARES)), share.WEEK, share.EVERYTHING],
        help="which seventh of the rotating tests runs (today's, where no file is named), week for all of them, "
        "all for the long ones too",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Workers are told the share that the whole run has: they see neither the command nor the same day."""
    config.option.share = share.running = share.asked_for(config)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """What does not run in this share is left out."""
    items[:], others = share.divided(items, config.option.share)
    if others:
        config.hook.pytest_deselected(items=others)


def pytest_collection_finish() -> None:
    """What importing and collecting left stays: the collector need not look through it during the tests."""
    gc.collect()
    gc.freeze()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Which share ran, and what was skipped, with how many tests for each reason."""
    reasons = Counter(str(report.longrepr[2]) for report in terminalreporter.stats.get("skipped", ()))
    for reason, count in sorted(reasons.items()):
        terminalreporter.write_line(f"skipped, {count}: {reason.removeprefix('Skipped: ')}")
    terminalreporter.write_line(f"share of the rotating tests (--share): {config.option.share}")
