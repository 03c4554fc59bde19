"""LLVM through llvmlite: from text to object code to a callable address, in memory and in the user's cache folder.

The folder is ``LINKWRIGHT_CACHE`` where set (``off``: no folder), else ``linkwright`` in the
user's cache folder (``XDG_CACHE_HOME``, ``~/.cache``; on Windows ``LOCALAPPDATA``, on macOS
``~/Library/Caches``), made with mode 0700. A folder of another user, or one that others may
write, is not used. A file counts where its header is that of this machine and version and its
checksum fits; anything else is ignored and written anew.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import os
import sys
import tempfile
import threading
import warnings
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from linkwright.formula.operations import FUNCTIONS
from linkwright.words import _

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


_IN_MEMORY = 128
#: Size limit of all files together, bytes; beyond it the oldest by use are removed.
SIZE_LIMIT = 64 * 1024 * 1024
_DIGEST = 32
_SUFFIX = ".lwcode"
_SOURCES = ("ir_*.py", "kernel*.py", "operations.py", "table.py", "program.py", "reductions.py", "machine_code.py")

_memory: OrderedDict[str, Loaded] = OrderedDict()
_lock = threading.RLock()


def loaded_code(key: str, text: Callable[[], tuple[str, int]], entry: str) -> Loaded:
    """Code for ``key``: from memory, from the folder, or compiled from ``text()``, a module and a level."""
    place = f"{host().description} {key}"
    with _lock:
        if place in _memory:
            _memory.move_to_end(place)
            return _memory[place]
        loaded = _from_folder(key, entry)
        if loaded is None:
            code = object_code(*text())
            loaded = Loaded(code, entry)
            with suppress(OSError):
                _write(key, code)
        _memory[place] = loaded
        while len(_memory) > _IN_MEMORY:
            _memory.popitem(last=False)
        return loaded


def forget() -> None:
    """Empty the memory; the folder stays."""
    with _lock:
        _memory.clear()


def folder() -> Path | None:
    """The folder of cached machine code, or None where it is not cached."""
    chosen = os.environ.get("LINKWRIGHT_CACHE")
    if chosen is not None:
        return None if chosen.lower() in ("off", "") else Path(chosen)
    if os.environ.get("XDG_CACHE_HOME"):
        base = Path(os.environ["XDG_CACHE_HOME"])
    elif sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path.home() / ".cache"
    return base / "linkwright"


@cache
def _stamp() -> str:
    """Digest of everything in this package that decides the code."""
    digest = hashlib.blake2b(digest_size=16)
    here = Path(__file__).parent
    for pattern in _SOURCES:
        for path in sorted(here.glob(pattern)):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def _header(key: str) -> bytes:
    return f"linkwright machine code\n{_stamp()}\n{host().description}\n{key}\n".encode()


def _path(base: Path, key: str) -> Path:
    return base / (hashlib.blake2b(_header(key), digest_size=20).hexdigest() + _SUFFIX)


def _from_folder(key: str, entry: str) -> Loaded | None:
    with suppress(OSError, RuntimeError, ValueError):
        code = _read(key)
        if code is not None:
            return Loaded(code, entry)
    return None


def _read(key: str) -> bytes | None:
    base = folder()
    if base is None or not base.is_dir() or not _private(base):
        return None
    path = _path(base, key)
    data, header = path.read_bytes(), _header(key)
    code = data[len(header) + _DIGEST :]
    if not code or not data.startswith(header + _checksum(code)):
        return None
    with suppress(OSError):
        os.utime(path)
    return code


def _write(key: str, code: bytes) -> None:
    base = folder()
    if base is None:
        return
    base.mkdir(parents=True, exist_ok=True, mode=0o700)
    if _private(base):
        _replace(_path(base, key), _header(key) + _checksum(code) + code)
        _remove_oldest(base)


def _checksum(code: bytes) -> bytes:
    return hashlib.blake2b(code, digest_size=_DIGEST).digest()


def _replace(path: Path, data: bytes) -> None:
    """Write to a temporary file, then rename, so that no reader sees half a file."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=_SUFFIX)  # mode 0600
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.replace(name, path)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise


def _private(base: Path) -> bool:
    """Whether a folder is the user's and nobody else may write in it; warns where not."""
    if sys.platform == "win32":
        return True
    status = base.stat()
    if status.st_uid == os.getuid() and not status.st_mode & 0o022:
        return True
    warnings.warn(
        _(
            "the cache folder {folder} belongs to another user or others may write in it, so compiled code "
            "is not cached; make it yours with mode 0700, or name another one in LINKWRIGHT_CACHE",
            folder=base,
        ),
        RuntimeWarning,
        stacklevel=2,
    )
    return False


def _remove_oldest(base: Path) -> None:
    files = [(path, path.stat()) for path in base.glob(f"*{_SUFFIX}")]
    total = sum(status.st_size for _, status in files)
    for path, status in sorted(files, key=lambda entry: entry[1].st_mtime):
        if total <= SIZE_LIMIT:
            return
        path.unlink(missing_ok=True)
        total -= status.st_size
