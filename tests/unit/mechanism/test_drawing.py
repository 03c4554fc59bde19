"""Angles that a drawing gives."""

from __future__ import annotations

import math

import pytest
from tests import store

import linkwright as lw
from linkwright.mechanism.drawing import Drawing

TRAIN = """format: 1
frame: {points: {O: [0 m, 0 m], Q: [0.3 m, 0 m], S: [0.6 m, 0 m]}}
links:
  crank: {points: {O: [0 m, 0 m], A: [0.1 m, 0 m]}}
  middle: {points: {Q: [0 m, 0 m], M: [0.1 m, 0 m]}}
  wheel: {points: {S: [0 m, 0 m], V: [0.1 m, 0 m]}}
joints:
  one: {kind: gear, links: [crank, middle], ratio: -1.5PHASE}
  two: {kind: gear, links: [middle, wheel], ratio: -0.4}
drawing: {DRAWN}
driver: {turn: crank, about: O, speed: 10 rpm, start: START}
"""


def test_what_neither_is_drawn_nor_follows_has_no_angle() -> None:
    """A four-bar with its crank at 200 deg and nothing else drawn; a wheel that is not drawn has no phase."""
    text = TRAIN.replace("PHASE", "").replace("START", "200 deg").replace("DRAWN", "M: [0.3 m, 0.1 m]")
    mechanism = lw.loads(text)
    drawing = Drawing(mechanism)
    assert drawing.angle("crank") == pytest.approx(math.radians(200))
    assert mechanism.joints["two"].phase == 0.0  # type: ignore[attr-defined]
    bars = Drawing(store.machine("crank_rocker"))
    assert [bars.angle(link) is None for link in bars.mechanism.links] == [False, True, True]
