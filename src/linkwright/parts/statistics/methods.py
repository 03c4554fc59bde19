"""Statistics of samples: description, intervals, distributions, regression, capability, tests of hypotheses."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats

#: Distributions that can be fitted: their names in SciPy, and the parameters that are held.
DISTRIBUTIONS: dict[str, tuple[str, dict[str, float]]] = {
    "normal": ("norm", {}),
    "lognormal": ("lognorm", {"floc": 0.0}),
    "weibull": ("weibull_min", {"floc": 0.0}),
    "exponential": ("expon", {"floc": 0.0}),
    "gamma": ("gamma", {"floc": 0.0}),
    "uniform": ("uniform", {}),
    "gumbel": ("gumbel_r", {}),
}
#: Distributions of positive values only.
POSITIVE = ("lognormal", "weibull", "exponential", "gamma")


@dataclass(frozen=True)
class Description:
    """Number, mean, standard deviation (n − 1), extremes, quartiles, skewness and excess kurtosis of a sample.

    ``deviation`` NaN for a single value; quartiles by linear interpolation (type 7 of Hyndman and Fan).
    """

    count: int
    mean: float
    deviation: float
    minimum: float
    quartiles: tuple[float, float, float]
    maximum: float
    skewness: float
    kurtosis: float


def described(values: Floats) -> Description:
    """The description of a sample."""
    n = len(values)
    centred = values - values.mean()
    spread = math.sqrt(float(centred @ centred) / (n - 1)) if n > 1 else math.nan
    second = float((centred**2).mean())
    third = float((centred**3).mean() / second**1.5) if second else math.nan
    fourth = float((centred**4).mean() / second**2 - 3.0) if second else math.nan
    low, middle, high = np.quantile(values, [0.25, 0.5, 0.75]).tolist()
    return Description(
        n, float(values.mean()), spread, float(values.min()), (low, middle, high), float(values.max()), third, fourth
    )


def mean_interval(values: Floats, confidence: float) -> tuple[float, float]:
    """Student's interval of the mean: x̄ ± t s/√n."""
    from scipy import stats

    d = described(values)
    half = float(stats.t.ppf(0.5 + confidence / 2, d.count - 1)) * d.deviation / math.sqrt(d.count)
    return d.mean - half, d.mean + half


def deviation_interval(values: Floats, confidence: float) -> tuple[float, float]:
    """Interval of σ of a normal distribution: s √((n − 1)/χ²)."""
    from scipy import stats

    d = described(values)
    ends = stats.chi2.ppf([0.5 + confidence / 2, 0.5 - confidence / 2], d.count - 1)
    low, high = (d.deviation * math.sqrt((d.count - 1) / float(end)) for end in ends)
    return low, high


@dataclass(frozen=True)
class Fit:
    """A distribution fitted by maximum likelihood: its parameters by name, Akaike's number, and the largest distance
    between its distribution function and the sample's (Kolmogorov)."""

    name: str
    parameters: dict[str, float]
    akaike: float
    distance: float
    values: tuple[float, ...]

    def density(self, x: Floats) -> Floats:
        """Probability density."""
        from scipy import stats

        return np.asarray(getattr(stats, DISTRIBUTIONS[self.name][0]).pdf(x, *self.values))


def fitted(values: Floats, name: str) -> Fit:
    """The distribution of a name fitted to a sample."""
    from scipy import stats

    scipy_name, held = DISTRIBUTIONS[name]
    family = getattr(stats, scipy_name)
    found = _weibull(values) if name == "weibull" else family.fit(values, **held)
    words = [*((family.shapes or "").split(", ") if family.shapes else []), "loc", "scale"]
    free = {w: float(v) for w, v in zip(words, found, strict=True) if f"f{w}" not in held}
    akaike = 2.0 * len(free) - 2.0 * float(family.logpdf(values, *found).sum())
    distance = float(stats.kstest(values, scipy_name, args=found).statistic)
    return Fit(name, _named(name, free), akaike, distance, tuple(float(v) for v in found))


def _weibull(values: Floats) -> tuple[float, float, float]:
    """Shape k, place 0 and scale of maximum likelihood: 1/k = Σ xᵏ ln x/Σ xᵏ − mean of ln x."""
    from scipy.optimize import brentq

    largest = float(values.max())
    logs = np.log(values / largest)

    def gap(k: float) -> float:
        powers = np.exp(k * logs)
        return float((powers * logs).sum() / powers.sum() - logs.mean() - 1.0 / k)

    low = high = 1.0 / float(logs.std())
    while gap(low) > 0:
        low /= 2
    while gap(high) < 0:
        high *= 2
    k = float(brentq(gap, low, high, xtol=1e-14 * high)) if low < high else low
    return k, 0.0, largest * float(np.exp(k * logs).mean()) ** (1 / k)


