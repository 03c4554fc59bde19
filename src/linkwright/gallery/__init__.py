"""Files that ship with the package, each with purpose and source: models, calculations, tasks."""

from importlib.resources import files
from importlib.resources.abc import Traversable

__all__ = ["calculations", "file", "names", "tasks"]

_SUFFIX = ".yaml"


def names() -> tuple[str, ...]:
    """Names of all models of mechanisms in alphabetical order, without the file suffix."""
    return _within(files(__name__))


def calculations() -> tuple[str, ...]:
    """Names of all calculations of machine parts in alphabetical order, without the file suffix."""
    return _within(files(__name__) / "parts")


def tasks() -> tuple[str, ...]:
    """Names of all tasks of synthesis in alphabetical order, without the file suffix."""
    return _within(files(__name__) / "tasks")


def file(name: str) -> Traversable:
    """The gallery file called ``name``.

    Raises:
        KeyError: there is no file of that name; ``names()``, ``calculations()`` and ``tasks()`` list them.
    """
    if name in names():
        return files(__name__) / f"{name}{_SUFFIX}"
    if name in calculations():
        return files(__name__) / "parts" / f"{name}{_SUFFIX}"
    if name in tasks():
        return files(__name__) / "tasks" / f"{name}{_SUFFIX}"
    raise KeyError(name)


def _within(folder: Traversable) -> tuple[str, ...]:
    entries = (entry.name for entry in folder.iterdir())
    return tuple(sorted(entry.removesuffix(_SUFFIX) for entry in entries if entry.endswith(_SUFFIX)))
