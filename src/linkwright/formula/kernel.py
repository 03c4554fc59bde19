"""Kernels: functions in a small typed subset of Python, compiled to machine code.

What straight-line programs cannot say (loops that end on a condition, tables of indices, an iteration inside) is
written as plain functions with annotated arguments: ``int``, ``float``, ``Reals`` and ``Wholes`` (addresses of
doubles and of 64-bit integers; ``address + k`` is the address k entries on). Statements: assignment, ``if``,
``while``, ``for … in range``, ``break``, ``continue``, ``return``; a variable keeps the type of its first value.
``load``, ``ramp`` and ``spread`` give vectors of ``LANES`` doubles (``Vector`` between kernels), ``fetch`` gives
complex ones: entries of 2 · ``LANES`` doubles, real parts before imaginary ones; +, - and · take complex numbers,
vectors and numbers in any mixture. Python never
runs such a function; it is read, translated to LLVM's language and stored in the cache of machine code. Sums may be
reordered: results are equal to the bit on one machine, not between machines.
"""

from __future__ import annotations

import ast
import ctypes
import hashlib
import inspect
import math
import textwrap
import threading
from collections.abc import Callable, Sequence
from typing import Any

from linkwright.errors import RequestError
from linkwright.formula import machine_code
from linkwright.formula.kernel_writer import KernelWriter, annotation
from linkwright.formula.late_import import ir
from linkwright.formula.machine_code import loaded_code
from linkwright.words import _


class Vector:
    """``LANES`` doubles inside a kernel."""

    def __add__(self, other: Vector | float) -> Vector:
        raise NotImplementedError

    __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __lt__ = __gt__ = __add__

    def __neg__(self) -> Vector:
        raise NotImplementedError


class Reals:
    """Address of doubles inside a kernel."""

    def __add__(self, entries: int) -> Reals:
        raise NotImplementedError

    def __getitem__(self, index: int) -> float:
        raise NotImplementedError

    def __setitem__(self, index: int, value: float) -> None:
        raise NotImplementedError


class Wholes:
    """Address of 64-bit integers inside a kernel."""

    def __add__(self, entries: int) -> Wholes:
        raise NotImplementedError

    def __getitem__(self, index: int) -> int:
        raise NotImplementedError

    def __setitem__(self, index: int, value: int) -> None:
        raise NotImplementedError


def load(address: Reals, index: int) -> Vector:
    """The vector that begins at an entry."""
    raise NotImplementedError


def store(address: Reals, index: int, value: Vector | float) -> None:
    """Writes a vector from an entry on."""
    raise NotImplementedError


def invoke(code: int, block: Wholes) -> None:
    """Calls a compiled program by the address of its code, with a call block."""
    raise NotImplementedError


def ramp(first: int) -> Vector:
    """first, first + 1, …"""
    raise NotImplementedError


def spread(value: float) -> Vector:
    """A vector of equal numbers."""
    raise NotImplementedError


def total(value: Vector) -> float:
    """Sum of a vector's numbers."""
    raise NotImplementedError


def smallest(value: Vector) -> float:
    """The smallest of a vector's numbers."""
    raise NotImplementedError


def minimum(a: Vector, b: Vector | float) -> Vector:
    """The smaller of each two."""
    raise NotImplementedError


def maximum(a: Vector, b: Vector | float) -> Vector:
    """The greater of each two."""
    raise NotImplementedError


def root(a: Vector) -> Vector:
    """Square roots."""
    raise NotImplementedError


def marked(value: Vector, index: Vector) -> Vector:
    """Numbers from 0 with an integer below 4096 in their last bits: ordered like the numbers (to 1e-12)."""
    raise NotImplementedError


def mark_of(value: float) -> int:
    """The integer in the last bits."""
    raise NotImplementedError


