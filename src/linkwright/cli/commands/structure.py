"""``linkwright structure``: mobility and Assur groups; the traced program."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, flag, model
from linkwright.cli.session import Session, bold
from linkwright.words import _


@command(
    _("mobility and Assur groups in solving order"),
    _(
        """\
Prints the structure analysis of a mechanism: how many links and pairs, its
mobility by Grübler's formula and what special geometry changes about it, and the
Assur groups in the order in which they are solved, with class and order."""
    ),
    _(
        """\
linkwright structure gallery:shaper_quick_return
linkwright structure crusher.yaml --program       what is computed, line by line
linkwright structure crusher.yaml --json"""
    ),
)
@model
@flag("--program", help=_("print the straight-line program of the motion, with its operation counts"))
@flag("--forces", help=_("print the program with the joint forces (implies --program)"))
def run(options: Options, session: Session) -> int:
    """Prints the structure analysis; with ``--program`` the straight-line program as well."""
    from linkwright.cli.files import read_model
    from linkwright.kinematics.rank_of_motion import rank_sentence
    from linkwright.kinematics.structure_with_rank import analysed
    from linkwright.kinetostatics.solver import operations, program_of_results

    mechanism, _findings = read_model(options.file, session)
    structure = analysed(mechanism)
    rank = rank_sentence(mechanism, "en" if session.json else session.language)
    asked = options.program or options.forces
    program = program_of_results(mechanism, forces=options.forces) if asked else None
    if session.json:
        data: dict[str, object] = {"ok": True, "name": mechanism.name, **structure.data(), "rank": rank}
        if program is not None:
            data["program"] = {"operations": program.counts(), "lines": program.text().splitlines()}
        session.show_data(data)
        return 0
    session.show(bold(mechanism.name), "")
    session.show_tables(structure)
    if rank:
        session.show(session.translate(_("{sentence}.", sentence=rank)))
    if program is not None:
        session.show("", *operations(program).lines(session.language), "")
        session.show_as_is(program.text())
    return 0