def _named(name: str, free: dict[str, float]) -> dict[str, float]:
    """Parameters under the names of textbooks."""
    match name:
        case "normal":
            return {"μ": free["loc"], "σ": free["scale"]}
        case "lognormal":
            return {"μ(ln)": math.log(free["scale"]), "σ(ln)": free["s"]}
        case "weibull":
            return {"shape": free["c"], "scale": free["scale"]}
        case "exponential":
            return {"mean": free["scale"]}
        case "gamma":
            return {"shape": free["a"], "scale": free["scale"]}
        case "uniform":
            return {"from": free["loc"], "to": free["loc"] + free["scale"]}
    return {"mode": free["loc"], "scale": free["scale"]}


@dataclass(frozen=True)
class Capability:
    """Process capability against limits: Cp = (U − L)/(6σ), Cpk = min(U − x̄, x̄ − L)/(3σ) (ISO 22514-2).

    ``within``: σ is that within subgroups (pooled), otherwise that of all values. ``cp`` None with one limit only.
    ``cp_interval`` (χ²), ``cpk_interval`` (Bissell's approximation); ``outside``: share of a normal process outside.
    """

    deviation: float
    within: bool
    cp: float | None
    cpk: float
    cp_interval: tuple[float, float] | None
    cpk_interval: tuple[float, float]
    outside: float


def capability(
    values: Floats, lower: float | None, upper: float | None, subgroup: int | None, confidence: float
) -> Capability:
    """Capability of a sample; ``subgroup``: size of successive subgroups."""
    from scipy import stats

    n, mean = len(values), float(values.mean())
    freedom = n - 1
    sigma = described(values).deviation
    if subgroup:
        groups = values[: n // subgroup * subgroup].reshape(-1, subgroup)
        sigma = math.sqrt(float(groups.var(axis=1, ddof=1).mean()))
        freedom = len(groups) * (subgroup - 1)
    distances = [upper - mean] if upper is not None else []
    distances += [mean - lower] if lower is not None else []
    cpk = min(distances) / (3 * sigma)
    half = float(stats.norm.ppf(0.5 + confidence / 2)) * math.sqrt(1 / (9 * n) + cpk**2 / (2 * freedom))
    cp, interval = None, None
    if lower is not None and upper is not None:
        cp = (upper - lower) / (6 * sigma)
        ends = stats.chi2.ppf([0.5 - confidence / 2, 0.5 + confidence / 2], freedom)
        interval = (cp * math.sqrt(float(ends[0]) / freedom), cp * math.sqrt(float(ends[1]) / freedom))
    outside = sum(float(stats.norm.sf(distance / sigma)) for distance in distances)
    return Capability(sigma, subgroup is not None, cp, cpk, interval, (cpk - half, cpk + half), outside)


@dataclass(frozen=True)
class Regression:
    """y = Σ b_j f_j(x): coefficients with standard errors, t and p of b_j = 0, intervals; R², residual deviation s.

    b = (FᵀF)⁻¹Fᵀy by QR; s² = Σ e²/(n − p); var b = s²(FᵀF)⁻¹ (Draper and Smith, Applied Regression Analysis).
    """

    terms: tuple[str, ...]
    coefficients: Floats
    errors: Floats
    t: Floats
    p: Floats
    low: Floats
    high: Floats
    determination: float
    deviation: float
    freedom: int
    fitted: Floats


def regression(y: Floats, columns: Floats, terms: tuple[str, ...], confidence: float) -> Regression | None:
    """The least squares of y (n,) on columns (n, p); None where the columns depend on each other."""
    from scipy import stats

    n, count = columns.shape
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0.0] = 1.0
    q, r = np.linalg.qr(columns / scale)
    if np.abs(np.diag(r)).min() < 1e-12 * np.abs(np.diag(r)).max():
        return None
    coefficients = np.linalg.solve(r, q.T @ y) / scale
    left = y - columns @ coefficients
    freedom = n - count
    variance = float(left @ left) / freedom
    errors = np.sqrt(variance * (np.linalg.inv(r) ** 2).sum(axis=1)) / scale
    centred = y - y.mean()
    total = float(centred @ centred)
    with np.errstate(all="ignore"):
        t = coefficients / errors
    half = float(stats.t.ppf(0.5 + confidence / 2, freedom)) * errors
    return Regression(
        terms,
        coefficients,
        errors,
        t,
        2 * stats.t.sf(np.abs(t), freedom),
        coefficients - half,
        coefficients + half,
        1.0 - float(left @ left) / total if total else 1.0,
        variance**0.5,
        freedom,
        columns @ coefficients,
    )


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
