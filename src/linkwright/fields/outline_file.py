"""Outlines in DXF files, which lie next to the model file or in folders below it."""

from __future__ import annotations

from pathlib import Path

from linkwright.core.entry_points import loaded
from linkwright.errors import Finding, LinkwrightError
from linkwright.fields.nodes import Node
from linkwright.fields.outline import Ring, without_repeats
from linkwright.fields.reading import Place, Reader
from linkwright.filesystem import allowed, below
from linkwright.words import _

#: What reads an outline; its room lies above this one.
READ_OUTLINE = "linkwright.importers.dxf_outline:read_outline"


class FileName(str):
    """The name of a model file in findings, with the ``folder`` in which the file lies."""

    folder: Path

    def __new__(cls, name: str, folder: Path) -> FileName:
        made = super().__new__(cls, name)
        made.folder = folder
        return made

    def __getnewargs__(self) -> tuple[str, Path]:  # type: ignore[override]
        return str(self), self.folder


def rings_of_file(reader: Reader, node: Node, place: Place, name: str) -> tuple[Ring, ...] | None:
    """The outline in a file and its holes, m; None after a finding."""
    path = _path(reader, node, place, name)
    if path is None:
        return None
    try:
        rings, findings = loaded(READ_OUTLINE)(allowed(path))
    except LinkwrightError as error:
        reader.error(node, place, error.sentence, _("draw one closed outline in it, and the holes within"), "outline")
        return None
    for each in findings:
        reader.error(node, place, _in_file(each), each.remedy, each.code, severity=each.severity)
    return tuple(without_repeats(ring) for ring in rings) or None


def _in_file(finding: Finding) -> str:
    """What was found in a file, with its place there."""
    where = ", ".join(filter(None, (finding.where, finding.key)))
    return _("{name}: {cause}", name=where, cause=finding.message)


def _path(reader: Reader, node: Node, place: Place, name: str) -> Path | None:
    if not isinstance(reader.source, FileName):
        problem = _("this text is not in a folder, so there is no file next to it", code="shapes.no_folder")
        remedy = _("load the model from its file, or give the corners: outline: [[x, y], …]")
        reader.error(node, place, problem, remedy, "no-file")
        return None
    folder = reader.source.folder.resolve()
    path = below(folder, name)
    if path is None or path.suffix.lower() != ".dxf":
        problem = _('"{name}" is not a DXF file below the folder of the model', name=name, code="shapes.file_outside")
        reader.error(node, place, problem, _("put it next to the model file: file: outline.dxf"), "no-file")
        return None
    if not path.is_file():
        problem = _('there is no file "{name}" in the folder of the model', name=name, code="shapes.no_file")
        reader.error(node, place, problem, _("check its name"), "no-file")
        return None
    return path
