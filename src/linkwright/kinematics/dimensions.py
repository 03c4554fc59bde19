"""Dimensions of a mechanism and coordinates of its drivers: as numbers of one design, and as traced values."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass
from math import cos as cosine
from math import sin as sine
from typing import TYPE_CHECKING

from linkwright.core.inputs import Input, mode_inputs
from linkwright.drivers.base import Driver
from linkwright.elements import TreeJoint
from linkwright.errors import LinkwrightError
from linkwright.formula.differentiation import Symbols
from linkwright.formula.late_import import numpy as np
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, Trace, absolute, cos, select, sin, sqrt
from linkwright.kinematics.equation import ChainPair
from linkwright.mechanism.link import Link, centre, local_points
from linkwright.mechanism.mass_from_shape import ENDS, derived_addresses, outline_sources, sources, traced_mass
from linkwright.mechanism.mechanism import Mechanism

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats


class Dimensions:
    """Gives every dimension as a parameter of the trace.

    A dimension that is zero in the mechanism, and not among the ``free`` ones that are going to vary, is a
    known zero, so that what it multiplies is never computed. ``pairs``: chains' joints traced with them.
    """

    def __init__(self, mechanism: Mechanism, trace: Trace, free: Set[str] = frozenset()) -> None:
        self.mechanism = mechanism
        self.trace = trace
        self.free = free
        self.nominal = mechanism.dimensions()
        self._points: dict[str, dict[str, Vec]] = {}
        self._varying = _varying(mechanism, free)
        links = weighed_anew(mechanism, self._varying, free)
        self._weighed = {f"{name}{end}": name for name in links for end in ENDS}
        self._varying |= self._weighed.keys()
        self._masses: dict[str, dict[str, Scalar]] = {}
        self._parameters: dict[str, Scalar] = {}
        self.symbols = Symbols(trace)
        self.pairs: dict[TreeJoint, ChainPair] = {}

    def __call__(self, address: str) -> Scalar:
        """The dimension at an address (``crank.length``)."""
        link = self._weighed.get(address)
        if link is not None:
            return self._mass(link)[address]
        expression = self.mechanism.expressions.get(address)
        if expression is not None and address not in self.free and self._follows(address):
            return self._from_expression(address)
        if self.nominal[address] == 0.0 and address not in self.free:
            return 0.0
        return self.trace.parameter(address)

    def _follows(self, address: str) -> bool:
        """Whether a dimension is an expression of something that varies."""
        return address in self._varying

    def _from_expression(self, address: str) -> Scalar:
        """The traced value of an expression; parameters that follow others are traced in their order, once."""
        expressions = self.mechanism.expressions
        waiting, needed = [address], set[str]()
        while waiting:
            for name in expressions[waiting.pop()].names:
                if self._follows(name) and not (name in self.free or name in needed or name in self._parameters):
                    needed.add(name)
                    waiting.append(name)
        parameters = filter(needed.__contains__, self.mechanism.parameters if needed else ())
        found: Scalar = 0.0
        for name in (*parameters, address):
            expression = expressions[name]
            found = expression.over({each: self._parameter(each) for each in expression.names})
            if name in needed:
                self._parameters[name] = found
        return found

    def _parameter(self, name: str) -> Scalar:
        return self._parameters[name] if name in self._parameters else self(name)

    def _mass(self, link: str) -> dict[str, Scalar]:
        """Mass, inertia and mass centre of a link whose shape or sizes vary, by their addresses."""
        if link not in self._masses:
            moved = not self._varying.isdisjoint(outline_sources(self.mechanism, link))
            found = traced_mass(self.mechanism, link, self, moved=moved)
            self._masses[link] = {f"{link}{end}": value for end, value in zip(ENDS, found, strict=True)}
        return self._masses[link]

    def link(self, name: str) -> Link:
        """A link by name, the frame included."""
        return self.mechanism.frame if name == "frame" else self.mechanism.links[name]

    def point(self, link: str, point: str) -> Vec:
        """A point of a link, in the link's axes."""
        if link not in self._points:
            found = local_points(self.link(link), self, cos, sin)
            self._points[link] = {name: Vec(x, y) for name, (x, y) in found.items()}
        return self._points[link][point]

    def distance(self, link: str, a: str, b: str) -> Scalar:
        """Distance of two points of a link."""
        return sqrt((self.point(link, b) - self.point(link, a)).square)

    def centre(self, link: str) -> Vec:
        """The mass centre of a link, in the link's axes."""
        first = next(iter(self.link(link).points))
        self.point(link, first)
        x, y = centre(self.link(link), {n: (v.x, v.y) for n, v in self._points[link].items()}, self)
        return Vec(x, y)

    def unit(self, address: str) -> Vec:
        """Unit vector at an angle that is a dimension; exact where that is fixed at a quarter of a turn."""
        angle = self(address)
        if not isinstance(angle, float) and not self._follows(address):
            turns = round(self.nominal[address] / (0.5 * _PI))
            if self.nominal[address] == turns * 0.5 * _PI:
                return _QUARTERS[turns % 4]
        if isinstance(angle, float):
            return Vec(cosine(angle), sine(angle))
        return Vec(cos(angle), sin(angle))


