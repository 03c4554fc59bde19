"""What a model file says about its report: section ``report``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError, RequestError
from linkwright.events.position_list import STEPPED, PositionList, known_outputs, of_value
from linkwright.fields import nodes
from linkwright.fields.base import Field, Schema, Text, file_key, file_keys, table_schema
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader, Saying, Sayings
from linkwright.fields.tables import ByAddress, Either, Keys, Line, Listed, Table, Value
from linkwright.files.reader import SectionReading
from linkwright.files.write import flow
from linkwright.kinematics.names import place_meant
from linkwright.machine.flywheel import COEFFICIENT, FLUCTUATION
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import listed
from linkwright.words import LANGUAGES, Message, _, pgettext

if TYPE_CHECKING:
    from linkwright.reports.markdown import TextContext

#: What else a list of sections can name: all that are not named, and calculations among the files.
OTHER_SECTIONS = ("rest", "calculations")
#: Lines of a cover, in their order, that are a row each.
COVER_ROWS: Mapping[str, Message] = {
    "faculty": _("Faculty"),
    "major": _("Major"),
    "class": _("Class"),
    "author": _("Author"),
    "student_number": _("Student number"),
    "adviser": _("Adviser"),
}
#: Limits of an output that numbers can begin at.
LIMITS = ("min", "max")
#: Most numbered positions.
MOST = 10_000
SAYINGS: Sayings = {
    "where_list": Saying("not-a-list", lambda **others: _("give a list: [task, structure]")),
    "where_mapping": Saying("not-a-mapping", lambda **others: _("give keys with values")),
    "where_text": Saying("not-a-text", lambda **others: _("a list or a mapping cannot be read here; write one text")),
}


@dataclass(frozen=True)
class Erratum:
    """A mistake of the source: where, what is printed, what is right, why."""

    where: str = file_key(Line(doc=_("its place in the source")))
    printed: str = file_key(Line(doc=_("what is printed there")))
    right: str = file_key(Line(doc=_("what is right")))
    why: str = file_key(Line(doc=pgettext("key", "why")), "")


@dataclass(frozen=True)
class Chapter:
    """A chapter of the user's own: title and text, Markdown, or Typst after a first line ``typst``; ``label``: the
    name by which texts refer to it."""

    title: str = file_key(Line(doc=_("title of an own chapter")))
    text: str = file_key(Text(doc=_("text of the chapter, Markdown")))
    label: str = file_key(Line(doc=_("name by which texts refer to it: [[label]]")), "")


@dataclass(frozen=True)
class OwnSource:
    """A source of the user's own: the name by which texts cite it, and the text that the list prints."""

    key: str = file_key(Line(doc=_("name by which texts cite it: [@key]")))
    text: str = file_key(Line(doc=_("the source as the list of references prints it")))


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
class SectionName(Field):
    """The name of a section, or one of ``more`` words."""

    more: tuple[str, ...] = ()

    @property
    def names(self) -> list[str]:
        """All names."""
        from linkwright.reports.section import section_names

        return [*section_names(), *self.more]

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        name = reader.text(node, place)
        if name is None or name in self.names:
            return name
        hint = listed(name, self.names)
        reader.error(
            node,
            place,
            _('there is no section "{name}"; {hint}', code="report.no_section", name=name, hint=hint),
            "",
            "no-section",
        )
        return None

    def shape(self) -> Schema:
        return {"enum": self.names}


@dataclass(frozen=True)
class SectionTexts(ByAddress):
    """Own texts by the name of a section."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        for entry in node.entries if isinstance(node, nodes.Mapping) else ():
            SectionName().read(reader, entry.key, place.child(entry.key.text), {})
        return super().read(reader, node, place, siblings)

    def shape(self) -> Schema:
        texts = {name: self.item.shape() for name in SectionName().names}
        return {"type": "object", "properties": texts, "additionalProperties": False}


@dataclass(frozen=True)
class Position(Line):
    """The position that is worked out; which there are, the machine says."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        if isinstance(node, Scalar):
            return super().read(reader, node, place, siblings)
        reader.error(
            node,
            place,
            _("the report works out one position; write one value with its unit, such as 60 deg"),
            "",
            "not-a-position",
        )
        return None


@dataclass(frozen=True)
class CoverField(Keys):
    """Whether there is a cover (None: there is none), or what it says."""

    bare = True

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, Scalar) and node.plain and (node.empty or node.text in ("true", "false")):
            return None if node.text == "false" else {}
        return super().read(reader, node, place, siblings)

    def shape(self) -> Schema:
        return {"oneOf": [{"type": "boolean"}, table_schema(self.fields)]}


