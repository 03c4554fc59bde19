"""Several searches side by side: what they ask at the same time is answered together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from queue import SimpleQueue
from threading import Thread
from typing import Any, TypeVar

Question = TypeVar("Question")
Answer = TypeVar("Answer")
Result = TypeVar("Result")


class _Ended(Exception):
    """Ends a search whose answers do not come any more."""


def together(
    searches: Sequence[Callable[[Callable[[Question], Answer]], Result]],
    answers: Callable[[list[Question]], list[Answer]],
) -> list[Result]:
    """The results of searches that each get a function to ask with.

    Every search runs in a thread of its own up to its next question; once all of them wait, ``answers`` gives the
    answers to all questions at once, in the caller's thread, so what is asked together does not depend on speed.
    Raises what a search or ``answers`` raises, after all searches have ended.
    """
    asked: SimpleQueue[tuple[int, Question | None, bool]] = SimpleQueue()
    replies: list[SimpleQueue[Any]] = [SimpleQueue() for _ in searches]
    results: list[Any] = [None] * len(searches)
    failures: list[BaseException] = []

    def work(number: int) -> None:
        def ask(question: Question) -> Answer:
            asked.put((number, question, False))
            reply: Answer | _Ended = replies[number].get()
            if isinstance(reply, _Ended):
                raise reply
            return reply

        try:
            results[number] = searches[number](ask)
        except _Ended:
            pass
        except BaseException as failure:
            failures.append(failure)
        finally:
            asked.put((number, None, True))

    threads = [Thread(target=work, args=(number,), daemon=True) for number in range(len(searches))]
    for thread in threads:
        thread.start()
    running = len(threads)
    try:
        while running:
            waiting: dict[int, Any] = {}
            while len(waiting) < running:
                number, question, ended = asked.get()
                running -= ended
                if not ended:
                    waiting[number] = question
            if waiting:
                order = sorted(waiting)
                for number, answer in zip(order, answers([waiting[each] for each in order]), strict=True):
                    replies[number].put(answer)
    finally:
        for reply in replies:
            reply.put(_Ended())
    for thread in threads:
        thread.join()
    if failures:
        raise failures[0]
    return results
