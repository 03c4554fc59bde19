"""The conclusion in sentences: what the machine does, which limits it keeps, and which length would improve it most.

Every number is one that other sections print: from the metrics, the steady running, the extremes of curves.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, MetricValue
from linkwright.analysis.evaluate import MetricsTable
from linkwright.core.outputs import Output
from linkwright.core.quantity import shown
from linkwright.cycle.summaries import Summary
from linkwright.designs.evaluation import value_text
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plotting.diagrams.source import main_output, main_outputs
from linkwright.reports.document import Block, Paragraph, literal
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.numbers import typeset
from linkwright.reports.section import section
from linkwright.words import Message, _
from linkwright.words.message import in_words

#: Joint forces nearer to each other than this share are equal; a mean below this share of the peak is zero.
EQUAL, NOTHING = 1e-9, 1e-6
#: A peak that is not more than so many times the mean is not compared with it.
WORTH = 1.05
#: Percent that are zero but for rounding.
SMALLEST = 1e-6
#: Outputs of which the sentences tell, at most.
MOST = 3
#: What one of several drivers supplies, and what the only one does: a torque, a force.
SUPPLIED = (
    _(
        "Driver {driver} must supply a torque of at most {peak} (at q = {at}), {mean} on average "
        "and {rms} as root mean square."
    ),
    _(
        "Driver {driver} must supply a force of at most {peak} (at q = {at}), {mean} on average "
        "and {rms} as root mean square."
    ),
)
SUPPLIED_ALONE = (
    _(
        "The driver must supply a torque of at most {peak} (at q = {at}), {mean} on average and "
        "{rms} as root mean square."
    ),
    _(
        "The driver must supply a force of at most {peak} (at q = {at}), {mean} on average and "
        "{rms} as root mean square."
    ),
)


@section("conclusion", _("Conclusion"), 21.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Motion, transmission of force, limits, forces, flywheel, and what to change."""
    found = list(_Conclusion(case).all())
    if not found:
        raise Missing(_("there are no results of a motion or of forces to conclude from", code="conclusion.nothing"))
    yield from found


