"""What every metric supplies: what it is, whether it applies, its values."""

from __future__ import annotations

from abc import ABC
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import isinf, isnan
from types import MappingProxyType
from typing import Any, ClassVar, Literal

import numpy as np

from linkwright.analysis.analysis import Analysis, Result
from linkwright.core.outputs import Output
from linkwright.core.quantity import shown, shown_unit
from linkwright.core.table import Amount, Cell
from linkwright.cycle.summaries import Summary, SummaryValue
from linkwright.formula.trace import Scalar
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import Registry
from linkwright.units import si_unit
from linkwright.words import Message, _
from linkwright.words.message import in_language, in_words

Better = Literal["higher", "lower"]
#: Heads of what :meth:`MetricValue.cells` gives, and of remarks.
CELLS = (_("metric"), _("of"), _("value"), _("unit"), _("at input"), _("limit"))
REMARK = _("remark")
#: A place (rad or m) smaller than this is rounding.
NO_PLACE = 1e-9


@dataclass(frozen=True)
class Remark:
    """A sentence about a value, by its ``key``; ``warning`` marks what needs attention."""

    key: str
    message: Message
    warning: bool = False

    def text(self, language: str = "en") -> str:
        """The sentence."""
        return self.message.translate(language)


@dataclass(frozen=True)
class MetricValue:
    """One value of a metric.

    ``subject``: the link, joint, point, group or loop; ``value``: SI; ``at``: the first driver's coordinate there
    (rad or m), None where the value belongs to the full cycle; ``place``: a point in frame axes, m, where there is
    one; ``exact``: False where the value is the largest or smallest of the solved positions, not refined between;
    ``limit``: the recommended one of this value, SI.
    """

    metric: str
    subject: str
    value: float
    dimension: str
    at: float | None = None
    at_dimension: str = "angle"
    remarks: tuple[Remark, ...] = ()
    place: tuple[float, float] | None = None
    exact: bool = True
    limit: float | None = None

    @property
    def unit(self) -> str:
        """SI unit of ``value``."""
        return si_unit(self.dimension)

    @property
    def warnings(self) -> tuple[Remark, ...]:
        """The remarks that need attention."""
        return tuple(remark for remark in self.remarks if remark.warning)

    @property
    def sentence(self) -> str:
        """All remarks in English."""
        return self.sentence_in("en")

    def sentence_in(self, language: str) -> str:
        """All remarks in a language."""
        return _("; ").translate(language).join(remark.text(language) for remark in self.remarks)

    def cells(self, language: str = "en") -> tuple[Cell, ...]:
        """What tables write of it, in the order of ``CELLS``; the last is the recommended limit."""
        metric, limit = METRICS[self.metric](), ""
        at = None if self.at is None else Amount(self.at if abs(self.at) >= NO_PLACE else 0.0, self.at_dimension)
        if self.limit is not None:
            limit = f"{'≥' if metric.better == 'higher' else '≤'} {shown(self.limit, self.dimension)}"
        label, subject = metric.label_in(language, self.dimension), in_words(self.subject, language)
        return (label, subject, Amount(self.value, self.dimension, bare=True), shown_unit(self.dimension), at, limit)

    def data(self, language: str = "en") -> dict[str, Any]:
        """Plain data."""
        return {
            "metric": self.metric,
            "subject": self.subject,
            "value": self.value,
            "unit": self.unit,
            "at": self.at,
            "at_unit": None if self.at is None else si_unit(self.at_dimension),
            "place": None if self.place is None else list(self.place),
            "limit": self.limit,
            "exact": self.exact,
            "warning": bool(self.warnings),
            "remark": self.sentence_in(language),
        }


def _itself(value: Scalar) -> Scalar:
    return value


def _first(*parts: SummaryValue) -> float:
    return parts[0].input


@dataclass(frozen=True)
class Number:
    """One value of a metric as a formula of summaries over the cycle, for one machine and for many designs.

    ``parts``: summaries, or outputs in words with a kind of summary, ``"reaction O5 on jaw max"`` (see
    ``cycle.summaries.KINDS``), from which ``summaries`` are read; ``formula``: the value from these, with ``+ - * /``
    and the functions of ``formula.trace`` alone, so that it serves numbers and traced values; ``at``: where it is,
    from the summaries as extremes. ``dimension``: that of the metric, or of the summary, where left out.
    ``passed_over``: outputs of the machine that come before and have no such number, as they reverse nowhere; without
    a subject the number is meant in such designs alone.
    """

    subject: str
    parts: tuple[Summary | str, ...]
    formula: Callable[..., Scalar] = _itself
    dimension: str | None = None
    at: Callable[..., float] = _first
    passed_over: tuple[Output, ...] = ()
    summaries: tuple[Summary, ...] = field(init=False, compare=False)

    def __post_init__(self) -> None:
        read = (Summary.of(each) if isinstance(each, str) else each for each in self.parts)
        object.__setattr__(self, "summaries", tuple(read))

    def value(self, found: Mapping[str, Scalar]) -> Scalar:
        """The value from those of its summaries by name."""
        return self.formula(*(found[each.name] for each in self.summaries))

    def measured(self, analysis: Analysis) -> tuple[float, float, bool]:
        """Value, place, and whether it is exact between the positions, of one machine."""
        parts = [analysis.part(each) for each in self.summaries]
        with np.errstate(divide="ignore", invalid="ignore"):  # infinite as of many designs, not an error
            found, at = self.formula(*(np.float64(part.value) for part in parts)), self.at(*parts)
        assert isinstance(found, float)
        return float(found), at, all(part.exact for part in parts)


