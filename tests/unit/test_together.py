"""Searches side by side: questions of one moment are answered together, and failures come out."""

from collections.abc import Callable

import pytest

from linkwright.optimisation.together import together

Ask = Callable[[int], int]


def test_questions_of_one_moment_are_answered_together() -> None:
    asked: list[list[int]] = []

    def answers(questions: list[int]) -> list[int]:
        asked.append(questions)
        return [10 * each for each in questions]

    def search(count: int) -> Callable[[Ask], list[int]]:
        return lambda ask: [ask(100 * count + k) for k in range(count)]

    found = together([search(3), search(1), search(0), search(2)], answers)
    assert found == [[3000, 3010, 3020], [1000], [], [2000, 2010]]
    assert asked == [[300, 100, 200], [301, 201], [302]]
    assert together([], answers) == []


def test_what_fails_comes_out_and_ends_all() -> None:
    def failing(ask: Ask) -> int:
        raise ValueError(ask(1))

    def going_on(ask: Ask) -> int:
        return sum(ask(k) for k in range(3))

    with pytest.raises(ValueError, match=r"^1$"):
        together([going_on, failing], list)
    with pytest.raises(ZeroDivisionError):
        together([going_on, going_on], lambda questions: [1 // 0 for _ in questions])
