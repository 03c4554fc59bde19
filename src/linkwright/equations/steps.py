"""A worked solution: its steps with sentences, equations, relations, matrices and tables, and its plain text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from linkwright.core.outputs import Output
from linkwright.core.quantity import number, shown_unit
from linkwright.core.quantity import shown as quantity_text
from linkwright.equations.latex import latex
from linkwright.equations.notation import Atom, Row, quantity, upright
from linkwright.equations.reading import filled, names, normal, read, read_name, sides
from linkwright.equations.reading import plain as unmarked
from linkwright.equations.terms import ZERO_TOLERANCE, Pair, Term, symbol
from linkwright.equations.typeset import digits_needed, error_of, last_place, plain, printed, put_in, typeset
from linkwright.errors import SelfCheckError
from linkwright.words import _
from linkwright.words.characters import aligned, cells, folded

#: A result smaller than this (SI) whose formula gives nothing at all is zero but for rounding.
FADED = 1e-9
#: Errors of a formula's symbols, in those that its digits are counted by, up to which it gives the solver's number.
OFF = 1e3


@dataclass(frozen=True)
class Note:
    """A sentence."""

    text: str

    def data(self) -> dict[str, object]:
        """Plain data."""
        return {"note": self.text}


@dataclass(frozen=True)
class Relation:
    """An equation to be solved further below: left and right side in symbols."""

    left: Term
    right: Term

    @property
    def text(self) -> str:
        """In plain symbols."""
        return f"{plain(self.left)} = {plain(self.right)}"

    @property
    def sides(self) -> tuple[Row, ...]:
        """Both sides as they are printed."""
        return typeset(self.left), typeset(self.right)

    def data(self) -> dict[str, object]:
        """Plain data."""
        return {"relation": self.text, "latex": " = ".join(map(latex, self.sides))}


@dataclass(frozen=True)
class Equation:
    """One result: symbol, formula, the formula with its numbers put in, and the result with its unit.

    ``value`` is the result to full precision, SI, angles in degrees; ``output``: which of the machine's outputs it
    is, if it is one; ``formula`` is empty for given data; ``filled``: the numbers, marked as formulas on a line are;
    ``terms``: result and formula as they can be evaluated again, with so many ``digits`` of the substituted numbers.
    """

    symbol: str
    formula: str
    filled: str
    result: str
    unit: str
    value: float
    output: Output | None = None
    terms: tuple[Term, Term] | None = field(default=None, repr=False, compare=False)
    digits: int = field(default=0, repr=False, compare=False)

    @property
    def numbers(self) -> str:
        """The formula with its numbers put in."""
        return unmarked(self.filled)

    @property
    def column(self) -> str:
        """The name of its column in the table of all results; empty for what is no output."""
        return self.output.heading if self.output else ""

    @property
    def printed_symbol(self) -> Row:
        """The symbol as it is printed."""
        return typeset(self.terms[0]) if self.terms else read_name(self.symbol)

    @property
    def printed_formula(self) -> Row:
        """The formula as it is printed; empty for given data."""
        return self._printed(self.formula, None)

    @property
    def printed_numbers(self) -> Row:
        """The formula with its numbers as it is printed."""
        return self._printed(self.filled, self.digits)

    def _printed(self, text: str, digits: int | None) -> Row:
        if not text:
            return Row()
        return typeset(self.terms[1], digits) if self.terms else read(text)

    @property
    def sides(self) -> tuple[Row, ...]:
        """Symbol, formula, numbers and result as they are printed, those that there are."""
        value = Row(quantity(self.result, self.unit))
        found = (self.printed_symbol, self.printed_formula, self.printed_numbers, value)
        return tuple(side for side in found if side.items)

    @property
    def latex_symbol(self) -> str:
        """The symbol as LaTeX."""
        return latex(self.printed_symbol)

    @property
    def latex_formula(self) -> str:
        """The formula as LaTeX."""
        return latex(self.printed_formula)

    @property
    def latex_numbers(self) -> str:
        """The formula with its numbers as LaTeX."""
        return latex(self.printed_numbers)

    def data(self) -> dict[str, object]:
        """Plain data."""
        names = ("symbol", "formula", "numbers")
        return {
            **{name: getattr(self, name) for name in (*names, "result", "unit", "value", "column")},
            "latex": {name: getattr(self, f"latex_{name}") for name in names},
        }


@dataclass(frozen=True)
class Written:
    """A formula without a result of its own: plain text, of a matrix in several lines, and its sides as printed.

    ``cells``: rows of a table, headings first, which reports print in place of a system too wide for a formula.
    """

    text: str
    sides: tuple[Row, ...]
    cells: tuple[tuple[str, ...], ...] = ()

    def data(self) -> dict[str, object]:
        """Plain data."""
        return {"relation": self.text, "latex": " = ".join(map(latex, self.sides))}


@dataclass(frozen=True)
class Tabulated:
    """A table: ``head`` and ``rows`` as plain text, ``align`` with ``<`` or ``>`` per column."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    align: str

    @property
    def text(self) -> str:
        """In plain text, its title above."""
        return "\n".join([self.title, *aligned([self.head, *self.rows], self.align)])

    def data(self) -> dict[str, object]:
        """Plain data."""
        return {"table": self.title, "head": list(self.head), "rows": [list(row) for row in self.rows]}


