"""A program prepared for evaluation: truth values separate from numbers, inputs by their index."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from linkwright.formula.node import COMPARISONS
from linkwright.formula.program import Program

INPUTS = frozenset({"parameter", "position", "field"})
LOGIC = frozenset({"and", "or", "not"})


class Line(NamedTuple):
    """One evaluation step.

    ``op``: an operation of :class:`~linkwright.formula.trace.Node`, or ``number`` (a truth value
    as 1.0 or 0.0), or ``truth`` (whether a number is not zero). ``place``: for an input, its
    place among the inputs of its kind; for a ``lookup``, the table's place, ``constant`` the order of
    the derivative. ``truth``: whether the line holds a truth value.
    """

    op: str
    args: tuple[int, ...]
    varies: bool
    truth: bool = False
    constant: float = 0.0
    place: int = 0

    @property
    def is_input(self) -> bool:
        """Whether the value is an input."""
        return self.op in INPUTS

    @property
    def is_operation(self) -> bool:
        """Whether the value is found from earlier lines."""
        return bool(self.args)


@dataclass(frozen=True, slots=True)
class Lines:
    """Lines in the order of evaluation; ``outputs`` by line number; ``tables``: how many are looked up."""

    lines: tuple[Line, ...]
    outputs: tuple[int, ...]
    tables: int = 0

    @classmethod
    def of(cls, program: Program) -> Lines:
        """The lines of a program; ``stop`` costs nothing and disappears."""
        builder = _Builder()
        places = dict.fromkeys(INPUTS, 0)
        where: list[int] = []
        for op, args, constant, name, varies in program.entries:
            if op in INPUTS:
                where.append(builder.add(Line(op, (), varies, place=places[op])))
                places[op] += 1
            elif op == "constant":
                where.append(builder.add(Line("constant", (), False, constant=constant)))
            elif op == "lookup":
                at, table = (builder.number(where[args[0]]),), program.tables.index(name)
                where.append(builder.add(Line("lookup", at, varies, False, constant, table)))
            elif op == "stop":
                where.append(where[args[0]])
            else:
                where.append(builder.operation(op, [where[i] for i in args], varies))
        return cls(tuple(builder.lines), tuple(where[i] for _, i in program.outputs), len(program.tables))

    def design_lines(self) -> list[int]:
        """The lines evaluated once per design, inputs left out."""
        return [i for i, line in enumerate(self.lines) if line.args and not line.varies]

    def boundary(self) -> list[int]:
        """Values found once per design that lines per position or outputs use."""
        wanted = {a for line in self.lines if line.varies for a in line.args}
        wanted.update(self.outputs)
        return sorted(i for i in wanted if not self.lines[i].varies and self.lines[i].op != "constant")


class _Builder:
    def __init__(self) -> None:
        self.lines: list[Line] = []
        self._converted: dict[tuple[str, int], int] = {}

    def add(self, line: Line) -> int:
        self.lines.append(line)
        return len(self.lines) - 1

    def operation(self, op: str, args: list[int], varies: bool) -> int:
        if op in LOGIC:
            args = [self.truth(a) for a in args]
        elif op == "select":
            args = [self.truth(args[0]), self.number(args[1]), self.number(args[2])]
        else:
            args = [self.number(a) for a in args]
        return self.add(Line(op, tuple(args), varies, op in COMPARISONS))

    def truth(self, index: int) -> int:
        return index if self.lines[index].truth else self._convert("truth", index)

    def number(self, index: int) -> int:
        return self._convert("number", index) if self.lines[index].truth else index

    def _convert(self, op: str, index: int) -> int:
        key = (op, index)
        if key not in self._converted:
            self._converted[key] = self.add(Line(op, (index,), self.lines[index].varies, op == "truth"))
        return self._converted[key]
