"""Tests of hypotheses: one file for all, each a few lines over SciPy's distributions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats


@dataclass(frozen=True)
class Outcome:
    """A test's ``statistic`` (named ``symbol``), its degrees of ``freedom``, and the probability ``p`` of one as
    extreme if the hypothesis holds; ``formula`` of the statistic."""

    symbol: str
    statistic: float
    freedom: tuple[float, ...]
    p: float
    formula: str


@dataclass(frozen=True)
class Hypothesis:
    """A kind of test: how many samples it takes (None for two or more), the values each needs, its function."""

    samples: int | None
    min_values: int
    apply: Callable[[Sequence[Floats], float], Outcome]
    varies: bool = True


def _mean(samples: Sequence[Floats], value: float) -> Outcome:
    from scipy import stats

    x = samples[0]
    t = (float(x.mean()) - value) / (float(x.std(ddof=1)) / math.sqrt(len(x)))
    p = 2 * float(stats.t.sf(abs(t), len(x) - 1))
    return Outcome("t", t, (len(x) - 1.0,), p, "(x̄ − μ0)/(s/√n)")


def _two_means(samples: Sequence[Floats], _: float) -> Outcome:
    from scipy import stats

    a, b = samples
    u, v = (float(x.var(ddof=1)) / len(x) for x in (a, b))
    t = (float(a.mean()) - float(b.mean())) / math.sqrt(u + v)
    freedom = (u + v) ** 2 / (u**2 / (len(a) - 1) + v**2 / (len(b) - 1))
    return Outcome("t", t, (freedom,), 2 * float(stats.t.sf(abs(t), freedom)), "(x̄1 − x̄2)/√(s1²/n1 + s2²/n2)")


def _paired(samples: Sequence[Floats], _: float) -> Outcome:
    found = _mean([samples[0] - samples[1]], 0.0)
    return Outcome("t", found.statistic, found.freedom, found.p, "d̄/(s_d/√n)")


def _variance(samples: Sequence[Floats], value: float) -> Outcome:
    from scipy import stats

    x = samples[0]
    freedom = len(x) - 1
    statistic = freedom * float(x.var(ddof=1)) / value**2
    tail = min(float(stats.chi2.cdf(statistic, freedom)), float(stats.chi2.sf(statistic, freedom)))
    return Outcome("χ²", statistic, (float(freedom),), min(1.0, 2 * tail), "(n − 1)s²/σ0²")


def _two_variances(samples: Sequence[Floats], _: float) -> Outcome:
    from scipy import stats

    a, b = samples
    freedom = (len(a) - 1.0, len(b) - 1.0)
    ratio = float(a.var(ddof=1)) / float(b.var(ddof=1))
    tail = min(float(stats.f.cdf(ratio, *freedom)), float(stats.f.sf(ratio, *freedom)))
    return Outcome("F", ratio, freedom, min(1.0, 2 * tail), "s1²/s2²")


def _anova(samples: Sequence[Floats], _: float) -> Outcome:
    from scipy import stats

    everything = np.concatenate(samples)
    between = sum(len(x) * (float(x.mean()) - float(everything.mean())) ** 2 for x in samples)
    within = sum(float(((x - x.mean()) ** 2).sum()) for x in samples)
    freedom = (len(samples) - 1.0, float(len(everything) - len(samples)))
    ratio = between / freedom[0] / (within / freedom[1])
    return Outcome("F", ratio, freedom, float(stats.f.sf(ratio, *freedom)), "(SSb/(k − 1))/(SSw/(n − k))")


def _normality(samples: Sequence[Floats], _: float) -> Outcome:
    from scipy import stats

    found = stats.shapiro(samples[0])
    return Outcome("W", float(found.statistic), (), float(found.pvalue), "(Σ a_i·x_(i))²/Σ (x_i − x̄)²")


def _correlation(samples: Sequence[Floats], _: float) -> Outcome:
    from scipy import stats

    r = float(np.corrcoef(samples[0], samples[1])[0, 1])
    freedom = len(samples[0]) - 2
    p = 0.0 if abs(r) >= 1.0 else 2 * float(stats.t.sf(abs(r) * math.sqrt(freedom / (1 - r * r)), freedom))
    return Outcome("r", r, (float(freedom),), p, "Σ (x − x̄)(y − ȳ)/√(Σ (x − x̄)²·Σ (y − ȳ)²)")


#: Kinds of tests by name.
TESTS: Mapping[str, Hypothesis] = {
    "mean": Hypothesis(1, 2, _mean),
    "variance": Hypothesis(1, 2, _variance),
    "normality": Hypothesis(1, 3, _normality),
    "two_means": Hypothesis(2, 2, _two_means),
    "paired": Hypothesis(2, 2, _paired),
    "two_variances": Hypothesis(2, 2, _two_variances),
    "correlation": Hypothesis(2, 3, _correlation),
    "anova": Hypothesis(None, 2, _anova),
}
#: Tests against a given value.
AGAINST = ("mean", "variance")
#: Tests of samples whose values belong together one by one.
TOGETHER = ("paired", "correlation")
