"""Lines of a program, and accumulators of reductions, as LLVM intermediate representation."""

from __future__ import annotations

from collections.abc import Callable

from linkwright.core.arrays import EQUAL
from linkwright.formula.ir_functions import FORMS, IN_LANES, LOOKUP, VECTOR, Lanes, number
from linkwright.formula.operations import FUNCTIONS, Function
from linkwright.formula.program import Line, Lines
from linkwright.formula.reductions import Accumulation, Step

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


_START = {"min": float("inf"), "max": float("-inf")}
_BETTER = {"min": "olt", "max": "ogt"}
#: Those that are better or as good, and which sign, times :data:`EQUAL`, makes a positive number worse.
_AS_GOOD, _WORSE = {"min": "ole", "max": "oge"}, {"min": 1.0, "max": -1.0}
#: The position number of an extreme that no number reached.
NO_INDEX = 2**62


class AccumulatorWriter:
    """Accumulator ``k`` is ``%a{k}`` at the start of a turn of the loop and ``%b{k}`` at its end.

    ``%position``: the i64 vector of the lanes' position numbers; ``%fresh``: the mask of the
    lanes that have no value yet.
    """

    def __init__(self, writer: LineWriter, accumulation: Accumulation) -> None:
        self.w = writer
        self.steps = accumulation.steps
        self.rows = dict(zip(accumulation.needed.output_names, writer.outputs, strict=True))
        self._valid = accumulation.valid
        self._column = accumulation.column
        self._masks: dict[str, str] = {}

    def kind(self, step: str) -> str:
        """LLVM type of an accumulator."""
        return self.w.integers if step in ("argmin", "argmax", "count") else self.w.vector

    def start(self, step: str) -> str:
        """Its value before the first position."""
        if step in ("argmin", "argmax"):
            return self.w.same("i64", NO_INDEX)
        if step in _START:
            return self.w.constant(_START[step], True)
        return "zeroinitializer"

    def update(self) -> list[str]:
        """Instructions that let a turn's positions enter."""
        code: list[str] = []
        for k, step in enumerate(self.steps):
            if step.kind in _BETTER:
                code += self._extreme(k, step)
            elif step.kind == "count":
                code += self._count(k, step.output)
            elif step.kind in ("sum", "square"):
                code += self._sum(k, step.kind, step.output)
        return code

    def finish_lanes(self, k: int) -> list[str]:
        """Instructions that bring the lanes of one accumulator together in ``%r{k}``.

        Extremes come first, then their position numbers.
        """
        step = self.steps[k]
        kind, value = self.kind(step.kind), f"%b{k}"
        suffix = f"v{self.w.width}f64"
        if step.kind in _BETTER:
            extreme = f"call nnan nsz double @llvm.vector.reduce.f{step.kind}.{suffix}"
            return [f"%r{k} = {extreme}({kind} {value})"]  # no NaN: only what compares as better came in
        if step.kind in ("sum", "square"):
            total = f"call {FAST} double @llvm.vector.reduce.fadd.{suffix}"
            return [f"%r{k} = {total}(double {number(-0.0)}, {kind} {value})"]
        if step.kind == "count":
            return [
                f"%q{k} = call i64 @llvm.vector.reduce.add.v{self.w.width}i64({kind} {value})",
                f"%r{k} = sitofp i64 %q{k} to double",
            ]
        return self._first_index(k, step)

    def _first_index(self, k: int, step: Step) -> list[str]:
        side = self._column[Step(step.kind.removeprefix("arg"), step.output)]
        vector, mask = self.w.vector, self.w.mask
        none, kind = self.start(step.kind), step.kind.removeprefix("arg")
        return [
            *self.w.spread(f"%r{side}", f"%best{k}", "double"),
            *self._worse(f"%equal{k}", f"%best{k}", kind),
            f"%at{k} = fcmp {_AS_GOOD[kind]} {vector} %b{side}, %equal{k}",
            f"%i{k} = select {mask} %at{k}, {self.w.integers} %b{k}, {self.w.integers} {none}",
            f"%q{k} = call i64 @llvm.vector.reduce.smin.v{self.w.width}i64({self.w.integers} %i{k})",
            f"%none{k} = icmp eq i64 %q{k}, {NO_INDEX}",
            f"%p{k} = select i1 %none{k}, i64 -1, i64 %q{k}",
            f"%r{k} = sitofp i64 %p{k} to double",
        ]

    def _entering(self, code: list[str], *, once: bool) -> str | None:
        """The mask of the positions that enter; ``once``: a repeated position must not."""
        parts = [] if self._valid is None else [self._truth(code, self._valid)]
        if once:
            parts.append("%fresh")
        if len(parts) < 2:
            return parts[0] if parts else None
        if "both" not in self._masks:
            self._masks["both"] = "%entering"
            code.append(f"%entering = and {self.w.mask} {parts[0]}, {parts[1]}")
        return self._masks["both"]

    def _truth(self, code: list[str], output: str) -> str:
        index = self.rows[output]
        operand = self.w.operand(index, True)
        if self.w.lines[index].truth:
            return operand
        name = f"%truth{index}"
        if name not in self._masks:
            self._masks[name] = name
            code.append(f"{name} = fcmp une {self.w.vector} {operand}, {self.w.constant(0.0, True)}")
        return name

    def _extreme(self, k: int, step: Step) -> list[str]:
        """An extreme, and its position number."""
        code: list[str] = []
        vector, mask = self.w.vector, self.w.mask
        value = self.w.as_number(self.rows[step.output], code)
        entering = self._entering(code, once=False)
        arg = self._column.get(Step(f"arg{step.kind}", step.output))
        compared = value
        if arg is not None:
            code += self._worse(f"%surely{k}", value, step.kind)
            compared = f"%surely{k}"
        code.append(f"%c{k} = fcmp {_BETTER[step.kind]} {vector} {compared}, %a{k}")
        better = f"%c{k}"
        if entering is not None and arg is None:
            return [
                *code,
                f"%e{k} = select {mask} %c{k}, {vector} {value}, {vector} %a{k}",
                f"%b{k} = select {mask} {entering}, {vector} %e{k}, {vector} %a{k}",
            ]
        if entering is not None:
            better = f"%e{k}"
            code.append(f"%e{k} = and {mask} %c{k}, {entering}")
        code.append(f"%b{k} = select {mask} {better}, {vector} {value}, {vector} %a{k}")
        if arg is not None:
            kinds = self.w.integers
            code.append(f"%b{arg} = select {mask} {better}, {kinds} %position, {kinds} %a{arg}")
        return code

    def _worse(self, name: str, value: str, kind: str) -> list[str]:
        """The worst values that are equal to some but for rounding."""
        vector, off = self.w.vector, _WORSE[kind] * EQUAL
        above, below = (self.w.constant(1.0 + each, True) for each in (off, -off))
        return [
            f"{name}_up = fcmp ogt {vector} {value}, {self.w.constant(0.0, True)}",
            f"{name}_by = select {self.w.mask} {name}_up, {vector} {above}, {vector} {below}",
            f"{name} = fmul {vector} {value}, {name}_by",
        ]

    def _count(self, k: int, output: str) -> list[str]:
        code: list[str] = []
        held, entering = self._truth(code, output), self._entering(code, once=True)
        return [
            *code,
            f"%h{k} = and {self.w.mask} {held}, {entering}",
            f"%o{k} = zext {self.w.mask} %h{k} to {self.w.integers}",
            f"%b{k} = add {self.w.integers} %a{k}, %o{k}",
        ]

    def _sum(self, k: int, step: str, output: str) -> list[str]:
        code: list[str] = []
        vector = self.w.vector
        value = self.w.as_number(self.rows[output], code)
        entering = self._entering(code, once=True)
        if step == "square":
            code.append(f"%squared{k} = fmul {FAST} {vector} {value}, {value}")
            value = f"%squared{k}"
        return [
            *code,
            f"%t{k} = fadd {FAST} {vector} {value}, %a{k}",
            f"%b{k} = select {self.w.mask} {entering}, {vector} %t{k}, {vector} %a{k}",
        ]
