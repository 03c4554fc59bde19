"""Samples of measurements: description, intervals, distributions, tests, regression, process capability."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.core.rows import Block, Row
from linkwright.core.table import PARTS_PER_MILLION, Scale, in_si
from linkwright.equations.reading import measured
from linkwright.equations.steps import Step, Value
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantity, Text, Word, file_key
from linkwright.fields.tables import Integer, Listed, Named, Table
from linkwright.parts.base import Problem, Result
from linkwright.parts.fields import AnyQuantity, Numbers, Sample
from linkwright.parts.statistics.describe import (
    DISTRIBUTIONS,
    POSITIVE,
    Capability,
    Description,
    Fit,
    Regression,
    capability,
    described,
    deviation_interval,
    fitted,
    mean_interval,
    regression,
)
from linkwright.parts.statistics.hypotheses import AGAINST, TESTS, TOGETHER, Outcome
from linkwright.words import Message, Translate, _, language_of, pgettext
from linkwright.words.sentence import in_language

#: A probability below this one counts as zero.
TINY = 1e-12
#: Values that a fitted distribution needs at least.
FIT_MINIMUM = 8
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


_NOT_PAIRED = _("the samples belong together value by value, but have different numbers ({counts})")


_TOO_FEW = _("the sample {sample} has {count} value(s), too few for {what}")


_CONSTANT = _("all values of {sample} are equal, so {what} has no answer")


@dataclass(frozen=True)
class TestSpec:
    """A test of ``kind`` ``of`` samples; ``value`` (SI) that the mean or deviation is compared with."""

    kind: str
    of: tuple[str, ...]
    value: float | None = None
    dimension: units.Dimension | None = None


@dataclass(frozen=True)
class Fitting:
    """The sample ``y`` as a polynomial of ``degree`` of one sample ``on``, or linear in several."""

    y: str = file_key(Text(doc="the sample that is explained"))
    on: tuple[str, ...] = file_key(Listed(Text(), "[x]", doc="the samples that explain it"))
    degree: int = file_key(Integer(1, doc="degree of the polynomial of one sample; default: 1"), 1)


@dataclass(frozen=True)
class Limits:
    """``lower`` and ``upper`` limit (SI) of a sample; ``subgroup``: size of successive subgroups."""

    lower: float | None = None
    upper: float | None = None
    subgroup: int | None = None


def _asked(kind: str, of: tuple[str, ...], value: Any = None) -> TestSpec:
    return TestSpec(kind, of, *(value or ()))


def _limits(lower: Any = None, upper: Any = None, subgroup: int | None = None) -> Limits:
    return Limits(lower and lower[0], upper and upper[0], subgroup)


OF = Listed(Text(), "[a, b]", required=True, doc="names of the samples")
TEST_FIELDS = {
    "kind": Word(tuple(TESTS), required=True, doc=", ".join(TESTS)),
    "of": OF,
    "value": AnyQuantity(doc="mean, or standard deviation, that is compared with"),
}
LIMIT_FIELDS = {
    "lower": AnyQuantity(doc="lower limit"),
    "upper": AnyQuantity(doc="upper limit"),
    "subgroup": Integer(2, doc="size of successive subgroups, for the deviation within them"),
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
        Named(Table(TEST_FIELDS, _asked), _("test"), doc="tests by name: {kind: mean, of: [a], value: 20 mm}"), dict
    )
    regressions: Mapping[str, Fitting] = file_key(
        Named(Table.of(Fitting), _("regression"), doc="regressions by name: {y: force, on: [speed], degree: 2}"), dict
    )
    capability: Mapping[str, Limits] = file_key(
        Named(
            Table(LIMIT_FIELDS, _limits),
            _("sample"),
            doc="limits by sample: {lower: 19.9 mm, upper: 20.1 mm, subgroup: 5}",
        ),
        dict,
    )
    name: str = ""
    source: str = ""

    def values(self, name: str) -> Floats:
        """A sample, SI."""
        return np.array(self.samples[name].values)

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
            found += self._test_findings(f"tests.{name}", test)
        for name, fitting in self.regressions.items():
            found += self._regression_findings(f"regressions.{name}", fitting)
        for name, limits in self.capability.items():
            found += self._limit_findings(f"capability.{name}", name, limits)
        for word in self.fit:
            found += self._fit_findings(word)
        return found

    def _unknown(self, key: str, names: tuple[str, ...]) -> list[Finding]:
        return [
            fault(
                "no_sample",
                key,
                _('there is no sample "{name}"'),
                _("one of: {known}"),
                name=name,
                known=tuple(self.samples),
            )
            for name in names
            if name not in self.samples
        ]

    def _small(self, key: str, names: tuple[str, ...], what: str, minimum: int) -> list[Finding]:
        """A finding for every sample that is too small, or that does not vary."""
        found = []
        for name in names:
            values = self.values(name)
            if len(values) < minimum:
                found.append(
                    fault(
                        "too_small",
                        key,
                        _TOO_FEW,
                        _("give at least {minimum}"),
                        sample=name,
                        count=len(values),
                        what=what,
                        minimum=minimum,
                    )
                )
            elif np.ptp(values) == 0.0:
                found.append(
                    fault("constant", key, _CONSTANT, _("measure finer, or leave it out"), sample=name, what=what)
                )
        return found

    def _test_findings(self, key: str, test: TestSpec) -> list[Finding]:
        kind = TESTS[test.kind]
        found = self._unknown(f"{key}.of", test.of)
        wanted = kind.samples or 2
        if len(test.of) != wanted if kind.samples else len(test.of) < 2:
            found.append(
                fault(
                    "sample_count",
                    f"{key}.of",
                    _("{what} needs {wanted} sample(s); {count} are named"),
                    _("name as many under of"),
                    what=test.kind,
                    wanted=wanted,
                    count=len(test.of),
                )
            )
        if (test.kind in AGAINST) != (test.value is not None):
            found.append(
                fault(
                    "value_needed",
                    key,
                    _("{what} needs a value to compare with"),
                    _("give value: such as 20 mm"),
                    what=test.kind,
                )
                if test.kind in AGAINST
                else fault(
                    "value_useless", key, _("{what} compares with no value"), _("leave value out"), what=test.kind
                )
            )
        if found:
            return found
        found = self._small(key, test.of, test.kind, kind.min_values)
        kinds = {self.samples[n].dimension for n in test.of} | ({test.dimension} if test.dimension else set())
        if test.kind != "correlation" and len(kinds) > 1:
            found.append(
                fault(
                    "kinds_differ",
                    key,
                    _("lengths cannot be compared with forces: the samples or the value differ in kind"),
                    _("compare values of one kind"),
                )
            )
        if test.kind in TOGETHER and len({len(self.values(n)) for n in test.of}) > 1:
            found.append(
                fault(
                    "not_paired",
                    key,
                    _NOT_PAIRED,
                    _("give as many values in each"),
                    counts=" : ".join(str(len(self.values(n))) for n in test.of),
                )
            )
        if test.kind == "variance" and test.value is not None and test.value <= 0:
            found.append(
                fault(
                    "deviation_above_zero",
                    f"{key}.value",
                    _("the standard deviation to compare with must be above zero"),
                    _("give a value above zero"),
                )
            )
        if test.kind == "paired" and not found and np.ptp(self.values(test.of[0]) - self.values(test.of[1])) == 0.0:
            found.append(
                fault(
                    "constant",
                    key,
                    _CONSTANT,
                    _("measure finer, or leave it out"),
                    sample=f"{test.of[0]} − {test.of[1]}",
                    what=test.kind,
                )
            )
        return found

    def _regression_findings(self, key: str, fitting: Fitting) -> list[Finding]:
        found = self._unknown(key, (fitting.y, *fitting.on))
        if found:
            return found
        if fitting.degree > 1 and len(fitting.on) > 1:
            return [
                fault(
                    "degree_of_one",
                    f"{key}.degree",
                    _("a degree above 1 is for one explaining sample"),
                    _("name one sample under on, or leave degree out"),
                )
            ]
        counts = {len(self.values(n)) for n in (fitting.y, *fitting.on)}
        if len(counts) > 1:
            return [
                fault(
                    "not_paired",
                    key,
                    _NOT_PAIRED,
                    _("give as many values in each"),
                    counts=" : ".join(map(str, sorted(counts))),
                )
            ]
        minimum = len(self.columns_of(fitting)[1]) + 1
        if min(counts) < minimum:
            return [
                fault(
                    "too_small",
                    key,
                    _TOO_FEW,
                    _("give at least {minimum}"),
                    sample=fitting.y,
                    count=min(counts),
                    what="regression",
                    minimum=minimum,
                )
            ]
        return (
            []
            if self.regress(fitting)
            else [
                fault(
                    "dependent",
                    f"{key}.on",
                    _("the explaining samples depend on each other or do not vary"),
                    pgettext("statistics", "leave one of them out"),
                )
            ]
        )

    def _limit_findings(self, key: str, name: str, limits: Limits) -> list[Finding]:
        found = self._unknown(key, (name,))
        if found:
            return found
        if limits.lower is None and limits.upper is None:
            return [fault("no_limits", key, _("there is no limit"), _("give lower, upper or both"))]
        if limits.lower is not None and limits.upper is not None and limits.upper <= limits.lower:
            return [
                fault(
                    "limits_order",
                    key,
                    _("the upper limit is not above the lower one"),
                    _("give the larger value as upper"),
                )
            ]
        return self._small(key, (name,), "capability", 2 * (limits.subgroup or 1))

    def _fit_findings(self, word: str) -> list[Finding]:
        found = self._small("fit", tuple(self.samples), word, FIT_MINIMUM)
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

    def columns_of(self, fitting: Fitting) -> tuple[Floats, tuple[str, ...]]:
        """The columns (n, p) of a regression and their names."""
        first = [np.ones(len(self.values(fitting.y)))]
        if len(fitting.on) == 1:
            x = self.values(fitting.on[0])
            powers = range(1, fitting.degree + 1)
            names = [fitting.on[0] if p == 1 else f"{fitting.on[0]}^{p}" for p in powers]
            return np.stack([*first, *(x**p for p in powers)], axis=1), ("1", *names)
        return np.stack([*first, *(self.values(n) for n in fitting.on)], axis=1), ("1", *fitting.on)

    def dimensions_of(self, fitting: Fitting) -> list[units.Dimension]:
        """The dimensions of its coefficients: of y, then of y over each column."""
        y, xs = self.samples[fitting.y].dimension, [self.samples[name].dimension for name in fitting.on]
        powers = [(xs[0], p) for p in range(1, fitting.degree + 1)] if len(xs) == 1 else [(x, 1) for x in xs]
        return [y, *(units.times(y, x, -power) for x, power in powers)]

    def regress(self, fitting: Fitting) -> Regression | None:
        """The least squares; None where the columns depend on each other."""
        columns, terms = self.columns_of(fitting)
        return regression(self.values(fitting.y), columns, terms, self.confidence)

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
        found = {name: self.problem.regress(fitting) for name, fitting in self.problem.regressions.items()}
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

    def blocks(self, say: Translate) -> list[Block]:
        found = [self._described(name, say) for name in self.problem.samples]
        found += [
            Block(
                f"fit.{name}",
                _("Distributions of {name}, best first (Akaike's number)", name=name),
                self._fit_rows(name, say),
            )
            for name in self.problem.samples
            if self.problem.fit
        ]
        if self.tests:
            rows = [row for name in self.tests for row in self._test_rows(name, say)]
            found.append(Block("tests", _("Tests"), rows))
        found += [self._regressed(name, say) for name in self.regressions]
        found += [self._capable(name, say) for name in self.capabilities]
        return found

    def _described(self, name: str, say: Translate) -> Block:
        d, scale = self.descriptions[name], self.scale(name)
        rows = [Row("count", float(d.count)), Row("mean", d.mean, scale=scale)]
        if d.count > 1:
            rows.append(Row("deviation", d.deviation, scale=scale))
            level = f"{100 * self.problem.confidence:g} %"
            for key, interval in (("mean", mean_interval), ("deviation", deviation_interval)):
                low, high = interval(self.problem.values(name), self.problem.confidence)
                label = say(INTERVALS[key].format(level=level))
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

    def _fit_rows(self, name: str, say: Translate) -> list[Row]:
        rows = []
        for fit in self.fits[name]:
            factor = self.scale(name).factor
            note = ", ".join(f"{k} = {number(_in_units(k, v, factor))}" for k, v in fit.parameters.items())
            distance = say(
                _("largest distance of the distribution functions {distance}", distance=f"{fit.distance:.4f}")
            )
            rows.append(Row(fit.name, fit.akaike, "", DISTRIBUTION_NAMES[fit.name], f"{note}; {distance}"))
        return rows

    def _test_rows(self, name: str, say: Translate) -> list[Row]:
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

    def _regressed(self, name: str, say: Translate) -> Block:
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

    def _capable(self, name: str, say: Translate) -> Block:
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

    def steps(self, say: Translate) -> list[Step]:
        found: list[Step] = []
        for name, d in self.descriptions.items():
            step = Step(str(len(found) + 1), say(_("Sample {name}", name=name)))
            step.law(f"n = {d.count}")
            step.law(f"x̄ = Σ x/n = {self._measured(name, d.mean)}")
            if d.count > 1:
                step.law(f"s = √(Σ (x − x̄)²/(n − 1)) = {self._measured(name, d.deviation)}")
                ends = mean_interval(self.problem.values(name), self.problem.confidence)
                step.law(f"x̄ ± t·s/√(n) = {measured(self._interval(name, ends))}")
            found.append(step)
        for name, outcome in self.tests.items():
            step = Step(str(len(found) + 1), f"{name}: {say(HYPOTHESES[self.problem.tests[name].kind])}")
            step.put(outcome.symbol, outcome.formula, outcome.statistic)
            step.law(f"p {_probability(outcome.p)}")
            step.say(in_language(self._test_rows(name, say)[1].note, language_of(say)))
            found.append(step)
        for name, r in self.regressions.items():
            step = Step(
                str(len(found) + 1), say(_("Regression {name} of {y}", name=name, y=self.problem.regressions[name].y))
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
            step = Step(str(len(found) + 1), say(_("Capability of {name}", name=name)))
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
