"""Work of a tool in a thread: progress told while it runs, ended where the call is cancelled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import anyio
import anyio.to_thread
from mcp.server.mcpserver import Context

from linkwright.core.progress import reporting

T = TypeVar("T")
#: Seconds between two notes of progress.
PAUSE = 0.5


class Stopped(Exception):
    """The call was cancelled."""


class Course:
    """How far work has come, and whether it is still wanted."""

    def __init__(self) -> None:
        self.done, self.total, self.wanted = 0, 0, True

    def tell(self, done: int, total: int) -> None:
        """What long work calls; raises Stopped where it is not wanted any more."""
        if not self.wanted:
            raise Stopped
        self.done, self.total = done, total


async def worked_off(work: Callable[[], T], context: Context[Any, Any]) -> T:
    """The result of some work, done in a thread."""
    course = Course()

    def within() -> T:
        with reporting(course.tell):
            return work()

    async def tell() -> None:
        told = 0.0
        while True:
            await anyio.sleep(PAUSE)
            share = course.done / course.total if course.total else 0.0
            if share > told:
                told = share
                await context.report_progress(100.0 * share, 100.0)

    found: list[T] = []
    try:
        async with anyio.create_task_group() as group:
            group.start_soon(tell)
            found.append(await anyio.to_thread.run_sync(within, abandon_on_cancel=True))
            group.cancel_scope.cancel()
    finally:
        course.wanted = False
    return found[0]
