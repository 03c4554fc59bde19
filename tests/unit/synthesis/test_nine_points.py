"""Nine-point synthesis: Wampler, Morgan and Sommese 1992 (J. Mech. Des. 114), Problem 3, with 64 real classes."""

import numpy as np
import pytest
from tests.unit.synthesis.trace_starts import curve

from linkwright.synthesis.path_generation import tracking as tracker
from linkwright.synthesis.path_generation.nine_points import (
    CLASSES,
    NinePoints,
    around,
    class_keys,
    is_real,
    new_classes,
    nine_points,
    random_points,
    relatives,
    start_set,
)
from linkwright.synthesis.path_generation.tracking import residual

PROBLEM_3 = [(0.25, 0), (0.52, 0.1), (0.8, 0.7), (1.2, 1), (1.4, 1.3), (1.1, 1.48), (0.7, 1.4), (0.2, 1), (0.02, 0.4)]


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


def test_compiled_paths_end_where_those_of_numpy_do() -> None:
    q, u = start_set()
    goal = random_points(np.random.default_rng(5))
    compiled = tracker.track(u[:24], q, goal)
    places = [tracker.Places(*points, np.empty(0, complex)) for points in (q, goal)]
    plain = tracker.carried(u[:24], *places)
    assert plain.arrived.all() and compiled.arrived.all()
    assert np.abs(class_keys(plain.solutions) - class_keys(compiled.solutions)).max() < 1e-9
