"""What programs take at a position beside the dimensions: places and rates of drivers, signs of assembly modes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Literal, TypeVar

from linkwright.core.dataclass import dataclass

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
    return {
        Input("cos", driver).name: cos(q),
        Input("sin", driver).name: sin(q),
        Input("turn", driver).name: q,
    }


def mode_inputs(signs: Mapping[str, Number]) -> dict[str, Number]:
    """Signs of assembly modes, by the names of their inputs instead of those of their groups."""
    return {Input("mode", group).name: sign for group, sign in signs.items()}


def mode_groups(names: Iterable[str]) -> list[str]:
    """The groups whose modes stand among some inputs, by the names of these."""
    before = Input("mode", "").name
    return [name.removeprefix(before) for name in names if name.startswith(before)]
