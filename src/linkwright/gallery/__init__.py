"""Model files that ship with the package, each with purpose, source and expected numbers."""

from importlib.resources import files
from importlib.resources.abc import Traversable

__all__ = ["file", "names"]

_SUFFIX = ".yaml"


def names() -> tuple[str, ...]:
    """Names of all gallery models in alphabetical order, without the file suffix."""
    entries = (entry.name for entry in files(__name__).iterdir())
    return tuple(sorted(entry.removesuffix(_SUFFIX) for entry in entries if entry.endswith(_SUFFIX)))


def file(name: str) -> Traversable:
    """The gallery file called ``name``.

    Raises:
        KeyError: there is no gallery model of that name; ``names()`` lists those that exist.
    """
    if name not in names():
        raise KeyError(name)
    return files(__name__) / f"{name}{_SUFFIX}"
