"""A page whose programs no WebAssembly module could be made of."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests import store
from tests.ui.agreement import rows_agree
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import page_of

from linkwright.page import content

pytestmark = [needs_chromium, pytest.mark.rotating]


def test_without_webassembly_the_same_numbers(
    opened: Opened, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(content, "wasm_module", lambda programs: None)
    opened.open(page_of(store.text("jaw_crusher_sixbar"), tmp_path))
    rows_agree(opened, store.machine("jaw_crusher_sixbar"))
    assert opened.notes == [opened.say("page.text_kernel")]
