"""What may be asked about samples: tests of hypotheses, regressions, limits; each finds what is wrong with itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright import units
from linkwright.core.arrays import Floats
from linkwright.errors import Finding, fault
from linkwright.fields.base import Text, Word, file_key
from linkwright.fields.tables import Integer, Listed, Table
from linkwright.parts.fields import AnyQuantity, Numbers
from linkwright.parts.statistics.methods import AGAINST, TESTS, TOGETHER, Regression, regression
from linkwright.words import _, pgettext

#: Values that a fitted distribution needs at least.
FIT_MINIMUM = 8
_NOT_PAIRED = _("the samples belong together value by value, but have different numbers ({counts})")
_TOO_FEW = _("the sample {sample} has {count} value(s), too few for {what}")
_CONSTANT = _("all values of {sample} are equal, so {what} has no answer")


def values_of(samples: Mapping[str, Numbers], name: str) -> Floats:
    """A sample, SI."""
    return np.array(samples[name].values)


def unknown(key: str, names: tuple[str, ...], samples: Mapping[str, Numbers]) -> list[Finding]:
    """A finding for every name that is no sample."""
    return [
        fault(
            "no_sample", key, _('there is no sample "{name}"'), _("one of: {known}"), name=name, known=tuple(samples)
        )
        for name in names
        if name not in samples
    ]


def too_small(
    key: str, names: tuple[str, ...], what: str, minimum: int, samples: Mapping[str, Numbers]
) -> list[Finding]:
    """A finding for every sample that is too small, or that does not vary."""
    found = []
    for name in names:
        values = values_of(samples, name)
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


@dataclass(frozen=True)
class TestSpec:
    """A test of ``kind`` ``of`` samples; ``value`` (SI) that the mean or deviation is compared with."""

    kind: str
    of: tuple[str, ...]
    value: float | None = None
    dimension: units.Dimension | None = None

    def findings(self, key: str, samples: Mapping[str, Numbers]) -> list[Finding]:
        """What is wrong with it, for these samples."""
        kind = TESTS[self.kind]
        found = unknown(f"{key}.of", self.of, samples)
        wanted = kind.samples or 2
        if len(self.of) != wanted if kind.samples else len(self.of) < 2:
            found.append(
                fault(
                    "sample_count",
                    f"{key}.of",
                    _("{what} needs {wanted} sample(s); {count} are named"),
                    _("name as many under of"),
                    what=self.kind,
                    wanted=wanted,
                    count=len(self.of),
                )
            )
        if (self.kind in AGAINST) != (self.value is not None):
            found.append(
                fault(
                    "value_needed",
                    key,
                    _("{what} needs a value to compare with"),
                    _("give value: such as 20 mm"),
                    what=self.kind,
                )
                if self.kind in AGAINST
                else fault(
                    "value_useless", key, _("{what} compares with no value"), _("leave value out"), what=self.kind
                )
            )
        if found:
            return found
        found = too_small(key, self.of, self.kind, kind.min_values, samples)
        kinds = {samples[n].dimension for n in self.of} | ({self.dimension} if self.dimension else set())
        if self.kind != "correlation" and len(kinds) > 1:
            found.append(
                fault(
                    "kinds_differ",
                    key,
                    _("lengths cannot be compared with forces: the samples or the value differ in kind"),
                    _("compare values of one kind"),
                )
            )
        if self.kind in TOGETHER and len({len(values_of(samples, n)) for n in self.of}) > 1:
            found.append(
                fault(
                    "not_paired",
                    key,
                    _NOT_PAIRED,
                    _("give as many values in each"),
                    counts=" : ".join(str(len(values_of(samples, n))) for n in self.of),
                )
            )
        if self.kind == "variance" and self.value is not None and self.value <= 0:
            found.append(
                fault(
                    "deviation_above_zero",
                    f"{key}.value",
                    _("the standard deviation to compare with must be above zero"),
                    _("give a value above zero"),
                )
            )
        if (
            self.kind == "paired"
            and not found
            and np.ptp(values_of(samples, self.of[0]) - values_of(samples, self.of[1])) == 0.0
        ):
            found.append(
                fault(
                    "constant",
                    key,
                    _CONSTANT,
                    _("measure finer, or leave it out"),
                    sample=f"{self.of[0]} − {self.of[1]}",
                    what=self.kind,
                )
            )
        return found


@dataclass(frozen=True)
class Fitting:
    """The sample ``y`` as a polynomial of ``degree`` of one sample ``on``, or linear in several."""

    y: str = file_key(Text(doc="the sample that is explained"))
    on: tuple[str, ...] = file_key(Listed(Text(), "[x]", doc="the samples that explain it"))
    degree: int = file_key(Integer(1, doc="degree of the polynomial of one sample; default: 1"), 1)

    def columns(self, samples: Mapping[str, Numbers]) -> tuple[Floats, tuple[str, ...]]:
        """The columns (n, p) of a regression and their names."""
        first = [np.ones(len(values_of(samples, self.y)))]
        if len(self.on) == 1:
            x = values_of(samples, self.on[0])
            powers = range(1, self.degree + 1)
            names = [self.on[0] if p == 1 else f"{self.on[0]}^{p}" for p in powers]
            return np.stack([*first, *(x**p for p in powers)], axis=1), ("1", *names)
        return np.stack([*first, *(values_of(samples, n) for n in self.on)], axis=1), ("1", *self.on)

    def regress(self, samples: Mapping[str, Numbers], confidence: float) -> Regression | None:
        """The least squares; None where the columns depend on each other."""
        columns, terms = self.columns(samples)
        return regression(values_of(samples, self.y), columns, terms, confidence)

    def findings(self, key: str, samples: Mapping[str, Numbers]) -> list[Finding]:
        """What is wrong with it, for these samples."""
        found = unknown(key, (self.y, *self.on), samples)
        if found:
            return found
        if self.degree > 1 and len(self.on) > 1:
            return [
                fault(
                    "degree_of_one",
                    f"{key}.degree",
                    _("a degree above 1 is for one explaining sample"),
                    _("name one sample under on, or leave degree out"),
                )
            ]
        counts = {len(values_of(samples, n)) for n in (self.y, *self.on)}
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
        minimum = len(self.columns(samples)[1]) + 1
        if min(counts) < minimum:
            return [
                fault(
                    "too_small",
                    key,
                    _TOO_FEW,
                    _("give at least {minimum}"),
                    sample=self.y,
                    count=min(counts),
                    what="regression",
                    minimum=minimum,
                )
            ]
        return (
            []
            if self.regress(samples, 0.95)
            else [
                fault(
                    "dependent",
                    f"{key}.on",
                    _("the explaining samples depend on each other or do not vary"),
                    pgettext("statistics", "leave one of them out"),
                )
            ]
        )


@dataclass(frozen=True)
class Limits:
    """``lower`` and ``upper`` limit (SI) of a sample; ``subgroup``: size of successive subgroups."""

    lower: float | None = None
    upper: float | None = None
    subgroup: int | None = None

    def findings(self, key: str, name: str, samples: Mapping[str, Numbers]) -> list[Finding]:
        """What is wrong with them, for the sample of this name."""
        found = unknown(key, (name,), samples)
        if found:
            return found
        if self.lower is None and self.upper is None:
            return [fault("no_limits", key, _("there is no limit"), _("give lower, upper or both"))]
        if self.lower is not None and self.upper is not None and self.upper <= self.lower:
            return [
                fault(
                    "limits_order",
                    key,
                    _("the upper limit is not above the lower one"),
                    _("give the larger value as upper"),
                )
            ]
        return too_small(key, (name,), "capability", 2 * (self.subgroup or 1), samples)


def _asked(kind: str, of: tuple[str, ...], value: Any = None) -> TestSpec:
    return TestSpec(kind, of, *(value or ()))


def _limits(lower: Any = None, upper: Any = None, subgroup: int | None = None) -> Limits:
    return Limits(lower and lower[0], upper and upper[0], subgroup)


OF = Listed(Text(), "[a, b]", required=True, doc="names of the samples")
TEST = Table(
    {
        "kind": Word(tuple(TESTS), required=True, doc=", ".join(TESTS)),
        "of": OF,
        "value": AnyQuantity(doc="mean, or standard deviation, that is compared with"),
    },
    _asked,
)
LIMITS = Table(
    {
        "lower": AnyQuantity(doc="lower limit"),
        "upper": AnyQuantity(doc="upper limit"),
        "subgroup": Integer(2, doc="size of successive subgroups, for the deviation within them"),
    },
    _limits,
)
