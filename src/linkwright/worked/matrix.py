"""Equations of matrices as text and as LaTeX: ``K = [ … ]``, and A·X = B with the names of unknowns and rows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.words.characters import cells
from linkwright.worked.page import Written
from linkwright.worked.written import latex_symbol, number

#: Columns of a matrix up to which A·X = B is a formula of a report; a wider one is a table.
WIDEST = 7
#: An entry below this share of the largest is nothing but rounding.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Matrices:
    """Matrices beside each other, each with its symbol: ``("A", rows)`` of numbers, or of names (a column)."""

    first: tuple[str, Floats | Sequence[str]]
    rest: tuple[tuple[str, Floats | Sequence[str]], ...] = ()
    rows: tuple[str, ...] = ()

    def written(self) -> Written:
        """One matrix as ``K = [ … ]``; several as ``A·X = B``, the last one behind the equal sign."""
        parts = [self.first, *self.rest]
        columns = [_texts(matrix) for _, matrix in parts]
        head = [symbol for symbol, _ in parts]
        if len(parts) == 1:
            return Written(
                _joined(columns, [f"{head[0]} ="], self.rows), (latex_symbol(head[0]), _latex(columns[0]))
            )
        left = "".join(_latex(each) for each in columns[:-1])
        if len(columns) == 3 and len(columns[0][0]) > WIDEST:
            return Written(
                _joined(columns, ["", "", "="], self.rows), (left, _latex(columns[-1])), self._cells(columns)
            )
        return Written(
            _joined(columns, ["", *[""] * (len(parts) - 2), "="], self.rows), (left, _latex(columns[-1]))
        )

    def _cells(self, columns: Sequence[list[list[str]]]) -> tuple[tuple[str, ...], ...]:
        """A·X = B as rows of a table: names of the unknowns over the columns of A, then B; zeros left out."""
        a, x, b = columns
        head = ("", *(each[0] for each in x), self.rest[-1][0])
        body = (
            (name, *("" if each == "0" else each for each in row), *right)
            for name, row, right in zip(self.rows, a, b, strict=True)
        )
        return (head, *body)


def _texts(matrix: Floats | Sequence[str]) -> list[list[str]]:
    """The entries as they are printed."""
    if not isinstance(matrix, np.ndarray):
        return [[str(each)] for each in matrix]
    largest = float(np.abs(matrix).max()) if matrix.size else 0.0
    return [
        ["0" if abs(c) <= ROUNDING * largest else f"{c:.6g}" for c in row]
        for row in np.atleast_2d(matrix).tolist()
    ]


def _latex(texts: list[list[str]]) -> str:
    rows = r" \\ ".join(" & ".join(_entry(each) for each in row) for row in texts)
    return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"


def _entry(text: str) -> str:
    sign = "-" if text.startswith("-") else ""
    bare = text.removeprefix("-")
    return sign + number(bare) if bare[:1].isdigit() else latex_symbol(text)


def _joined(blocks: list[list[list[str]]], heads: list[str], rows: tuple[str, ...]) -> str:
    """All matrices line by line, columns right under each other, signs between them on the middle line."""
    count = max(len(block) for block in blocks)
    middle = (count - 1) // 2
    lines = [f"{name}:".ljust(max(map(cells, rows)) + 2) for name in rows] or [""] * count
    for head, block in zip(heads, blocks, strict=True):
        wide = [max(cells(row[i]) for row in block) for i in range(len(block[0]))]
        for k in range(count):
            sign = (head if k == middle else " " * cells(head)) if head else ""
            inside = "  ".join(" " * (w - cells(t)) + t for t, w in zip(block[k], wide, strict=True))
            lines[k] += f"{sign + ' ' if head else ''}[ {inside} ] "
    return "\n".join(line.rstrip() for line in lines)
