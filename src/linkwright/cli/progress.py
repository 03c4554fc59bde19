"""Progress of long work on the standard error, where that is a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar

from linkwright.cli.session import Session
from linkwright.core.progress import Progress, reporting
from linkwright.words import Message, _


@contextmanager
def progress(session: Session, what: Message) -> Iterator[Progress | None]:
    """A function that is called with (done, total) and moves a bar with the remaining time; None where there is no
    terminal. All long work within the block calls it as well. The bar is removed at the end."""
    console = session.errors
    if not console.is_terminal:
        yield None
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Bar(*columns, console=console, transient=True, redirect_stdout=False) as bar:
        task = bar.add_task(session.say(what), total=None)

        def report(done: int, total: int) -> None:
            if done < bar.tasks[0].completed:  # the next one of several pieces of work
                bar.reset(task, total=total)
            bar.update(task, completed=done, total=total)
            if done >= total:
                bar.stop()  # the result may be printed now
            elif not bar.live.is_started:
                bar.start()

        with reporting(report):
            yield report


@contextmanager
def resumable(state: str | None, name: str, inputs: Iterable[object], session: Session) -> Iterator[Progress | None]:
    """Work with a bar whose finished parts are stored in ``state``; an interruption names the file to resume from."""
    from linkwright.designs.checkpoints import RESUME, Interrupted, checkpointing

    try:
        with (
            progress(session, _("computing designs")) as report,
            checkpointing(state, name, *inputs, progress=report),
        ):
            yield report
    except Interrupted as stopped:
        session.tell(session.say(RESUME.format(path=stopped.state)))
        raise
