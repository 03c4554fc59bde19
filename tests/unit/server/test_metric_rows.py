"""Metrics of the studio: names in words, limits, values known in closed form."""

from __future__ import annotations

import math

import pytest

import linkwright as lw
from linkwright.server.metrics import metric_rows


def test_metrics_of_a_press_are_those_of_its_task() -> None:
    """The gallery's task gives stroke, swing and time ratio; the limit of the transmission angle is 40 deg."""
    text = lw.read_document("gallery:press_course").text
    found = {(row["metric"], row["subject"]): row for row in metric_rows(text, "en")}
    assert found["stroke", "guide"]["value"] == pytest.approx(0.150, rel=1e-9)
    assert found["swing_angle", "rocker"]["value"] == pytest.approx(math.pi / 3, rel=1e-9)
    assert found["quick_return_ratio", "guide"]["value"] == pytest.approx(1.0504708, rel=1e-6)
    angle = found["transmission_angle", "coupler+rocker"]
    assert angle["limit"] == pytest.approx(math.radians(40))
    assert (angle["better"], angle["unit"]) == ("higher", "°")
    assert angle["value"] * angle["factor"] == pytest.approx(math.degrees(angle["value"]))
    labels = {row["label"] for row in metric_rows(text, "zh")}
    assert not any(label.isascii() for label in labels)
