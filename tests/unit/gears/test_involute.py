"""The involute function and its inverse."""

import math

import pytest

from linkwright.gears.gear import angle_of_involute, involute


@pytest.mark.parametrize("degrees", [14.5, 20.0, 25.0, 26.0886])
def test_involute_function_and_its_inverse(degrees: float) -> None:
    assert angle_of_involute(involute(math.radians(degrees))) == pytest.approx(math.radians(degrees), rel=1e-13)


def test_inverse_of_small_and_large_involutes() -> None:
    for angle in (1e-9, 1e-5, 0.019, 0.021, 0.3, 1.0, 1.5, 1.57):
        assert angle_of_involute(involute(angle)) == pytest.approx(angle, rel=1e-11)
