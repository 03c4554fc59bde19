"""The C kernels, compiled for this machine when asked for."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
FLAGS = ["-O3", "-march=native", "-mprefer-vector-width=512", "-ffast-math", "-fopenmp-simd", "-shared", "-fPIC"]
SOURCE = Path(__file__).parent / "kernels" / "calls.c"


class CallBlock(ctypes.Structure):
    """Arguments of a call: one address to hand over, as for the package's machine code."""

    _fields_ = [
        ("designs", ctypes.c_long),
        ("n", ctypes.c_long),
        ("cosine", ctypes.c_void_p),
        ("sine", ctypes.c_void_p),
        ("table", ctypes.c_void_p),
        ("out", ctypes.c_void_p),
    ]


def compiler() -> str | None:
    """The C compiler, if there is one."""
    return shutil.which("gcc")


@cache
def _library() -> ctypes.CDLL:
    gcc = compiler()
    if gcc is None:
        raise RuntimeError("no gcc on this machine, so the C kernels are left out")
    folder = Path(tempfile.mkdtemp(prefix="linkwright_benchmarks_"))
    try:
        target = folder / "kernels.so"
        subprocess.run([gcc, *FLAGS, "-o", str(target), str(SOURCE), "-lm"], check=True)
        return ctypes.CDLL(str(target))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def kernel(name: str, cosine: Floats, sine: Floats, table: Floats, out: Floats) -> Callable[[], object]:
    """A call of ``name`` (``fourbar``, ``sixbar``, ``fourbar_sweep``, ``sixbar_sweep``) on these arrays."""
    arrays = (cosine, sine, table, out)
    assert all(array.flags.c_contiguous and array.dtype == np.float64 for array in arrays)
    designs = len(table) if table.ndim == 2 else 1
    block = CallBlock(designs, len(cosine), *(array.ctypes.data for array in arrays))
    function = getattr(_library(), f"call_{name}")
    function.argtypes = [ctypes.c_size_t]
    function.restype = None
    address = ctypes.addressof(block)

    def run(kept: object = (arrays, block)) -> None:
        function(address)

    return run
