"""Where the text of a model comes from: a file, a pipe, the gallery."""

from __future__ import annotations

import os
import stat
from typing import TYPE_CHECKING

from linkwright import gallery
from linkwright.core.arguments import describe
from linkwright.errors import Finding, ModelError, RequestError
from linkwright.fields.outline_file import FileName
from linkwright.filesystem import allowed
from linkwright.registry import nearest
from linkwright.words import _, pgettext
from linkwright.words.message import reason_of

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
        raise RequestError(
            _(
                'expected the name of a model file, not {found}; write lw.load("machine.yaml")',
                code="given_instead.no_file_name",
                found=describe(source),
            )
        )
    from pathlib import Path

    content = read_bytes(source)
    name = os.path.basename(source)
    return decode(content, name), FileName(name, Path(source).parent)


def read_bytes(source: str | Path) -> bytes:
    """What a file holds; raises ModelError with what is wrong with its name or the file."""
    from pathlib import Path

    path = Path(source)
    if "\n" in str(source):
        raise _refuse(
            "<text>",
            _("this is a text of several lines, where the name of a file is needed", code="model.text_for_name"),
            _("for the text of a model write lw.loads(text)", code="model.write_loads"),
            "no-file",
        )
    allowed(path)
    try:
        if path.is_dir():
            raise _refuse(path, _("this is a folder"), _("name a model file in it"), "not-a-file")
        if not path.exists():
            raise _refuse(path, _("there is no such file"), _near_file(path), "no-file")
        return _content(path)
    except (OSError, ValueError) as error:
        unreadable = _("the file cannot be read ({reason})", reason=reason_of(error))
        raise _refuse(path, unreadable, _("check its name and permissions"), "no-file") from None


def _content(path: Path) -> bytes:
    """What a file holds, or a pipe or device gives; raises ModelError, OSError."""
    status = path.stat()
    most = _("a model has at most {most:.0f} MB", most=MAX_BYTES / 1e6)
    if not stat.S_ISREG(status.st_mode):
        content = _read_bytes(path)
    elif status.st_size > MAX_BYTES:
        raise _refuse(path, _("the file has {size:.1f} MB", size=status.st_size / 1e6), most, "size")
    else:
        content = path.read_bytes()
    if len(content) > MAX_BYTES:
        raise _refuse(path, _("the source has no end"), most, "size")
    return content


def _read_bytes(path: Path) -> bytes:
    """What a pipe or a device gives before it ends, without waiting for one that gives nothing."""
    if os.name != "posix":
        raise _refuse(path, _("this is neither a file nor a pipe"), _("name a model file"), "not-a-file")
    import select

    parts, total = list[bytes](), 0
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    try:
        while total <= MAX_BYTES:
            if not select.select([handle], [], [], PATIENCE)[0]:
                raise _refuse(path, _("nothing comes from it"), _("name a model file"), "not-a-file")
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
        return _('there is no folder "{folder}" either', folder=folder)
    names = [entry.name for entry in list(folder.iterdir())[:1000] if not entry.is_dir()]
    ended = (name for name in names if name in [path.name + ending for ending in ENDINGS])
    near = next(ended, None) or nearest(path.name, names)
    if near is None and path.name in gallery_names():
        return _('for the model of the gallery write "{gallery}{name}"', gallery=GALLERY, name=path.name)
    return _('did you mean "{offer}"?', offer=near) if near else _("check the path")


def _read_gallery(name: str) -> tuple[str, str]:
    try:
        content = gallery.content(name)
    except KeyError:
        names = gallery_names()
        near = nearest(name, names)
        remedy = (
            _('did you mean "{offer}"?', offer=f"{GALLERY}{near}")
            if near
            else _("one of: {names}", names=tuple(names))
        )
        problem = pgettext("model", 'the gallery has no model "{name}"', name=name)
        raise _refuse(GALLERY + name, problem, remedy, "no-file") from None
    return decode(content, f"{name}.yaml"), f"{name}.yaml"


def decode(content: bytes, name: str) -> str:
    """Text of a file's bytes; raises ModelError with the place of the first byte that is not UTF-8."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _refuse(name, _("the file is UTF-16"), _("save it as UTF-8"), "encoding")
    if b"\x00" in content:
        problem = _("the file is not text (a zero byte at offset {offset})", offset=content.index(0))
        raise _refuse(name, problem, _("name a model file, YAML or JSON in UTF-8"), "encoding")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start]
        line, column = before.count(b"\n") + 1, len(before) - before.rfind(b"\n")
        problem = _(
            "the file is not UTF-8: byte 0x{byte:02x} at offset {start}", byte=content[error.start], start=error.start
        )
        place = f"{name}:{line}:{column}"
        raise _refuse(place, problem, _("save it as UTF-8"), "encoding") from None
