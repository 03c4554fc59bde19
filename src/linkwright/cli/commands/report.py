"""``linkwright report``: the whole report of a machine, or of several."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.files import ENDING_SAYS
from linkwright.cli.options import Options, argument, fonts, force, option
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism

SUMMARY = _(
    "the whole report: structure, method, worked position, tables, curves, forces, flywheel",
)
DESCRIPTION = _(
    """\
Writes the report of a machine as PDF, HTML or Word file: task and data, drawing,
structure, method, one worked position with its polygons, tables over the cycle,
curves, joint forces, driving torque by both methods, design numbers, flywheel,
appendix, references. Several files are compared. The section "report" of a model
file sets title, cover, own chapters and text, sources, order and more."""
)
EXAMPLES = _(
    """\
linkwright report gallery:swing_conveyor
linkwright report crusher.yaml --to docx --lang zh
linkwright report a.yaml b.yaml --output comparison.pdf
linkwright report crusher.yaml --sections task structure worked tables"""
)

FORMS = ("pdf", "html", "docx")
#: Names of the sections in their usual order.
SECTIONS = (
    "task", "drawing", "structure", "flow", "method", "worked", "tables", "curves", "reactions", "balance",
    "free_bodies", "gears", "cams", "torque", "limits", "flywheel", "synthesis", "errata", "calls", "program",
    "comparison", "conclusion", "appendix", "references",
)  # fmt: skip


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@argument(
    "files",
    "FILE",
    help=_("model files, or gallery:NAME; several are compared"),
    nargs=-1,
    required=True,
    model=True,
)
@option(
    "--sections",
    "NAME",
    default=[],
    help=_(
        "sections in the order wanted, of: {names}; titles of own chapters; rest: all others",
        names=", ".join(SECTIONS),
    ),
    several=True,
)
@option(
    "--position",
    "INPUT",
    default="",
    help=_('input of the worked position: "60 deg" (default: a sixth of the cycle)'),
)
@option(
    "--positions",
    "POSITIONS",
    help=_(
        'positions of the tables: so many (default: 24), or a list: "0..-360 deg:15 deg", "0 '
        'deg, 60 deg, limits"',
    ),
    several=True,
)
@option("--to", "pdf|html|docx", help=_("pdf, html or docx (default: what --output says, else pdf)"))
@option("--output", "FILE", help=_("file to write (default: the model's name)"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Writes the report; sections that have nothing to show are named on the console."""
    from linkwright.cli.files import atomic_write
    from linkwright.cli.positions import joined
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.parts.file import kind_of
    from linkwright.reports.report import report
    from linkwright.synthesis.task_file import task_file

    path = _path(options)
    machines: list[Mechanism | str] = []
    sources = []
    for file in options.files:
        if kind_of(file) or task_file(file) is not None:
            machines.append(file)
        else:
            machines.append(read_model(file, session)[0])
            sources.append(file)
    with progress(session, _("report")) as told:
        found = report(
            machines,
            sources=sources,
            sections=options.sections,
            language=session.language,
            position=options.position,
            positions=joined(options.positions) if options.positions else None,
            progress=told,
        )
        content = found.content(path.suffix.lower())
    atomic_write(path, content, force=options.force)
    if session.json:
        session.show_data({"ok": not found.broken, "file": str(path), "missing": list(found.missing)})
        return int(found.broken)
    if found.missing:
        session.tell(session.say(_("Not in the report:")))
        for sentence in found.missing:
            session.tell(f"  {sentence}")
    session.show_written(path)
    return int(found.broken)


def _path(options: Options) -> Path:
    """Where the report goes; refused before any work is done."""
    from linkwright.cli.files import refuse_existing

    if options.to is not None and options.to not in FORMS:
        raise UsageError(
            _('--to: "{text}" is no form; use pdf, html or docx', code="report.bad_form", text=options.to)
        )
    source = Path(options.files[0].removeprefix("gallery:")).stem
    path = Path(options.output or f"{source}-report.{options.to or 'pdf'}")
    if path.suffix.lower().lstrip(".") not in FORMS or (
        options.to and path.suffix.lower() != f".{options.to}"
    ):
        endings = tuple(f".{form}" for form in FORMS if options.to in (None, form))
        raise UsageError(ENDING_SAYS.format(path=path, endings=endings))
    refuse_existing(path, force=options.force)
    return path