class _Conclusion:
    def __init__(self, case: ReportContext) -> None:
        self.case = case
        self.translate = case.translate
        self.moves = bool(case.mechanism.drivers)

    def all(self) -> Iterator[Block]:
        """The paragraphs, each with its subject first."""
        if self.moves:
            yield from self._paragraph(_("**Motion.**"), self._motion())
            yield from self._paragraph(_("**Transmission of force.**"), self._transmission())
            yield from self._limits()
        if self.case.mechanism.has_loads:
            yield from self._paragraph(_("**Forces.**"), self._forces())
        if self.moves:
            yield from self._paragraph(_("**Flywheel.**"), self._flywheel())
            yield from self._paragraph(_("**What a designer would change.**"), self._changes())

    def _paragraph(self, subject: Message, sentences: Iterator[str]) -> Iterator[Block]:
        if text := self._joined(*sentences):
            yield Paragraph(self._joined(self.translate(subject), text))

    def _joined(self, *sentences: str) -> str:
        """Sentences of one paragraph; between Chinese ones there is no space."""

        def together(first: str, second: str) -> str:
            return self.translate(_("{first} {second}", first=first, second=second))

        return reduce(together, sentences) if sentences else ""

    def _rows(self, *metrics: str) -> list[MetricValue]:
        return [row for row in self.case.metrics if row.metric in metrics]

    # motion -----------------------------------------------------------------------------------
    def _motion(self) -> Iterator[str]:
        translate = self.translate
        for row in self._rows("stroke", "swing_angle")[:MOST]:
            moved = (
                _("The stroke of {subject} is {value}.")
                if row.metric == "stroke"
                else _("The swing angle of {subject} is {value}.")
            )
            yield translate(moved.format(subject=literal(row.subject), value=_value(row)))
        for row in self._rows("quick_return_ratio")[:MOST]:
            ratio = (
                _("The slow stroke of {subject} takes {ratio} times as long as the fast one (quick-return ratio K).")
                if abs(row.value - 1.0) > 1e-6
                else _("Both strokes of {subject} take the same time (quick-return ratio K = 1).")
            )
            yield translate(ratio.format(subject=literal(row.subject), ratio=_value(row)))
        for output in main_outputs(self.case.motion)[:MOST]:
            yield from self._rates(output)
        if not self.case.motion.complete:
            yield translate(
                _("The values hold for the part of the input's range in which the machine can be assembled.")
            )

    def _rates(self, output: Output) -> Iterator[str]:
        """The largest velocity and acceleration of an output or of a point, with their places."""
        analysis, rates = Analysis.of(self.case.result), output.course[1:]
        first, second = (analysis.part(Summary(each.name, "peak")) for each in rates)
        if not (math.isfinite(first.value) and math.isfinite(second.value)):
            return
        places = [typeset(shown(each.input, analysis.input_dimension)) for each in (first, second)]
        yield self.translate(
            (
                _(
                    "The angular velocity of {subject} is at most {velocity} (at q = {first}), its "
                    "angular acceleration at most {acceleration} (at q = {second})."
                )
                if output.kind == "angle"
                else _(
                    "The velocity of {subject} is at most {velocity} (at q = {first}), its acceleration "
                    "at most {acceleration} (at q = {second})."
                )
            ).format(
                subject=literal(str(output)),
                velocity=typeset(shown(first.value, rates[0].dimension)),
                acceleration=typeset(shown(second.value, rates[1].dimension)),
                first=places[0],
                second=places[1],
            )
        )

    # transmission -----------------------------------------------------------------------------
    def _transmission(self) -> Iterator[str]:
        translate = self.translate
        if (row := _lowest(self._rows("transmission_angle"))) is not None and row.limit is not None:
            message = (
                _(
                    "The transmission angle falls to {value} (group {subject}, at q = {at}), below the "
                    "recommended {limit}."
                )
                if broken(row)
                else _(
                    "The transmission angle is at least {value} (group {subject}, at q = {at}) and so keeps "
                    "the recommended limit of {limit}."
                )
            )
            yield translate(message.format(**_placeholders(row), limit=typeset(shown(row.limit, row.dimension))))
        if (row := _lowest(self._rows("singularity"))) is not None:
            yield translate(
                (
                    _(
                        "Group {subject} comes close to a singular position at q = {at} (distance from it "
                        "{value}; 1 at best, 0 where singular): forces grow very large there."
                    )
                    if broken(row)
                    else _(
                        "No group comes close to a singular position: the distance from it is at least "
                        "{value} (group {subject}, at q = {at}; 1 at best, 0 where singular)."
                    )
                ).format(**_placeholders(row))
            )

    def _limits(self) -> Iterator[Block]:
        translate, rows = self.translate, [row for row in self.case.metrics if row.limit is not None]
        if not rows:
            return
        count = sum(map(broken, rows))
        if not count:
            yield Paragraph(
                self._joined(
                    translate(_("**Recommended limits.**")),
                    translate(_("All {count} values that have a recommended limit keep it.", count=len(rows))),
                )
            )
            return
        yield Paragraph(
            self._joined(
                translate(_("**Recommended limits.**")),
                translate(
                    _(
                        "Of {count} values that have a recommended limit {broken} do not keep it:",
                        count=len(rows),
                        broken=count,
                    )
                ),
            )
        )
        for sentence in self.case.metrics.warnings_in(self.case.language):
            yield Paragraph(literal(sentence), "bullet")

    # forces -----------------------------------------------------------------------------------
    def _forces(self) -> Iterator[str]:
        translate, case = self.translate, self.case
        peaks = self._rows("peak_reaction")
        if peaks:
            top = max(peaks, key=lambda row: row.value)
            equal = [row for row in peaks if abs(row.value - top.value) <= EQUAL * abs(top.value)]
            joints = translate(_(", ")).join(literal(in_words(row.subject, case.language)) for row in equal)
            largest = (
                _("The largest joint force is {value} (joint {joints}).")
                if top.at is None or not self.moves
                else _("The largest joint force is {value} (joint {joints}, at q = {at}).")
            )
            yield translate(largest.format(value=_value(top), joints=joints, at=_at(top)))
        if not self.moves:
            return
        for row in self._rows("peak_input_torque"):
            yield from self._effort(row)
        for row in self._rows("peak_shaking_force"):
            yield translate(
                _("The largest shaking force on the frame is {value} (at q = {at}).", value=_value(row), at=_at(row))
            )

    def _effort(self, peak: MetricValue) -> Iterator[str]:
        """Peak, mean and root mean square of what a driver supplies."""
        mean = Analysis.of(self.case.forces).part(Summary(f"{peak.subject}.effort", "mean")).value
        roots = [row for row in self._rows("rms_input_torque") if row.subject == peak.subject]
        if not roots:
            return
        small = abs(mean) <= NOTHING * abs(peak.value)
        torque, force = SUPPLIED if len(self.case.mechanism.drivers) > 1 else SUPPLIED_ALONE
        yield self.translate(
            (torque if peak.dimension == "torque" else force).format(
                driver=literal(in_words(peak.subject, self.case.language)),
                peak=_value(peak),
                at=_at(peak),
                mean=typeset(shown(0.0 if small else mean, peak.dimension)),
                rms=_value(roots[0]),
            )
        )
        if not small and abs(peak.value) > WORTH * abs(mean):
            ratio = abs(peak.value / mean)
            yield self.translate(
                _("The peak is {ratio} times the mean.", ratio=f"{ratio:.0f}" if ratio >= 100.0 else f"{ratio:.3g}")
            )

    # flywheel ---------------------------------------------------------------------------------
    def _flywheel(self) -> Iterator[str]:
        translate, case = self.translate, self.case
        try:
            running = case.running
        except LinkwrightError:
            return
        at, excess = running.equivalent.input_at, running.energy
        low, high = (typeset(shown(at(end), "angle")) for end in (excess.low, excess.high))
        energy = typeset(shown(excess.value, "energy"))
        yield translate(
            _(
                "What governs the flywheel is the stretch from q = {low}, where the input turns "
                "slowest, on to q = {high}, where it turns fastest: there the energy excess grows by "
                "{energy}.",
                low=low,
                high=high,
                energy=energy,
            )
        )
        fluctuation = f"{running.required:g}"
        if not running.exact_flywheel:
            yield translate(
                _(
                    "For δ = {fluctuation} no flywheel is needed: the machine's own inertia is enough.",
                    fluctuation=fluctuation,
                )
            )
            return
        inertia, formula = (typeset(shown(each, "inertia")) for each in (running.exact_flywheel, running.flywheel))
        yield translate(
            _(
                "For δ = {fluctuation} the input shaft needs a flywheel of {inertia} ({formula} by the formula).",
                fluctuation=fluctuation,
                inertia=inertia,
                formula=formula,
            )
        )
        yield translate(_("Without a flywheel δ would be {own} by the formula.", own=typeset(f"{running.own:.4g}")))

    # changes ----------------------------------------------------------------------------------
    def _changes(self) -> Iterator[str]:
        found = improvements(self.case.motion, self.case.metrics)
        for each in found:
            metric = METRICS[each.row.metric]().label_in(self.case.language, each.row.dimension)
            yield self.translate(
                (
                    _(
                        "Among the link lengths {dimension} has most influence on the {metric}: 1 % {way} "
                        "would lower it from {value} to about {better}."
                    )
                    if each.row.metric == EFFORT
                    else _(
                        "Among the link lengths {dimension} has most influence on the {metric}: 1 % {way} "
                        "would bring it from {value} to about {better}."
                    )
                ).format(
                    metric=literal(metric),
                    dimension=literal(each.dimension),
                    way=self.translate(_("longer") if each.longer else _("shorter")),
                    value=_value(each.row),
                    better=typeset(value_text(each.better, each.row.dimension)),
                )
            )
            percent = typeset(f"{each.side_effect:.2g}") if abs(each.side_effect) > SMALLEST else "0"
            yield self.translate(
                _(
                    "The travel of {output} would then change by {percent} %.",
                    output=literal(each.output),
                    percent=percent,
                )
            )
        if found:
            yield self.translate(
                _(
                    "These figures are of first order, from the exact derivatives at the present "
                    "dimensions; what else is asked of the machine is to be checked anew."
                )
            )


