"""What a file may say about its drawing sheets: the keys of ``sheet``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.fields.base import Field, Free, Quantities, Quantity, Schema, Text, Word, table_schema
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import ByAddress, Flag, Integer, Listed, Table
from linkwright.words import LANGUAGES, _

#: Sizes of paper, and the standards of frames and title blocks.
SIZES, STANDARDS = ("A0", "A1", "A2", "A3", "A4"), ("gb", "iso")
#: Texts of the title block.
WORDS: Mapping[str, Field] = {
    "title": Text(
        doc=_("title of the task in the title block; otherwise that of the report, else the machine's name")
    ),
    "drawing": Text(doc=_("name of the drawing in the title block")),
    "number": Text(doc=_("number of the drawing")),
    "school": Text(doc=_("school or company in the title block")),
    "faculty": Text(doc=_("faculty or department")),
    "class": Text(doc=_("class of the student")),
    "student": Text(doc=_("who made the drawing; otherwise the report's author")),
    "student_number": Text(doc=_("number of the student")),
    "adviser": Text(doc=_("who advises")),
    "checker": Text(doc=_("who checks")),
    "date": Text(doc=_("date of the drawing")),
}
PANEL: Mapping[str, Field] = {
    "at": Quantities(
        "length", ("x", "y"), doc=_("lower left corner of the panel with its caption, from that of the paper")
    ),
    "size": Quantity("length", above=0.0, doc=_("longest side of the picture at most, on paper")),
    "scale": Quantity("dimensionless", above=0.0, doc=_("scale in SI units per millimetre of paper")),
}
SHEET: Mapping[str, Field] = {
    "size": Word(SIZES, doc=_("paper size, A0 to A4; default A1")),
    "orientation": Word(("landscape", "portrait"), doc=_("default landscape; A4 portrait")),
    "standard": Word(STANDARDS, doc=_("gb (GB/T 14689, 10609.1) or iso (ISO 5457, 7200); default by the language")),
    "block": Word(
        ("full", "short"), doc=_("title block: full, or the short one of schools; default full, short on A3 and A4")
    ),
    "binding": Flag(doc=_("whether a margin for binding is left (gb); default true")),
    "zones": Flag(doc=_("whether the frame has numbered fields; default false")),
    **WORDS,
    "sheet": Integer(1, 999, doc=_("number of this sheet")),
    "sheets": Integer(1, 999, doc=_("how many sheets there are")),
    "positions": Listed(
        Text(), "[60 deg, 240 deg]", doc=_("inputs of the positions that are worked out, one or two")
    ),
    "only": Listed(Text(), "[mechanism, velocity_1]", doc=_("panels that are drawn, in their order; default all")),
    "leave_out": Listed(Text(), "[table_data]", doc=_("panels that are left out")),
    "panels": ByAddress(Table(PANEL), doc=_("place, size and scale of single panels by their names")),
    **{each: Table(WORDS, doc=_("the texts in the language {language}", language=each)) for each in LANGUAGES},
}


@dataclass(frozen=True)
class SheetSection(Free):
    """The section ``sheet``: stored as written, checked by its keys."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        return None if reader.table(node, place, SHEET) is None else super().read(reader, node, place, siblings)

    def shape(self) -> Schema:
        return table_schema(SHEET)


#: The key of files.
FIELD = SheetSection(doc=_("size, title block, panels and their places for the command sheet"))
