"""How much a group lacks to reach, and in which direction: the sentence gives the length that must be added."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from linkwright.groups.base import DYADS


@pytest.mark.parametrize(
    ("dyad", "facts", "words"),
    [
        ("RRR", {"distance²": 16.0, "first²": 1.0, "second²": 4.0}, ["4 m apart", "reach 3 m", " 1 m "]),
        ("RRR", {"distance²": 0.25, "first²": 9.0, "second²": 1.0}, ["0.5 m apart", "least 2 m", "1.5 m"]),
        ("RRR", {"distance²": 0.25, "first²": 1.0, "second²": 9.0}, ["0.5 m apart", "least 2 m", "1.5 m"]),
        ("RRP", {"height": 3.0, "length²": 4.0}, ["is 3 m", "reaches 2 m", " 1 m"]),
        ("RRP", {"height": -3.0, "length²": 4.0}, ["is 3 m", "reaches 2 m", " 1 m"]),
        ("RPR", {"distance²": 0.04, "offset": 0.5}, ["0.2 m apart", "0.5 m apart", "0.3 m"]),
        ("RPR", {"distance²": 0.04, "offset": -0.5}, ["0.2 m apart", "0.5 m apart", "0.3 m"]),
    ],
)
def test_the_sentence_says_what_is_missing(dyad: str, facts: Mapping[str, float], words: list[str]) -> None:
    said = DYADS[dyad]().explain(facts)
    assert all(word in said for word in words), said
    numbers = [word for text in words for word in text.split() if word[0].isdigit()]
    chinese = said.say("zh")
    assert all(f"{number} m" in chinese for number in numbers), chinese
    assert "-" not in chinese and "-" not in said, said
