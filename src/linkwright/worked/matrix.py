"""Equations of matrices as text and as LaTeX: ``K = [ … ]``, and A·X = B with the names of unknowns and rows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.words.characters import aligned, cells, padded
from linkwright.worked.page import Written
from linkwright.worked.written import latex_symbol, number

#: Columns of a matrix up to which A·X = B is a formula of a report; a wider one is a table.
WIDEST = 7
#: An entry below this share of the largest is nothing but rounding.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Matrix:
    """Entries of a matrix in rows, each as plain text and as LaTeX."""

    rows: tuple[tuple[tuple[str, str], ...], ...]

    @classmethod
    def of(cls, matrix: Floats | Sequence[str]) -> Matrix:
        """Of numbers (m, n), or of names (a column); numbers that are rounding beside the largest are zero."""
        texts = _texts(matrix)
        return cls(tuple(tuple((text, _entry(text)) for text in row) for row in texts))

    @property
    def lines(self) -> list[str]:
        """Its rows in plain text, in brackets that go over all of them."""
        inside = aligned([[text for text, _ in row] for row in self.rows], ">" * len(self.rows[0]))
        if len(inside) == 1:
            return [f"[{inside[0]}]"]
        marks = ["⎡⎤", *["⎢⎥"] * (len(inside) - 2), "⎣⎦"]
        width = max(map(cells, inside))
        return [
            f"{mark[0]} {padded(line, width)} {mark[1]}" for mark, line in zip(marks, inside, strict=True)
        ]

    @property
    def latex(self) -> str:
        """As LaTeX."""
        rows = r" \\ ".join(" & ".join(tex for _, tex in row) for row in self.rows)
        return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"


def side_by_side(
    parts: Sequence[Matrix | str], rows: Sequence[str] = (), table: Sequence[tuple[str, ...]] = ()
) -> Written:
    """An equation of matrices and the signs between them (``=``, a symbol, or empty for a product), the signs halfway
    up; ``rows``: names before the lines; ``table``: what reports print where a matrix is too wide."""
    blocks = [part.lines if isinstance(part, Matrix) else [part or "·"] for part in parts]
    high = max(map(len, blocks))
    if rows:
        blocks.insert(0, [f"{name}:" for name in rows])
    columns = []
    for block in blocks:
        above = (high - len(block)) // 2
        filled = [""] * above + block + [""] * (high - len(block) - above)
        width = max(map(cells, block))
        columns.append([padded(line, width) for line in filled])
    sides = [""]
    for part in parts:
        if part == "=":
            sides.append("")
        else:
            sides[-1] += part.latex if isinstance(part, Matrix) else latex_symbol(part) if part else ""
    text = "\n".join(" ".join(row).rstrip() for row in zip(*columns, strict=True))
    return Written(text, tuple(sides), tuple(table))


@dataclass(frozen=True)
class Matrices:
    """Matrices beside each other, each with its symbol: ``("A", rows)`` of numbers, or of names (a column)."""

    first: tuple[str, Floats | Sequence[str]]
    rest: tuple[tuple[str, Floats | Sequence[str]], ...] = ()
    rows: tuple[str, ...] = ()

    def written(self) -> Written:
        """One matrix as ``K = [ … ]``; several as ``A·X = B``, the last one behind the equal sign."""
        own = [Matrix.of(matrix) for _, matrix in (self.first, *self.rest)]
        if not self.rest:
            return side_by_side([self.first[0], "=", own[0]], self.rows)
        parts: list[Matrix | str] = [*own[:-1], "=", own[-1]]
        wide = len(own) == 3 and len(own[0].rows[0]) > WIDEST
        return side_by_side(parts, self.rows, self._cells(own) if wide else ())

    def _cells(self, own: Sequence[Matrix]) -> tuple[tuple[str, ...], ...]:
        """A·X = B as rows of a table: names of the unknowns over the columns of A, then B; zeros left out."""
        a, x, b = ([[text for text, _ in row] for row in each.rows] for each in own)
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


def _entry(text: str) -> str:
    sign = "-" if text.startswith("-") else ""
    bare = text.removeprefix("-")
    return sign + number(bare) if bare[:1].isdigit() else latex_symbol(text)
