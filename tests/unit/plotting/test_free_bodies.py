"""All that acts on a link adds up to nothing: forces, and moments about any point; scales are round."""

import math

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.pictures.picture import GRAPHICAL, round_up
from linkwright.pictures.svg import fold, width
from linkwright.plotting.free_bodies import free_bodies, idle_loads

LOADED = [name for name in store.names() if store.machine(name).has_loads]


@pytest.mark.rotating
@pytest.mark.parametrize("name", LOADED)
@pytest.mark.parametrize("static", [False, True])
def test_actions_are_in_balance(name: str, static: bool) -> None:
    motion = lw.solve_motion(store.machine(name), steps=24, failures="mark")
    forces = lw.solve_forces(motion, static=static)
    reach = max(link.reach for link in motion.mechanism.links.values())
    acting = 0
    for index in np.flatnonzero(motion.ok)[::5]:
        for body in free_bodies(forces, int(index)):
            acting += 1
            largest = max((each.size for each in body.forces), default=0.0)
            turning = max((abs(each.torque) for each in body.couples), default=0.0)
            assert np.hypot(*np.sum([each.force for each in body.actions], axis=0)) <= 1e-8 * largest + 1e-9
            scale = max(largest * (reach + float(np.hypot(*body.centre))), turning)
            for about in (body.centre, np.zeros(2), np.array([0.3, -0.7])):
                assert abs(sum(each.moment(about) for each in body.actions)) <= 1e-7 * scale + 1e-9
    assert acting or static


def test_loads_outside_their_phase_are_named() -> None:
    forces = store.forces("jaw_crusher_sixbar", 24)
    states = {tuple(idle_loads(forces, index)) for index in range(24)}
    assert states == {(), ("crushing",)}


@pytest.mark.parametrize("largest", [1e-6, 0.9, 1.0, 1.01, 2.1, 2.6, 4.2, 5.3, 99.0, 3.3e7])
def test_scales_are_the_smallest_round_ones(largest: float) -> None:
    scale = round_up(largest / 30.0, GRAPHICAL)
    assert largest / scale <= 30.0 * (1 + 1e-9)
    smaller = [k * 10.0**e for e in range(-10, 9) for k in (1.0, 2.0, 2.5, 4.0, 5.0) if k * 10.0**e < 0.999 * scale]
    assert all(largest / each > 30.0 for each in every(smaller))
    assert any(math.isclose(scale, k * 10.0**e) for e in range(-10, 9) for k in (1.0, 2.0, 2.5, 4.0, 5.0))


@pytest.mark.parametrize(
    "text",
    [
        "links 2 coupler, 3 rocker of a long chain",
        "由构件转角和基点求其余各点：各质心？",
        "averyveryverylongnamewithoutanyblank",
    ],
)
def test_folded_lines_fit_and_lose_nothing(text: str) -> None:
    lines = fold(text, 90.0, 13.0)
    assert all(width(line, 13.0) <= 90.0 + 13.0 for line in lines)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
