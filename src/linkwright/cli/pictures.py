"""What the commands that make pictures have in common."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.cli.errors import UsageError
from linkwright.cli.options import Decorator, Options, count, flag, fonts, force, option, together
from linkwright.cli.session import Session
from linkwright.errors import LinkwrightError, about
from linkwright.fields.tables import Integer
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.mechanism.mechanism import Mechanism


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
            "loads and forces in these joints (B: on its last link, rocker.B: on that link); in "
            "all without names",
        ),
    ),
    flag("--static", help=_("forces without inertia")),
    flag("--centres", help=_("mark the mass centres")),
)


def picture_file(output: Message) -> Decorator[Any]:
    """Where the picture goes (``output``: help for that), how large, and in which letters."""
    return together(
        option("--output", "FILE", required=True, help=output),
        force,
        option("--width", "PIXELS", of=Integer(1), help=_("pixels across (SVG and PDF: of the longer side)")),
        fonts,
    )


def names(words: Sequence[str] | None) -> tuple[str, ...]:
    """Names given one by one or with commas between them."""
    return tuple(name for word in words or () for name in word.split(",") if name)


def names_or_all(words: Sequence[str] | None) -> tuple[str, ...] | bool:
    """Names; True where the option stands without any, False where it does not stand."""
    return False if words is None else names(words) or True


def refuse_unknown_marks(mechanism: Mechanism, options: Options) -> None:
    """Raises UsageError for a point of a path, a point or a joint of an arrow that does not exist."""
    from linkwright.kinematics.names import point_key
    from linkwright.registry import no_such

    for each in ("paths", "velocities", "accelerations"):
        given = names(getattr(options, each))
        refuse_unknown(lambda name: point_key(mechanism, name), f"--{each}", given)
    joints = mechanism.joints
    for name in names(options.forces):
        if (joint := name.rpartition(".")[2]) not in joints:
            raise UsageError(
                _(
                    "{name}: {cause}",
                    name="--forces",
                    cause=no_such(_("joint"), joint, joints),
                )
            )


def refuse_unknown(find: Callable[[str], object], option: str, given: Sequence[str]) -> None:
    """Raises UsageError where ``find`` does not know a name that follows an option."""

    for name in given:
        with about(option, UsageError, LinkwrightError):
            find(name)


def cycle(mechanism: Mechanism, steps: int, session: Session) -> Motion:
    """The motion over a cycle; says how many positions are out of reach."""
    from linkwright.events.position_list import MOST
    from linkwright.kinematics.solve import solve_motion

    if steps > MOST:
        raise UsageError(
            _("--steps is {steps}; take {most} at most", code="solve.too_many", steps=steps, most=MOST)
        )
    motion = solve_motion(mechanism, steps=steps, failures="mark")
    failed = int((~motion.ok).sum())
    if failed and failed < motion.steps:
        first = next(each for each in motion.outcomes if not each.ok)
        session.tell(
            session.say(
                _(
                    "note: {count} of {of} positions cannot be reached and are left out; the first: "
                    "{sentence}",
                    count=failed,
                    of=motion.steps,
                    sentence=first.sentence,
                )
            )
        )
    return motion


def told(path: Path, options: Options, session: Session) -> None:
    """Says what was written; as data with ``--json``."""
    if options.json:
        session.show_data({"ok": True, "written": str(path)})
    else:
        session.show_written(path)
