"""``linkwright gallery``: the model files that come with Linkwright."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, argument, force
from linkwright.cli.session import Session
from linkwright.words import _

ACTIONS = ("list", "show", "copy")


@command(
    _("machines and calculations that come with Linkwright: list, show, copy"),
    _(
        """\
Machines that come with Linkwright, from single dyads to an excavator arm. Each
file states its purpose, its source and expected numbers. gallery:NAME stands for
such a file wherever a command takes a model file."""
    ),
    _(
        """\
linkwright gallery list
linkwright gallery list crusher                  names that contain "crusher"
linkwright gallery show slider_crank_inline
linkwright gallery copy jaw_crusher_sixbar .     a file of your own to change"""
    ),
)
@argument("action", "|".join(ACTIONS), choices=ACTIONS, default="list", help=_("what to do (default: list)"))
@argument("name", "NAME", help=_("name of a model; for list: a part of names"), required=False)
@argument("folder", "DIR", default=".", help=_("folder for the copy (default: the current one)"), required=False)
@force
def run(options: Options, session: Session) -> int:
    """Lists the gallery, prints one of its files or copies it."""
    from pathlib import Path

    from linkwright.cli.files import atomic_write
    from linkwright.cli.gallery_files import file_text, show_list, title_and_purpose

    if options.action == "list":
        show_list(options.name or "", session)
        return 0
    name, text = file_text(options.name, options.action)
    if options.action == "show":
        if session.json:
            session.show_data({**title_and_purpose(name), "text": text})
        else:
            session.show_as_is(text.rstrip("\n"))
        return 0
    path = Path(options.folder) / f"{name}.yaml"
    atomic_write(path, text, force=options.force)
    if session.json:
        session.show_data({"written": str(path)})
    else:
        session.show_written(path)
    return 0