def _lowest(rows: Sequence[MetricValue]) -> MetricValue | None:
    """The value that is lowest relative to its limit."""
    known = [row for row in rows if math.isfinite(row.value)]
    return min(known, key=lambda row: row.value / (row.limit or 1.0), default=None)


def _placeholders(row: MetricValue) -> dict[str, str]:
    return {"value": _value(row), "subject": literal(row.subject), "at": _at(row)}


def _value(row: MetricValue) -> str:
    return typeset(shown(row.value, row.dimension))


def _at(row: MetricValue) -> str:
    return "–" if row.at is None else typeset(shown(row.at, row.at_dimension))


#: Numbers whose recommended limits say how a machine passes on forces: the first that is exceeded is examined.
JUDGED = ("transmission_angle", "pressure_angle", "singularity")
#: What a driver must supply.
EFFORT = "peak_input_torque"
#: Percent per percent: a smaller change is none, a larger one is beyond what a first order can tell.
MIN_PERCENT, MAX_PERCENT = 0.02, 50.0
#: Links of machines of which the derivatives of forces cost no more than the rest of a report.
FEW = 8
#: To this share the value that has derivatives is the one in the table, not that of another subject.
SAME = 1e-6


@dataclass(frozen=True)
class Improvement:
    """A link length that, one percent ``longer`` or shorter, brings the metric ``row`` to about ``better``;
    the travel of ``output`` then changes by ``side_effect`` percent."""

    row: MetricValue
    dimension: str
    longer: bool
    better: float
    output: str
    side_effect: float


