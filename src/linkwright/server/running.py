"""Motion under forces by hand: runs as machines that the page can show."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from linkwright.core.data import Plain
from linkwright.dynamics.result import Run
from linkwright.dynamics.run import run
from linkwright.dynamics.run_text import SHOWN as EVENTS
from linkwright.dynamics.run_text import RunText
from linkwright.files.model_file import loads
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.content import page_data
from linkwright.server.background import Job
from linkwright.words.message import in_language

#: Positions over the time of a run that a page is given.
SHOWN = 720


def started(text: str) -> Callable[[Job], None]:
    """The run of a text's model; raises ModelError with all findings about it."""
    return partial(_run, loads(text, "model"), text)


def _run(mechanism: Mechanism, text: str, job: Job) -> None:
    found = run(mechanism, progress=job.alive)
    told = _told(found, job.language)
    job.tell([], **told)
    motion = solve_motion(found.as_driven(), steps=SHOWN)
    (model,) = page_data([(motion, text)], job.language)["models"]
    course = {**model["positions"], "period": found.end, "run": True}
    job.tell([], model={**model, "positions": course, "dimensions": []}, **told)


def _told(found: Run, language: str) -> Plain:
    """How it ended and what happened, as rows of texts, with the times of what happened, s."""
    text = RunText(found)
    summary, *events = (table.texts(language) for table in text.tables(language))
    times = [each.time for each in found.events]
    return {
        "summary": summary,
        "stalled": "" if text.stalled is None else in_language(text.stalled, language),
        "events": events[0][1:] if events else [],
        "times": [*times[: EVENTS - 1], times[-1]] if len(times) > EVENTS else times,
        "end": found.end,
    }
