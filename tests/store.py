"""Machines of the gallery, loaded and solved once for each worker: results are not changed, so tests share them."""

from __future__ import annotations

from functools import cache

import linkwright as lw


@cache
def machine(name: str) -> lw.Mechanism:
    """A mechanism of the gallery."""
    return lw.load(f"gallery:{name}")


@cache
def text(name: str) -> str:
    """The text of a gallery file."""
    return lw.read_document(f"gallery:{name}").text


@cache
def motion(name: str, steps: int = 360) -> lw.Motion:
    """The motion of a gallery machine over its cycle."""
    return lw.solve_motion(machine(name), steps=steps)


@cache
def forces(name: str, steps: int = 360) -> lw.Forces:
    """The joint forces of a gallery machine over its cycle."""
    return lw.solve_forces(motion(name, steps))


@cache
def names() -> tuple[str, ...]:
    """All files of the gallery."""
    return tuple(lw.gallery_names())
