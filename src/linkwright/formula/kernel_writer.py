"""Functions of the small typed part of Python that kernels are written in, as LLVM's language."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from functools import cache
from typing import Any

from linkwright.formula.late_import import ir


class ComplexWriter:
    """How a writer of kernels writes complex numbers."""

    b: Any
    vector: Any
    lanes: int
    flags: tuple[str, ...]
    _as: Any

    def _is_pair(self, value: Any) -> bool:
        return isinstance(value.type, ir.LiteralStructType)

    def _parts(self, value: Any) -> tuple[Any, Any]:
        """Real and imaginary part; the latter None for what is real."""
        if self._is_pair(value):
            return self.b.extract_value(value, 0), self.b.extract_value(value, 1)
        return self._as(value, self.vector), None

    def _pair(self, real: Any, imaginary: Any) -> Any:
        empty = ir.Constant(ir.LiteralStructType([self.vector, self.vector]), ir.Undefined)
        return self.b.insert_value(self.b.insert_value(empty, real, 0), imaginary, 1)

    def _complex_operation(self, name: str, left: Any, right: Any) -> Any:
        (a, b), (c, d) = self._parts(left), self._parts(right)
        if name == "Mult":
            if b is None or d is None:
                pair, factor = ((c, d), a) if b is None else ((a, b), c)
                return self._pair(self._fmul(pair[0], factor), self._fmul(pair[1], factor))
            real = self._fsub(self._fmul(a, c), self._fmul(b, d))
            return self._pair(real, self._fadd(self._fmul(a, d), self._fmul(b, c)))
        if name == "Sub":
            c, d = self._negative(c), None if d is None else self._negative(d)
        elif name != "Add":
            raise TypeError(name)
        return self._pair(self._fadd(a, c), b if d is None else d if b is None else self._fadd(b, d))

    def _negative(self, value: Any) -> Any:
        if self._is_pair(value):
            a, b = self._parts(value)
            return self._pair(self._negative(a), self._negative(b))
        return self.b.fneg(value, flags=self.flags)

    def _fadd(self, a: Any, b: Any) -> Any:
        return self.b.fadd(a, b, flags=self.flags)

    def _fsub(self, a: Any, b: Any) -> Any:
        return self.b.fsub(a, b, flags=self.flags)

    def _fmul(self, a: Any, b: Any) -> Any:
        return self.b.fmul(a, b, flags=self.flags)

    def _entry(self, address: Any, entry: Any, half: int) -> Any:
        index_type = entry.type
        place = self.b.mul(entry, ir.Constant(index_type, 2 * self.lanes))
        place = self.b.add(place, ir.Constant(index_type, half * self.lanes))
        return self.b.gep(address.value, [place], source_etype=address.entry)

    def _call_fetch(self, address: Any, entry: Any) -> Any:
        halves = (self.b.load(self._entry(address, entry, k), align=8, typ=self.vector) for k in (0, 1))
        return self._pair(*halves)

    def _call_put(self, address: Any, entry: Any, value: Any) -> None:
        for k, part in enumerate(self._parts(value)):
            self.b.store(part, self._entry(address, entry, k), align=8)

    def _call_square(self, value: Any) -> Any:
        a, b = self._parts(value)
        return self._fadd(self._fmul(a, a), self._fmul(b, b))

    def _call_inverse(self, value: Any) -> Any:
        one = ir.Constant(self.vector, [1.0] * self.lanes)
        size = self.b.fdiv(one, self._call_square(value), flags=self.flags)
        a, b = self._parts(value)
        return self._pair(self._fmul(a, size), self._negative(self._fmul(b, size)))

    def _call_choose(self, test: Any, yes: Any, no: Any) -> Any:
        (a, b), (c, d) = self._parts(yes), self._parts(no)
        return self._pair(self.b.select(test, a, c), self.b.select(test, b, d))


LANES = 8
_FLAGS = ("contract", "reassoc", "nsz", "arcp")
_COMPARE = {"Lt": "<", "Gt": ">", "LtE": "<=", "GtE": ">=", "Eq": "==", "NotEq": "!="}
_INTEGER_OPERATIONS = {"Add": "add", "Sub": "sub", "Mult": "mul", "FloorDiv": "sdiv", "Mod": "srem"}
_REAL = {"Add": "fadd", "Sub": "fsub", "Mult": "fmul", "Div": "fdiv"}
_INTRINSIC = {"sqrt": "sqrt", "sin": "sin", "cos": "cos", "exp": "exp", "log": "log", "fabs": "fabs"}


def annotation(node: ast.expr | None) -> str | None:
    """What a kernel's definition says of an argument or its result."""
    return None if node is None or isinstance(node, ast.Constant) else ast.unparse(node)


