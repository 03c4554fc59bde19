"""Design numbers as formulas of summaries, ready for many designs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.cycle.summary import Extreme
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.trace import Scalar, absolute, minimum, select
from linkwright.kinematics.names import find_point
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import METRICS, Analysis
from linkwright.metrics.base import Metric, MetricValue, Number
from linkwright.metrics.flywheel import SIZED
from linkwright.metrics.outputs import turns_fully
from linkwright.registry import offered


@dataclass(frozen=True)
class Term:
    """One number per design: of the ``numbers`` of a metric the governing one.

    ``passed_over``: outputs that reverse nowhere where the number is meant, see ``Number``.
    """

    name: str
    numbers: tuple[Number, ...]
    dimension: str
    better: str | None = None
    passed_over: tuple[Output, ...] = ()

    @property
    def parts(self) -> tuple[str, ...]:
        """The summaries that it is made of."""
        return tuple(dict.fromkeys(part for number in self.numbers for part in number.parts))

    def measured(self, analysis: Analysis) -> float:
        """The number of one machine."""
        parts = {part: np.float64(analysis.part(part).value) for part in self.parts}
        with np.errstate(divide="ignore", invalid="ignore"):  # infinite as of many designs, not an error
            found = self.value(parts)
        assert isinstance(found, float)
        return float(found)

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


def own(name: str, analysis: Analysis, asked: Asked) -> Term | None:
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
        numbers.append(Number(joint, (f"{Output('reaction', joint, on=link).name} max",)))
    elif name != "travel":
        rate = output.course[1 if name == "output_velocity" else 2]
        dimension = rate.dimension
        numbers.append(Number(str(output), (f"{rate.name} peak",)))
    elif not turns_fully(analysis.motion, output):
        dimension = output.dimension
        numbers.append(Number(str(output), (f"{output.name} range",), at=_nowhere))
    return Term(name, tuple(numbers), dimension, OWN[name][1]) if numbers else None


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


def term(name: str, analysis: Analysis, asked: Asked | None = None) -> Term | None:
    """A metric, ``peak_reaction`` or ``peak_reaction O5``, as a term; None where it does not fit the machine, or is
    no formula of summaries.

    ``analysis``: of the machine from which designs start; ``asked``: for the numbers of the shared output, which is
    also the subject that counts where none is asked and the metric has it. None as well for an output of which other
    designs may have such a number. Raises RequestError for another subject that the metric does not have.
    """
    if asked is not None and name in OWN:
        return own(name, analysis, asked)
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
    passed_over = chosen[0].passed_over if len(chosen) == len(numbers) and not subject else ()
    return Term(name, chosen, chosen[0].dimension or metric.dimension, metric.better, passed_over)


def measured(name: str, analysis: Analysis) -> tuple[float, str] | None:
    """Value and dimension of a metric of one machine: of the asked subject, or the governing one; None where it has
    no such number. Raises LinkwrightError for an output that has none here while others have; RequestError for a
    subject that no design can have."""
    found = term(name, analysis)
    if found is not None:
        return found.measured(analysis), found.dimension
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


def all_parts(terms: Iterable[Term]) -> tuple[str, ...]:
    """The summaries that some terms are made of, each once."""
    return tuple(dict.fromkeys(part for each in terms for part in each.parts))
