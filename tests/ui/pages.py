"""Living pages of the gallery, each made once by every worker, and of other models' texts."""

from __future__ import annotations

import atexit
import shutil
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

from tests import store

import linkwright as lw

#: Positions of the pages.
STEPS = 72
FOLDER = Path(mkdtemp(prefix="linkwright-pages-"))
atexit.register(shutil.rmtree, FOLDER, ignore_errors=True)


@cache
def page(name: str) -> Path:
    """The page of a gallery file; it hands out the file's text."""
    path = FOLDER / f"{name}.html"
    return lw.export(store.motion(name, STEPS), path, text=store.text(name), force=True)


def page_of(text: str, folder: Path) -> Path:
    """The page of a model's text."""
    return lw.export(lw.solve_motion(lw.loads(text), steps=STEPS), folder / "page.html", text=text, force=True)
