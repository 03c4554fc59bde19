"""What a model file says about its report: section ``report``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import field
from typing import TYPE_CHECKING, Any

from linkwright.core.dataclass import dataclass
from linkwright.core.expressions import amount
from linkwright.errors import Finding, LinkwrightError, ModelError, QuantityError, RequestError
from linkwright.events.position_list import PositionList, known_outputs, of_value
from linkwright.files.write import flow
from linkwright.kinematics.names import place_meant
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import listed, offered
from linkwright.words import LANGUAGES
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.report.markdown import Beside

KEYS = (
    "title", "author", "course", "date", "sections", "position", "positions", "numbered_from", "fluctuation",
    "text", "errata", "purpose", "source", "cover", "references", *LANGUAGES,
)  # fmt: skip
#: Single lines, and what can be said for one language alone.
WORDS = ("title", "author", "course", "date", "position", "purpose", "source")
OWN = (*WORDS, "text", "errata", "sections", "cover", "references")
CHAPTER = ("title", "text", "label")
#: Lines of a cover, in their order; those of a row each, ``fields`` behind them.
COVER_ROWS = ("faculty", "major", "class", "author", "student_number", "adviser")
COVER = ("school", "kind", "logo", *COVER_ROWS, "fields", "date")
#: What a list of sections can name beside these: all that are not named, and calculations among the files.
BESIDE_SECTIONS = ("rest", "calculations")
REFERENCE = ("key", "text")
ERRATUM = ("where", "printed", "right", "why")
#: Limits of an output that numbers can begin at.
LIMITS = ("min", "max")
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
class Chapter:
    """A chapter of the user's own: title and text, Markdown, or Typst after a first line ``typst``; ``label``: the
    name by which texts refer to it."""

    title: str
    text: str
    label: str = ""


@dataclass(frozen=True)
class CoverWords:
    """What the cover says: school, kind of document, ``rows`` of key or own name and value, date; ``logo``: SVG."""

    school: str = ""
    kind: str = ""
    date: str = ""
    logo: str = ""
    rows: tuple[tuple[str, str], ...] = ()
    fields: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Settings:
    """``sections`` and own chapters in the order wanted (empty: all sections); ``position`` of the worked solution;
    ``positions`` in the tables (those that are listed, or so many, numbered from ``numbered_from``, ``"rocker min"``;
    None: as many as show the cycle); ``fluctuation`` δ of the flywheel; ``text``: own text by section, Markdown, or
    Typst after a first line ``typst``; ``purpose`` and ``source`` instead of the model's; ``cover``: of its own page,
    None without one; ``references``: own sources by the name by which texts cite them; ``folder``: where pictures
    lie.
    """

    title: str = ""
    author: str = ""
    course: str = ""
    date: str = ""
    purpose: str = ""
    source: str = ""
    sections: tuple[str | Chapter, ...] = ()
    position: str = ""
    positions: int | PositionList | None = None
    numbered_from: str = ""
    fluctuation: float = FLUCTUATION
    text: Mapping[str, str] = field(default_factory=dict)
    errata: tuple[Erratum, ...] = ()
    cover: CoverWords | None = None
    references: Mapping[str, str] = field(default_factory=dict)
    folder: str = ""

    @property
    def beside(self) -> Beside:
        """What own texts refer to."""
        from linkwright.report.markdown import Beside

        return Beside(self.folder, self.references)


def settings(
    given: Mapping[str, Any],
    language: str = "en",
    mechanism: Mechanism | None = None,
    folder: str = "",
) -> Settings:
    """The settings of a file's ``report``, of a ``mechanism`` where what they name can be looked for in it.

    Pictures that they name lie in ``folder``.

    What stands under a language's own key (``zh: {title: …}``) goes before the rest in that language. Raises
    ModelError with all findings.
    """
    reading = _Reading(given, mechanism, folder)
    for each in LANGUAGES:
        if each != language:
            reading.all_of({**given, **reading.mapping(given, each)}, each)
    found = reading.all_of({**given, **reading.mapping(given, language)}, language)
    if reading.findings:
        raise ModelError([*reading.findings])
    return found


def worked_place(mechanism: Mechanism, position: str) -> float | None:
    """The input (rad or m) or time (s) of a worked position, None where none is asked for; raises QuantityError."""
    if not position or not mechanism.drivers:
        return None
    if not mechanism.steady:
        return amount(position, "time")
    return amount(position, mechanism.across)


class _Reading:
    """Reads the settings and collects what is wrong with them, each once."""

    def __init__(self, given: Mapping[str, Any], mechanism: Mechanism | None, folder: str) -> None:
        self.given, self.mechanism, self.folder = given, mechanism, folder
        self.findings: dict[Finding, None] = {}
        self.known(given, KEYS, "report")
        for each in LANGUAGES:
            self.known(self.mapping(given, each), OWN, f"report.{each}")

    def all_of(self, given: Mapping[str, Any], language: str) -> Settings:
        """The settings in a language; ``given``: with the texts of that language."""
        own = self.mapping(self.given, language)
        places = {key: f"report.{language}.{key}" if key in own else f"report.{key}" for key in KEYS}
        words = {key: self.text(given[key], places[key]) for key in WORDS if key in given}
        numbered_from = self.text(given.get("numbered_from", ""), "report.numbered_from")
        references = self.references(given, places["references"])
        sections = tuple(
            self.chapter(each, f"{places['sections']}.{i}", references)
            for i, each in enumerate(self.sequence(given, "sections"))
        )
        self.position(words.get("position", ""), places["position"])
        self.numbered(numbered_from)
        return Settings(
            **words,
            sections=sections,
            positions=self.positions(given["positions"]) if "positions" in given else None,
            numbered_from=numbered_from,
            fluctuation=self.fluctuation(given.get("fluctuation", FLUCTUATION)),
            text=self.texts(given, places["text"], references),
            cover=self.cover(given, places["cover"], words),
            references=references,
            folder=self.folder,
            errata=tuple(
                self.erratum(each, f"{places['errata']}.{i}")
                for i, each in enumerate(self.sequence(given, "errata"))
            ),
        )

    def wrong(self, place: str, key: str, code: str = "", **values: object) -> None:
        """Notes what is wrong at a place: the sentence ``report.KEY``, by the same word as its code unless given."""
        told = Sentence(f"report.{key}", **values)
        self.findings[Finding("error", "", place, told, code=code or key.replace("_", "-"))] = None

    def known(self, given: Mapping[str, Any], keys: tuple[str, ...], place: str) -> None:
        for key in given:
            if key not in keys:
                self.wrong(f"{place}.{key}", "unknown_key", name=key, hint=offered(str(key), keys))

    def sequence(self, given: Mapping[str, Any], key: str) -> list[Any]:
        found = given.get(key) or []
        if isinstance(found, list | tuple):
            return list(found)
        self.wrong(f"report.{key}", "not_a_list")
        return []

    def mapping(self, given: Mapping[str, Any], key: str) -> Mapping[str, Any]:
        found = given.get(key) or {}
        if isinstance(found, Mapping):
            return found
        self.wrong(f"report.{key}", "not_a_mapping")
        return {}

    def text(self, value: Any, place: str) -> str:
        if not isinstance(value, Mapping | list | tuple):
            return str(value)
        self.wrong(place, "not_a_position" if place.endswith(".position") else "not_a_text")
        return ""

    def texts(self, given: Mapping[str, Any], place: str, sources: Mapping[str, str]) -> dict[str, str]:
        """Own text by the name of a section."""
        found = self.mapping(given, "text")
        for name in found:
            self.section(str(name), f"{place}.{name}")
        return {str(name): self.own(text, f"{place}.{name}", sources) for name, text in found.items()}

    def own(self, value: Any, place: str, sources: Mapping[str, str]) -> str:
        """An own text; files and sources that it names must be there."""
        from linkwright.report.markdown import Beside, own_text

        text, beside = self.text(value, place), Beside(self.folder, sources)
        try:
            faults = [each for _, faults in own_text(text, beside=beside) for each in faults if each.code]
        except LinkwrightError:
            return text
        for fault in faults:
            self.findings[Finding("error", "", place, fault.sentence, code=fault.code)] = None
        return text

    def chapter(self, each: Any, place: str, sources: Mapping[str, str]) -> str | Chapter:
        """A section's name, or an own chapter."""
        if not isinstance(each, Mapping):
            self.section(name := self.text(each, place), place, *BESIDE_SECTIONS)
            return name
        self.known(each, CHAPTER, place)
        for key in CHAPTER[:2]:
            if key not in each:
                self.wrong(place, "lacks", "missing-key", name=key)
        title, label = (self.text(each.get(key, ""), f"{place}.{key}") for key in ("title", "label"))
        return Chapter(title, self.own(each.get("text", ""), f"{place}.text", sources), label)

    def section(self, name: str, place: str, *more: str) -> None:
        from linkwright.report.section import section_names

        if name not in (known := [*section_names(), *more]):
            self.wrong(place, "no_section", name=name, hint=listed(name, known))

    def references(self, given: Mapping[str, Any], place: str) -> dict[str, str]:
        """Own sources, by their key or, without one, by themselves."""
        found: dict[str, str] = {}
        for i, each in enumerate(self.sequence(given, "references")):
            if not isinstance(each, Mapping):
                text = self.text(each, f"{place}.{i}")
                found[text] = text
                continue
            self.known(each, REFERENCE, f"{place}.{i}")
            for key in REFERENCE:
                if key not in each:
                    self.wrong(f"{place}.{i}", "lacks", "missing-key", name=key)
            key, text = (self.text(each.get(key, ""), f"{place}.{i}.{key}") for key in REFERENCE)
            if key in found:
                self.wrong(f"{place}.{i}", "source_twice", name=key)
            found[key] = text
        return found

    def cover(self, given: Mapping[str, Any], place: str, words: Mapping[str, str]) -> CoverWords | None:
        """The cover; author and date are those of the report where it names no others."""
        if "cover" not in given or given["cover"] is False:
            return None
        found = {} if given["cover"] in (True, None) else given["cover"]
        if not isinstance(found, Mapping):
            self.wrong(place, "not_a_mapping")
            return None
        self.known(found, COVER, place)
        own = {
            key: self.text(found[key], f"{place}.{key}") for key in COVER if key in found and key != "fields"
        }
        fields = found.get("fields") or {}
        if not isinstance(fields, Mapping):
            self.wrong(f"{place}.fields", "not_a_mapping")
            fields = {}
        own = {"author": words.get("author", ""), "date": words.get("date", ""), **own}
        return CoverWords(
            own.get("school", ""),
            own.get("kind", ""),
            own["date"],
            self.logo(own.get("logo", ""), f"{place}.logo"),
            tuple((key, own[key]) for key in COVER_ROWS if own.get(key)),
            tuple(
                (str(name), self.text("" if value is None else value, f"{place}.fields.{name}"))
                for name, value in fields.items()
            ),
        )

    def logo(self, name: str, place: str) -> str:
        """The picture of a cover, SVG."""
        from linkwright.report.pictures import picture_of

        try:
            return picture_of(name, self.folder).svg if name else ""
        except LinkwrightError as error:
            self.findings[Finding("error", "", place, error.sentence, code="wrong-picture")] = None
            return ""

    def position(self, text: str, place: str) -> None:
        try:
            _ = self.mechanism and worked_place(self.mechanism, text)
        except QuantityError as error:
            self.findings[Finding("error", "", place, error.message, error.remedy, error.code)] = None

    def numbered(self, text: str) -> None:
        """An output with the limit at which the numbers begin."""
        name, _, limit = text.partition(" ")
        if limit not in ("", *LIMITS):
            self.wrong("report.numbered_from", "no_limit", text=text, limit=limit, name=name)
        elif name and self.mechanism is not None:
            try:
                place_meant(self.mechanism, name)
            except RequestError as error:
                place = "report.numbered_from"
                self.findings[Finding("error", "", place, error.sentence, code=error.code)] = None

    def positions(self, value: Any) -> int | PositionList | None:
        """So many positions, or those that are listed."""
        text = str(value).strip()
        if text.isdecimal() and 2 <= int(text) <= MOST:
            return int(text)
        if re.fullmatch(r"[-+]?[\d.]+", text) or isinstance(value, bool) or value is None:
            self.wrong("report.positions", "bad_positions", text=flow(value), most=MOST)
            return None
        try:
            listed = of_value(value, self.dimensions)
            if self.mechanism is not None:
                known_outputs(self.mechanism, listed)
        except LinkwrightError as error:
            remedy = error.remedy if isinstance(error, QuantityError) else ""
            said = error.message if isinstance(error, QuantityError) else error.sentence
            self.findings[Finding("error", "", "report.positions", said, remedy, error.code)] = None
            return None
        return listed

    @property
    def dimensions(self) -> tuple[str, ...]:
        """What positions may be given as: the first driver's coordinate where its speed is constant, or times."""
        if self.mechanism is None:
            return ("angle", "length", "time")
        law = next((each.law for each in self.mechanism.drivers.values()), None)
        constant = law is None or law.constant_speed is not None
        return (self.mechanism.across, "time") if constant else ("time",)

    def fluctuation(self, value: Any) -> float:
        try:
            found = float(value)
        except (TypeError, ValueError):
            found = 0.0
        if not 0.0 < found < 1.0:
            self.wrong("report.fluctuation", "bad_fluctuation", text=flow(value))
        return found

    def erratum(self, each: Any, place: str) -> Erratum:
        if not isinstance(each, Mapping):
            self.wrong(place, "not_a_mapping")
            return Erratum("", "", "")
        self.known(each, ERRATUM, place)
        for key in ERRATUM[:3]:
            if key not in each:
                self.wrong(place, "lacks", "missing-key", name=key)
        return Erratum(**{key: self.text(each.get(key, ""), f"{place}.{key}") for key in ERRATUM})
