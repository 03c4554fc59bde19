"""Single inputs beyond a change point are reached as in the cycle: a parallelogram stays one."""

import numpy as np
import pytest

import linkwright as lw

PARALLELOGRAM = """
format: 1
name: parallelogram
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 4 m}
  rocker: {points: [O2, B], length: 1 m}
driver: {turn: crank, about: O1, speed: 10 rad/s}
"""


@pytest.mark.parametrize("inputs", [[270.0], [90.0, 270.0], [10.0, 350.0, 400.0], [-90.0]])
def test_parallelogram(inputs: list[float]) -> None:
    motion = lw.solve_motion(lw.loads(PARALLELOGRAM), at=np.radians(inputs))
    assert motion.link("coupler").angle == pytest.approx(np.zeros(len(inputs)), abs=1e-9)


def test_grashof_equality_has_the_other_sign_in_the_second_turn() -> None:
    text = PARALLELOGRAM.replace("length: 4 m", "length: 3 m").replace("[O2, B], length: 1 m", "[O2, B], length: 2 m")
    motion = lw.solve_motion(lw.loads(text), at=np.radians([90.0, 270.0, 450.0, 630.0]))
    across = motion.point("A").position - motion.point("B").position
    diagonal = np.array([4.0, 0.0]) - motion.point("A").position
    side = np.sign(diagonal[:, 0] * -across[:, 1] - diagonal[:, 1] * -across[:, 0])
    assert list(side) == [1.0, -1.0, -1.0, 1.0]