def broken(row: MetricValue) -> bool:
    """Whether a value is beyond its recommended limit."""
    if row.limit is None:
        return False
    return row.value < row.limit if METRICS[row.metric].better == "higher" else row.value > row.limit


def improvements(motion: Motion, metrics: MetricsTable) -> list[Improvement]:
    """For the first number of force transmission that does not keep its limit, and for the peak of what an only
    driver supplies; none where there are no derivatives, or where they help little."""
    mechanism, output = motion.mechanism, main_output(motion)
    rows = [row for row in (_transmission(metrics), _effort(metrics, len(mechanism.links))) if row is not None]
    lengths = [name for name in mechanism.dimensions() if name.endswith(".length") or ".lengths." in name]
    if not rows or not lengths or output.is_point:
        return []
    travel = f"{output.name} range"
    slopes = _slopes(mechanism, [row.metric for row in rows], travel, lengths)
    found = (_improved(row, lengths, slopes, str(output), travel) for row in rows if row.metric in slopes)
    return [each for each in found if each is not None]


def _transmission(metrics: MetricsTable) -> MetricValue | None:
    """The worst value of the first number that does not keep its limit."""
    for name in JUDGED:
        rows = [row for row in metrics if row.metric == name and broken(row)]
        if rows:
            sign = 1.0 if METRICS[name].better == "higher" else -1.0
            return min(rows, key=lambda row: sign * row.value)
    return None


def _effort(metrics: MetricsTable, links: int) -> MetricValue | None:
    rows = [row for row in metrics if row.metric == EFFORT]
    return rows[0] if len(rows) == 1 and links <= FEW else None


#: Value of a number, and percent by which it changes per percent of each length.
Slopes = dict[str, tuple[float, Sequence[float]]]


def _slopes(mechanism: Mechanism, names: Sequence[str], travel: str, lengths: Sequence[str]) -> Slopes:
    """Of all numbers that have derivatives; together where that goes, for they share a program."""
    from linkwright.designs.sensitivity import sensitivity

    found: Slopes = {}
    for asked in _tries([*names, travel]):
        try:
            result = sensitivity(mechanism, of=asked, by=lengths)
            found |= {name: (result.value(name), result.relative(name).tolist()) for name in asked}
        except LinkwrightError:
            continue
        if len(asked) > 1:
            break
    return found


def _tries(names: Sequence[str]) -> Iterator[Sequence[str]]:
    """All names together, then each alone."""
    yield names
    yield from ([name] for name in names)


def _improved(
    row: MetricValue, lengths: Sequence[str], slopes: Slopes, output: str, travel: str
) -> Improvement | None:
    """The length with most influence; None where none helps, or what it does to the travel is not known."""
    value, changes = slopes[row.metric]
    if not abs(value - row.value) <= SAME * abs(row.value) or not np.isfinite(changes).any():
        return None
    best = int(np.nanargmax(np.abs(changes)))
    slope, side = changes[best], slopes[travel][1][best] if travel in slopes else math.nan
    if not MIN_PERCENT <= abs(slope) <= MAX_PERCENT or not math.isfinite(side):
        return None
    sign = 1.0 if METRICS[row.metric].better == "higher" else -1.0
    longer = sign * slope * row.value > 0.0
    better = row.value + sign * 0.01 * abs(slope * row.value)
    return Improvement(row, lengths[best], longer, better, output, side if longer else -side)
