"""Work on a Dask cluster: parts of designs, few at a time, computed again where a worker died."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import import_module
from typing import Any

from linkwright.designs.checkpoints import current_checkpoints, identity
from linkwright.errors import LinkwrightError
from linkwright.formula.threads import cores
from linkwright.words import _

#: Parts that wait on the cluster for every thread of a worker, so that memory stays the same however many there are.
WAITING = 3
#: Parts that are held where they are wanted in order.
HELD = 16
#: How often a part is given out whose workers died.
AGAIN = 20
#: Seconds that a scheduler has to answer.
PATIENCE = 8.0

_current: ContextVar[Any] = ContextVar("cluster", default=None)


def connected(cluster: Any) -> Any:
    """A Dask client: the one given, or one for a scheduler's address such as ``tcp://host:8786``."""
    dask = _dask()
    if not isinstance(cluster, str):
        return cluster
    try:
        return dask.Client(cluster, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise LinkwrightError(
            _(
                'the scheduler "{address}" does not answer ({reason}); start one with "dask '
                'scheduler", or check the address',
                code="study.no_cluster",
                address=cluster,
                reason=str(error)[:200],
            )
        ) from None


def _dask() -> Any:
    try:
        return import_module("distributed")
    except ImportError:
        raise LinkwrightError(
            _("a cluster needs Dask; install linkwright[cluster]", code="study.needs_distributed")
        ) from None


@contextmanager
def on_cluster(cluster: Any) -> Iterator[Any]:
    """Within it sweeps, the studies and tolerance runs made of them, free curves, and optimisations whose designs go
    one by one, are computed by the workers of a Dask cluster: a client, or the address of a scheduler. Gives the
    client. None: threads of this machine.

    Results are equal to those of threads but for rounding, but where a clock ends a search. Raises
    LinkwrightError without the extra ``cluster``, and for a scheduler that does not answer.
    """
    client = None if cluster is None else connected(cluster)
    token = _current.set(client)
    try:
        yield client
    finally:
        _current.reset(token)
        if client is not None and client is not cluster:
            client.close()


def current() -> Any:
    """The client of the surrounding ``on_cluster``; None: threads."""
    return _current.get()


def hands(client: Any) -> int:
    """Threads of all workers at this moment, or of this machine."""
    return cores() if client is None else max(1, sum(client.nthreads().values()))


def in_turn(
    client: Any, work: Callable[..., Any], tasks: Sequence[tuple[Any, ...]], own: str = ""
) -> Iterator[tuple[int, Any]]:
    """Results of ``work(*task)`` with the tasks' numbers, as they come; a few are on the cluster at a time.

    A task whose workers died is submitted again; an error of the work itself is raised. ``own``: replaces the first
    argument of every task in the keys under which the surrounding ``checkpointing`` stores the results.
    """
    checkpoints = current_checkpoints()
    names = [identity(own, *task[1:]) for task in tasks] if checkpoints is not None and own else []
    missing = [*range(len(tasks))]
    for number, name in enumerate(names):
        if checkpoints is not None and (there := checkpoints.part(name)) is not None:
            missing.remove(number)
            yield number, there[0]
    for number, found, seconds in _computed(client, work, tasks, missing):
        if checkpoints is not None and names:
            checkpoints.add(names[number], found, seconds)
        yield number, found


def _computed(
    client: Any, work: Callable[..., Any], tasks: Sequence[tuple[Any, ...]], missing: list[int]
) -> Iterator[tuple[int, Any, float]]:
    """Results of some tasks with their numbers and seconds, as they come."""
    if not missing:
        return
    dask = _dask()
    left, tried = iter(missing), dict.fromkeys(missing, 0)
    numbers: dict[Any, int] = {}
    room = WAITING * hands(client)

    def submitted(number: int) -> Any:
        tried[number] += 1
        future = client.submit(_timed, work, *tasks[number], pure=False)
        numbers[future] = number
        return future

    futures = [submitted(number) for _unused, number in zip(range(room), left, strict=False)]
    waiting = dask.as_completed(futures, loop=client.loop)
    try:
        for future in waiting:
            number = numbers.pop(future)
            if future.status == "error" and _died(future) and tried[number] < AGAIN:
                waiting.add(submitted(number))
                continue
            yield number, *future.result()
            future.release()
            for onward in left:
                waiting.add(submitted(onward))
                break
    finally:
        client.cancel(list(numbers))


def in_order(client: Any, work: Callable[..., Any], tasks: Sequence[tuple[Any, ...]], own: str) -> Iterator[Any]:
    """Results in the order of the tasks; at most ``HELD`` wait for those before them, so that memory stays fixed."""
    for first in range(0, len(tasks), HELD):
        found = dict(in_turn(client, work, tasks[first : first + HELD], own))
        yield from (found[number] for number in range(len(found)))


def _timed(work: Callable[..., Any], *task: Any) -> tuple[Any, float]:
    """A result and the seconds that it took, on a worker."""
    begun = time.perf_counter()
    return work(*task), time.perf_counter() - begun


def _died(future: Any) -> bool:
    """Whether a task failed because its workers died."""
    return type(future.exception()).__name__ == "KilledWorker"
