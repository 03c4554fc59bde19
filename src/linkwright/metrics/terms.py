"""Metrics by the names that users give them, as formulas of summaries and as values of one machine."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from itertools import islice

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.cycle.summary import Extreme, Summary
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.trace import Scalar, absolute, minimum, select
from linkwright.kinematics.names import find_point
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import METRICS, Analysis
from linkwright.metrics.base import Metric, MetricValue, Number
from linkwright.metrics.flywheel import SIZED
from linkwright.metrics.outputs import turns_fully
from linkwright.metrics.wanted import is_summary, wanted
from linkwright.registry import offered


def governing_number(numbers: Sequence[Number], better: str | None) -> Number:
    """Of several numbers the worst where a direction is better, else the first, as one number without a subject."""
    if better is None or len(numbers) == 1:
        return numbers[0]
    parts, (first, *_) = tuple(each for number in numbers for each in number.summaries), numbers
    worst, at = partial(_worst, tuple(numbers), better), partial(_place_of_worst, tuple(numbers), better)
    return Number("", parts, worst, first.dimension, at, first.passed_over)


def _each(numbers: Iterable[Number], values: Iterable[Scalar]) -> list[Scalar]:
    """The values of several numbers from those of all their summaries, one number's behind the other's."""
    rest = iter(values)
    return [number.formula(*islice(rest, len(number.summaries))) for number in numbers]


def _worst(numbers: Sequence[Number], better: str, *values: Scalar) -> Scalar:
    return reduce(minimum if better == "higher" else _larger, _each(numbers, values))


def _place_of_worst(numbers: Sequence[Number], better: str, *parts: Extreme) -> float:
    rest = iter(parts)
    own = [tuple(islice(rest, len(number.summaries))) for number in numbers]
    values = np.array(_each(numbers, [np.float64(each.value) for each in parts]), dtype=float)
    worst = first_largest(-values if better == "higher" else np.abs(values))
    return numbers[worst].at(*own[worst])


def _larger(a: Scalar, b: Scalar) -> Scalar:
    return select(absolute(a) >= absolute(b), a, b)


def metric_of(name: str) -> tuple[type[Metric], str] | None:
    """The registered metric that a name begins with, and the subject behind it."""
    metric, _, subject = name.partition(" ")
    return (METRICS[metric], subject) if metric in METRICS else None


def refuse_obstacle(name: str, analysis: Analysis) -> None:
    """Raises RequestError where the machine itself has an obstacle to a metric, as one that would stop."""
    found = metric_of(name)
    why = None if found is None else found[0]().obstacle(analysis)
    if why is not None:
        raise RequestError("cli.about", name=name, cause=why)


@dataclass(frozen=True)
class Asked:
    """What numbers of a machine's own output depend on besides the machine: the ``output`` that it shares with
    others, and δ, the coefficient of speed ``fluctuation``."""

    output: Output
    fluctuation: float


def own(name: str, analysis: Analysis, asked: Asked) -> Number | None:
    """``travel``, ``output_velocity``, ``output_acceleration``, ``pivot_reaction``, or a number of ``SIZED``.

    None where the machine has none.
    """
    output, dimension = asked.output, OWN[name][0]
    numbers: list[Number] = []
    if name in SIZED:
        metric = SIZED[name](asked.fluctuation)
        numbers += metric.numbers(analysis) if metric.applies(analysis) else ()
    elif name == "pivot_reaction":
        joint, link = pivot(analysis.motion.mechanism, output)
        numbers.append(Number(joint, (Summary(Output("reaction", joint, on=link).name, "max"),)))
    elif name != "travel":
        rate = output.course[1 if name == "output_velocity" else 2]
        dimension = rate.dimension
        numbers.append(Number(str(output), (Summary(rate.name, "peak"),)))
    elif not turns_fully(analysis.motion, output):
        dimension = output.dimension
        numbers.append(Number(str(output), (Summary(output.name, "range"),), at=_nowhere))
    return replace(governing_number(numbers, OWN[name][1]), dimension=dimension) if numbers else None


#: Numbers of the shared output and of δ: their dimension and which direction is better.
OWN: Mapping[str, tuple[str, str | None]] = {
    "travel": ("length", None),
    "output_velocity": ("velocity", None),
    "output_acceleration": ("acceleration", "lower"),
    "pivot_reaction": ("force", "lower"),
    **{name: (each.dimension, each.better) for name, each in SIZED.items()},
}


def pivot(mechanism: Mechanism, output: Output) -> tuple[str, str]:
    """Joint and link where an output is carried by the frame."""
    if output.kind == "displacement":
        joint = mechanism.joints[output.owner]
        return output.owner, next(link for link in joint.joined if link not in mechanism.grounded)
    owner = output.owner if output.kind == "angle" else find_point(mechanism, output.owner)[0]
    at_frame = [
        n for n, j in mechanism.joints.items() if owner in j.joined and mechanism.grounded & set(j.joined)
    ]
    return next(iter(at_frame), _first_joint(mechanism, owner)), owner


def _first_joint(mechanism: Mechanism, link: str) -> str:
    return next(name for name, joint in mechanism.joints.items() if link in joint.joined)


def _nowhere(*parts: Extreme) -> float:
    return float("nan")


def number_named(name: str, analysis: Analysis, asked: Asked | None = None) -> Number | None:
    """A metric, ``peak_reaction`` or ``peak_reaction O5``, or a summary, ``driver.effort rms``, as a formula of
    summaries; None where it does not fit the machine, or is none.

    ``analysis``: of the machine from which designs start; ``asked``: for the numbers of the shared output, which is
    also the subject that counts where none is asked and the metric has it. None as well for an output of which other
    designs may have such a number. Raises RequestError for another subject that the metric does not have.
    """
    if asked is not None and name in OWN:
        return own(name, analysis, asked)
    if is_summary(name):
        return Number("", wanted([name])[:1])
    found = metric_of(name)
    if found is None:
        return None
    preferred = "" if asked is None else str(asked.output)
    kind, subject = found
    metric = kind()
    if not metric.fits(analysis):
        return None
    numbers = tuple(metric.numbers(analysis))
    if not numbers:
        return None
    if may_have(subject, analysis) and all(number.subject != subject for number in numbers):
        return None
    chosen = _chosen(name, metric, numbers, subject, preferred)
    number = governing_number(chosen, metric.better)
    passed_over = number.passed_over if len(chosen) == len(numbers) and not subject else ()
    return replace(number, dimension=number.dimension or metric.dimension, passed_over=passed_over)


def measured(name: str, analysis: Analysis) -> tuple[float, str] | None:
    """Value and dimension of a metric of one machine: of the asked subject, or the governing one; None where it has
    no such number. Raises LinkwrightError for an output that has none here while others have; RequestError for a
    subject that no design can have."""
    found = number_named(name, analysis)
    if found is not None:
        return found.measured(analysis)[0], found.dimension or ""
    kind, subject = metric_of(name) or (None, "")
    if kind is None or not kind().applies(analysis):
        return None
    values = kind().evaluate(analysis)
    mine = [each for each in values if not subject or each.subject == subject]
    if subject and values and not mine:
        error = LinkwrightError if may_have(subject, analysis) else RequestError
        raise _no_subject(error, name, subject, (each.subject for each in values))
    chosen = governing(mine, kind.better) if mine else None
    return None if chosen is None else (chosen.value, chosen.dimension)


def governing(found: Sequence[MetricValue], better: str | None) -> MetricValue:
    """Of several values the worst where a direction is better, else the first."""
    if better is None:
        return found[0]
    values = np.array([value.value for value in found])
    return found[first_largest(-values if better == "higher" else np.abs(values))]


def _no_subject(
    error: type[LinkwrightError], name: str, subject: str, known: Iterable[str]
) -> LinkwrightError:
    metric, _, _ = name.partition(" ")
    return error("metrics.no_value", name=metric, subject=subject, hint=offered(subject, known))


def may_have(subject: str, analysis: Analysis) -> bool:
    """Whether a subject is an output, or a limit of one, of which numbers come and go with the dimensions."""
    return bool(subject) and subject.removesuffix(" max").removesuffix(" min") in map(str, analysis.outputs)


def _chosen(
    name: str, metric: Metric, numbers: Sequence[Number], subject: str, preferred: str
) -> tuple[Number, ...]:
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
