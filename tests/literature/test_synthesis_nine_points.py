"""Nine-point synthesis: a linkage that is hidden in nine points of its curve, and the cognates of one that is found.

The points of Problem 3 of Wampler, Morgan and Sommese 1992 (J. Mech. Des. 114); its 64 real classes are counted where
they are found.
"""

import numpy as np
import pytest

import linkwright as lw

PROBLEM_3 = [(0.25, 0), (0.52, 0.1), (0.8, 0.7), (1.2, 1), (1.4, 1.3), (1.1, 1.48), (0.7, 1.4), (0.2, 1), (0.02, 0.4)]


def test_a_hidden_crank_rocker_is_among_the_solutions() -> None:
    theta = 2 * np.pi * (np.arange(9) + 0.3) / 9
    a, b, c, arm = 1.0, 2.6, 2.2, 1.3 + 1.1j
    pin = a * np.exp(1j * theta)
    reach = np.abs(2.9 - pin)
    turn = (2.9 - pin) / reach * np.exp(1j * np.arccos((reach**2 + b * b - c * c) / (2 * reach * b)))
    path = pin + arm * turn
    found = lw.exact_path_generation(path, count=20)
    lengths = [sorted(each.linkage.lengths().values()) for each in found]
    assert min(np.abs(np.array(each) - [1.0, 2.2, 2.6, 2.9]).max() for each in lengths) < 1e-6
    best = found.best
    assert not best.defects
    moved = lw.solve_motion(best.mechanism(), steps=3600).point("P").position
    assert max(np.hypot(moved[:, 0] - p.real, moved[:, 1] - p.imag).min() for p in path) < 0.02


def test_three_cognates_draw_one_curve() -> None:
    found = lw.path_generation(PROBLEM_3)
    three = lw.cognates(found.best.linkage)
    p = complex(*PROBLEM_3[0])
    for each in three:
        points = each.linkage.points
        assert points["P"] == pytest.approx(found.best.linkage.points["P"])
        o1, a, b, o2 = (points[name] for name in ("O1", "A", "B", "O2"))
        lengths = abs(a - o1), abs(b - a), abs(o2 - b)
        pose = found.best.mechanism()
        path = lw.solve_motion(pose, steps=24).point("P").position
        for x, y in path:
            assert _reaches(complex(x, y), o1, o2, lengths, points["P"] - a, b - a)
    assert abs(p - found.best.linkage.points["P"]) < 1e-6


def _reaches(
    p: complex, o1: complex, o2: complex, lengths: tuple[float, float, float], arm: complex, coupler: complex
) -> bool:
    """Whether a cognate can put its coupler point on p: A on both circles, then B on its own."""
    crank, _, output = lengths
    d = p - o1
    t = (abs(d) ** 2 + crank**2 - abs(arm) ** 2) / 2
    root = np.sqrt(max(abs(d) ** 2 * crank**2 - t * t, 0.0))
    off = []
    for sign in (1, -1):
        a = o1 + d * (t + sign * 1j * root) / abs(d) ** 2
        b = a + (p - a) / arm * coupler
        off.append(abs(abs(b - o2) - output))
    return min(off) < 1e-6
