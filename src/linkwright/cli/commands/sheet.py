"""``linkwright sheet``: the drawing sheet of a machine or a cam."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.files import default_path, refuse_output
from linkwright.cli.options import Options, fonts, force, model, option
from linkwright.cli.session import Session
from linkwright.fields.sheet import SIZES
from linkwright.words import _

ENDINGS = (".pdf", ".svg", ".dxf")


@command(
    _("the drawing sheet, A0 to A4: mechanism, polygons, diagrams, tables, title block"),
    _(
        """\
Draws the sheet of a course design: the mechanism to a standard scale in one or two
positions, velocity, acceleration and force polygons, diagrams over the cycle and
tables, in a frame with a title block; for a cam, its profile. One millimetre on the
sheet is one on paper. The section "sheet" of the file fills the title block and
moves, scales or leaves out single panels."""
    ),
    """\
linkwright sheet gallery:shaper_quick_return
linkwright sheet shaper.yaml --size A2 --output shaper.dxf
linkwright sheet shaper.yaml --size A1 --lang zh""",
)
@model
@option("--size", choices=SIZES, help=_("paper size, A0 to A4 (default: what the file says, else A1, A2 for a cam)"))
@option("--kind", choices=("mechanism", "cam"), help=_("mechanism or cam (default: what the file holds)"))
@option("--of", "NAME", default="", help=_("the part that is meant, where there are several: the joint of a cam"))
@option("--output", "FILE", help=_("file to write: .pdf, .svg or .dxf (default: the model's name, .pdf)"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Lays out the sheet and writes it."""
    from linkwright.sheets.sheet import sheet

    path = Path(options.output) if options.output else default_path(options.file, "-sheet.pdf")
    refuse_output(path, ENDINGS, force=options.force)
    settings = {name: getattr(options, name) for name in ("kind", "of", "size")}
    found = sheet(options.file, language=session.language, **settings)
    found.save(path, force=options.force, fonts=options.fonts)
    data = {"ok": True, "file": str(path), "size": found.paper.size, "scale": found.scale}
    for note in () if session.json else found.notes:
        session.tell(note)
    session.show_written(path, data={**data, "panels": [*found.panels], "notes": [*found.notes]})
    return 0
