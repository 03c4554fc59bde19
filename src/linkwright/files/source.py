"""Where the text of a model comes from: a file, a pipe, the gallery."""

from __future__ import annotations

import os
import stat
from typing import TYPE_CHECKING

from linkwright import gallery
from linkwright.core.given import told
from linkwright.errors import Finding, ModelError, RequestError
from linkwright.registry import nearest
from linkwright.words.sentence import Sentence, reason_of

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES = 5_000_000
GALLERY = "gallery:"
#: What names of model files end in, as a rule.
ENDINGS = (".yaml", ".yml", ".json")
#: Seconds that a pipe or a device may give nothing.
PATIENCE = 3.0


def gallery_names() -> list[str]:
    """Names of the models in the gallery."""
    return list(gallery.names())


def read_source(source: str | Path) -> tuple[str, str]:
    """Text of a source, and the name of the file for findings."""
    if isinstance(source, str) and source.startswith(GALLERY):
        return _read_gallery(source.removeprefix(GALLERY))
    if not isinstance(source, str | os.PathLike):
        raise RequestError("given_instead.no_file_name", told=told(source))
    from pathlib import Path

    path = Path(source)
    if "\n" in str(source):
        raise _refuse("<text>", Sentence("model.text_for_name"), Sentence("model.write_loads"), "no-file")
    try:
        if path.is_dir():
            raise _refuse(path, Sentence("model.folder"), Sentence("model.name_file_in"), "not-a-file")
        if not path.exists():
            raise _refuse(path, Sentence("model.no_file"), _near_file(path), "no-file")
        content = _content(path)
    except (OSError, ValueError) as error:
        unreadable = Sentence("model.unreadable", reason=reason_of(error))
        raise _refuse(path, unreadable, Sentence("model.check_permissions"), "no-file") from None
    return decode(content, path.name), path.name


def _content(path: Path) -> bytes:
    """What a file holds, or a pipe or device gives; raises ModelError, OSError."""
    status = path.stat()
    most = Sentence("model.most_size", most=MAX_BYTES / 1e6)
    if not stat.S_ISREG(status.st_mode):
        content = _given(path)
    elif status.st_size > MAX_BYTES:
        raise _refuse(path, Sentence("model.file_size", size=status.st_size / 1e6), most, "size")
    else:
        content = path.read_bytes()
    if len(content) > MAX_BYTES:
        raise _refuse(path, Sentence("model.no_end"), most, "size")
    return content


def _given(path: Path) -> bytes:
    """What a pipe or a device gives before it ends, without waiting for one that gives nothing."""
    if os.name != "posix":
        raise _refuse(
            path, Sentence("model.no_regular_file"), Sentence("model.name_model_file"), "not-a-file"
        )
    import select

    parts, total = list[bytes](), 0
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    try:
        while total <= MAX_BYTES:
            if not select.select([handle], [], [], PATIENCE)[0]:
                raise _refuse(
                    path, Sentence("model.gives_nothing"), Sentence("model.name_model_file"), "not-a-file"
                )
            part = os.read(handle, 1 << 20)
            if not part:
                break
            parts.append(part)
            total += len(part)
    finally:
        os.close(handle)
    return b"".join(parts)


def _refuse(where: Path | str, message: str, remedy: str, code: str) -> ModelError:
    return ModelError([Finding("error", str(where), "", message, remedy, code)])


def _near_file(path: Path) -> str:
    folder = path.parent
    if not folder.is_dir():
        return Sentence("model.no_folder", folder=folder)
    names = [entry.name for entry in list(folder.iterdir())[:1000] if not entry.is_dir()]
    ended = (name for name in names if name in [path.name + ending for ending in ENDINGS])
    near = next(ended, None) or nearest(path.name, names)
    if near is None and path.name in gallery_names():
        return Sentence("model.write_gallery", gallery=GALLERY, name=path.name)
    return Sentence("names.did_you_mean", offer=near) if near else Sentence("model.check_path")


def _read_gallery(name: str) -> tuple[str, str]:
    try:
        content = gallery.content(name)
    except KeyError:
        names = gallery_names()
        near = nearest(name, names)
        remedy = (
            Sentence("names.did_you_mean", offer=f"{GALLERY}{near}")
            if near
            else Sentence("names.one_of", names=tuple(names))
        )
        problem = Sentence("model.no_gallery_model", name=name)
        raise _refuse(GALLERY + name, problem, remedy, "no-file") from None
    return decode(content, f"{name}.yaml"), f"{name}.yaml"


def decode(content: bytes, name: str) -> str:
    """Text of a file's bytes; raises ModelError with the place of the first byte that is not UTF-8."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _refuse(name, Sentence("model.utf16"), Sentence("model.save_utf8"), "encoding")
    if b"\x00" in content:
        problem = Sentence("model.not_text", offset=content.index(0))
        raise _refuse(name, problem, Sentence("model.name_text_file"), "encoding")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start]
        line, column = before.count(b"\n") + 1, len(before) - before.rfind(b"\n")
        problem = Sentence("model.not_utf8", byte=content[error.start], start=error.start)
        place = f"{name}:{line}:{column}"
        raise _refuse(place, problem, Sentence("model.save_utf8"), "encoding") from None
