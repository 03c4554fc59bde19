"""Inputs of programs at a position, besides dimensions: coordinates and rates of drivers, signs of assembly modes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, TypeVar

#: Cosine, sine and angle of a driver that turns (of links also the angle with its turns), place of one that slides,
#: both rates, sign of a group's assembly mode.
Kind = Literal["cos", "sin", "turn", "slide", "rate", "second", "mode"]
Number = TypeVar("Number")


@dataclass(frozen=True)
class Input:
    """One input of a program; ``owner``: the driver, the link whose turns are counted, or the group."""

    kind: Kind
    owner: str

    @property
    def name(self) -> str:
        """Its name among the inputs of a program."""
        return f"{self.kind}:{self.owner}"


def turned(
    driver: str, q: Number, cos: Callable[[Number], Number], sin: Callable[[Number], Number]
) -> dict[str, Number]:
    """The inputs of a driver at the angle q, rad, with the cosine and sine of such numbers."""
    cosine, sine, turn, *_ = _of_driver(driver)
    return {cosine: cos(q), sine: sin(q), turn: q}


def driven(
    driver: str,
    rotary: bool,
    course: tuple[Number, Number, Number],
    cos: Callable[[Number], Number],
    sin: Callable[[Number], Number],
) -> dict[str, Number]:
    """All inputs of a driver: its coordinate, rad or m, with the first and the second rate."""
    q, first, second = course
    *_, slide, rate, acceleration = _of_driver(driver)
    place = turned(driver, q, cos, sin) if rotary else {slide: q}
    place[rate], place[acceleration] = first, second
    return place


@lru_cache(1024)
def _of_driver(driver: str) -> tuple[str, ...]:
    """Names of all inputs of a driver; motions ask for them at every time."""
    kinds: tuple[Kind, ...] = ("cos", "sin", "turn", "slide", "rate", "second")
    return tuple(Input(kind, driver).name for kind in kinds)


def mode_inputs(signs: Mapping[str, Number]) -> dict[str, Number]:
    """Signs of assembly modes, by the names of their inputs instead of those of their groups."""
    return {Input("mode", group).name: sign for group, sign in signs.items()}


def mode_groups(names: Iterable[str]) -> list[str]:
    """The groups whose modes stand among some inputs, by the names of these."""
    before = Input("mode", "").name
    return [name.removeprefix(before) for name in names if name.startswith(before)]
