"""What alternatives and designs are measured by: registered design numbers, and summaries of any output."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.given import one_or_more
from linkwright.designs.alternatives import Alternative
from linkwright.errors import LinkwrightError, RequestError
from linkwright.metrics import METRICS, Metric, MetricValue
from linkwright.metrics.base import Number
from linkwright.metrics.flywheel import SIZED
from linkwright.metrics.terms import OWN, governing, may_have, metric_of, number_named, own
from linkwright.metrics.wanted import is_summary, wanted
from linkwright.registry import offered
from linkwright.words import say
from linkwright.words.sentence import Sentence, in_words


@dataclass(frozen=True)
class Measured:
    """A value, SI, with its dimension; ``at``: the input there (rad or m), where it belongs to one."""

    value: float
    dimension: str
    at: float | None = None


@dataclass(frozen=True)
class Criterion:
    """A number to compare by: ``better`` is ``higher``, ``lower`` or None where neither is."""

    name: str
    better: str | None
    measure: Callable[[Alternative], Measured | None]
    forces: bool = False

    def __reduce__(self) -> tuple[Callable[[str], Criterion], tuple[str]]:
        return criterion, (self.name,)

    def label(self, language: str = "en", dimension: str = "") -> str:
        """Its name in words; a driver that slides has a force, by its ``dimension``."""
        if self.name in OWN:
            return say(f"compare.{self.name}.label", language)
        if (found := metric_of(self.name)) is None:
            return self.name
        title = found[0]().label_in(language, dimension)
        return f"{title}, {in_words(found[1], language)}" if found[1] else title


def criteria(names: Iterable[str] | str) -> list[Criterion]:
    """The criteria of the given names; raises LinkwrightError for an unknown one, the nearest offered."""
    asked = one_or_more(names)
    if not asked:
        raise RequestError("study.no_metric_named")
    return [criterion(str(name)) for name in dict.fromkeys(asked)]


def criterion(name: str) -> Criterion:
    """``peak_reaction``, ``peak_reaction O5``, ``flywheel``, or a summary such as ``driver.effort rms``."""
    if name in OWN:
        forces = name == "pivot_reaction" or name in SIZED
        return Criterion(name, OWN[name][1], lambda each: _own(each, name), forces)
    if is_summary(name):
        return Criterion(name, _better(name), lambda each: _summary(each, name), True)
    if (known := metric_of(name)) is not None:
        kind, subject = known
        return Criterion(name, kind.better, lambda each: _metric(each, kind(), subject), kind.needs_forces)
    hint = offered(name, [*OWN, *METRICS])
    raise RequestError("study.no_metric", name=name, hint=hint)


def _better(name: str) -> str | None:
    """Of sizes and efforts less is better; of displacements neither."""
    output, kind = wanted([name])[0].output, wanted([name])[0].kind
    if kind in ("argmin", "argmax") or output.startswith(("closeness", "transmission_angle")):
        return "higher" if kind == "min" else None
    forces = ("reaction", "couple", "shaking", "input_torque", "power", "load")
    heavy = output.startswith(forces) or output.endswith((".effort", "acceleration"))
    return "lower" if heavy and kind in ("max", "rms", "peak", "range") else None


def _metric(each: Alternative, metric: Metric, subject: str) -> Measured | None:
    """The value of a subject; of the shared output; else the governing one. None where it does not apply."""
    if not metric.applies(each.analysis):
        if (why := metric.obstacle(each.analysis)) is not None:
            each.notes.append(Sentence("cli.about", name=each.label, cause=why))
        return None
    meant = (
        number_named(metric.name, each.analysis, each.asked) if metric.own_values and not subject else None
    )
    if meant is not None:
        value, at, _ = meant.measured(each.analysis)
        return Measured(value, meant.dimension or "", at)
    values = metric.evaluate(each.analysis)
    found = [v for v in values if v.subject == subject] if subject else _of_output(each, metric, values)
    if not found:
        if subject and values:
            hint = offered(subject, [v.subject for v in values])
            error = LinkwrightError if may_have(subject, each.analysis) else RequestError
            raise error("study.no_value_for", name=metric.name, label=each.label, subject=subject, hint=hint)
        return None
    worst = governing(found, metric.better)
    return Measured(worst.value, worst.dimension, worst.at)


def numbers_of(each: Alternative, name: str) -> Iterable[Number]:
    """The formulas of summaries behind a criterion, of all subjects."""
    if name in OWN:
        found = own(name, each.analysis, each.asked)
        return (found,) if found else ()
    metric, _ = metric_of(name) or (None, "")
    kind = metric() if metric is not None else None
    return kind.numbers(each.analysis) if kind is not None and kind.applies(each.analysis) else ()


def _own(each: Alternative, name: str) -> Measured | None:
    """A number of the shared output."""
    if name in SIZED and not each.takes_flywheel:
        return None
    found = own(name, each.analysis, each.asked)
    if found is None:
        return None
    value, at, _ = found.measured(each.analysis)
    return Measured(value, found.dimension or "", None if np.isnan(at) else at)


def _of_output(each: Alternative, metric: Metric, values: Iterable[MetricValue]) -> list[MetricValue]:
    """Values of the shared output, where the number is one of outputs; else all.

    Forces are of joints and drivers, of which one may bear the output's name.
    """
    everything = list(values)
    mine = [] if metric.needs_forces else [v for v in everything if v.subject == str(each.output)]
    return mine or everything


def _summary(each: Alternative, name: str) -> Measured:
    """A summary of an output, from the program of sweeps."""
    from linkwright.designs.designs import sweep

    found = sweep(
        each.mechanism, {"gravity.x": [each.mechanism.gravity[0]]}, outputs=[name], steps=each.steps
    )
    summary = next(iter(found.summaries))
    if found.unloaded:
        raise LinkwrightError(found.unloaded[0])
    each.notes += [Sentence("cli.about", name=each.label, cause=note) for note in found.notes]
    return Measured(float(found.summaries[summary][0]), found.dimension(summary))


#: What is compared when nobody says what.
USUAL = (
    "travel",
    "quick_return_ratio",
    "output_velocity",
    "output_acceleration",
    "transmission_angle",
    "peak_input_torque",
    "rms_input_torque",
    "mean_power",
    "pivot_reaction",
    "peak_reaction",
    "peak_shaking_force",
    "flywheel",
)
