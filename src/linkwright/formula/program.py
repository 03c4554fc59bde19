"""A finished straight-line program: inputs, lines that matter, outputs; inspectable, and prepared for evaluation."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

from linkwright.formula.operations import COMPARISONS, Entry, Node, needed
from linkwright.formula.trace import Scalar, Trace

SYMBOLS = {"add": "+", "sub": "-", "mul": "*", "div": "/", "less": "<", "less_equal": "<=", "and": "&", "or": "|"}


@dataclass(frozen=True)
class Program:
    """Lines in the order of evaluation, by name of their fields in ``nodes``; outputs by line number.

    ``parameters``: one number per design; ``positions``: one per position; ``fields``: one per
    design and position; ``tables``: data of a call.
    """

    entries: tuple[Entry, ...]
    outputs: tuple[tuple[str, int], ...]

    @classmethod
    def of(cls, trace: Trace, outputs: Mapping[str, Scalar | bool]) -> Program:
        """What of a trace the named outputs need, renumbered."""
        wanted = {name: trace.lift(value) for name, value in outputs.items()}
        needed = trace.needed(wanted.values())
        number = {old: new for new, old in enumerate(needed)}
        return cls(
            tuple([trace.entry(old, number) for old in needed]),
            tuple((name, number[old]) for name, old in wanted.items()),
        )

    def only(self, names: list[str]) -> Program:
        """The same program for some of its outputs."""
        entries, by_name = self.entries, dict(self.outputs)
        outputs = [(name, by_name[name]) for name in names]
        order = needed(lambda index: entries[index][1], [i for _, i in outputs])
        number = {old: new for new, old in enumerate(order)}
        return Program(
            tuple(_renumbered(entries[old], number) for old in order), tuple((name, number[i]) for name, i in outputs)
        )

    def with_inputs(self, names: Container[str], op: Literal["field", "position"] = "field") -> Program:
        """The same program with the parameters and positions of some names taken as fields, or as positions."""
        nodes: list[Node] = []
        for node in self.nodes:
            if not node.args and node.name in names:
                nodes.append(node._replace(op=op, varies=True))
            else:
                nodes.append(node._replace(varies=node.varies or any(nodes[each].varies for each in node.args)))
        return Program(tuple(nodes), self.outputs)

    @cached_property
    def nodes(self) -> tuple[Node, ...]:
        """The lines with names for their fields."""
        return tuple(map(Node._make, self.entries))

    @cached_property
    def output_names(self) -> tuple[str, ...]:
        return tuple(name for name, _ in self.outputs)

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        return self._inputs("parameter")

    @cached_property
    def positions(self) -> tuple[str, ...]:
        return self._inputs("position")

    @cached_property
    def fields(self) -> tuple[str, ...]:
        return self._inputs("field")

    @cached_property
    def tables(self) -> tuple[str, ...]:
        """The tables that are looked up, each once."""
        return tuple(dict.fromkeys(self._inputs("lookup")))

    @property
    def names(self) -> dict[str, list[str]]:
        """The names of the outputs, and of the inputs of every kind, in their order."""
        kinds = ("parameters", "positions", "fields", "tables")
        return {"outputs": list(self.output_names), **{kind: list(getattr(self, kind)) for kind in kinds}}

    def _inputs(self, kind: str) -> tuple[str, ...]:
        return tuple(name for op, _, _, name, _ in self.entries if op == kind)

    @cached_property
    def key(self) -> str:
        """A hash of everything that decides what the program computes."""
        import hashlib

        return hashlib.blake2b(self.text().encode(), digest_size=16).hexdigest()

    def counts(self) -> dict[str, dict[str, int]]:
        """Numbers of operations, done once per design and once per position."""
        tally: dict[str, Counter[str]] = {"design": Counter(), "position": Counter()}
        for op, args, _, _, varies in self.entries:
            if args:
                tally["position" if varies else "design"][op] += 1
        return {level: dict(sorted(counter.items())) for level, counter in tally.items()}

    def text(self) -> str:
        """The program as lines ``v12 = v3 * v7``."""
        lines = [f"v{i} = {_spelled(*entry)}" for i, entry in enumerate(self.entries)]
        lines += [f"output {name} = v{i}" for name, i in self.outputs]
        return "\n".join(lines)

    def yields_truth(self, index: int) -> bool:
        """Whether a line holds a truth value instead of a number."""
        return self.entries[index][0] in COMPARISONS


def _spelled(op: str, args: tuple[int, ...], constant: float, name: str, _: bool) -> str:
    if op == "constant":
        return repr(constant)
    if not args:
        return f"{op} {name}"
    names = [f"v{i}" for i in args]
    if op == "lookup":
        return f"lookup[{name}, {constant:.0f}]({names[0]})"
    if op in SYMBOLS:
        return f"{names[0]} {SYMBOLS[op]} {names[1]}"
    return f"{op}({', '.join(names)})"


def _renumbered(entry: Entry, number: Mapping[int, int]) -> Entry:
    op, args, constant, name, varies = entry
    return (op, tuple([number[i] for i in args]), constant, name, varies) if args else entry


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
