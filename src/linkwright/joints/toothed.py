"""What the pairs of two wheels on one carrier have in common: gears, rolling wheels, belts and chains.

The equality of the two pitch-line velocities is linear in the rotations θ of the wheels a, b and of their carrier c,

    k_a (θ_a - θ_c) + k_b (θ_b - θ_c) = const,      ratio i = (ω_b - ω_c) / (ω_a - ω_c) = -k_a / k_b,

with the lever arms k in m, so that it holds with turns and its multiplier is the tangential force (Willis 1841;
Müller, Epicyclic Drive Trains, ch. 2).
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.quantity import shown
from linkwright.elements import Drawing, Model, Sizes
from linkwright.fields.base import Field, Quantities, Quantity, pair_schema
from linkwright.fields.references import LinkName, LinkNames
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, reciprocal, sqrt
from linkwright.joints.base import Entry, HigherPair, Joint
from linkwright.joints.ends import Ends
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.fields.reading import Place as Where
    from linkwright.fields.reading import Reader

#: A centre distance or a ratio may differ from what the wheels ask for by this share.
FITS = 1e-6
Pair = tuple[float, float]


@dataclass(frozen=True)
class WheelPair(HigherPair):
    """Two wheels, ``links`` (a, b), whose ``centres`` are pins on the link ``carrier``.

    Sizes by numbers of ``teeth``, by pitch ``radii`` (m), or by their ``ratio`` (ω_b - ω_c) / (ω_a - ω_c) alone.
    ``phase`` (rad): angle of b's x axis to the carrier's when a's has none.
    """

    rotations_only: ClassVar[bool] = True
    toothed: ClassVar[bool] = False
    links: tuple[str, str]
    carrier: str
    centres: tuple[str, str]
    teeth: Pair | None = None
    radii: Pair | None = None
    ratio: float | None = None
    phase: float | None = None

    @property
    def joined(self) -> tuple[str, ...]:
        return self.links

    @property
    def turning(self) -> tuple[str, ...]:
        return (*self.links, self.carrier)

    @property
    @abstractmethod
    def sense(self) -> float:
        """1 where both wheels turn the same way on their carrier, -1 where they turn against each other."""

    @property
    def transmission(self) -> float:
        """Ratio (ω_b - ω_c) / (ω_a - ω_c), with its sign."""
        if self.ratio is not None:
            return self.ratio
        a, b = self.teeth or self.radii or (1.0, 1.0)
        return self.sense * a / b

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            "links": LinkNames(required=True, doc=_("the two wheels [a, b]")),
            "radii": Quantities("length", count=2, above=0, doc=_("their pitch radii [a, b]")),
            "carrier": LinkName(doc=_("the link on which both wheels have their pins, where it is in doubt")),
            "phase": Quantity(
                "angle", doc=_("angle of b's x axis to the carrier's when a's has none (default: drawn)")
            ),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        held = _Centres(entry, entry.values["links"], entry.values.pop("carrier", None)).found(cls.kind)
        if held is None or not _one_size(entry, cls.sizes()):
            return None
        joint = cls(entry.name, carrier=held[0], centres=held[1:], **entry.values)
        points = entry.links[held[0]].points if held[0] in entry.links else {}
        if all(each in points for each in joint.centres):
            joint.check(entry, math.dist(*(points[each] for each in joint.centres)))
        return joint

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        """The keys of which one gives the sizes."""
        return ("teeth", "radii", "ratio")

    def check(self, entry: Entry, distance: float) -> None:
        """Adds findings where the sizes do not fit the distance (m) between the centres."""

    def drawn(self, drawing: Drawing) -> Joint:
        if self.phase is not None:
            return self
        a, b, c = (drawing.angle(link) for link in self.turning)
        if not drawing or a is None or b is None or c is None:
            return replace(self, phase=0.0)
        return replace(self, phase=(b - c) - self.transmission * (a - c))

    def rotation_sum(self, drawing: Drawing) -> tuple[Mapping[str, float], float] | None:
        if self.phase is None:
            return None
        factors, _unused, rest = self.sums(drawing.mechanism)
        return factors, rest

    def dimensions(self) -> Mapping[str, float]:
        found: dict[str, float] = {}
        for key in ("teeth", "radii"):
            for index, value in enumerate(getattr(self, key) or ()):
                found[f"{self.name}.{key}.{index}"] = value
        if self.ratio is not None:
            found[f"{self.name}.ratio"] = self.ratio
        return {**found, f"{self.name}.phase": self.phase or 0.0}

    def limit(self, address: str, value: float) -> Message | None:
        """A pair does not become an internal one, or the other way round, by a changed ratio."""
        if address == f"{self.name}.ratio" and value * self.transmission < 0:
            return _(
                "a ratio of the same sign as {ratio:g}; the other sign is another mesh",
                code="joints.same_sign",
                ratio=self.transmission,
            )
        return super().limit(address, value)

    # motion -----------------------------------------------------------------------------------
    @abstractmethod
    def arms(self, mechanism: Model) -> tuple[float, float]:
        """Lever arms k_a, k_b of the row, m."""

    @abstractmethod
    def traced_arms(self, at: Ends) -> tuple[Scalar, Scalar, Scalar]:
        """Lever arms of a, b and the carrier, m, as traced values."""

    def residual(self, at: Ends) -> list[Scalar]:
        arms, total = self.traced_arms(at), 0.0  # type: tuple[Scalar, ...], Scalar
        for arm, link in zip(arms, self.turning, strict=True):
            total = total + arm * at.rotation(link)
        return [total - arms[1] * at.dimension(f"{self.name}.phase")]

    def axis(self, at: Ends) -> Vec:
        """Unit vector from the centre of a to that of b, in the carrier's axes."""
        line = self.traced_line(at.dimensions)
        return line * reciprocal(sqrt(line.square))

    def traced_line(self, dimensions: Sizes) -> Vec:
        """From the centre of a to that of b in the carrier's axes, traced, m."""
        a, b = (dimensions.point(self.carrier, each) for each in self.centres)
        return b - a

    def centre_offset(self, at: Ends) -> tuple[Scalar, Scalar]:
        """How far b's centre is from a's along the carrier's line and to its left, m: its distance, and zero."""
        (one, other), (a, b) = self.links, self.centres
        along, gap = at.vector(self.carrier, self.axis(at)), at.point(other, b) - at.point(one, a)
        return along.dot(gap), along.cross(gap)

    def traced_ratio(self, dimensions: Sizes) -> Scalar:
        """The ratio as a traced value of the dimensions."""
        if self.ratio is not None:
            return dimensions(f"{self.name}.ratio")
        key = "teeth" if self.teeth is not None else "radii"
        return self.sense * dimensions(f"{self.name}.{key}.0") / dimensions(f"{self.name}.{key}.1")

    def sums(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float], float]:
        i = self.transmission
        return dict(zip(self.turning, (i, -1.0, 1.0 - i), strict=True)), {}, self.phase or 0.0

    def line(self, mechanism: Model) -> complex:
        """From the centre of a to that of b in the carrier's axes, m."""
        points = mechanism.link(self.carrier).points
        a, b = (complex(*points[each]) for each in self.centres)
        return b - a

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.carrier, self.centres[0]), (self.carrier, self.centres[1]))


