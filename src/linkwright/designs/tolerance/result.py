"""The spread of a mechanism's numbers as a result: whether linear and Monte Carlo agree, tables, steps."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkwright.analysis.by_name import wanted
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.core.table import PERCENT, Block, Row
from linkwright.designs.tolerance.pins import is_position
from linkwright.designs.tolerance.spread import QUANTILES, SpreadNumbers
from linkwright.designs.varied_dimensions import design_values
from linkwright.equations.steps import Step
from linkwright.errors import ModelError, fault
from linkwright.parts.base import Result
from linkwright.words import Message, Translate, _, pgettext

#: Linear and Monte Carlo spread agree within this share.
AGREE = 0.005
#: A bend that explains less than this share of a difference is not its reason.
SMALL = 0.1
#: A cycle that comes nearer to a dead point than this (closeness, 0 at it) is near one.
NEAR = 0.05
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "nominal": _("nominal value"),
    "largest_deviation": _("largest standard deviation"),
    "shift": _("shift by pressed pins"),
    "linear": _("standard deviation, linear"),
    "monte_carlo": _("standard deviation, Monte Carlo"),
    "mean": _("mean, Monte Carlo"),
    "range": _("99.73 % of the machines"),
    "worst": _("± worst case (all tolerances used up)"),
    "yield": _("yield"),
    "largest_monte_carlo": _("largest standard deviation, Monte Carlo"),
    "widest": _("widest band of 99.73 % of the machines"),
    "largest_shift": _("largest shift by pressed pins"),
}


@dataclass(frozen=True, repr=False)
class Spread(SpreadNumbers, Result):
    """Spread of every summary and curve of a tolerance study, SI.

    Linear: σ² = Σ (∂y/∂p · σ_p)², exact derivatives at the nominal mechanism; a free clearance c counts its two
    components with c/√2 each. Monte Carlo: machines drawn by a scrambled Sobol sequence and solved fully. Pressed
    clearances shift the numbers (see ``linkwright.designs.tolerance.pins``) and do not spread them.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS

    def check(self) -> None:
        """Solves what everything rests on; raises LinkwrightError where it cannot be."""
        for text in self.study.of:
            if len(wanted([text])) != 1:
                raise ModelError(
                    [
                        fault(
                            "no_kind",
                            f"of.{self.study.of.index(text)}",
                            _('"{name}" is a curve, not one number of a machine'),
                            _("add min, max, mean, rms, range or peak, or name it under curves"),
                            name=text,
                        )
                    ]
                )
            if self.study.holes("pressed") and not self.summaries[text].kind:
                raise ModelError(
                    [
                        fault(
                            "pressed_number",
                            f"of.{self.study.of.index(text)}",
                            _('"{name}" is a metric; pressed pins shift summaries of outputs alone'),
                            _("name a summary such as rocker.angle range, or leave the pressed clearances out"),
                            name=text,
                        )
                    ]
                )
        if self.summaries or not self._curves:
            _unused = self.gradients
        if self._curves:
            _unused1 = self.derivatives
        if self.drawn:
            design_values(self.study.prepared, self.drawn)
        unseen = self.drawn and self.study.curves and not self.curves
        if unseen or (self.swept is not None and not self.swept.ok.any()):
            raise ModelError(
                [
                    fault(
                        "none_passes",
                        "dimensions",
                        _("none of the {count} machines within these tolerances passes its cycle"),
                        _("give smaller tolerances and clearances"),
                        count=self.study.samples,
                    )
                ]
            )
        if self.study.holes("pressed"):
            _unused2 = self.forces
            if not all(is_position(self.study, output) for output in self._curves):
                _unused3 = self.tracked_pins

    def reason(self, text: str, translate: Translate) -> str:
        """Whether linear and Monte Carlo agree, and if not, why."""
        if self.swept is None or (self.failed == 0 and abs(self.ratio(text) - 1.0) <= AGREE):
            return (
                ""
                if self.swept is None
                else translate(_("{name}: linear and Monte Carlo agree within 0.5 %.", name=text))
            )
        lines = []
        if abs(self.ratio(text) - 1.0) > AGREE or math.isnan(self.ratio(text)):
            lines.append(self._difference(text, translate))
        close = self.closeness
        if close is not None and close[0] < NEAR:
            place = shown(close[1], "angle" if self.turning else "length", 4)
            lines.append(
                translate(
                    _(
                        "The cycle comes near a dead point (closeness {closeness} at {place}, 0 at a dead "
                        "point): there the derivatives grow without bound, and the linear spread holds for "
                        "ever smaller tolerances only.",
                        closeness=f"{close[0]:.3g}",
                        place=place,
                    )
                )
            )
        if self.failed:
            lines.append(
                translate(
                    _(
                        "{failed} of {count} machines do not pass the cycle; the numbers are of the others.",
                        failed=self.failed,
                        count=self.study.samples,
                    )
                )
            )
        return " ".join(lines)

    def _difference(self, text: str, translate: Translate) -> str:
        """Why the two spreads differ: the bend b of y over ±2σ makes its spread 1 + b²/4 times as large; where that
        is far less than the difference, it is too few machines."""
        name, bend = self.bend(text)
        values = {"name": text, "ratio": f"{self.ratio(text):.4g}", "dimension": name}
        values["bend"] = f"{100 * bend:.3g} %" if math.isfinite(bend) else "—"
        if self.failed or not 0.25 * bend**2 < SMALL * abs(self.ratio(text) - 1.0):
            return translate(
                _(
                    "{name}: Monte Carlo gives {ratio} times the linear spread, because the number is "
                    "not linear in the tolerances: over ±2σ of {dimension} it bends by {bend} of its "
                    "change."
                ).format(**values)
            )
        return translate(
            _(
                "{name}: Monte Carlo gives {ratio} times the linear spread, and the number hardly "
                "bends over the tolerances ({bend} over ±2σ of {dimension}): {count} machines tell "
                "the spread no better; give more samples."
            ).format(count=len(self.values(text)), **values)
        )

    def columns(self) -> dict[str, Floats]:
        """Input, every curve and its standard deviation; without curves the summaries of all machines."""
        if self.study.curves:
            found = {"input": self.derivatives.input}
            for output in self.study.curves:
                _unused, values, deviation = self.curve(output)
                found |= {output: values, f"{output} standard deviation": deviation}
                if output in self.curves:
                    spread = self.curves[output]
                    found |= {
                        f"{output} mean, Monte Carlo": spread.mean,
                        f"{output} standard deviation, Monte Carlo": spread.deviation,
                        f"{output} 0.135 %": spread.low,
                        f"{output} 99.865 %": spread.high,
                    }
            return found
        return {text: self.values(text) for text in self.study.of}

    def blocks(self, translate: Translate) -> list[Block]:
        found = [block for text in self.study.of for block in self._summary_blocks(text, translate)]
        for output in self.study.curves:
            found.append(self._curve_block(output, translate))
        return found

    def _summary_blocks(self, text: str, translate: Translate) -> list[Block]:
        kind = self.dimension(text)
        rows = [Row("nominal", self.nominal(text), kind)]
        shift = self.shift(text)
        if self.study.holes("pressed"):
            gaps = int((~self.tracked_pins.tracked).sum()) if math.isnan(shift) else 0
            unknown = _("not tracked (the pins cannot follow at {count} positions)", count=gaps) if gaps else ""
            rows.append(Row("shift", shift, kind, text=unknown))
        if self.swept is not None:
            values = self.values(text)
            low, high = np.quantile(values, QUANTILES).tolist()
            rows += [
                Row("linear", self.linear(text), kind),
                Row("monte_carlo", self.monte_carlo(text), kind, "", _("{count} machines", count=len(values))),
                Row("mean", float(values.mean()), kind),
                Row("range", low, kind, end=high),
                Row("worst", self.worst_case(text), kind),
            ]
        if text in self.study.limits:
            share, low, high, linear = self.passed(text)
            note = _(
                "95 % interval {low} … {high} %; linear {linear} %",
                low=f"{100 * low:.3f}",
                high=f"{100 * high:.3f}",
                linear=f"{100 * linear:.3f}",
            )
            rows.append(Row("yield", share, note=note, scale=PERCENT))
        parts = []
        for each in self.shares(text):
            slope = f"{each.slope:.5g} {self.study.per_unit(kind, each.name)}".rstrip()
            note = _("∂y/∂p = {slope}", slope=slope)
            percent = f"{100 * each.share:.2f} %"
            parts.append(Row(each.name, each.share, label=each.name, note=note, text=percent))
        found = [Block(text, text, rows, tuple(filter(None, [self.reason(text, translate)])))]
        return (
            [*found, Block(f"{text}: contributions", _("Contributions to the variance"), parts)] if parts else found
        )

    def _pins_remark(self, output: str, translate: Translate) -> tuple[str, ...]:
        """How near the pins lie to where their reactions press them, and where they cannot."""
        if not self.study.holes("pressed") or is_position(self.study, output):
            return ()
        settled = self.tracked_pins.tracked
        off = float(self.tracked_pins.residual[settled].max()) if settled.any() else math.nan
        sentences = (
            [
                translate(
                    _("The pins lie within {off} of where their reactions press them.", off=shown(off, "angle", 2))
                )
            ]
            if settled.any()
            else []
        )
        if not settled.all():
            sentences.append(
                translate(
                    _(
                        "At {count} of {steps} positions a reaction jumps or turns faster than the pin can "
                        "follow in its hole: no value there.",
                        count=int((~settled).sum()),
                        steps=len(settled),
                    )
                )
            )
        return (" ".join(sentences),)

    def _curve_block(self, output: str, translate: Translate) -> Block:
        kind = self.dimension(output)
        place, _unused, deviation = self.curve(output)
        found = {"largest_deviation": deviation}
        places = pgettext("tolerance", "at {place}")
        if output in self.curves:
            spread = self.curves[output]
            found |= {"largest_monte_carlo": spread.deviation, "widest": spread.high - spread.low}
        moved = self.pressed(output)
        if np.isfinite(moved).any() and np.nanmax(np.abs(moved)) > 0.0:
            found["largest_shift"] = moved
        rows = []
        for key, values in found.items():
            i = int(np.nanargmax(np.abs(values)))
            at = shown(float(place[i]), "angle" if self.turning else "length", 4)
            note = (
                _("at {place}, of {count} machines", place=at, count=self.curves[output].machines)
                if key == "largest_monte_carlo"
                else places.format(place=at)
            )
            rows.append(Row(key, float(values[i]), kind, "", note))
        return Block(f"curve {output}", _("Curve {name}", name=output), rows, self._pins_remark(output, translate))

    def steps(self, translate: Translate) -> list[Step]:
        found: list[Step] = []
        for text in self.study.of:
            kind, step = self.dimension(text), Step(str(len(found) + 1), text)
            step.note(translate(_("σ² = Σ (∂y/∂p)²·σ_p², derivatives exact at the nominal mechanism (SI)")))
            for each in self.shares(text):
                product = abs(each.slope * each.deviation)
                step.put(
                    f"|∂y/∂p|·σ ({each.name})",
                    "",
                    product,
                    kind,
                    numbers=f"{abs(each.slope):.6g}·{each.deviation:.6g}",
                )
            step.put("σ", "√(Σ (∂y/∂p·σ)²)", self.linear(text), kind)
            if self.swept is not None:
                step.put("s", "√(Σ (y − ȳ)²/(N − 1))", self.monte_carlo(text), kind)
            reason = self.reason(text, translate)
            if reason:
                step.note(reason)
            found.append(step)
        for pin in self.study.holes("pressed"):
            step = Step(str(len(found) + 1), translate(_("Pin {pin} pressed by its own reaction", pin=pin)))
            step.law("r = c·F/|F|; Δy(φ) = c·(∂y/∂x·F_x + ∂y/∂y·F_y)/|F|")
            for text in self.study.of:
                shift = self.shift(text)
                if not math.isnan(shift):
                    step.put(f"Δ {text}", "", shift, self.dimension(text))
            found.append(step)
        return found or [
            Step("1", translate(_("σ² = Σ (∂y/∂p)²·σ_p², derivatives exact at the nominal mechanism (SI)")))
        ]
