"""Layers and the smallest gap as numbers of a machine, in expectations and sweeps, against lengths by hand."""

import numpy as np
import pytest

import linkwright as lw

#: The rocker's eye comes nearest to the crank's pin where crank and coupler are folded: 80 - 25 mm from it, less half
#: the width and the radius of the pin.
FOURBAR = """format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [80 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 25 mm}
  coupler: {points: [A, B], length: 80 mm}
  rocker: {points: [O2, B], length: 50 mm}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 60 rpm}
construction: {material: steel, thickness: 5 mm, width: 16 mm, pin_radius: 4 mm}
expect: {layers: at most 4, min_gap: 43 mm ± 1e-6 mm}
"""
NEAREST = 0.080 - 0.025 - 0.008 - 0.004


def measured(text: str) -> list[lw.analysis.MetricValue]:
    return [*lw.metrics(lw.solve_motion(lw.loads(text)), names=["layers", "min_gap"])]


def test_the_smallest_gap_lies_where_crank_and_coupler_are_folded() -> None:
    count, gap = measured(FOURBAR)
    assert count.value == 4
    assert gap.value == pytest.approx(NEAREST, abs=1e-12)
    # the triangle O1, O2, B with B folded back, its angle at O1 by the law of cosines
    folded = np.pi + np.arccos((0.055**2 + 0.08**2 - 0.05**2) / (2 * 0.055 * 0.08))
    assert gap.at is not None and gap.at % (2 * np.pi) == pytest.approx(folded, abs=1e-5)


def test_expectations_take_both() -> None:
    found = lw.expectations(lw.loads(FOURBAR))
    assert [each.holds for each in found] == [True, True]


def test_sweeps_take_both() -> None:
    swept = lw.sweep(lw.loads(FOURBAR), {"coupler.length": [0.078, 0.082]}, outputs=["min_gap", "layers"])
    assert swept["min_gap"].tolist() == pytest.approx([NEAREST - 0.002, NEAREST + 0.002], abs=1e-12)
    assert swept["layers"].tolist() == [4.0, 4.0]


def test_without_layers_the_overlap_counts() -> None:
    """Crank and coupler share a pin, and are both asked into the first layer."""
    text = FOURBAR.replace("pin_radius: 4 mm}", "pin_radius: 4 mm, layers: {crank: 1, coupler: 1}}")
    count, gap = measured(text)
    assert count.value == np.inf and gap.value <= 0.0
    assert count.warnings
