"""A finished straight-line program: inputs, lines that matter, outputs; inspectable."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Mapping, Sequence
from functools import cached_property

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import COMPARISONS, Entry, Node, Scalar, Trace

SYMBOLS = {
    "add": "+",
    "sub": "-",
    "mul": "*",
    "div": "/",
    "less": "<",
    "less_equal": "<=",
    "and": "&",
    "or": "|",
}


@dataclass(frozen=True)
class Program:
    """Lines in the order of evaluation; outputs and next states by line number.

    ``parameters``: one number per design; ``positions``: one per position; ``fields``: one per
    design and position; ``states``: carried from a position to the next; ``tables``: data of a call.
    """

    nodes: tuple[Node, ...]
    outputs: tuple[tuple[str, int], ...]
    next_states: tuple[tuple[str, int], ...] = ()

    @classmethod
    def of(
        cls,
        trace: Trace,
        outputs: Mapping[str, Scalar | bool],
        next_states: Mapping[str, Scalar] | None = None,
    ) -> Program:
        """What of a trace the named outputs need, renumbered."""
        wanted = {name: trace.lift(value) for name, value in outputs.items()}
        carried = {name: trace.lift(value) for name, value in (next_states or {}).items()}
        kept = needed(trace.lines, [*wanted.values(), *carried.values()])
        number = {old: new for new, old in enumerate(kept)}
        nodes = tuple(_renumbered(trace.lines[old], number) for old in kept)
        return cls(
            nodes,
            tuple((name, number[old]) for name, old in wanted.items()),
            tuple((name, number[old]) for name, old in carried.items()),
        )

    def only(self, names: list[str]) -> Program:
        """The same program for some of its outputs."""
        by_name = dict(self.outputs)
        kept = needed(self.nodes, [*(by_name[name] for name in names), *(i for _, i in self.next_states)])
        number = {old: new for new, old in enumerate(kept)}
        return Program(
            tuple(_renumbered(self.nodes[old], number) for old in kept),
            tuple((name, number[by_name[name]]) for name in names),
            tuple((name, number[i]) for name, i in self.next_states),
        )

    def fields_last(self) -> Program:
        """The same program with all lines that need no field before those that do."""
        late: set[int] = set()
        for index, node in enumerate(self.nodes):
            if node.op == "field" or not late.isdisjoint(node.args):
                late.add(index)
        order = [i for i in range(len(self.nodes)) if i not in late] + sorted(late)
        number = {old: new for new, old in enumerate(order)}
        return Program(
            tuple(_renumbered(self.nodes[old], number) for old in order),
            tuple((name, number[i]) for name, i in self.outputs),
            tuple((name, number[i]) for name, i in self.next_states),
        )

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
    def states(self) -> tuple[str, ...]:
        return self._inputs("state")

    @cached_property
    def tables(self) -> tuple[str, ...]:
        """The tables that are looked up, each once."""
        return tuple(dict.fromkeys(self._inputs("lookup")))

    def _inputs(self, op: str) -> tuple[str, ...]:
        return tuple(node.name for node in self.nodes if node.op == op)

    @cached_property
    def key(self) -> str:
        """A hash of everything that decides what the program computes."""
        import hashlib

        return hashlib.blake2b(self.text().encode(), digest_size=16).hexdigest()

    def counts(self) -> dict[str, dict[str, int]]:
        """Numbers of operations, done once per design and once per position."""
        tally: dict[str, Counter[str]] = {"design": Counter(), "position": Counter()}
        for node in self.nodes:
            if node.args:
                tally["position" if node.varies else "design"][node.op] += 1
        return {level: dict(sorted(counter.items())) for level, counter in tally.items()}

    def text(self) -> str:
        """The program as lines ``v12 = v3 * v7``."""
        lines = [f"v{i} = {_spelled(node)}" for i, node in enumerate(self.nodes)]
        lines += [f"output {name} = v{i}" for name, i in self.outputs]
        lines += [f"carry {name} = v{i}" for name, i in self.next_states]
        return "\n".join(lines)

    def yields_truth(self, index: int) -> bool:
        """Whether a line holds a truth value instead of a number."""
        return self.nodes[index].op in COMPARISONS


def _spelled(node: Node) -> str:
    if node.op == "constant":
        return repr(node.constant)
    if not node.args:
        return f"{node.op} {node.name}"
    names = [f"v{i}" for i in node.args]
    if node.op == "lookup":
        return f"lookup[{node.name}, {node.constant:.0f}]({names[0]})"
    if node.op in SYMBOLS:
        return f"{names[0]} {SYMBOLS[node.op]} {names[1]}"
    return f"{node.op}({', '.join(names)})"


def needed(lines: Sequence[Entry], wanted: Iterable[int], stop: Container[int] = ()) -> list[int]:
    """The lines that the wanted ones are found from, in order; what is behind ``stop`` is left out."""
    seen = set(wanted)
    stack = list(seen)
    while stack:
        index = stack.pop()
        if index not in stop:
            for arg in lines[index][1]:
                if arg not in seen:
                    seen.add(arg)
                    stack.append(arg)
    return sorted(seen)


def _renumbered(line: Entry, number: Mapping[int, int]) -> Node:
    op, args, constant, name, varies = line
    return Node(op, tuple([number[i] for i in args]), constant, name, varies)
