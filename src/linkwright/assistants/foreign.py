"""Texts, files and share links of other programs, where a model is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from linkwright.assistants.folder import Folder, Source, is_text
from linkwright.core.expressions import parse_any
from linkwright.errors import RequestError, about
from linkwright.files.source import ENDINGS, GALLERY
from linkwright.importers.foreign import READERS, Foreign, ForeignText, is_own, read_foreign
from linkwright.words import _

#: What begins a text of another program, and what a share link has.
MARKUP, LINK = "<", "://"


def read_elsewhere(folder: Folder, model: str, answers: Mapping[str, str]) -> Foreign | None:
    """What is read of another program's text or file, or None where an argument means a model of ours.

    ``answers``: what the file does not say itself, by the names of :func:`linkwright.read_foreign`.
    Raises LinkwrightError where it should be of another program and no reader knows it.
    """
    given = model.strip()
    if given.startswith(GALLERY) or not (answers or _is_foreign(folder, given)):
        return None
    source: str | Path = model if is_text(given) else folder.existing(given)
    asked = {key: value for key, value in answers.items() if key != "speed" and value}
    return read_foreign(source, **asked, speed=_speed(answers.get("speed", "")))


def model_of(read: Foreign) -> Source:
    """The model that says the same, an empty text where there is none."""
    return Source(read.text, "model", "", Path())


def _is_foreign(folder: Folder, given: str) -> bool:
    """Whether a text or the name of a file is another program's."""
    if is_text(given):
        return _elsewhere(given)
    suffix = Path(given).suffix.lower()
    if suffix in ENDINGS[:2]:
        return False
    path, endings = folder.existing(given), {ending for each in READERS.values() for ending in each.suffixes}
    return suffix in endings.difference(ENDINGS) or _elsewhere(path.read_text("utf-8", errors="replace"))


def _elsewhere(text: str) -> bool:
    """Whether a text is another program's."""
    if is_own(text):
        return False
    link = LINK in text and "\n" not in text.strip()
    source = ForeignText(text, "<text>")
    return text.lstrip().startswith(MARKUP) or link or any(each.recognises(source) for each in READERS.values())


def _speed(text: str) -> float | None:
    """SI value of a speed; raises RequestError."""
    if not text:
        return None
    with about("speed", RequestError):
        return float(parse_any(text, {}).evaluate({}))


def refuse_foreign(folder: Folder, model: str) -> None:
    """Raises RequestError for a text of another program where a model of ours is needed."""
    if not model.strip().startswith(GALLERY) and _is_foreign(folder, model.strip()):
        raise RequestError(
            _(
                "this is a file of another program; check_model gives the text of the model that says the same",
                code="assistants.foreign",
            )
        )
