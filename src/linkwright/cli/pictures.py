"""What the commands that make pictures have in common: options, names, motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from linkwright.cli.errors import UsageError, refuse_unknown
from linkwright.cli.files import read_model
from linkwright.cli.options import Decorator, Options, count, flag, fonts, force, option, output, together
from linkwright.cli.positions import one_place
from linkwright.cli.session import Session, progress
from linkwright.errors import LinkwrightError, about
from linkwright.fields.tables import Integer
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.mechanism.mechanism import Mechanism
    from linkwright.plotting.drawing.dimensions import Dimension


def cycle_steps(steps: int) -> Decorator[Any]:
    """The steps of the cycle."""
    return count("--steps", steps, help=_("equal steps over the cycle (default: {steps})", steps=steps))


#: What may be drawn as arrows.
arrows = together(
    option(
        "--velocities",
        "POINT",
        several=True,
        optional=True,
        help=_("velocities of these points; of all without names"),
    ),
    option(
        "--accelerations",
        "POINT",
        several=True,
        optional=True,
        help=_("accelerations of these points; of all without names"),
    ),
    option(
        "--forces",
        "JOINT",
        several=True,
        optional=True,
        help=_(
            "loads and forces in these joints (B: on its last link, rocker.B: on that link); in all without names"
        ),
    ),
    flag("--static", help=_("forces without inertia")),
    flag("--centres", help=_("mark the mass centres")),
    flag("--outlines", help=_("parts as they are made, to scale, in place of symbols")),
)


def paths(help: Message) -> Decorator[Any]:
    """Points whose paths are drawn."""
    return option("--paths", "POINT", "--traces", several=True, help=help)


def picture_file(endings: Sequence[str], help: Message) -> Decorator[Any]:
    """Where the picture goes, how large, and in which letters."""
    width = option("--width", "PIXELS", of=Integer(1), help=_("pixels across (SVG and PDF: of the longer side)"))
    return together(output(endings, help, required=True), force, width, fonts)


def vectors(motion: Motion, options: Options, *, solved: bool) -> dict[str, Any]:
    """What of the options a drawing shows as paths and arrows; ``solved``: its forces are to be solved here."""
    from linkwright.kinetostatics.run import solve_forces

    forces: Any = options.forces is not None or None
    if forces and (solved or options.static):
        forces = solve_forces(motion, static=options.static)
    return {
        "paths": names(options.paths),
        "velocities": names_or_all(options.velocities),
        "accelerations": names_or_all(options.accelerations),
        "forces": forces,
        "reactions_of": names(options.forces) or None,
        "centres": options.centres,
        "outlines": options.outlines,
    }


def names(words: Sequence[str] | None) -> tuple[str, ...]:
    """Names one by one or with commas between them."""
    return tuple(name for word in words or () for name in word.split(",") if name)


def names_or_all(words: Sequence[str] | None) -> tuple[str, ...] | bool:
    """Names; True where the option has no names, False without the option."""
    return False if words is None else names(words) or True


def refuse_unknown_points(mechanism: Mechanism, options: Options) -> None:
    """Raises UsageError for a point of a path, a point or a joint of an arrow that does not exist."""
    from linkwright.kinematics.names import point_key
    from linkwright.registry import no_such

    for each in ("paths", "velocities", "accelerations"):
        points = names(getattr(options, each))
        refuse_unknown(lambda name: point_key(mechanism, name), f"--{each}", points)
    joints = mechanism.joints
    for name in names(options.forces):
        if (joint := name.rpartition(".")[2]) not in joints:
            raise UsageError(_("{name}: {cause}", name="--forces", cause=no_such(_("joint"), joint, joints)))


def dimensions(words: Sequence[str] | None) -> list[Dimension] | bool:
    """Links, pairs of points as ``O1:O3``, or all links."""
    if words is None:
        return False
    parts = (name.partition(":") for name in names(words))
    return [(first, last) if colon else first for first, colon, last in parts] or True


def refuse_unknown_names(mechanism: Mechanism, options: Options, dimensions: list[Dimension] | bool) -> None:
    """Raises UsageError for a name of ``draw`` that does not exist."""
    from linkwright.kinematics.names import find_point, place_meant

    refuse_unknown_points(mechanism, options)
    named = [] if isinstance(dimensions, bool) else dimensions
    refuse_unknown(mechanism.link, "--dimensions", [each for each in named if isinstance(each, str)])
    ends = [point for each in named if not isinstance(each, str) for point in each]
    refuse_unknown(lambda name: find_point(mechanism, name), "--dimensions", ends)
    word, _colon, output = options.overlay.partition(":")
    if word == "limits" and output:
        refuse_unknown(lambda name: place_meant(mechanism, name), "--overlay", [output])


def cycle(mechanism: Mechanism, steps: int, session: Session) -> Motion:
    """The motion over a cycle; says how many positions are out of reach."""
    from linkwright.events.position_list import MOST
    from linkwright.kinematics.solve import solve_motion

    if steps > MOST:
        raise UsageError(_("--steps is {steps}; take {most} at most", code="solve.too_many", steps=steps, most=MOST))
    motion = solve_motion(mechanism, steps=steps, failures="mark")
    failed = int((~motion.ok).sum())
    if failed and failed < motion.steps:
        first = next(each for each in motion.outcomes if not each.ok)
        session.tell(
            session.translate(
                _(
                    "note: {count} of {of} positions cannot be reached and are left out; the first: {sentence}",
                    count=failed,
                    of=motion.steps,
                    sentence=first.sentence,
                )
            )
        )
    return motion


def refuse_diagram(options: Options) -> None:
    """Raises UsageError for an unknown kind, or an option that a kind does not have."""
    from linkwright.plotting.diagrams.base import OPTIONS, require_kind, require_options

    with about("--kind", UsageError, LinkwrightError):
        require_kind(options.kind)
    for name in OPTIONS:
        if getattr(options, name):
            with about(f"--{name}", UsageError, LinkwrightError):
                require_options(options.kind, [name])


def cycles(files: Sequence[str], steps: int, session: Session) -> dict[str, Motion]:
    """The cycle of every model by a unique name; reports positions that are left out, once all are solved."""
    from linkwright.kinematics.solve import solve_motion

    found: dict[str, Motion] = {}
    notes = []
    with progress(session, _("solving")) as report:
        for done, file in enumerate(files, 1):
            mechanism, _findings = read_model(file, session)
            motion = solve_motion(mechanism, steps=steps, failures="mark")
            failed = [outcome for outcome in motion.outcomes if not outcome.ok]
            if len(failed) == motion.steps:
                raise LinkwrightError(_("{name}: {cause}", name=file, cause=failed[0].sentence))
            if failed:
                notes.append(
                    _(
                        "{file}: {count} of {of} positions are not reached and left blank: {sentence}",
                        file=file,
                        count=len(failed),
                        of=motion.steps,
                        sentence=failed[0].sentence,
                    )
                )
            found[mechanism.name if mechanism.name not in found else f"{mechanism.name} ({file})"] = motion
            if report is not None:
                report(done, len(files))
    for note in notes:
        session.tell(session.translate(note))
    return found


def diagram_position(text: str | None, motions: Mapping[str, Motion]) -> float | str | None:
    """The input or time of a polygon; raises UsageError. For a model without driver the text itself."""
    from linkwright.plotting.diagrams.source import PlotInput

    first = PlotInput(next(iter(motions.values())))
    if text is None or not first.mechanism.drivers:
        return text
    return one_place(text, first.mechanism, first.input_dimension, "--at")
