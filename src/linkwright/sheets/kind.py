"""What a kind of sheet supplies, and the registry of the kinds.

A kind is one module of ``sheets/kinds`` with a function, registered under its name, that gives the panels for what
is drawn in the order in which they are laid out. The word ``sheet.drawing_NAME`` is the name of the drawing where
the file gives none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field

from linkwright.core.dataclass import dataclass
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.registry import Registry
from linkwright.sheets.panel import Panel
from linkwright.sheets.settings import Settings
from linkwright.words import Message, Say
from linkwright.words.sentence import Sentence


@dataclass(frozen=True)
class Subject:
    """What a sheet shows: a machine or a calculation, with the settings and the language of the sheet.

    ``of``: the part of it that is meant, such as a cam's joint; ``notes``: sentences on what the sheet lacks.
    """

    drawn: Mechanism | Problem
    settings: Settings
    language: str
    say: Say
    of: str = ""
    notes: list[str] = field(default_factory=list)

    def note(self, key: str, **values: object) -> None:
        """Notes what the sheet lacks: a sentence of the area ``sheet``."""
        self.notes.append(Sentence(f"sheet.{key}", **values).say(self.language))

    def words(self, key: str, **values: object) -> str:
        """A text of the area ``sheet``."""
        return self.say(key if isinstance(key, Message) else f"sheet.{key}", **values)


@dataclass(frozen=True)
class Content:
    """The panels of a sheet in their order; ``scale``: what the title block prints where no panel has a scale as a
    ratio."""

    panels: Sequence[Panel]
    scale: Callable[[], str] = lambda: ""


Kind = Callable[[Subject], Content]
SHEETS: Registry[Kind] = Registry("sheet_kind", "linkwright.sheets.kinds")
