"""Public names that are imported when they are first asked for, so that the package itself starts at once."""

from __future__ import annotations

import sys
from types import ModuleType

TYPE_CHECKING = (
    False  # type checkers take it for true; nothing is imported before the first name is asked for
)
if TYPE_CHECKING:
    from collections.abc import Mapping
    from inspect import Signature
    from typing import Any


def offer(package: str, public: Mapping[str, tuple[str, ...]]) -> None:
    """Makes the names of other modules attributes of a package.

    ``public``: the names by the module that has them. Where a function has the name of a subpackage
    (``linkwright.structure``), the attribute is the subpackage, and calling it calls the function: both
    ``linkwright.structure(mechanism)`` and ``linkwright.structure.Group`` work, however either was imported.
    A plain module of the same name stays importable; the attribute is the public name. Other subpackages
    (``linkwright.parts``) are imported when they are first used.
    """
    home = {name: module for module, names in public.items() for name in names}

    class Offering(ModuleType):
        """The package with its offered names."""

        def __setattr__(self, name: str, value: object) -> None:
            if isinstance(value, ModuleType) and name in home:
                if not hasattr(value, "__path__"):
                    return
                _make_callable(value, home[name], name)
            super().__setattr__(name, value)

        def __getattr__(self, name: str) -> Any:
            if name == "__all__":
                return sorted(home)
            if name not in home and not name.startswith("_") and _is_package(f"{package}.{name}"):
                return import_module(f"{package}.{name}")
            if name not in home:
                raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
            if _is_package(f"{package}.{name}"):
                return import_module(f"{package}.{name}")
            value = getattr(import_module(home[name]), name)
            setattr(self, name, value)
            return value

        def __dir__(self) -> list[str]:
            return sorted({*super().__dir__(), *home})

    sys.modules[package].__class__ = Offering


def import_module(name: str) -> ModuleType:
    """The module of a name."""
    from importlib import import_module as by_name

    return by_name(name)


def _is_package(name: str) -> bool:
    from importlib.util import find_spec

    found = find_spec(name)
    return found is not None and found.submodule_search_locations is not None


def _make_callable(module: ModuleType, home: str, name: str) -> None:
    """Lets a subpackage be called as the function of its name."""

    class Callable(type(module)):  # type: ignore[misc]
        """A package that is called as its function."""

        def __call__(self, *arguments: Any, **options: Any) -> Any:
            return getattr(import_module(home), name)(*arguments, **options)

        @property
        def __signature__(self) -> Signature:
            from inspect import signature

            return signature(getattr(import_module(home), name))

    module.__class__ = Callable
