"""``linkwright mcp``: tools for assistants over the Model Context Protocol."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, option
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("tools for assistants (Model Context Protocol), bound to one folder"),
    _(
        """\
Serves tools over standard input and output for an assistant that speaks the
Model Context Protocol: check a model, solve, design numbers, draw, synthesize,
optimise, compare, report, change dimensions, explain findings, gallery, schema.
It reads and writes below one folder only, runs no code, and fetches nothing."""
    ),
    _(
        """\
linkwright mcp                           the current folder
linkwright mcp --folder ~/machines       another one
linkwright mcp --lang zh                 findings in Chinese"""
    ),
)
@option("--folder", "DIR", default=".", help=_("the folder that is read and written (default: the current one)"))
def run(options: Options, session: Session) -> int:
    """Serves until the input ends."""
    from pathlib import Path

    from linkwright.cli.errors import UsageError
    from linkwright.exporters.export import package

    folder = Path(options.folder)
    if not folder.is_dir():
        raise UsageError(
            _('there is no folder "{path}"; create it first', code="file.no_folder", path=options.folder)
        )
    package("mcp", _("tools for assistants"), '"linkwright[assistants]"')
    from linkwright.assistants.server import server

    server(folder, language=session.language).run("stdio")
    return 0
