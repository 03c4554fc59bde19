"""Integrals and extremes of piecewise polynomials against closed forms."""

import math

import numpy as np
import pytest

from linkwright.curves.curve import Curve, nodes
from linkwright.curves.polynomials import POINTS

TURN = 2 * math.pi


def wave(x):
    return np.sin(3 * x) + 0.3 * np.cos(11 * x + 1)


def test_integral_of_a_smooth_function_at_any_place():
    work = Curve.of(wave, 0.0, TURN, pieces=24).integral()
    x = np.linspace(0.0, TURN, 777)
    exact = (1 - np.cos(3 * x)) / 3 + 0.3 / 11 * (np.sin(11 * x + 1) - math.sin(1))
    assert np.abs(work(x) - exact).max() < 5e-15
    assert work.total == pytest.approx(0.0, abs=1e-14)


@pytest.mark.parametrize("place", [1.2345, 0.3, 5.999, TURN / 24 * (1 + 1e-4), TURN / 24 * (3 - 1e-9)])
def test_a_jump_at_an_unknown_place_is_found(place):
    jump = Curve.of(lambda x: np.where(x < place, np.sin(x), 2 + np.cos(x)), 0.0, TURN, pieces=24)
    exact = (1 - math.cos(place)) + 2 * (TURN - place) - math.sin(place)
    assert jump.integral().total == pytest.approx(exact, abs=2e-12)


def test_a_kink_of_its_own():
    kink = Curve.of(lambda x: np.abs(np.sin(x - 0.3)), 0.0, TURN, pieces=24)
    assert kink.integral().total == pytest.approx(4.0, abs=1e-12)
    assert kink.extreme("min").value < 1e-9


def test_a_known_jump_costs_no_halving():
    calls = []

    def step(x):
        calls.append(len(x))
        return np.where(x < 1.0, x, x - 3.0)

    found = Curve.of(step, 0.0, 2.0, pieces=4, knots=np.array([1.0]))
    assert calls == [4 * POINTS]
    assert found.integral().total == pytest.approx(2.0 - 3.0, abs=1e-15)
    assert found.extreme("max").value == pytest.approx(1.0, abs=1e-13)
    assert found.extreme("min").value == pytest.approx(-2.0, abs=1e-13)


@pytest.mark.parametrize("frequency", [1, 2, 7, 19])
def test_extremes_of_a_cosine(frequency):
    found = Curve.of(lambda x: np.cos(frequency * (x - 0.4)), 0.0, TURN, pieces=24)
    top, low = found.extreme("max"), found.extreme("min")
    assert (top.value, low.value) == (pytest.approx(1.0, abs=1e-14), pytest.approx(-1.0, abs=1e-14))
    assert math.cos(frequency * (top.place - 0.4)) > 1 - 1e-14


def test_the_higher_of_two_nearly_equal_peaks():
    found = Curve.of(lambda x: np.sin(x) ** 2 + 1e-9 * np.sin(x), 0.0, TURN, pieces=24)
    assert found.extreme("max").place == pytest.approx(TURN / 4, abs=1e-7)
    assert found.extreme("max").value == pytest.approx(1 + 1e-9, abs=5e-14)


def spikes(x):
    return 1 / (1 + ((x - 2.0) / 0.02) ** 2) + 1.01 / (1 + ((x - 4.7) / 0.015) ** 2) + 0.2 * np.abs(np.sin(x))


@pytest.mark.parametrize("lobes", range(7, 12))
def test_the_highest_of_many_nearly_equal_peaks(lobes):
    dense = np.linspace(0.0, TURN, 50001)
    for start, other in np.random.default_rng(lobes).uniform(0.0, TURN, (60, 2)):

        def wave(x, start=start, other=other):
            return np.cos(lobes * x + start) * (1.0 + 0.001 * np.cos(x + other))

        found = Curve.of(wave, 0.0, TURN, pieces=26).extreme("max")
        assert found.smooth and found.value == pytest.approx(wave(dense).max(), abs=1e-6)
        assert wave(found.place) == pytest.approx(found.value, abs=1e-13)


def test_the_highest_of_peaks_that_polynomials_do_not_meet():
    least, most = Curve.of(spikes, 0.0, TURN, pieces=24).extremes()
    near = 4.7 + np.linspace(-1e-5, 1e-5, 20001)
    edges = np.linspace(0.0, TURN, 25)
    assert not Curve(edges, spikes(nodes(edges))).extreme("max").smooth
    assert most.smooth
    assert most.value == pytest.approx(spikes(near).max(), rel=1e-13)
    assert most.place == pytest.approx(near[spikes(near).argmax()], abs=1e-7)
    assert least.value == pytest.approx(spikes(math.pi * np.arange(3)).min(), rel=1e-10)
    assert least.place in (pytest.approx(0.0, abs=1e-11), pytest.approx(math.pi, abs=1e-11), pytest.approx(TURN))


def test_the_larger_side_of_a_jump_at_an_unknown_place():
    def step(x):
        return np.where(x < 1.2345, np.sin(x), -np.cos(x))

    most = Curve.of(step, 0.0, 2.0, pieces=5).extreme("max")
    assert most.value == pytest.approx(math.sin(1.2345), rel=1e-11)
    assert most.place == pytest.approx(1.2345, abs=1e-11)


def test_values_at_the_nodes_are_the_functions():
    edges = np.linspace(0.0, 1.0, 4)
    found = Curve(edges, np.exp(nodes(edges)))
    x = nodes(edges).ravel()
    assert np.abs(found(x) - np.exp(x)).max() < 1e-15 * math.e
    assert np.abs(found(np.array([0.0, 1.0])) - np.exp([0.0, 1.0])).max() < 1e-14
