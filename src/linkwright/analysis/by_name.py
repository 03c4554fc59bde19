"""Summaries and metrics by the texts that users give: what these mean, as formulas, and as values of one machine.

Also those of the one output that alternatives share or a search is about, and of the flywheel for a coefficient δ.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial, reduce
from itertools import islice
from typing import Any, ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, MetricValue, Number
from linkwright.analysis.flywheel import SIZED
from linkwright.analysis.outputs import turns_fully
from linkwright.core.arguments import one_or_more
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.cycle.summaries import KINDS, Summary, SummaryValue
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.trace import Scalar, absolute, minimum, select
from linkwright.kinematics.names import PHRASES, find_point, output_meant
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import _

NO_OUTPUTS = _('no outputs are asked for; name some, such as "driver.effort rms"', code="study.no_outputs")


NO_TEXT = _('invalid output {value}; write a text such as "driver.effort rms"', code="study.no_output_name")


def wanted(outputs: Iterable[str | tuple[str, str]]) -> tuple[Summary, ...]:
    """Summaries from pairs (output, kind), or texts ``output kind``; an output alone means its min and max, the name
    of a metric that number.

    Raises LinkwrightError for an unknown kind, and where nothing is asked.
    """
    found: dict[Summary, None] = {}
    for each in one_or_more(outputs):
        for summary in _read(each):
            found[summary] = None
    if not found:
        raise RequestError(NO_OUTPUTS)
    return tuple(found)


def is_summary(name: str) -> bool:
    """Whether a text is a summary of an output, ``driver.effort rms``, not a metric, ``limit_position jaw max``."""
    ends = any(sign in name and name.rpartition(sign)[2] in KINDS for sign in " .")
    first = name.partition(" ")[0]
    return ends and (first in PHRASES or first not in METRICS)


def is_metric(name: str) -> bool:
    """Whether a text means a registered metric, not a summary of the output of the same name."""
    return name.partition(" ")[0] in METRICS and not is_summary(name)


def _read(each: str | tuple[str, str]) -> list[Summary]:
    if isinstance(each, str):
        if is_metric(each):
            return [Summary(each, "")]
        output, _unused, kind = each.rpartition(" ")
        if not output or kind not in KINDS:
            output, dot, kind = each.rpartition(".")
            if not dot or kind not in KINDS:
                return [Summary(each, "min"), Summary(each, "max")]
        return [Summary(output, kind)]
    if not isinstance(each, tuple | list) or len(each) != 2:
        raise RequestError(NO_TEXT.format(value=repr(each)[:60]))
    output, kind = each
    if kind not in KINDS:
        hint = offered(kind, KINDS, _("one of: {names}"))
        raise RequestError(
            _(
                "{output!r}: there is no summary {kind!r}; {hint}",
                code="study.no_summary",
                output=output,
                kind=kind,
                hint=hint,
            )
        )
    return [Summary(output, kind)]


def governing_number(numbers: Sequence[Number], better: str | None) -> Number:
    """Of several numbers the worst where a direction is better, else the first, as one number without a subject."""
    if better is None or len(numbers) == 1:
        return numbers[0]
    parts, (first, *_unused) = tuple(each for number in numbers for each in number.summaries), numbers
    worst, at = partial(_worst, tuple(numbers), better), partial(_place_of_worst, tuple(numbers), better)
    return Number("", parts, worst, first.dimension, at, first.passed_over)


def _each(numbers: Iterable[Number], values: Iterable[Scalar]) -> list[Scalar]:
    """The values of several numbers from those of all their summaries, one number's behind the other's."""
    rest = iter(values)
    return [number.formula(*islice(rest, len(number.summaries))) for number in numbers]


def _worst(numbers: Sequence[Number], better: str, *values: Scalar) -> Scalar:
    return reduce(minimum if better == "higher" else _larger, _each(numbers, values))


def _place_of_worst(numbers: Sequence[Number], better: str, *parts: SummaryValue) -> float:
    rest = iter(parts)
    own = [tuple(islice(rest, len(number.summaries))) for number in numbers]
    values: Any = _each(numbers, [np.float64(each.value) for each in parts])
    worst = _first_worst(values, better)
    return numbers[worst].at(*own[worst])


def _larger(a: Scalar, b: Scalar) -> Scalar:
    return select(absolute(a) >= absolute(b), a, b)


def metric_of(name: str) -> tuple[type[Metric], str] | None:
    """The registered metric that a name begins with, and the subject behind it."""
    metric, _unused, subject = name.partition(" ")
    return (METRICS[metric], subject) if metric in METRICS else None


def metric_named(name: str, asked: Asked | None = None) -> tuple[Metric, str] | None:
    """The metric that a name begins with, and the subject behind it; ``asked``: for those of ``of_output``."""
    if asked is not None and name in OWN:
        return own_metric(name, asked), ""
    found = metric_of(name)
    return None if found is None else (found[0](), found[1])


def needs_forces(name: str, mechanism: Mechanism, asked: Asked | None = None) -> bool:
    """Whether a metric, or a summary, takes more than the motion."""
    if is_summary(name):
        return not output_meant(mechanism, wanted([name])[0].output).of_motion
    found = metric_named(name, asked)
    return found is not None and found[0].needs_forces


def number_named(name: str, analysis: Analysis, asked: Asked | None = None) -> Number | None:
    """A metric, ``peak_reaction`` or ``peak_reaction O5``, or a summary, ``driver.effort rms``, as a formula of
    summaries; None where it does not fit the machine, or is none.

    ``analysis``: of the machine from which designs start; ``asked``: for the metrics of the shared output, which is
    also the subject that counts where none is asked and the metric has it. None as well for an output of which other
    designs may have such a number. Raises RequestError for another subject that the metric does not have.
    """
    if is_summary(name):
        return _of_summary(name, analysis)
    found = metric_named(name, asked)
    if found is None or not found[0].fits(analysis):
        return None
    metric, subject = found
    numbers = tuple(metric.numbers(analysis))
    if not numbers or (may_have(subject, analysis) and all(each.subject != subject for each in numbers)):
        return None
    preferred = "" if asked is None else str(asked.output)
    chosen = _chosen(name, metric, numbers, subject, preferred)
    number = governing_number(chosen, metric.better)
    passed_over = number.passed_over if len(chosen) == len(numbers) and not subject else ()
    return replace(number, dimension=number.dimension or metric.dimension, passed_over=passed_over)


def _of_summary(name: str, analysis: Analysis) -> Number:
    """A summary as a number; raises RequestError for the angle of a link that turns through."""
    (summary,) = wanted([name])
    meant = analysis.meant(summary.output)
    if turns_fully(analysis.motion, meant):
        raise RequestError(
            _(
                "{link!r} turns through, so its angle has no smallest and largest value; ask for "
                "{link}.angular_velocity instead",
                code="study.turns_through",
                link=meant.owner,
            )
        )
    place = summary.kind in ("argmin", "argmax")
    return Number("", (summary,), dimension=analysis.input_dimension if place else meant.dimension)


def ask(names: Iterable[str], analysis: Analysis, asked: Asked | None = None) -> None:
    """Says which summaries of a machine some numbers will want, so that these are found together."""
    found = {name: None if is_summary(name) else metric_named(name, asked) for name in names}
    for name in sorted(found, key=lambda name: (each := found[name]) is not None and each[0].judged_last):
        with suppress(LinkwrightError):  # where something is in the way, measuring tells
            number = number_named(name, analysis, asked)
            analysis.ask(number.summaries if number else ())


def measured(name: str, analysis: Analysis, asked: Asked | None = None) -> MetricValue | None:
    """The value of a summary, or of a metric, of one machine: of the asked subject, or the governing one, that of the
    shared output before others; None where it has no such number. Raises LinkwrightError for an output that has none
    here while others have; RequestError for a subject that no design can have."""
    if is_summary(name):
        summary = _of_summary(name, analysis)
        value, at, exact = summary.measured(analysis)
        return MetricValue(name, "", value, summary.dimension or "", at=at, exact=exact)
    found = metric_named(name, asked)
    if found is None:
        return None
    metric, subject = found
    number = None if metric.own_values and subject else number_named(name, analysis, asked)
    if number is not None:
        value, at, exact = number.measured(analysis)
        kind = number.dimension
        return metric.value(analysis, number.subject, value, dimension=kind, at=at, exact=exact)
    if not metric.applies(analysis):
        return None
    values = metric.evaluate(analysis)
    mine = [each for each in values if not subject or each.subject == subject]
    if subject and values and not mine:
        error = LinkwrightError if may_have(subject, analysis) else RequestError
        raise _no_subject(error, name, subject, (each.subject for each in values))
    if asked is not None and not metric.needs_forces:
        mine = [each for each in mine if each.subject == str(asked.output)] or mine
    return governing(mine, metric.better) if mine else None


def governing(found: Sequence[MetricValue], better: str | None) -> MetricValue:
    """Of several values the worst where a direction is better, else the first."""
    return found[_first_worst([each.value for each in found], better) if better else 0]


def _first_worst(values: Sequence[float], better: str) -> int:
    sizes = np.array(values, dtype=float)
    return first_largest(-sizes if better == "higher" else np.abs(sizes))


def _no_subject(error: type[LinkwrightError], name: str, subject: str, known: Iterable[str]) -> LinkwrightError:
    metric, _unused, _unused2 = name.partition(" ")
    return error(
        _(
            '"{name}" has no value for "{subject}"; {hint}',
            code="metrics.no_value",
            name=metric,
            subject=subject,
            hint=offered(subject, known),
        )
    )


def may_have(subject: str, analysis: Analysis) -> bool:
    """Whether a subject is an output, or a limit of one, of which numbers come and go with the dimensions."""
    return bool(subject) and subject.removesuffix(" max").removesuffix(" min") in map(str, analysis.outputs)


def _chosen(name: str, metric: Metric, numbers: Sequence[Number], subject: str, preferred: str) -> tuple[Number, ...]:
    """The numbers of one subject, or all."""
    wanted = (subject,) if subject or metric.needs_forces else (preferred, f"{preferred} max")
    mine = tuple(number for number in numbers if number.subject in wanted)
    chosen_subjects(name, subject, (number.subject for number in numbers))
    return mine or tuple(numbers)


def chosen_subjects(name: str, subject: str, known: Iterable[str]) -> tuple[str, ...]:
    """Of the known subjects the asked one, or all; raises RequestError where it is none of them."""
    every = tuple(known)
    if subject and subject not in every:
        raise _no_subject(RequestError, name, subject, every)
    return (subject,) if subject else every


@dataclass(frozen=True)
class Asked:
    """What these metrics depend on besides the machine: its ``output``, and δ, the coefficient of speed
    ``fluctuation``."""

    output: Output
    fluctuation: float


class OfOutput(Metric):
    """A metric of one output."""

    source = "kinematics and kinetostatics of the output"

    def __init__(self, output: Output) -> None:
        self.output = output


class Travel(OfOutput):
    """The way of the output between its outermost positions, where it does not turn through."""

    name = "travel"
    dimension = "length"

    def suits(self, analysis: Analysis) -> bool:
        return not turns_fully(analysis.motion, self.output)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        summary = Summary(self.output.name, "range")
        yield Number(str(self.output), (summary,), dimension=self.output.dimension)


class OutputVelocity(OfOutput):
    """Largest size of the output's velocity."""

    name = "output_velocity"
    dimension = "velocity"
    order: ClassVar[int] = 1

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        rate = self.output.course[self.order]
        yield Number(str(self.output), (Summary(rate.name, "peak"),), dimension=rate.dimension)


