"""Some of the random machines that ``python -m tests.unit.collisions.against_shapely`` judges, in fewer positions."""

import pytest
from tests.unit.collisions.against_shapely import judged


@pytest.mark.rotating
@pytest.mark.parametrize("seed", [1, 2, 4, 5, 8, 10, 14, 16, 19, 20, 25, 466])
def test_a_random_machine_with_random_outlines(seed: int) -> None:
    result = judged(seed, positions=720)
    assert result.pairs == 21
    assert result.wrong == []
