"""Design numbers as formulas of summaries, ready for many designs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from linkwright.engine.trace import Scalar, absolute, minimum, select
from linkwright.errors import RequestError
from linkwright.metrics import METRICS, Analysis
from linkwright.metrics.base import Metric, Number
from linkwright.metrics.summary import is_summary
from linkwright.registry import offered
from linkwright.words.sentence import Sentence


@dataclass(frozen=True)
class Term:
    """One number per design: of the ``numbers`` of a metric the governing one."""

    name: str
    numbers: tuple[Number, ...]
    dimension: str
    better: str | None = None

    @property
    def parts(self) -> tuple[str, ...]:
        """The summaries that it is made of."""
        return tuple(dict.fromkeys(part for number in self.numbers for part in number.parts))

    def value(self, part: Mapping[str, Scalar]) -> Scalar:
        """The number from its parts: the worst of its subjects where a direction is better, else the first."""
        found = [number.formula(*(part[each] for each in number.parts)) for number in self.numbers]
        if self.better == "higher":
            return reduce(minimum, found)
        return reduce(_larger, found) if self.better == "lower" else found[0]


def _larger(a: Scalar, b: Scalar) -> Scalar:
    return select(absolute(a) >= absolute(b), a, b)


def metric_of(name: str) -> tuple[type[Metric], str] | None:
    """The registered metric that a name begins with, and the subject behind it."""
    metric, _, subject = name.partition(" ")
    return (METRICS[metric], subject) if metric in METRICS else None


def is_metric(name: str) -> bool:
    """Whether a name means a registered metric, not a summary of the output of the same name."""
    return metric_of(name) is not None and not is_summary(name)


def term(name: str, analysis: Analysis, preferred: str = "") -> Term | None:
    """A metric, ``peak_reaction`` or ``peak_reaction O5``, as a term; None where it does not apply to the machine, or
    is no formula of summaries.

    ``analysis``: of the machine from which designs start; ``preferred``: the subject that counts where none is asked
    and the metric has it. Raises RequestError for a subject that the metric does not have.
    """
    found = metric_of(name)
    if found is None:
        return None
    kind, subject = found
    metric = kind()
    if not metric.applies(analysis):
        return None
    numbers = tuple(metric.numbers(analysis))
    if not numbers:
        return None
    chosen = _chosen(name, metric, numbers, subject, preferred)
    return Term(name, chosen, chosen[0].dimension or metric.dimension, metric.better)


def _chosen(
    name: str, metric: Metric, numbers: Sequence[Number], subject: str, preferred: str
) -> tuple[Number, ...]:
    """The numbers of one subject, or all."""
    wanted = subject or ("" if metric.needs_forces else preferred)
    mine = tuple(number for number in numbers if number.subject == wanted)
    if subject and not mine:
        hint = offered(subject, [number.subject for number in numbers])
        raise RequestError(Sentence("metrics.no_value", name=metric.name, subject=subject, hint=hint))
    return mine or tuple(numbers)


def all_parts(terms: Iterable[Term]) -> tuple[str, ...]:
    """The summaries that some terms are made of, each once."""
    return tuple(dict.fromkeys(part for each in terms for part in each.parts))
