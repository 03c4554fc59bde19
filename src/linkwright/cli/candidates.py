"""The task of ``synthesize`` from the command line, and its candidates as files and tables."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.cli.errors import UsageError
from linkwright.cli.files import atomic_write, refuse_existing, write_diagram
from linkwright.cli.options import Options
from linkwright.cli.session import Session
from linkwright.files.source import GALLERY
from linkwright.filesystem import make_folder
from linkwright.filesystem import refuse_folder as refuse_unusable
from linkwright.synthesis.names import TASK_NAMES
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.synthesis.result import Synthesis

BAD_DEMAND = _('invalid demand "{text}"; write KEY=VALUE, such as stroke="40 mm"', code="synthesize.bad_demand")


def task_of(name: str, demands: Sequence[str]) -> tuple[str, dict[str, Any]]:
    """A task and its demands, from a file or the command line; raises UsageError."""
    from linkwright.synthesis.tasks import asked_in, asked_of

    if name not in TASK_NAMES and not demands:
        path = Path(name)
        unknown = not path.suffix and not path.exists() and not name.startswith(GALLERY)
        return (name, {}) if unknown else asked_of(name)
    pairs = [text.partition("=") for text in demands]
    for text, equals, _value in pairs:
        if not equals:
            raise UsageError(BAD_DEMAND.format(text=text))
    lines = [f"  {key.strip()}: {value.strip()}" for key, _equals, value in pairs]
    return asked_in("\n".join(["synthesis:", f"  task: {name}", *lines]), "synthesize")


def refuse_folder(name: str | None, task: str, *, force: bool) -> None:
    """Raises RequestError, before any search, where models cannot be written into a folder."""
    if name is not None:
        folder = Path(name)
        refuse_unusable(folder)
        if folder.is_dir():
            refuse_existing(_model_path(folder, task, 0), force=force)


def show(found: Synthesis, options: Options, session: Session) -> None:
    """Writes the candidates as model files and in a diagram where asked, and prints them with their loads."""
    if options.mass is not None:
        found = found.with_loads(options.mass, speed=options.speed)
    written: list[Path | str] = []
    for index in range(0 if options.output is None else len(found)):
        path = _model_path(make_folder(options.output), found.task, index)
        text = found.model_text(index, language=session.language, speed=options.speed)
        atomic_write(path, text, force=options.force)
        written.append(path)
    write_diagram(found, options, session)
    text, data = "", {}
    if options.worked:
        worked = found.worked(session.language)
        loads = ("\n".join(each.lines(session.language)) for each in found.load_tables())
        text, data = "\n\n".join([worked.text(), *loads]), {"worked": worked.data()}
    session.show_result(found, *written, options.plot, text=text, data=data, spaced=False)


def _model_path(folder: Path, task: str, index: int) -> Path:
    return folder / f"{task}_{index + 1}.yaml"