#: A value of a formula's name: SI with its dimension, or a plain number.
Value = float | tuple[float, str]
Item = Note | Relation | Equation | Written | Tabulated


@dataclass
class Step:
    """One step of the solution; ``group`` is the name of the Assur group it belongs to, or empty; ``known``: values
    of names in formulas on a line."""

    number: str
    title: str
    group: str = ""
    items: list[Item] = field(default_factory=list)
    known: dict[str, Value] = field(default_factory=dict, repr=False, compare=False)

    @property
    def equations(self) -> list[Equation]:
        """Its results."""
        return [item for item in self.items if isinstance(item, Equation)]

    def note(self, text: str) -> None:
        """Adds a sentence."""
        self.items.append(Note(text))

    def law(self, text: str, unit: str = "") -> None:
        """Adds formulas as they are written on a line, several separated by ``;``; ``unit`` of numbers."""
        for each in text.split("; "):
            *first, last = sides(each)
            last = Row((*last.items, Atom("space", "quad"), upright(unit))) if unit else last
            self.items.append(Written(f"{unmarked(each.strip())} {unit}".rstrip(), (*first, last)))

    def put(
        self,
        symbol: str,
        formula: str,
        value: float,
        dimension: str = "",
        *,
        of: Mapping[str, Value] | None = None,
        numbers: str = "",
        digits: int = 6,
    ) -> None:
        """Adds a result: symbol, formula on a line, the formula with its numbers, and the value (SI) as it is shown.

        Numbers are put in for a formula's names where all of them, or some ``of`` here, are known, from here or from
        what was put before: with their units, without these where all have the result's; ``digits`` of them.
        ``numbers``: a sum in that unit, where the formula has no names for them.
        """
        self.known |= {normal(key): each for key, each in (of or {}).items()}
        used = [each for each in names(formula) if each in self.known]
        if not numbers and used and (of or {*names(formula)} <= {*used, "e", "π"}):
            numbers = filled(formula, self._put_in(used, dimension, digits))
        shown = number(0.0 if not dimension and abs(value) < ZERO_TOLERANCE else value, dimension)
        found = "" if unmarked(numbers) in (formula, shown) else numbers
        self.items.append(Equation(symbol, formula, found, shown, shown_unit(dimension), value))
        self.known[normal(symbol)] = (value, dimension)

    def _put_in(self, used: Sequence[str], dimension: str, digits: int) -> dict[str, str]:
        """The values of the names of a formula."""
        values = {key: each if isinstance(each := self.known[key], tuple) else (each, "") for key in used}
        bare = all(kind == dimension for _, kind in values.values()) and dimension != "angle"
        return {key: (number if bare else quantity_text)(each, kind, digits) for key, (each, kind) in values.items()}

    def relate(self, left: Term, right: Term) -> None:
        """Adds an equation that is solved further below."""
        self.items.append(Relation(left, right))

    def find(self, result: Term, formula: Term, what: str | Output) -> Term:
        """Adds a result, ``what``: its unit, or the output that it is: the symbol with the solver's value, and the
        formula that gives it; what is printed as zero is put in as zero from there on."""
        item = _equation(result, formula, what)
        self.items.append(item)
        return replace(result, amount=0.0) if item.result == "0" else result

    def define(self, name: str, formula: Term, what: str | Output, *, degrees: bool = False) -> Term:
        """Adds a quantity by its formula alone."""
        return self.find(symbol(name, formula.value, degrees=degrees), formula, what)

    def find_pair(self, name: str, values: complex, formula: Pair, force: Output | None) -> Pair:
        """Adds both components of a force."""
        found = []
        for c, value, part in (("x", values.real, formula.x), ("y", values.imag, formula.y)):
            term = symbol(f"{name}{c}", value)
            found.append(self.find(term, part, replace(force, component=c) if force else "N"))
        return Pair(found[0], found[1])

    def give(self, result: Term, what: str | Output) -> Term:
        """Adds what is known beforehand; ``what``: its unit, or the output that it is."""
        shown = put_in(result, 6).rstrip("°")
        self.items.append(Equation(plain(result), "", "", shown, *_measured(result, what), (result, result)))
        return result

    def data(self) -> dict[str, object]:
        """Plain data."""
        items = [item.data() for item in self.items]
        return {"number": self.number, "title": self.title, "group": self.group, "items": items}


def _measured(result: Term, what: str | Output) -> tuple[str, float, Output | None]:
    """Unit, value and output of a result."""
    unit, output = (what, None) if isinstance(what, str) else (what.unit, what)
    return "°" if result.degrees else unit, result.amount, output