def is_integer(value: float) -> bool:
    """Whether a number can be one of teeth."""
    return value >= 1 and value == round(value)


class Numbers(Field):
    """Two positive integers."""

    dimension: ClassVar[str] = "dimensionless"

    def read(self, reader: Reader, node: Any, place: Where, siblings: Mapping[str, Any]) -> Pair | None:
        items = reader.items(node, place, 2, "[20, 60]")
        if items is None:
            return None
        found = [reader.quantity(item, place.child(str(i)), "dimensionless") for i, item in enumerate(items)]
        for item, value in zip(items, found, strict=True):
            if value is not None and not is_integer(value):
                reader.error(
                    item,
                    place,
                    _("invalid number of teeth {value:g}", code="joints.no_teeth", value=value),
                    _("give an integer of at least 1"),
                    "range",
                )
                return None
        a, b = found
        return None if a is None or b is None else (a, b)

    def limit(self, value: float) -> Message | None:
        return Quantity("dimensionless", above=0).limit(value)

    def shape(self) -> dict[str, Any]:
        return pair_schema({"type": ["integer", "string"], "minimum": 1})

    def written(self, value: Any) -> Any:
        return [int(each) if each == round(each) else each for each in value]


def _one_size(entry: Entry, keys: tuple[str, ...]) -> bool:
    values = entry.values
    present = [key for key in keys if values.get(key) is not None]
    if not present:
        remedy = (_("give one of {keys}") if len(keys) > 1 else _("give {keys}")).format(keys=keys)
        entry.finding("", _("nothing says how large the wheels are", code="joints.no_size"), remedy, "missing-key")
        return False
    if {"teeth", "radii"} <= set(present):
        (a, b), (c, d) = values["teeth"], values["radii"]
        if abs(a * d - b * c) > FITS * abs(b * c):
            entry.finding(
                "radii",
                _("teeth and radii give different ratios", code="joints.sizes_misfit"),
                _("leave one of them out"),
                "choice",
            )
            return False
    return True