@cache
def _types() -> tuple[Any, ...]:
    integer, real = ir.IntType(64), ir.DoubleType()
    return integer, real, ir.VectorType(real, LANES), ir.VectorType(integer, LANES), ir.PointerType()


class _Address:
    """An address in the text, with the type of what lies there."""

    def __init__(self, value: Any, entry: Any) -> None:
        self.value, self.entry = value, entry
        self.type = value.type


class KernelWriter(ComplexWriter):
    """Writes one function into a module of LLVM's language, after those ``made`` before."""

    lanes, flags = LANES, _FLAGS

    def __init__(self, module: Any, made: dict[str, Any], constants: dict[str, float]) -> None:
        self.module, self.made, self.constants = module, made, constants
        self.integer, self.real, self.vector, self.integers, self.pointer = _types()
        self.slots: dict[str, tuple[Any, Any]] = {}
        self.loops: list[tuple[Any, Any]] = []

    def function(self, tree: ast.FunctionDef) -> Any:
        """The function of a definition."""
        kinds = {"int": self.integer, "float": self.real, "Vector": self.vector}
        names = [each.arg for each in tree.args.args]
        notes = [str(annotation(each.annotation)) for each in tree.args.args]
        result = kinds.get(str(annotation(tree.returns)), ir.VoidType())
        shape = ir.FunctionType(result, [kinds.get(note, self.pointer) for note in notes])
        self.f = ir.Function(self.module, shape, tree.name)
        self.made[tree.name] = self.f
        self.entry = self.f.append_basic_block("entry")
        body = self.f.append_basic_block("body")
        self.b = ir.IRBuilder(body)
        for value, name, note in zip(self.f.args, names, notes, strict=True):
            entry = self.real if note == "Reals" else self.integer
            self._keep(name, _Address(value, entry) if note in ("Reals", "Wholes") else value)
        self._block(tree.body)
        if not self.b.block.is_terminated:
            self.b.ret_void() if result == ir.VoidType() else self.b.ret(ir.Constant(result, 0))
        ir.IRBuilder(self.entry).branch(body)
        return self.f

    # variables
    def _keep(self, name: str, value: Any) -> None:
        entry = value.entry if isinstance(value, _Address) else None
        kind = self.pointer if entry is not None else value.type
        if name not in self.slots:
            with self.b.goto_block(self.entry):
                self.slots[name] = self.b.alloca(kind, name=name), (kind, entry)
        slot, (kind, _) = self.slots[name]
        self.b.store(value.value if entry is not None else self._as(value, kind), slot)

    def _get(self, name: str) -> Any:
        if name in self.slots:
            slot, (kind, entry) = self.slots[name]
            value = self.b.load(slot, typ=kind)
            return value if entry is None else _Address(value, entry)
        number = self.constants[name]
        return ir.Constant(self.integer if isinstance(number, int) else self.real, number)

    def _as(self, value: Any, kind: Any) -> Any:
        if value.type == kind:
            return value
        if value.type == self.integer and kind in (self.real, self.vector):
            return self._as(self.b.sitofp(value, self.real), kind)
        if value.type == self.real and kind == self.vector:
            return self._spread(value)
        raise TypeError(f"{value.type} is no {kind}")

    def _spread(self, value: Any) -> Any:
        short = ir.IntType(32)
        empty = ir.Constant(self.vector, ir.Undefined)
        first = self.b.insert_element(empty, value, ir.Constant(short, 0))
        return self.b.shuffle_vector(first, empty, ir.Constant(ir.VectorType(short, LANES), [0] * LANES))

    # statements
    def _block(self, statements: Sequence[ast.stmt]) -> None:
        for each in statements:
            if self.b.block.is_terminated:
                return
            getattr(self, f"_do_{type(each).__name__}")(each)

    def _do_Expr(self, node: ast.Expr) -> None:
        if not isinstance(node.value, ast.Constant):
            self._value(node.value)

    def _do_Assign(self, node: ast.Assign) -> None:
        (target,) = node.targets
        if isinstance(target, ast.Tuple):
            assert isinstance(node.value, ast.Tuple)
            values = [self._value(each) for each in node.value.elts]
            for each, value in zip(target.elts, values, strict=True):
                assert isinstance(each, ast.Name)
                self._keep(each.id, value)
        elif isinstance(target, ast.Subscript):
            place, entry = self._place(target)
            self.b.store(self._as(self._value(node.value), entry), place)
        else:
            assert isinstance(target, ast.Name)
            self._keep(target.id, self._value(node.value))

    def _do_AugAssign(self, node: ast.AugAssign) -> None:
        now = ast.parse(ast.unparse(node.target), mode="eval").body
        self._do_Assign(ast.Assign([node.target], ast.BinOp(now, node.op, node.value)))

    def _do_If(self, node: ast.If) -> None:
        test = self._value(node.test)
        yes, no, end = (self.f.append_basic_block() for _ in range(3))
        self.b.cbranch(test, yes, no)
        for at, statements in ((yes, node.body), (no, node.orelse)):
            self.b.position_at_end(at)
            self._block(statements)
            if not self.b.block.is_terminated:
                self.b.branch(end)
        self.b.position_at_end(end)

    def _do_While(self, node: ast.While, step: ast.AugAssign | None = None) -> None:
        head, body, onward, end = (self.f.append_basic_block() for _ in range(4))
        self.b.branch(head)
        self.b.position_at_end(head)
        self.b.cbranch(self._value(node.test), body, end)
        self.b.position_at_end(body)
        self.loops.append((onward, end))
        self._block(node.body)
        self.loops.pop()
        if not self.b.block.is_terminated:
            self.b.branch(onward)
        self.b.position_at_end(onward)
        if step is not None:
            self._do_AugAssign(step)
        self.b.branch(head)
        self.b.position_at_end(end)

    def _do_For(self, node: ast.For) -> None:
        assert isinstance(node.iter, ast.Call) and isinstance(node.target, ast.Name)
        bounds = node.iter.args
        first, last = (ast.Constant(0), bounds[0]) if len(bounds) == 1 else (bounds[0], bounds[1])
        step = bounds[2] if len(bounds) > 2 else ast.Constant(1)
        stop = f"{node.target.id} stops {len(self.slots)}"
        self._keep(node.target.id, self._value(first))
        self._keep(stop, self._value(last))
        now = ast.Name(node.target.id, ast.Load())
        test = ast.Compare(now, [ast.Lt()], [ast.Name(stop, ast.Load())])
        onward = ast.AugAssign(ast.Name(node.target.id, ast.Store()), ast.Add(), step)
        self._do_While(ast.While(test, node.body, []), onward)

    def _do_Break(self, _: ast.Break) -> None:
        self.b.branch(self.loops[-1][1])

    def _do_Continue(self, _: ast.Continue) -> None:
        self.b.branch(self.loops[-1][0])

    def _do_Return(self, node: ast.Return) -> None:
        if node.value is None:
            self.b.ret_void()
        else:
            self.b.ret(self._as(self._value(node.value), self.f.function_type.return_type))

    # expressions
    def _value(self, node: ast.expr) -> Any:
        return getattr(self, f"_of_{type(node).__name__}")(node)

    def _of_Constant(self, node: ast.Constant) -> Any:
        return ir.Constant(self.integer if isinstance(node.value, int) else self.real, node.value)

    def _of_Name(self, node: ast.Name) -> Any:
        return self._get(node.id)

    def _of_UnaryOp(self, node: ast.UnaryOp) -> Any:
        value = self._value(node.operand)
        return self.b.neg(value) if value.type == self.integer else self._negative(value)

    def _of_BinOp(self, node: ast.BinOp) -> Any:
        left, right, name = self._value(node.left), self._value(node.right), type(node.op).__name__
        if isinstance(left, _Address):
            if name != "Add":
                raise TypeError(f"an address can only be added to: {ast.unparse(node)}")
            return _Address(self.b.gep(left.value, [right], source_etype=left.entry), left.entry)
        if self._is_pair(left) or self._is_pair(right):
            return self._complex_operation(name, left, right)
        left, right = self._same_type(left, right)
        if left.type == self.integer:
            return getattr(self.b, _INTEGER_OPERATIONS[name])(left, right)
        return getattr(self.b, _REAL[name])(left, right, flags=_FLAGS)

    def _same_type(self, left: Any, right: Any) -> tuple[Any, Any]:
        kinds = left.type, right.type
        kind = self.vector if self.vector in kinds else self.real if self.real in kinds else left.type
        return self._as(left, kind), self._as(right, kind)

    def _of_Compare(self, node: ast.Compare) -> Any:
        left, right = self._same_type(self._value(node.left), self._value(node.comparators[0]))
        return self._compared(_COMPARE[type(node.ops[0]).__name__], left, right)

    def _compared(self, sign: str, left: Any, right: Any) -> Any:
        compare = self.b.icmp_signed if left.type == self.integer else self.b.fcmp_ordered
        return compare(sign, left, right)

    def _of_BoolOp(self, node: ast.BoolOp) -> Any:
        join = self.b.and_ if isinstance(node.op, ast.And) else self.b.or_
        found, *rest = (self._value(each) for each in node.values)
        for each in rest:
            found = join(found, each)
        return found

    def _of_IfExp(self, node: ast.IfExp) -> Any:
        test = self._value(node.test)
        return self.b.select(test, *self._same_type(self._value(node.body), self._value(node.orelse)))

    def _place(self, node: ast.Subscript) -> tuple[Any, Any]:
        address = self._value(node.value)
        place = self.b.gep(address.value, [self._value(node.slice)], source_etype=address.entry)
        return place, address.entry

    def _of_Subscript(self, node: ast.Subscript) -> Any:
        place, entry = self._place(node)
        return self.b.load(place, typ=entry)

    def _of_Call(self, node: ast.Call) -> Any:
        assert isinstance(node.func, ast.Name)
        name, arguments = node.func.id, [self._value(each) for each in node.args]
        if name in self.made:
            kinds = self.made[name].function_type.args
            plain = [
                each.value if isinstance(each, _Address) else self._as(each, kind)
                for each, kind in zip(arguments, kinds, strict=True)
            ]
            return self.b.call(self.made[name], plain)
        if name in _INTRINSIC:
            return self._intrinsic(_INTRINSIC[name], self._as(arguments[0], self.real))
        return getattr(self, f"_call_{name}")(*arguments)

    def _intrinsic(self, name: str, value: Any) -> Any:
        suffix = f"v{LANES}f64" if value.type == self.vector else "f64"
        return self.b.call(self._outside(f"llvm.{name}.{suffix}", value.type, value.type), [value])

    def _outside(self, name: str, result: Any, *arguments: Any) -> Any:
        known = self.module.globals.get(name)
        return known or ir.Function(self.module, ir.FunctionType(result, arguments), name)

    def _call_int(self, value: Any) -> Any:
        return value if value.type == self.integer else self.b.fptosi(value, self.integer)

    def _call_float(self, value: Any) -> Any:
        return self._as(value, self.real)

    def _call_min(self, left: Any, right: Any) -> Any:
        left, right = self._same_type(left, right)
        return self.b.select(self._compared("<", left, right), left, right)

    def _call_max(self, left: Any, right: Any) -> Any:
        left, right = self._same_type(left, right)
        return self.b.select(self._compared("<", left, right), right, left)

    _call_minimum, _call_maximum = _call_min, _call_max

    def _call_load(self, address: _Address, index: Any) -> Any:
        place = self.b.gep(address.value, [index], source_etype=self.real)
        return self.b.load(place, align=8, typ=self.vector)

    def _call_store(self, address: _Address, index: Any, value: Any) -> Any:
        place = self.b.gep(address.value, [index], source_etype=self.real)
        return self.b.store(self._as(value, self.vector), place, align=8)

    def _call_invoke(self, code: Any, block: _Address) -> Any:
        kind = ir.FunctionType(ir.VoidType(), [self.pointer]).as_pointer()
        return self.b.call(self.b.inttoptr(code, kind), [block.value])

    def _call_ramp(self, first: Any) -> Any:
        steps = ir.Constant(self.vector, [float(each) for each in range(LANES)])
        return self.b.fadd(self._as(first, self.vector), steps)

    def _call_spread(self, value: Any) -> Any:
        return self._spread(self._as(value, self.real))

    def _call_root(self, value: Any) -> Any:
        return self._intrinsic("sqrt", value)

    def _call_total(self, value: Any) -> Any:
        name = f"llvm.vector.reduce.fadd.v{LANES}f64"
        add = self._outside(name, self.real, self.real, self.vector)
        return self.b.call(add, [ir.Constant(self.real, 0.0), value], fastmath=_FLAGS)

    def _call_smallest(self, value: Any) -> Any:
        return self.b.call(self._outside(f"llvm.vector.reduce.fmin.v{LANES}f64", self.real, self.vector), [value])

    def _call_marked(self, value: Any, index: Any) -> Any:
        cleared = self.b.and_(self.b.bitcast(value, self.integers), ir.Constant(self.integers, [~4095] * LANES))
        return self.b.bitcast(self.b.or_(cleared, self.b.fptosi(index, self.integers)), self.vector)

    def _call_mark_of(self, value: Any) -> Any:
        return self.b.and_(self.b.bitcast(value, self.integer), ir.Constant(self.integer, 4095))
