"""The one type for a mechanism, frozen, in SI units, checked, not solved; and outputs that a model names itself."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any

from linkwright.actuators.base import Actuator
from linkwright.applied_loads.base import Load
from linkwright.core.arguments import require
from linkwright.core.attached import attached
from linkwright.core.data import Frozen, FrozenDict, frozen
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output, rate_dimension
from linkwright.drivers.base import Driver
from linkwright.drivers.following import Following, Guidance
from linkwright.drivers.path import Path, path_fields
from linkwright.drivers.rocking import Rocking
from linkwright.errors import LinkwrightError, RequestError
from linkwright.fields.base import Field, Quantities
from linkwright.fields.references import PLACE
from linkwright.joints.base import Joint
from linkwright.joints.lower_pair import RigidJoint, SlidingJoint, TurningJoint
from linkwright.mechanism.construction import Construction
from linkwright.mechanism.cycle import Cycle
from linkwright.mechanism.link import Link, Vec
from linkwright.mechanism.run_conditions import RunConditions
from linkwright.mechanism.stops import Stop
from linkwright.registry import nearest, no_such
from linkwright.units import LARGEST_OF_ALL, SI_UNITS, Dimension
from linkwright.words import _
from linkwright.words.message import in_language


@dataclass(frozen=True)
class NamedOutput:
    """An output by a formula of the machine's places and rates, its parameters, and named outputs before it.

    ``dimension``: name of the dimension of its value; ``rates``: how many of its derivatives in time are known, 2 of
    a formula of places, 1 where velocities are in it, 0 where accelerations are.
    """

    name: str
    expression: Expression
    dimension: str
    rates: int

    @property
    def outputs(self) -> tuple[Output, ...]:
        """Its value and its rates as outputs of the machine."""
        found = [Output("named", self.name, measured=self.dimension)]
        while len(found) <= self.rates and rate_dimension(found[-1].dimension):
            found.append(found[-1].rate)
        return tuple(found)


def named_outputs(outputs: Mapping[str, NamedOutput]) -> dict[str, Output]:
    """Values and rates of named outputs as outputs, by the names they go by: ``gap``, ``gap.rate``."""
    return {each.name: each for named in outputs.values() for each in named.outputs}


#: What has dimensions of its own.
_SORTS = ("link", "joint", "driver", "load", "actuator", "stop")

GRAVITY = Quantities("acceleration", ("x", "y"), doc=_("gravity in frame axes"), form="[0, -9.81 m/s²]")


@dataclass(frozen=True)
class Mechanism(Frozen):
    """A planar mechanism as the file or the code gave it: links, joints, drivers, loads; SI units, radians.

    ``frame`` is the fixed link; ``links`` are the moving ones in the file's order. ``joints`` lists the
    implied
    pins in order of first appearance, then the explicit joints. ``kinds`` are the dimensions of the
    ``parameters``; ``outputs`` are formulas of places that have a name. ``actuators``, ``stops`` and ``run`` are for
    motion under forces; what prescribes a motion leaves them out. ``expressions`` maps the address of every
    dimension that was given by an expression of ``parameters`` to that expression. ``construction``: how it is made,
    None where the file does not say.
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
    path: Path | None = None
    actuators: Mapping[str, Actuator] = field(default_factory=dict)
    stops: Mapping[str, Stop] = field(default_factory=dict)
    run: RunConditions | None = None
    construction: Construction | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    kinds: Mapping[str, Dimension] = field(default_factory=dict)
    expressions: Mapping[str, Expression] = field(default_factory=dict)
    expected: Mapping[str, Any] = field(default_factory=dict)
    synthesis: Mapping[str, Any] = field(default_factory=dict)
    report: Mapping[str, Any] = field(default_factory=dict)
    sheet: Mapping[str, Any] = field(default_factory=dict)
    course: Mapping[str, Any] = field(default_factory=dict)
    optimize: Mapping[str, Any] = field(default_factory=dict)
    expect: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._lead()

    def _lead(self) -> None:
        """Gives the only driver the law of a cycle that rocks, and those without a law that of a path; in any other
        machine drivers keep their own laws."""
        rock = None if self.cycle is None else self.cycle.rock
        if rock is None and self.path is None and all(each.law.own is each.law for each in self.drivers.values()):
            return
        own = FrozenDict({name: replace(each, law=each.law.own) for name, each in self.drivers.items()})
        drivers: Mapping[str, Driver] = own
        if rock is not None and len(own) == 1:
            (driver,) = own.values()
            law = Rocking(driver.law, rock, self._changed({}, drivers=own, cycle=None), driver.law.rotary)
            drivers = FrozenDict({driver.name: replace(driver, law=law)})
        elif self.path is not None:
            guidance = Guidance(self._changed({}, drivers=own, path=None), self.path)
            led = {
                name: replace(each, law=Following(each.law.rotary, name, guidance))
                for name, each in own.items()
                if isinstance(each.law, Following)
            }
            drivers = FrozenDict({**own, **led})
        object.__setattr__(self, "drivers", drivers)

    @property
    def posed(self) -> Mechanism:
        """The machine whose drawing shows how it is put together: of one that follows a path as it is at the path's
        beginning, else itself."""
        return self if self.guidance is None else self.guidance.posed()

    @property
    def guidance(self) -> Guidance | None:
        """What gives the drivers without a law their coordinates in a machine that follows a path."""
        laws = (each.law for each in self.drivers.values())
        return next((law.guidance for law in laws if isinstance(law, Following)), None)

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
        sort, name = self._owners.get(address, ("", address.partition(".")[0]))
        element = self._elements[sort][name] if sort else None
        fields = self._section_fields(name) if element is None else element.fields()
        key = address.removeprefix(f"{getattr(element, 'section', '')}.").removeprefix(f"{name}.").partition(".")[0]
        found = (each for own, each in fields.items() if (each.key or own) == key)
        return next(found, PLACE if sort == "link" else None)

    def _section_fields(self, section: str) -> Mapping[str, Field]:
        """The keys of a section that is one table; none of another."""
        match section:
            case "cycle":
                return Cycle.fields(self.across)
            case "path":
                return path_fields()
            case "run":
                return RunConditions.fields(self.drivers)
            case "construction":
                return Construction.fields()
        return {}

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
        unchanged = {address: each for address, each in self.expressions.items() if address not in changes}
        for address, expression in unchanged.items():
            new[address] = self._checked(address, expression.evaluate(new))
        weighed = self._weigh(changes, new)
        moved = {
            self._owners.get(each) for each in (*changes, *unchanged, *self._derived) if new[each] != known[each]
        }
        value, parameters = new.__getitem__, {name: new[name] for name in self.parameters}
        renewed: dict[str, set[str]] = {sort: set() for sort in _SORTS}
        for sort, name in filter(None, moved):
            renewed[sort].add(name)
        links = {"frame": self.frame, **self.links}
        links |= {name: links[name].with_dimensions(value) for name in renewed["link"]}
        links |= {name: replace(links[name], mass_from_shape=False) for name in weighed}
        joints = {name: self.joints[name].with_dimensions(value) for name in renewed["joint"]}
        for name, joint in self.joints.items():
            if name in joints or joint.joined[0] in renewed["link"]:
                new_joint = joints.get(name, joint)
                joints[name] = new_joint.aligned(links[joint.joined[0]].points)
        drivers = self.drivers if parameters != self.parameters else renewed["driver"]
        same = len(unchanged) == len(self.expressions) and not weighed
        found = {"_dimensions": new, "_owners": self._owners, "higher": self.higher}
        led = self.path is not None or (self.cycle is not None and self.cycle.rock is not None)
        changed = self._changed(
            found | ({"family": self.family} if same and not led else {}),
            frame=links.pop("frame"),
            links=_with(self.links, links),
            joints=_with(self.joints, joints),
            drivers=_with(
                self.drivers, {name: self.drivers[name].with_dimensions(value, parameters) for name in drivers}
            ),
            loads=_with(self.loads, {name: self.loads[name].with_dimensions(value) for name in renewed["load"]}),
            actuators=_with(
                self.actuators, {name: self.actuators[name].with_dimensions(value) for name in renewed["actuator"]}
            ),
            stops=_with(self.stops, {name: self.stops[name].with_dimensions(value) for name in renewed["stop"]}),
            gravity=(value("gravity.x"), value("gravity.y")),
            cycle=None if self.cycle is None else self.cycle.with_dimensions(value),
            path=None
            if self.path is None
            else self.path.with_dimensions(lambda name: value(f"path.{name}"), parameters),
            run=None if self.run is None else self.run.with_dimensions(value),
            construction=None if self.construction is None else self.construction.with_dimensions(value),
            parameters=_with(self.parameters, parameters),
            expressions=self.expressions if same else unchanged,
        )
        if led:
            changed._lead()
        return changed

    def _weigh(self, changes: Mapping[str, float], new: dict[str, float]) -> set[str]:
        """Puts what follows from the shapes of links into ``new`` dimensions, where these change it; the links whose
        mass, inertia or mass centre is itself changed, which then follows no more."""
        if not self._derived:
            return set()
        from linkwright.mechanism.mass_from_shape import ENDS, mass_of, sources

        given = {self._derived[each] for each in changes if each in self._derived}
        for name in dict.fromkeys(self._derived.values()):
            known = self._dimensions
            if name not in given and any(new[each] != known[each] for each in sources(self, name)):
                found = mass_of(self, name, new.__getitem__)
                new.update({f"{name}{end}": float(each) for end, each in zip(ENDS, found, strict=True)})
        return given

    @cached_property
    def _derived(self) -> Mapping[str, str]:
        """Addresses of what follows from the shapes of links, with the names of the links."""
        if not any(link.mass_from_shape for link in self.links.values()):
            return {}
        from linkwright.mechanism.mass_from_shape import derived_addresses

        return derived_addresses(self)

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
        own = (links, self.joints, self.drivers, self.loads, self.actuators, self.stops)
        return dict(zip(_SORTS, own, strict=True))

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
        return FrozenDict({name: each for name, each in self.joints.items() if isinstance(each, TurningJoint)})

    @cached_property
    def guides(self) -> Mapping[str, SlidingJoint]:
        """The joints along which blocks slide."""
        return FrozenDict({name: each for name, each in self.joints.items() if isinstance(each, SlidingJoint)})

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

    @cached_property
    def cylinder_parts(self) -> Mapping[str, str]:
        """The links of which drivers between two points are made, with the names of these drivers."""
        cylinders = [each for each in self.drivers.values() if each.cylinder is not None]
        return FrozenDict({link: each.name for each in cylinders for link in (each.relative_to, each.link)})

    def pin_links(self, name: str) -> tuple[str, ...]:
        """The links on the pin of that name; none where there is no such pin."""
        joint = self.joints.get(name)
        return joint.joined if joint is not None and joint.coordinate == "turn" else ()

    def translate(self, language: str) -> Mechanism:
        """The same with name, purpose and source in a language, where the file gives them in several."""
        texts = {"name": self.name, "purpose": self.purpose, "source": self.source}
        translated_texts = {key: in_language(text, language) for key, text in texts.items()}
        return self if translated_texts == texts else self._changed({}, **translated_texts)

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
            raise RequestError(no_such(_("link"), name, ["frame", *self.links]))
        return self.links[name]

    @cached_property
    def size(self) -> float:
        """A power of two in metres, not below the largest coordinate, offset or stroke.

        A power of two, so that dividing by it does not round, and so that small changes of a design do not change it.
        """
        reach = [link.reach for link in (self.frame, *self.links.values())]
        reach += [abs(c) for point in self.drawing.values() for c in point]
        reach += [abs(getattr(joint, "offset", 0.0)) for joint in self.joints.values()]
        for driver in self.drivers.values():
            if self.joints[driver.joint].coordinate == "slide":
                reach.append(abs(driver.law.own.at(0.0)))
        largest = max(reach)
        return 2.0 ** math.frexp(largest)[1] if largest > 0.0 else 1.0

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
        if self.path is not None:
            found.update({f"path.{name}": value for name, value in self.path.dimensions().items()})
        if self.run is not None:
            found.update(self.run.dimensions())
        if self.construction is not None:
            found.update(self.construction.dimensions())
        return found

    def _unknown(self, address: str) -> LinkwrightError:
        offer = nearest(str(address), self._dimensions)
        hint = _('did you mean "{offer}"?', offer=offer) if offer else _("see the addresses in dimensions()")
        return LinkwrightError(
            _(
                'the mechanism has no dimension "{address}"; {hint}',
                code="model.no_dimension",
                address=address,
                hint=hint,
            )
        )

    def _checked(self, address: str, value: float) -> float:
        if address not in self._dimensions:
            raise self._unknown(address)
        try:
            value = float(value)
        except (TypeError, ValueError):
            raise RequestError(
                _(
                    "{address}: invalid number {text}; give its SI value, such as 0.05 for 50 mm",
                    code="model.set_no_number",
                    address=address,
                    text=repr(value)[:60],
                )
            ) from None
        if not math.isfinite(value):
            raise RequestError(
                _(
                    "{address} is set to {value}; give a finite number",
                    code="model.set_not_finite",
                    address=address,
                    value=value,
                )
            )
        if abs(value) > LARGEST_OF_ALL:
            raise RequestError(
                _(
                    "{address} is set to {value:g}, which is more than any machine has; check the number",
                    code="model.set_beyond",
                    address=address,
                    value=value,
                )
            )
        sort, name = self._owners.get(address, ("", ""))
        if sort == "joint":
            limit = self.joints[name].limit(address, value)
        else:
            limit = None if (field := self.declared(address)) is None else field.limit(value)
        if limit is not None:
            unit = SI_UNITS.get(getattr(self.declared(address), "dimension", ""), "")
            shown_value = f"{value:g} {unit}".rstrip()
            raise RequestError(
                _(
                    "{address} is set to {value}; give {limit}",
                    code="model.set_outside",
                    address=address,
                    value=shown_value,
                    limit=limit,
                )
            )
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
