"""``linkwright gallery``: the model files that come with Linkwright."""

from __future__ import annotations

from pathlib import Path

from rich.text import Text

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.files import atomic_write
from linkwright.cli.options import Options, argument, force
from linkwright.cli.session import Session
from linkwright.cli.usage import did_you_mean
from linkwright.errors import with_remedy
from linkwright.registry import nearest
from linkwright.words import _
from linkwright.words.sentence import Worded, in_language

SUMMARY = _("machines and calculations that come with Linkwright: list, show, copy")
DESCRIPTION = _(
    """\
Machines that come with Linkwright, from single dyads to an excavator arm. Each
file states its purpose, its source and expected numbers. gallery:NAME stands for
such a file wherever a command takes a model file."""
)
EXAMPLES = _(
    """\
linkwright gallery list
linkwright gallery list crusher                  names that contain "crusher"
linkwright gallery show slider_crank_inline
linkwright gallery copy jaw_crusher_sixbar .     a file of your own to change"""
)

CALCULATIONS = _("Calculations of machine parts (linkwright beam, statics, vibration, …):")
TASKS = _("Tasks of synthesis (linkwright synthesize gallery:NAME):")


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@argument("action", "list|show|copy", default="list", help=_("what to do (default: list)"), required=False)
@argument("name", "NAME", help=_("name of a model; for list: a part of names"), required=False)
@argument(
    "folder", "DIR", default=".", help=_("folder for the copy (default: the current one)"), required=False
)
@force
def run(options: Options, session: Session) -> int:
    """Lists the gallery, prints one of its files or copies it."""
    actions = {"list": _list, "show": _show, "copy": _copy}
    if options.action not in actions:
        choices = tuple(actions)
        said = _(
            '{name} cannot be "{value}"; choose from {choices}',
            code="cli.bad_choice",
            name="gallery",
            value=options.action,
            choices=choices,
        )
        offer = nearest(options.action, choices)
        hint = _('did you mean "{offer}"?', offer=f"gallery {offer}") if offer else ""
        raise UsageError(with_remedy(said, hint))
    return actions[options.action](options, session)


def _list(options: Options, session: Session) -> int:
    from linkwright import gallery

    models, parts, tasks = (
        [title_and_purpose(name) for name in names if (options.name or "") in name]
        for names in (gallery.names(), gallery.calculations(), gallery.tasks())
    )
    entries = [*models, *parts, *tasks]
    if session.json:
        session.show_data(entries)
        return 0
    wide = max((len(entry["name"]) for entry in entries), default=0)
    for entry in entries:
        if parts and entry is parts[0]:
            session.show(f"\n{session.say(CALCULATIONS)}")
        if tasks and entry is tasks[0]:
            session.show(f"\n{session.say(TASKS)}")
        name, title = entry["name"], in_language(entry["title"], session.language)
        session.show(Text.assemble((name.ljust(wide), "bold"), f"  {title}"))
    session.show()
    session.show(
        session.say(_("linkwright gallery show NAME prints a file; linkwright solve gallery:NAME solves it."))
    )
    return 0


def _show(options: Options, session: Session) -> int:
    name, text = _text(options)
    if session.json:
        session.show_data({**title_and_purpose(name), "text": text})
    else:
        session.show_as_is(text.rstrip("\n"))
    return 0


def _copy(options: Options, session: Session) -> int:
    name, text = _text(options)
    path = Path(options.folder) / f"{name}.yaml"
    atomic_write(path, text, force=options.force)
    if session.json:
        session.show_data({"written": str(path)})
    else:
        session.show_written(path)
    return 0


def _text(options: Options) -> tuple[str, str]:
    """Name and text of the model that is asked for; raises UsageError with the nearest name."""
    from linkwright import gallery

    if options.name is None:
        raise UsageError(
            _(
                "gallery {action}: which one? give a name; linkwright gallery list shows all",
                code="gallery.which",
                action=options.action,
            )
        )
    name = options.name.removeprefix("gallery:").removesuffix(".yaml")
    known = (*gallery.names(), *gallery.calculations(), *gallery.tasks())
    if name not in known:
        hint = _("see {command} --help", command="linkwright gallery")
        raise UsageError(
            did_you_mean(
                _('the gallery has no model "{name}"', code="gallery.unknown", name=name), name, known, hint
            )
        )
    return name, gallery.file(name).read_text(encoding="utf-8")


def title_and_purpose(name: str) -> dict[str, str]:
    """Title and purpose from the first lines of a gallery file, without reading the model."""
    from linkwright import gallery
    from linkwright.files.model_file import read_nodes
    from linkwright.files.reader import Reader

    first, _unused, _unused2 = gallery.file(name).read_text(encoding="utf-8").partition("\nsource:")
    root, _unused3 = read_nodes(first, name)
    assert root is not None
    given = Reader(name).free(root)
    return {"name": name, "title": Worded(given["name"]), "purpose": Worded(given["purpose"])}
