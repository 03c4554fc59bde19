"""Lines of a program as LLVM intermediate representation."""

from __future__ import annotations

from collections.abc import Callable

from linkwright.formula.functions import FUNCTIONS, Function
from linkwright.formula.ir_functions import FORMS, IN_LANES, VECTOR, number
from linkwright.formula.ir_lookup import LOOKUP
from linkwright.formula.ir_vectors import Lanes
from linkwright.formula.lines import Line, Lines

#: What the compiler may assume: signs of zero, reciprocals, fused and regrouped operations.
#: Never that there is no NaN and no infinity.
FAST = "nsz arcp contract reassoc"
_ARITHMETIC = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
_COMPARISON = {"less": "olt", "less_equal": "ole"}
_LOGIC = {"and": "and", "or": "or"}


class LineWriter(Lanes):
    """Writes lines as instructions; ``%v12`` is line 12, ``%w12`` the same in all lanes.

    ``library``: functions are called from outside, lane by lane. ``names`` and ``tables`` may be
    changed where lines are written next to others: the names of values, and where the tables are.
    """

    def __init__(self, lines: Lines, width: int, library: bool = False) -> None:
        super().__init__(width)
        self.lines = lines.lines
        self.outputs = lines.outputs
        self._in_lanes = {} if library or width < 2 else IN_LANES
        self.names: dict[int, str] = {}
        self.tables = list(range(lines.tables))
        self.preamble: list[str] = []
        self.body: list[str] = []
        self._splats: set[int] = set()
        self._as_number: set[int] = set()
        self._found: dict[tuple[str, str], str] = {}

    def name(self, index: int) -> str:
        """The name of a line's value."""
        return self.names.get(index, f"%v{index}")

    def is_vector(self, index: int) -> bool:
        """Whether a line is held in all lanes."""
        return self.lines[index].varies

    def type_of(self, index: int, vector: bool) -> str:
        """LLVM type of a line's value."""
        if self.lines[index].truth:
            return self.mask if vector else "i1"
        return self.vector if vector else "double"

    def operand(self, index: int, vector: bool) -> str:
        """A line's value as an operand, spread over the lanes where a vector is wanted."""
        line = self.lines[index]
        if line.op == "constant":
            return self.constant(line.constant, vector)
        if not vector or self.is_vector(index):
            return self.name(index)
        if index not in self._splats:
            self._splats.add(index)
            self.preamble += self.spread(self.name(index), f"%w{index}", "i1" if line.truth else "double")
        return f"%w{index}"

    def constant(self, value: float, vector: bool) -> str:
        """A number as an operand."""
        return self.same("double", number(value)) if vector else number(value)

    def write(self, index: int) -> None:
        """Write an operation where it belongs: before the loop or in it."""
        line = self.lines[index]
        vector = self.is_vector(index)
        target = self.body if line.varies else self.preamble
        instructions = self._instructions(index, line, vector)
        target += instructions

    def as_number(self, index: int, into: list[str]) -> str:
        """A line of the loop as a vector of numbers, truth values as 1.0 and 0.0."""
        operand = self.operand(index, True)
        if not self.lines[index].truth:
            return operand
        if index not in self._as_number:
            self._as_number.add(index)
            into.append(f"%f{index} = uitofp {self.mask} {operand} to {self.vector}")
        return f"%f{index}"

    def _instructions(self, index: int, line: Line, vector: bool) -> list[str]:
        kind = self.type_of(index, vector)
        value = self.name(index)
        args = [self.operand(a, vector) for a in line.args]
        if line.op in _ARITHMETIC:
            return [f"{value} = {_ARITHMETIC[line.op]} {FAST} {kind} {args[0]}, {args[1]}"]
        if line.op in _COMPARISON:
            operands = self.type_of(line.args[0], vector)
            return [f"{value} = fcmp {_COMPARISON[line.op]} {operands} {args[0]}, {args[1]}"]
        if line.op in _LOGIC:
            return [f"{value} = {_LOGIC[line.op]} {kind} {args[0]}, {args[1]}"]
        if line.op in FUNCTIONS:
            return self._function(FUNCTIONS[line.op], value, kind, args, vector)
        if line.op == "lookup":
            return self._look_up(line, value, args[0], vector)
        return _OTHER[line.op](self, line, value, kind, args, vector)

    def _function(self, function: Function, value: str, kind: str, args: list[str], vector: bool) -> list[str]:
        """An intrinsic, a function in all lanes, or a call of the C library, lane by lane."""
        if function.exact:
            suffix = f"v{self.width}f64" if vector else "f64"
            return [f"{value} = call {FAST} {kind} @llvm.{function.exact}.{suffix}({kind} {args[0]})"]
        name = f"@linkwright_{function.library}"
        if not vector:
            return [f"{value} = call double {name}({', '.join(f'double {a}' for a in args)})"]
        if function.library in self._in_lanes:
            return self._in_all_lanes(function.library, value, ", ".join(f"{self.vector} {a}" for a in args))
        lines, last = [], "poison"
        for lane in range(self.width):
            places = [f"{value}.x{lane}.{place}" for place in range(len(args))]
            lines += [
                f"{at} = extractelement {self.vector} {argument}, i32 {lane}"
                for at, argument in zip(places, args, strict=True)
            ]
            lines.append(f"{value}.y{lane} = call double {name}({', '.join(f'double {a}' for a in places)})")
            into = value if lane == self.width - 1 else f"{value}.i{lane}"
            lines.append(f"{into} = insertelement {self.vector} {last}, double {value}.y{lane}, i32 {lane}")
            last = into
        return lines

    def _in_all_lanes(self, library: str, value: str, arguments: str) -> list[str]:
        """One of the results of a form for vectors, which is called once for the same arguments."""
        form = IN_LANES[library]
        results, place = ", ".join([self.vector] * len(FORMS[form])), FORMS[form].index(library)
        found, code = self._found.get((form, arguments)), []
        if found is None:
            found = self._found[form, arguments] = f"{value}.all"
            code.append(f"{found} = call {{ {results} }} @{VECTOR}{form}({arguments})")
        return [*code, f"{value} = extractvalue {{ {results} }} {found}, {place}"]

    def _look_up(self, line: Line, value: str, x: str, vector: bool) -> list[str]:
        call = f"call {self.vector} @{LOOKUP}{line.constant:.0f}(ptr %table{self.tables[line.place]}, {self.vector}"
        if vector:
            return [f"{value} = {call} {x})"]
        return [
            *self.spread(x, f"{value}.all", "double"),
            f"{value}.found = {call} {value}.all)",
            f"{value} = extractelement {self.vector} {value}.found, i32 0",
        ]


