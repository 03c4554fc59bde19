"""Titles and purposes of the files in the gallery, from their first lines, without reading the models."""

from __future__ import annotations

from linkwright import gallery
from linkwright.files.model_file import read_nodes
from linkwright.files.reader import Reader
from linkwright.words.message import LocalizedText


def entry(name: str) -> dict[str, str]:
    """Name, title and purpose of a file."""
    first, _unused, _unused2 = gallery.content(name).decode().partition("\nsource:")
    root, _unused3 = read_nodes(first, name)
    assert root is not None
    header = Reader(name).free(root)
    return {"name": name, "title": LocalizedText(header["name"]), "purpose": LocalizedText(header["purpose"])}


def entries(part: str = "") -> tuple[list[dict[str, str]], ...]:
    """Models, calculations and tasks whose names have a part."""
    kinds = (gallery.names(), gallery.calculations(), gallery.tasks())
    return tuple([entry(name) for name in names if part in name] for names in kinds)
