"""``linkwright studio``: draw, change and solve a machine in the browser, next to its file."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, argument, count, flag
from linkwright.cli.session import Session
from linkwright.words import _
from linkwright.words.message import reason_of

LAST_PORT = 65535
OUTSIDE = _("{name} is not a model file below the folder in which the studio was started", code="studio.outside")


NO_PORT = _("port {port} cannot be used: {reason}; choose another one, or none for a free one", code="studio.no_port")


@command(
    _("draw, change and solve a machine in the browser, next to its file"),
    _(
        """\
Opens the studio in the browser: a sheet on which a mechanism is drawn, loaded, moved and designed, with
its curves and numbers next to it; the text of its file follows, with comments and order as they were.
The server answers this machine only and reads and writes model files below the folder it is started
in. Every change is saved at once; what was not saved is there again after a crash."""
    ),
    _(
        """\
linkwright studio
linkwright studio crusher.yaml
linkwright studio 'http://127.0.0.1/#model=…'    a shared link, as a new drawing"""
    ),
)
@argument(
    "file",
    "FILE",
    help=_("the model file, below this folder, or a shared link; a new one may be named"),
    required=False,
    model=True,
)
@count("--port", 0, help=_("the port (default: a free one)"))
@flag("--no-browser", help=_("only print the address"))
def run(options: Options, session: Session) -> int:
    """Serves the folder that it is started in until it is interrupted."""
    import webbrowser
    from pathlib import Path

    from linkwright.cli.errors import UsageError
    from linkwright.server.shared import holds_model, model_of
    from linkwright.server.web import drafted, started

    folder, name = Path.cwd().resolve(), None
    if options.file is not None and holds_model(options.file):
        name = drafted(folder, model_of(options.file), session.language)
    elif options.file is not None:
        path = (folder / options.file).resolve()
        if not path.is_relative_to(folder):
            raise UsageError(OUTSIDE.format(name=options.file))
        name = path.relative_to(folder).as_posix()
    if not 0 <= options.port <= LAST_PORT:
        raise UsageError(NO_PORT.format(port=options.port, reason=_("ports go from 0 to {last}", last=LAST_PORT)))
    try:
        studio = started(folder, name, port=options.port, language=session.language)
    except OSError as problem:
        raise UsageError(NO_PORT.format(port=options.port, reason=reason_of(problem))) from None
    with studio:
        if name is not None:
            studio.work.foresee(name, session.language)
        session.show(session.translate(_("The studio is at {url} (end it with Ctrl+C)", url=studio.url)))
        if not options.no_browser:
            webbrowser.open(studio.url)
        studio.serve_forever()
    return 0
