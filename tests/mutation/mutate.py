"""Small changes of a module's source: each replaces one piece of text, as an attentive colleague would mistype it."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """The text of `path` from byte `begin` to `end` becomes `text`; `kind` says what was done."""

    path: str
    begin: int
    end: int
    text: str
    kind: str
    lines: tuple[int, int]

    def applied(self, source: str) -> str:
        raw = source.encode("utf-8")
        return (raw[: self.begin] + self.text.encode("utf-8") + raw[self.end :]).decode("utf-8")

    def changed_lines(self, source: str) -> tuple[str, str]:
        """The lines before and after, stripped and joined."""
        old, new = source.split("\n"), self.applied(source).split("\n")
        first, last = self.lines
        shift = len(new) - len(old)
        return _joined(old[first - 1 : last]), _joined(new[first - 1 : last + shift])

    def key(self, source: str) -> str:
        """What it is known by in the list of equivalent ones: independent of line numbers."""
        before, after = self.changed_lines(source)
        return f"{self.path} | {before} | {after}"


def _joined(lines: list[str]) -> str:
    return " ".join(line.strip() for line in lines)


OPERATORS: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Div,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitOr: ast.BitAnd,
    ast.BitAnd: ast.BitOr,
}
COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}


#: Functions whose arguments may change places.
COMMUTATIVE = (
    "max",
    "min",
    "maximum",
    "minimum",
    "lower",
    "higher",
    "hypot",
    "gcd",
    "lcm",
    "mul",
    "t.add",
    "w.add",
    "trace.add",
    "_trace.add",
)


def mutants(path: str, source: str) -> list[Mutant]:
    """All mutants of one module."""
    tree = ast.parse(source)
    starts = [0]
    for line in source.encode("utf-8").split(b"\n"):
        starts.append(starts[-1] + len(line) + 1)
    found = []
    for node in _nodes(tree):
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[(node.end_lineno or node.lineno) - 1] + (node.end_col_offset or 0)
        for kind, text in _changes(node):
            found.append(Mutant(path, begin, end, text, kind, (node.lineno, node.end_lineno or node.lineno)))
    return found


def _nodes(node: ast.AST) -> Iterator[ast.expr | ast.stmt]:
    """Expressions and statements that do something when the program runs."""
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "type_comment", "decorator_list", "bases"):
            continue
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST) or _silent(child) or _rest_of_shape(node, child):
                continue
            if isinstance(child, (ast.expr, ast.stmt)):
                yield child
            yield from _nodes(child)


def _silent(node: ast.AST) -> bool:
    """Documentation, types, narrowing for the type checker, imports, texts with their positions unknown, and what is
    asserted (zip's ``strict`` among it)."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return True
    if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
        return True
    if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
        return node.targets[0].id in ("__all__", "__slots__")
    if isinstance(node, ast.FunctionDef) and node.name == "__repr__":
        return True
    if isinstance(node, ast.keyword) and node.arg == "strict":
        return True
    return isinstance(node, (ast.Import, ast.ImportFrom, ast.Assert, ast.JoinedStr, ast.Pass))


def _rest_of_shape(parent: ast.AST, child: ast.AST) -> bool:
    """The -1 of a ``reshape``, where every negative number says the same."""
    reshapes = isinstance(parent, ast.Call) and ast.unparse(parent.func).endswith("reshape")
    return reshapes and ast.unparse(child) == "-1"


def _changes(node: ast.expr | ast.stmt) -> Iterator[tuple[str, str]]:
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        if not _of_text(node):
            yield "operator", _with(node, op=OPERATORS[type(node.op)]())
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        for other in COMPARISONS[type(node.ops[0])]:
            yield "comparison", _with(node, ops=[other()])
    elif isinstance(node, ast.BoolOp):
        yield "boolean", _with(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.Not)):
        yield "sign" if isinstance(node.op, ast.USub) else "boolean", f"({ast.unparse(node.operand)})"
    elif isinstance(node, ast.Constant):
        yield from _constants(node.value)
    elif isinstance(node, ast.IfExp):
        yield "condition", _with(node, body=node.orelse, orelse=node.body)
    elif isinstance(node, ast.Call):
        yield from _arguments(node)
    elif isinstance(node, ast.stmt):
        yield from _statements(node)


def _of_text(node: ast.BinOp) -> bool:
    """Whether it joins texts, or names alternatives of a type."""
    sides = (node.left, node.right)
    if any(isinstance(side, ast.JoinedStr) for side in sides):
        return True
    return any(isinstance(side, ast.Constant) and isinstance(side.value, (str, type(None))) for side in sides)


def _constants(value: object) -> Iterator[tuple[str, str]]:
    if isinstance(value, bool):
        yield "constant", str(not value)
    elif isinstance(value, int):
        yield "constant", repr(value + 1)
    elif isinstance(value, float):
        yield "constant", repr(value * 2 if value else 1.0)


def _arguments(node: ast.Call) -> Iterator[tuple[str, str]]:
    plain = [k for k, a in enumerate(node.args) if not isinstance(a, ast.Starred)]
    if len(plain) >= 2 and plain[:2] == [0, 1] and not isinstance(node.args[0], ast.JoinedStr):
        first, second, *others = node.args
        name = ast.unparse(node.func).split(".")
        alike = name[-1] in COMMUTATIVE or ".".join(name[-2:]) in COMMUTATIVE
        if ast.dump(first) != ast.dump(second) and not alike:
            yield "arguments", _with(node, args=[second, first, *others])


def _statements(node: ast.stmt) -> Iterator[tuple[str, str]]:
    if isinstance(node, ast.Return):
        if node.value is not None and not (isinstance(node.value, ast.Constant) and node.value.value is None):
            yield "return", "return None"
    elif _can_be_left_out(node):
        yield "statement", "pass"


def _can_be_left_out(node: ast.stmt) -> bool:
    """Statements without which the module still compiles and names stay bound."""
    if isinstance(node, ast.Expr):
        return isinstance(node.value, (ast.Call, ast.Yield))
    if isinstance(node, ast.Assign):
        return not isinstance(node.targets[0], (ast.Name, ast.Tuple))
    return isinstance(node, (ast.AugAssign, ast.Raise, ast.Continue, ast.Break))


def _with(node: ast.expr, **fields: object) -> str:
    changed = copy.copy(node)
    for name, value in fields.items():
        setattr(changed, name, value)
    return f"({ast.unparse(changed)})"
