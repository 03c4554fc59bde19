"""What the operating system says, in every language."""

from __future__ import annotations

import errno

from linkwright.words import has
from linkwright.words.sentence import Sentence


def reason_of(problem: Exception) -> str:
    """Why a file cannot be read or written."""
    name = errno.errorcode.get(getattr(problem, "errno", None) or 0, "")
    if has(f"system.{name}"):
        return Sentence(f"system.{name}")
    return getattr(problem, "strerror", None) or str(problem)
