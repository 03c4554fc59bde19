"""Reading of expressions: a tokenizer and a precedence (Pratt) parser, from a text to its tree."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from typing import Literal

from linkwright import units
from linkwright.core.expression_tree import ARITY, Binary, Call, Negative, Node, Number, Variable
from linkwright.errors import QuantityError
from linkwright.registry import nearest, offered
from linkwright.words import Message, _

MAX_DEPTH = 40
CONSTANTS: Mapping[str, float] = {"pi": math.pi}
#: What a name is that is a unit and a variable.
Preferred = Literal["units", "variables behind units", "variables"]
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
_BINDING = {"+": 10, "-": 10, "*": 20, "/": 20, "^": 40}
_NEGATIVE_BINDING = 30
_SAME = {"**": "^", "·": "*", "⋅": "*"}


class ExpressionError(QuantityError):
    """A text that is no expression; its string shows the text with a caret under the place."""

    def __init__(self, message: str, remedy: str, text: str, column: int, code: str = "expression") -> None:
        self.text = text
        super().__init__(message, remedy, column=column, code=code)

    def translate(self, language: str = "en") -> str:
        """The message in a language, the text, and a caret under the place."""
        return f"{super().translate(language)}\n  {self.text}\n  {' ' * self.column}^"


class Parser:
    """Precedence parser over the tokens of one text."""

    def __init__(self, text: str, variables: Collection[str], prefer: Preferred = "units") -> None:
        self.text, self.variables, self.prefer = text, variables, prefer
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
                raise self._fault(
                    _('"{text}" is not part of an expression'),
                    column,
                    _("use numbers with units, names, + - * / ^ and parentheses"),
                    text=self.text[column],
                )
            token = found.group(found.lastgroup)
            tokens.append((found.lastgroup, _SAME.get(token, token), found.start(found.lastgroup)))
            position = found.end()
        return [*tokens, ("end", "", len(self.text))]

    def _fault(
        self, message: Message, column: int, remedy: Message, code: str = "expression", **values: object
    ) -> ExpressionError:
        """The error with the values of its texts at a column."""
        return ExpressionError(message.format(**values), remedy.format(**values), self.text, column, code)

    def parse(self) -> Node:
        tree = self._binary(0)
        kind, token, column = self.tokens[self.at]
        if kind != "end":
            factor = kind in ("name", "number") or token == "("
            remedy = _("write * between factors") if factor else _("remove it")
            if units.SENSE.fullmatch(token):
                remedy = _(
                    "the sign says the sense: positive is counter-clockwise, negative (-120 rpm) clockwise",
                    code="units.sense",
                )
            raise self._fault(_('"{token}" is not expected here'), column, remedy, token=token)
        return tree

    def _binary(self, binding: int) -> Node:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self._fault(_("the expression is nested too deep"), 0, _("split it with named parameters"))
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
        if token in ("-", "+") and self.tokens[self.at][1] not in ("-", "+"):
            inner = self._binary(_NEGATIVE_BINDING)
            return Negative(inner, column) if token == "-" else inner
        if token == "(":
            inner = self._binary(0)
            self._close(column)
            return self._in_units(inner)
        if token in ("-", "+"):
            _unused, token, column = self.tokens[self.at]
        what = _("the expression ends too early") if kind == "end" else _('"{token}" is not expected here')
        raise self._fault(what, column, _("a number, a name or a parenthesis is needed"), token=token)

    def _close(self, opened: int) -> None:
        if self.tokens[self.at][1] != ")":
            raise self._fault(_("a parenthesis is not closed"), opened, _('add ")"'))
        self.at += 1

    def _number(self, token: str, column: int) -> Node:
        value = float(token)
        if not math.isfinite(value):
            raise ExpressionError(
                _('"{text}" is not a finite number', text=token), "", self.text, column, "not-finite"
            )
        kind, name, place = self.tokens[self.at]
        if kind != "name" or self.tokens[self.at + 1][1] == "(":
            return Number(value, units.NONE, column)
        if self.prefer == "variables" and name in self.variables:
            return Binary("*", Number(value, units.NONE, column), self._prefix(), place)
        turning = [entry[1] for entry in self.tokens[self.at : self.at + 3]] in (["r", "/", "min"], ["r", "/", "s"])
        unit = name in units.UNITS or (name in units.BEHIND_NUMBERS and name not in self.variables)
        if not unit and not turning:
            if name in self.variables:
                raise self._fault(
                    _('a factor "{token} {name}" without a sign'),
                    place,
                    _('write "{token}*{name}"'),
                    token=token,
                    name=name,
                )
            error = units.unknown_unit(name)
            raise ExpressionError(error.message, error.remedy, self.text, place, "unknown-unit")
        factor, dimension = self._units("rev" if turning else name)
        return Number(value * factor, dimension, column)

    def _in_units(self, node: Node) -> Node:
        """The node times the unit that follows it, as in ``sqrt(2) m`` and ``(1 + 2) mm``."""
        kind, name, place = self.tokens[self.at]
        behind = kind == "name" and self.tokens[self.at + 1][1] != "("
        if not behind or name not in units.BEHIND_NUMBERS or name in self.variables:
            return node
        return Binary("*", node, Number(*self._units(name), place), place)

    def _units(self, name: str) -> tuple[float, units.Dimension]:
        """The product of units that begins at the present token, consumed."""
        factor, dimension = self._unit(name)
        while self._joined_unit():
            sign = -1 if self.tokens[self.at][1] == "/" else 1
            self.at += 1
            size, extra = self._unit(self.tokens[self.at][1])
            factor, dimension = factor * size**sign, units.times(dimension, extra, sign)
        return factor, dimension

    def _unit(self, name: str) -> tuple[float, units.Dimension]:
        """The unit at the present token with its power, both consumed."""
        self.at += 1
        factor, dimension = units.BEHIND_NUMBERS[name]
        kind, power, _unused = self.tokens[self.at]
        exponent = 1
        if kind == "power":
            self.at += 1
            exponent = units.exponent(power)
        elif power == "^" and self.tokens[self.at + 1][0] == "number" and self.tokens[self.at + 1][1].isdigit():
            exponent = units.exponent(self.tokens[self.at + 1][1])
            self.at += 2
        return factor**exponent, units.times(units.NONE, dimension, exponent)

    def _joined_unit(self) -> bool:
        """Whether a further unit follows, joined by ``/`` or ``·`` without spaces (``N/m``).

        Joined by ``*`` a name may be a parameter; where it is a unit as well, that is an error.
        """
        _unused, sign, column = self.tokens[self.at]
        if sign not in ("*", "/") or self.tokens[self.at + 1][0] != "name" or self.tokens[self.at + 2][1] == "(":
            return False
        _unused2, name, place = self.tokens[self.at + 1]
        if name not in units.BEHIND_NUMBERS or (self.prefer != "units" and name in self.variables):
            return False
        if self.text[column] == "*":
            if name in self.variables and name != "t":
                raise self._fault(
                    _('"{name}" is a unit and a parameter'),
                    place,
                    _('write "(1 {name})" for the unit, "({name})" for the parameter'),
                    "ambiguous",
                    name=name,
                )
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
            return self._in_units(Number(CONSTANTS[name], units.NONE, column))
        if name in units.UNITS:
            factor, dimension = units.UNITS[name]
            return Number(factor, dimension, column)
        offer = nearest(name, [*self.variables, *CONSTANTS])
        known = tuple(sorted(self.variables, key=lambda each: (each.count("."), each))[:12])
        remedy = (
            _("define it under parameters (known: {known})", known=known)
            if known
            else _("define it under parameters (none is defined)")
        )
        if offer:
            remedy = _('did you mean "{offer}"?', offer=offer)
        if name.casefold() in DIRECTIONS:
            remedy = _(
                "a direction is an angle, counter-clockwise from x: right 0 deg, up 90 deg, left 180 "
                "deg, down -90 deg",
                code="model.direction_word",
            )
        raise self._fault(_('unknown name "{name}"'), column, remedy, "unknown-name", name=name)

    def _call(self, name: str, column: int) -> Node:
        if name not in ARITY:
            raise self._fault(_('unknown function "{name}"'), column, offered(name, ARITY), "unknown-name", name=name)
        self.at += 1
        arguments = [self._binary(0)]
        while self.tokens[self.at][1] == ",":
            self.at += 1
            arguments.append(self._binary(0))
        self._close(column)
        if len(arguments) != ARITY[name]:
            needed, count = ARITY[name], len(arguments)
            raise self._fault(
                _("{name} takes {needed} argument(s), found {count}"),
                column,
                _("separate arguments by commas, decimals by points"),
                name=name,
                needed=needed,
                count=count,
            )
        return self._in_units(Call(name, tuple(arguments), column))
