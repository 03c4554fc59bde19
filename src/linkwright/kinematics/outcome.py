"""What became of each position, in a sentence; and the error for positions that cannot be reached."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.errors import LinkwrightError
from linkwright.words import _
from linkwright.words.sentence import in_language


@dataclass(frozen=True)
class Outcome:
    """Of one position: whether it is solved, and if not, the group that fails and why (in English)."""

    ok: bool
    sentence: str = _("assembled", code="outcome.assembled")
    group: str | None = None
    kind: str = "ok"

    def say(self, language: str = "en") -> str:
        """The sentence in a language."""
        return in_language(self.sentence, language)


class PositionError(LinkwrightError):
    """The mechanism cannot be in a position that was asked for.

    ``failed``: indices of the failed positions; ``outcomes``: what became of the first of them.
    """

    def __init__(self, message: str, failed: tuple[int, ...] = (), outcome: Outcome | None = None) -> None:
        super().__init__(message)
        self.failed = failed
        self.outcome = outcome
