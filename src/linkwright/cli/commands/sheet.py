"""``linkwright sheet``: the drawing sheet of a machine or a cam."""

from __future__ import annotations

import argparse
from pathlib import Path

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.sheets.paper import SIZES
from linkwright.words import _

ENDINGS = (".pdf", ".svg", ".dxf")


def arguments(option: Options) -> None:
    option.model()
    option("--size", choices=tuple(SIZES))
    option("--kind", choices=("mechanism", "cam"))
    option("--of", "NAME", default="")
    option("--output", "FILE")
    option.of("draw")("--fonts", "FILE", nargs="+", default=())
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Lays out the sheet and writes it."""
    from linkwright.cli.files import refuse_existing
    from linkwright.sheets.sheet import sheet

    path = Path(options.output or f"{Path(options.file.removeprefix('gallery:')).stem}-sheet.pdf")
    if path.suffix.lower() not in ENDINGS:
        raise UsageError(
            _(
                '"{path}": the ending says what is written; end the name in {endings}',
                code="cli.bad_suffix",
                path=path,
                endings=ENDINGS,
            )
        )
    refuse_existing(path, force=options.force)
    found = sheet(
        options.file, kind=options.kind, of=options.of, size=options.size, language=session.language
    )
    found.save(path, force=options.force, fonts=options.fonts)
    if session.json:
        session.show_data({
            "ok": True, "file": str(path), "size": found.paper.size, "scale": found.scale,
            "panels": list(found.panels), "notes": list(found.notes),
        })  # fmt: skip
        return 0
    for note in found.notes:
        session.tell(note)
    session.show_written(path)
    return 0
