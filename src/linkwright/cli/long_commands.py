"""Long commands whose finished parts are kept: progress, and what an interruption leaves."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from linkwright.cli.progress import progress
from linkwright.cli.session import Session
from linkwright.core.progress import Progress
from linkwright.words import _

if TYPE_CHECKING:
    from collections.abc import Iterable


@contextmanager
def kept(
    state: str | None, name: str, asked: Iterable[object], session: Session
) -> Iterator[Progress | None]:
    """``kept_in`` of a command, with a bar; an interruption names the file that is left."""
    from linkwright.designs.finished_parts import Interrupted, kept_in

    try:
        with (
            progress(session.say, "study.computing") as report,
            kept_in(state, name, *asked, progress=report),
        ):
            yield report
    except Interrupted as stopped:
        session.tell(
            session.say(
                _("Interrupted; run the same command with --state {path} to go on.", path=stopped.state)
            )
        )
        raise
