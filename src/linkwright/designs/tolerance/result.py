"""The spread of a mechanism's numbers: linear by exact derivatives, and by Monte Carlo through the engine."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from linkwright.analysis.by_name import wanted
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.core.rows import Block, Row
from linkwright.core.table import PERCENT
from linkwright.cycle.summary import Summary
from linkwright.designs.designs import Sweep, sweep
from linkwright.designs.one_by_one import OF_VALUES
from linkwright.designs.sensitivity import CURVE, Sensitivity, sensitivity
from linkwright.designs.tolerance.curves import CurveSpread, curve_spreads
from linkwright.designs.tolerance.pins_in_motion import FollowedPins, follow
from linkwright.designs.tolerance.pressed_pins import is_position, require_forces, shifts
from linkwright.designs.tolerance.problem import Limit, Tolerances
from linkwright.designs.varied_dimensions import design_values
from linkwright.equations.steps import Step
from linkwright.errors import LinkwrightError, ModelError, fault
from linkwright.kinetostatics.forces import Forces
from linkwright.parts.base import Result
from linkwright.words import Message, Translate, _, pgettext

#: Linear and Monte Carlo spread agree within this share.
AGREE = 0.005
#: A bend that explains less than this share of a difference is not its reason.
SMALL = 0.1
#: A cycle that comes nearer to a dead point than this (closeness, 0 at it) is near one.
NEAR = 0.05
#: Shares of a normal distribution at ±3σ.
QUANTILES = (0.00135, 0.99865)
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


@dataclass(frozen=True)
class Share:
    """What a dimension or clearance contributes: derivative, its own standard deviation, part of the variance."""

    name: str
    slope: float
    deviation: float
    share: float


@dataclass(frozen=True, repr=False)
class Spread(Result):
    """Spread of every summary and curve of a tolerance study, SI.

    Linear: σ² = Σ (∂y/∂p · σ_p)², exact derivatives at the nominal mechanism; a free clearance c counts its two
    components with c/√2 each. Monte Carlo: machines drawn by a scrambled Sobol sequence and solved fully. Pressed
    clearances shift the numbers (see ``linkwright.designs.tolerance.pressed_pins``) and do not spread them.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    study: Tolerances

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
                            _('"{name}" is a design number; pressed pins shift summaries of outputs alone'),
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
                _unused3 = self.followed

    @property
    def _curves(self) -> tuple[str, ...]:
        """Outputs over the positions: the curves, and those whose summaries pressed pins shift."""
        shifted = (s.output for s in self.summaries.values() if self.study.holes("pressed"))
        return tuple(dict.fromkeys([*self.study.curves, *shifted]))

    # linear ---------------------------------------------------------------------------------------
    @cached_property
    def summaries(self) -> dict[str, Summary]:
        """The summaries by their texts."""
        return {text: wanted([text])[0] for text in self.study.of}

    @property
    def addresses(self) -> list[str]:
        """Everything that varies, in the prepared mechanism."""
        holes = [a for kind in ("free", "pressed") for pair in self.study.holes(kind).values() for a in pair]
        return [*self.study.deviating, *(a for a in holes if a not in self.study.deviating)]

    @cached_property
    def gradients(self) -> Sensitivity:
        """Exact derivatives of summaries of the cycle."""
        asked = [summary.name for summary in self.summaries.values()]
        return sensitivity(self.study.prepared, of=asked, by=self.addresses)

    @cached_property
    def derivatives(self) -> Sensitivity:
        """Exact derivatives of curves."""
        curves = [(output, CURVE) for output in self._curves]
        return sensitivity(self.study.prepared, of=curves, by=self.addresses, steps=self.study.steps)

    @cached_property
    def forces(self) -> Forces:
        """Forces of the nominal mechanism, which press the pins."""
        return require_forces(self.study)

    @cached_property
    def followed(self) -> FollowedPins:
        """The pins led by their own reactions over the cycle, for rates and forces."""
        return follow(self.study, self.forces)

    def nominal(self, text: str) -> float:
        """A summary of the nominal mechanism without clearances."""
        return self.gradients.values[self.summaries[text]]

    def dimension(self, text: str) -> str:
        """Name of the dimension of a summary or a curve."""
        summary = self.summaries.get(text)
        if summary is not None and not summary.kind:
            assert self.swept is not None
            return self.swept.dimension(summary)
        if summary is None:
            return self.derivatives.quantities[text].dimension
        return self.gradients.quantities[summary.output].dimension

    def shares(self, text: str) -> list[Share]:
        """What contributes to the linear spread of a summary, the largest first."""
        gradient = self.gradients.by_name(self.summaries[text].name)
        parts = {
            self.study.written(address): (gradient[address], tolerance.deviation)
            for address, tolerance in self.study.deviating.items()
        }
        for pin, pair in self.study.holes("free").items():
            slope = math.hypot(*(gradient[address] for address in pair))
            parts[pin] = (slope, self.study.clearances[pin].clearance / math.sqrt(2))
        total = sum((slope * deviation) ** 2 for slope, deviation in parts.values())
        found = [
            Share(name, slope, deviation, (slope * deviation) ** 2 / total if total else 0.0)
            for name, (slope, deviation) in parts.items()
        ]
        return sorted(found, key=lambda each: -each.share)

    def linear(self, text: str) -> float:
        """Linear standard deviation of a summary."""
        return math.sqrt(sum((each.slope * each.deviation) ** 2 for each in self.shares(text)))

    def worst_case(self, text: str) -> float:
        """Σ |∂y/∂p|·t: the largest deviation if all tolerances are used up at once."""
        gradient = self.gradients.by_name(self.summaries[text].name)
        total = sum(abs(gradient[a]) * t.tolerance for a, t in self.study.deviating.items())
        for pin, pair in self.study.holes("free").items():
            total += math.hypot(*(gradient[a] for a in pair)) * self.study.clearances[pin].clearance
        return total

    def curve(self, output: str) -> tuple[Floats, Floats, Floats]:
        """Input (n,), nominal curve shifted by the pressed pins (n,), its linear standard deviation (n,)."""
        variance = np.zeros(len(self.derivatives.curve(output)))
        for address, tolerance in self.study.deviating.items():
            variance += (self.derivatives.slope(output, address) * tolerance.deviation) ** 2
        for pin, pair in self.study.holes("free").items():
            size = self.study.clearances[pin].clearance / math.sqrt(2)
            for address in pair:
                variance += (self.derivatives.slope(output, address) * size) ** 2
        moved = self.derivatives.curve(output) + self.pressed(output)
        return self.derivatives.input, moved, np.sqrt(variance)

    def pressed(self, output: str) -> Floats:
        """Change (n,) of an output by all pressed pins: of a position to first order; of rates and forces with the
        pins led over the cycle, NaN where they cannot follow. Zero where no pin is pressed."""
        count = len(self.derivatives.input)
        if not self.study.holes("pressed"):
            return np.zeros(count)
        if not is_position(self.study, output):
            return self.followed.curve(output) - self.derivatives.curve(output)
        return shifts(self.study, lambda address: self.derivatives.slope(output, address), self.forces)

    def shift(self, text: str) -> float:
        """Change of a summary by all pressed pins; NaN where rates and forces cannot follow."""
        summary = self.summaries[text]
        if not self.study.holes("pressed"):
            return 0.0
        curve = self.derivatives.curve(summary.output)
        moved, found = curve + self.pressed(summary.output), OF_VALUES[summary.kind]
        return float(found(moved) - found(curve)) if np.isfinite(moved).all() else math.nan

    # Monte Carlo ----------------------------------------------------------------------------------
    @cached_property
    def drawn(self) -> dict[str, Floats]:
        """Values (samples,) of everything that varies, by address in the prepared mechanism."""
        from scipy.stats import qmc

        free, nominal = self.study.holes("free"), self.study.prepared.dimensions()
        dimensions = len(self.study.deviating) + len(free)
        power = max(self.study.samples - 1, 1).bit_length()
        even = qmc.Sobol(max(dimensions, 1), seed=self.study.seed).random_base2(power)[: self.study.samples].T
        even = np.clip(even, 1e-12, 1 - 1e-12)
        found = {
            address: nominal[address] + tolerance.values(share)
            for (address, tolerance), share in zip(self.study.deviating.items(), even, strict=False)
        }
        for (pin, (x, y)), share in zip(free.items(), even[len(self.study.deviating) :], strict=False):
            size = self.study.clearances[pin].clearance
            for address, part in ((x, np.cos(2 * math.pi * share)), (y, np.sin(2 * math.pi * share))):
                found[address] = found.get(address, nominal[address]) + size * part
        return found

    @cached_property
    def swept(self) -> Sweep | None:
        """The drawn machines through the engine; None where nothing spreads or no summary is asked."""
        if not self.drawn or not self.summaries:
            return None
        asked = [summary.name for summary in self.summaries.values()]
        return sweep(self.study.prepared, self.drawn, outputs=asked)

    @cached_property
    def curves(self) -> dict[str, CurveSpread]:
        """Every curve among the drawn machines, shifted by the pressed pins; empty where nothing spreads."""
        if not self.drawn or not self.study.curves:
            return {}
        expected = {}
        for output in self.study.curves:
            expected[output] = self.derivatives.curve(output), self.curve(output)[2]
        found = curve_spreads(self.study.prepared, self.drawn, expected, self.study.steps, QUANTILES)
        return {output: spread.moved(self.pressed(output)) for output, spread in found.items()}

    def values(self, text: str) -> Floats:
        """A summary of the machines that pass the cycle, shifted by pressed pins, (machines,)."""
        if self.swept is None:
            return np.array([self.nominal(text) + self.shift(text)])
        summary, shift = self.summaries[text], self.shift(text)
        passing = self.swept[summary.name][self.swept.ok]
        return np.asarray(passing + (0.0 if math.isnan(shift) else shift))

    def monte_carlo(self, text: str) -> float:
        """Standard deviation of a summary among the machines."""
        values = self.values(text)
        return float(values.std(ddof=1)) if len(values) > 1 else 0.0

    @property
    def failed(self) -> int:
        """Machines that do not pass the cycle."""
        return 0 if self.swept is None else int((~self.swept.ok).sum())

    def ratio(self, text: str) -> float:
        """Monte Carlo over linear standard deviation; NaN where the linear one is zero."""
        linear = self.linear(text)
        return self.monte_carlo(text) / linear if linear else math.nan

    def passed(self, text: str) -> tuple[float, float, float, float]:
        """Yield: share of machines within the limits of a summary, ends of its 95 % interval (Clopper and Pearson),
        and the share of the linear normal distribution."""
        from scipy import stats

        limit = self.study.limits[text]
        values, count = self.values(text), max(len(self.values(text)) + self.failed, 1)
        good = int(((values >= limit.lower) & (values <= limit.upper)).sum())
        low = float(stats.beta.ppf(0.025, good, count - good + 1)) if good else 0.0
        high = float(stats.beta.ppf(0.975, good + 1, count - good)) if good < count else 1.0
        return good / count, low, high, self._normal(text, limit)

    def _normal(self, text: str, limit: Limit) -> float:
        from scipy import stats

        shift = self.shift(text)
        middle, sigma = self.nominal(text) + (0.0 if math.isnan(shift) else shift), self.linear(text)
        if not sigma:
            return float(limit.lower <= middle <= limit.upper)
        return float(stats.norm.cdf((limit.upper - middle) / sigma) - stats.norm.cdf((limit.lower - middle) / sigma))

    # why they differ ------------------------------------------------------------------------------
    @cached_property
    def closeness(self) -> tuple[float, float] | None:
        """Minimum closeness over the nominal cycle (0 at a dead point), and the input there; None if not known."""
        address = self.addresses[0]
        one = {address: np.array([self.study.prepared.dimension(address)])}
        asked = [("closeness", "min"), ("closeness", "argmin")]
        try:
            found = sweep(self.study.prepared, one, outputs=asked)
        except LinkwrightError:
            return None
        return float(found["closeness", "min"][0]), float(found["closeness", "argmin"][0])

    def bend(self, text: str) -> tuple[str, float]:
        """The largest contributor, and how much the summary bends over ±2σ of it: |y₊ + y₋ − 2y₀|/|y₊ − y₋|."""
        summary = self.summaries[text]
        deviations = {
            a: (t.deviation, abs(self.gradients.by_name(summary.name)[a]) * t.deviation)
            for a, t in self.study.deviating.items()
        }
        for pair in self.study.holes("free").values():
            for a in pair:
                size = self.study.clearances[a.split(".")[-2]].clearance / math.sqrt(2)
                deviations[a] = size, abs(self.gradients.by_name(summary.name)[a]) * size
        address = max(deviations, key=lambda a: deviations[a][1])
        at = self.study.prepared.dimension(address) + deviations[address][0] * np.array([-2.0, 0.0, 2.0])
        found = sweep(self.study.prepared, {address: at}, outputs=[summary.name])[summary.name]
        low, middle, high = found.tolist()
        change = abs(high - low)
        return self.study.written(address), abs(high + low - 2 * middle) / change if change else math.inf

    def reason(self, text: str, say: Translate) -> str:
        """Whether linear and Monte Carlo agree, and if not, why."""
        if self.swept is None or (self.failed == 0 and abs(self.ratio(text) - 1.0) <= AGREE):
            return (
                "" if self.swept is None else say(_("{name}: linear and Monte Carlo agree within 0.5 %.", name=text))
            )
        lines = []
        if abs(self.ratio(text) - 1.0) > AGREE or math.isnan(self.ratio(text)):
            lines.append(self._difference(text, say))
        close = self.closeness
        if close is not None and close[0] < NEAR:
            place = shown(close[1], "angle" if self.turning else "length", 4)
            lines.append(
                say(
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
                say(
                    _(
                        "{failed} of {count} machines do not pass the cycle; the numbers are of the others.",
                        failed=self.failed,
                        count=self.study.samples,
                    )
                )
            )
        return " ".join(lines)

    def _difference(self, text: str, say: Translate) -> str:
        """Why the two spreads differ: the bend b of y over ±2σ makes its spread 1 + b²/4 times as large; where that
        is far less than the difference, it is too few machines."""
        name, bend = self.bend(text)
        values = {"name": text, "ratio": f"{self.ratio(text):.4g}", "dimension": name}
        values["bend"] = f"{100 * bend:.3g} %" if math.isfinite(bend) else "—"
        if self.failed or not 0.25 * bend**2 < SMALL * abs(self.ratio(text) - 1.0):
            return say(
                _(
                    "{name}: Monte Carlo gives {ratio} times the linear spread, because the number is "
                    "not linear in the tolerances: over ±2σ of {dimension} it bends by {bend} of its "
                    "change."
                ).format(**values)
            )
        return say(
            _(
                "{name}: Monte Carlo gives {ratio} times the linear spread, and the number hardly "
                "bends over the tolerances ({bend} over ±2σ of {dimension}): {count} machines tell "
                "the spread no better; give more samples."
            ).format(count=len(self.values(text)), **values)
        )

    @property
    def turning(self) -> bool:
        """Whether the input is an angle."""
        from linkwright.kinematics.cycle import over_cycle

        return bool(next(iter(over_cycle(self.study.mechanism, 1).rotary.values()), True))

    # sentences ------------------------------------------------------------------------------------
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

    def blocks(self, say: Translate) -> list[Block]:
        found = [block for text in self.study.of for block in self._summary_blocks(text, say)]
        for output in self.study.curves:
            found.append(self._curve_block(output, say))
        return found

    def _summary_blocks(self, text: str, say: Translate) -> list[Block]:
        kind = self.dimension(text)
        rows = [Row("nominal", self.nominal(text), kind)]
        shift = self.shift(text)
        if self.study.holes("pressed"):
            gaps = int((~self.followed.followed).sum()) if math.isnan(shift) else 0
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
        found = [Block(text, text, rows, tuple(filter(None, [self.reason(text, say)])))]
        return (
            [*found, Block(f"{text}: contributions", _("Contributions to the variance"), parts)] if parts else found
        )

    def _pins_remark(self, output: str, say: Translate) -> tuple[str, ...]:
        """How near the pins lie to where their reactions press them, and where they cannot."""
        if not self.study.holes("pressed") or is_position(self.study, output):
            return ()
        settled = self.followed.followed
        off = float(self.followed.residual[settled].max()) if settled.any() else math.nan
        sentences = (
            [say(_("The pins lie within {off} of where their reactions press them.", off=shown(off, "angle", 2)))]
            if settled.any()
            else []
        )
        if not settled.all():
            sentences.append(
                say(
                    _(
                        "At {count} of {steps} positions a reaction jumps or turns faster than the pin can "
                        "follow in its hole: no value there.",
                        count=int((~settled).sum()),
                        steps=len(settled),
                    )
                )
            )
        return (" ".join(sentences),)

    def _curve_block(self, output: str, say: Translate) -> Block:
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
        return Block(f"curve {output}", _("Curve {name}", name=output), rows, self._pins_remark(output, say))

    def steps(self, say: Translate) -> list[Step]:
        found: list[Step] = []
        for text in self.study.of:
            kind, step = self.dimension(text), Step(str(len(found) + 1), text)
            step.say(say(_("σ² = Σ (∂y/∂p)²·σ_p², derivatives exact at the nominal mechanism (SI)")))
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
            reason = self.reason(text, say)
            if reason:
                step.say(reason)
            found.append(step)
        for pin in self.study.holes("pressed"):
            step = Step(str(len(found) + 1), say(_("Pin {pin} pressed by its own reaction", pin=pin)))
            step.law("r = c·F/|F|; Δy(φ) = c·(∂y/∂x·F_x + ∂y/∂y·F_y)/|F|")
            for text in self.study.of:
                shift = self.shift(text)
                if not math.isnan(shift):
                    step.put(f"Δ {text}", "", shift, self.dimension(text))
            found.append(step)
        return found or [Step("1", say(_("σ² = Σ (∂y/∂p)²·σ_p², derivatives exact at the nominal mechanism (SI)")))]
