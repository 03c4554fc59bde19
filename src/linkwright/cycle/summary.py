"""Summaries of outputs over the cycle, their values, and the reductions of sweeps that some are made of."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats, Integers
from linkwright.errors import RequestError
from linkwright.formula.reductions import Reduction
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.words import _

#: Kinds of summaries, and the reductions they need.
KINDS: Mapping[str, tuple[str, ...]] = {
    "min": ("min",),
    "max": ("max",),
    "mean": ("mean",),
    "rms": ("rms",),
    "range": ("min", "max"),
    "peak": ("min", "max"),
    "argmin": ("argmin",),
    "argmax": ("argmax",),
}
#: Which way an output goes, by the limits with which its strokes begin.
STROKES = {"max": "falling", "min": "rising"}
_GROWING = frozenset({"min", "max", "range", "peak", "argmin", "argmax"})


@dataclass(frozen=True)
class Summary:
    """One summary of one output over the cycle; without a ``kind`` a registered design number.

    ``kind``: ``min``, ``max``, ``mean``, ``rms``; ``range`` = max - min (swing, stroke); ``peak`` = largest
    absolute value; ``argmin``, ``argmax``: the first driver's coordinate (rad or m) of the extreme. ``of_cycle``:
    whether pieces of the cycle give it.
    """

    of_cycle: ClassVar[bool] = True
    output: str
    kind: str

    @classmethod
    def of(cls, text: str) -> Summary:
        """The summary that a text ``output kind`` means."""
        output, _unused, kind = text.rpartition(" ")
        return cls(output, kind)

    @property
    def name(self) -> str:
        """Its name in tables."""
        return f"{self.output} {self.kind}".rstrip()


@dataclass(frozen=True)
class StrokeSummary(Summary):
    """A summary while another output, ``by``, goes one ``way``: ``falling`` or ``rising``."""

    by: str
    way: str

    @property
    def name(self) -> str:
        """Its name among others: ``transmission_angle B min on jaw.angle falling``."""
        return f"{self.output} {self.kind} on {self.by} {self.way}"


@dataclass(frozen=True)
class SummaryValue:
    """The value of a summary of one machine; ``time`` s and ``input`` rad or m are NaN where it belongs to no place.

    ``exact``: found between the solved positions to the machine's resolution of a flat extreme, else a sample.
    """

    value: float
    time: float
    input: float
    exact: bool


def reductions(summaries: Iterable[Summary], quantities: Mapping[str, Quantity]) -> list[Reduction]:
    """The reductions of a sweep; raises LinkwrightError for a mean of what is known by its tangent only."""
    found: dict[Reduction, None] = {}
    for summary in summaries:
        if quantities[summary.output].reference is not None and summary.kind not in _GROWING:
            raise RequestError(
                _(
                    "{name!r}: an angle has {kinds} in a study; take one of these, or the mean or rms of its rate",
                    code="study.angle_summary",
                    name=summary.name,
                    kinds=tuple(sorted(_GROWING)),
                )
            )
        for kind in KINDS[summary.kind]:
            found[Reduction(summary.output, kind)] = None  # type: ignore[arg-type]
    return list(found)


def finished(
    summary: Summary, quantity: Quantity, results: Mapping[str, Floats | Integers], input_: Floats
) -> Floats:
    """The summary (designs,) from its reductions; NaN where no position counts."""
    if summary.kind in ("argmin", "argmax"):
        place = np.asarray(results[f"{summary.output}.{summary.kind}"], dtype=np.int64)
        return np.where(place >= 0, input_[np.maximum(place, 0)], np.nan)
    parts = [quantity.shown(np.asarray(results[f"{summary.output}.{k}"], dtype=float)) for k in KINDS[summary.kind]]
    if summary.kind == "range":
        return np.asarray(parts[1] - parts[0])
    if summary.kind == "peak":
        return np.maximum(np.abs(parts[0]), np.abs(parts[1]))
    return np.array(parts[0])
