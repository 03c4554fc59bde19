"""Public names that are imported when they are first asked for, so that the package itself starts at once."""

from __future__ import annotations

import sys
from types import ModuleType

TYPE_CHECKING = (
    False  # type checkers take it for true; nothing is imported before the first name is asked for
)
if TYPE_CHECKING:
    from inspect import Signature
    from typing import Any


def offer(package: str) -> dict[str, tuple[str, ...]]:
    """Makes the names that a package imports for type checkers its attributes; returns them by their modules.

    They stand in the package's source as ``from module import name as name``, the form in which a type checker takes
    a name for public, and nowhere else. Where a function has the name of a subpackage
    (``linkwright.structure``), the attribute is the subpackage, and calling it calls the function: both
    ``linkwright.structure(mechanism)`` and ``linkwright.topology.Group`` work, however either was imported.
    A plain module of the same name stays importable; the attribute is the public name. Other subpackages
    (``linkwright.parts``) are imported when they are first used.
    """
    home = _imported(package)

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
    modules = dict.fromkeys(home.values())
    return {module: tuple(name for name in home if home[name] == module) for module in modules}


def _imported(package: str) -> dict[str, str]:
    """The modules of the names in the lines ``from module import name as name`` of a package's source."""
    module = sys.modules[package]
    assert module.__file__ is not None and module.__spec__ is not None
    source = module.__spec__.loader.get_data(module.__file__).decode()  # type: ignore[union-attr]
    lines = [line.split() for line in source.splitlines() if line.lstrip().startswith("from ")]
    return {words[-1]: words[1] for words in lines if words[4:5] == ["as"]}


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
