"""Machines that fall, against MuJoCo with two step sizes; more, and Exudyn, by `python -m tests.dynamics.foreign`."""

from __future__ import annotations

import pytest
from tests.dynamics import foreign

pytest.importorskip("mujoco")


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("name", "steps", "within"),
    [("double pendulum", 10_000, 1e-11), ("crank-rocker", 10_000, 1e-8), ("five-bar", 2000, 1e-9)],
)
def test_points_end_where_mujoco_has_them(name: str, steps: int, within: float) -> None:
    text, end, _ = foreign.CASES[name]
    assert foreign.gaps(text, end, foreign.by_mujoco, end / steps)[1] < within
