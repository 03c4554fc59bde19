"""Elements that a test registers, as a package of somebody would, and takes away again."""

from typing import Any


def taken_away(registry: Any, *names: str) -> None:
    """Registries have no way back: what is registered stays for the life of a program, but not of a test."""
    for name in names:
        del registry._elements[name]
