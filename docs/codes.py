"""The codes of findings and errors, collected from the calls that create them."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TypeGuard

import linkwright
from linkwright.words import code_meanings

AREAS, MEANINGS = code_meanings.AREAS, code_meanings.MEANINGS
SOURCE = Path(linkwright.__file__).parent
#: Index of the code among the arguments of calls that report a finding.
PLACES = {
    "Saying": 0,
    "Refused": 3,
    "Finding": 5,
    "finding": 3,
    "error": 4,
    "remark": 3,
    "Remark": 4,
    "_remarks": 4,
    "_refuse": 3,
    "add": 3,
    "_wrong": 2,
    "wrong": 2,
    "ExpressionError": 4,
    "note": 2,
}
SHORT = re.compile(r"[a-z]+(?:-[a-z]+)*")


@cache
def nodes() -> tuple[tuple[str, ast.AST], ...]:
    """Calls, assignments and declarations of the package, each with the path of its module."""
    return tuple(
        (path.relative_to(SOURCE).as_posix(), node)
        for path in sorted(SOURCE.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Call | ast.Assign | ast.ClassDef | ast.arguments)
    )


def called(node: ast.Call) -> str:
    """The name of a function that is called."""
    return getattr(node.func, "id", getattr(node.func, "attr", ""))


def texts(node: ast.AST | None) -> Iterator[str]:
    """The possible texts of an expression: constants, either side of a condition, entries of tuples."""
    match node:
        case ast.Constant(value=str(text)):
            yield text
        case ast.IfExp(body=one, orelse=other):
            yield from (*texts(one), *texts(other))
        case ast.Tuple(elts=each):
            for inner in each:
                yield from texts(inner)


# findings ---------------------------------------------------------------------------------------
@cache
def of_findings() -> frozenset[str]:
    """The codes of findings about files."""
    return frozenset(code for _path, node in nodes() for code in _noted(node) if SHORT.fullmatch(code))


def _noted(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.Call(args=given, keywords=named):
            place = PLACES.get(called(node), 99)
            if given and any(isinstance(each, ast.Starred) for each in given) and place < 99:
                yield from texts(given[-1])
            elif len(given) > place:
                yield from texts(given[place])
            elif called(node) in ("wrong", "_wrong") and len(given) == 2:
                yield from (text.replace("_", "-") for text in texts(given[1]))
            yield from (text for each in named if each.arg == "code" for text in texts(each.value))
        case ast.Assign(targets=[ast.Name(id="_REFUSED")], value=ast.Dict(values=rows)):
            yield from (text for row in rows if isinstance(row, ast.Tuple) for text in texts(row.elts[-1]))
        case ast.Assign(targets=[target], value=value) if "code" in map(_name, ast.walk(target)):
            yield from texts(value)
        case ast.arguments(args=given, kwonlyargs=only):
            defaults = zip(reversed(given), reversed(node.defaults), strict=False)
            for each, value in (*defaults, *zip(only, node.kw_defaults, strict=True)):
                yield from texts(value) if each.arg == "code" else ()


def _name(node: ast.AST) -> str:
    return node.id if isinstance(node, ast.Name) else ""


def of_calculations() -> dict[str, str]:
    """The codes of findings about calculations and motion programs, with their English sentences."""
    found = {}
    for path, node in nodes():
        match node:
            case ast.Call(args=[ast.Constant(value=str(code)), _key, sentence, _remedy]):
                if called(node) == "fault" and isinstance(message := _resolved(sentence, path), ast.Call):
                    found[code] = next(texts(message.args[-1]))
    return found


@cache
def _constants() -> dict[tuple[str, str], ast.expr]:
    """What is assigned to names of capitals, by module and name; of public names by the name alone as well."""
    found: dict[tuple[str, str], ast.expr] = {}
    for path, node in nodes():
        match node:
            case ast.Assign(targets=[ast.Name(id=name)], value=value) if name.isupper():
                found[path, name] = value
                if not name.startswith("_"):
                    found["", name] = value
    return found


def _resolved(node: ast.AST, path: str) -> ast.AST:
    """The message of a constant; other expressions unchanged."""
    name = _name(node)
    return _constants().get((path, name), _constants().get(("", name), node)) if name else node


# errors -----------------------------------------------------------------------------------------
def of_errors() -> dict[str, list[str]]:
    """Codes of errors that are raised literally, by their areas."""
    found: dict[str, set[str]] = {area: set() for area in AREAS}
    for path, node in nodes():
        for key in _codes_within(node.args[0], path) if _raises(node) and node.args else ():
            if key.partition(".")[0] in AREAS:
                found[key.partition(".")[0]].add(key)
    return {area: sorted(each) for area, each in sorted(found.items())}


def _codes_within(node: ast.AST, path: str) -> Iterator[str]:
    for each in ast.walk(node):
        if isinstance(each, ast.Name) and (message := _resolved(each, path)) is not each:
            yield from _codes_within(message, path)
        if isinstance(each, ast.keyword) and each.arg == "code":
            yield from texts(each.value)


def _raises(node: ast.AST) -> TypeGuard[ast.Call]:
    return isinstance(node, ast.Call) and called(node) in classes()


@cache
def classes() -> frozenset[str]:
    """The names of error classes whose code is that of their message."""
    bases = {node.name: [_name(each) for each in node.bases] for _, node in nodes() if isinstance(node, ast.ClassDef)}
    found = {"LinkwrightError"}
    while more := {name for name, own in bases.items() if found.intersection(own)} - found:
        found |= more
    return frozenset(found - {"ModelError", "QuantityError", "ExpressionError"})
