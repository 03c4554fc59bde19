"""Options that are declared as fields: what their help says of them, and their values by the reader of files."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar, cast

from linkwright.cli.errors import OptionError
from linkwright.cli.parser import Options
from linkwright.fields.base import Field, given_by_file
from linkwright.fields.nodes import Entry, Node, Scalar
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import Place
from linkwright.fields.tables import Table
from linkwright.words import Message

Made = TypeVar("Made")


def declare(option: Options, fields: Mapping[str, Field], metavars: Mapping[str, str]) -> None:
    """Options for some fields, each with what stands for its value; ``KEY=VALUE,…``, or nothing, where it is a
    table."""
    for name, metavar in metavars.items():
        own: dict[str, Any] = {"nargs": "?", "const": ""} if isinstance(fields[name], Table) else {}
        option(f"--{name}", metavar, help=cast(Message, fields[name].doc), **own)


def values_of(made: type[Made], options: argparse.Namespace) -> Made:
    """The object of what stands in the options of its fields; raises OptionError with all findings."""
    from linkwright.files.reader import Reader

    fields, reader = given_by_file(made), Reader("")
    texts = {name: text for name in fields if (text := getattr(options, name)) is not None}
    entries = [Entry(_scalar(f"--{name}"), _node(fields[name], text)) for name, text in texts.items()]
    named = {name: replace(each, key=f"--{name}") for name, each in fields.items()}
    values = reader.table(MappingNode(0, 0, 0, 0, entries), Place("", ""), named)
    if reader.error_count:
        raise OptionError(reader.findings)
    return made(**values or {})


def _node(field: Field, text: str) -> Node:
    if not isinstance(field, Table):
        return _scalar(text)
    parts = (part.partition("=") for part in text.split(",") if part.strip())
    entries = [Entry(_scalar(key), _scalar(value)) for key, _sign, value in parts]
    return MappingNode(0, 0, 0, 0, entries)


def _scalar(text: str) -> Scalar:
    return Scalar(0, 0, 0, 0, text.strip())