def _equation(result: Term, formula: Term, what: str | Output) -> Equation:
    value, error = result.amount, error_of(formula)
    if abs(value - formula.value) > OFF * error + FADED:
        raise SelfCheckError(
            _(
                "the worked solution does not come out: {symbol} is {value} by the solver, but "
                "{formula} by its formula. Next to a singular position the numbers may have no "
                "digits left: ask for a position away from it. Elsewhere this is an error of the "
                "program: please report it with the model file",
                code="worked.off",
                symbol=plain(result),
                value=f"{value:.6g}",
                formula=f"{formula.value:.6g}",
            )
        )
    place = last_place(value, error)
    text = "0" if formula.value == 0.0 and abs(value) < FADED else printed(value, place)
    digits = digits_needed(formula, text, place if text != "0" else max(place, -6))
    symbols, numbers = plain(formula), plain(formula, digits)
    if formula.op == "number":
        symbols = numbers = ""
    elif formula.op == "symbol" and put_in(formula, digits).rstrip("°") == text:
        numbers = ""
    elif symbols == numbers:
        symbols = ""
    if numbers == text:
        numbers = ""
    measured = _measured(result, what)
    return Equation(plain(result), symbols, numbers, text, *measured, (result, formula), digits)


WIDTH = 100


def page(heading: Iterable[str], steps: Iterable[Step]) -> str:
    """All steps, equal signs in line within a step."""
    title, *legend = heading
    lines = [title, *(line for text in legend for line in _folded(text))]
    for step in steps:
        title = f"{step.number}  {step.title}"
        lines += ["", title, ("=" if "." not in step.number else "-") * cells(title), *_step_lines(step)]
    return "\n".join(line for i, line in enumerate(lines) if line or i == 0 or lines[i - 1])


def _step_lines(step: Step) -> Iterator[str]:
    names = [cells(item.symbol) for item in step.equations if cells(item.symbol) <= 14]
    margin = max(names, default=0)
    previous_note = False
    for item in step.items:
        if isinstance(item, Note):
            if not previous_note and item is not step.items[0]:
                yield ""
            yield from _folded(item.text)
        elif isinstance(item, Relation):
            yield from _long("    ", item.text, "    ")
        elif isinstance(item, Written | Tabulated):
            lines = [f"    {line}".rstrip() for line in item.text.splitlines()]
            yield from ["", *lines, ""] if len(lines) > 1 else lines
        else:
            yield from _equation_lines(item, margin)
        previous_note = isinstance(item, Note)


def _equation_lines(item: Equation, margin: int) -> Iterator[str]:
    gap = " " * max(margin - cells(item.symbol), 0)
    start = f"    {item.symbol}{gap} = "
    unit = f" {item.unit}" if item.unit and item.unit != "°" else item.unit
    result = f"{item.result}{unit}"
    parts = [part for part in (item.formula, item.numbers) if part]
    one_line = start + " = ".join([*parts, result])
    if cells(one_line) <= WIDTH:
        yield one_line
        return
    indent = " " * (4 + max(margin, cells(item.symbol)))
    yield from _long(start, parts[0] if parts else result, indent)
    for part in [*parts[1:], result] if parts else []:
        yield from _long(f"{indent} = ", part, indent)


def _long(start: str, text: str, indent: str) -> Iterator[str]:
    """A side of an equation, broken before a plus or a minus between its terms where it is too wide."""
    line = start
    for i, token in enumerate(_terms(text)):
        if i and cells(line) + cells(token) + 1 > WIDTH:
            yield line
            line = f"{indent}     {token}"
        else:
            line += (" " if i else "") + token
    yield line


def _terms(text: str) -> list[str]:
    """Parts that begin with a plus or a minus in at most one pair of parentheses."""
    parts, depth = [""], 0
    for word in text.split(" "):
        if word in ("+", "-") and depth <= 1:
            parts.append(word)
        else:
            parts[-1] += f" {word}" if parts[-1] else word
        depth += word.count("(") - word.count(")")
    return parts


def _folded(text: str) -> list[str]:
    """A sentence in lines."""
    return [f"  {line}".rstrip() for line in folded(text, WIDTH - 2)]


@dataclass(frozen=True)
class Solution:
    """A worked solution: ``steps`` in the order in which a textbook prints them."""

    title: str
    steps: tuple[Step, ...]

    @property
    def equations(self) -> tuple[Equation, ...]:
        """All results in order."""
        return tuple(equation for step in self.steps for equation in step.equations)

    def text(self) -> str:
        """Plain text, up to 100 columns wide but for tables and matrices."""
        return page((self.title,), self.steps)

    def data(self) -> dict[str, object]:
        """Plain data for programs and reports."""
        return {"title": self.title, "steps": [step.data() for step in self.steps]}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.title!r}: {len(self.steps)} steps, {len(self.equations)} equations)"
