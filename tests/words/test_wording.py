"""The wording is that of the snapshots, which ``python -m tests.words`` writes and people read in review."""

from __future__ import annotations

from difflib import unified_diff

import pytest
from tests.words.wording import HERE, LANGUAGES, snapshot


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_wording_is_that_of_the_snapshot(language: str) -> None:
    held = (HERE / f"{language}.txt").read_text("utf-8").splitlines()
    now = snapshot(language)[0].splitlines()
    changed = "\n".join(unified_diff(held, now, "held", "now", lineterm="", n=0))
    assert not changed, f"if this is meant, write it with python -m tests.words:\n{changed}"
