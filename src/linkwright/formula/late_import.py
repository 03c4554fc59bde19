"""Modules that are imported when something of them is first used: a model is read and checked without NumPy."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as numpy  # noqa: PLC0414 (offered to others)
    from llvmlite import ir as ir  # noqa: PLC0414
else:

    class _Late(ModuleType):
        def __getattr__(self, name: str) -> Any:
            value = getattr(import_module(self.__name__), name)
            setattr(self, name, value)
            return value

    numpy, ir = _Late("numpy"), _Late("llvmlite.ir")
