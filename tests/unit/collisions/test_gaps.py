"""Smallest gaps over a cycle where they are known in closed form."""

from cmath import exp
from math import cos, pi

import numpy as np
import pytest

import linkwright as lw
from linkwright.collisions.gaps import Gap, Moving, smallest_gaps
from linkwright.shapes.shape import bar, disc, polygon, rectangle

FOUR_BAR = """
format: 1
name: four-bar
frame: {points: {O: [0 m, 0 m], Q: [4 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  coupler: {points: [A, B], length: 4 m}
  rocker: {points: [Q, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""


def gap(one: Moving, other: Moving, text: str = FOUR_BAR, steps: int = 360) -> Gap:
    (found,) = smallest_gaps(lw.solve_motion(lw.loads(text), steps=steps), [(one, other)])
    return found


def test_a_pin_passes_a_post() -> None:
    """The crank's pin runs on a circle of 1 m about O; a post at 2·exp(0.7i) is met at 0.7 rad."""
    found = gap(Moving("crank", disc(1.0, 0.1)), Moving("frame", disc(2.0 * exp(0.7j), 0.2)))
    assert found.size == pytest.approx(0.7, abs=1e-9)
    assert found.input % (2.0 * pi) == pytest.approx(0.7, abs=1e-6)
    assert found.place == pytest.approx(1.45 * exp(0.7j), abs=1e-6)
    assert found.exact


def test_a_pin_passes_a_wall_between_two_positions() -> None:
    """The wall x = 0.95 to 1: the pin's centre gets to x = 1, so that the smallest gap is none; a wall from 1.25 on
    is 0.25 - 0.1 away. Two positions alone, at 90° and 270°, would show neither."""
    pin = Moving("crank", disc(1.0, 0.1))
    wall = Moving("frame", polygon([0.95 - 2j, 1.0 - 2j, 1.0 + 2j, 0.95 + 2j]))
    assert gap(pin, wall).size == 0.0
    far = Moving("frame", polygon([1.25 - 2j, 1.5 - 2j, 1.5 + 2j, 1.25 + 2j]))
    for steps in (2, 7, 360):
        assert gap(pin, far, steps=steps).size == pytest.approx(0.15, abs=1e-9)


def test_what_keeps_its_distance() -> None:
    """A disc on the crank about O keeps its distance from a post; the ends of crank and rocker at O and Q keep
    theirs, and so does the crank's pin from a ring of a plate about O."""
    assert gap(Moving("crank", disc(0.0, 0.5)), Moving("frame", disc(3j, 0.5))).size == pytest.approx(2.0, abs=1e-9)
    assert gap(Moving("crank", bar([0.0, -0.2], 0.1)), Moving("rocker", disc(0.0, 0.2))).size == pytest.approx(
        3.8 - 0.25, abs=1e-9
    )
    corners = 2.0 * np.exp(2j * pi * np.arange(12) / 12)
    ring = polygon([3.0 + 3.0j, -3.0 + 3.0j, -3.0 - 3.0j, 3.0 - 3.0j], [corners])
    apothem = 2.0 * cos(pi / 12)
    assert gap(Moving("crank", disc(1.0, 0.1)), Moving("frame", ring)).size == pytest.approx(apothem - 1.1, abs=1e-9)


def test_within_another_without_touching_it_is_an_overlap() -> None:
    """A small plate on the crank's pin stays within a large one, and one about O within the hole of a ring does not
    overlap it."""
    large = polygon([3.0 + 3.0j, -3.0 + 3.0j, -3.0 - 3.0j, 3.0 - 3.0j])
    small = Moving("crank", rectangle(1.0, 0.3, 0.2, 0.1))
    assert gap(small, Moving("frame", large)).size == 0.0
    assert gap(Moving("frame", large), small).size == 0.0
    ring = polygon(large.pieces[0].rings[0], [0.5 * large.pieces[0].rings[0]])
    assert gap(small, Moving("frame", ring)).size > 0.0


def test_bars_that_cross_all_the_time() -> None:
    """No corner comes near a side: a long bar on the crank through O crosses a long one of the frame through O."""
    cross = Moving("crank", bar([-5.0, 5.0], 0.01)), Moving("frame", bar([-5.0 - 0.1j, 5.0 - 0.1j], 0.01))
    assert gap(*cross).size == 0.0


def test_two_on_one_link() -> None:
    """A link's own shapes keep their gap."""
    pair = Moving("coupler", disc(0.0, 0.1)), Moving("coupler", bar([3.0 + 4.0j, 3.0 + 9.0j], 0.2))
    assert gap(*pair).size == pytest.approx(5.0 - 0.2, abs=1e-12)


def test_the_coupler_and_a_post() -> None:
    """Where the crank points away from the rocker's pin, at 180°, the coupler's line is nearest to a post far behind
    it: the least over the angles of the distance of a point from a line through A and B, in closed form."""
    angle = np.linspace(0.0, 2.0 * pi, 200_001)
    a = np.exp(1j * angle)
    base = 4.0 - a
    reach = np.abs(base)
    along = (16.0 - 2.5**2 + reach**2) / (2.0 * reach)
    way = base / reach * (along + 1j * np.sqrt(16.0 - along**2)) / 4.0
    post = -0.5 + 2.0j
    share = np.clip(((post - a) * way.conj()).real, 0.0, 4.0)
    least = np.abs(post - a - share * way).min()
    found = gap(Moving("coupler", bar([0.0, 4.0], 0.2)), Moving("frame", disc(post, 0.1)))
    assert found.size == pytest.approx(least - 0.2, abs=1e-9)


def test_a_polygon_of_many_corners() -> None:
    """A wheel of 400 corners about the crank's pin, 1 m from O, and one of 300 about a place 3 m from O: the gap is
    that of their circles, and at most their heights of arc more."""
    moving = polygon(1.0 + 0.5 * np.exp(2j * pi * np.arange(400) / 400))
    still = polygon(3.0 + 0.8 * np.exp(2j * pi * (0.5 + np.arange(300)) / 300))
    more = gap(Moving("crank", moving), Moving("frame", still)).size - (2.0 - 0.5 - 0.8)
    assert 0.0 <= more <= 0.5 * (1.0 - cos(pi / 400)) + 0.8 * (1.0 - cos(pi / 300))


def test_a_slider_along_a_wall() -> None:
    """The slider's corner keeps its distance from a wall along its guide: 0.3 - 0.1."""
    text = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  slider: {points: [B]}
joints: {slide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""
    wall = Moving("frame", polygon([0.3j, 9.0 + 0.3j, 9.0 + 1j, 1j]))
    found = gap(Moving("slider", rectangle(0.0, 0.0, 0.4, 0.2)), wall, text)
    assert found.size == pytest.approx(0.2, abs=1e-9)
