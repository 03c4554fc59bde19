"""``linkwright schema``: the JSON Schema of models and calculations, for editors."""

from __future__ import annotations

import argparse

from linkwright.cli.session import Session
from linkwright.words import Say


def arguments(parser: argparse.ArgumentParser, say: Say) -> None:
    """The command's options."""
    parser.add_argument("--output", metavar="FILE", help=say("schema.output_help"))
    parser.add_argument("--force", action="store_true", help=say("cli.force_help"))


def run(options: argparse.Namespace, session: Session) -> int:
    """Prints the schema, or writes it."""
    from pathlib import Path

    from linkwright.cli.data import json_text
    from linkwright.cli.files import write_whole
    from linkwright.parts.file import file_schema

    text = json_text(file_schema())
    if options.output is None:
        session.show(text)
        return 0
    write_whole(Path(options.output), text + "\n", force=options.force)
    session.show(session.say("cli.written", path=options.output))
    return 0
