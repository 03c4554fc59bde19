"""A program written again into a trace, line by line, to be continued there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress

from linkwright.formula.operations import COMPARISONS, FUNCTIONS, Node
from linkwright.formula.program import Program
from linkwright.formula.trace import Operation, Scalar, Trace, Value

#: Operations through which no derivative passes.
WITHOUT_SLOPE = COMPARISONS | {"stop", "floor"}
_BINARY = {"add", "sub", "mul", "div"}


class Replay:
    """``values[i]``: line ``i`` of the program in ``trace``; only chosen lines are written (None: all).

    ``inputs``: replacements of inputs by name; the other inputs stay as they are.
    """

    def __init__(
        self,
        program: Program,
        chosen: Iterable[int] | None = None,
        trace: Trace | None = None,
        inputs: Mapping[str, Scalar] | None = None,
    ) -> None:
        self.trace = Trace() if trace is None else trace
        self.program = program
        self.values: dict[int, Scalar] = {}
        self._inputs = inputs or {}
        for index in range(len(program.nodes)) if chosen is None else chosen:
            self.write(index)

    def write(self, index: int) -> None:
        """Write a line whose arguments are there."""
        self.values[index] = self._written(self.program.nodes[index])

    @property
    def outputs(self) -> dict[str, Scalar | bool]:
        """The program's outputs by name, where all lines are written."""
        return {name: self.values[i] for name, i in self.program.outputs}

    def _written(self, node: Node) -> Scalar:
        if node.args:
            return operation(self.trace, node, [self.values[a] for a in node.args])
        return node.constant if node.op == "constant" else self._input(node)

    def _input(self, node: Node) -> Scalar:
        if node.name in self._inputs:
            return self._inputs[node.name]
        t = self.trace
        make = {"parameter": t.parameter, "position": t.position, "field": t.field_input}
        return make[node.op](node.name)


class Substitution:
    """Values of a trace with other values in the place of some of its inputs, written into the same trace.

    ``replacement``: the replacement of an input, by the number of its line; None leaves the input as it is.
    """

    def __init__(self, trace: Trace, replacement: Callable[[int], Scalar | None]) -> None:
        self.trace = trace
        self.replacement = replacement
        self.found: dict[int, Scalar] = {}
        self._unchanged: set[int] = set()

    def __call__(self, value: Scalar) -> Scalar:
        if not isinstance(value, Value):
            return value
        found, lines, waiting = self.found, self.trace.lines, [value.index]
        while waiting:
            index = waiting[-1]
            missing = [] if index in found else [arg for arg in lines[index][1:] if arg not in found]
            if missing:
                waiting += missing
                continue
            if index not in found:
                found[index] = self._line(index, lines[index])
            waiting.pop()
        return found[value.index]

    def _line(self, index: int, line: Operation) -> Scalar:
        t, (op, *args) = self.trace, line
        if args and not self._unchanged.issuperset(args):
            node = Node(op, (), *t.constant_and_name(index), False)
            return operation(t, node, [self.found[arg] for arg in args])
        other = self.replacement(index) if not args and op != "constant" else None
        if other is not None:
            return other
        self._unchanged.add(index)
        return t.constant_and_name(index)[0] if op == "constant" else Value(t, index)


def operation(t: Trace, node: Node, args: Sequence[Scalar]) -> Scalar:
    """An operation on other arguments."""
    if node.op in _BINARY:
        return _arithmetic(t, node.op, args[0], args[1])
    if node.op in FUNCTIONS:
        return t.power(*args) if node.op == "pow" else t.function(node.op, *args)
    if node.op == "lookup":
        return t.lookup(node.name, args[0], int(node.constant))
    if node.op == "stop":
        return t.stop(args[0])
    if node.op == "neg":
        return t.neg(args[0])
    if node.op in ("less", "less_equal"):
        return t.compare(node.op, args[0], args[1])
    if node.op in ("and", "or"):
        return t.logic(node.op, _truth(args[0]), _truth(args[1]))
    if node.op == "not":
        return t.negate(_truth(args[0]))
    return t.select(_truth(args[0]), args[1], args[2])


def _arithmetic(t: Trace, op: str, a: Scalar, b: Scalar) -> Scalar:
    with suppress(ZeroDivisionError):
        return {"add": t.add, "sub": t.sub, "mul": t.mul, "div": t.div}[op](a, b)
    return float("nan")


def _truth(value: Scalar) -> Value | bool:
    return value if isinstance(value, Value) else bool(value)


def depending(program: Program, names: Iterable[str]) -> set[int]:
    """The lines with numbers that change, smoothly, with the named inputs."""
    wanted, found = set(names), set()
    for index, node in enumerate(program.nodes):
        if node.op in WITHOUT_SLOPE:
            continue
        args = node.args[1:] if node.op == "select" else node.args
        if (not args and node.name in wanted) or any(a in found for a in args):
            found.add(index)
    return found


def operations(program: Program, chosen: set[int]) -> Iterator[int]:
    """The chosen lines that are operations, last first."""
    return (i for i in range(len(program.nodes) - 1, -1, -1) if i in chosen and program.nodes[i].args)


def inlined(program: Program, trace: Trace, inputs: Mapping[str, Scalar]) -> dict[str, Scalar | bool]:
    """The outputs of a program written into a trace, with values of that trace for some of its inputs.

    So a motion traced over positions becomes a cycle value, or another function of them.
    """
    return Replay(program, trace=trace, inputs=inputs).outputs


def across_designs(program: Program) -> Program:
    """A program without positions with its parameters as positions: the lanes are designs."""
    t = Trace()
    return Program.of(t, inlined(program, t, {name: t.position(name) for name in program.parameters}))


def along_input(program: Program) -> tuple[Program, Program] | None:
    """What depends on the positions alone, as a program of its own, and the rest with its outputs as positions.

    None where that holds no function and no look-up, so that it would not pay.
    """
    alone: set[int] = set()
    for index, node in enumerate(program.nodes):
        if node.op in ("position", "constant") or (node.args and all(a in alone for a in node.args)):
            alone.add(index)
    dear = [i for i in alone if program.nodes[i].op == "lookup" or _is_dear(program.nodes[i].op)]
    if not any(program.nodes[i].varies for i in dear):
        return None
    replay = Replay(program, ())
    for index, node in enumerate(program.nodes):
        if index in alone and node.args and node.varies and not program.yields_truth(index):
            replay.values[index] = replay.trace.position(f"{_ALONE}{index}")
        else:
            replay.write(index)
    rest = Program.of(replay.trace, replay.outputs)
    wanted = [name for name in rest.positions if name.startswith(_ALONE)]
    return Program(program.entries, tuple((name, int(name.removeprefix(_ALONE))) for name in wanted)).only(
        wanted
    ), rest


#: Prefix of the positions that are found from the input positions.
_ALONE = "along:"


def _is_dear(op: str) -> bool:
    return op in FUNCTIONS and bool(FUNCTIONS[op].library)
