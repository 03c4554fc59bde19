"""Files that ship with the package, each with purpose and source: models, calculations, tasks."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["calculations", "content", "file", "names", "tasks"]

_SUFFIX = ".yaml"
_FOLDER = os.path.dirname(__file__)


def names() -> tuple[str, ...]:
    """Names of all models of mechanisms in alphabetical order, without the file suffix."""
    return _within()


def calculations() -> tuple[str, ...]:
    """Names of all calculations of machine parts in alphabetical order, without the file suffix."""
    return _within("parts")


def tasks() -> tuple[str, ...]:
    """Names of all tasks of synthesis in alphabetical order, without the file suffix."""
    return _within("tasks")


def file(name: str) -> Path:
    """The gallery file called ``name``.

    Raises:
        KeyError: there is no file of that name; ``names()``, ``calculations()`` and ``tasks()`` list them.
    """
    from pathlib import Path

    for folder in ("", "parts", "tasks"):
        if name in _within(folder):
            return Path(_FOLDER, folder, f"{name}{_SUFFIX}")
    raise KeyError(name)


def content(name: str) -> bytes:
    """What the file of a model, else of a task or a calculation called ``name`` holds; raises KeyError where there is
    none."""
    if name.replace("_", "").isalnum():
        for folder in ("", "tasks", "parts"):
            try:
                with open(os.path.join(_FOLDER, folder, f"{name}{_SUFFIX}"), "rb") as file:
                    return file.read()
            except OSError:  # a name that no file has, or that is too long for one
                continue
    raise KeyError(name)


def _within(folder: str = "") -> tuple[str, ...]:
    files = os.listdir(os.path.join(_FOLDER, folder))
    return tuple(sorted(name.removesuffix(_SUFFIX) for name in files if name.endswith(_SUFFIX)))
