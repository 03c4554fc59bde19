"""What a model file says about its report: section ``report``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Any

from linkwright.core.dataclass import dataclass
from linkwright.errors import RequestError
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.registry import offered
from linkwright.words import LANGUAGES

KEYS = (
    "title", "author", "course", "date", "sections", "position", "positions", "numbered_from", "fluctuation",
    "text", "errata", "purpose", "source", *LANGUAGES,
)  # fmt: skip
#: Single lines, and what can be said for one language alone.
WORDS = ("title", "author", "course", "date", "position", "purpose", "source")
OWN = (*WORDS, "text", "errata")
ERRATUM = ("where", "printed", "right", "why")
#: Most numbered positions.
MOST = 10_000


@dataclass(frozen=True)
class Erratum:
    """A mistake of the source: where, what is printed, what is right, why."""

    where: str
    printed: str
    right: str
    why: str = ""


@dataclass(frozen=True)
class Settings:
    """``sections`` in the order wanted (empty: all); ``position`` of the worked solution; ``positions`` in the
    tables (None: as many as show the cycle), numbered from ``numbered_from`` (``"rocker min"``); ``fluctuation`` δ of
    the flywheel; ``text``: own text by section, Markdown, or Typst after a first line ``typst``; ``purpose`` and
    ``source`` instead of the model's.
    """

    title: str = ""
    author: str = ""
    course: str = ""
    date: str = ""
    purpose: str = ""
    source: str = ""
    sections: tuple[str, ...] = ()
    position: str = ""
    positions: int | None = None
    numbered_from: str = ""
    fluctuation: float = FLUCTUATION
    text: Mapping[str, str] = field(default_factory=dict)
    errata: tuple[Erratum, ...] = ()


def settings(given: Mapping[str, Any], language: str = "en") -> Settings:
    """The settings of a file's ``report``; raises RequestError for what they cannot be, with its key.

    What stands under a language's own key (``zh: {title: …}``) goes before the rest in that language.
    """
    _known(given, KEYS, "report")
    for each in LANGUAGES:
        _known(_mapping(given, each), OWN, f"report.{each}")
    given = {**given, **_mapping(given, language)}
    words = {key: str(given[key]) for key in WORDS if key in given}
    return Settings(
        **words,
        sections=tuple(map(str, _sequence(given, "sections"))),
        positions=_count(given["positions"]) if "positions" in given else None,
        numbered_from=str(given.get("numbered_from", "")),
        fluctuation=_fluctuation(given.get("fluctuation", FLUCTUATION)),
        text={str(key): str(text) for key, text in _mapping(given, "text").items()},
        errata=tuple(_erratum(each, i) for i, each in enumerate(_sequence(given, "errata"))),
    )


def _known(given: Mapping[str, Any], keys: tuple[str, ...], place: str) -> None:
    for key in given:
        if key not in keys:
            raise RequestError(
                "report.unknown_key", place=f"{place}.{key}", name=key, hint=offered(str(key), keys)
            )


def _sequence(given: Mapping[str, Any], key: str) -> list[Any]:
    found = given.get(key) or []
    if not isinstance(found, list | tuple):
        raise RequestError("report.not_a_list", place=f"report.{key}")
    return list(found)


def _mapping(given: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    found = given.get(key) or {}
    if not isinstance(found, Mapping):
        raise RequestError("report.not_a_mapping", place=f"report.{key}")
    return found


def _count(value: Any) -> int:
    try:
        found = int(str(value))
    except ValueError:
        found = 0
    if not 2 <= found <= MOST:
        raise RequestError("report.bad_positions", text=str(value), most=MOST)
    return found


def _fluctuation(value: Any) -> float:
    try:
        found = float(value)
    except (TypeError, ValueError):
        found = 0.0
    if not 0.0 < found < 1.0:
        raise RequestError("report.bad_fluctuation", text=str(value))
    return found


def _erratum(each: Any, index: int) -> Erratum:
    place = f"report.errata.{index}"
    if not isinstance(each, Mapping):
        raise RequestError("report.not_a_mapping", place=place)
    _known(each, ERRATUM, place)
    for key in ERRATUM[:3]:
        if key not in each:
            raise RequestError("report.lacks", place=place, name=key)
    return Erratum(**{key: str(each[key]) for key in ERRATUM if key in each})