COVER: Mapping[str, Field] = {
    "school": Line(doc=_("name of the school, at the top")),
    "kind": Line(doc=_("what the document is (default: Course design report)")),
    "logo": Line(doc=_("picture next to the model file: PNG, JPG or SVG")),
    "faculty": Line(doc=_("faculty or department")),
    "major": Line(doc=_("major")),
    "class": Line(doc=pgettext("key", "class")),
    "author": Line(doc=_("author (default: that of the report)")),
    "student_number": Line(doc=_("student number, in quotation marks where it begins with 0")),
    "adviser": Line(doc=_("adviser")),
    "date": Line(doc=_("date (default: that of the report)")),
    "fields": ByAddress(Line(), doc=_("further rows of the cover: {{Mark: }}")),
}
SECTIONS = Listed(
    Either(SectionName(OTHER_SECTIONS), Table.of(Chapter)),
    doc=_("sections and own chapters in order; rest: all others"),
)


@dataclass(frozen=True)
class Settings:
    """Settings of a report; ``positions`` in the tables (those that are listed, or so many, numbered from
    ``numbered_from``, ``"rocker min"``; None: as many as show the cycle); ``cover``: None without one;
    ``references``: own sources by the name by which texts cite them; ``folder``: where pictures lie.
    """

    title: str = file_key(Line(doc=_("title of the report")), "")
    author: str = file_key(Line(doc=_("author of the report")), "")
    course: str = file_key(Line(doc=_("course")), "")
    date: str = file_key(Line(doc=_("date of the report")), "")
    purpose: str = file_key(Line(doc=_("what the machine is for, instead of the model's")), "")
    source: str = file_key(Line(doc=_("where it is taken from, instead of the model's")), "")
    position: str = file_key(Position(doc=_("position that is worked out, such as 60 deg")), "")
    sections: tuple[str | Chapter, ...] = file_key(SECTIONS, ())
    text: Mapping[str, str] = file_key(
        SectionTexts(Text(), doc=_("own text by the name of a section, Markdown")), dict
    )
    errata: tuple[Erratum, ...] = file_key(Listed(Table.of(Erratum), doc=_("mistakes of the source")), ())
    cover: CoverWords | None = file_key(CoverField(COVER, doc=_("a cover of its own page")), None)
    references: Mapping[str, str] = file_key(Listed(Either(Line(), Table.of(OwnSource)), doc=_("own sources")), dict)
    positions: int | PositionList | None = file_key(
        Listed(
            Either(Value(), Table({key: Value() for key in STEPPED})),
            alone=True,
            doc=_("numbered positions of the tables"),
        ),
        None,
    )
    numbered_from: str = file_key(Line(doc=_("limit position that is number 1, such as rocker min")), "")
    fluctuation: float = file_key(COEFFICIENT, FLUCTUATION)
    folder: str = ""

    @property
    def text_context(self) -> TextContext:
        """What own texts refer to."""
        from linkwright.reports.markdown import TextContext

        return TextContext(self.folder, self.references)


_KEYS = file_keys(Settings)
#: Keys that can differ by language.
OWN = {key: each for key, each in _KEYS.items() if key not in ("positions", "numbered_from", "fluctuation")}
SECTION = Keys(
    {
        **_KEYS,
        "en": Keys(OWN, doc=_("what an English report says instead")),
        "zh": Keys(OWN, doc=_("what a Chinese report says instead")),
    },
    own=SAYINGS,
)


def settings(
    section: Mapping[str, Any], language: str = "en", mechanism: Mechanism | None = None, folder: str = ""
) -> Settings:
    """The settings of a file's ``report``, of a ``mechanism`` where what they name can be looked for in it.

    Pictures that they name lie in ``folder``.

    Values under a language's own key (``zh: {title: …}``) precede the rest in that language. Raises
    ModelError with all findings.
    """
    reading = _Reading(section, mechanism, folder)
    found = [reading.all_of(each) for each in (*(each for each in LANGUAGES if each != language), language)]
    reading.settle()
    return found[-1]


def worked_place(mechanism: Mechanism, position: str) -> float | None:
    """The input (rad or m) or time (s) of a worked position, None where none is asked for; raises QuantityError."""
    if not position or not mechanism.drivers:
        return None
    if not mechanism.steady:
        return amount(position, "time")
    return amount(position, mechanism.across)


