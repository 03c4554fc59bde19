"""Values of options that are declared as fields, by the reader of files, with all findings at once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from linkwright.cli.errors import OptionError
from linkwright.cli.options import Option
from linkwright.fields.base import Field
from linkwright.fields.nodes import Entry, Node, Scalar, Sequence
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import Place
from linkwright.fields.tables import ByAddress, Either, Listed, Table
from linkwright.files.reader import Reader
from linkwright.words import _


def read_declared(values: dict[str, Any], options: Iterable[Option]) -> None:
    """Puts values in the place of the texts of declared options; raises OptionError with all findings."""
    reader, fields, entries = Reader(""), dict[str, Field](), list[Entry]()
    for each in sorted(options, key=lambda option: option.rank):
        if each.field is not None:
            key, name = each.opts[0], str(each.name)
            fields[name] = replace(each.field, key=key)
            entries.append(Entry(_scalar(key), _node(reader, key, each.field, values[name])))
    found = reader.table(MappingNode(0, 0, 0, 0, entries), Place("", ""), fields)
    if reader.error_count:
        raise OptionError(reader.findings)
    values.update(found or {})


def _node(reader: Reader, key: str, field: Field, words: str | list[str]) -> Node:
    """The node of an option's words; of KEY=VALUE, separated by commas in one word, where the field takes a table."""
    table = isinstance(field, Table | ByAddress) or (isinstance(field, Either) and "=" in words)
    if isinstance(field, Listed):
        return Sequence(0, 0, 0, 0, [_scalar(text) for text in words])
    if not table:
        return _scalar(str(words))
    entries: dict[str, Entry] = {}
    for text in words.split(",") if isinstance(words, str) else words:
        name, sign, value = (each.strip() for each in text.partition("="))
        if not (sign and name and value) and text.strip():
            message = _('"{text}" is no setting', text=text)
            reader.error(
                None, key, message, _("write NAME=VALUE, such as crank.length=80..120mm or flywheel=2"), "syntax"
            )
        elif name in entries:
            message = _("{name} is given twice", name=name)
            reader.error(None, key, message, _("write it once"), "duplicate-key")
        elif name:
            entries[name] = Entry(_scalar(name), _scalar(value))
    return MappingNode(0, 0, 0, 0, [*entries.values()])


def _scalar(text: str) -> Scalar:
    return Scalar(0, 0, 0, 0, text.strip())
