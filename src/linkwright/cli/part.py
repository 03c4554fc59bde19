"""What the commands for machine parts have in common: one file in, numbers, worked text, curves, a diagram."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import Command, command
from linkwright.cli.errors import UsageError
from linkwright.cli.files import read_model, write_diagram, write_result
from linkwright.cli.options import PICTURES, RESULTS, Options, argument, flag, fonts, force, option, output, together
from linkwright.cli.session import Session
from linkwright.fields.tables import Integer
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.parts.base import Problem, Result


#: The options that all commands for machine parts have.
part_options = together(
    argument("file", "FILE", model=True, help=_("file with kind: …, or gallery:NAME")),
    flag("--worked", help=_("show the way to the numbers, step by step")),
    option(
        "--digits",
        "N",
        of=Integer(3, 15),
        default=6,
        help=_("significant digits of the numbers (3 to 15; default: 6)"),
    ),
    output(PICTURES, _("draw the diagram in a .svg, .pdf or .png file"), name="--plot"),
    output(RESULTS, _("write curves to a .csv file, or all numbers to a .json, .xlsx, .md or .html file")),
    fonts,
    force,
)


def read(source: str, command: str, session: Session) -> Problem:
    """The problem of a file; UsageError where its kind belongs to another command."""
    from linkwright.files.calculations import COMMANDS
    from linkwright.parts.file import kind_of, load

    kind = kind_of(source)
    if kind in COMMANDS and COMMANDS[kind] != command:
        raise UsageError(
            _(
                "the file is of kind {kind}; call: linkwright {command} {file}",
                code="part.other_command",
                kind=kind,
                command=COMMANDS[kind],
                file=source,
            )
        )
    problem = load(source)
    for each in problem.warnings:
        session.tell(session.finding(each))
    return problem


def show(result: Result, options: Options, session: Session, *, kind: str | None = None) -> None:
    """Prints the result; writes its curves and its diagram (``kind``: another than its usual one) where asked."""
    write_result(result, options, session)
    write_diagram(result, options, session, kind=kind)
    text = result.worked(session.language) if options.worked else ""
    session.show_result(result, options.output, options.plot, text=text, digits=options.digits)


def _equilibrium(options: Options, session: Session) -> Result:
    from linkwright.parts.statics.structure import equilibrium

    return equilibrium(read_model(options.file, session)[0])


def part_command(name: str, summary: Message, description: Message, examples: str) -> Command:
    """A command that solves a file of its kinds and does nothing else."""

    @command(summary, description, examples, name=name)
    @part_options
    def run(options: Options, session: Session) -> int:
        from linkwright.parts.file import kind_of, solve

        if name == "statics" and kind_of(options.file) is None:  # links and joints
            show(_equilibrium(options, session), options, session)
        else:
            show(solve(read(options.file, name, session), options.file), options, session)
        return 0

    return run


PART_COMMANDS = {
    "beam": part_command(
        "beam",
        _("beams on any supports; bending of a mechanism's link over its cycle"),
        _(
            """\
Finds reactions, shear force, bending moment, slope and deflection of a beam on any
supports (also statically indeterminate, stepped, with hinges and springs), stress and
safety; and the bending of a link of a mechanism under its joint forces, loads, weight
and inertia, with stress, safety and the needed section over the cycle."""
        ),
        """\
linkwright beam gallery:cantilever
linkwright beam gallery:propped_cantilever --worked
linkwright beam gallery:pitman_bending --plot bending.svg""",
    ),
    "program": part_command(
        "program",
        _("minimise or maximise under constraints: linear, integer, nonlinear"),
        _(
            """\
Solves the optimisation program of a small file: variables with bounds (continuous,
integer, or from a list), an expression to minimise or maximise, constraints by name.
Explains which constraints are active and what one more unit of each is worth; says
which constraints cannot hold together where there is no solution."""
        ),
        """\
linkwright program gallery:production_mix
linkwright program gallery:lightest_spring --worked
linkwright program gallery:gear_pair --json""",
    ),
    "statistics": part_command(
        "statistics",
        _("samples described, fitted, tested, regressed; process capability"),
        _(
            """\
Describes samples of measurements (mean, deviation, quartiles, intervals), fits
distributions, tests hypotheses (mean, variance, two samples, pairs, analysis of
variance, normality, correlation), fits lines and polynomials, and finds process
capability against limits."""
        ),
        """\
linkwright statistics gallery:shaft_diameters
linkwright statistics gallery:spring_rate --plot rate.svg
linkwright statistics gallery:shaft_diameters --worked --lang zh""",
    ),
    "statics": part_command(
        "statics",
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
    ),
    "trajectory": part_command(
        "trajectory",
        _("a thrown particle with drag; the load on a swinging conveyor"),
        _(
            """\
Finds the flight of a particle thrown in a vertical plane, with linear or quadratic
drag, also from a point of a mechanism; and what a swinging conveyor's trough does to
its load: rest, sliding forward and back, throw, and the mean speed of transport."""
        ),
        """\
linkwright trajectory gallery:thrown_ball
linkwright trajectory gallery:conveyor_load --plot load.svg
linkwright trajectory gallery:conveyor_load --worked""",
    ),
    "vibration": part_command(
        "vibration",
        _("natural frequencies, modes and responses; cam followers; machines on mounts"),
        _(
            """\
Finds natural frequencies, modes and damping of masses (or discs) joined by springs and
dampers, their free and forced vibration (force, unbalance, moving ground, measured
force), transmissibility and the best absorber; the vibration that a cam's motion law
leaves behind in a follower; and what a mechanism's shaking force does on mounts."""
        ),
        """\
linkwright vibration gallery:two_masses
linkwright vibration gallery:tuned_absorber --plot absorber.svg
linkwright vibration gallery:machine_on_mounts --worked""",
    ),
}
