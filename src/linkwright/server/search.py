"""Linkages for a curve that was drawn by hand."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from linkwright.core.json_data import Plain
from linkwright.errors import LinkwrightError
from linkwright.files.write import dump
from linkwright.server.background import Job
from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.words import _

#: Times of the searches that follow on each other, s; points of a curve that is sent, and of one that is sought.
SECONDS, SENT, CORNERS = (1.0, 6.0), 180, 48
#: Largest lengths of four-bars beyond the curve's place, in widths of the curve; smallest transmission angle, rad.
REACH, TRANSMISSION = 4.0, 0.35
_FEWEST, _MOST = 3, 4000


_NO_CURVE = _("that is no curve to search for: draw one with at least three points", code="studio.no_curve")


def linkages(points: Any, closed: bool) -> Callable[[Job], None]:
    """The search for linkages whose coupler curve goes through ``points`` (m), pairs of numbers."""
    try:
        curve = np.array(points, dtype=float)
    except (ValueError, TypeError, OverflowError):
        raise LinkwrightError(_NO_CURVE) from None
    if curve.ndim != 2 or curve.shape[1] != 2 or not _FEWEST <= len(curve) <= _MOST:
        raise LinkwrightError(_NO_CURVE)
    if not np.isfinite(curve).all() or not np.ptp(curve, axis=0).max() > 0:
        raise LinkwrightError(_NO_CURVE)
    return partial(_search, _even(curve, closed), closed)


def _search(curve: np.ndarray, closed: bool, job: Job) -> None:
    best: list[Plain] = []
    refused: LinkwrightError | None = None
    for result in _results(job, curve, closed):
        if isinstance(result, LinkwrightError):
            refused = result
            continue
        shown = (_shown(each, curve) for each in result)
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
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0.0, way[-1], CORNERS, endpoint=not closed)
    return np.stack([np.interp(at, way, line[:, k]) for k in range(2)], axis=1)


def _shown(candidate: Candidate, target: np.ndarray) -> Plain:
    """A candidate as plain data; ``error``: the farthest that a point of the target is from its curve, m."""
    drawn = np.asarray(candidate.curve if candidate.curve is not None else [], dtype=complex).ravel()
    goal = target[:, 0] + 1j * target[:, 1]
    error = float(np.abs(goal[:, None] - drawn[None, :]).min(axis=1).max()) if len(drawn) else float("inf")
    sent = drawn[:: max(1, len(drawn) // SENT)]
    return {
        "text": dump(candidate.mechanism(candidate.linkage.kind.replace("_", " "))),
        "kind": candidate.linkage.kind,
        "links": len(candidate.linkage.links) + 1,
        "error": error,
        "transmission_angle": float(candidate.transmission_angle),
        "curve": [[float(each.real), float(each.imag)] for each in sent],
    }


def _distinct(ordered: list[Plain], most: int = 6) -> list[Plain]:
    """The first ones that are not the same again."""
    keys = itertools.groupby(ordered, key=lambda each: (each["links"], round(float(each["error"]), 7)))
    return [next(group) for _unused, group in keys][:most]
