"""Equations of matrices: ``K = [ … ]``, and A·X = B with the names of unknowns and rows."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.equations.notation import Matrix, Node, Row, number, row
from linkwright.equations.reading import read_name
from linkwright.equations.steps import Written
from linkwright.words.characters import aligned, cells, padded

#: Columns of a matrix up to which A·X = B is a formula of a report; a wider one is a table.
WIDEST = 7
#: An entry below this share of the largest is nothing but rounding.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Entries:
    """Entries of a matrix in rows, as they are written on a line."""

    rows: tuple[tuple[str, ...], ...]

    @classmethod
    def of(cls, matrix: Floats | Sequence[str]) -> Entries:
        """Of numbers (m, n), or of names (a column); rounding errors of the largest are zero."""
        if not isinstance(matrix, np.ndarray):
            return cls(tuple((str(each),) for each in matrix))
        negligible = ROUNDING * (float(np.abs(matrix).max()) if matrix.size else 0.0)
        texts = (("0" if abs(c) <= negligible else f"{c:.6g}" for c in row) for row in np.atleast_2d(matrix).tolist())
        return cls(tuple(map(tuple, texts)))

    @property
    def lines(self) -> list[str]:
        """Its rows in plain text, in brackets that go over all of them."""
        inside = aligned(self.rows, ">" * len(self.rows[0]))
        if len(inside) == 1:
            return [f"[{inside[0]}]"]
        brackets = ["⎡⎤", *["⎢⎥"] * (len(inside) - 2), "⎣⎦"]
        width = max(map(cells, inside))
        return [f"{mark[0]} {padded(line, width)} {mark[1]}" for mark, line in zip(brackets, inside, strict=True)]

    @property
    def printed(self) -> Matrix:
        """As it is printed."""
        return Matrix(tuple(tuple(map(_entry, row)) for row in self.rows), "[", "]")


def side_by_side(
    parts: Sequence[Entries | str], rows: Sequence[str] = (), table: Sequence[tuple[str, ...]] = ()
) -> Written:
    """An equation of matrices and the signs between them (``=``, a symbol, or empty for a product), the signs halfway
    up; ``rows``: names before the lines; ``table``: what reports print where a matrix is too wide."""
    blocks = [part.lines if isinstance(part, Entries) else [part or "·"] for part in parts]
    high = max(map(len, blocks))
    if rows:
        blocks.insert(0, [f"{name}:" for name in rows])
    columns = []
    for block in blocks:
        above = (high - len(block)) // 2
        filled = [""] * above + block + [""] * (high - len(block) - above)
        width = max(map(cells, block))
        columns.append([padded(line, width) for line in filled])
    sides: list[list[Node]] = [[]]
    for part in parts:
        if part == "=":
            sides.append([])
        elif part:
            sides[-1] += [part.printed] if isinstance(part, Entries) else read_name(part).items
    text = "\n".join(" ".join(line).rstrip() for line in zip(*columns, strict=True))
    return Written(text, tuple(map(row, sides)), tuple(table))


def named_matrix(symbol: str, matrix: Floats) -> Written:
    """A matrix with its symbol: ``K = [ … ]``."""
    return side_by_side([symbol, "=", Entries.of(matrix)])


def system(a: Floats, unknowns: Sequence[str], b: Floats, rows: Sequence[str]) -> Written:
    """A·X = B with the names of the unknowns and of the rows; as a table for reports where it is wide: names of the
    unknowns over the columns of A, then B, zeros left out."""
    left, names, right = Entries.of(a), Entries.of(unknowns), Entries.of(b[:, None])
    table: list[tuple[str, ...]] = []
    if len(unknowns) > WIDEST:
        table.append(("", *unknowns, "B"))
        for name, factors, known in zip(rows, left.rows, right.rows, strict=True):
            table.append((name, *("" if each == "0" else each for each in factors), *known))
    return side_by_side([left, names, "=", right], rows, table)


def _entry(text: str) -> Row:
    return Row(number(text)) if re.fullmatch(r"-?\d[\d.]*(e[-+]?\d+)?", text) else read_name(text)
