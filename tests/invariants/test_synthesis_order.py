"""Of linkages that meet a demand equally well, the order is that of transmission, size and ratio of the links."""

from collections.abc import Callable

import numpy as np
import pytest

import linkwright as lw

ARCH = np.array([[0.0, 0.0], [5.0, 4.0], [10.0, 6.0], [15.0, 5.0], [20.0, 0.0]])
NINE = np.array(
    [8.2 + 5.4j, 7.6 + 6.4j, 6 + 7.1j, 4.1 + 7.2j, 2.3 + 6.6j, 1.2 + 5.6j, 1.4 + 4.6j, 3.3 + 4j, 6.4 + 4.3j]
)
POSES = [(0.0, 0.0, 0.0), (1.0, 0.4, 0.3), (1.6, 1.2, 0.9), (1.7, 2.1, 1.5)]
ANGLES = [0.0, 0.35, 0.70, 1.05]


def largest(points: list[complex]) -> float:
    return max(abs(p - q) for p in points for q in points)


def worth(each: lw.Candidate, demand: float) -> float:
    """The order's number from the points of the model file's mechanism, not from those of the synthesis."""
    machine = each.mechanism()
    bodies = [[complex(*place) for place in link.points.values()] for link in machine.links.values()]
    longest = max(largest(points) for points in bodies)
    size = longest / demand if demand else 1.0
    lengths = each.linkage.lengths().values()
    unequal = max(lengths) / min(lengths)
    return float(np.sin(each.transmission_angle) * min(1.0, 3.0 / size) * min(1.0, 10.0 / unequal))


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("found", "demand"),
    [
        (lambda: lw.exact_path_generation(ARCH), 20.0),
        (lambda: lw.exact_path_generation(NINE), np.abs(NINE[:, None] - NINE).max()),
        (lambda: lw.path_generation(ARCH[:3]), np.hypot(10, 6)),
        (lambda: lw.path_generation(ARCH[:3], angles=[0.0, 0.5, 1.0]), np.hypot(10, 6)),
        (lambda: lw.motion_generation(POSES), np.hypot(1.7, 2.1)),
        (lambda: lw.function_generation(ANGLES, [0.0, 0.61, 1.11, 1.57]), 0.0),
    ],
    ids=["exact path", "nine points", "path", "timed path", "motion", "function"],
)
def test_the_order_of_equals_is_that_of_the_documentation(found: Callable[[], lw.Synthesis], demand: float) -> None:
    candidates = [each for each in found() if not each.defects]
    assert len(candidates) > 1
    order = [worth(each, demand) for each in candidates]
    assert order == sorted(order, reverse=True)


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(3))
def test_a_compact_linkage_comes_before_one_of_a_better_angle(seed: int) -> None:
    """A path of 20 m had first a four-bar of 139 m with an angle of 62 degrees, before one of 34 m with 44."""
    found = lw.exact_path_generation([[0, 0], [10, 4], [20, 3]], seed=seed)
    first = found.best
    assert first.linkage.longest() < 4 * found.extent and np.degrees(first.transmission_angle) > 40


def test_the_longest_link_is_shown_beside_the_demand() -> None:
    found = lw.exact_path_generation(ARCH)
    longest = found.best.linkage.longest()
    assert found.data()["extent [m]"] == pytest.approx(20.0)
    for language in ("en", "zh"):
        assert f"{longest:.4g} m ({longest / 20:.3g}×)" in found.text(language)
