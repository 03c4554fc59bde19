"""Samples of measurements: description, intervals, distributions, tests, regression, process capability."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.core.table import PARTS_PER_MILLION, Block, Row, Scale, in_si
from linkwright.equations.reading import measured
from linkwright.equations.steps import Step, Value
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantity, Word, file_key
from linkwright.fields.tables import Listed, Named, Table
from linkwright.parts.base import Problem, Result
from linkwright.parts.fields import Numbers, Sample
from linkwright.parts.statistics.methods import (
    DISTRIBUTIONS,
    POSITIVE,
    TESTS,
    Capability,
    Description,
    Fit,
    Outcome,
    Regression,
    capability,
    described,
    deviation_interval,
    fitted,
    mean_interval,
)
from linkwright.parts.statistics.specs import (
    FIT_MINIMUM,
    LIMITS,
    TEST,
    Fitting,
    Limits,
    TestSpec,
    too_small,
    values_of,
)
from linkwright.words import Message, Translate, _, language_of, pgettext
from linkwright.words.message import in_language

#: A probability below this one counts as zero.
TINY = 1e-12
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "count": _("number n"),
    "mean": _("mean x̄"),
    "least": pgettext("statistics", "least"),
    "median": _("median"),
    "quartiles": _("quartiles"),
    "largest": pgettext("statistics", "largest"),
    "determination": _("determination R²"),
    "residual": _("residual deviation s"),
    "sigma": _("σ"),
    "deviation": _("standard deviation s"),
    "skewness": _("skewness"),
    "kurtosis": _("excess kurtosis"),
}
#: Intervals, distributions and hypotheses in words.
INTERVALS = {"mean": _("interval of the mean, {level}"), "deviation": _("interval of σ, {level}")}
DISTRIBUTION_NAMES = {
    "normal": _("normal"),
    "lognormal": _("lognormal"),
    "weibull": _("Weibull"),
    "exponential": _("exponential"),
    "uniform": _("uniform"),
    "gamma": _("gamma"),
    "gumbel": _("Gumbel"),
}
HYPOTHESES = {
    "mean": _("the mean is the given value"),
    "variance": _("the standard deviation is the given value"),
    "normality": _("the values are normal"),
    "two_means": _("both means are equal"),
    "paired": _("the pairs differ by nothing on average"),
    "two_variances": _("both variances are equal"),
    "correlation": _("the samples are not correlated"),
    "anova": _("all means are equal"),
}


@dataclass(frozen=True)
class Samples(Problem):
    """Samples by name (SI with the unit in which they were given) and what is asked about them."""

    kind: ClassVar[str] = "statistics"
    samples: Mapping[str, Numbers] = file_key(
        Named(Sample(), _("sample"), doc="samples by name: {unit: mm, values: [20.1, 19.9]}, or [20.1 mm, 19.9 mm]")
    )
    confidence: float = file_key(
        Quantity("dimensionless", above=0.0, doc="level of intervals and tests; default: 0.95"), 0.95
    )
    fit: tuple[str, ...] = file_key(
        Listed(Word(tuple(DISTRIBUTIONS)), "[normal, weibull]", doc=f"any of {', '.join(DISTRIBUTIONS)}"), ()
    )
    tests: Mapping[str, TestSpec] = file_key(
        Named(TEST, _("test"), doc="tests by name: {kind: mean, of: [a], value: 20 mm}"), dict
    )
    regressions: Mapping[str, Fitting] = file_key(
        Named(Table.of(Fitting), _("regression"), doc="regressions by name: {y: force, on: [speed], degree: 2}"), dict
    )
    capability: Mapping[str, Limits] = file_key(
        Named(LIMITS, _("sample"), doc="limits by sample: {lower: 19.9 mm, upper: 20.1 mm, subgroup: 5}"), dict
    )
    name: str = ""
    source: str = ""

    def values(self, name: str) -> Floats:
        """A sample, SI."""
        return values_of(self.samples, name)

    def findings(self) -> list[Finding]:
        found = [
            fault("empty", f"samples.{n}", _("the sample is empty"), _("give at least one value"))
            for n, s in self.samples.items()
            if not s.values
        ]
        if not 0.0 < self.confidence < 1.0:
            found.append(
                fault("confidence", "confidence", _("a confidence must lie between 0 and 1"), _("write 0.95"))
            )
        for name, test in self.tests.items():
            found += test.findings(f"tests.{name}", self.samples)
        for name, fitting in self.regressions.items():
            found += fitting.findings(f"regressions.{name}", self.samples)
        for name, limits in self.capability.items():
            found += limits.findings(f"capability.{name}", name, self.samples)
        for word in self.fit:
            found += self._fit_findings(word)
        return found

    def _fit_findings(self, word: str) -> list[Finding]:
        found = too_small("fit", tuple(self.samples), word, FIT_MINIMUM, self.samples)
        found += [
            fault(
                "not_positive",
                "fit",
                _("{what} is for positive values, but {sample} has zero or negative ones"),
                _("leave this distribution out"),
                sample=n,
                what=word,
            )
            for n in self.samples
            if word in POSITIVE and len(self.values(n)) and self.values(n).min() <= 0
        ]
        return found

    def dimensions_of(self, fitting: Fitting) -> list[units.Dimension]:
        """The dimensions of its coefficients: of y, then of y over each column."""
        y, xs = self.samples[fitting.y].dimension, [self.samples[name].dimension for name in fitting.on]
        powers = [(xs[0], p) for p in range(1, fitting.degree + 1)] if len(xs) == 1 else [(x, 1) for x in xs]
        return [y, *(units.times(y, x, -power) for x, power in powers)]

    def solve(self) -> Statistics:
        """All that is asked. Raises ModelError with all findings."""
        self.require()
        return Statistics(self)


@dataclass(frozen=True, repr=False)
class Statistics(Result):
    """Descriptions, fits, outcomes of tests, regressions and capabilities by name; SI."""

    labels: ClassVar[Mapping[str, Message]] = LABELS
    problem: Samples

    @cached_property
    def descriptions(self) -> dict[str, Description]:
        """By sample."""
        return {name: described(self.problem.values(name)) for name in self.problem.samples}

    @cached_property
    def fits(self) -> dict[str, list[Fit]]:
        """By sample, the best by Akaike's number first."""
        return {
            name: sorted((fitted(self.problem.values(name), f) for f in self.problem.fit), key=lambda fit: fit.akaike)
            for name in self.problem.samples
        }

    @cached_property
    def tests(self) -> dict[str, Outcome]:
        """By test."""
        return {
            name: TESTS[test.kind].apply([self.problem.values(n) for n in test.of], test.value or 0.0)
            for name, test in self.problem.tests.items()
        }

    @cached_property
    def regressions(self) -> dict[str, Regression]:
        """By regression."""
        found = {
            name: fitting.regress(self.problem.samples, self.problem.confidence)
            for name, fitting in self.problem.regressions.items()
        }
        return {name: each for name, each in found.items() if each is not None}

    @cached_property
    def capabilities(self) -> dict[str, Capability]:
        """By sample."""
        return {
            name: capability(self.problem.values(name), own.lower, own.upper, own.subgroup, self.problem.confidence)
            for name, own in self.problem.capability.items()
        }

    def scale(self, name: str) -> Scale:
        """The unit of a sample."""
        own = self.problem.samples[name]
        si = in_si(own.dimension)
        return Scale(own.unit, own.factor, si.unit) if own.unit else si

    def _in_unit(self, name: str, value: float) -> str:
        return f"{value / self.scale(name).factor:.6g}"

    def blocks(self, translate: Translate) -> list[Block]:
        found = [self._described(name, translate) for name in self.problem.samples]
        found += [
            Block(
                f"fit.{name}",
                _("Distributions of {name}, best first (Akaike's number)", name=name),
                self._fit_rows(name, translate),
            )
            for name in self.problem.samples
            if self.problem.fit
        ]
        if self.tests:
            rows = [row for name in self.tests for row in self._test_rows(name, translate)]
            found.append(Block("tests", _("Tests"), rows))
        found += [self._regressed(name, translate) for name in self.regressions]
        found += [self._capable(name, translate) for name in self.capabilities]
        return found

    def _described(self, name: str, translate: Translate) -> Block:
        d, scale = self.descriptions[name], self.scale(name)
        rows = [Row("count", float(d.count)), Row("mean", d.mean, scale=scale)]
        if d.count > 1:
            rows.append(Row("deviation", d.deviation, scale=scale))
            level = f"{100 * self.problem.confidence:g} %"
            for key, interval in (("mean", mean_interval), ("deviation", deviation_interval)):
                low, high = interval(self.problem.values(name), self.problem.confidence)
                label = translate(INTERVALS[key].format(level=level))
                rows.append(Row(f"{key}_interval", low, label=label, scale=scale, end=high))
        rows += [Row("least", d.minimum, scale=scale), Row("median", d.quartiles[1], scale=scale)]
        rows.append(Row("quartiles", d.quartiles[0], scale=scale, end=d.quartiles[2]))
        rows.append(Row("largest", d.maximum, scale=scale))
        if d.count > 2 and d.minimum < d.maximum:
            rows += [Row("skewness", d.skewness), Row("kurtosis", d.kurtosis)]
        return Block(f"sample.{name}", _("Sample {name}", name=name), rows)

    def _measured(self, name: str, value: float) -> str:
        """A value of a sample in its own unit, as one sign of a formula."""
        return measured(f"{self._in_unit(name, value)} {self.scale(name).unit}".rstrip())

    def _limits_of(self, name: str) -> dict[str, Value]:
        """Limits, mean and deviation of a capability, in the unit of the sample."""
        own, c, factor = self.problem.capability[name], self.capabilities[name], self.scale(name).factor
        values = {"U": own.upper, "L": own.lower, "x̄": self.descriptions[name].mean, "σ": c.deviation}
        return {key: value / factor for key, value in values.items() if value is not None}

    def _nearest(self, name: str) -> str:
        """Formula of the capability towards the nearer limit."""
        own = self.problem.capability[name]
        if own.lower is None:
            return "(U − x̄)/(3·σ)"
        return "(x̄ − L)/(3·σ)" if own.upper is None else "min(U − x̄, x̄ − L)/(3·σ)"

    def _scales(self, fitting: Fitting) -> list[Scale]:
        """Units of the coefficients of a regression by those of its samples: of y, then of y over each column."""
        y, xs = self.scale(fitting.y), [self.scale(name) for name in fitting.on]
        powers = [(xs[0], p) for p in range(1, fitting.degree + 1)] if len(xs) == 1 else [(x, 1) for x in xs]
        kinds = self.problem.dimensions_of(fitting)[1:]
        return [y, *(_over(y, x, power, in_si(kind)) for (x, power), kind in zip(powers, kinds, strict=True))]

    def _interval(self, name: str, ends: tuple[float, float]) -> str:
        unit = self.scale(name).unit
        return f"{self._in_unit(name, ends[0])} … {self._in_unit(name, ends[1])} {unit}".rstrip()

    def _fit_rows(self, name: str, translate: Translate) -> list[Row]:
        rows = []
        for fit in self.fits[name]:
            factor = self.scale(name).factor
            note = ", ".join(f"{k} = {number(_in_units(k, v, factor))}" for k, v in fit.parameters.items())
            distance = translate(
                _("largest distance of the distribution functions {distance}", distance=f"{fit.distance:.4f}")
            )
            rows.append(Row(fit.name, fit.akaike, "", DISTRIBUTION_NAMES[fit.name], f"{note}; {distance}"))
        return rows

    def _test_rows(self, name: str, translate: Translate) -> list[Row]:
        outcome, test = self.tests[name], self.problem.tests[name]
        freedom = f"({', '.join(number(f) for f in outcome.freedom)})" if outcome.freedom else ""
        rejected = outcome.p < 1.0 - self.problem.confidence
        hypothesis = HYPOTHESES[test.kind]
        verdict = (_("rejected: {hypothesis}") if rejected else _("not rejected: {hypothesis}")).format(
            hypothesis=hypothesis
        )
        return [
            Row(f"{name}.{outcome.symbol}", outcome.statistic, "", f"{name}: {outcome.symbol}{freedom}"),
            Row(f"{name}.p", outcome.p, "", f"  {name}: p", verdict, text="" if outcome.p >= TINY else f"< {TINY:g}"),
        ]

    def _regressed(self, name: str, translate: Translate) -> Block:
        r, rows = self.regressions[name], []
        scales = self._scales(self.problem.regressions[name])
        for i, (term, scale) in enumerate(zip(r.terms, scales, strict=True)):
            error, low, high = (number(float(each[i]) / scale.factor) for each in (r.errors, r.low, r.high))
            p = _probability(float(r.p[i]))
            note = _("± {error}; {low} … {high}; p {p}", error=error, low=low, high=high, p=p)
            rows.append(Row(f"b_{term}", float(r.coefficients[i]), "", f"b({term})", note, scale))
        rows += [Row("determination", r.determination), Row("residual", r.deviation, scale=scales[0])]
        y = self.problem.regressions[name].y
        return Block(f"regression.{name}", _("Regression {name} of {y}", name=name, y=y), rows)

    def _capable(self, name: str, translate: Translate) -> Block:
        c, rows = self.capabilities[name], []
        mark = "C" if c.within else "P"
        if c.cp is not None and c.cp_interval is not None:
            rows.append(Row("cp", c.cp, "", f"{mark}p", f"{c.cp_interval[0]:.4g} … {c.cp_interval[1]:.4g}"))
        rows.append(Row("cpk", c.cpk, "", f"{mark}pk", f"{c.cpk_interval[0]:.4g} … {c.cpk_interval[1]:.4g}"))
        rows.append(Row("sigma", c.deviation, scale=self.scale(name)))
        rows.append(Row("outside", c.outside, label=_("outside the limits"), scale=PARTS_PER_MILLION))
        remark = (
            _("σ from within the subgroups (Cp, Cpk); share outside for a normal process.")
            if c.within
            else _("σ from all values (Pp, Ppk); share outside for a normal process.")
        )
        return Block(f"capability.{name}", _("Capability of {name}", name=name), rows, (remark,))

    def steps(self, translate: Translate) -> list[Step]:
        found: list[Step] = []
        for name, d in self.descriptions.items():
            step = Step(str(len(found) + 1), translate(_("Sample {name}", name=name)))
            step.law(f"n = {d.count}")
            step.law(f"x̄ = Σ x/n = {self._measured(name, d.mean)}")
            if d.count > 1:
                step.law(f"s = √(Σ (x − x̄)²/(n − 1)) = {self._measured(name, d.deviation)}")
                ends = mean_interval(self.problem.values(name), self.problem.confidence)
                step.law(f"x̄ ± t·s/√(n) = {measured(self._interval(name, ends))}")
            found.append(step)
        for name, outcome in self.tests.items():
            step = Step(str(len(found) + 1), f"{name}: {translate(HYPOTHESES[self.problem.tests[name].kind])}")
            step.put(outcome.symbol, outcome.formula, outcome.statistic)
            step.law(f"p {_probability(outcome.p)}")
            step.note(in_language(self._test_rows(name, translate)[1].note, language_of(translate)))
            found.append(step)
        for name, r in self.regressions.items():
            step = Step(
                str(len(found) + 1),
                translate(_("Regression {name} of {y}", name=name, y=self.problem.regressions[name].y)),
            )
            step.law("b = (Fᵀ·F)⁻¹·Fᵀ·y; s² = Σ e²/(n − p)")
            scales = self._scales(self.problem.regressions[name])
            for term, value, scale in zip(r.terms, r.coefficients, scales, strict=True):
                value, text = float(value) / scale.factor, scale.unit
                symbol = "b_0" if term == "1" else f"b_{term.replace('^', '')}"
                step.law(f"{symbol} = {measured(f'{value:.6g} {text}'.rstrip())}")
            step.put("R²", "1 − Σ e²/Σ (y − ȳ)²", r.determination)
            found.append(step)
        for name, c in self.capabilities.items():
            step = Step(str(len(found) + 1), translate(_("Capability of {name}", name=name)))
            mark = "C" if c.within else "P"
            if c.cp is not None:
                step.put(f"{mark}p", "(U − L)/(6·σ)", c.cp, of=self._limits_of(name), digits=8)
            step.put(f"{mark}pk", self._nearest(name), c.cpk, of=self._limits_of(name), digits=8)
            found.append(step)
        return found


def _probability(p: float) -> str:
    """``= 0.0123``, or ``< 1e-12`` of what is smaller than its rounding."""
    return f"= {number(p, digits=3)}" if p >= TINY else f"< {TINY:g}"


def _over(y: Scale, x: Scale, power: int, si: Scale) -> Scale:
    """The unit of y over a power of that of x: ``N/mm``, ``N/mm²``."""
    if not x.unit:
        return Scale(y.unit, y.factor / x.factor**power, si.si)
    raised = x.unit + ("" if power == 1 else "⁰¹²³⁴⁵⁶⁷⁸⁹"[power] if power < 10 else f"^{power}")
    below = f"({x.unit}){raised[len(x.unit) :]}" if set(x.unit) & set("·/") else raised
    return Scale(f"{y.unit or '1'}/{below}", y.factor / x.factor**power, si.si)


def _in_units(parameter: str, value: float, factor: float) -> float:
    """A parameter of a distribution for values in a unit of ``factor`` in SI."""
    if parameter == "μ(ln)":
        return value - math.log(factor)
    return value if parameter in ("shape", "σ(ln)") else value / factor
