"""Reads the equations of a worked solution as a reader with a calculator does, and beside the solver."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from tests.every import every

import linkwright as lw

_BINARY: dict[type, Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_FUNCTIONS: dict[str, Callable[..., float]] = {
    "sqrt": math.sqrt,
    "cos": lambda x: math.cos(math.radians(x)),
    "sin": lambda x: math.sin(math.radians(x)),
    "tan": lambda x: math.tan(math.radians(x)),
    "abs": abs,
    "atan2": lambda y, x: math.degrees(math.atan2(y, x)),
    "arccos": lambda x: math.degrees(math.acos(x)),
    "arcsin": lambda x: math.degrees(math.asin(x)),
    "arctan": lambda x: math.degrees(math.atan(x)),
}


def reckon(numbers: str) -> float:
    """What a line of numbers amounts to; angles in degrees."""
    plain = re.sub(r"\|([^|]*)\|", r"abs(\1)", numbers)
    plain = plain.replace("·", "*").replace("²", "**2").replace("√", "sqrt").replace("°", "")
    return _value(ast.parse(plain, mode="eval").body)


def _value(node: Any) -> float:
    if isinstance(node, ast.Constant):
        return float(node.value)
    if isinstance(node, ast.UnaryOp):
        assert isinstance(node.op, ast.USub)
        return -_value(node.operand)
    if isinstance(node, ast.BinOp):
        return _BINARY[type(node.op)](_value(node.left), _value(node.right))
    assert isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    return _FUNCTIONS[node.func.id](*(_value(each) for each in node.args))


def last_digit(result: str) -> float:
    """What one unit of a printed number's last digit is worth."""
    mantissa, _, exponent = result.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def is_printed_zero(result: str) -> bool:
    """Whether the page says that nothing is left."""
    return re.fullmatch(r"-?0(\.0*)?", result) is not None


def numeric_matrices(latex: str) -> list[np.ndarray]:
    """The matrices of a LaTeX equation all of whose entries are numbers."""
    found = []
    for body in re.findall(r"\\begin\{bmatrix\} (.*?) \\end\{bmatrix\}", latex):
        rows = [row.split(" & ") for row in body.split(r" \\ ")]
        if not any("_" in each or "\\" in each for row in rows for each in row):
            found.append(np.array(rows, float))
    return found


class Line(Protocol):
    """An equation with its numbers."""

    @property
    def symbol(self) -> str: ...
    @property
    def numbers(self) -> str: ...
    @property
    def result(self) -> str: ...


class Page(Protocol):
    """A worked solution, of a machine or of a synthesis."""

    @property
    def equations(self) -> Sequence[Line]: ...


def reckon_lines(page: Page) -> list[str]:
    """Lines that do not come out as printed, of which there are some."""
    wrong = []
    for line in every(line for line in page.equations if line.numbers):
        found, told = reckon(line.numbers), float(line.result)
        slip = 1e-5 if is_printed_zero(line.result) else 1.001 * last_digit(line.result)
        if not abs(found - told) <= slip:
            wrong.append(f"{line.symbol} = {line.numbers} gives {found}, printed {line.result}")
    return wrong


def against_solver(page: lw.Worked, forces: lw.Forces) -> tuple[list[str], set[str]]:
    """Results that are not the solver's numbers, and the columns that were printed."""
    columns, wrong, seen = forces.columns(), [], set()
    for line in every(line for line in page.equations if line.column):
        seen.add(line.column)
        value = float(columns[line.column][page.position])
        told = float(line.result)
        if line.unit == "°":
            value = math.degrees(value)
            told = value + (told - value + 180.0) % 360.0 - 180.0
        slip = 1e-6 if is_printed_zero(line.result) else 0.51 * last_digit(line.result)
        if not abs(told - value) <= slip:
            wrong.append(f"{line.column}: printed {line.result}, solved {value}")
    return wrong, seen
