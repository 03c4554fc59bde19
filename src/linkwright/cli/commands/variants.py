"""``linkwright variants``: variants of a task for a course."""

from __future__ import annotations

import os
from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError
from linkwright.cli.files import default_path
from linkwright.cli.options import Options, count, force, model, option
from linkwright.cli.session import Session
from linkwright.fields.tables import Integer
from linkwright.words import _

COUNT = 30
NO_FORM = _('there is no form "{name}"; the forms are {forms}', code="course.no_form")
FOLDER_EXISTS = _(
    "{path}: the folder is there already; name another with --output, or replace its files with --force",
    code="variants.folder_exists",
)
WRITTEN = _("{count} variants with {questions} questions written: {path}")


@command(
    _("variants of a task for a course: sheets, answer key, PrairieLearn, Moodle, QTI"),
    _(
        """\
Changes a model's dimensions within limits and writes a sheet per variant, the
answer key with the numbers that usual mistakes lead to, and questions for
PrairieLearn, Moodle and QTI. Every variant passes its cycle, transmits as well as
the model and is as hard. The section "course" of the model says what changes, what
is asked, and where; without it all lengths change by 8 %."""
    ),
    """\
linkwright variants gallery:jaw_crusher_fourbar --count 3 --seed 7
linkwright variants crusher.yaml --count 30 --to sheets key moodle --output exercise""",
)
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
@option("--output", "FOLDER", help=_("folder (default: the model's name with -variants); it must not exist yet"))
@force
def run(options: Options, session: Session) -> int:
    """Finds the variants and writes their files."""
    from linkwright.cli.files import read_model
    from linkwright.cli.session import progress
    from linkwright.course.questions import FORMS
    from linkwright.course.variants import variants

    unknown = next((form for form in options.to if form not in FORMS), None)
    if unknown is not None:
        raise UsageError(NO_FORM.format(name=unknown, forms=tuple(FORMS)))
    folder = Path(options.output) if options.output else default_path(options.file, "-variants")
    if os.path.exists(folder) and not options.force:
        raise UsageError(FOLDER_EXISTS.format(path=folder))
    mechanism, _findings = read_model(options.file, session)
    with progress(session, _("variants")) as report:
        found = variants(mechanism, options.count, seed=options.seed, progress=report)
        files = found.save(folder, options.to, session.language, force=True)
    if session.json:
        session.show_data({"ok": True, "files": [str(path) for path in files], "key": found.key()})
    else:
        count, questions = len(found.variants), len(found.task.questions)
        written = WRITTEN.format(count=count, questions=questions, path=folder)
        session.show(session.translate(written), session.translate(found.difficulty.sentence))
    return 0