class Complex:
    """``LANES`` complex numbers inside a kernel."""

    def __add__(self, other: Complex | Vector | float) -> Complex:
        raise NotImplementedError

    __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __add__

    def __neg__(self) -> Complex:
        raise NotImplementedError


def fetch(address: Reals, entry: int) -> Complex:
    """The complex numbers of an entry."""
    raise NotImplementedError


def put(address: Reals, entry: int, value: Complex) -> None:
    """Writes the complex numbers of an entry."""
    raise NotImplementedError


def inverse(value: Complex) -> Complex:
    """Reciprocals."""
    raise NotImplementedError


def square(value: Complex) -> Vector:
    """Squares of the absolute values."""
    raise NotImplementedError


def choose(test: Vector, yes: Complex, no: Complex) -> Complex:
    """``yes`` where the vectors compared keep the test, else ``no``."""
    raise NotImplementedError


class Kernels:
    """Functions of one module; the later ones may call the earlier ones.

    ``kernels(name, *arguments)`` calls one: arrays are given by their address (``array.ctypes.data``). The lock of
    the interpreter lock is released while a kernel runs. ``apart``: they are not copied into their callers, which
    takes long to compile where large ones are called in many places.
    """

    def __init__(self, functions: Sequence[Callable[..., Any]], apart: bool = False) -> None:
        self._apart = apart
        self.functions = {each.__name__: each for each in functions}
        self.trees = {name: _tree(each) for name, each in self.functions.items()}
        self._called: dict[str, Any] = {}

    def __call__(self, name: str, *arguments: float) -> Any:
        found = self._called.get(name)
        if found is None:
            found = self._called[name] = self._prototype(name)
        return found(*arguments)

    def _prototype(self, name: str) -> Any:
        kinds: dict[str | None, Any] = {"int": ctypes.c_int64, "float": ctypes.c_double, None: None}
        tree = self.trees[name]
        kinds_of_arguments = [kinds.get(annotation(each.annotation), ctypes.c_void_p) for each in tree.args.args]
        result = kinds[annotation(tree.returns)]
        return self._code().function(name, ctypes.CFUNCTYPE(result, *kinds_of_arguments))

    def _code(self) -> machine_code.Loaded:
        if not machine_code.available():
            raise RequestError(
                _(
                    "llvmlite cannot be loaded, and this runs in compiled code only; install it again",
                    code="synthesize.no_llvmlite",
                )
            )
        digest = hashlib.blake2b(b"apart" if self._apart else b"", digest_size=16)
        for name, tree in self.trees.items():
            digest.update(ast.dump(tree).encode())
            digest.update(repr(sorted(_constants(tree, self.functions[name]).items())).encode())
        first = next(iter(self.functions))
        return loaded_code(f"kernels {digest.hexdigest()}", lambda: (self.text(), 3), first)

    def text(self) -> str:
        """The module in LLVM's language, optimised."""
        module = ir.Module("kernels")
        made: dict[str, Any] = {}
        for name, tree in self.trees.items():
            made[name] = KernelWriter(module, made, _constants(tree, self.functions[name])).function(tree)
            if self._apart:
                made[name].attributes.add("noinline")
        return machine_code.optimised(str(module))


#: Python 3.11 counts the depth of a tree that it makes for all threads together, and refuses where two make one.
_parsing = threading.Lock()


def _tree(function: Callable[..., Any]) -> ast.FunctionDef:
    source = textwrap.dedent(inspect.getsource(function))
    with _parsing:
        (tree,) = ast.parse(source).body
    assert isinstance(tree, ast.FunctionDef)
    return tree


def _constants(tree: ast.FunctionDef, function: Callable[..., Any]) -> dict[str, float]:
    """Numbers of the function's module that it names."""
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    known: dict[str, Any] = function.__globals__
    return {name: known[name] for name in names if isinstance(known.get(name), (int, float))}


sqrt, sin, cos, exp, log, fabs = math.sqrt, math.sin, math.cos, math.exp, math.log, math.fabs
