"""Sizes of machines that give none: round shares of their size."""

import pytest

import linkwright as lw
from linkwright.sizing.preferred import PINS, PLATES, WIDTHS, at_least, decade
from linkwright.sizing.sizes import sizes_of

FOURBAR = """
format: 1
name: four-bar
frame: {points: {O: [0 mm, 0 mm], C: [400 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  coupler: {points: [A, B], length: 300 mm}
  rocker: {points: [B, C], length: 250 mm}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""


def test_widths_are_a_twelfth_of_the_usual_length() -> None:
    """Lengths 100, 300, 250: their median 250 mm, a twelfth 20.8 mm."""
    sizes = sizes_of(lw.loads(FOURBAR))
    assert set(sizes.width) == {"frame", "crank", "coupler", "rocker"} == set(sizes.thickness)
    assert list(sizes.width.values()) == pytest.approx([0.020] * 4)
    assert list(sizes.thickness.values()) == pytest.approx([0.005] * 4)
    assert dict(sizes.pin_radius) == {name: pytest.approx(0.005) for name in "OABC"}
    assert "20 mm" in str(sizes.notes[0])


def test_a_given_pin_needs_its_eye() -> None:
    sizes = sizes_of(lw.loads(FOURBAR + "joints: {A: {kind: revolute, pin_radius: 12 mm}}\n"))
    assert sizes.pin_radius["A"] == 0.012
    assert sizes.width["crank"] == sizes.width["coupler"] == pytest.approx(0.050)
    assert sizes.width["rocker"] == pytest.approx(0.020)


def test_preferred_sizes_round_up() -> None:
    assert at_least(0.0101, PINS) == pytest.approx(0.012)
    assert at_least(0.012, PINS) == pytest.approx(0.012)
    assert at_least(0.9, WIDTHS) == pytest.approx(1.0)
    assert at_least(0.0, PLATES) == pytest.approx(0.0005)
    assert decade(0.034, up=False) == pytest.approx(0.030)
    assert decade(0.009, up=True) == pytest.approx(0.010)
