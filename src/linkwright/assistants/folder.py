"""The folder that the server is bound to: models as texts, as files in it, of the gallery; files that are written."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from linkwright.cli.files import ENDING_SAYS
from linkwright.errors import Finding, ModelError, RequestError
from linkwright.files.model_file import read_text
from linkwright.files.source import ENDINGS, GALLERY, read_source
from linkwright.files.write import Document
from linkwright.filesystem import atomic_write, below, refuse_target, within
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import _
from linkwright.words.characters import printable

#: Files that are listed.
LISTED = 100


@dataclass(frozen=True)
class Source:
    """The text of a model; ``name`` as findings name it; ``given``: how it may be named in a next call, "" for a
    text; ``folder``: where files lie that it names.
    """

    text: str
    name: str
    given: str
    folder: Path

    def document(self) -> Document:
        """The model, to be changed with its comments kept; raises ModelError."""
        return Document(self.text, self.name, read_text)

    def mechanism(self) -> tuple[Mechanism, list[Finding]]:
        """The machine, and findings that do not hinder; raises ModelError."""
        mechanism, findings = read_text(self.text, self.name)
        if mechanism is None:
            raise ModelError(findings)
        return mechanism, findings


class Folder:
    """Reads and writes below one folder."""

    def __init__(self, path: Path) -> None:
        self.path = path.resolve()

    def source(self, model: str) -> Source:
        """The model that an argument means: ``gallery:NAME``, the name of a file in the folder, or the text itself.

        Raises RequestError for a file elsewhere, ModelError for one that is not there.
        """
        given = model.strip()
        if not given:
            raise RequestError(
                _(
                    "the model is empty; give the text of a model file, a file in the folder, or gallery:NAME",
                    code="model.none_given",
                )
            )
        if given.startswith(GALLERY) and "\n" not in given:
            text, name = read_source(given)
            return Source(text, name, given, self.path)
        if is_text(given):
            return Source(model, "model", "", self.path)
        path = self.existing(given)
        text, _unused = read_source(path)
        inner = path.relative_to(self.path).as_posix()
        return Source(text, inner, inner, path.parent)

    def file(self, name: str) -> Path:
        """The path of a name in the folder; raises RequestError for one that leads elsewhere."""
        return within(self.path, name)

    def existing(self, name: str) -> Path:
        """The path of a file that is there; raises RequestError for one elsewhere, ModelError for one that is not."""
        path = self.file(name)
        with suppress(OSError):  # a name that no file can have
            if path.is_file():
                return path
        raise ModelError([self._absent(name)])

    def _absent(self, name: str) -> Finding:
        """That there is no such file, with the nearest one."""
        hint = offered(name, self.models(), _("the folder has {names}"))
        message = _('there is no file "{name}" in the folder', name=printable(name))
        return Finding("error", "", "", message, hint or _("give the text of the model"), "no-file")

    def target(self, name: str, endings: Iterable[str] = ENDINGS, *, overwrite: bool = False) -> Path:
        """Where a file of a name may be written; raises RequestError before any work is done where it may not."""
        path = self.file(name)
        if path.suffix.lower() not in endings:
            raise RequestError(ENDING_SAYS.format(path=printable(name), endings=tuple(endings)))
        refuse_target(path, force=overwrite, remedy="overwrite=true")
        return path

    def write(self, path: Path, content: bytes, *, overwrite: bool = False) -> str:
        """Writes a file; its name in the folder."""
        atomic_write(path, content, force=overwrite, remedy="overwrite=true")
        return path.relative_to(self.path).as_posix()

    def models(self) -> list[str]:
        """Files in the folder whose names end as those of models, at most ``LISTED``."""
        found = []
        for path in sorted(self.path.rglob("*")):
            if path.suffix.lower() in ENDINGS and below(self.path, path) is not None and path.is_file():
                found.append(path.relative_to(self.path).as_posix())
            if len(found) == LISTED:
                break
        return found


def is_text(model: str) -> bool:
    """Whether an argument is the text of a model and not the name of a file."""
    return "\n" in model or "://" in model or model.startswith(("{", "[", "<", "format:", "%", "---"))