@dataclass(frozen=True)
class _Centres:
    """Looks for the link that carries both wheels, and for their pins on it."""

    entry: Entry
    wheels: tuple[str, str]
    named: str | None

    def found(self, kind: str) -> tuple[str, str, str] | None:
        """Carrier and centres; None after a finding."""
        pins = self.entry.reader.names.pins
        own = [[pin for pin, links in pins.items() if wheel in links] for wheel in self.wheels]
        for wheel, mine in zip(self.wheels, own, strict=True):
            if not mine:
                tied = self.entry.reader.names.welded.get(wheel)
                remedy = (
                    _(
                        '"{wheel}" is welded to "{tied}": name "{tied}" in its place',
                        code="joints.name_welded",
                        wheel=wheel,
                        tied=tied,
                    )
                    if tied
                    else None
                )
                self._report(
                    self._without(kind).format(wheel=wheel),
                    remedy
                    or _(
                        'give "{wheel}" a point that a carrier (the frame, an arm) has as well: its centre',
                        wheel=wheel,
                    ),
                )
                return None
        carriers = [
            (link, p, q)
            for p in own[0]
            for q in own[1]
            if p != q
            for link in pins[p]
            if link in pins[q] and link not in self.wheels and self.named in (None, link)
        ]
        bearing = sorted({link for p in own[0] for q in own[1] for link in pins[p] if link in pins[q]})
        bearing = [link for link in bearing if link not in self.wheels]
        if not carriers and self.named is not None and bearing:
            problem = _(
                "{name!r} does not carry the pins of both wheels {wheels}",
                code="joints.no_such_carrier",
                name=self.named,
                wheels=self.wheels,
            )
            self.entry.finding("carrier", problem, _("they are carried by {names}", names=tuple(bearing)))
            return None
        if not carriers:
            self._report(
                _(
                    "no link carries the pins of both wheels {wheels}, so nothing fixes their centre distance",
                    code="joints.no_carrier",
                    wheels=self.wheels,
                ),
                _("give one link (the frame, an arm) a point in the centre of each of {wheels}", wheels=self.wheels),
            )
            return None
        carriers.sort(key=lambda each: each[0] != "frame")
        same = [each for each in carriers if each[0] == carriers[0][0]]
        if (len(carriers) > 1 and carriers[0][0] != "frame") or len(same) > 1:
            self._report(
                _(
                    "the centres of the wheels may be {names}",
                    code="joints.carriers",
                    names=tuple(f"{link} ({p}, {q})" for link, p, q in carriers),
                ),
                _("say which link carries both: carrier: NAME"),
            )
            return None
        return carriers[0]

    @staticmethod
    def _without(kind: str) -> Message:
        return (
            _('the link "{wheel}" does not turn about a pin, so no belt or chain can run around it')
            if kind in ("belt", "chain")
            else _('the wheel "{wheel}" has no pin about which it turns')
        )

    def _report(self, problem: Message, remedy: Message) -> None:
        self.entry.finding("links", problem, remedy)


def length(value: float) -> str:
    """A length as sentences print it."""
    return shown(value, "length", 7)
