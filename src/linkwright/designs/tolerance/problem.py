"""What varies and what is asked: tolerances of dimensions, clearances of pins, outputs and their limits."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright import units
from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Floats
from linkwright.designs.ranges import dimension_of
from linkwright.fields.base import Quantity, Text, Word, file_key
from linkwright.fields.tables import ByAddress, Either, Integer, Listed, Named, Table
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.fields import MECHANISM, AnyQuantity, OfMechanism
from linkwright.units import si_unit
from linkwright.words import _

#: Standard deviation of each distribution as a share of its tolerance ±t.
DEVIATIONS = {"normal": 1 / 3, "uniform": 1 / math.sqrt(3), "triangular": 1 / math.sqrt(6)}
#: Fewer samples than this tell nothing about a spread.
MIN_SAMPLES = 64


@dataclass(frozen=True)
class Tolerance:
    """± ``tolerance`` (SI) about the nominal value: normal with 3σ = t, uniform, or triangular."""

    tolerance: float
    distribution: str = "normal"
    dimension: units.Dimension | None = None

    @property
    def deviation(self) -> float:
        """Standard deviation."""
        return self.tolerance * DEVIATIONS[self.distribution]

    def values(self, share: Floats) -> Floats:
        """Deviations from the nominal value for even shares between 0 and 1."""
        from scipy import stats

        match self.distribution:
            case "normal":
                return np.asarray(stats.norm.ppf(share)) * self.deviation
            case "uniform":
                return self.tolerance * (2.0 * share - 1.0)
        return np.asarray(stats.triang.ppf(share, 0.5, loc=-self.tolerance, scale=2 * self.tolerance))


@dataclass(frozen=True)
class Clearance:
    """Radial ``clearance`` (m) of a pin in its hole in link ``on``.

    ``kind``: ``free`` — the pin touches the hole anywhere, each machine somewhere else, in any direction;
    ``pressed`` — at every position the joint's own reaction presses the pin against the hole.
    """

    clearance: float = file_key(Quantity("length", above=0.0, doc="radius of the hole less that of the pin"))
    on: str = file_key(Text(doc="the link with the hole"))
    kind: str = file_key(
        Word(("free", "pressed"), doc="free: the pin lies anywhere; pressed: where the reaction presses it"), "free"
    )


@dataclass(frozen=True)
class Limit:
    """``lower`` and ``upper`` limit (SI) of an output."""

    lower: float = -math.inf
    upper: float = math.inf
    kinds: tuple[units.Dimension, ...] = ()


def _tolerance(tolerance: Any, distribution: str = "normal") -> Tolerance:
    return Tolerance(tolerance[0], distribution, tolerance[1])


def _limit(lower: Any = None, upper: Any = None) -> Limit:
    kinds = tuple(each[1] for each in (lower, upper) if each is not None)
    return Limit(lower[0] if lower else -math.inf, upper[0] if upper else math.inf, kinds)


@dataclass(frozen=True)
class ToleranceField(Either):
    """``0.05 mm`` (normal, ± 3σ), or ``{tolerance: 0.05 mm, distribution: uniform}``."""

    def read(self, reader: Any, node: Any, place: Any, siblings: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, siblings)
        return _tolerance(found) if isinstance(found, tuple) else found


TOLERANCE = {
    "tolerance": AnyQuantity(required=True, doc="± about the nominal value"),
    "distribution": Word(tuple(DEVIATIONS), doc=", ".join(DEVIATIONS)),
}
LIMIT = {"lower": AnyQuantity(doc="lower limit"), "upper": AnyQuantity(doc="upper limit")}


@dataclass(frozen=True)
class Tolerances(OfMechanism):
    """What varies of a mechanism, and what is asked about it: see ``ToleranceStudy``."""

    kind: ClassVar[str] = "tolerance"
    mechanism: Mechanism = file_key(MECHANISM)
    dimensions: Mapping[str, Tolerance] = file_key(
        ByAddress(
            ToleranceField(AnyQuantity(), Table(TOLERANCE, _tolerance)),
            doc="by dimension: crank.length: 0.05 mm, or {tolerance: 0.05 mm, distribution: uniform}",
        ),
        dict,
    )
    clearances: Mapping[str, Clearance] = file_key(
        Named(
            Table.of(Clearance), _("pin"), doc="clearances by pin: {clearance: 0.02 mm, on: rocker, kind: pressed}"
        ),
        dict,
    )
    of: tuple[str, ...] = file_key(Listed(Text(), '["rocker.angle range"]', doc="summaries over the cycle"), ())
    curves: tuple[str, ...] = file_key(Listed(Text(), "[rocker.angle]", doc="outputs over the cycle"), ())
    limits: Mapping[str, Limit] = file_key(
        ByAddress(Table(LIMIT, _limit), doc="limits by summary: {lower: 59 deg, upper: 61 deg}"), dict
    )
    samples: int = file_key(Integer(MIN_SAMPLES, doc="machines of the Monte Carlo study; default: 8192"), 8192)
    seed: int = file_key(Integer(0, 2**32 - 1, doc="seed of the random numbers"), 1)
    steps: int = file_key(Integer(4, doc="positions of the curves over the cycle; default: 360"), STEPS)
    name: str = ""
    source: str = ""

    @cached_property
    def prepared(self) -> Mechanism:
        """The mechanism with the holes' links given by coordinates, so that their points can move."""
        links, mechanism = dict(self.mechanism.links), self.mechanism
        moved = {c.on for c in self.clearances.values() if c.on in links}
        for name in moved:
            links[name] = _by_coordinates(links[name])
        expressions = {a: e for a, e in mechanism.expressions.items() if a.partition(".")[0] not in moved}
        return replace(mechanism, links=links, expressions=expressions)

    def alias(self, address: str) -> str:
        """Where a dimension is found in the prepared mechanism: a length as its second point's x."""
        owner, _, last = address.partition(".")
        link = self.mechanism.links.get(owner)
        if link is not None and last == "length" and self.prepared.links[owner].geometry != "length":
            return f"{owner}.{list(link.points)[1]}.x"
        return address

    @cached_property
    def deviating(self) -> dict[str, Tolerance]:
        """Tolerances by address in the prepared mechanism."""
        return {self.alias(address): each for address, each in self.dimensions.items()}

    def per_unit(self, kind: str, name: str) -> str:
        """SI unit of the derivative of a quantity of a kind by what varies under this name: ``rad/m``."""
        own: dict[str, units.Dimension | None] = dict.fromkeys(self.clearances, units.DIMENSIONS["length"])
        for address, each in self.deviating.items():
            own[self.written(address)] = each.dimension or dimension_of(self.mechanism, address)
        above, below = si_unit(kind), units.si_symbol(own.get(name) or units.NONE)
        return f"{above or 1}/{f'({below})' if '·' in below or '/' in below else below}" if below else above

    def written(self, address: str) -> str:
        """The address as the user wrote it."""
        return next((own for own in self.dimensions if self.alias(own) == address), address)

    def holes(self, kind: str) -> dict[str, tuple[str, str]]:
        """Addresses of the hole's coordinates by pin, for clearances of a kind."""
        return {
            pin: (f"{each.on}.{pin}.x", f"{each.on}.{pin}.y")
            for pin, each in self.clearances.items()
            if each.kind == kind
        }


def _by_coordinates(link: Link) -> Link:
    """The same link, its points given by coordinates."""
    return replace(link, geometry="coordinates", lengths=(), angle=0.0)
