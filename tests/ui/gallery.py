"""Every gallery file's living page in Chromium, dragged, its numbers, its file: ``python -m tests.ui.gallery``."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.ui.browser import Opened, browser
from tests.ui.test_page import opened_and_dragged
from tests.ui.test_page_files import handed_out_and_read
from tests.ui.test_page_numbers import numbers_agree

import linkwright as lw


def main() -> int:
    """Says of every file whether its page has the solver's numbers and hands out its machine; 1 where not."""
    failed = 0
    with browser() as chromium, tempfile.TemporaryDirectory() as folder:
        for name in lw.gallery_names():
            context = chromium.new_context(viewport={"width": 1280, "height": 900}, offline=True)
            page, text = Opened(context.new_page()), lw.read_document(f"gallery:{name}").text
            try:
                opened_and_dragged(page, Path(folder), name)
                numbers_agree(page, Path(folder), text)
                handed_out_and_read(page, Path(folder), text)
            except Exception as error:
                failed += 1
                print(f"{name}: {error}")
            else:
                print(f"{name}: agrees")
            context.close()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
