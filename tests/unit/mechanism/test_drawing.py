"""Angles that a drawing gives."""

from __future__ import annotations

import math

import pytest
from tests import store
from tests.geared_train import TRAIN

import linkwright as lw
from linkwright.mechanism.drawing import Drawing


def test_what_neither_is_drawn_nor_follows_has_no_angle() -> None:
    """A four-bar with its crank at 200 deg and nothing else drawn; a wheel that is not drawn has no phase."""
    text = TRAIN.replace("PHASE", "").replace("START", "200 deg").replace("DRAWN", "M: [0.3 m, 0.1 m]")
    mechanism = lw.loads(text)
    drawing = Drawing(mechanism)
    assert drawing.angle("crank") == pytest.approx(math.radians(200))
    assert mechanism.joints["two"].phase == 0.0  # type: ignore[attr-defined]
    bars = Drawing(store.machine("crank_rocker"))
    assert [bars.angle(link) is None for link in bars.mechanism.links] == [False, True, True]
