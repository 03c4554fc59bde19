"""``linkwright variants``: variants of a task for a course."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options, count, force, model, option
from linkwright.cli.session import Session
from linkwright.core.quantity import number
from linkwright.fields.tables import Integer
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.course.variants import Variants

SUMMARY = _("variants of a task for a course: sheets, answer key, PrairieLearn, Moodle, QTI")
DESCRIPTION = _(
    """\
Changes a model's dimensions within limits and writes a sheet per variant, the
answer key with the numbers that usual mistakes lead to, and questions for
PrairieLearn, Moodle and QTI. Every variant passes its cycle, transmits as well as
the model and is as hard. The section "course" of the model says what changes, what
is asked, and where; without it all lengths change by 8 %."""
)
EXAMPLES = """\
linkwright variants gallery:jaw_crusher_fourbar --count 3 --seed 7
linkwright variants crusher.yaml --count 30 --to sheets key moodle --output exercise"""

COUNT = 30


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@model
@count("--count", COUNT, help=_("how many (default 30)"))
@option(
    "--seed",
    "N",
    of=Integer(),
    default=0,
    help=_("seed of the random numbers (default 0): the same seed gives the same variants"),
)
@option(
    "--to",
    "FORM",
    default=[],
    help=_("what to write: sheets, key, prairielearn, moodle, qti (default: all)"),
    several=True,
)
@option(
    "--output", "FOLDER", help=_("folder (default: the model's name with -variants); it must not exist yet")
)
@force
def run(options: Options, session: Session) -> int:
    """Finds the variants and writes their files."""
    from linkwright.cli.progress import progress
    from linkwright.cli.source import read_model
    from linkwright.course.questions import FORMS
    from linkwright.course.variants import variants

    unknown = next((form for form in options.to if form not in FORMS), None)
    if unknown is not None:
        raise UsageError(
            _(
                'there is no form "{name}"; the forms are {forms}',
                code="course.no_form",
                name=unknown,
                forms=tuple(FORMS),
            )
        )
    folder = Path(options.output or f"{Path(options.file.removeprefix('gallery:')).stem}-variants")
    if os.path.exists(folder) and not options.force:
        raise UsageError(
            _(
                "{path}: the folder is there already; name another with --output, or replace its "
                "files with --force",
                code="variants.folder_exists",
                path=folder,
            )
        )
    mechanism, _unused = read_model(options.file, session)
    with progress(session, _("variants")) as told:
        found = variants(mechanism, options.count, seed=options.seed, progress=told)
        files = found.save(folder, options.to, session.language, force=True)
    if session.json:
        session.show_data({"ok": True, "files": [str(path) for path in files], "key": found.key()})
    else:
        _show(found, folder, session)
    return 0


def _show(found: Variants, folder: Path, session: Session) -> None:
    written = _(
        "{count} variants with {questions} questions written: {path}",
        count=len(found.variants),
        questions=len(found.task.questions),
        path=folder,
    )
    angles, ratio = found.difficulty.transmission_angle, f"{found.difficulty.ratio:.3g}"
    hard = _("difficulty: an answer's sizes differ by {ratio} times at most", ratio=ratio)
    if angles is not None:
        low, high = (number(each, "angle", 3) for each in angles)
        hard = _(
            "difficulty: smallest transmission angle {low}° to {high}°; an answer's sizes differ "
            "by {ratio} times at most",
            low=low,
            high=high,
            ratio=ratio,
        )
    session.show("\n".join(map(session.say, (written, hard))))
