"""The section ``construction`` of a model file, and what it has to do with the rest of it."""

from __future__ import annotations

from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place
from linkwright.files.reader import Reader
from linkwright.mechanism.construction import Construction


def read_construction(reader: Reader, node: Node | None) -> Construction | None:
    """How the machine is made, if the file says so."""
    if node is None:
        return None
    before = reader.error_count
    values = reader.table(node, Place("construction", "construction"), Construction.fields())
    return None if values is None or reader.error_count > before else Construction.of_values(values)
