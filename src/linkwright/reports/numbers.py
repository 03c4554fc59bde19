"""Columns of results as tables print them: symbols of the books in the heads, equal decimals below."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats, largest
from linkwright.core.outputs import KINDS, RESIDUALS, Output
from linkwright.core.quantity import MISSING, SHOWN, fixed
from linkwright.kinetostatics.forces import link_numbers
from linkwright.mechanism.mechanism import Mechanism
from linkwright.reports.document import literal, noted
from linkwright.words import Translate

#: Significant digits of the largest number of a column.
DIGITS = 6
#: An input or a number below this share of a turn (rad) or of a metre is zero but for rounding.
FADED = 1e-9
#: A result below this share of the largest one of its unit is rounding.
ROUNDING = 1e-12
#: Keeps a unit such as rad/s on one line.
JOINER = "\u2060"
_POWER_OF_TEN = re.compile(r"([-−]?\d+(?:\.\d+)?)e([+-]?\d+)((?: ?\S+)?)")
_NEGATIVE = re.compile(r"-(?=\d)")


class ColumnHeadings:
    """Heads of columns with the symbols of the worked solution; links are numbered in the order of the file."""

    def __init__(self, mechanism: Mechanism, translate: Translate) -> None:
        self.mechanism, self.translate = mechanism, translate
        self.numbers = link_numbers(mechanism)

    def head(self, output: Output) -> tuple[str, float]:
        """Head of a column of results in the unit of tables, and the factor from SI."""
        shown, factor = SHOWN.get(output.dimension, (output.unit, 1.0))
        symbol = self.symbol(output)
        quantity = noted(symbol) if symbol else literal(output.column)
        return f"{quantity}\u00a0/\u00a0{shown.replace('/', f'/{JOINER}')}", factor

    def symbol(self, output: Output) -> str:
        """What a result is called; empty where the books have none."""
        kind, owner, axis = KINDS[output.kind], output.owner, output.component
        match kind.of:
            case "point":
                name = self._point(owner)
                return f"{kind.symbol}_{name}{axis}" if kind.symbol else f"{axis}_{name}"
            case "link":
                return f"{kind.symbol}_{self.numbers[owner]}"
            case "guide":
                return f"{kind.symbol}_{owner}"
            case "joint":
                return f"{kind.symbol}_{owner},{self.numbers.get(output.on, output.on)}{axis}"
            case "driver" if kind.symbol:
                several = len(self.mechanism.drivers) > 1
                letter = "F" if output.slides else kind.symbol
                return f"{letter}_d{f',{owner}' if several else ''}"
        return f"{kind.symbol}{axis}"

    def _point(self, name: str) -> str:
        """A point without its link where no other link has one of this name."""
        last = name.rpartition(".")[2]
        links = (self.mechanism.frame, *self.mechanism.links.values())
        return last if sum(last in link.points for link in links) == 1 else name


def without_rounding(results: Mapping[Output, Floats]) -> dict[Output, Floats]:
    """Results, zero where a number is negligible against the largest of its dimension; residuals as they are."""
    sizes: dict[str, float] = {}
    for output, values in results.items():
        sizes[output.dimension] = max(sizes.get(output.dimension, 0.0), largest(values))
    return {
        output: values
        if output.kind in RESIDUALS
        else np.where(np.abs(values) < ROUNDING * sizes[output.dimension], 0.0, values)
        for output, values in results.items()
    }


def column(values: Floats) -> list[str]:
    """Numbers of one column with the same decimals, as many as the largest needs for six digits."""
    size = largest(values)
    if size and not 1e-4 <= size < 1e9:
        return [small(value, DIGITS) for value in values]
    place = max(DIGITS - 1 - math.floor(math.log10(size)), 0) if size else 0
    place = min(place, 6)
    return [fixed(float(value), place) for value in values]


def residual(values: Floats) -> list[str]:
    """What rounding leaves, of which more than two digits say nothing."""
    return [small(value, 2) for value in values]


def small(value: float, digits: int) -> str:
    """A number of any size with so many digits, a power of ten as ``e-13``; zero as 0."""
    if not math.isfinite(value):
        return MISSING
    return f"{value:.{digits - 1}e}" if value else "0"


def typeset(cell: str) -> str:
    """A cell that is a number, with its minus and its power of ten as books print them; other texts as they are."""
    found = _POWER_OF_TEN.fullmatch(cell)
    if found:
        base = found[1].replace("−", "-")
        base = base.rstrip("0").rstrip(".") if "." in base else base
        return f"{noted(f'{base}e{int(found[2])}')}{found[3]}"
    return _NEGATIVE.sub("−", cell, count=1) if re.match(r"-\d[\d.]*(?: ?[^\s\w]*| \S+)$", cell) else cell


def faded(value: float) -> float:
    """A value, zero where it is nothing but rounding."""
    return 0.0 if abs(value) < FADED else value
