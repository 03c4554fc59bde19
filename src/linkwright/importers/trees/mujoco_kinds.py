"""Kinds in the arrays of a MuJoCo model."""

from __future__ import annotations

from typing import Any


def is_one_of(value: Any, *kinds: Any) -> bool:
    """Whether a number of an array is one of an enumeration's kinds, which ``in`` would not see."""
    return any(bool(value == each) for each in kinds)
