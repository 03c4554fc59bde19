"""What is asked for a sheet, by the section ``sheet`` of a file, and the registry of the kinds of sheets.

A kind is one module of ``sheets/kinds`` with a function, registered under its name, that gives the panels for what
is drawn in the order in which they are laid out. The word ``sheet.drawing_NAME`` is the name of the drawing where
the file gives none.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, cast

from linkwright.errors import Finding, ModelError, QuantityError
from linkwright.fields.sheet import SHEET, WORDS
from linkwright.fields.tables import Keys
from linkwright.files.reader import SectionReading
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.registry import Registry
from linkwright.reports.settings import worked_place
from linkwright.sheets.layout import Panel
from linkwright.sheets.paper import Fields, Paper, Standard
from linkwright.words import Message, Translate, _


@dataclass(frozen=True)
class Subject:
    """What a sheet shows: a machine or a calculation, with the settings and the language of the sheet.

    ``of``: the part of it that is meant, such as a cam's joint; ``notes``: sentences on what the sheet lacks.
    """

    drawn: Mechanism | Problem
    settings: Settings
    language: str
    translate: Translate
    of: str = ""
    notes: list[str] = field(default_factory=list)

    def note(self, message: Message) -> None:
        """Notes what the sheet lacks."""
        self.notes.append(message.translate(self.language))

    def words(self, message: Message) -> str:
        """A text on the sheet."""
        return self.translate(message)


@dataclass(frozen=True)
class Content:
    """The panels of a sheet in their order; ``scale``: what the title block prints where no panel has a scale as a
    ratio."""

    panels: Sequence[Panel]
    scale: Callable[[], str] = lambda: ""


Kind = Callable[[Subject], Content]
SHEETS: Registry[Kind] = Registry(_("kind of sheet"), "linkwright.sheets.kinds")


#: Keys of the report's section, and of its cover, that a title block falls back on.
_OF_REPORT = {"title": "title", "student": "author", "date": "date", "faculty": "course"}
_OF_COVER = {
    "title": "title",
    "school": "school",
    "faculty": "faculty",
    "class": "class",
    "student_number": "number",
    "student": "author",
    "adviser": "adviser",
    "date": "date",
}


@dataclass(frozen=True)
class Placed:
    """What a file says of one panel: ``at`` x, y mm, ``size`` mm, ``scale`` SI per mm; None where nothing."""

    at: tuple[float, float] | None = None
    size: float | None = None
    scale: float | None = None


@dataclass(frozen=True)
class Settings:
    """The settings of a sheet; ``fields`` of its title block; ``only`` and ``leave_out``: names of panels."""

    paper: Paper
    block: str
    zones: bool
    fields: Fields
    positions: tuple[str, ...] = ()
    only: tuple[str, ...] = ()
    leave_out: tuple[str, ...] = ()
    panels: Mapping[str, Placed] = field(default_factory=dict)


def read_section(section: Mapping[str, Any]) -> dict[str, Any]:
    """The values of a section ``sheet`` by its keys, SI; raises ModelError with all findings."""
    reading = SectionReading(Keys(SHEET), "sheet", section)
    reading.settle()
    return {key: value for key, value in reading.values.items() if value is not None}


def settings(
    section: Mapping[str, Any],
    language: str,
    *,
    size: str = "",
    report: Mapping[str, Any] | None = None,
    name: str = "",
    usual: str = "A1",
) -> Settings:
    """The settings in a language; ``size`` before that of the file, ``usual`` where neither is; ``name``: of the
    machine, for a title block without a title."""
    read = read_section(section)
    paper = _paper(read, language, size or read.get("size") or usual)
    words = {**_fallback(report or {}, language), **_words(read), **(read.get(language) or {})}
    words.setdefault("title", name)
    fields = Fields(
        **{("class_name" if key == "class" else key): str(words.get(key, "")) for key in WORDS},
        sheet=read.get("sheet", 1),
        sheets=max(read.get("sheets", 1), read.get("sheet", 1)),
    )
    return Settings(
        paper,
        read.get("block") or ("short" if paper.size in ("A3", "A4") else "full"),
        bool(read.get("zones", False)),
        fields,
        tuple(read.get("positions", ())),
        tuple(read.get("only", ())),
        tuple(read.get("leave_out", ())),
        {key: _placed(each) for key, each in read.get("panels", {}).items()},
    )


def check(mechanism: Mechanism) -> None:
    """Raises ModelError for a section ``sheet`` of which a key makes no sense."""
    places(mechanism, read_section(mechanism.sheet).get("positions", ()))


def places(mechanism: Mechanism, texts: Sequence[str]) -> list[float]:
    """The inputs (rad or m), or times (s), of positions as a file gives them; none of what is at rest.

    Raises ModelError with a finding for each that is none.
    """
    found: list[float] = []
    wrong: list[Finding] = []
    for number, text in enumerate(texts):
        try:
            place = worked_place(mechanism, text)
        except QuantityError as error:
            key = f"sheet.positions.{number}"
            wrong.append(Finding("error", "", key, error.message, error.remedy, error.code))
            continue
        found += [] if place is None else [place]
    if wrong:
        raise ModelError(wrong)
    return found


def _paper(section: Mapping[str, Any], language: str, size: str) -> Paper:
    upright = section.get("orientation", "portrait" if size == "A4" else "landscape") == "portrait"
    standard = cast(Standard, section.get("standard") or ("gb" if language == "zh" else "iso"))
    return Paper(size, upright, standard, section.get("binding", True))


def _words(section: Mapping[str, Any]) -> dict[str, str]:
    return {key: section[key] for key in WORDS if key in section}


def _fallback(report: Mapping[str, Any], language: str) -> dict[str, str]:
    """What the section ``report`` and its cover tell, the language's own before the rest."""
    found: dict[str, str] = {}
    for section in (report, report.get(language)):
        if isinstance(section, Mapping):
            found |= _plain(section, _OF_REPORT)
            cover = section.get("cover")
            if isinstance(cover, Mapping):
                found |= _plain(cover, _OF_COVER)
                if isinstance(own := cover.get(language), Mapping):
                    found |= _plain(own, _OF_COVER)
    return found


def _plain(section: Mapping[str, Any], keys: Mapping[str, str]) -> dict[str, str]:
    texts = {key: section.get(name) for key, name in keys.items()}
    return {key: str(text) for key, text in texts.items() if isinstance(text, str | int | float)}


def _placed(values: Mapping[str, Any]) -> Placed:
    at = values.get("at")
    return Placed(
        None if at is None else (1e3 * at[0], 1e3 * at[1]),
        None if values.get("size") is None else 1e3 * values["size"],
        values.get("scale"),
    )
