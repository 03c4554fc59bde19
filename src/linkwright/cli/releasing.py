"""``solve --free``: accelerations and reactions of a mechanism that nothing drives, at the positions named."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from rich.text import Text

from linkwright.cli.errors import NOT_TOGETHER, UsageError
from linkwright.cli.options import Options
from linkwright.cli.positions import inputs, joined, one_speed
from linkwright.cli.session import Session
from linkwright.cli.solve_text import report
from linkwright.cli.solving import Solved, data, input_text, named_columns
from linkwright.core.table import Amount, Cell, Table
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.release import Release, released
from linkwright.dynamics.samples import Samples
from linkwright.dynamics.states import forces_at, motion_at
from linkwright.errors import Finding
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _, pgettext

#: Options that ask for a motion that drivers prescribe.
NOT_FREE = ("steps", "times", "static", "mark", "prove")
#: What becomes of a mechanism in words.
OUTCOMES = {
    "moves": _("moves"),
    "rests": _("rests: forces balance"),
    "sticks": _("sticks: friction holds it"),
    "jams": _("jams: no single answer"),
}


def free_run(mechanism: Mechanism, warnings: list[Finding], options: Options, session: Session) -> int:
    """Prints or writes the releases at all positions; 0."""
    for name in NOT_FREE:
        if getattr(options, name):
            raise UsageError(NOT_TOGETHER.format(name="--free", other=f"--{name}"))
    found = releases(mechanism, options)
    if options.worked:
        pages = [each.worked(language=session.language) for each in found]
        if session.json:
            session.show_data({"worked": [page.data() for page in pages]})
        else:
            session.show("\n\n\n".join(page.text() for page in pages))
        return 0
    motion = motion_at(Samples.apart([each.moment for each in found]))
    solved = Solved(motion, forces_at(motion), np.arange(motion.steps), tuple(warnings))
    table = data(solved, options) | {"released": [_data(each) for each in found]}
    if options.output is not None:
        from linkwright.cli.files import write_table

        write_table(options.output, named_columns(solved, options), table, force=options.force)
    if session.json:
        session.show_data(table)
    elif options.output is None:
        heading, structure, *rest = report(solved, options, session)
        session.show(heading, structure, "", *_inputs(found, solved, options, session), *rest)
    else:
        session.show_written(options.output)
    return 0


def releases(mechanism: Mechanism, options: Options) -> list[Release]:
    """One for every position of ``--at``."""
    equation = EquationOfMotion(mechanism)
    speed = one_speed(options.speed, mechanism)
    places: list[Mapping[str, float] | None] = [None]
    if options.at is not None:
        listed = inputs(joined(options.at), mechanism)
        count = max(map(len, listed.values()))
        places = [{name: row[k if len(row) > 1 else 0] for name, row in listed.items()} for k in range(count)]
    return [released(equation, at=place, speed=speed) for place in places]


def _data(found: Release) -> dict[str, object]:
    """What the columns do not tell."""
    return {
        "outcome": found.outcome,
        "accelerations": found.accelerations,
        "ways": list(found.ways),
        "mass_matrix": found.mass_matrix.tolist(),
        "generalized_forces": found.generalized_forces.tolist(),
        "kinetic_energy [J]": found.kinetic_energy,
    }


def _inputs(found: list[Release], solved: Solved, options: Options, session: Session) -> list[str | Text]:
    """Accelerations of the inputs, with reduced inertia and force where there is one, and what becomes of it."""
    rows: list[list[Cell]] = []
    one = len(found[0].equation.free) == 1
    for place, each in enumerate(found):
        for name, (_q, rate, second) in each.motion.positions.coordinates.items():
            turning = each.equation.rotary[name]
            reduced: list[Cell] = []
            if one:
                inertia = Amount(float(each.mass_matrix[0, 0]), "inertia" if turning else "mass")
                reduced = [inertia, Amount(float(each.generalized_forces[0]), "torque" if turning else "force")]
            kinds = ("angular_velocity", "angular_acceleration") if turning else ("velocity", "acceleration")
            rates = [Amount(float(v[0]), kind) for v, kind in zip((rate, second), kinds, strict=True)]
            own = session.translate(_("driver", code="nouns.driver")) if name == "driver" else name
            position = input_text(solved.motion, place, degrees=not options.si)
            rows.append([own, position, *rates, *reduced, OUTCOMES[each.outcome]])
    reduced_heads = [_("reduced inertia"), _("reduced force")] if one else []
    head = [
        _("input"),
        pgettext("release", "position"),
        pgettext("solve", "velocity"),
        pgettext("solve", "acceleration"),
        *reduced_heads,
        _("outcome"),
    ]
    notes = [session.translate(each.verdict) for each in found if each.outcome != "moves"]
    title = _("Let go: nothing drives the inputs but forces")
    table = Table(head, rows, "<<>>" + ">" * len(reduced_heads) + "<", title, list(dict.fromkeys(notes)))
    return [*table.lines(session.language)]
