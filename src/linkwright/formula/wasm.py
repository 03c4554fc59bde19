"""Programs as WebAssembly modules for browsers, by the same text that native code is made of.

Positions are taken in vectors of four numbers (two of SIMD128 at a time).
Square roots, absolute values and floors are instructions; the other functions are imported from the host
(``env.linkwright_sin`` …), as native code takes them from the C library. The only other import is the memory.
Function ``kernel`` takes the address of the program's call block (see ``ir_kernel.Block``; 64 bits per place,
addresses below 2³²).

The object for ``wasm32-unknown-unknown`` keeps its standard sections; an export section is put before the code;
custom sections (symbols, relocations) are left out. That holds for straight-line kernels: no data, no addresses of
their own and no stack, so nothing is left to be linked. Layout of modules: WebAssembly Core Specification 2.0, 5.5.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

from linkwright.errors import RequestError
from linkwright.formula.ir_kernel import ENTRY, kernel
from linkwright.formula.machine_code import module_for
from linkwright.formula.program import Lines, Program
from linkwright.words import _

_TRIPLE = "wasm32-unknown-unknown"
#: Positions in one step of a loop.
WIDTH = 4
#: Functions of a module besides its kernels: written into these, since vectors would pass between them on a stack.
_INTERNAL = re.compile(r"(?m)^(define internal .*) nounwind \{$")


def wasm_module(program: Program) -> bytes:
    """The module of a program, every output stored. Raises RequestError where llvmlite lacks the target."""
    machine = _machines()
    text, level = kernel(Lines.of(program), WIDTH, None, library=True)
    text = _INTERNAL.sub(r"\1 alwaysinline nounwind {", text.replace(f"@{ENTRY}(", "@kernel("))
    return linked(_object(text, machine[level]), {"kernel": 0})


def _object(text: str, machine: Any) -> bytes:
    import llvmlite.binding as binding

    module = module_for(binding, machine, text)
    builder = binding.create_pass_builder(machine, binding.create_pipeline_tuning_options())
    passes = binding.create_new_module_pass_manager()
    passes.add_always_inliner_pass()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, builder)
    return bytes(machine.emit_object(module))


@cache
def _machines() -> dict[int, Any]:
    """The compilers for WebAssembly by how much they optimise."""
    import llvmlite.binding as binding

    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    try:
        target = binding.Target.from_triple(_TRIPLE)
    except RuntimeError:
        raise RequestError(
            _(
                "living pages need WebAssembly, which the LLVM of this llvmlite cannot make; "
                "install the llvmlite of the package index",
                code="export.no_webassembly",
            )
        ) from None
    return {level: target.create_target_machine(opt=level, features="+simd128,+bulk-memory") for level in (0, 3)}


_HEADER = 8
_CUSTOM, _IMPORT, _EXPORT = 0, 2, 7
#: Sections that stand behind the exports: start, elements, number of data segments, code, data.
_BEHIND = frozenset({8, 9, 12, 10, 11})
_FUNCTION, _MEMORY = 0, 2


def linked(emitted: bytes, exports: Mapping[str, int]) -> bytes:
    """The module of an object file; ``exports``: numbers of the defined functions by name.

    Raises ValueError where the object needs a linker.
    """
    result = bytearray(emitted[:_HEADER])
    imported, exported = 0, False
    for kind, body in _sections(emitted):
        if kind == _IMPORT:
            imported = _imported_functions(body)
        if kind in _BEHIND and not exported:
            result += _section(_EXPORT, _exports(exports, imported))
            exported = True
        if kind != _CUSTOM:
            result += _section(kind, body)
    return bytes(result)


def _sections(module: bytes) -> Iterator[tuple[int, bytes]]:
    place = _HEADER
    while place < len(module):
        kind = module[place]
        length, start = _number(module, place + 1)
        place = start + length
        yield kind, module[start:place]


def _section(kind: int, body: bytes) -> bytes:
    return bytes([kind]) + _written(len(body)) + body


def _exports(exports: Mapping[str, int], imported: int) -> bytes:
    entries = b"".join(
        _written(len(name.encode())) + name.encode() + bytes([_FUNCTION]) + _written(imported + number)
        for name, number in exports.items()
    )
    return _written(len(exports)) + entries


def _imported_functions(body: bytes) -> int:
    """How many functions are imported; besides them only the memory may be."""
    count, place = _number(body, 0)
    found = 0
    for _import in range(count):
        for _part in range(2):
            length, place = _number(body, place)
            place += length
        kind, place = body[place], place + 1
        if kind == _FUNCTION:
            found += 1
            _, place = _number(body, place)
        elif kind == _MEMORY:
            limits, place = body[place], place + 1
            for _ in range(1 + (limits & 1)):
                _, place = _number(body, place)
        else:
            raise ValueError(f"the object imports something of kind {kind}, so it needs a linker")
    return found


def _number(data: bytes, place: int) -> tuple[int, int]:
    """An unsigned LEB128 number, and the place behind it."""
    value = shift = 0
    while True:
        byte = data[place]
        place += 1
        value |= (byte & 127) << shift
        shift += 7
        if not byte & 128:
            return value, place


def _written(value: int) -> bytes:
    out = bytearray()
    while True:
        byte, value = value & 127, value >> 7
        if not value:
            return bytes(out) + bytes([byte])
        out.append(byte | 128)
