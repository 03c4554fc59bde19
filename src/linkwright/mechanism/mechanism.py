"""The one type for a mechanism: frozen, in SI units, checked, not solved."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import field, fields
from typing import TYPE_CHECKING, Any, Literal

from linkwright.core.attached import attached
from linkwright.core.cached_property import cached_property
from linkwright.core.dataclass import dataclass
from linkwright.core.given import require
from linkwright.core.read_only import Frozen, FrozenDict, frozen
from linkwright.drivers.base import Driver
from linkwright.errors import LinkwrightError, RequestError
from linkwright.fields.base import Field, Quantities, Quantity
from linkwright.fields.references import PLACE, Coordinates, LinkPoints, PlaceOrPoint
from linkwright.joints.base import Joint
from linkwright.joints.lower import RigidJoint, SlidingJoint, TurningJoint
from linkwright.loads.base import Load
from linkwright.mechanism.geometry import (
    centre,
    local_points,
    mechanism_size,
    point_addresses,
    second_point_address,
)
from linkwright.mechanism.named_output import NamedOutput
from linkwright.registry import nearest, no_such
from linkwright.units import LARGEST_OF_ALL, SI_UNITS, Dimension
from linkwright.words import LANGUAGES
from linkwright.words.sentence import Sentence, Worded, in_language

if TYPE_CHECKING:
    from linkwright.core.expressions import Expression
Vec = tuple[float, float]
#: What has dimensions of its own.
_SORTS = ("link", "joint", "driver", "load")
Geometry = Literal["length", "bent", "coordinates", "drawing", "point"]

LINK_FIELDS: Mapping[str, Field] = {
    "points": LinkPoints(required=True, doc="the link's points: [A, B], or {A: [x, y], …} in its own axes"),
    "length": Quantity("length", above=0, doc="distance from the first point to the second"),
    "lengths": Quantities("length", count=2, above=0, doc="bent link: first to second, first to third point"),
    "angle": Quantity("angle", doc="bent link: angle from the first length to the second"),
    "also": Coordinates(doc="further points, by coordinates in the link's axes"),
    "mass": Quantity("mass", minimum=0, doc="mass (default 0)"),
    "inertia": Quantity("inertia", minimum=0, doc="moment of inertia about the mass centre (default 0)"),
    "mass_centre": PlaceOrPoint("length", ("x", "y"), doc="mass centre: [x, y] or a point (default: midway)"),
}
FRAME_FIELDS: Mapping[str, Field] = {
    "points": Coordinates(required=True, doc="fixed points: {O1: [0 m, 0 m], …}"),
}

GRAVITY = Quantities("acceleration", ("x", "y"), doc="gravity in frame axes", form="[0, -9.81 m/s²]")


@dataclass(frozen=True)
class Link:
    """A rigid link with named points in its own axes (m), mass (kg) and moment of inertia about its centre
    (kg·m²).

    ``geometry`` says how the user gave it: ``length`` (two points), ``bent`` (two lengths and an angle),
    ``coordinates``, ``drawing`` (from the coordinates of an assembled drawing), ``point`` (one point, at
    the origin).
    ``points`` holds all points in order, those of ``also`` last. ``mass_centre`` may name one of them;
    None means the default: midway between the first two points, or at the only one.
    """

    name: str
    geometry: Geometry
    points: Mapping[str, Vec]
    lengths: tuple[float, ...] = ()
    angle: float = 0.0
    mass: float = 0.0
    inertia: float = 0.0
    mass_centre: Vec | str | None = None

    def fields(self) -> Mapping[str, Field]:
        """What a file may say about the link."""
        return FRAME_FIELDS if self.name == "frame" else LINK_FIELDS

    @property
    def centre(self) -> Vec:
        """Mass centre in the link's axes, m."""
        x, y = centre(self, self.points, self.dimensions().__getitem__)
        return float(x), float(y)

    @cached_property
    def reach(self) -> float:
        """The largest coordinate of a point, m."""
        return max((abs(each) for place in self.points.values() for each in place), default=0.0)

    @cached_property
    def coinciding(self) -> tuple[int, ...]:
        """Of points at one place the number of the first, none where all lie apart."""
        first, places = dict[Vec, int](), self.points.values()
        if len(set(places)) == len(places):
            return ()
        return tuple([first.setdefault(place, i) for i, place in enumerate(places)])

    def geometry_dimensions(self) -> dict[str, float]:
        """Addresses of the dimensions that place the points, with their SI values."""
        found: dict[str, float] = {}
        for index, (point, (x, y)) in enumerate(self.points.items()):
            addresses = point_addresses(self, index, point)
            if addresses is not None:
                found.update(zip(addresses, (x, y), strict=True))
            elif index == 1:
                found[second_point_address(self, point)] = self.lengths[0] if self.lengths else x
            elif index == 2:
                found[f"{self.name}.lengths.1"], found[f"{self.name}.angle"] = self.lengths[1], self.angle
        return found

    def dimensions(self) -> dict[str, float]:
        """Addresses of all dimensions of the link with their SI values."""
        found = self.geometry_dimensions()
        if self.name == "frame":
            return found
        found[f"{self.name}.mass"], found[f"{self.name}.inertia"] = self.mass, self.inertia
        if isinstance(self.mass_centre, tuple):
            found[f"{self.name}.mass_centre.x"], found[f"{self.name}.mass_centre.y"] = self.mass_centre
        return found

    def with_dimensions(self, value: Callable[[str], float]) -> Link:
        """The same link with the values that ``value`` gives for the addresses of ``dimensions``."""
        name = self.name
        lengths: tuple[float, ...] = ()
        if self.geometry == "length":
            lengths = (value(f"{name}.length"),)
        elif self.geometry == "bent":
            lengths = (value(f"{name}.lengths.0"), value(f"{name}.lengths.1"))
        moved = {
            point: (float(x), float(y))
            for point, (x, y) in local_points(self, value, math.cos, math.sin).items()
        }
        angle = value(f"{name}.angle") if self.geometry == "bent" else self.angle
        if name == "frame":
            return Link(name, self.geometry, moved, lengths, angle)
        centre = self.mass_centre
        if isinstance(centre, tuple):
            centre = value(f"{name}.mass_centre.x"), value(f"{name}.mass_centre.y")
        mass, inertia = value(f"{name}.mass"), value(f"{name}.inertia")
        return Link(name, self.geometry, moved, lengths, angle, mass, inertia, centre)


