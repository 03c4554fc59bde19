"""Which summaries and design numbers the texts and pairs mean that a user gives."""

from __future__ import annotations

from collections.abc import Iterable

from linkwright.core.given import one_or_more
from linkwright.cycle.summary import KINDS, Summary
from linkwright.errors import RequestError
from linkwright.kinematics.names import PHRASES
from linkwright.metrics.base import METRICS
from linkwright.registry import offered


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


def is_summary(name: str) -> bool:
    """Whether a text is a summary of an output, ``driver.effort rms``, not a metric, ``limit_position jaw max``."""
    ends = any(sign in name and name.rpartition(sign)[2] in KINDS for sign in " .")
    first = name.partition(" ")[0]
    return ends and (first in PHRASES or first not in METRICS)


def is_metric(name: str) -> bool:
    """Whether a text means a registered design number, not a summary of the output of the same name."""
    return name.partition(" ")[0] in METRICS and not is_summary(name)


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
