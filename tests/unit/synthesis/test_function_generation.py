"""Function generators: exact pairs, what every position has, extremes that are proven."""

import numpy as np
import pytest

from linkwright.synthesis.function_generation.exact import chebyshev_spacing, five_pairs
from linkwright.synthesis.function_generation.generators import KINDS, GearedFiveBar, extremes

pytestmark = pytest.mark.rotating


def test_five_pairs_of_a_hidden_four_bar() -> None:
    rng = np.random.default_rng(4)
    for _ in range(50):
        a, b, c = rng.uniform(0.4, 1.8, 3)
        phi = np.sort(rng.uniform(0.3, 2.4, 5))
        reach = np.abs(a * np.exp(1j * phi) - 1)
        cosine = (reach**2 + c * c - b * b) / (2 * reach * c)
        if np.abs(cosine).max() > 0.97:
            continue
        psi = np.angle(a * np.exp(1j * phi) - 1) + np.arccos(cosine)
        zeros, lengths = five_pairs(phi - 0.7, psi + 0.4)
        off = np.abs(lengths - [a, b, c]).max(1) + np.abs(np.exp(1j * zeros) - np.exp([0.7j, -0.4j])).max(1)
        assert off.min() < 1e-6
        assert len(zeros) <= 3


@pytest.mark.parametrize("kind", ["four_bar", "slider_crank", "watt", "stephenson", "geared_five_bar"])
def test_what_is_shown_of_a_range_is_what_every_position_has(kind: str) -> None:
    """Least sine of the dyads' angles against 4001 positions: assembled everywhere just where it is not 0."""
    generator = GearedFiveBar(-0.5) if kind == "geared_five_bar" else KINDS[kind]()
    rng = np.random.default_rng(6)
    x, signs = generator.sample(rng, 60), rng.choice([-1.0, 1.0], (60, generator.modes))
    assembled = 0
    for row, sign in zip(x[:, None], signs[:, None], strict=True):
        low = rng.uniform(0, 6)
        high = low + rng.uniform(0.2, 2)
        shown = min(generator.sines(row, sign, low, high))
        run = generator.run(row, sign, np.linspace(low, high, 4001))
        assert (shown > 0) == (run.missing.max() == 0)
        if shown > 0:
            assembled += 1
            assert shown == pytest.approx(run.sine.min(), abs=1e-4) and shown <= run.sine.min() + 1e-9
    assert assembled > 2


def test_a_gap_between_positions_is_seen() -> None:
    """A peak far thinner than the first intervals, on a slope; the bound is that of its own slope."""
    width, rate = 1e-3, 4e3
    found = extremes(lambda t: t + 4 * np.exp(-(((t - 1.23456) / width) ** 2)), rate, 0.0, 3.0, 1e-4)
    assert found == pytest.approx((0.0, 5.23456), abs=1e-4)


def test_chebyshev_spacing_is_that_of_the_polynomial() -> None:
    x = chebyshev_spacing(-1, 1, 7)
    assert np.polynomial.chebyshev.chebval(x, [0] * 7 + [1]) == pytest.approx(np.zeros(7), abs=1e-12)
