"""Optimisation of the open model, by the section ``optimize`` of its text."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial

from linkwright.analysis import METRICS, metrics
from linkwright.analysis.outputs import mechanism_outputs
from linkwright.core.json_data import Plain
from linkwright.designs.criteria import criterion
from linkwright.designs.optimise.optimize import optimize
from linkwright.designs.optimise.optimum import OptimizeError, Optimum, comparison
from linkwright.designs.optimise.problem import problem
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.document import Document
from linkwright.files.model_file import read_text
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.server.background import Job
from linkwright.words import _

#: Designs of a front that are shown.
SHOWN = 8


def optimised(text: str) -> Callable[[Job], None]:
    """The optimisation of a model; raises LinkwrightError with all findings about its settings."""
    document = Document(text, "model", read_text)
    mechanism = document.mechanism
    if not mechanism.optimize:
        raise RequestError(
            _(
                "the text has no section optimize; choose what varies and what is minimized first",
                code="studio.no_optimize",
            )
        )
    problem(mechanism, mechanism.optimize, document.name)
    return partial(_optimise, document)


def _optimise(document: Document, job: Job) -> None:
    def tell(found: Optimum) -> None:
        job.tell(**_shown(found, job.language))

    try:
        tell(optimize(document, progress=job.alive, leading=tell))
    except OptimizeError as error:
        tell(error.nearest)
        raise


def _shown(found: Optimum, language: str) -> Plain:
    """The designs with their values (SI) and the rows of metrics next to those of the start, as texts."""
    choices = found.choices[:: -(-len(found) // SHOWN)]
    tables = [comparison(found, each, language).texts() for each in choices]
    return {
        "head": tables[0][0],
        "candidates": [
            {"values": dict(each.values), "rows": rows[1:], "missed": list(each.missed)}
            for each, rows in zip(choices, tables, strict=True)
        ],
    }


def goals(text: str, language: str) -> list[Plain]:
    """What can be minimized or demanded: metrics of the machine and of their subjects, with their labels."""
    mechanism = Document(text, "model", read_text).mechanism
    rows = metrics(solve_forces(solve_motion(mechanism)))
    names: dict[str, None] = {}
    for row in rows:
        if METRICS[row.metric].better is not None:
            names |= {row.metric: None, f"{row.metric} {row.subject}": None}
    for output in mechanism_outputs(mechanism):
        names |= {f"{output.name} {kind}": None for kind in ("range", "max", "min")}
    found = []
    for name in names:
        with suppress(LinkwrightError):
            found.append({"name": name, "label": criterion(name).label(language)})
    return found