@dataclass(frozen=True)
class Cycle:
    """What one cycle is: a ``duration`` (s), a range of the first driver's coordinate (rad or m), or
    ``turns`` of it."""

    duration: float | None = None
    start: float | None = None
    end: float | None = None
    turns: float | None = None

    @staticmethod
    def fields(across: str) -> dict[str, Field]:
        """The keys of the section ``cycle``; ``across``: dimension of the first driver's coordinate."""
        return {
            "duration": Quantity("time", above=0, doc="time of one cycle"),
            "from": Quantity(across, doc="first coordinate of the first driver"),
            "to": Quantity(across, doc="last coordinate of the first driver"),
            "turns": Quantity("dimensionless", above=0, doc="turns of the first driver"),
        }

    def dimensions(self) -> dict[str, float]:
        """Addresses (``cycle.duration``, ``cycle.from``, ``cycle.to``, ``cycle.turns``) with their SI
        values."""
        values = {"duration": self.duration, "from": self.start, "to": self.end, "turns": self.turns}
        return {f"cycle.{name}": value for name, value in values.items() if value is not None}

    def with_dimensions(self, value: Callable[[str], float]) -> Cycle:
        """The same cycle with the values that ``value`` gives for the addresses of ``dimensions``."""
        new = {address: value(address) for address in self.dimensions()}
        return Cycle(*(new.get(f"cycle.{name}") for name in ("duration", "from", "to", "turns")))


