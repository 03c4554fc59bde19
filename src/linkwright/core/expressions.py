"""Expressions in model files: ``l2/2 + 3 mm``, ``30 deg*sin(2*pi*t/(2 s))``.

A small language of its own: numbers with adjacent
units, names, ``+ - * / ^``, parentheses and the functions of ARITY. Nothing is ever executed as Python.
Dimensions are checked; values may be floats, NumPy arrays, or anything else that knows arithmetic.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from linkwright import units
from linkwright.core.expression_parser import CONSTANTS, ExpressionError, Parser, Preferred
from linkwright.core.expression_tree import (
    ARITY,
    Binary,
    Node,
    Number,
    derived,
    dimension_of,
    evaluate,
    functions_of,
    scalar_functions,
)
from linkwright.errors import QuantityError
from linkwright.formula import trace
from linkwright.formula.late_import import numpy as np
from linkwright.formula.recently_made import Recent
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.formula.numpy_backend import NumpyProgram

MAX_LENGTH = 1000
#: Names of the language itself.
OWN_NAMES = frozenset((*CONSTANTS, *ARITY))
NUMBER_AND_UNIT = re.compile(r"^([+-]?\s*(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(.*)$")
#: Units that stand behind others so often that they are meant wherever they fit: ``N/m``, ``m/s``.
_BASE = ("m", "s")
#: Factors with a unit behind all of them; a quotient with one behind it; the last number of a text with its unit.
_FACTORS = re.compile(r"(?P<factors>.*(?:[\d.)]|\b[^\W\d]\w*(?= )))\s*(?P<unit>(?:[^\W\d_]|[°%])[^()+,]*)")
_QUOTIENT = re.compile(r"((?:\d+\.?\d*|\.\d+|\bpi)/(?:\d+\.?\d*|\.\d+)) ?([^\W\d]+|[°%])")
_TIGHT = re.compile(r"((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*(?:[^\W\d_]|[°%])[^()+,]*)$")


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
        """Value in SI for numbers of the free names.

        Raises QuantityError where the result does not exist (a division by zero, the root of a negative number).
        """
        value, problem = math.nan, _('"{text}" has no finite real value')
        try:
            value = float(evaluate(self.tree, values, scalar_functions()))
        except ZeroDivisionError:
            problem = _('"{text}" divides by zero')
        except (ValueError, OverflowError, TypeError):
            pass
        if math.isfinite(value):
            return value
        remedy = _("change the values")
        raise QuantityError(problem.format(text=self.text), remedy, code="not-finite")

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
        from linkwright.formula.differentiation import slope

        found: list[trace.Scalar] = [math.nan] * (order + 1)
        with suppress(ZeroDivisionError):
            found[0] = evaluate(self.tree, values, {**ON_VALUES, "abs": lambda x: x * trace.sign(x)})
            for k in range(order):
                found[k + 1] = slope(found[k], {values[name]: 1.0})
        return found

    def switches(self, values: Mapping[str, Any]) -> list[Any]:
        """What changes its sign where the expression goes over to another formula, over arrays of the free names:
        arguments of ``abs``, ``sign`` and ``step``, differences of those of ``min`` and ``max``."""
        found = []

        def noted_function(name: str) -> Callable[..., Any]:
            def call(*of: Any) -> Any:
                found.append(of[0] - of[1] if len(of) > 1 else of[0])
                return ON_VALUES[name](*of)

            return call

        noted = {name: noted_function(name) for name in ("abs", "sign", "step", "min", "max")}
        evaluate(self.tree, values, {**ON_VALUES, **noted})
        return found

    def _traced(self, name: str, order: int) -> NumpyProgram:
        """A program of the free names whose outputs are the derivatives."""
        from linkwright.formula.numpy_backend import NumpyProgram
        from linkwright.formula.program import Program

        lines = trace.Trace()
        names = {each: lines.position(each) for each in {*self.names, name}}
        _unused, *slopes = self.along(names, name, order)
        return NumpyProgram(Program.of(lines, {str(k): each for k, each in enumerate(slopes)}))

    def dimension(self, kinds: Mapping[str, units.Dimension]) -> units.Dimension:
        """Dimension of the result from those of the free names; raises QuantityError where they do not
        fit."""
        return dimension_of(self.tree, kinds)

    def __str__(self) -> str:
        return self.text


def parse(text: str, variables: Collection[str] = (), *, prefer: Preferred = "units") -> Expression:
    """Read an expression in which the names ``variables`` may occur.

    A name that is a unit and a variable is the unit behind a number, and behind another unit unless ``prefer`` says
    otherwise: then it is the variable behind units, or everywhere.
    Raises ExpressionError with the column for anything that is not an expression or an unknown name.
    """
    plain = text.replace("−", "-").strip()
    if len(plain) > MAX_LENGTH:
        raise ExpressionError(
            _("the expression has {count} characters", count=len(plain)),
            _("at most {most}; split it with named parameters", most=MAX_LENGTH),
            plain[:60] + "…",
            0,
        )
    parser = Parser(plain, variables, prefer)
    tree = parser.parse()
    return Expression(plain, tree, frozenset(parser.used))


def parse_quantity(
    text: str, dimension: str, kinds: Mapping[str, units.Dimension] | None = None
) -> float | Expression:
    """A quantity as a file gives it: a number with its unit (SI float), or an expression of the names in
    ``kinds``. Raises QuantityError."""
    value = units.plain_quantity(text, dimension) if not kinds or kinds.keys().isdisjoint(units.UNITS) else None
    return parse_as(text, dimension, kinds or {}) if value is None else value


def amount(text: str, dimension: str) -> float:
    """SI value of a quantity without names; raises QuantityError."""
    try:
        return parse_as(text, dimension, {}).evaluate({})
    except ExpressionError:
        return units.parse(text, dimension)  # says what a quantity is


def parse_as(text: str, dimension: str, kinds: Mapping[str, units.Dimension]) -> Expression:
    """A number with its unit, or an expression of the names in ``kinds``, of a dimension that is known.

    ``pi/6 rad`` and ``sqrt(2) m`` are numbers with a unit behind them. Raises QuantityError, also where a name is a
    unit and a parameter and the text may mean either.
    """
    plain = units.tidy(text)
    try:
        found = _with_units(plain, dimension, kinds)
    except QuantityError as error:
        quantity = _number_and_unit(plain, kinds)
        if quantity is not None and quantity.dimension(kinds) == units.DIMENSIONS[dimension]:
            return quantity
        if error.code != "ambiguous" and (name := _meant_parameter(plain, dimension, kinds)):
            raise _ambiguous(name) from None
        if error.code == "wrong-dimension" and (right := _quotient(plain, dimension, kinds)):
            raise QuantityError(error.message, _('write "{right}"', right=right), code=error.code) from None
        raise
    if name := _meant_parameter(plain, dimension, kinds, found):
        raise _ambiguous(name)
    return found


def _with_units(plain: str, dimension: str, kinds: Mapping[str, units.Dimension]) -> Expression:
    """The quantity of a text in which a unit is a unit wherever one can stand."""
    if is_literal(plain, kinds):
        value = units.parse(plain, dimension)
        return Expression(plain, Number(value, units.DIMENSIONS[dimension]), frozenset())
    if re.search(r"\d,\d", plain) and "(" not in plain:
        raise units.decimal_comma(plain)
    if (
        not plain
        or (plain in units.UNITS and plain not in kinds)
        or re.match(r"^[+-]?\.?(inf|infinity|nan)\b", plain, re.IGNORECASE)
    ):
        raise units.not_a_number(plain, dimension)
    return fitted(parse(plain, kinds), dimension, kinds)


def _number_and_unit(plain: str, kinds: Mapping[str, units.Dimension]) -> Expression | None:
    """A product or quotient without units with one unit behind all of it: ``pi/6 rad``, ``(1 + sqrt(5))/2 m``; None
    where the text is none."""
    found = _FACTORS.fullmatch(plain)
    if found is None or not kinds.keys().isdisjoint(re.findall(r"[^\W\d]+", found["unit"])):
        return None
    inner, inside = units.NUMBER.sub("0", found["factors"]).lstrip("+-"), ""
    while inner != inside:
        inner, inside = re.sub(r"\([^()]*\)", "0", inner), inner
    try:
        number, (factor, kind) = parse(found["factors"], kinds), units.unit(found["unit"])
        if re.search(r"[+-]", inner) or number.dimension(kinds) != units.NONE:
            return None
    except QuantityError:
        return None
    text = f"({number.text})*{found['unit']}"
    return Expression(text, Binary("*", number.tree, Number(factor, kind)), number.names)


def _meant_parameter(
    plain: str, dimension: str, kinds: Mapping[str, units.Dimension], found: Expression | None = None
) -> str:
    """The name of a parameter that the text has as a unit in ``found``, where it is the quantity that is needed with
    the parameter as well; empty where there is none."""
    words = re.findall(r"[^\W\d]\w*", plain)
    names = [each for each in words if each in units.UNITS and each in kinds and not (found and each in _BASE)]
    if names:
        with suppress(QuantityError):
            prefer: Preferred = "variables" if found is None else "variables behind units"
            other = fitted(parse(plain, kinds, prefer=prefer), dimension, kinds)
            return next((each for each in names if each in other.names - (found.names if found else set())), "")
    return ""


def _ambiguous(name: str) -> QuantityError:
    return QuantityError(
        _('"{name}" is a unit and a parameter', name=name),
        _('write "(1 {name})" for the unit, "({name})" for the parameter', name=name),
        code="ambiguous",
    )


def _quotient(plain: str, dimension: str, kinds: Mapping[str, units.Dimension]) -> str:
    """The text with its quotients of numbers in parentheses, a unit behind them, where that is what is needed."""
    right = _QUOTIENT.sub(r"(\1)*\2", plain)
    if right != plain:
        with suppress(QuantityError):
            fitted(parse(right, kinds), dimension, kinds)
            return right
    return ""


def parse_any(text: str, kinds: Mapping[str, units.Dimension]) -> Expression:
    """A quantity of any dimension, or a bare number, as an expression of the names in ``kinds``.

    ``1/2 m`` may be half a metre or one over two metres, and is refused.
    """
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
    quantity = _number_and_unit(plain, kinds)
    if quantity is None:
        return parse(plain, kinds)
    try:
        tight = parse(plain, kinds)
        if tight.dimension(kinds) == quantity.dimension(kinds):
            return tight
    except QuantityError:
        return quantity
    remedy = _('write "{quantity}" or "{tight}"', quantity=quantity.text, tight=_TIGHT.sub(r"(\1)", plain))
    raise QuantityError(_('"{text}" can be read in two ways', text=plain), remedy, code="ambiguous")


def fitted(expression: Expression, dimension: str, kinds: Mapping[str, units.Dimension]) -> Expression:
    """The expression as a quantity of a dimension; raises QuantityError where it is none.

    A radian is no unit in a product of several quantities: ``r*phi`` is a length, ``P/omega`` a torque. One
    quantity or a multiple of it must have the very dimension, and an angle stays an angle. A frequency counts
    cycles: an angular velocity is divided by 2π, and where cycles or radians may be meant, as in ``sqrt(k/m)``, the
    text has to say which.
    """
    kind, needed = expression.dimension(kinds), units.DIMENSIONS[dimension]
    if dimension == "frequency" and kind == units.DIMENSIONS["angular_velocity"]:
        return Expression(expression.text, Binary("/", expression.tree, Number(2 * math.pi)), expression.names)
    near = units.nearly(kind, needed)
    product = near and derived(expression.tree, kinds)
    if (product and dimension != "frequency") or (kind == needed and not product):
        return expression
    if near and kind[:2] == (0, 0):
        raise QuantityError(
            _('"{text}" counts turns, cycles or radians: it has to say which', text=expression.text),
            _(
                'write "({text})*rev" if it counts turns or cycles, "({text})*rad" if it counts radians',
                text=expression.text,
            ),
            code="ambiguous",
        )
    if kind == units.NONE and isinstance(expression.tree, Number) and expression.tree.value == 0:
        return expression
    if kind == units.NONE and dimension == "angle":
        raise QuantityError(
            _('"{text}" has no unit', text=expression.text),
            _('an angle is needed: "({text})*rad"', text=expression.text),
            code="missing-unit",
        )
    units.require(kind, dimension, expression.text)
    return expression


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
