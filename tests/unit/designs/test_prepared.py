"""Which designs a prepared mechanism solves anew: by the distance from its limits."""

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright.designs.prepared import NEAREST, is_near
from linkwright.formula.numpy_backend import NumpyProgram


@pytest.mark.parametrize("swing", [0.0, 0.01, 0.05, 0.3])
def test_positions_are_near_by_the_largest_step_and_the_least_distance(swing: float) -> None:
    """Whether a step is found to be short by one sum or looked for makes no difference."""
    turn, found = np.linspace(0.0, 2.0 * np.pi, 60), []
    for least in (0.0, 0.019, 0.021, 0.05, 0.0501, 0.2, 0.9):
        row = least + swing * (1.0 + np.cos(turn)) / 2.0
        found.append(is_near(row))
        assert found[-1] == (row.min() < 0.02 + np.abs(np.diff(row)).max())
    assert found[0] and not found[-1]


@pytest.mark.parametrize("forwards", [True, False])
@pytest.mark.parametrize(
    ("highest", "lowest", "agree"),
    [(0.0, 0.0, True), (1.5, 0.0, False), (0.0, -1.5, False), (360.0, -720.0, True), (np.inf, 0.0, False)],
)
def test_limits_are_taken_only_where_the_rates_change_their_signs(highest, lowest, agree, forwards) -> None:
    """Limits moved by some steps, or (inf) both at the place of one, are seen by the positions beside them."""
    crusher = store.machine("jaw_crusher_sixbar")
    speed = abs(crusher.dimension("driver.speed")) * (1.0 if forwards else -1.0)
    prepared = lw.prepare(crusher.with_dimensions({"driver.speed": speed}), vary=["pitman.length"])
    limits = {each.kind: each.input for each in lw.limit_positions(prepared.solve({}).motion, "jaw")}
    step = np.radians(1.0)
    limits["max"] = limits["min"] if np.isinf(highest) else limits["max"] + highest * step
    limits["min"] += lowest * step
    numbers = prepared._base.copy()
    for kind, value in limits.items():
        numbers[prepared._places[f"limit:jaw:{kind}"]] = value
    row = NumpyProgram(prepared.program).run(numbers, prepared.positions.arrays)[prepared._index[NEAREST]]
    assert is_near(row) != agree