_Writer = Callable[[LineWriter, Line, str, str, list[str], bool], list[str]]


def _negation(w: LineWriter, line: Line, value: str, kind: str, args: list[str], vector: bool) -> list[str]:
    return [f"{value} = fneg {FAST} {kind} {args[0]}"]


def _inverse(w: LineWriter, line: Line, value: str, kind: str, args: list[str], vector: bool) -> list[str]:
    return [f"{value} = xor {kind} {args[0]}, {w.all_true if vector else 'true'}"]


def _choice(w: LineWriter, line: Line, value: str, kind: str, args: list[str], vector: bool) -> list[str]:
    condition = w.mask if vector else "i1"
    return [f"{value} = select {condition} {args[0]}, {kind} {args[1]}, {kind} {args[2]}"]


def _to_number(w: LineWriter, line: Line, value: str, kind: str, args: list[str], vector: bool) -> list[str]:
    return [f"{value} = uitofp {w.mask if vector else 'i1'} {args[0]} to {kind}"]


def _to_truth(w: LineWriter, line: Line, value: str, kind: str, args: list[str], vector: bool) -> list[str]:
    operands = w.vector if vector else "double"
    return [f"{value} = fcmp une {operands} {args[0]}, {w.constant(0.0, vector)}"]


_OTHER: dict[str, _Writer] = {
    "neg": _negation,
    "not": _inverse,
    "select": _choice,
    "number": _to_number,
    "truth": _to_truth,
}
