"""LLVM through llvmlite: from text to object code to a callable address. Imported on need."""

from __future__ import annotations

import ctypes
import importlib.util
import sys
import threading
from dataclasses import dataclass
from functools import cache
from typing import Any

from linkwright.formula.functions import FUNCTIONS

_LOCK = threading.RLock()
OF_ONE_ADDRESS = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
_DESCRIPTION = "cpu {cpu} features {features} llvm {version} llvmlite {binding}"


@cache
def available() -> bool:
    """Whether programs can be compiled on this machine."""
    if importlib.util.find_spec("llvmlite") is None:
        return False
    try:
        _binding()
    except (ImportError, OSError, RuntimeError):
        return False
    return True


@dataclass(frozen=True, slots=True)
class Host:
    """This machine's processor and compiler: code made for one is not valid for another."""

    cpu: str
    features: str
    width: int
    description: str


@cache
def host() -> Host:
    """The processor of this machine; ``width``: numbers in one vector."""
    import llvmlite

    binding = _binding()
    cpu, flags = binding.get_host_cpu_name(), binding.get_host_cpu_features()
    features = flags.flatten()
    width = 8 if flags.get("avx512f") else 4 if flags.get("avx2") else 2
    description = _DESCRIPTION.format(
        cpu=cpu, features=features, version=binding.llvm_version_info, binding=llvmlite.__version__
    )
    return Host(cpu, features, width, description)


@cache
def _binding() -> Any:
    import llvmlite.binding as binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    binding.parse_assembly("declare void @probe(ptr)")  # LLVM before 17 may not know opaque pointers
    library = ctypes.CDLL("ucrtbase") if sys.platform == "win32" else ctypes.CDLL(None)
    for function in FUNCTIONS.values():
        if function.library:
            address = ctypes.cast(getattr(library, function.library), ctypes.c_void_p).value
            binding.add_symbol(f"linkwright_{function.library}", address)
    return binding


def _target_machine(level: int = 3) -> Any:
    here = host()
    target = _binding().Target.from_default_triple()
    return target.create_target_machine(
        cpu=here.cpu, features=here.features, opt=level, reloc="default", codemodel="jitdefault", jit=True
    )


def object_code(text: str, level: int = 3) -> bytes:
    """Object code of a module; ``level``: how much the compiler optimises, 0 to 3."""
    with _LOCK:
        machine = _target_machine(level)
        return bytes(machine.emit_object(module_for(_binding(), machine, text)))


def module_for(binding: Any, machine: Any, text: str) -> Any:
    """A module to be compiled for a machine."""
    module = binding.parse_assembly(text)
    module.triple = machine.triple
    module.data_layout = str(machine.target_data)
    return module


def optimised(text: str) -> str:
    """A module after LLVM's own passes: for text written with variables in memory and calls."""
    with _LOCK:
        binding = _binding()
        machine = _target_machine()
        module = module_for(binding, machine, text)
        options = binding.create_pipeline_tuning_options(speed_level=3)
        passes = binding.create_pass_builder(machine, options)
        passes.getModulePassManager().run(module, passes)
        return str(module)


class Loaded:
    """Object code in memory; stays while this object or one of its functions lives."""

    def __init__(self, code: bytes, entry: str) -> None:
        with _LOCK:
            binding = _binding()
            self._engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _target_machine())
            self._engine.add_object_file(binding.ObjectFileRef.from_data(code))
            self._engine.finalize_object()
        self.function(entry)

    def function(self, entry: str, kind: Any = OF_ONE_ADDRESS) -> Any:
        """A function of the code, of one address unless ``kind`` is another; the code lives as long as it.

        It gives the lock of the interpreter back while it runs. Raises RuntimeError where the code has none.
        """
        address = self._engine.get_function_address(entry)
        if not address:
            raise RuntimeError(f"the object code has no function {entry}")
        found = kind(address)
        found.code = self
        return found
