"""Structure analysis grows with the number of links, not with its square, whatever the order of the file."""

from __future__ import annotations

import random

import pytest
from tests.work import counted

import linkwright as lw

FEW, MANY = 50, 400


def chain(dyads: int, order: str) -> lw.Mechanism:
    """Four-bar loops in a row, each driven by the rocker of the one before."""
    links = [
        text
        for i in range(dyads)
        for text in (
            f"  c{i}: {{points: [{f'B{i - 1}' if i else 'A'}, B{i}], length: 0.6 m}}",
            f"  r{i}: {{points: [F{i}, B{i}], length: 0.45 m}}",
        )
    ]
    if order == "reversed":
        links.reverse()
    elif order == "shuffled":
        random.Random(3).shuffle(links)
    pins = ", ".join(["O1: [0 m, 0 m]", *(f"F{i}: [{0.5 + 0.5 * i} m, 0 m]" for i in range(dyads))])
    return lw.loads(
        f"format: 1\nname: chain\nframe:\n  points: {{{pins}}}\nlinks:\n"
        "  crank: {points: [O1, A], length: 0.1 m}\n" + "\n".join(links) + "\n"
        "driver: {turn: crank, about: O1, speed: 1 rad/s}\n"
    )


@pytest.mark.rotating
@pytest.mark.parametrize("order", ["file", "reversed", "shuffled"])
def test_structure_grows_linearly(order: str) -> None:
    few, many = chain(FEW, order), chain(MANY, order)
    found = lw.structure(many)
    assert [len(group.links) for group in found.groups] == [1] + [2] * MANY
    assert {group.signature for group in found.groups[1:]} == {"RRR"}
    growth = counted(lambda: lw.structure(many))[1] / counted(lambda: lw.structure(few))[1]
    assert 1.0 < growth < (MANY / FEW) ** 1.1
