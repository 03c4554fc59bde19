"""Cycles that plain numbers show to be passed are those that Grashof's rule and the transmission angle show."""

import random

import pytest

import linkwright as lw
from linkwright.kinematics.passing import nothing_passed, plainly_passed
from linkwright.kinematics.solve import try_motion
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.mechanism.mechanism import Mechanism


def fourbar(a: float, b: float, c: float, d: float) -> Mechanism:
    return lw.loads(
        f"""
format: 1
name: four-bar
frame: {{points: {{O: [0 m, 0 m], Q: [{d!r} m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: {a!r} m}}
  coupler: {{points: [A, B], length: {b!r} m}}
  rocker: {{points: [Q, B], length: {c!r} m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O, speed: 60 rpm}}
"""
    )


def passed(mechanism: Mechanism) -> bool:
    return plainly_passed(mechanism, analysed(mechanism), 72) is not None


def test_fourbars_pass_where_grashof_and_the_transmission_angle_say() -> None:
    given, seen = random.Random(1), set()
    for _ in range(60):
        a, b, c, d = (given.uniform(0.5, 4.0) for _ in range(4))
        ends = [(b * b + c * c - (d + sign * a) ** 2) / (2 * b * c) for sign in (1, -1)]
        turns = all(abs(cosine) < 1.0 for cosine in ends)
        least = min(1.0 - cosine**2 for cosine in ends) if turns else 0.0
        found = passed(fourbar(a, b, c, d))
        assert turns or not found
        assert found or least < 0.2
        seen.add(found)
    assert seen == {True, False}


@pytest.mark.parametrize("sides", [(1.0, 3.0, 1.0, 3.0), (1.0, 2.0, 2.0, 1.0), (1.0, 3.5, 2.5, 5.0)])
def test_change_points_are_not_plain(sides: tuple[float, float, float, float]) -> None:
    assert not passed(fourbar(*sides))


def test_where_plain_numbers_tell_arrays_tell_the_same() -> None:
    mechanism = fourbar(1.0, 3.5, 2.5, 4.0)
    assert passed(mechanism)
    motion = try_motion(mechanism, 72)
    assert motion.ok.all() and not motion.notes


def test_what_comes_near_zero_or_moves_as_far_in_a_step_is_not_passed_over() -> None:
    assert nothing_passed(["quality:g"], [[0.5, 0.6, 0.7, 0.6]])
    assert not nothing_passed(["quality:g"], [[0.5, 0.019, 0.5, 0.5]])
    assert not nothing_passed(["quality:g"], [[0.3, 0.9, 0.5, 0.4]])
    assert not nothing_passed(["fact:g|distance²"], [[100.0, 1.0, 50.0]])
    assert nothing_passed(["fact:g|distance²"], [[100.0, 3.0, 50.0]])
    assert not nothing_passed(["quality:g"], [[0.5, float("nan"), 0.5]])
