"""Rack and pinion: a wheel that rolls along a straight line of another link."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING, Any, ClassVar, Self

from linkwright.elements import Drawing, Guide, Model, Sizes
from linkwright.fields.base import Field, Quantity
from linkwright.fields.references import Direction, LinkName, PointName
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Mask, Scalar, absolute, tan
from linkwright.joints.base import JOINTS, Entry, HigherPair, Joint, Report, Size
from linkwright.joints.ends import Ends
from linkwright.joints.gear import CLEARANCE, STANDARD
from linkwright.joints.toothed import FITS, is_integer, length
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.elements import Connection, Group


@JOINTS.register("rack")
@dataclass(frozen=True)
class RackPair(HigherPair):
    """A pinion of pitch ``radius`` (m) rolls on the pitch line of a rack.

    The line goes through ``through`` in ``direction`` (rad, in the rack's axes); the pinion's centre, its pin
    ``centre``, stays at the distance of the radius from it, on the left (``side`` 1) or the right (-1), which guides
    must see to. With s the centre's place along the line from ``through``: s + side r (θ_p - θ_r - phase) = 0. The
    multiplier is the force on the pinion along the line at the pitch point; the teeth press the pinion off the rack
    with |F_t| tan α, ``pressure_angle`` α.
    """

    letter: ClassVar[str] = "K"
    couples: ClassVar[bool] = True
    pinion: str
    rack: str
    through: str
    direction: float
    centre: str
    side: int
    radius: float
    teeth: float | None = None
    module: float | None = None
    phase: float | None = None
    pressure_angle: float = STANDARD

    @property
    def joined(self) -> tuple[str, ...]:
        return (self.pinion, self.rack)

    @property
    def turning(self) -> tuple[str, ...]:
        return (self.pinion, self.rack)

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            "pinion": LinkName(required=True, doc=_("the wheel")),
            "rack": LinkName(required=True, doc=_("the link that carries the rack")),
            "through": PointName("rack", required=True, doc=_("point of the rack on its pitch line")),
            "direction": Direction(
                of="rack", doc=_("direction of the pitch line in the rack's axes (default: its guide's)")
            ),
            "centre": PointName(
                "pinion", doc=_("the pinion's centre, its pin (default: the one that guides lead to)")
            ),
            "radius": Quantity("length", above=0, doc=_("pitch radius of the pinion")),
            "teeth": Quantity("dimensionless", above=0, doc=_("number of teeth of the pinion, with module")),
            "module": Quantity("length", above=0, doc=_("module, with teeth")),
            "phase": Quantity(
                "angle",
                doc=_("angle of the pinion's x axis to the rack's when its centre is at through (default: drawn)"),
            ),
            "pressure_angle": Quantity("angle", minimum=0, below=0.5 * pi, doc=_("pressure angle (default 20 deg)")),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        values = entry.values
        pinion, rack = values["pinion"], values["rack"]
        if pinion == rack:
            entry.finding(
                "rack",
                _('both links are "{first}"', code="model.both_links", first=pinion),
                _("name two different links"),
            )
            return None
        if not any(pinion in owners for owners in entry.reader.names.pins.values()):
            wheel = {"wheel": pinion}
            entry.finding(
                "pinion",
                _('the wheel "{wheel}" has no pin about which it turns', code="joints.without_pin").format(**wheel),
                _('give "{wheel}" a point that a carrier (the frame, an arm) has as well: its centre').format(
                    **wheel
                ),
            )
            return None
        if not _sized(entry):
            return None
        direction = values.pop("direction", None)
        if isinstance(direction, tuple):
            p, q = (complex(*entry.links[rack].points[each]) for each in direction)
            direction = cmath.phase(q - p)
        radius = values.pop("radius", None) or 0.5 * values["teeth"] * values["module"]
        values.setdefault("centre", "")
        return cls(entry.name, direction=direction, side=1, radius=radius, **values)

    def settled(self, mechanism: Model, report: Report) -> Joint:
        way = self._way(mechanism)
        elsewhere = None if way is not None else replace(self, centre="")._way(mechanism)
        if elsewhere is not None:
            problem = _(
                "{centre!r} is not a pin to whose link a guide of the rack {rack!r} leads",
                code="joints.centre_unguided",
                centre=self.centre,
                rack=self.rack,
            )
            report("centre", problem, _("leave the centre out: it is {centre}", centre=elsewhere.centre))
            return replace(self, direction=elsewhere.direction, centre=elsewhere.centre)
        if way is None:
            report(
                "rack",
                _(
                    "no guide leads from the rack {rack!r} to a link that carries the pin of {pinion!r}: "
                    "nothing keeps the pinion at its distance from the rack",
                    code="joints.no_guide",
                    rack=self.rack,
                    pinion=self.pinion,
                ),
                _("add a prismatic joint between the rack and the link that carries the pinion, along the rack"),
            )
            return replace(self, direction=self.direction or 0.0)
        wrong = self._misplaced(way)
        if wrong is not None:
            key, problem = wrong
            remedy = (
                _("give both the same direction, or leave the direction out")
                if key == "direction"
                else _("move the rack's guide or the point through which its pitch line goes, or change the radius")
            )
            loose = self._misplaced(way, self._slack) is None
            report(key, problem, remedy, "warning" if loose else "error")
        off = way.gap.imag
        return replace(self, direction=way.direction, centre=way.centre, side=1 if off > 0 else -1)

    def _misplaced(self, way: _Way, slack: float = 0.0) -> tuple[str, Message] | None:
        """What keeps the pinion off the pitch line by more than the slack, m, and the key that says it."""
        if not way.parallel:
            guide = way.guides[-1][0]
            return "direction", _(
                "the guide {guide!r} is not parallel to the pitch line of {rack!r}",
                code="joints.guide_askew",
                guide=guide,
                rack=self.rack,
            )
        distance = abs(way.gap.imag)
        if abs(distance - self.radius) <= max(FITS * self.radius, slack):
            return None
        shown_distance, radius = length(distance), length(self.radius)
        key = "module" if self.module is not None else "radius"
        return key, _(
            "the pinion's centre {centre!r} is {distance} away from the pitch line, but its radius is {radius}",
            code="joints.rack_misfit",
            centre=way.centre,
            distance=shown_distance,
            radius=radius,
        )

    @property
    def _slack(self) -> float:
        """By how much the pinion may be off its place, m."""
        return CLEARANCE * (self.module or 0.0)

    def misfit(self, mechanism: Model) -> Message | None:
        way = self._way(mechanism)
        wrong = None if way is None else self._misplaced(way, self._slack)
        return None if wrong is None else wrong[1]

    def fits(self, dimensions: Sizes) -> Mask:
        """A pinion of a module may be off its place by the clearance of its teeth, any other not at all."""
        off, askew = _Search(self, dimensions.mechanism).traced(dimensions)
        radius = self._radius(dimensions)
        slack = FITS * radius if self.module is None else CLEARANCE * dimensions(f"{self.name}.module")
        near: Mask = absolute(self.side * off - radius) <= slack
        for each in askew:
            near = dimensions.trace.logic("and", near, absolute(each) < FITS)
        return near

    def _radius(self, dimensions: Sizes) -> Scalar:
        if self.module is None:
            return dimensions(f"{self.name}.radius")
        return 0.5 * dimensions(f"{self.name}.teeth") * dimensions(f"{self.name}.module")

    def drawn(self, drawing: Drawing) -> Joint:
        if self.phase is not None:
            return self
        rolled = self._rolled(drawing)
        pinion, rack = drawing.angle(self.pinion), drawing.angle(self.rack)
        if not drawing or rolled is None or pinion is None or rack is None:
            return replace(self, phase=0.0)
        return replace(self, phase=pinion - rack + rolled)

    def rotation_sum(self, drawing: Drawing) -> tuple[Mapping[str, float], float] | None:
        rolled = self._rolled(drawing)
        if self.phase is None or rolled is None:
            return None
        return {self.pinion: 1.0, self.rack: -1.0}, rolled - self.phase

    def _rolled(self, drawing: Drawing) -> float | None:
        """The angle, rad, that the pinion rolls back from where it is drawn until its centre is at ``through``."""
        rack = drawing.angle(self.rack)
        centre, start = drawing.place(self.pinion, self.centre), drawing.place(self.rack, self.through)
        if rack is None or centre is None or start is None:
            return None
        along = cmath.exp(1j * (rack + self.direction)).conjugate() * (complex(*centre) - complex(*start))
        return self.side * along.real / self.radius

    def written(self) -> dict[str, Any]:
        """Teeth of a module tell the radius."""
        redundant = "" if self.module is None else "radius"
        return {key: value for key, value in super().written().items() if key != redundant}

    def dimensions(self) -> Mapping[str, float]:
        size = {"radius": self.radius}
        if self.module is not None and self.teeth is not None:
            size = {"module": self.module, "teeth": self.teeth}
        values = {
            **size,
            "direction": self.direction,
            "phase": self.phase or 0.0,
            "pressure_angle": self.pressure_angle,
        }
        return {f"{self.name}.{key}": value for key, value in values.items()}

    def with_dimensions(self, value: Callable[[str], float]) -> Self:
        found = super().with_dimensions(value)
        if found.module is None or found.teeth is None:
            return found
        return replace(found, radius=0.5 * found.teeth * found.module)

    # motion -----------------------------------------------------------------------------------
    @classmethod
    def linear(cls, group: Group, cut: Connection) -> bool:
        """Unless something that the group turns carries the rack or the pinion's centre about."""
        return group.carried_steadily(cut)

    def residual(self, at: Ends) -> list[Scalar]:
        gap, line = self._gap(at)
        turned = at.rotation(self.pinion) - at.rotation(self.rack) - at.dimension(f"{self.name}.phase")
        return [line.dot(gap) + self._radius(at.dimensions) * self.side * turned]

    def held(self, at: Ends, force: Scalar, size: Size) -> list[tuple[Scalar, Scalar]]:
        """The teeth press the pinion off the pitch line, on which guides keep it."""
        slope = tan(at.dimension(f"{self.name}.pressure_angle"))
        if isinstance(slope, float) and slope == 0.0:
            return []
        gap, line = self._gap(at)
        return [(line.cross(gap), self.side * slope * size(force))]

    def _gap(self, at: Ends) -> tuple[Vec, Vec]:
        """From the rack's point to the pinion's centre, and the direction of the pitch line."""
        gap = at.point(self.pinion, self.centre) - at.point(self.rack, self.through)
        return gap, at.vector(self.rack, at.unit(f"{self.name}.direction"))

    def sums(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float], float]:
        way = self._way(mechanism)
        assert way is not None
        lever = self.side * self.radius
        slides: dict[str, float] = {}
        for name, sign in way.guides:
            slides[name] = slides.get(name, 0.0) + sign
        rest = way.gap.real - lever * (self.phase or 0.0)
        return {self.pinion: lever, self.rack: -lever}, slides, rest

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.pinion, self.centre),)

    def _way(self, mechanism: Model) -> _Way | None:
        return _Search(self, mechanism).found()