class _Reading(SectionReading):
    """The settings, of a mechanism where there is one; pictures lie in a folder."""

    def __init__(self, section: Mapping[str, Any], mechanism: Mechanism | None, folder: str) -> None:
        super().__init__(SECTION, "report", section)
        self.mechanism, self.folder = mechanism, folder

    def all_of(self, language: str) -> Settings:
        """The settings in a language."""
        own = self.values.get(language) or {}
        merged = {key: each for key, each in {**self.values, **own}.items() if each is not None}
        merged = {key: each for key, each in merged.items() if key not in LANGUAGES}
        places = {key: f"{language}.{key}" if key in own else key for key in OWN}
        sources = self.references(merged.get("references", ()), places["references"])
        for place, text in self.texts(merged, places):
            self.own(text, place, sources)
        self.position(merged.get("position", ""), places["position"])
        self.numbered(merged.get("numbered_from", ""))
        more = {key: tuple(each for each in merged.get(key, ()) if each) for key in ("sections", "errata")}
        return Settings(
            **{
                **merged,
                **more,
                "positions": self.positions(merged["positions"]) if "positions" in merged else None,
                "cover": self.cover(merged, places["cover"]),
                "references": sources,
                "folder": self.folder,
            }
        )

    def texts(self, section: Mapping[str, Any], places: Mapping[str, str]) -> Iterator[tuple[str, str]]:
        """Own texts with their places."""
        for name, text in section.get("text", {}).items():
            yield f"{places['text']}.{name}", text or ""
        for i, each in enumerate(section.get("sections", ())):
            if isinstance(each, Chapter):
                yield f"{places['sections']}.{i}.text", each.text

    def own(self, text: str, place: str, sources: Mapping[str, str]) -> None:
        """Files and sources that an own text names must be there."""
        from linkwright.reports.markdown import TextContext, own_text

        try:
            for _unused, faults in own_text(text, context=TextContext(self.folder, sources)):
                for fault in faults:
                    if fault.code:
                        self.note(place, fault.sentence, fault.code)
        except LinkwrightError:
            return

    def references(self, sources: tuple[str | OwnSource | None, ...], place: str) -> dict[str, str]:
        """Own sources, by their key or, without one, by themselves."""
        found: dict[str, str] = {}
        for i, each in enumerate(sources):
            key, text = (each.key, each.text) if isinstance(each, OwnSource) else (each or "", each or "")
            if isinstance(each, OwnSource) and key in found:
                self.note(
                    f"{place}.{i}",
                    _(
                        'two sources are named "{name}"; give each a name of its own',
                        code="report.source_twice",
                        name=key,
                    ),
                    "source-twice",
                )
            found[key] = text
        return found

    def cover(self, settings: Mapping[str, Any], place: str) -> CoverWords | None:
        """The cover; author and date are those of the report where it names no others."""
        if (cover_data := settings.get("cover")) is None:
            return None
        own = {key: settings.get(key, "") for key in ("author", "date")}
        own |= {key: text for key, text in cover_data.items() if key != "fields" and text is not None}
        return CoverWords(
            own.get("school", ""),
            own.get("kind", ""),
            own["date"],
            self.logo(own.get("logo", ""), f"{place}.logo"),
            tuple((key, own[key]) for key in COVER_ROWS if own.get(key)),
            tuple((cover_data.get("fields") or {}).items()),
        )

    def logo(self, name: str, place: str) -> str:
        """The picture of a cover, SVG."""
        from linkwright.reports.pictures import picture_of

        try:
            return picture_of(name, self.folder).svg if name else ""
        except LinkwrightError as error:
            self.note(place, error, code="wrong-picture")
            return ""

    def position(self, text: str, place: str) -> None:
        try:
            _unused = self.mechanism and worked_place(self.mechanism, text)
        except QuantityError as error:
            self.note(place, error)

    def numbered(self, text: str) -> None:
        """An output with the limit at which the numbers begin."""
        name, _unused, limit = text.partition(" ")
        if limit not in ("", *LIMITS):
            message = _(
                '"{text}": numbers begin at the limit min or max of an output, not at "{limit}"; write "{name} min"',
                code="report.no_limit",
                text=text,
                limit=limit,
                name=name,
            )
            self.note("numbered_from", message, "no-limit")
        elif name and self.mechanism is not None:
            try:
                place_meant(self.mechanism, name)
            except RequestError as error:
                self.note("numbered_from", error)

    def positions(self, value: Any) -> int | PositionList | None:
        """So many positions, or those that are listed."""
        text = str(value).strip()
        if text.isdecimal() and 2 <= int(text) <= MOST:
            return int(text)
        if re.fullmatch(r"[-+]?[\d.]+", text) or isinstance(value, bool) or value is None:
            message = _(
                'invalid number of positions "{text}"; give 2 to {most}',
                code="report.bad_positions",
                text=flow(value),
                most=MOST,
            )
            self.note("positions", message, "bad-positions")
            return None
        try:
            listed = of_value(value, self.dimensions)
            if self.mechanism is not None:
                known_outputs(self.mechanism, listed)
        except LinkwrightError as error:
            self.note("positions", error)
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
