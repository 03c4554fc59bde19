"""Files that commands write, whole or not at all, never over another one unless asked: tables, data, diagrams."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright import filesystem
from linkwright.cli.errors import UsageError
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.core.attached import Plotted
    from linkwright.core.table import Tabular
    from linkwright.designs.compare import Comparison


PICTURES = (".svg", ".pdf", ".png")
#: Files of results.
RESULTS = (".csv", ".json", ".xlsx", ".md", ".html")


ENDING_SAYS = _('"{path}": the ending says what is written; end the name in {endings}', code="cli.bad_suffix")


def refuse_existing(path: Path, *, force: bool) -> None:
    """Raises RequestError where a file could not be written later, before any work is done."""
    filesystem.refuse_target(path, force=force, remedy="--force")


def atomic_write(path: Path, content: str | bytes, *, force: bool) -> None:
    """Writes a file by way of a temporary one beside it, so that a broken one is never seen."""
    encoded = content.encode() if isinstance(content, str) else content
    filesystem.atomic_write(path, encoded, force=force, remedy="--force")


def write_diagram(
    name: str | None,
    found: Plotted,
    session: Session,
    *,
    force: bool,
    kind: str | None = None,
) -> None:
    """Draws a diagram of a result, the usual one unless a ``kind`` is named; the file's ending is its format."""
    if name is None:
        return
    path = Path(name)
    content = found.plot(kind=kind, language=session.language).content(path.suffix.lower())
    atomic_write(path, content, force=force)


def refuse_output(name: str | None, endings: Sequence[str], *, force: bool) -> None:
    """Raises UsageError for a file that could not be written, before any work is done."""
    if name is None:
        return
    path = Path(name)
    if path.suffix.lower() not in endings:
        raise UsageError(ENDING_SAYS.format(path=path, endings=tuple(endings)))
    refuse_existing(path, force=force)


def write_table(name: str | None, table: Callable[[], str], data: Callable[[], Any], *, force: bool) -> None:
    """Writes the table or the data, as the file's ending says."""
    if name is None:
        return
    from linkwright.core.json_data import json_text

    path = Path(name)
    text = table() if path.suffix.lower() == ".csv" else json_text(data()) + "\n"
    atomic_write(path, text, force=force)


def write_result(name: str | None, found: Tabular, session: Session, *, force: bool) -> None:
    """Writes a result as the file's ending says: its columns or tables, or its data."""
    if name is None:
        return
    from linkwright.exporters.export import chosen_format, content_of

    path = Path(name)
    atomic_write(path, content_of(found, chosen_format(path, None), session.language), force=force)


def curve_columns(found: Comparison) -> dict[str, Any]:
    """Curves of a comparison as columns, SI."""
    from linkwright.units import si_unit

    columns: dict[str, Any] = {}
    for overlay in found.curves:
        unit = si_unit(overlay.dimension)
        for label, (across, values) in overlay.lines.items():
            if overlay.name == "hodograph":
                columns[f"{label}: pivot_reaction.x [{unit}]"] = across
                columns[f"{label}: pivot_reaction.y [{unit}]"] = values
                continue
            columns.setdefault(f"{label}: input", across)
            columns[f"{label}: {overlay.name} [{unit}]"] = values
    return columns


def curve_data(found: Comparison) -> list[dict[str, Any]]:
    """The same as plain data."""
    from linkwright.units import si_unit

    return [
        {
            "name": overlay.name,
            "unit": si_unit(overlay.dimension),
            "lines": {label: {"x": x.tolist(), "y": y.tolist()} for label, (x, y) in overlay.lines.items()},
        }
        for overlay in found.curves
    ]
