"""Nine-point synthesis: Wampler, Morgan and Sommese 1992 (J. Mech. Des. 114), Problem 3, with 64 real classes."""

import numpy as np
import pytest
from tests.trace_starts import curve

import linkwright as lw
from linkwright.synthesis.nine_points import tracker
from linkwright.synthesis.nine_points.classes import CLASSES, class_keys, is_real, new_classes, relatives
from linkwright.synthesis.nine_points.query import NinePoints, nine_points
from linkwright.synthesis.nine_points.start import around, random_points, start_set
from linkwright.synthesis.nine_points.tracker import residual

PROBLEM_3 = [
    (0.25, 0), (0.52, 0.1), (0.8, 0.7), (1.2, 1), (1.4, 1.3), (1.1, 1.48), (0.7, 1.4), (0.2, 1), (0.02, 0.4),
]  # fmt: skip


@pytest.fixture(scope="module")
def solved() -> NinePoints:
    return nine_points(np.array([complex(*point) for point in PROBLEM_3]))


def test_all_classes_and_the_published_number_of_real_ones(solved: NinePoints) -> None:
    assert solved.complete
    assert int(is_real(solved.solutions).sum()) == 64


def test_every_solution_and_its_cognates_satisfy_the_equations(solved: NinePoints) -> None:
    for each in relatives(solved.solutions, solved.q):
        assert residual(each, solved.q).max() < 1e-5
    assert np.median(residual(solved.solutions, solved.q)) < 1e-13


def test_the_coupler_curves_of_all_solutions_pass_all_points(solved: NinePoints) -> None:
    """Roberts' sextic, formed without any rotation of the coupler, at the points and at one beside them."""
    beside = np.array([[0.31 + 0.2j], [0.31 - 0.2j]])
    values, slopes = curve(solved.solutions[:, :8], np.concatenate([solved.q, beside], 1))
    size = (np.abs(slopes) * np.abs(solved.solutions[:, None, :8])).sum(2)
    relative = np.abs(values) / size
    assert np.median(relative[:, :8].max(1)) < 1e-12
    assert np.quantile(relative[:, :8].max(1), 0.99) < 1e-7
    assert np.median(relative[:, 8]) > 1e-4


def test_cognates_are_of_one_class(solved: NinePoints) -> None:
    keys = class_keys(solved.solutions[:50])
    for each in relatives(solved.solutions[:50], solved.q):
        assert np.abs(class_keys(each) - keys).max() < 1e-5 * np.abs(keys).max()


def test_the_start_set_is_closed_under_monodromy() -> None:
    """Carried around a random triangle, the start set comes back to itself: nothing new, nothing twice."""
    q, u = start_set()
    assert len(u) == CLASSES
    ends, lost = around(q, u, np.random.default_rng(99))
    assert lost <= 3
    assert len(new_classes(ends, class_keys(u))) == 0
    assert len(new_classes(ends, np.empty(0, complex))) == len(ends)


def test_without_a_compiler_paths_end_at_the_same_solutions(monkeypatch: pytest.MonkeyPatch) -> None:
    q, u = start_set()
    goal = random_points(np.random.default_rng(5))
    compiled = tracker.track(u[:24], q, goal)
    monkeypatch.setattr(tracker, "available", lambda: False)
    plain = tracker.track(u[:24], q, goal)
    assert plain.arrived.all() and compiled.arrived.all()
    assert np.abs(class_keys(plain.solutions) - class_keys(compiled.solutions)).max() < 1e-9


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
