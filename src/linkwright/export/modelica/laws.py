"""Drivers' laws as Modelica expressions of time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import assert_never

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.expression_tree import Binary, Call, Negative, Node, Number, Variable
from linkwright.drivers.base import Law
from linkwright.export.modelica.names import number


@dataclass(frozen=True)
class LawText:
    """Writes laws between two times, s, in terms of ``time``."""

    begin: float
    end: float

    def straight(self, start: float, speed: float) -> str:
        """start + speed t."""
        return f"{number(start)} + ({number(speed)})*time"

    def expression(self, tree: Node, parameters: Mapping[str, float]) -> str:
        """An expression of t and of parameters, which are put in."""
        return formula(tree, {**{name: number(value) for name, value in parameters.items()}, "t": "time"})

    def pieces(self, law: Law, times: Sequence[float], interpolation: str) -> str:
        """A law by cubic pieces between times, ``linear`` ones or those that repeat (``periodic``)."""
        nodes = np.asarray(times)
        if interpolation == "periodic":
            period = nodes[-1] - nodes[0]
            first = np.floor((self.begin - nodes[0]) / period)
            last = np.ceil((self.end - nodes[0]) / period)
            turns = np.arange(first, max(last, first + 1))
            nodes = np.unique(np.concatenate([nodes + turn * period for turn in turns]))
        rows = np.stack([nodes, *law.coordinate(nodes)], axis=1)
        texts = []
        for (left, q, qd, qdd), (right, _, _, qdd_next) in pairwise(rows):
            third = (qdd_next - qdd) / (6 * (right - left)) if interpolation != "linear" else 0.0
            x = f"(time - ({number(left)}))"
            a, b, c, d = (f"({number(each)})" for each in (q, qd, qdd / 2, third))
            texts.append((right, f"({a} + {x}*({b} + {x}*({c} + {x}*{d})))"))
        text = texts[-1][1]
        for right, piece in reversed(texts[:-1]):
            text = f"(if time < {number(right)} then {piece} else {text})"
        return text


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