def _sized(entry: Entry) -> bool:
    """Whether the pinion has one size, by its radius or by an integer number of teeth of a module."""
    radius, teeth, module = (entry.values.get(key) for key in ("radius", "teeth", "module"))
    remedy = _("give radius: 40 mm, or teeth: 20 with module: 4 mm")
    if radius is not None and (teeth is not None or module is not None):
        entry.finding("radius", _("the size is set twice", code="joints.sizes_twice"), remedy, "choice")
        return False
    if radius is None and (teeth is None or module is None):
        entry.finding(
            "radius", _("nothing says how large the wheels are", code="joints.no_size"), remedy, "missing-key"
        )
        return False
    if teeth is not None and not is_integer(teeth):
        entry.finding(
            "teeth",
            _("invalid number of teeth {value:g}", code="joints.no_teeth", value=teeth),
            _("give an integer of at least 1"),
            "range",
        )
        return False
    return True


@dataclass(frozen=True)
class _Way:
    """From the rack through guides to the pinion's carrier: their names, 1 where a growing slide moves the centre
    along the line; ``gap``: the centre's place along and across it with all slides at zero."""

    guides: tuple[tuple[str, float], ...]
    centre: str
    gap: complex
    direction: float
    parallel: bool


class _Search:
    """Looks for guides between the rack and a link on which the pinion is pinned."""

    def __init__(self, pair: RackPair, mechanism: Model) -> None:
        self.pair, self.mechanism = pair, mechanism
        self.guides = list(mechanism.guides.values())

    def found(self) -> _Way | None:
        found = self._route()
        return None if found is None else self._measured(*found)

    def _route(self) -> tuple[str, str, tuple[Guide, ...]] | None:
        """The pinion's carrier and pin, and the guides that lead to it from the rack."""
        carriers = self._carriers()
        routes: list[tuple[str, tuple[Guide, ...]]] = [(self.pair.rack, ())]
        visited = {self.pair.rack}
        for link, route in routes:
            if link in carriers and route:
                return link, carriers[link], route
            for joint in self.guides:
                for here, there in (joint.ties, joint.ties[::-1]):
                    if here == link and there not in visited:
                        visited.add(there)
                        routes.append((there, (*route, joint)))
        return None

    def traced(self, dimensions: Sizes) -> tuple[Scalar, list[Scalar]]:
        """How far left of the pitch line the pinion's centre is, m; the sines of the guides' angles to it."""
        found = self._route()
        assert found is not None
        carrier, centre, route = found
        link, axes = self.pair.rack, dimensions.unit(f"{self.pair.name}.direction").conjugate
        here, gap, askew = dimensions.point(link, self.pair.through), Vec(0.0, 0.0), []
        for joint in route:
            outward = joint.guide == link
            on_guide, on_block = (joint.slide_direction(dimensions), dimensions.unit(f"{joint.name}.block_angle"))
            start, end = (joint.through, joint.at) if outward else (joint.at, joint.through)
            n = axes.turn(on_guide if outward else on_block)
            offset = dimensions(f"{joint.name}.offset")
            gap = gap + axes.turn(dimensions.point(link, start) - here)
            gap = gap + n.perp * (offset if outward else -offset)
            askew.append(n.y)
            axes = n.turn((on_block if outward else on_guide).conjugate)
            link = joint.block if outward else joint.guide
            here = dimensions.point(link, end)
        return (gap + axes.turn(dimensions.point(carrier, centre) - here)).y, askew

    def _carriers(self) -> dict[str, str]:
        """Links on which the pinion is pinned, with the pin."""
        pinion, centre = self.pair.pinion, self.pair.centre
        return {
            link: name
            for name, joint in self.mechanism.joints.items()
            if joint.coordinate == "turn" and pinion in joint.joined and centre in ("", name)
            for link in joint.joined
            if link != pinion
        }

    def _measured(self, carrier: str, centre: str, route: Sequence[Guide]) -> _Way:
        """The route in axes whose x axis is the pitch line."""
        pair, link = self.pair, self.pair.rack
        first = route[0]
        on_rack = first.direction if first.guide == link else first.block_angle
        direction = on_rack if pair.direction is None else pair.direction
        axes, here, parallel = -direction, self._local(link, pair.through), True
        gap, guides = 0j, []
        for joint in route:
            outward = joint.guide == link
            along = joint.direction if outward else joint.block_angle
            start, end = (joint.through, joint.at) if outward else (joint.at, joint.through)
            sign = 1.0 if outward else -1.0
            n = cmath.exp(1j * (axes + along))
            gap += cmath.exp(1j * axes) * (self._local(link, start) - here) + sign * 1j * n * joint.offset
            guides.append((joint.name, sign * n.real))
            parallel &= abs(n.imag) < FITS
            turn = joint.direction - joint.block_angle
            axes += turn if outward else -turn
            link = joint.block if outward else joint.guide
            here = self._local(link, end)
        gap += cmath.exp(1j * axes) * (self._local(carrier, centre) - here)
        return _Way(tuple(guides), centre, gap, direction, parallel)

    def _local(self, link: str, point: str) -> complex:
        return complex(*self.mechanism.link(link).points[point])
