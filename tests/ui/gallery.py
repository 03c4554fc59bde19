"""Every gallery file's living page, opened and dragged in Chromium: ``python -m tests.ui.gallery``."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.ui.browser import Opened, browser
from tests.ui.test_page import opened_and_dragged

import linkwright as lw


def main() -> int:
    """Says of every file whether its page has the solver's numbers; 1 where one has not."""
    failed = 0
    with browser() as chromium, tempfile.TemporaryDirectory() as folder:
        for name in lw.gallery_names():
            context = chromium.new_context(viewport={"width": 1280, "height": 900}, offline=True)
            try:
                opened_and_dragged(Opened(context.new_page()), Path(folder), name)
            except Exception as error:
                failed += 1
                print(f"{name}: {error}")
            else:
                print(f"{name}: agrees")
            context.close()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
