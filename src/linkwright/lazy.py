"""Public names that are imported when they are first asked for, so that the package itself starts at once."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from importlib import import_module
from types import ModuleType
from typing import Any


def offer(package: str, public: Mapping[str, tuple[str, ...]]) -> None:
    """Makes the names of other modules attributes of a package.

    ``public``: the names by the module that has them. A subpackage of the same name as one of them
    (``linkwright.structure``) stays importable; the attribute is the public name.
    """
    home = {name: module for module, names in public.items() for name in names}

    class Offering(ModuleType):
        """The package with its offered names."""

        def __setattr__(self, name: str, value: object) -> None:
            if not (isinstance(value, ModuleType) and name in home):
                super().__setattr__(name, value)

        def __getattr__(self, name: str) -> Any:
            if name not in home:
                raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
            value = getattr(import_module(home[name]), name)
            setattr(self, name, value)
            return value

        def __dir__(self) -> list[str]:
            return sorted({*super().__dir__(), *home})

    sys.modules[package].__class__ = Offering
