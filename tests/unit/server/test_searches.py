"""What an optimisation of the studio says, in the language of its page."""

from __future__ import annotations

import time

import pytest

import linkwright as lw
from linkwright.server.background import Background
from linkwright.server.search import optimised

SECTION = """optimize:
  vary: {coupler.length: 3.4..3.6 m}
  maximize: transmission_angle
  evaluations: 20
"""


@pytest.mark.parametrize(("language", "head"), [("en", "start"), ("zh", "原设计")])
def test_the_head_of_designs_is_in_the_language_of_the_page(language: str, head: str) -> None:
    background = Background()
    text = lw.read_document("gallery:crank_rocker").text + SECTION
    background.begin("optimum", optimised(text), language)
    for _ in range(600):
        found = background.state()
        if not found["running"]:
            break
        time.sleep(0.02)
    assert found["candidates"]
    assert found["head"][1] == head
