"""``linkwright gallery``: the model files that come with Linkwright."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.text import Text

from linkwright import gallery
from linkwright.cli.command import command
from linkwright.cli.errors import UsageError, did_you_mean
from linkwright.cli.files import atomic_write
from linkwright.cli.options import Options, argument, force
from linkwright.cli.session import Session
from linkwright.words import _
from linkwright.words.message import in_language

ACTIONS = ("list", "show", "copy")
TITLES = (
    None,
    _("Calculations of machine parts (linkwright beam, statics, vibration, …):"),
    _("Tasks of synthesis (linkwright synthesize gallery:NAME):"),
)
NEXT = _("linkwright gallery show NAME prints a file; linkwright solve gallery:NAME solves it.")
WHICH = _("gallery {action}: which one? give a name; linkwright gallery list shows all", code="gallery.which")
UNKNOWN = _('the gallery has no model "{name}"', code="gallery.unknown")


@command(
    _("machines and calculations that come with Linkwright: list, show, copy"),
    _(
        """\
Machines that come with Linkwright, from single dyads to an excavator arm. Each
file states its purpose, its source and expected numbers. gallery:NAME is
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
    from linkwright.files.gallery_entries import entries, entry

    if options.action == "list":
        _show_list(entries(options.name or ""), session)
        return 0
    name, text = _file_text(options.name, options.action)
    if options.action == "copy":
        path = Path(options.folder) / f"{name}.yaml"
        atomic_write(path, text, force=options.force)
        session.show_written(path, data={"written": str(path)})
    elif session.json:
        session.show_data({**entry(name), "text": text})
    else:
        session.show_as_is(text.rstrip("\n"))
    return 0


def _show_list(kinds: Sequence[list[dict[str, str]]], session: Session) -> None:
    """Prints names and titles of models, calculations and tasks."""
    shown = [entry for entries in kinds for entry in entries]
    if session.json:
        session.show_data(shown)
        return
    wide = max((len(entry["name"]) for entry in shown), default=0)
    for title, entries in zip(TITLES, kinds, strict=True):
        if title and entries:
            session.show("", session.translate(title))
        for entry in entries:
            text = in_language(entry["title"], session.language)
            session.show(Text.assemble((entry["name"].ljust(wide), "bold"), f"  {text}"))
    session.show("", session.translate(NEXT))


def _file_text(name: str | None, action: str) -> tuple[str, str]:
    """Name and text of a file; raises UsageError with the nearest name."""
    if name is None:
        raise UsageError(WHICH.format(action=action))
    name = name.removeprefix("gallery:").removesuffix(".yaml")
    try:
        return name, gallery.content(name).decode()
    except KeyError:
        known = (*gallery.names(), *gallery.calculations(), *gallery.tasks())
        hint = _("see {command} --help", command="linkwright gallery")
        raise UsageError(did_you_mean(UNKNOWN.format(name=name), name, known, hint)) from None