@dataclass(frozen=True)
class Mechanism(Frozen):
    """A planar mechanism as the file or the code gave it: links, joints, drivers, loads; SI units, radians.

    ``frame`` is the fixed link; ``links`` are the moving ones in the file's order. ``joints`` lists the
    implied
    pins in order of first appearance, then the explicit joints. ``kinds`` are the dimensions of the
    ``parameters``; ``outputs`` are formulas of places that have a name. ``expressions`` maps the address of every
    dimension that was given by an expression of ``parameters`` to that expression.
    """

    name: str
    frame: Link
    links: Mapping[str, Link]
    joints: Mapping[str, Joint]
    drivers: Mapping[str, Driver]
    purpose: str = ""
    source: str = ""
    assembly: Mapping[str, str] = field(default_factory=dict)
    drawing: Mapping[str, Vec] = field(default_factory=dict)
    gravity: Vec = (0.0, 0.0)
    loads: Mapping[str, Load] = field(default_factory=dict)
    outputs: Mapping[str, NamedOutput] = field(default_factory=dict)
    cycle: Cycle | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    kinds: Mapping[str, Dimension] = field(default_factory=dict)
    expressions: Mapping[str, Expression] = field(default_factory=dict)
    expected: Mapping[str, Any] = field(default_factory=dict)
    synthesis: Mapping[str, Any] = field(default_factory=dict)
    report: Mapping[str, Any] = field(default_factory=dict)
    sheet: Mapping[str, Any] = field(default_factory=dict)
    course: Mapping[str, Any] = field(default_factory=dict)
    optimize: Mapping[str, Any] = field(default_factory=dict)

    def dimension(self, address: str) -> float:
        """SI value of the dimension at an address such as ``crank.length``; raises for an unknown address."""
        if address not in self._dimensions:
            raise self._unknown(address)
        return self._dimensions[address]

    @property
    def across(self) -> str:
        """Dimension of the first driver's coordinate: ``angle``, or ``length``."""
        return "angle" if all(each.law.rotary for each in list(self.drivers.values())[:1]) else "length"

    def declared(self, address: str) -> Field | None:
        """What a file may hold at the address of a dimension; None of a parameter, and where there is none."""
        if address in ("gravity.x", "gravity.y"):
            return GRAVITY
        sort, name = self._owners.get(address, ("", "cycle"))
        fields = self._elements[sort][name].fields() if sort else Cycle.fields(self.across)
        key = address.removeprefix("loads.").removeprefix(f"{name}.").partition(".")[0]
        found = (each for own, each in fields.items() if (each.key or own) == key)
        return next(found, PLACE if sort == "link" else None)

    def dimensions(self) -> dict[str, float]:
        """All addresses with their SI values, named parameters under their own names."""
        return dict(self._dimensions)

    def with_dimensions(self, changes: Mapping[str, float]) -> Mechanism:
        """A new mechanism with changed SI values.

        Dimensions that are expressions of changed parameters follow; a changed dimension that was an
        expression loses it. Raises LinkwrightError for an unknown address, a value that is not finite, and one that a
        file may not give it either (a length that is not positive, a negative mass or stiffness).
        """
        require(changes, Mapping)
        known = self._dimensions
        new = known | {address: self._checked(address, value) for address, value in changes.items()}
        kept = {address: each for address, each in self.expressions.items() if address not in changes}
        for address, expression in kept.items():
            new[address] = self._checked(address, expression.evaluate(new))
        moved = {self._owners.get(each) for each in (*changes, *kept) if new[each] != known[each]}
        value, parameters = new.__getitem__, {name: new[name] for name in self.parameters}
        renewed: dict[str, set[str]] = {sort: set() for sort in _SORTS}
        for sort, name in filter(None, moved):
            renewed[sort].add(name)
        links = {"frame": self.frame, **self.links}
        links |= {name: links[name].with_dimensions(value) for name in renewed["link"]}
        joints = {name: self.joints[name].with_dimensions(value) for name in renewed["joint"]}
        for name, joint in self.joints.items():
            if name in joints or joint.joined[0] in renewed["link"]:
                new_joint = joints.get(name, joint)
                joints[name] = new_joint.aligned(links[joint.joined[0]].points)
        drivers = self.drivers if parameters != self.parameters else renewed["driver"]
        same = len(kept) == len(self.expressions)
        found = {"_dimensions": new, "_owners": self._owners, "higher": self.higher}
        return self._changed(
            found | ({"family": self.family} if same else {}),
            frame=links.pop("frame"),
            links=_with(self.links, links),
            joints=_with(self.joints, joints),
            drivers=_with(
                self.drivers,
                {name: self.drivers[name].with_dimensions(value, parameters) for name in drivers},
            ),
            loads=_with(
                self.loads, {name: self.loads[name].with_dimensions(value) for name in renewed["load"]}
            ),
            gravity=(value("gravity.x"), value("gravity.y")),
            cycle=None if self.cycle is None else self.cycle.with_dimensions(value),
            parameters=_with(self.parameters, parameters),
            expressions=self.expressions if same else kept,
        )

    def _changed(self, found: Mapping[str, Any], **changes: Any) -> Mechanism:
        """The same mechanism with other fields, the others are frozen already, and what is ``found`` of it."""
        own, made = vars(self), object.__new__(type(self))
        vars(made).update({name: own[name] for name in self.__dataclass_fields__})
        vars(made).update({name: frozen(each) for name, each in changes.items()})
        vars(made).update(found)
        return made

    @cached_property
    def _elements(self) -> dict[str, Mapping[str, Any]]:
        """All that has dimensions of its own, by sort and name."""
        links = {"frame": self.frame, **self.links}
        return dict(zip(_SORTS, (links, self.joints, self.drivers, self.loads), strict=True))

    @cached_property
    def _owners(self) -> dict[str, tuple[str, str]]:
        """The element whose dimension an address is, as its sort and name."""
        return {
            address: (sort, name)
            for sort, named in self._elements.items()
            for name, each in named.items()
            for address in each.dimensions()
        }

    @cached_property
    def pins(self) -> Mapping[str, TurningJoint]:
        """The joints about which links turn."""
        return FrozenDict(
            {name: each for name, each in self.joints.items() if isinstance(each, TurningJoint)}
        )

    @cached_property
    def guides(self) -> Mapping[str, SlidingJoint]:
        """The joints along which blocks slide."""
        return FrozenDict(
            {name: each for name, each in self.joints.items() if isinstance(each, SlidingJoint)}
        )

    @cached_property
    def welds(self) -> Mapping[str, RigidJoint]:
        """The joints that make one of two links."""
        return FrozenDict({name: each for name, each in self.joints.items() if isinstance(each, RigidJoint)})

    @cached_property
    def grounded(self) -> frozenset[str]:
        """The frame and the links welded to it, also through others."""
        found, welds = {"frame"}, [set(weld.joined) for weld in self.welds.values()]
        while touching := [each for each in welds if each & found and not each <= found]:
            found = found.union(*touching)
        return frozenset(found)

    def pin_links(self, name: str) -> tuple[str, ...]:
        """The links on the pin of that name; none where there is no such pin."""
        joint = self.joints.get(name)
        return joint.joined if joint is not None and joint.coordinate == "turn" else ()

    def said_in(self, language: str) -> Mechanism:
        """The same with name, purpose and source in a language, where the file gives them in several, or under that
        language of its report."""
        told = {key: self._worded(key) for key in ("name", "purpose", "source")}
        said = {key: in_language(text, language) for key, text in told.items()}
        return self._changed({}, **said) if any(isinstance(text, Worded) for text in told.values()) else self

    def _worded(self, key: str) -> str:
        """A text of the file in all languages in which the file gives it."""
        text: str = getattr(self, key)
        report = {each: self.report.get(each) for each in LANGUAGES}
        own = {
            each: str(words[key])
            for each, words in report.items()
            if isinstance(words, Mapping) and key in words
        }
        if isinstance(text, Worded):
            return Worded({**own, **text.texts})
        return Worded({**dict.fromkeys(LANGUAGES, text), **own}) if own else text

    @attached
    def structure(self) -> Any:
        """Mobility and Assur groups of the mechanism (see ``linkwright.structure``)."""
        raise NotImplementedError

    @property
    def steady(self) -> bool:
        """Whether inputs say where a position is: there are drivers, all of constant speed."""
        laws = [driver.law for driver in self.drivers.values()]
        return bool(laws) and all(law.constant_speed is not None for law in laws)

    @property
    def has_loads(self) -> bool:
        """Whether there is anything that joints would have to carry: loads, masses or moments of inertia."""
        return bool(self.loads) or any(link.mass or link.inertia for link in self.links.values())

    @attached
    def _repr_svg_(self) -> str | None:
        """The drawing, as notebooks show it; None where it cannot be put together."""
        raise NotImplementedError

    def link(self, name: str) -> Link:
        """The link of that name, the frame included; raises for an unknown name."""
        if name == "frame":
            return self.frame
        if name not in self.links:
            raise RequestError(no_such("link", name, ["frame", *self.links]))
        return self.links[name]

    @cached_property
    def size(self) -> float:
        """A power of two in metres, not below the largest coordinate, offset or stroke."""
        return mechanism_size(self)

    @cached_property
    def higher(self) -> bool:
        """Whether it has higher pairs: wheels, racks, cams."""
        return any(joint.higher for joint in self.joints.values())

    @cached_property
    def family(self) -> object:
        """The same for mechanisms that differ in numbers only, where one was made from another."""
        return object()

    @cached_property
    def _dimensions(self) -> dict[str, float]:
        found = dict(self.parameters)
        for named in self._elements.values():
            for each in named.values():
                found.update(each.dimensions())
        found["gravity.x"], found["gravity.y"] = self.gravity
        if self.cycle is not None:
            found.update(self.cycle.dimensions())
        return found

    def _unknown(self, address: str) -> LinkwrightError:
        offer = nearest(str(address), self._dimensions)
        hint = Sentence("names.did_you_mean", offer=offer) if offer else Sentence("model.see_addresses")
        return LinkwrightError("model.no_dimension", address=address, hint=hint)

    def _checked(self, address: str, value: float) -> float:
        if address not in self._dimensions:
            raise self._unknown(address)
        try:
            value = float(value)
        except (TypeError, ValueError):
            raise RequestError("model.set_no_number", address=address, given=repr(value)[:60]) from None
        if not math.isfinite(value):
            raise RequestError("model.set_not_finite", address=address, value=value)
        if abs(value) > LARGEST_OF_ALL:
            raise RequestError("model.set_beyond", address=address, value=value)
        sort, name = self._owners.get(address, ("", ""))
        if sort == "joint":
            limit = self.joints[name].limit(address, value)
        else:
            limit = None if (field := self.declared(address)) is None else field.limit(value)
        if limit is not None:
            unit = SI_UNITS.get(getattr(self.declared(address), "dimension", ""), "")
            told = f"{value:g} {unit}".rstrip()
            raise RequestError("model.set_outside", address=address, value=told, limit=limit)
        return value

    def __repr__(self) -> str:
        names = ", ".join(self.links)
        counts = f"{len(self.joints)} joints, {len(self.drivers)} driver(s)"
        return f"Mechanism({self.name!r}: links {names}; {counts})"

    def __getstate__(self) -> dict[str, Any]:
        return {each.name: getattr(self, each.name) for each in fields(self)}


def _with(old: Mapping[str, Any], new: Mapping[str, Any]) -> Mapping[str, Any]:
    """A mapping with new elements in their places; where nothing is new the old one itself, by which what was found
    for its elements is known again."""
    return FrozenDict({**old, **new}) if any(each is not old[name] for name, each in new.items()) else old
