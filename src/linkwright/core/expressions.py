"""Expressions in model files: ``l2/2 + 3 mm``, ``30 deg*sin(2*pi*t/(2 s))``.

A small language of its own, read by a tokenizer and a precedence (Pratt) parser: numbers with adjacent
units, names, ``+ - * / ^``, parentheses and the functions of FUNCTIONS. Nothing is ever executed as Python.
Dimensions are checked; values may be floats, NumPy arrays, or anything else that knows arithmetic.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import field
from typing import TYPE_CHECKING, Any

from linkwright import units
from linkwright.core.dataclass import dataclass
from linkwright.core.expression_tree import (
    ARITY,
    Binary,
    Call,
    Negative,
    Node,
    Number,
    Variable,
    dimension_of,
    evaluate,
    functions_of,
    scalar_functions,
)
from linkwright.engine import trace
from linkwright.engine.late_import import numpy as np
from linkwright.engine.recently_made import Recent
from linkwright.errors import QuantityError
from linkwright.registry import nearest, offered
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.engine.numpy_backend import NumpyProgram

MAX_LENGTH, MAX_DEPTH = 1000, 40
CONSTANTS: Mapping[str, float] = {"pi": math.pi}
FUNCTIONS = tuple(ARITY)
#: Words that are written where a direction is asked for, and are angles.
DIRECTIONS = frozenset(
    ("right", "up", "left", "down", "upwards", "downwards", "horizontal", "vertical", "上", "下", "左", "右")
)
_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<power>⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
    r"|(?P<name>(?:(?![⁰¹²³⁴⁵⁶⁷⁸⁹])[^\W\d]|[°%])(?:(?![⁰¹²³⁴⁵⁶⁷⁸⁹])\w|\.(?=[^\W\d]))*)"
    r"|(?P<sign>\*\*|[-+*/^(),·⋅]))"
)
NUMBER_AND_UNIT = re.compile(r"^([+-]?\s*(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(.*)$")
_BINDING = {"+": 10, "-": 10, "*": 20, "/": 20, "^": 40}
_NEGATIVE_BINDING = 30
_SAME = {"**": "^", "·": "*", "⋅": "*"}


class ExpressionError(QuantityError):
    """A text that is no expression; its string shows the text with a caret under the place."""

    def __init__(self, message: str, remedy: str, text: str, column: int, code: str = "expression") -> None:
        self.text = text
        super().__init__(message, remedy, column=column, code=code)

    def say(self, language: str = "en") -> str:
        """The message in a language, the text, and a caret under the place."""
        return f"{super().say(language)}\n  {self.text}\n  {' ' * self.column}^"


@dataclass(frozen=True)
class Expression:
    """An expression that was read; two are equal when their texts are.

    ``names`` are the free names (parameters and variables) that it uses.
    """

    text: str
    tree: Node = field(compare=False, repr=False)
    names: frozenset[str] = field(compare=False, repr=False)

    def over(self, values: Mapping[str, Any]) -> Any:
        """Value in SI over arrays or traced values of the free names; NaN or infinite where there is none.

        Raises ZeroDivisionError where a number in the text is divided by zero.
        """
        return evaluate(self.tree, values, ON_VALUES)

    def evaluate(self, values: Mapping[str, float]) -> float:
        """Value in SI for the given numbers of the free names.

        Raises QuantityError where the result does not exist (a division by zero, the root of a negative number).
        """
        value, problem = math.nan, "model.no_real_value"
        try:
            value = float(evaluate(self.tree, values, scalar_functions()))
        except ZeroDivisionError:
            problem = "model.divides_by_zero"
        except (ValueError, OverflowError, TypeError):
            pass
        if math.isfinite(value):
            return value
        remedy = Sentence("model.change_values")
        raise QuantityError(Sentence(problem, text=self.text), remedy, code="not-finite")

    def derivatives(self, values: Mapping[str, Any], name: str, order: int = 1) -> list[Any]:
        """Exact derivatives of the orders 1 to ``order`` with respect to a free name, over arrays of the free names.

        Of the shape of the values together, where the expression has a value. At the kink of ``abs`` 0, of ``min``
        and ``max`` that of the first argument; ``sign`` and ``step`` are taken as constant.
        """
        shape = np.broadcast_shapes(*map(np.shape, values.values()))
        along = {each: np.broadcast_to(values[each], shape).ravel() for each in self.names}
        program = _derivatives.get(self, (name, order), lambda: self._traced(name, order))
        return list(program.run((), along, length=math.prod(shape)).reshape(order, *shape))

    def along(self, values: Mapping[str, Any], name: str, order: int) -> list[trace.Scalar]:
        """Value and derivatives, see ``derivatives``, over numbers and traced values of the free names, of which that
        of ``name`` is traced; NaN where a number in the text is divided by zero."""
        found: list[trace.Scalar] = [math.nan] * (order + 1)
        with suppress(ZeroDivisionError):
            found[0] = evaluate(self.tree, values, {**ON_VALUES, "abs": lambda x: x * trace.sign(x)})
            for k in range(order):
                found[k + 1] = trace.slope(found[k], {values[name]: 1.0})
        return found

    def switches(self, values: Mapping[str, Any]) -> list[Any]:
        """What changes its sign where the expression goes over to another formula, over arrays of the free names:
        arguments of ``abs``, ``sign`` and ``step``, differences of those of ``min`` and ``max``."""
        found = []

        def seen(name: str) -> Callable[..., Any]:
            def call(*of: Any) -> Any:
                found.append(of[0] - of[1] if len(of) > 1 else of[0])
                return ON_VALUES[name](*of)

            return call

        noted = {name: seen(name) for name in ("abs", "sign", "step", "min", "max")}
        evaluate(self.tree, values, {**ON_VALUES, **noted})
        return found

    def _traced(self, name: str, order: int) -> NumpyProgram:
        """A program of the free names whose outputs are the derivatives."""
        from linkwright.engine.numpy_backend import NumpyProgram
        from linkwright.engine.program import Program

        lines = trace.Trace()
        names = {each: lines.position(each) for each in {*self.names, name}}
        _, *slopes = self.along(names, name, order)
        return NumpyProgram(Program.of(lines, {str(k): each for k, each in enumerate(slopes)}))

    def dimension(self, kinds: Mapping[str, units.Dimension]) -> units.Dimension:
        """Dimension of the result, given those of the free names; raises QuantityError where they do not
        fit."""
        return dimension_of(self.tree, kinds)

    def __str__(self) -> str:
        return self.text


def parse(text: str, variables: Collection[str] = ()) -> Expression:
    """Read an expression in which the names ``variables`` may occur.

    Raises ExpressionError with the column for anything that is not an expression or an unknown name.
    """
    plain = text.replace("−", "-").strip()
    if len(plain) > MAX_LENGTH:
        raise ExpressionError(
            Sentence("model.expression_long", count=len(plain)),
            Sentence("model.expression_most", most=MAX_LENGTH),
            plain[:60] + "…",
            0,
        )
    parser = _Parser(plain, variables)
    tree = parser.whole()
    return Expression(plain, tree, frozenset(parser.used))


def parse_quantity(
    text: str, dimension: str, kinds: Mapping[str, units.Dimension] | None = None
) -> float | Expression:
    """A quantity as a file gives it: a number with its unit (SI float), or an expression of the names in
    ``kinds``.

    An expression without names is evaluated at once. Raises QuantityError.
    """
    value = units.plain_quantity(text, dimension)
    if value is not None:
        return value
    kinds = kinds or {}
    plain = units.tidy(text)
    if is_literal(plain, kinds):
        return units.parse(plain, dimension)
    if re.search(r"\d,\d", plain) and "(" not in plain:
        raise units.decimal_comma(plain)
    if (
        not plain
        or (plain in units.UNITS and plain not in kinds)
        or re.match(r"^[+-]?\.?(inf|infinity|nan)\b", plain, re.IGNORECASE)
    ):
        raise units.not_a_number(plain, dimension)
    expression = parse(plain, kinds)
    require(expression, dimension, kinds)
    return expression if expression.names else expression.evaluate({})


def parse_any(text: str, kinds: Mapping[str, units.Dimension]) -> Expression:
    """A quantity of any dimension, or a bare number, as an expression of the names in ``kinds``."""
    plain = units.tidy(text)
    if is_literal(plain, kinds):
        found = re.match(NUMBER_AND_UNIT, plain)
        unit = found.group(2).strip() if found else ""
        dimension = units.unit(unit)[1] if unit and not re.match(r"[\d,.]", unit) else units.NONE
        names = [name for name, kind in units.DIMENSIONS.items() if kind == dimension]
        if names:
            value = units.parse(plain, names[0])
            return Expression(plain, Number(value, dimension), frozenset())
    elif not plain or (plain in units.UNITS and plain not in kinds):
        raise units.not_a_number(plain, "length")
    return parse(plain, kinds)


def require(expression: Expression, dimension: str, kinds: Mapping[str, units.Dimension]) -> None:
    """Raise QuantityError unless the expression has the dimension.

    With names in it, an angle may stand for its arc (``r*phi`` is a length); a pure angle stays an angle.
    """
    kind, needed = expression.dimension(kinds), units.DIMENSIONS[dimension]
    if kind == needed or (expression.names and kind[:3] == needed[:3] != (0, 0, 0)):
        return
    if kind == units.NONE and isinstance(expression.tree, Number) and expression.tree.value == 0:
        return
    if kind == units.NONE and dimension == "angle":
        raise QuantityError(
            Sentence("units.no_unit", text=expression.text),
            Sentence("model.needs_angle", text=expression.text),
            code="missing-unit",
        )
    units.require(kind, dimension, expression.text)


def is_literal(text: str, names: Collection[str] = ()) -> bool:
    """Whether the text is meant as a number with a unit, not as an expression of ``names``."""
    found = re.match(r"^[+-]?\s*(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![.\w]*\()", text)
    if found is None:
        return False
    rest = text[found.end() :].strip()
    if not rest or re.match(r"[\d,.]", rest):
        return "(" not in rest
    return re.fullmatch(r"[^\W\d_]?[^()+,]*", rest) is not None and _only_units(rest, names)


def _only_units(rest: str, known: Collection[str]) -> bool:
    if re.search(r"[\s]-|-[\s]|[*/]\s*[\d(]", rest) or re.match(r"[-+*/^]", rest):
        return False
    names = re.findall(r"[^\W\d_]\w*", rest)
    if any(name in known for name in names):
        return re.fullmatch(r"[^\s*()]+", rest) is not None and all(name in units.UNITS for name in names)
    return len(names) < 2 or all(name in units.UNITS or units.suggestion(name) is not None for name in names)


class _Parser:
    """Precedence parser over the tokens of one text."""

    def __init__(self, text: str, variables: Collection[str]) -> None:
        self.text, self.variables = text, variables
        self.used: set[str] = set()
        self.depth = 0
        self.tokens = self._tokens()
        self.at = 0

    def _tokens(self) -> list[tuple[str, str, int]]:
        tokens, position = [], 0
        while position < len(self.text):
            found = _TOKEN.match(self.text, position)
            if found is None or found.lastgroup is None:
                column = position + len(self.text[position:]) - len(self.text[position:].lstrip())
                raise self._fault("no_part", column, text=self.text[column])
            token = found.group(found.lastgroup)
            tokens.append((found.lastgroup, _SAME.get(token, token), found.start(found.lastgroup)))
            position = found.end()
        return [*tokens, ("end", "", len(self.text))]

    def _fault(
        self, key: str, column: int, code: str = "expression", remedy: str = "", **values: object
    ) -> ExpressionError:
        """The error ``model.KEY`` of the catalogue with its remedy, ``model.KEY_do`` where no other is given."""
        told = remedy or Sentence(f"model.{key}_do", **values)
        return ExpressionError(Sentence(f"model.{key}", **values), told, self.text, column, code)

    def whole(self) -> Node:
        tree = self._binary(0)
        kind, token, column = self.tokens[self.at]
        if kind != "end":
            factor = kind in ("name", "number") or token == "("
            remedy = Sentence("model.write_factor_sign" if factor else "model.remove_it")
            if units.SENSE.fullmatch(token):
                remedy = Sentence("units.sense")
            raise self._fault("unexpected", column, remedy=remedy, token=token)
        return tree

    def _binary(self, binding: int) -> Node:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self._fault("too_deep", 0)
        left = self._powers(self._prefix())
        while True:
            kind, token, column = self.tokens[self.at]
            strength = _BINDING.get(token, 0) if kind == "sign" else 0
            if strength <= binding:
                self.depth -= 1
                return left
            self.at += 1
            right = self._binary(strength - 1 if token == "^" else strength)
            left = Binary(token, left, right, column)

    def _powers(self, base: Node) -> Node:
        kind, token, column = self.tokens[self.at]
        if kind != "power":
            return base
        self.at += 1
        return Binary("^", base, Number(float(units.exponent(token)), units.NONE, column), column)

    def _prefix(self) -> Node:
        kind, token, column = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            return self._number(token, column)
        if kind == "name":
            return self._name(token, column)
        if token in ("-", "+"):
            inner = self._binary(_NEGATIVE_BINDING)
            return Negative(inner, column) if token == "-" else inner
        if token == "(":
            inner = self._binary(0)
            self._close(column)
            return inner
        what, needed = "ends_early" if kind == "end" else "unexpected", Sentence("model.operand_needed")
        raise self._fault(what, column, remedy=needed, token=token)

    def _close(self, opened: int) -> None:
        if self.tokens[self.at][1] != ")":
            raise self._fault("open_parenthesis", opened)
        self.at += 1

    def _number(self, token: str, column: int) -> Node:
        value = float(token)
        if not math.isfinite(value):
            raise ExpressionError(
                Sentence("units.not_finite", text=token), "", self.text, column, "not-finite"
            )
        kind, name, place = self.tokens[self.at]
        if kind != "name" or self.tokens[self.at + 1][1] == "(":
            return Number(value, units.NONE, column)
        turning = [entry[1] for entry in self.tokens[self.at : self.at + 3]] in (
            ["r", "/", "min"],
            ["r", "/", "s"],
        )
        if name not in units.UNITS and not turning:
            if name in self.variables:
                raise self._fault("no_sign", place, token=token, name=name)
            error = units.unknown_unit(name)
            raise ExpressionError(error.message, error.remedy, self.text, place, "unknown-unit")
        factor, dimension = self._unit("rev" if turning else name)
        while self._joined_unit():
            sign = -1 if self.tokens[self.at][1] == "/" else 1
            self.at += 1
            size, extra = self._unit(self.tokens[self.at][1])
            factor, dimension = factor * size**sign, units.times(dimension, extra, sign)
        return Number(value * factor, dimension, column)

    def _unit(self, name: str) -> tuple[float, units.Dimension]:
        """The unit at the present token with its power, both consumed."""
        self.at += 1
        factor, dimension = units.UNITS[name]
        kind, power, _ = self.tokens[self.at]
        exponent = 1
        if kind == "power":
            self.at += 1
            exponent = units.exponent(power)
        elif (
            power == "^" and self.tokens[self.at + 1][0] == "number" and self.tokens[self.at + 1][1].isdigit()
        ):
            exponent = units.exponent(self.tokens[self.at + 1][1])
            self.at += 2
        return factor**exponent, units.times(units.NONE, dimension, exponent)

    def _joined_unit(self) -> bool:
        """Whether a further unit follows, joined by ``/`` or ``·`` without spaces (``N/m``).

        Joined by ``*`` a name may be a parameter; where it is a unit as well, that is an error.
        """
        _, sign, column = self.tokens[self.at]
        if (
            sign not in ("*", "/")
            or self.tokens[self.at + 1][0] != "name"
            or self.tokens[self.at + 2][1] == "("
        ):
            return False
        _, name, place = self.tokens[self.at + 1]
        if name not in units.UNITS:
            return False
        if self.text[column] == "*":
            if name in self.variables and name != "t":
                raise self._fault("unit_and_parameter", place, "ambiguous", name=name)
            return False
        tight = place == column + 1 and self.text[column - 1] != " "
        return tight or name not in self.variables

    def _name(self, name: str, column: int) -> Node:
        if self.tokens[self.at][1] == "(" and name not in self.variables:
            return self._call(name, column)
        if name in self.variables:
            self.used.add(name)
            return Variable(name, column)
        if name in CONSTANTS:
            return Number(CONSTANTS[name], units.NONE, column)
        if name in units.UNITS:
            factor, dimension = units.UNITS[name]
            return Number(factor, dimension, column)
        offer = nearest(name, [*self.variables, *CONSTANTS])
        known = tuple(sorted(self.variables, key=lambda each: (each.count("."), each))[:12])
        remedy = Sentence("model.define_it", known=known) if known else Sentence("model.define_none")
        if offer:
            remedy = Sentence("names.did_you_mean", offer=offer)
        if name.casefold() in DIRECTIONS:
            remedy = Sentence("model.direction_word")
        raise self._fault("unknown_name", column, "unknown-name", remedy, name=name)

    def _call(self, name: str, column: int) -> Node:
        if name not in ARITY:
            raise self._fault("unknown_function", column, "unknown-name", offered(name, ARITY), name=name)
        self.at += 1
        arguments = [self._binary(0)]
        while self.tokens[self.at][1] == ",":
            self.at += 1
            arguments.append(self._binary(0))
        self._close(column)
        if len(arguments) != ARITY[name]:
            needed, given = ARITY[name], len(arguments)
            raise self._fault("argument_count", column, name=name, needed=needed, given=given)
        return Call(name, tuple(arguments), column)


#: The functions of the language on arrays and traced values.
ON_VALUES = functions_of(
    trace,
    {
        "atan2": trace.angle,
        "abs": trace.absolute,
        "min": lambda a, b: trace.select(a <= b, a, trace.select(b < a, b, a + b)),
        "max": lambda a, b: trace.select(a >= b, a, trace.select(b > a, b, a + b)),
        "step": lambda x: trace.select(x >= 0.0, 1.0, trace.select(x < 0.0, 0.0, trace.stop(x))),
        "pow": trace.power,
    },
)
#: Traced derivatives by expression, name and order.
_derivatives: Recent[Expression, NumpyProgram] = Recent(256)
