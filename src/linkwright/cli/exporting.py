"""What ``export`` asks of formats: their options, the texts of a page, positions that are not reached."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options
from linkwright.cli.session import Session
from linkwright.errors import LinkwrightError

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion


def checked(path: Path, options: Options, names: Sequence[str]) -> tuple[str, dict[str, Any]]:
    """The format of a file and its options; raises UsageError before any work is done."""
    from linkwright.exporters.export import FORMATS, check_options, chosen_format

    given = {name: getattr(options, name) for name in names if getattr(options, name) is not None}
    settings = {"compared" if name == "beside" else name: value for name, value in given.items()}
    try:
        chosen = chosen_format(path, options.format)
        check_options(chosen, FORMATS[chosen], settings)
    except LinkwrightError as error:
        raise UsageError(error.sentence) from None
    return chosen, settings


def page_inputs(file: str, others: Sequence[str]) -> dict[str, Any]:
    """The text of the file, which the page gives back changed, and the files of the other machines on it."""
    from linkwright.files.model_file import read_document
    from linkwright.files.source import read_source

    return {"text": read_source(file)[0], "compared": [read_document(each) for each in others]}


def report_failures(motion: Motion, session: Session) -> int:
    """Reports why positions have no numbers; 1 where there are some."""
    from linkwright.cli.solve_remarks import input_text

    for number, outcome in enumerate(motion.outcomes):
        if not outcome.ok:
            session.tell(f"{input_text(motion, number, degrees=True)}: {outcome.say(session.language)}")
    return int(not motion.complete)
