"""What alternatives and designs are measured by: metrics, and summaries of any output."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from linkwright.analysis import METRICS, Metric, MetricValue
from linkwright.analysis.by_name import OWN, is_summary, measured, metric_named, metric_of, wanted
from linkwright.analysis.flywheel import SIZED
from linkwright.core.arguments import one_or_more
from linkwright.designs.alternatives import Alternative
from linkwright.errors import LinkwrightError, RequestError
from linkwright.registry import offered
from linkwright.words import _
from linkwright.words.message import in_words

#: Names of the numbers that only comparisons have.
LABELS = {
    "travel": _("travel of the output"),
    "output_velocity": _("largest speed of the output"),
    "output_acceleration": _("largest acceleration of the output"),
    "pivot_reaction": _("peak reaction at the output's pivot"),
    "flywheel": _("flywheel on the crank"),
    "exact_flywheel": _("exact flywheel on the crank"),
    "reached_fluctuation": _("speed fluctuation reached"),
}


@dataclass(frozen=True)
class Criterion:
    """A number to compare by: ``peak_reaction``, ``peak_reaction O5``, ``flywheel``, ``driver.effort rms``."""

    name: str

    @cached_property
    def metric(self) -> type[Metric] | None:
        """The metric; None for a summary of an output."""
        found = None if is_summary(self.name) else metric_of(self.name)
        return OWN[self.name] if self.name in OWN else None if found is None else found[0]

    @property
    def better(self) -> str | None:
        """``higher`` or ``lower``; None where neither is better."""
        return _better(self.name) if self.metric is None else self.metric.better

    @property
    def forces(self) -> bool:
        """Whether joint forces must be solved."""
        return self.metric is None or self.metric.needs_forces

    def label(self, language: str = "en", dimension: str = "") -> str:
        """Its name in words; a driver that slides has a force, by its ``dimension``."""
        if self.name in OWN:
            return LABELS[self.name].translate(language)
        if self.metric is None:
            return self.name
        title, subject = self.metric().label_in(language, dimension), self.name.partition(" ")[2]
        return f"{title}, {in_words(subject, language)}" if subject else title

    def measure(self, each: Alternative) -> MetricValue | None:
        """The value of an alternative: of a subject, of the shared output, else the governing one. None where it does
        not apply."""
        found = None if self.metric is None else metric_named(self.name, each.asked)
        if found is None:
            return measured(self.name, each.analysis)
        if self.name in SIZED and not each.takes_flywheel:
            return None
        if not found[0].applies(each.analysis):
            if (why := found[0].obstacle(each.analysis)) is not None:
                each.notes.append(_("{name}: {cause}", name=each.label, cause=why))
            return None
        try:
            return measured(self.name, each.analysis, each.asked)
        except LinkwrightError as error:
            if error.code != "metrics.no_value":
                raise
            raise type(error)(
                _(
                    "{name!r} of {label!r} has no value for {subject!r}; {hint}",
                    code="study.no_value_for",
                    label=each.label,
                    **error.values,
                )
            ) from None


def criteria(names: Iterable[str] | str) -> list[Criterion]:
    """The criteria of the given names; raises LinkwrightError for an unknown one, the nearest offered."""
    asked = one_or_more(names)
    if not asked:
        raise RequestError(
            _("no metric is asked for; name some, such as peak_input_torque", code="study.no_metric_named")
        )
    return [criterion(str(name)) for name in dict.fromkeys(asked)]


def criterion(name: str) -> Criterion:
    """The criterion of a name; raises RequestError for an unknown one."""
    found = Criterion(name)
    if found.metric is None and not is_summary(name):
        raise RequestError(
            _(
                "there is no metric {name!r}; {hint} An output with a summary will do as well, such "
                'as "driver.effort rms"',
                code="study.no_metric",
                name=name,
                hint=offered(name, [*OWN, *METRICS]),
            )
        )
    return found


def _better(name: str) -> str | None:
    """Of sizes and efforts less is better; of displacements neither."""
    output, kind = wanted([name])[0].output, wanted([name])[0].kind
    if kind in ("argmin", "argmax") or output.startswith(("closeness", "transmission_angle")):
        return "higher" if kind == "min" else None
    forces = ("reaction", "couple", "shaking", "input_torque", "power", "load")
    heavy = output.startswith(forces) or output.endswith((".effort", "acceleration"))
    return "lower" if heavy and kind in ("max", "rms", "peak", "range") else None


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
