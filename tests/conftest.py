"""The tests import each other's helpers as `tests....`, and keep compiled code out of the user's cache."""

import gc
import os
import sys
import tempfile
from pathlib import Path

ROOT = str(Path(__file__).resolve().parents[1])
if ROOT not in sys.path:
    sys.path.insert(0, ROOT)

os.environ.setdefault("LINKWRIGHT_CACHE", str(Path(tempfile.gettempdir()) / "linkwright-tests-cache"))
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # workers share the cores; threads that wait spin
gc.set_threshold(50_000)  # with Python's own 700 the collector takes a seventh of the tests' time


def pytest_collection_finish() -> None:
    """What importing and collecting left stays: the collector need not look through it during the tests."""
    gc.collect()
    gc.freeze()