class OutputAcceleration(OutputVelocity):
    """Largest size of the output's acceleration."""

    name = "output_acceleration"
    dimension = "acceleration"
    better: ClassVar[Better | None] = "lower"
    order = 2


class PivotReaction(OfOutput):
    """Largest size of the reaction where the output is carried by the frame."""

    name = "pivot_reaction"
    dimension = "force"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        joint, link = pivot(analysis.motion.mechanism, self.output)
        yield Number(joint, (Summary(Output("reaction", joint, on=link).name, "max"),))


_OF_OUTPUT: Mapping[str, type[OfOutput]] = {
    each.name: each for each in (Travel, OutputVelocity, OutputAcceleration, PivotReaction)
}
#: All of them by name.
OWN: Mapping[str, type[Metric]] = {**_OF_OUTPUT, **SIZED}


def own_metric(name: str, asked: Asked) -> Metric:
    """One of them, of an output or for a coefficient."""
    return SIZED[name](asked.fluctuation) if name in SIZED else _OF_OUTPUT[name](asked.output)


def pivot(mechanism: Mechanism, output: Output) -> tuple[str, str]:
    """Joint and link where an output is carried by the frame."""
    if output.kind == "displacement":
        joint = mechanism.joints[output.owner]
        return output.owner, next(link for link in joint.joined if link not in mechanism.grounded)
    owner = output.owner if output.kind == "angle" else find_point(mechanism, output.owner)[0]
    at_frame = [n for n, j in mechanism.joints.items() if owner in j.joined and mechanism.grounded & set(j.joined)]
    return next(iter(at_frame), _first_joint(mechanism, owner)), owner


def _first_joint(mechanism: Mechanism, link: str) -> str:
    return next(name for name, joint in mechanism.joints.items() if link in joint.joined)