class Metric(ABC):
    """One metric of a mechanism, from ``numbers`` or, where it is no formula of summaries, from ``values``.

    ``dimension``: name of its dimension (values may have their own, where a link gives an angle and a slider a
    length); ``better``: the direction in which designs improve, if there is one; ``limit``: the recommended value,
    SI; ``source``: where definition and limit are from; ``needs_forces``: whether joint forces must be solved;
    ``rank``: what matters first comes first in tables (output 1, transmission 2, torque 3, reactions 4, shaking 5);
    ``on_request``: only where it is asked for by name; ``own_values``: one machine's ``values`` are found in a way of
    their own, besides the ``numbers`` of many designs; ``judged_last``: ``suits`` reads what is found of the machine,
    which all others have asked for by then; ``input_ranges``: it is the extent of the input's ranges in
    which the mechanism can be assembled; ``labels``: its names by dimensions that have one of their own (of
    a driver that slides, a force).
    """

    name: ClassVar[str]
    dimension: ClassVar[str]
    source: ClassVar[str]
    better: ClassVar[Better | None] = None
    limit: ClassVar[float | None] = None
    needs_forces: ClassVar[bool] = False
    rank: ClassVar[float] = 9.0
    on_request: ClassVar[bool] = False
    own_values: ClassVar[bool] = False
    judged_last: ClassVar[bool] = False
    input_ranges: ClassVar[bool] = False
    labels: ClassVar[Mapping[str, Message]] = MappingProxyType({})

    @property
    def unit(self) -> str:
        """SI unit."""
        return si_unit(self.dimension)

    @property
    def label(self) -> str:
        """Its name in words."""
        return self.name.replace("_", " ")

    @property
    def meaning(self) -> str:
        """What it says, in one sentence: the class's own first line where it gives no other."""
        return (self.__doc__ or self.name).strip().splitlines()[0]

    def label_in(self, language: str, dimension: str = "") -> str:
        """Its name in words, by its dimension where that has one of its own."""
        return in_language(self.labels.get(dimension, self.label), language)

    def meaning_in(self, language: str) -> str:
        """What it says, in one sentence."""
        return in_language(self.meaning, language)

    def applies(self, result: Result) -> bool:
        """Whether the mechanism has this number, and the result what it takes to find it."""
        analysis = Analysis.of(result)
        return self.fits(analysis) and self.obstacle(analysis) is None

    def fits(self, analysis: Analysis) -> bool:
        """The same, but for obstacles that other dimensions of the mechanism may not have."""
        return (analysis.forces is not None or not self.needs_forces) and self.suits(analysis)

    def evaluate(self, result: Result) -> tuple[MetricValue, ...]:
        """All its values, one per subject."""
        return tuple(self.values(Analysis.of(result)))

    def suits(self, analysis: Analysis) -> bool:
        """Whether the mechanism has this number; forces are there if they are needed."""
        return bool(analysis.motion.mechanism.drivers)

    def obstacle(self, analysis: Analysis) -> str | None:
        """Why the machine has no such number, in a sentence; None where nothing is known against it."""
        return None

    def numbers(self, analysis: Analysis) -> Iterable[Number]:
        """Its values as formulas; ``analysis``: of the machine, or of the one from which designs start."""
        return ()

    def swept(self, mechanism: Mechanism) -> Mapping[str, tuple[str, ...]]:
        """The points of every subject, where its value is the area of the hull of their curves."""
        return {}

    def asked(self, analysis: Analysis) -> tuple[Number, ...]:
        """These formulas, found once per analysis, whose outputs are evaluated together with all that are asked for
        before the first value is read."""
        key = ("numbers", self.name)
        if key not in analysis.cached:
            analysis.cached[key] = numbers = tuple(self.numbers(analysis))
            analysis.ask(each for number in numbers for each in number.summaries)
        found: tuple[Number, ...] = analysis.cached[key]
        return found

    def remarks(self, value: float, at: float, analysis: Analysis) -> tuple[Remark, ...]:
        """Remarks about a value of a formula."""
        return ()

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        """The values, from what several numbers share; none where no position is reached, nor of the full cycle
        where not all of it is."""
        if not analysis.motion.ok.any():
            return
        for number in self.asked(analysis):
            value, at, exact = number.measured(analysis)
            if isnan(value) and analysis.partial:
                continue
            remarks = (*self.remarks(value, at, analysis), *_unbounded(value, at, analysis))
            yield self.value(
                analysis, number.subject, value, dimension=number.dimension, at=at, exact=exact, remarks=remarks
            )

    def value(
        self,
        analysis: Analysis,
        subject: str,
        value: float,
        *,
        dimension: str | None = None,
        at: float | None = None,
        **more: Any,
    ) -> MetricValue:
        """A value of this number; an ``at`` that is NaN is left out."""
        kind = dimension or self.dimension
        more.setdefault("limit", self.limit if kind == self.dimension else None)
        where = None if at is None or isnan(at) else at
        return MetricValue(self.name, subject, float(value), kind, where, analysis.input_dimension, **more)


def _unbounded(value: float, at: float, analysis: Analysis) -> tuple[Remark, ...]:
    """Remarks about an infinite value: none about one that belongs to no place."""
    if not isinf(value) or isnan(at):
        return ()
    return (
        Remark(
            "unbounded",
            _(
                "grows without bound towards {at}, where it cannot be carried (change or dead point)",
                at=shown(at, analysis.input_dimension),
            ),
            warning=True,
        ),
    )


METRICS: Registry[type[Metric]] = Registry(
    _("metric"), "linkwright.analysis", entry_points="linkwright.metrics", attribute="name"
)
