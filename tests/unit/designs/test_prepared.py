"""Which designs a prepared mechanism solves anew: by the distance from its limits."""

import numpy as np
import pytest

from linkwright.designs.prepared import is_near


@pytest.mark.parametrize("swing", [0.0, 0.01, 0.05, 0.3])
def test_positions_are_near_by_the_largest_step_and_the_least_distance(swing: float) -> None:
    """Whether a step is found to be short by one sum or looked for makes no difference."""
    turn, found = np.linspace(0.0, 2.0 * np.pi, 60), []
    for least in (0.0, 0.019, 0.021, 0.05, 0.0501, 0.2, 0.9):
        row = least + swing * (1.0 + np.cos(turn)) / 2.0
        found.append(is_near(row))
        assert found[-1] == (row.min() < 0.02 + np.abs(np.diff(row)).max())
    assert found[0] and not found[-1]
