"""Motion under forces by hand: kinds of actuators as forms, and runs as machines that the page can show."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from linkwright.actuators.base import ACTUATORS, Actuator
from linkwright.core.data import Plain
from linkwright.dynamics.result import Run
from linkwright.dynamics.run import run
from linkwright.dynamics.run_text import SHOWN as EVENTS
from linkwright.dynamics.run_text import RunText
from linkwright.fields.base import Field, Quantity, Word
from linkwright.files.model_file import loads
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.run_conditions import RunConditions
from linkwright.mechanism.stops import Stop
from linkwright.page.content import page_data
from linkwright.server.background import Job
from linkwright.units import example
from linkwright.words.message import in_language

#: Positions over the time of a run that a page is given.
SHOWN = 720


def forms(language: str) -> Plain:
    """Every kind of actuator with its keys, and the keys of stops and of a run."""
    return {
        "kinds": [
            {"kind": kind, "about": _first(each), "fields": _fields(each.fields(), language)}
            for kind, each in ACTUATORS.items()
        ],
        "stops": _fields(dict(Stop.fields()), language),
        "run": _fields(RunConditions.fields({}), language),
    }


def _first(kind: type[Actuator]) -> str:
    return " ".join((kind.__doc__ or "").partition("\n\n")[0].split())


def _fields(fields: dict[str, Field], language: str) -> list[Plain]:
    found: list[Plain] = []
    for name, each in fields.items():
        words = list(each.choices) if isinstance(each, Word) else []
        hint = example(each.dimension) if isinstance(each, Quantity) else ""
        found.append(
            {
                "key": each.key or name,
                "about": in_language(each.doc, language),
                "needed": each.required,
                "words": words,
                "example": hint,
            }
        )
    return found


def started(text: str) -> Callable[[Job], None]:
    """The run of a text's model; raises ModelError with all findings about it."""
    return partial(_run, loads(text, "model"), text)


def _run(mechanism: Mechanism, text: str, job: Job) -> None:
    found = run(mechanism, progress=job.alive)
    motion = solve_motion(found.as_driven(), steps=SHOWN)
    (model,) = page_data([(motion, text)], job.language)["models"]
    job.tell([], model={**model, "dimensions": []}, **_told(found, job.language))


def _told(found: Run, language: str) -> Plain:
    """How it ended and what happened, as rows of texts, with the times of what happened, s."""
    summary, *events = (table.texts(language) for table in RunText(found).tables(language))
    times = [each.time for each in found.events]
    return {
        "summary": summary,
        "events": events[0][1:] if events else [],
        "times": [*times[: EVENTS - 1], times[-1]] if len(times) > EVENTS else times,
        "end": found.end,
    }
