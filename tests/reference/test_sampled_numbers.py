"""Metrics of random loaded machines equal those of 20 000 positions (more: ``python -m tests.brute_force``)."""

import numpy as np
import pytest
from tests.brute_force import verdict_of
from tests.reference import sampled_cycle as cycle
from tests.reference.loaded_machines import loaded_machine

import linkwright as lw

TURN = np.linspace(0.0, 2.0 * np.pi, 2000, endpoint=False)


@pytest.mark.rotating
@pytest.mark.parametrize("number", [1000001, 1000004, 1000013, 1000039, 1000049, 1000107])
def test_metrics_are_those_of_many_positions(number: int) -> None:
    found = verdict_of(number)
    assert not found.refused and not found.crash
    assert [f"{each.metric} {each.subject}: {each.wrong}" for each in found.wrong] == []
    assert len(found.values) > 8


def test_bounds_hold_smooth_extremes() -> None:
    for phase in np.linspace(0.0, 0.003, 7):
        value, slack = cycle.maximum(np.cos(TURN - phase) + 0.2 * np.sin(5 * (TURN - phase)), True)
        exact = (np.cos(x := np.linspace(0.0, 0.5, 2_000_001)) + 0.2 * np.sin(5 * x)).max()
        assert abs(value - exact) <= slack + 1e-13
        assert slack < 1e-6


def test_bounds_hold_the_limit_at_a_jump() -> None:
    """A signal grows to 1 and falls to 0, wherever between two samples."""
    for end in np.linspace(3.0, 3.01, 11):
        value, slack = cycle.maximum(np.where(end > TURN, TURN / end, 0.0), True)
        assert abs(value - 1.0) <= slack < 2e-3
        average = cycle.mean(np.where(end > TURN, TURN / end, 0.0), True)
        assert abs(average.value - 0.5 * end / (2 * np.pi)) <= average.slack


def test_excess_of_a_harmonic() -> None:
    """The integral of a sine through a turn rises by 2."""
    value, slack = cycle.excess(3.0 - np.sin(TURN))
    assert value * 2 * np.pi == pytest.approx(2.0, abs=1e-10)
    assert slack < 1e-6


def test_hull_of_points_given_twice() -> None:
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [1.0, 0.5]])
    assert cycle.hull_area(np.concatenate([square, square + 1e-15])) == pytest.approx(2.0)


def test_extremes_beside_means_are_those_alone() -> None:
    """A load that sets in just beside the end of a cam's law: of a piece with that jump only values count."""
    found = loaded_machine(1000043)
    assert found is not None
    columns = {"l1.mass": found.mechanism.dimension("l1.mass") * np.array([1.0, 1.0001])}
    swept = lw.sweep(found.mechanism, columns, outputs=["peak_power", "mean_power"], threads=1)
    alone = lw.metrics(lw.solve_forces(found.mechanism), "peak_power").value("peak_power")
    assert swept["peak_power"][0] == pytest.approx(alone, rel=1e-8)


@pytest.mark.parametrize("number", [1000029, 1000053])
def test_swept_areas_of_designs_are_those_alone(number: int) -> None:
    """A driver by a periodic table, and a wheel on a belt: hulls of curves whose nodes must lie close."""
    found = loaded_machine(number)
    assert found is not None
    columns = {"gravity.y": np.array([-9.81])}
    links = [f"swept_area_of_link {link}" for link in found.mechanism.links]
    swept = lw.sweep(found.mechanism, columns, outputs=["swept_area", *links], threads=1)
    alone = lw.metrics(lw.solve_motion(found.mechanism), ["swept_area", "swept_area_of_link"])
    assert swept["swept_area"][0] == pytest.approx(alone.value("swept_area"), rel=1e-6)
    for name in links:
        assert swept[name][0] == pytest.approx(alone[tuple(name.split(" "))].value, rel=1e-6)
