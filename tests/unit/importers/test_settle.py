"""Places that hold lengths and lines: slopes of each constraint, the nearest places, and what is led."""

import math

import numpy as np
import pytest

from linkwright.importers.settle import Apart, Constraint, Distance, OnBar, OnLine, Turned, meeting, settle

PLACES = {"A": (0.3, 0.1), "B": (1.4, 0.9), "C": (0.6, -0.7)}


@pytest.mark.parametrize(
    "constraint",
    [
        Distance("A", "B", 1.0),
        Distance("A", "B", 2.0, 1.0),
        Turned("A", "B", 1.0, 0.4, 0.2),
        Apart("A", "B", 0, 0.5),
        Apart("A", "B", 1, 0.5),
        OnLine("C", (0.1, 0.2), 0.7),
        OnBar("C", "A", "B", 0.3, 0.2),
    ],
)
def test_slopes_are_those_of_finite_differences(constraint: Constraint) -> None:
    for number, (_wrong, slopes) in enumerate(constraint.rows(PLACES, 0.6)):
        for name, slope in slopes.items():
            if isinstance(constraint, Turned) and name == constraint.pivot:
                continue
            for axis in (0, 1):
                ends = []
                for shift in (1e-6, -1e-6):
                    place = list(PLACES[name])
                    place[axis] += shift
                    ends.append(list(constraint.rows(PLACES | {name: tuple(place)}, 0.6))[number][0])
                assert (ends[0] - ends[1]) / 2e-6 == pytest.approx(slope[axis], abs=1e-8)


def test_places_that_hold_stay_as_they_are() -> None:
    places = {"O": (0.0, 0.0), "A": (0.3, 0.4)}
    assert settle(places, ["O"], [Distance("O", "A", 0.5)]) == (places, 0.0)


def test_the_smallest_change_is_made() -> None:
    places, wrong = settle({"A": (0.0, 0.0), "B": (1.0, 0.0)}, [], [Distance("A", "B", 1.2)])
    assert places["A"] == pytest.approx((-0.1, 0.0)) and places["B"] == pytest.approx((1.1, 0.0))
    assert wrong < 1e-13


def test_a_crank_is_led_in_the_assembly_mode_in_which_it_is_drawn() -> None:
    o, q, crank, rod, rocker = (0.0, 0.0), (4.0, 0.0), 1.0, 3.5, 3.0
    drawn = {"O": o, "Q": q, "A": (1.0, 0.0), "B": meeting((1.0, 0.0), rod, q, rocker, True) or o}
    turned, lengths = Turned("O", "A", crank, 3.0, 0.0), [Distance("A", "B", rod), Distance("B", "Q", rocker)]
    places, wrong = settle(drawn, ["O", "Q"], [turned, *lengths])
    a = (math.cos(3.0), math.sin(3.0))
    assert wrong < 1e-12 and places["A"] == pytest.approx(a)
    assert places["B"] == pytest.approx(meeting(a, rod, q, rocker, True))


def test_what_cannot_be_held_is_said() -> None:
    places = {"O": (0.0, 0.0), "Q": (4.0, 0.0), "A": (1.0, 1.0)}
    _settled, wrong = settle(places, ["O", "Q"], [Distance("O", "A", 1.0), Distance("Q", "A", 1.0)])
    assert 0.5 < wrong < 4.0


def test_circles_that_do_not_meet() -> None:
    assert meeting((0.0, 0.0), 1.0, (4.0, 0.0), 1.0, True) is None
    assert np.allclose(meeting((0.0, 0.0), 5.0, (6.0, 0.0), 5.0, False) or (), (3.0, -4.0))
