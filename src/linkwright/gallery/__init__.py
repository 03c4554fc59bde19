"""Files that ship with the package, each with purpose and source: models, calculations, tasks."""

from pathlib import Path

__all__ = ["calculations", "file", "names", "tasks"]

_SUFFIX = ".yaml"
_FOLDER = Path(__file__).parent


def names() -> tuple[str, ...]:
    """Names of all models of mechanisms in alphabetical order, without the file suffix."""
    return _within(_FOLDER)


def calculations() -> tuple[str, ...]:
    """Names of all calculations of machine parts in alphabetical order, without the file suffix."""
    return _within(_FOLDER / "parts")


def tasks() -> tuple[str, ...]:
    """Names of all tasks of synthesis in alphabetical order, without the file suffix."""
    return _within(_FOLDER / "tasks")


def file(name: str) -> Path:
    """The gallery file called ``name``.

    Raises:
        KeyError: there is no file of that name; ``names()``, ``calculations()`` and ``tasks()`` list them.
    """
    if name in names():
        return _FOLDER / f"{name}{_SUFFIX}"
    if name in calculations():
        return _FOLDER / "parts" / f"{name}{_SUFFIX}"
    if name in tasks():
        return _FOLDER / "tasks" / f"{name}{_SUFFIX}"
    raise KeyError(name)


def _within(folder: Path) -> tuple[str, ...]:
    entries = (entry.name for entry in folder.iterdir())
    return tuple(sorted(entry.removesuffix(_SUFFIX) for entry in entries if entry.endswith(_SUFFIX)))
