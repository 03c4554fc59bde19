"""What the numbers were measured on."""

from __future__ import annotations

import os
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from benchmarks import by_c

_FEATURES = ("sse4_2", "avx", "avx2", "fma", "avx512f", "avx512dq", "avx512vl", "neon", "asimd")
_PACKAGES = ("numpy", "llvmlite", "pylinkage", "numba", "kinepy", "exudyn", "sympy", "scipy", "mpmath")


def _flags() -> list[str]:
    """Vector features of the processor, where the system tells them."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return []
    for line in lines:
        key, _, value = line.partition(":")
        if key.strip() in ("flags", "Features"):
            return [each for each in _FEATURES if each in value.split()]
    return []


def _installed(name: str) -> str | None:
    try:
        return f"{name} {version(name)}"
    except PackageNotFoundError:
        return None


def _compiler() -> str:
    gcc = by_c.compiler()
    if gcc is None:
        return "no gcc"
    return (
        "gcc " + subprocess.run([gcc, "-dumpfullversion"], check=True, capture_output=True, text=True).stdout.strip()
    )


def load() -> float:
    """Processes that wanted to run in the last minute, on average, this one too; NaN where that is not told."""
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")


def description() -> list[str]:
    """Lines for the page."""
    packages = [each for each in map(_installed, _PACKAGES) if each]
    return [
        f"{os.cpu_count()} cores, {platform.machine()}, {' '.join(_flags()) or 'vector features not told'}",
        f"{platform.system()}, Python {platform.python_version()}, {', '.join(packages)}",
        f"{_compiler()} {' '.join(by_c.FLAGS)}",
    ]
