"""Which summaries of which outputs are wanted, and the engine's reductions they are made of."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import lru_cache

import numpy as np

from linkwright.core.arrays import Floats, Whole
from linkwright.core.dataclass import dataclass
from linkwright.core.given import one_or_more
from linkwright.engine.reductions import Reduction
from linkwright.errors import RequestError
from linkwright.kinematics.names import PHRASES
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.registry import offered

#: Kinds of summaries, and the engine's reductions they need.
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
_GROWING = frozenset({"min", "max", "range", "peak", "argmin", "argmax"})


@dataclass(frozen=True)
class Summary:
    """One summary of one output over the cycle; without a ``kind`` a registered design number.

    ``kind``: ``min``, ``max``, ``mean``, ``rms``; ``range`` = max - min (swing, stroke); ``peak`` = largest
    absolute value; ``argmin``, ``argmax``: the first driver's coordinate (rad or m) of the extreme.
    """

    output: str
    kind: str

    @property
    def name(self) -> str:
        """Its name in tables."""
        return f"{self.output} {self.kind}".rstrip()


def wanted(outputs: Iterable[str | tuple[str, str]]) -> tuple[Summary, ...]:
    """Summaries from pairs (output, kind), or texts ``output kind``; an output alone means its min and max, the name
    of a design number that number.

    Raises LinkwrightError for an unknown kind, and where nothing is asked.
    """
    found: dict[Summary, None] = {}
    for each in one_or_more(outputs):
        for summary in _one(each):
            found[summary] = None
    if not found:
        raise RequestError("study.no_outputs")
    return tuple(found)


@lru_cache(1024)
def one(text: str) -> Summary:
    """The one summary that a text ``output kind`` means."""
    output, _, kind = text.rpartition(" ")
    return Summary(output, kind)


def is_summary(name: str) -> bool:
    """Whether a text is a summary of an output, ``driver.effort rms``, not a metric, ``limit_position jaw max``."""
    ends = any(sign in name and name.rpartition(sign)[2] in KINDS for sign in " .")
    first = name.partition(" ")[0]
    return ends and (first in PHRASES or first not in _metrics())


def is_metric(name: str) -> bool:
    """Whether a text means a registered design number, not a summary of the output of the same name."""
    return name.partition(" ")[0] in _metrics() and not is_summary(name)


def _metrics() -> Collection[str]:
    from linkwright.metrics.base import METRICS

    return METRICS


def _one(each: str | tuple[str, str]) -> list[Summary]:
    if isinstance(each, str):
        if is_metric(each):
            return [Summary(each, "")]
        output, _, kind = each.rpartition(" ")
        if not output or kind not in KINDS:
            output, dot, kind = each.rpartition(".")
            if not dot or kind not in KINDS:
                return [Summary(each, "min"), Summary(each, "max")]
        return [Summary(output, kind)]
    if not isinstance(each, tuple | list) or len(each) != 2:
        raise RequestError("study.no_output_name", given=repr(each)[:60])
    output, kind = each
    if kind not in KINDS:
        hint = offered(kind, KINDS, "names.one_of")
        raise RequestError("study.no_summary", output=output, kind=kind, hint=hint)
    return [Summary(output, kind)]


def reductions(summaries: Iterable[Summary], quantities: Mapping[str, Quantity]) -> list[Reduction]:
    """The engine's reductions; raises LinkwrightError for a mean of what is known by its tangent only."""
    found: dict[Reduction, None] = {}
    for summary in summaries:
        if quantities[summary.output].reference is not None and summary.kind not in _GROWING:
            raise RequestError("study.angle_summary", name=summary.name, kinds=tuple(sorted(_GROWING)))
        for kind in KINDS[summary.kind]:
            found[Reduction(summary.output, kind)] = None  # type: ignore[arg-type]
    return list(found)


def finished(
    summary: Summary,
    quantity: Quantity,
    results: Mapping[str, Floats | Whole],
    input_: Floats,
) -> Floats:
    """The summary (designs,) from the engine's reductions; NaN where no position counts."""
    if summary.kind in ("argmin", "argmax"):
        place = np.asarray(results[f"{summary.output}.{summary.kind}"], dtype=np.int64)
        return np.where(place >= 0, input_[np.maximum(place, 0)], np.nan)
    parts = [
        quantity.shown(np.asarray(results[f"{summary.output}.{k}"], dtype=float)) for k in KINDS[summary.kind]
    ]
    if summary.kind == "range":
        return np.asarray(parts[1] - parts[0])
    if summary.kind == "peak":
        return np.maximum(np.abs(parts[0]), np.abs(parts[1]))
    return np.array(parts[0])
