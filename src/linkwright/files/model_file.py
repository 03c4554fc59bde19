"""Model files: reading, checking, changing and writing them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.core.arguments import describe
from linkwright.errors import Finding, ModelError, RequestError
from linkwright.fields.nodes import Node, Scalar, below
from linkwright.files.compose import compose
from linkwright.files.read_model import read_model
from linkwright.files.source import ENDINGS, GALLERY, gallery_names, read_source
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

if TYPE_CHECKING:
    from pathlib import Path

    from linkwright.files.document import Document

__all__ = ["gallery_names", "load", "loads", "read_document"]


def load(source: str | Path) -> Mechanism:
    """The mechanism in a model file: a path, or ``gallery:NAME``.

    Raises ModelError with all findings where the file cannot be used.
    """
    text, name = read_source(source)
    return loads(text, name)


def loads(text: str, name: str = "<text>") -> Mechanism:
    """The mechanism in the text of a model file; findings name ``name`` as the file.

    Raises ModelError with all findings where the text cannot be used.
    """
    if not isinstance(text, str):
        raise RequestError(
            _(
                "expected the text of a model, not {found}; files are read by lw.load",
                code="given_instead.no_text",
                found=describe(text),
            )
        )
    if "\n" not in text.strip() and (text.startswith(GALLERY) or text.endswith(ENDINGS)):
        raise RequestError(
            _(
                'the text of a model is needed, not the name of a file; write lw.load("{name}")',
                code="given_instead.name_for_text",
                name=text,
            )
        )
    mechanism, findings = read_text(text, name)
    if mechanism is None:
        raise ModelError(findings)
    return mechanism


def read_document(source: str | Path) -> Document:
    """A model file that can be changed and saved with its comments and order. Raises ModelError."""
    from linkwright.files.document import Document

    text, name = read_source(source)
    return Document(text, name, read_text)


def read_text(text: str, name: str) -> tuple[Mechanism | None, list[Finding]]:
    """The mechanism of a text, or None where there is an error, and all findings."""
    return read_tree(*read_root(text, name), name)


def read_tree(root: Node | None, findings: list[Finding], name: str) -> tuple[Mechanism | None, list[Finding]]:
    """The mechanism of what :func:`read_root` gives, or None where there is an error, and all findings."""
    if root is None:
        return None, findings
    mechanism, found = read_model(root, name)
    return (None if findings else mechanism), findings + found


def declared_kind(root: Node | None) -> str | None:
    """The kind of calculation that a tree declares; None of a model."""
    node = below(root, "kind")
    return node.text if isinstance(node, Scalar) else None


def is_task(root: Node | None) -> bool:
    """Whether a tree holds a task of synthesis and no model."""
    task, *model = (below(root, key) for key in ("synthesis", "links", "frame"))
    return task is not None and model == [None, None]


def read_nodes(text: str, name: str) -> tuple[Node | None, list[Finding]]:
    """The tree of a text as far as there is one, and what is wrong with the text itself."""
    root, remarks = compose(text.removeprefix("\ufeff"))
    return root, [
        Finding("error", f"{name}:{r.line + 1}:{r.column + 1}", r.key, r.message, r.remedy, r.code) for r in remarks
    ]


def read_root(text: str, name: str) -> tuple[Node | None, list[Finding]]:
    """The tree of a text, None where there is nothing to read, and what is wrong with the text itself."""
    root, findings = read_nodes(text, name)
    if root is None or (isinstance(root, Scalar) and root.empty):
        empty = Finding("error", f"{name}:1:1", "", _("the file is empty"), _("begin with format: 1"), "empty")
        return None, findings or [empty]
    return root, findings
