"""``linkwright report``: the full report of a machine, or of several."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.files import atomic_write, default_path, refuse_output
from linkwright.cli.options import Options, argument, fonts, force, option
from linkwright.cli.session import Session
from linkwright.words import _

FORMS = ("pdf", "html", "docx")
#: Names of the sections in their usual order.
SECTIONS = (
    *("task", "drawing", "structure", "flow", "method", "worked", "tables", "curves", "reactions", "balance"),
    *(
        "free_bodies",
        "gears",
        "cams",
        "torque",
        "limits",
        "flywheel",
        "run",
        "synthesis",
        "sizing",
        "parts",
        "errata",
        "calls",
        "program",
    ),
    *("comparison", "conclusion", "appendix", "references"),
)


@command(
    _("the full report: structure, method, worked position, tables, curves, forces, flywheel"),
    _(
        """\
Writes the report of a machine as PDF, HTML or Word file: task and data, drawing,
structure, method, one worked position with its polygons, tables over the cycle,
curves, joint forces, driving torque by both methods, metrics, flywheel,
appendix, references. Several files are compared. The section "report" of a model
file sets title, cover, own chapters and text, sources, order and more."""
    ),
    _(
        """\
linkwright report gallery:swing_conveyor
linkwright report crusher.yaml --to docx --lang zh
linkwright report a.yaml b.yaml --output comparison.pdf
linkwright report crusher.yaml --sections task structure worked tables"""
    ),
)
@argument(
    "files", "FILE", help=_("model files, or gallery:NAME; several are compared"), nargs=-1, required=True, model=True
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
        'positions of the tables: so many (default: 24), or a list: "0..-360 deg:15 deg", "0 deg, 60 deg, limits"'
    ),
    several=True,
)
@option("--to", choices=FORMS, help=_("pdf, html or docx (default: what --output says, else pdf)"))
@option("--output", "FILE", help=_("file to write (default: the model's name)"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Writes the report; sections that have nothing to show are named on the console."""
    from linkwright.cli.files import read_model
    from linkwright.cli.positions import joined
    from linkwright.cli.session import progress
    from linkwright.parts.file import kind_of
    from linkwright.reports.report import report
    from linkwright.synthesis.tasks import task_file

    forms = FORMS if options.to is None else (options.to,)
    path = Path(options.output) if options.output else default_path(options.files[0], f"-report.{forms[0]}")
    refuse_output(path, [f".{form}" for form in forms], force=options.force)
    calculations = [file for file in options.files if kind_of(file) or task_file(file) is not None]
    with progress(session, _("report")) as steps:
        found = report(
            [file if file in calculations else read_model(file, session)[0] for file in options.files],
            sources=[file for file in options.files if file not in calculations],
            sections=options.sections,
            language=session.language,
            position=options.position,
            positions=joined(options.positions) if options.positions else None,
            progress=steps,
        )
        content = found.content(path.suffix.lower())
    atomic_write(path, content, force=options.force)
    if found.missing and not session.json:
        session.tell("\n  ".join([session.translate(_("Not in the report:")), *found.missing]))
    session.show_written(path, data={"ok": not found.broken, "file": str(path), "missing": list(found.missing)})
    return int(found.broken)
