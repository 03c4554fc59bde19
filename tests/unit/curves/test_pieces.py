"""Means, integrals and extremes of functions that are known, on pieces of many designs."""

import numpy as np
import pytest
from scipy.special import i0e

from linkwright.core.arrays import Floats, Indices
from linkwright.curves.pieces import HIGH, LOW, Columns, Layout, Pieces, Wanted
from linkwright.curves.polynomials import COMPILED, NODES, climbed, product

TURN = 2.0 * np.pi


def on_pieces(sharpness: list[float], wanted: Wanted) -> Pieces:
    """exp(k cos x) and its square over a turn, for every k, on four pieces each to begin with."""
    k, count = np.array(sharpness), len(sharpness)

    def columns(stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        return {LOW: TURN * first, HIGH: TURN * last, "k": k[stretch]}

    def signals(columns: Columns, nodes: Floats) -> Floats:
        x = columns[LOW] + (columns[HIGH] - columns[LOW]) * nodes[:, None]
        value = np.exp(columns["k"] * (np.cos(x - 0.3) - 1.0))
        return np.stack([value, value * value], axis=1)

    stretch, place = np.repeat(np.arange(count), 4), np.tile(np.arange(4) / 4.0, count)
    return Pieces(signals, Layout(np.arange(count), count, columns), stretch, place, place + 0.25, wanted)


def test_means_of_designs_of_any_sharpness_are_those_of_bessel_functions() -> None:
    sharpness = [0.1, 3.0, 40.0, 900.0]
    found = on_pieces(sharpness, Wanted(even=(0, 1)))
    k = np.array(sharpness)
    expected = [i0e(k), i0e(2.0 * k)]
    assert np.bincount(found.design)[-1] > np.bincount(found.design)[0] == 4
    for signal, mean in enumerate(expected):
        assert found.mean(signal) == pytest.approx(mean, rel=1e-12)
    assert found.mean_square(0) == pytest.approx(found.mean(1), rel=1e-12)
    assert not found.unmet.any()


def test_the_largest_value_is_met_where_it_is() -> None:
    found = on_pieces([3.0, 900.0], Wanted(sides=((0, 1.0), (0, -1.0))))
    rows, side, piece = found.contenders([(0, 1.0), (0, -1.0)], [None, None])
    place, value = climbed(rows)
    best = [
        int(
            np.flatnonzero((side == 0) & (found.design[piece] == k))[
                value[(side == 0) & (found.design[piece] == k)].argmax()
            ]
        )
        for k in (0, 1)
    ]
    time = found.columns[LOW][piece[best]] + 0.5 * (1.0 + place[best]) * found.width[piece[best]]
    assert time == pytest.approx([0.3, 0.3], abs=1e-7)
    assert value[best] == pytest.approx([1.0, 1.0], abs=1e-13)


def test_the_excess_of_a_wave_is_its_integral() -> None:
    """∫ (mean - cos) up to x is -sin x: from 1 to -1."""

    def columns(stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        return {LOW: TURN * first, HIGH: TURN * last}

    def signals(columns: Columns, nodes: Floats) -> Floats:
        return np.cos(columns[LOW] + (columns[HIGH] - columns[LOW]) * nodes[:, None])[:, None, :]

    place = np.arange(6) / 6.0
    layout = Layout(np.zeros(1, dtype=np.intp), 1, columns)
    found = Pieces(signals, layout, np.zeros(6, dtype=np.intp), place, place + 1 / 6, Wanted(even=(0,)))
    x = found.columns[LOW] + found.width * NODES[:, None]
    assert found.excess(0, found.mean(0)) == pytest.approx(-np.sin(x), abs=1e-14)


def test_polynomials_are_climbed_alike_by_arrays_and_by_machine_code() -> None:
    rng, count = np.random.default_rng(5), COMPILED + 7
    series = rng.standard_normal((16, count)) * 0.2 ** np.arange(16)[:, None]
    rows = np.polynomial.chebyshev.chebval(2.0 * NODES - 1.0, series).T
    compiled = climbed(rows)
    parts = [climbed(rows[:, k : k + 500]) for k in range(0, count, 500)]
    dense = np.polynomial.chebyshev.chebval(np.linspace(-1.0, 1.0, 4001), series).max(axis=1)
    assert compiled[1] == pytest.approx(np.concatenate([value for _, value in parts]), abs=1e-13)
    assert (compiled[1] >= dense - 1e-13).all() and (compiled[1] <= dense + 1e-6).all()


def test_products_in_parts_are_those_at_once() -> None:
    rng = np.random.default_rng(2)
    matrix, rows = rng.standard_normal((33, 16)), rng.standard_normal((16, 5000))
    assert product(matrix, rows) == pytest.approx(matrix @ rows, rel=1e-12, abs=1e-12)
