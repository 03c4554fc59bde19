"""Programs as WebAssembly modules for browsers, by the same text that native code is made of.

Positions are taken in vectors of four numbers (two of SIMD128 at a time).
Square roots, absolute values and floors are instructions; the other functions are imported from the host
(``env.linkwright_sin`` …), as native code takes them from the C library. The only other import is the memory.
Function ``kernel`` takes the address of the program's call block (see ``ir_kernel.Block``; 64 bits per place,
addresses below 2³²).
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from linkwright.errors import RequestError
from linkwright.formula.ir_kernel import kernel
from linkwright.formula.ir_module import ENTRY
from linkwright.formula.lines import Lines
from linkwright.formula.machine_code import module_for
from linkwright.formula.program import Program
from linkwright.formula.wasm_module import linked
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
