"""NumPy, imported when something of it is first used: a model is read and checked without it."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as numpy  # noqa: PLC0414 (offered to others)
else:

    class _Late(ModuleType):
        def __getattr__(self, name: str) -> Any:
            import numpy

            value = getattr(numpy, name)
            setattr(self, name, value)
            return value

    numpy = _Late("numpy")
