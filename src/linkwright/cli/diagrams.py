"""What ``plot`` draws: motions of several files, and checks of what is asked of a kind of diagram."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options
from linkwright.cli.positions import one_place
from linkwright.cli.progress import progress
from linkwright.cli.session import Session
from linkwright.cli.source import read_model
from linkwright.errors import LinkwrightError, about
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion


def refuse_diagram(options: Options) -> None:
    """Raises UsageError for an unknown kind, or an option that a kind does not have."""
    from linkwright.plotting.diagrams.base import OPTIONS
    from linkwright.plotting.diagrams.diagram_by_name import require_kind, require_options

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
        session.tell(session.say(note))
    return found


def diagram_position(text: str | None, motions: Mapping[str, Motion]) -> float | str | None:
    """The input or time of a polygon; raises UsageError. For a model without driver the text itself."""
    from linkwright.plotting.diagrams.source import PlotInput

    first = PlotInput(next(iter(motions.values())))
    if text is None or not first.mechanism.drivers:
        return text
    return one_place(text, first.mechanism, first.input_dimension, "--at")
