"""Points of unfinished texts that only lengths place are drawn with these lengths."""

from __future__ import annotations

import math

import pytest
from tests import store

from linkwright.server.work import solved

CHAIN = """format: 1
frame: {points: {O: [0 mm, 0 mm], P: [100 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 30 mm}
  rod: {points: [A, B], length: 90 mm, also: {C: [40 mm, 20 mm]}}
  lever: {points: [P, B], length: 60 mm}
"""


def test_points_of_an_unfinished_text_stand_as_their_lengths_say() -> None:
    """A four-bar that nothing drives; an open chain; lengths that do not close are drawn all the same."""
    answer = solved(CHAIN, "en")
    assert answer["model"] is None
    places = {**answer["picture"]["points"], **answer["picture"]["sketched"]}
    sizes = {"OA": 0.03, "AB": 0.09, "PB": 0.06, "AC": math.hypot(0.04, 0.02), "BC": math.hypot(0.05, 0.02)}
    assert {ends: math.dist(places[ends[0]], places[ends[1]]) for ends in sizes} == pytest.approx(sizes, abs=1e-6)
    open_chain = solved(CHAIN.replace("  lever: {points: [P, B], length: 60 mm}\n", ""), "en")["picture"]
    assert set(open_chain["sketched"]) == {"A", "B", "C"}
    far = solved(CHAIN.replace("60 mm}", "600 mm}"), "en")["picture"]
    assert set(far["sketched"]) == {"A", "B", "C"}
    assert solved("format: 1\nlinks: {a: {points: [A, B]}}\n", "en")["picture"]["sketched"]["A"] == [0, 0]
    assert "sketched" not in solved(store.text("crank_rocker"), "en")["picture"]
