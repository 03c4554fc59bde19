"""``linkwright schema``: the JSON Schema of models and calculations, for editors."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, force, option
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("JSON Schema of models and calculations, for editors"),
    _(
        """\
Prints the JSON Schema of models and calculations (draft 2020-12), generated from the model itself.
Editors complete keys and mark mistakes with it: write as the first line of a model
# yaml-language-server: $schema=./linkwright.schema.json"""
    ),
    """\
linkwright schema --output linkwright.schema.json
linkwright schema | less""",
)
@option("--output", "FILE", help=_("write it to a file"))
@force
def run(options: Options, session: Session) -> int:
    """Prints the schema, or writes it."""
    from pathlib import Path

    from linkwright.cli.files import atomic_write
    from linkwright.core.data import json_text
    from linkwright.parts.file import file_schema

    text = json_text(file_schema())
    if options.output is None:
        session.show_as_is(text)
        return 0
    atomic_write(Path(options.output), text + "\n", force=options.force)
    session.show_written(options.output)
    return 0
