"""Drivers' laws as Modelica expressions of time; names and numbers in Modelica."""

from __future__ import annotations

import re
from functools import singledispatch
from itertools import pairwise
from typing import assert_never

import numpy as np

from linkwright.core.expression_tree import Binary, Call, Negative, Node, Number, Variable
from linkwright.drivers.base import Law
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.expression import ExpressionLaw
from linkwright.drivers.table import TableLaw
from linkwright.errors import LinkwrightError
from linkwright.words import _
from linkwright.words.characters import one_line, printable


def number(value: float) -> str:
    """A number with all its digits."""
    return repr(float(value) + 0.0)


def quoted(text: str) -> str:
    """A text in quotes, on one line."""
    return '"' + one_line(text).replace("\\", "\\\\").replace('"', '\\"') + '"'


class Names:
    """Identifiers for things of the model, each used once; letters beyond ASCII are spelled by their code.

    The model's names are these with an ending (``crank_phi``), so none is a word of the language.
    """

    def __init__(self) -> None:
        self._given: dict[tuple[str, str], str] = {}
        self._used: set[str] = set()

    def of(self, kind: str, name: str) -> str:
        """The identifier of a link, point, guide or driver; the same one for the same ``kind`` and ``name``."""
        if (kind, name) not in self._given:
            base = identifier(name)
            found = base if base not in self._used else f"{kind}_{base}"
            count = 2
            while found in self._used:
                found, count = f"{kind}_{base}_{count}", count + 1
            self._given[kind, name] = found
            self._used.add(found)
        return self._given[kind, name]


def identifier(name: str) -> str:
    """A Modelica identifier that looks like the name."""
    plain = "".join(c if c.isascii() else f"u{ord(c):04x}" for c in printable(name))
    plain = re.sub(r"\W", "_", plain)
    return plain if plain[:1].isalpha() else f"n_{plain}"


@singledispatch
def law_text(law: Law, begin: float, end: float) -> str:
    """A law between two times, s, as an expression of ``time``, of operations that tools can differentiate."""
    raise LinkwrightError(
        _("a driver with the law {law!r} cannot be written as Modelica text", code="export.no_law", law=law.key)
    )


@law_text.register
def _constant_speed(law: ConstantSpeed, begin: float, end: float) -> str:
    return f"{number(law.start)} + ({number(law.speed)})*time"


@law_text.register
def _expression_law(law: ExpressionLaw, begin: float, end: float) -> str:
    parameters = {name: number(value) for name, value in law.parameters.items()}
    return formula(law.expression.tree, {**parameters, "t": "time"})


@law_text.register
def _table_law(law: TableLaw, begin: float, end: float) -> str:
    """By cubic pieces between the times of the table, straight ones of a linear one."""
    nodes = np.asarray(law.times)
    if law.interpolation == "periodic":
        period = nodes[-1] - nodes[0]
        first, last = np.floor((begin - nodes[0]) / period), np.ceil((end - nodes[0]) / period)
        turns = np.arange(first, max(last, first + 1))
        nodes = np.unique(np.concatenate([nodes + turn * period for turn in turns]))
    rows = np.stack([nodes, *law.coordinate(nodes)], axis=1)
    texts = []
    for (left, q, qd, qdd), (right, _unused, _unused2, qdd_next) in pairwise(rows):
        third = (qdd_next - qdd) / (6 * (right - left)) if law.interpolation != "linear" else 0.0
        x = f"(time - ({number(left)}))"
        a, b, c, d = (f"({number(each)})" for each in (q, qd, qdd / 2, third))
        texts.append((right, f"({a} + {x}*({b} + {x}*({c} + {x}*{d})))"))
    text = texts[-1][1]
    for right, piece in reversed(texts[:-1]):
        text = f"(if time < {number(right)} then {piece} else {text})"
    return text


def formula(node: Node, names: dict[str, str]) -> str:
    """An expression; ``names``: replacements of its free names."""
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