def _varying(mechanism: Mechanism, free: Set[str]) -> set[str]:
    """Every dimension that is free or follows a free one; an expression uses only parameters that stand before it."""
    found = set(free)
    for address, expression in mechanism.expressions.items():
        if address not in free and not found.isdisjoint(expression.names):
            found.add(address)
    return found


def weighed_anew(mechanism: Mechanism, varying: Set[str], free: Set[str]) -> list[str]:
    """The links whose mass follows from a shape or from sizes that vary, and is not free itself."""
    names = dict.fromkeys(derived_addresses(mechanism).values())
    return [
        name
        for name in names
        if free.isdisjoint(f"{name}{end}" for end in ENDS) and not varying.isdisjoint(sources(mechanism, name))
    ]


_PI = 3.141592653589793
_QUARTERS = (Vec(1.0, 0.0), Vec(0.0, 1.0), Vec(-1.0, 0.0), Vec(0.0, -1.0))


@dataclass(frozen=True)
class DriverInput:
    """A driver's coordinate in the program: ``turn`` (cosine, sine) or ``slide``, with its rates."""

    turn: Vec | None
    slide: Scalar | None
    rate: Scalar
    second: Scalar


def driver_input(driver: Driver, dimensions: Dimensions) -> DriverInput:
    """Inputs named ``cos:NAME``, ``sin:NAME`` or ``slide:NAME``, and ``rate:NAME``, ``second:NAME``.

    A constant speed is a dimension of the design, its rate needs no input per position.
    """
    trace = dimensions.trace
    if driver.law.constant_speed is not None:
        rate: Scalar = trace.parameter(f"{driver.name}.speed")
        second: Scalar = 0.0
    else:
        rate = trace.position(Input("rate", driver.name).name)
        second = trace.position(Input("second", driver.name).name)
    if dimensions.mechanism.joints[driver.joint].coordinate == "turn":
        return DriverInput(turned(driver.name, trace), None, rate, second)
    return DriverInput(None, trace.position(Input("slide", driver.name).name), rate, second)


def turned(name: str, trace: Trace) -> Vec:
    """Cosine and sine of a driver's angle."""
    return Vec(trace.position(Input("cos", name).name), trace.position(Input("sin", name).name))


class Design:
    """A mechanism, perhaps with changed dimensions, and the signs of its assembly modes."""

    __slots__ = ("_mechanism", "_parameters", "base", "changes", "modes")

    def __init__(self, base: Mechanism, modes: Mapping[str, float], changes: Mapping[str, float]) -> None:
        self.base = base
        self.modes = modes
        self.changes = changes
        self._mechanism: Mechanism | None = None
        self._parameters: dict[str, float] | None = None

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism with the changes made."""
        if self._mechanism is None:
            self._mechanism = self.base.with_dimensions(self.changes) if self.changes else self.base
        return self._mechanism

    @property
    def parameters(self) -> dict[str, float]:
        """Values of all parameters of the programs: dimensions, signs of the assembly modes, paces."""
        if self._parameters is None:
            known = self.mechanism
            self._parameters = {**known.dimensions(), **mode_inputs(self.modes), **paces(known)}
        return self._parameters


#: Share of the drivers' largest rate up to which a rate is rounding, where something reverses.
ROUNDING = 1e-14
#: The same where its own rate is not above the second share of the largest one's square: what is at rest.
STANDING, STEADY = 1e-10, 1e-8
#: Times of a driver's law among which its largest rate is sought, and of a law that has no duration, s, how long.
LOOKS, WHILE = 361, 1.0


def pace_name(dimension: str) -> str:
    """Name of the parameter that holds the drivers' largest rate, of an ``angle`` (rad/s) or a ``length`` (m/s)."""
    return f"pace:{dimension}"


def paces(mechanism: Mechanism) -> dict[str, float]:
    """These parameters; one follows from the other by the size of the mechanism."""
    size, fastest = mechanism.size, 0.0
    for driver in mechanism.drivers.values():
        fastest = max(fastest, _pace(driver, mechanism) / (1.0 if driver.law.rotary else size))
    return {pace_name("angle"): fastest, pace_name("length"): fastest * size}


def moving(rate: Scalar, second: Scalar, pace: Scalar, turning: Scalar) -> Scalar:
    """A rate with its own rate ``second``, zero at rest; ``pace``: the largest one of its dimension, ``turning``: of
    angles, rad/s."""
    steady = absolute(second) <= STEADY * pace * turning
    rest = select(steady, STANDING * pace, ROUNDING * pace)
    return select(absolute(rate) <= rest, 0.0, rate)


def _pace(driver: Driver, mechanism: Mechanism) -> float:
    """The largest rate of a driver, rad/s or m/s, within its law or the mechanism's cycle."""
    law = driver.law
    if law.constant_speed is not None:
        return abs(law.constant_speed)
    first, last = law.span()
    if not np.isfinite([first, last]).all():
        cycle = mechanism.cycle
        first, last = 0.0, law.natural_duration() or (cycle and cycle.duration) or WHILE
    time = np.union1d(np.linspace(first, last, LOOKS), law.breaks(first, last))
    try:
        with np.errstate(all="ignore"):
            rate: Floats = np.abs(law.coordinate(time)[1])
    except LinkwrightError:
        return 0.0
    return float(rate[np.isfinite(rate)].max(initial=0.0))
