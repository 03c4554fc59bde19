"""Model files: reading, checking, changing and writing them."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from linkwright.errors import Finding, ModelError
from linkwright.model.compose import compose
from linkwright.model.document import Document
from linkwright.model.mechanism import Mechanism
from linkwright.model.nodes import Node, Scalar
from linkwright.model.read_model import read_model
from linkwright.model.write import dump
from linkwright.registry import nearest
from linkwright.words.sentence import Sentence

__all__ = ["check", "dump", "gallery_names", "load", "loads", "read_document"]

MAX_BYTES = 5_000_000
GALLERY = "gallery:"


def load(source: str | Path) -> Mechanism:
    """The mechanism in a model file: a path, or ``gallery:NAME``.

    Raises ModelError with all findings where the file cannot be used.
    """
    text, name = read_source(source)
    return loads(text, name)


def loads(text: str, name: str = "<text>") -> Mechanism:
    """The mechanism in the text of a model file; ``name`` stands for the file in findings.

    Raises ModelError with all findings where the text cannot be used.
    """
    mechanism, findings = read_text(text, name)
    if mechanism is None:
        raise ModelError(findings)
    return mechanism


def check(source: str | Path) -> list[Finding]:
    """All findings about a model file, errors and warnings; never raises for bad content."""
    try:
        text, name = read_source(source)
    except ModelError as error:
        return list(error.findings)
    return read_text(text, name)[1]


def read_document(source: str | Path) -> Document:
    """A model file that can be changed and saved with its comments and order. Raises ModelError."""
    text, name = read_source(source)
    return Document(text, name, read_text)


def read_text(text: str, name: str) -> tuple[Mechanism | None, list[Finding]]:
    """The mechanism of a text, or None where there is an error, and all findings."""
    root, findings = read_root(text, name)
    if root is None:
        return None, findings
    mechanism, found = read_model(root, name)
    return (None if findings else mechanism), findings + found


def read_root(text: str, name: str) -> tuple[Node | None, list[Finding]]:
    """The tree of a text, None where there is nothing to read, and what is wrong with the text itself."""
    root, remarks = compose(text.removeprefix("\ufeff"))
    findings = [
        Finding(
            "error",
            f"{name}:{remark.line + 1}:{remark.column + 1}",
            remark.key,
            remark.message,
            remark.remedy,
            remark.code,
        )
        for remark in remarks
    ]
    if root is None or (isinstance(root, Scalar) and root.empty):
        empty = Finding(
            "error", f"{name}:1:1", "", Sentence("model.empty"), Sentence("model.begin_with"), "empty"
        )
        return None, findings or [empty]
    return root, findings


def gallery_names() -> list[str]:
    """Names of the models in the gallery."""
    folder = resources.files("linkwright") / "gallery"
    return sorted(
        entry.name.removesuffix(".yaml") for entry in folder.iterdir() if entry.name.endswith(".yaml")
    )


def read_source(source: str | Path) -> tuple[str, str]:
    """Text of a source, and the name of the file for findings."""
    if isinstance(source, str) and source.startswith(GALLERY):
        return _read_gallery(source.removeprefix(GALLERY))
    path = Path(source)
    try:
        if path.is_dir():
            raise _refuse(path, Sentence("model.folder"), Sentence("model.name_file_in"), "not-a-file")
        if not path.exists():
            raise _refuse(path, Sentence("model.no_file"), _near_file(path), "no-file")
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise _refuse(
                path,
                Sentence("model.file_size", size=size / 1000000.0),
                Sentence("model.most_size", most=MAX_BYTES / 1000000.0),
                "size",
            )
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise _refuse(
            path, Sentence("model.unreadable", reason=reason), Sentence("model.check_permissions"), "no-file"
        ) from None
    if len(content) > MAX_BYTES:
        raise _refuse(
            path, Sentence("model.no_end"), Sentence("model.most_size", most=MAX_BYTES / 1000000.0), "size"
        )
    return decode(content, path.name), path.name


def _refuse(path: Path, message: str, remedy: str, code: str) -> ModelError:
    return ModelError([Finding("error", str(path), "", message, remedy, code)])


def _near_file(path: Path) -> str:
    folder = path.parent
    names = [entry.name for entry in list(folder.iterdir())[:1000]] if folder.is_dir() else []
    if not folder.is_dir():
        return Sentence("model.no_folder", folder=folder)
    near = nearest(path.name, names)
    if near is None and path.name in gallery_names():
        return Sentence("model.write_gallery", gallery=GALLERY, name=path.name)
    return Sentence("names.did_you_mean", offer=near) if near else Sentence("model.check_path")


def _read_gallery(name: str) -> tuple[str, str]:
    names = gallery_names()
    if name not in names:
        near = nearest(name, names)
        remedy = (
            Sentence("names.did_you_mean", offer=f"{GALLERY}{near}")
            if near
            else Sentence("names.one_of", names=tuple(names))
        )
        raise ModelError(
            [
                Finding(
                    "error",
                    GALLERY + name,
                    "",
                    Sentence("model.no_gallery_model", name=name),
                    remedy,
                    "no-file",
                )
            ]
        )
    content = (resources.files("linkwright") / "gallery" / f"{name}.yaml").read_bytes()
    return decode(content, f"{name}.yaml"), f"{name}.yaml"


def decode(content: bytes, name: str) -> str:
    """Text of a file's bytes; raises ModelError with the place of the first byte that is not UTF-8."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise ModelError(
            [Finding("error", name, "", Sentence("model.utf16"), Sentence("model.save_utf8"), "encoding")]
        )
    if b"\x00" in content:
        raise ModelError(
            [
                Finding(
                    "error",
                    name,
                    "",
                    Sentence("model.not_text", offset=content.index(0)),
                    Sentence("model.name_text_file"),
                    "encoding",
                )
            ]
        )
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start]
        line, column = before.count(b"\n") + 1, len(before) - before.rfind(b"\n")
        byte = content[error.start]
        raise ModelError(
            [
                Finding(
                    "error",
                    f"{name}:{line}:{column}",
                    "",
                    Sentence("model.not_utf8", byte=byte, start=error.start),
                    Sentence("model.save_utf8"),
                    "encoding",
                )
            ]
        ) from None
