"""Drivers' laws as Modelica expressions of time."""

from __future__ import annotations

from typing import assert_never

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.expression_tree import Binary, Call, Negative, Node, Number, Variable
from linkwright.drivers.expression import ExpressionLaw
from linkwright.drivers.table import TableLaw
from linkwright.export.modelica.names import number


@dataclass(frozen=True)
class LawText:
    """Writes laws between two times, s, in terms of ``time``."""

    begin: float
    end: float

    def straight(self, start: float, speed: float) -> str:
        """start + speed t."""
        return f"{number(start)} + ({number(speed)})*time"

    def expression(self, law: ExpressionLaw) -> str:
        """An expression of t and of parameters, which are put in."""
        values = {name: number(value) for name, value in law.parameters.items()}
        return formula(law.expression.tree, {**values, "t": "time"})

    def pieces(self, law: TableLaw) -> str:
        """The table's cubic or straight pieces."""
        return _pieces(law, self.begin, self.end)


def formula(node: Node, names: dict[str, str]) -> str:
    """An expression; ``names``: what stands for its free names."""
    match node:
        case Number(value):
            return f"({number(value)})"
        case Variable(name):
            return f"({names[name]})"
        case Negative(operand):
            return f"(-{formula(operand, names)})"
        case Binary(sign, left, right):
            return f"({formula(left, names)} {sign} {formula(right, names)})"
        case Call(function, arguments):
            return _call(function, [formula(each, names) for each in arguments])
    assert_never(node)


def _call(function: str, arguments: list[str]) -> str:
    if function == "step":
        return f"(if {arguments[0]} >= 0 then 1.0 else 0.0)"
    if function == "sign":
        x = arguments[0]
        return f"(if {x} > 0 then 1.0 elseif {x} < 0 then -1.0 else 0.0)"
    if function == "abs":
        return f"(if {arguments[0]} >= 0 then {arguments[0]} else -{arguments[0]})"
    if function in ("min", "max"):
        a, b = arguments
        return f"(if {a} {'<' if function == 'min' else '>'} {b} then {a} else {b})"
    return f"{function}({', '.join(arguments)})"


def _pieces(law: TableLaw, begin: float, end: float) -> str:
    """The table's cubic or straight pieces between two times."""
    nodes = _nodes(law, begin, end)
    position, rate, second = law.coordinate(nodes)
    texts = []
    for left, right, q, qd, qdd, qdd_next in zip(
        nodes, nodes[1:], position, rate, second, second[1:], strict=False
    ):
        third = (qdd_next - qdd) / (6 * (right - left)) if law.interpolation != "linear" else 0.0
        x = f"(time - ({number(left)}))"
        a, b, c, d = (f"({number(each)})" for each in (q, qd, qdd / 2, third))
        texts.append((right, f"({a} + {x}*({b} + {x}*({c} + {x}*{d})))"))
    text = texts[-1][1]
    for right, piece in reversed(texts[:-1]):
        text = f"(if time < {number(right)} then {piece} else {text})"
    return text


def _nodes(law: TableLaw, begin: float, end: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    times = np.asarray(law.times)
    if law.interpolation != "periodic":
        return times
    period = times[-1] - times[0]
    first, last = np.floor((begin - times[0]) / period), np.ceil((end - times[0]) / period)
    turns = np.arange(first, max(last, first + 1))
    return np.unique(np.concatenate([times + turn * period for turn in turns]))
