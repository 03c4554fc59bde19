"""A file that holds a task of synthesis and no model: its heading, for reports."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from linkwright.errors import ModelError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import Place
from linkwright.files.model_file import is_task, read_nodes
from linkwright.files.read_model import HEADER, TASK_KEYS
from linkwright.files.reader import Reader
from linkwright.files.source import read_source
from linkwright.words.sentence import in_language

HEADING = tuple(key for key in TASK_KEYS if key in HEADER and key not in ("expected", "synthesis"))


@dataclass(frozen=True)
class TaskFile:
    """``file``: path or gallery name; name, purpose and source as the file gives them; ``report``: its settings."""

    file: str
    name: str
    purpose: str = ""
    source: str = ""
    report: Mapping[str, Any] = field(default_factory=dict)

    def translate(self, language: str) -> TaskFile:
        """The same with its texts in a language."""
        return replace(
            self,
            name=in_language(self.name, language),
            purpose=in_language(self.purpose, language),
            source=in_language(self.source, language),
        )


def task_file(file: str | Path) -> TaskFile | None:
    """The heading of a file that holds a task and no model, None for every other file.

    Raises ModelError for a file that cannot be read, and for a heading that is wrong.
    """
    text, name = read_source(file)
    root, _ = read_nodes(text, name)
    if not is_task(root) or not isinstance(root, MappingNode):
        return None
    reader = Reader(name)
    entries = [entry for entry in root.entries if entry.key.text in HEADING]
    found = reader.table(replace(root, entries=entries), Place("", ""), {key: HEADER[key] for key in HEADING}) or {}
    if reader.error_count:
        raise ModelError(reader.findings)
    return TaskFile(
        str(file),
        found.get("name") or Path(name).stem,
        found.get("purpose") or "",
        found.get("source") or "",
        found.get("report") or {},
    )
