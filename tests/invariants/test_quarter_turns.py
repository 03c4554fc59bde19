"""Angles of whole quarter turns, which programs know, place links where any other angle would."""

from __future__ import annotations

import numpy as np
import pytest
from tests.invariants.welded_slider import MODEL

import linkwright as lw


@pytest.mark.parametrize("bed", [-360, -270, -180, -90, 0, 90, 180, 270, 360, 450, 30])
@pytest.mark.parametrize(("own", "weld"), [(0, 0), (90, -90), (360, 180), (-90, 360), (180, 270), (270, 17)])
def test_a_slider_crank_in_all_quarters(bed: float, own: float, weld: float) -> None:
    """s = r cos(θ - δ) + √(l² - r² sin²(θ - δ)) along the bed's direction δ."""
    text = MODEL.replace("BED", f"{bed}").replace("OWN", f"{own}").replace("WELD", f"{weld}")
    motion = lw.solve_motion(lw.loads(text), steps=5)
    way, turned = np.radians(bed), motion.input - np.radians(bed)
    s = 0.1 * np.cos(turned) + np.sqrt(0.35**2 - (0.1 * np.sin(turned)) ** 2)
    block = 0.1 - 0.2j + s * np.exp(1j * way)
    slide = np.exp(1j * (way - np.radians(own)))
    plate = slide * np.exp(1j * np.radians(weld))
    for name, expected in (("B", block), ("T", block + (0.03 + 0.01j) * plate)):
        place = motion.point(name).position
        assert place[:, 0] + 1j * place[:, 1] == pytest.approx(expected, abs=1e-14)
    for name, direction in (("slide", slide), ("plate", plate)):
        found = motion.link(name).direction
        assert found[:, 0] + 1j * found[:, 1] == pytest.approx(np.full(5, direction), abs=1e-14)
    assert motion.joint("bed").displacement == pytest.approx(s, abs=1e-14)
