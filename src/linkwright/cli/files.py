"""Files of commands: the model that one reads, and results and diagrams that one writes.

A file is written completely or not at all, never over another one unless asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright import filesystem
from linkwright.cli.errors import UsageError
from linkwright.errors import Finding, ModelError
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.cli.options import Options
    from linkwright.cli.session import Session
    from linkwright.core.attached import PlotMixin
    from linkwright.core.table import Tabular
    from linkwright.designs.optimise.optimum import Optimum
    from linkwright.mechanism.mechanism import Mechanism

ENDING_SAYS = _('"{path}": the ending says what is written; end the name in {endings}', code="cli.bad_suffix")


def read_model(source: str, session: Session) -> tuple[Mechanism, list[Finding]]:
    """The mechanism of a path or ``gallery:NAME``, and findings that do not hinder; raises ModelError.

    One that gives its name in several languages has that of the reader, except in data.
    """
    from linkwright.files.model_file import read_text
    from linkwright.files.source import read_source

    mechanism, findings = read_text(*read_source(source))
    if mechanism is None:
        raise ModelError(findings)
    return mechanism if session.json else mechanism.translate(session.language), findings


def refuse_existing(path: Path, *, force: bool) -> None:
    """Raises RequestError where a file could not be written later, before any work is done."""
    filesystem.refuse_target(path, force=force, remedy="--force")


def refuse_output(name: str | Path, endings: Sequence[str], *, force: bool) -> None:
    """Raises UsageError for a file that could not be written, before any work is done."""
    path = Path(name)
    if path.suffix.lower() not in endings:
        raise UsageError(ENDING_SAYS.format(path=path, endings=tuple(endings)))
    refuse_existing(path, force=force)


def atomic_write(path: Path, content: str | bytes, *, force: bool) -> None:
    """Writes a file by way of a temporary one next to it, so that no incomplete one is ever there."""
    encoded = content.encode() if isinstance(content, str) else content
    filesystem.atomic_write(path, encoded, force=force, remedy="--force")


def default_path(source: str, suffix: str) -> Path:
    """A name in this folder for what a command makes of a model file."""
    return Path(f"{Path(source.removeprefix('gallery:')).stem}{suffix}")


def write_diagram(
    found: PlotMixin, options: Options, session: Session, *, kind: str | None = None, name: str = "plot"
) -> None:
    """Draws a diagram of a result where the option of that name asks for one, the usual one unless a ``kind`` is
    named."""
    if (target := getattr(options, name)) is not None:
        path = Path(target)
        content = found.plot(kind=kind, language=session.language).content(path.suffix.lower())
        atomic_write(path, content, force=options.force)


def write_result(found: Tabular, options: Options, session: Session) -> None:
    """Writes a result where ``--output`` asks for it: columns, tables or data, as the file's ending says."""
    if options.output is not None:
        from linkwright.exporters.export import chosen_format, content_of

        path = Path(options.output)
        content = content_of(found, chosen_format(path, None), session.language)
        atomic_write(path, content, force=options.force)


def present(found: Tabular, options: Options, session: Session, *written: object, **shown: Any) -> None:
    """Writes a result as ``--output`` and ``--plot`` ask, and prints it; ``written``: further files to be named."""
    write_result(found, options, session)
    if "plot" in vars(options):
        write_diagram(found, options, session)  # type: ignore[arg-type]
    session.show_result(found, options.output, *written, getattr(options, "plot", None), **shown)


def write_table(name: str, columns: dict[str, Any], data: Any, *, force: bool) -> None:
    """Writes columns as CSV or data as JSON, as the file's ending says."""
    from linkwright.core.data import json_text
    from linkwright.core.table import csv_text

    path = Path(name)
    text = csv_text(columns) if path.suffix.lower() == ".csv" else json_text(data) + "\n"
    atomic_write(path, text, force=force)


def write_models(name: str | None, found: Optimum, *, force: bool) -> list[str]:
    """Writes the designs of an optimum as model files, NAME, NAME_2, …, and returns what to name as written."""
    if name is None:
        return []
    path = Path(name)
    others = [path.with_name(f"{path.stem}_{k}{path.suffix}") for k in range(2, len(found) + 1)]
    for index, target in enumerate([path, *others]):
        atomic_write(target, found.model_text(index), force=force)
    return [f"{path} … {others[-1]}" if others else str(path)]
