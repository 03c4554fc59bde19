"""Searches of the studio: optimisation of the open model, and linkages for a curve that was drawn by hand."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np

from linkwright.analysis import METRICS, metrics
from linkwright.analysis.outputs import mechanism_outputs
from linkwright.core.data import Plain
from linkwright.designs.criteria import criterion
from linkwright.designs.optimise.optimize import optimize
from linkwright.designs.optimise.optimum import OptimizeError, Optimum, comparison
from linkwright.designs.optimise.problem import problem
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.model_file import read_text
from linkwright.files.write import Document
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.server.background import Job
from linkwright.server.rounding import SHARE, short_text
from linkwright.server.synthesis import curve_data, linkage_drawing
from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.words import _

#: Times of the searches that follow on each other, s; points of a curve that is sought.
SECONDS, CORNERS = (1.0, 6.0), 48
#: Largest lengths of four-bars beyond the curve's place, in widths of the curve; smallest transmission angle, rad.
REACH, TRANSMISSION = 4.0, 0.35
_FEWEST, _MOST = 3, 4000


_NO_CURVE = _("that is no curve to search for: draw one with at least three points", code="studio.no_curve")


def linkages(points: Any, closed: bool, unit: str = "mm") -> Callable[[Job], None]:
    """The search for linkages whose coupler curve goes through ``points`` (m), pairs of numbers;
    ``unit``: of the lengths that they are written with."""
    try:
        curve = np.array(points, dtype=float)
    except (ValueError, TypeError, OverflowError):
        raise LinkwrightError(_NO_CURVE) from None
    if curve.ndim != 2 or curve.shape[1] != 2 or not _FEWEST <= len(curve) <= _MOST:
        raise LinkwrightError(_NO_CURVE)
    if not np.isfinite(curve).all() or not np.ptp(curve, axis=0).max() > 0:
        raise LinkwrightError(_NO_CURVE)
    return partial(_search, _even(curve, closed), closed, unit)


def _search(curve: np.ndarray, closed: bool, unit: str, job: Job) -> None:
    best: list[Plain] = []
    refused: LinkwrightError | None = None
    for result in _results(job, curve, closed):
        if isinstance(result, LinkwrightError):
            refused = result
            continue
        shown = (_drawn_candidate(each, curve, unit) for each in result)
        best = _distinct(sorted([*best, *shown], key=lambda each: float(each["error"])))
        job.tell(best)
    if refused is not None and not best:
        raise refused


def _results(job: Job, curve: np.ndarray, closed: bool) -> Iterator[Synthesis | LinkwrightError]:
    from linkwright.synthesis.free_curve.generate import free_curve
    from linkwright.synthesis.path_generation.generate import path_generation

    def alive(*_: float) -> None:
        job.alive()

    try:
        few = curve[:: max(1, len(curve) // 16)]
        goal = np.vstack([few, few[:1]]) if closed else few
        bound = float(np.abs(curve).max() + REACH * np.ptp(curve, axis=0).max())
        yield path_generation(goal, bound=bound, transmission_angle=TRANSMISSION)
    except LinkwrightError as error:
        yield error
    for seed, seconds in enumerate(SECONDS):
        job.alive()
        try:
            yield free_curve(curve, closed=closed, seconds=seconds, seed=seed, progress=alive)
        except LinkwrightError as error:
            yield error


def _even(curve: np.ndarray, closed: bool) -> np.ndarray:
    """Points at equal distances along a polyline."""
    line = np.vstack([curve, curve[:1]]) if closed else curve
    arc_length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0.0, arc_length[-1], CORNERS, endpoint=not closed)
    return np.stack([np.interp(at, arc_length, line[:, k]) for k in range(2)], axis=1)


def _drawn_candidate(candidate: Candidate, target: np.ndarray, unit: str) -> Plain:
    """A candidate as plain data; ``error``: the farthest that a point of the target is from its curve, m."""
    drawn = np.asarray(candidate.curve if candidate.curve is not None else [], dtype=complex).ravel()
    goal = target[:, 0] + 1j * target[:, 1]
    error = float(np.abs(goal[:, None] - drawn[None, :]).min(axis=1).max()) if len(drawn) else float("inf")
    linkage = candidate.linkage
    text = linkage.text(linkage.kind.replace("_", " "))
    return {
        "text": short_text(linkage, text, SHARE * error if np.isfinite(error) else 0.0, unit=unit),
        "kind": linkage.kind,
        "links": len(linkage.links) + 1,
        "error": error,
        "transmission_angle": float(candidate.transmission_angle),
        "drawing": linkage_drawing(linkage),
        "curve": curve_data(candidate),
    }


def _distinct(ordered: list[Plain], most: int = 6) -> list[Plain]:
    """The first ones that are not the same again."""
    keys = itertools.groupby(ordered, key=lambda each: (each["links"], round(float(each["error"]), 7)))
    return [next(group) for _unused, group in keys][:most]


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
        job.tell(**_designs(found, job.language))

    try:
        tell(optimize(document, progress=job.alive, leading=tell))
    except OptimizeError as error:
        tell(error.nearest)
        raise


def _designs(found: Optimum, language: str) -> Plain:
    """The designs with their values (SI) and the rows of metrics next to those of the start, as texts."""
    choices = found.choices[:: -(-len(found) // SHOWN)]
    tables = [comparison(found, each, language).texts(language) for each in choices]
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
