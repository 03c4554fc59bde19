"""All zeros over a range: crossings, pairs that hide between two places, touchings, jumps, flat parts."""

import numpy as np
import pytest

from linkwright.core.arrays import Floats
from linkwright.dynamics.zeros import Sampled

PLACES = np.linspace(0.0, 2.0 * np.pi, 361)


def test_crossings_by_their_sense() -> None:
    zeros = Sampled(lambda q: np.array([np.cos(q), -np.sin(q)]), PLACES, 1.0).zeros
    assert [(each.place, each.kind) for each in zeros] == [
        (pytest.approx(np.pi / 2, rel=1e-14), "falling"),
        (pytest.approx(1.5 * np.pi, rel=1e-14), "rising"),
    ]


def test_two_zeros_between_neighbouring_places() -> None:
    """cos q = 1 - 1e-9 has two roots 9e-5 rad apart, both between the first place but one and its neighbours."""
    shift = 1.0007
    zeros = Sampled(lambda q: np.array([1.0 - 1e-9 - np.cos(q - shift), np.sin(q - shift)]), PLACES, 1.0).zeros
    apart = np.arccos(1.0 - 1e-9)
    assert [each.place for each in zeros] == pytest.approx([shift - apart, shift + apart], abs=1e-11)
    assert [each.kind for each in zeros] == ["falling", "rising"]


def test_touching() -> None:
    (only,) = Sampled(lambda q: np.array([1.0 - np.cos(q - 2.0), np.sin(q - 2.0)]), PLACES, 1.0).zeros
    assert (only.place, only.kind) == (pytest.approx(2.0, abs=1e-9), "touching")


def test_jump_through_zero() -> None:
    def function(q: Floats) -> Floats:
        return np.array([np.where(q < 2.0, -1.0, 3.0), 0.0 * q])

    (only,) = Sampled(function, PLACES, 1.0).zeros
    assert (only.place, only.kind, only.jump) == (pytest.approx(2.0, abs=1e-12), "rising", True)


def test_flat_part() -> None:
    def function(q: Floats) -> Floats:
        return np.array([np.maximum(q - 3.0, 0.0), np.where(q > 3.0, 1.0, 0.0)])

    (only,) = Sampled(function, PLACES, 1.0).zeros
    assert only.kind == "flat"
    assert (only.low, only.high) == (0.0, pytest.approx(3.0, abs=0.01))


def test_integral_of_a_sampled_function() -> None:
    sampled = Sampled(lambda q: np.array([np.sin(q), np.cos(q)]), PLACES, 1.0)
    assert sampled.integral(0.3, 2.9) == pytest.approx(np.cos(0.3) - np.cos(2.9), rel=1e-14)
