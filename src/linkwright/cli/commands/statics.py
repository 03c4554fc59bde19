"""``linkwright statics``: force systems, rigid bodies, belts, wedges, and pinned structures of model files."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options
from linkwright.cli.part import part_options, run_part, show
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("resultants, reactions of bodies and structures, belts, wedges, balancing of rotors"),
    _(
        """\
Adds up systems of forces (resultant, moment, wrench, equilibrant), finds the
reactions of rigid bodies and of pinned structures, the tensions of belts, the
pushes on wedges and the counterweights of rotors. A structure is a model file
of links and joints without a drive."""
    ),
    """\
linkwright statics gallery:force_system
linkwright statics gallery:two_bars_equilibrium --worked
linkwright statics bracket.yaml --plot bracket.svg""",
)
@part_options
def run(options: Options, session: Session) -> int:
    """Solves the file's problem; a file without ``kind`` is a structure of links and joints."""
    from linkwright.cli.source import read_model
    from linkwright.parts.file import kind_of
    from linkwright.parts.statics.structure import equilibrium

    if kind_of(options.file) is not None:
        return run_part(options, session, "statics")
    mechanism, _ = read_model(options.file, session)
    show(equilibrium(mechanism), options, session)
    return 0
