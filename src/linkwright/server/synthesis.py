"""Synthesis by hand: the tasks as forms of the page, and their candidates with what it draws of them."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import partial
from inspect import signature
from typing import Any

import numpy as np

from linkwright.core.data import Plain
from linkwright.core.quantity import length_text
from linkwright.errors import speaker
from linkwright.server.background import Job
from linkwright.server.request import refuse
from linkwright.server.rounding import short_text, tolerance
from linkwright.synthesis.catalogue import TASKS, Task
from linkwright.synthesis.function_generation.generators import KINDS as GENERATORS
from linkwright.synthesis.linkage import Linkage
from linkwright.synthesis.names import TYPE_NAMES, display_name
from linkwright.synthesis.result import Candidate, Synthesis, SynthesisError, counts_text, defects_text, error_texts
from linkwright.synthesis.tasks import asked_in
from linkwright.words import Message, pgettext

#: Demands that a page does not ask for: files of the server, and numbers that no design depends on.
HIDDEN = ("file", "file_unit", "seed", "seconds")
#: What the words that demands may be are called.
WORDS: Mapping[str, Mapping[str, Message]] = {
    "linkage": {each: TYPE_NAMES[each] for each in GENERATORS},
    "kind": {
        "hoecken": pgettext("straight line", "Hoecken"),
        "chebyshev": pgettext("straight line", "Chebyshev"),
        "watt": pgettext("straight line", "Watt"),
        "roberts": pgettext("straight line", "Roberts"),
        "peaucellier": TYPE_NAMES["peaucellier"],
    },
}
#: Points of a curve that is sent; candidates at most.
SENT, MOST = 181, 12


def task_forms(language: str) -> list[Plain]:
    """Every task with its demands: their forms, whether they must be given, the words that they may be."""
    return [
        {"name": name, "demands": [_demand(task, key, language) for key in task.demands if key not in HIDDEN]}
        for name, task in TASKS.items()
    ]


def _demand(task: Task, key: str, language: str) -> Plain:
    usual = signature(task.run).parameters[key].default
    return {
        "key": key,
        "form": task.demands[key],
        "needed": key in task.needed,
        "usual": usual if isinstance(usual, bool | str) else None,
        "words": [[word, message.translate(language)] for word, message in WORDS.get(key, {}).items()],
    }


def designed(task: str, demands: Mapping[str, Any], unit: str = "mm") -> Callable[[Job], None]:
    """The search for linkages of a task; its demands as in the section of a file, with units.

    ``unit``: of the lengths that candidates are written with.

    Raises ModelError with all findings about the demands, BadRequest for hidden ones.
    """
    if not set(demands).isdisjoint(HIDDEN):
        refuse("demands", "mapping")
    lines = [f"  {key}: {json.dumps(value, ensure_ascii=False)}" for key, value in demands.items()]
    head = ["synthesis:", f"  task: {json.dumps(task)}", "  unit: mm", "  angle_unit: deg"]
    name, read = asked_in("\n".join([*head, *lines]), "synthesis")
    return partial(_design, name, read, unit)


def _design(name: str, demands: Mapping[str, Any], unit: str, job: Job) -> None:
    task = TASKS[name]

    def alive(*done: float) -> None:
        job.alive(*([done[0], 100.0] if done else []))

    more = {"progress": alive} if "progress" in signature(task.run).parameters else {}
    try:
        found = task.run(**demands, **more)
    except SynthesisError as error:
        if error.nearest is not None:
            _tell(error.nearest, unit, job)
        raise
    _tell(found, unit, job)


def _tell(found: Synthesis, unit: str, job: Job) -> None:
    tell = speaker(job.language)
    notes = [*([counts_text(found, tell)] if found.counts else []), *(tell(each) for each in found.notes)]
    shown = []
    for index in range(min(MOST, len(found))):
        job.alive()
        shown.append(candidate_data(found, index, job.language, unit))
    job.tell(shown, notes=notes)


def candidate_data(found: Synthesis, index: int, language: str, unit: str = "mm") -> Plain:
    """A candidate as the page shows it: its file, its numbers in words, its drawing."""
    each, tell = found.candidates[index], speaker(language)
    allowed, of_angles = tolerance(found, each)
    text = found.model_text(index, language=language)
    return {
        "text": short_text(each.linkage, text, allowed, of_angles=of_angles, unit=unit),
        "type": tell(TYPE_NAMES[each.grashof_type]),
        "error": _error(found, each),
        "defects": defects_text(each, tell) if each.defects else "",
        "transmission_angle": finite(each.transmission_angle),
        "lengths": [
            [display_name(name, tell), length_text(value, 5)] for name, value in each.linkage.lengths().items()
        ],
        "values": [[display_name(name, tell), f"{value:.5g}"] for name, value in each.values.items()],
        "drawing": linkage_drawing(each.linkage),
        "curve": curve_data(each),
    }


def _error(found: Synthesis, each: Candidate) -> str:
    """How far off it is, with its unit; empty where the demand is met exactly."""
    text = error_texts(each)[0]
    if text == "0" or found.error_name == "none":
        return ""
    if found.error_name == "squares":
        return length_text(float(np.sqrt(each.error)), 3)
    if found.error_name in ("deviation", "length"):
        return length_text(each.error, 3)
    if found.error_name in ("angle", "rest"):
        return f"{np.degrees(each.error):.3g}°"
    # Of a curve it is a share of the curve's size.
    return f"{100.0 * each.error:.2g} %" if found.error_name == "curve" else text


def curve_data(candidate: Candidate) -> list[list[float]]:
    """Places (m) of the drawn curve; none of a function."""
    curve = np.asarray(candidate.curve if candidate.curve is not None else [])
    if curve.ndim != 1 or not np.iscomplexobj(curve):
        return []
    sent = curve[np.isfinite(curve)][:: max(1, len(curve) // SENT)]
    return [[float(place.real), float(place.imag)] for place in sent]


def finite(value: float) -> float | None:
    """A number as JSON has it; None for one that is not known."""
    return float(value) if np.isfinite(value) else None


def linkage_drawing(linkage: Linkage) -> Plain:
    """Where the points of a linkage are, and which links join them."""
    guides = [
        {"on": guide.link, "at": guide.at, "angle": _heading(linkage, guide.direction)}
        for guide in linkage.guides.values()
    ]
    return {
        "points": {name: [float(place.real), float(place.imag)] for name, place in linkage.points.items()},
        "fixed": list(linkage.frame),
        "links": {name: list(points) for name, points in linkage.links.items()},
        "guides": guides,
        "driver": linkage.driver[0],
    }


def _heading(linkage: Linkage, along: float | tuple[str, str]) -> float:
    if not isinstance(along, tuple):
        return float(along)
    first, second = (linkage.points[name] for name in along)
    return float(np.angle(second - first))
