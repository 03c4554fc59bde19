"""How loads see a mechanism whose inputs are free: phases go by where the input is and which way it moves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.signals import BetweenLimits
from linkwright.applied_loads.strokes import TURN, outermost, strokes
from linkwright.core.inputs import Input
from linkwright.drivers.base import Driver
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.free import Free
from linkwright.dynamics.stops import contact
from linkwright.errors import LinkwrightError
from linkwright.formula.differentiation import slope
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.table import Table
from linkwright.formula.trace import Scalar, angle, nearest_turn, select, sqrt
from linkwright.kinematics.solve import solve_motion
from linkwright.kinematics.trace import MotionOutputs, MotionTrace
from linkwright.kinetostatics.load_site import TracedSite, limit_name, sense_name, value_name
from linkwright.kinetostatics.signals import MotionSignals, numbers_of_loads
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: A slide never comes round: so many times the size of its machine.
_FAR = 1e6
#: Way of a point per unit of the input, over the size of the machine, that is none.
_DEAD = 1e-12


class FreeSite(TracedSite):
    """View of one load of a mechanism whose first driver moves as forces will have it, to and fro.

    A phase between two limits of an output is where the input is between them, going from the one to the other.
    """

    @property
    def sense(self) -> Scalar:
        return select(coordinate_of(self.motion, self.drivers[0])[1] >= 0.0, 1.0, -1.0)

    @property
    def heading(self) -> Scalar:
        return self.sense

    @property
    def along(self) -> Scalar:
        return self.input

    @property
    def lap(self) -> Scalar:
        return TURN if self.rotary else _FAR * self.motion.mechanism.size

    def share_of_input(self, phase: BetweenLimits, share: Scalar) -> Scalar:
        return share

    def heading_of(self, link: str, point: str) -> Vec:
        """By the velocity per rate of the only input, so that there is one on both sides of rest too."""
        if len(self.motion.drivers) != 1:
            return super().heading_of(link, point)
        rate = self.motion.trace.position(Input("rate", next(iter(self.motion.drivers))).name)
        velocity = self.velocity(link, point)
        way = Vec(slope(velocity.x, {rate: 1.0}), slope(velocity.y, {rate: 1.0}))
        moves = way.square > (_DEAD * self.motion.mechanism.size) ** 2
        size = select(moves, 1.0 / sqrt(select(moves, way.square, 1.0)), 0.0)
        return way * (size * select(rate > 0.0, 1.0, select(rate < 0.0, -1.0, 0.0)))


class ModelSite(FreeSite):
    """The same where other joints than those of the model's ``drivers`` are the coordinates: the loads go by the
    model's."""

    def __init__(self, drivers: tuple[Driver, ...], motion: MotionTrace, load: Load, **manner: bool) -> None:
        super().__init__(motion, load, **manner)
        self._drivers = drivers

    @property
    def drivers(self) -> tuple[Driver, ...]:
        return self._drivers

    @property
    def input(self) -> Scalar:
        return coordinate_of(self.motion, self.drivers[0])[0]


@dataclass(frozen=True)
class SeenFromModel:
    """Makes these views; equal for drivers that differ in numbers only."""

    drivers: tuple[Driver, ...]

    @classmethod
    def of(cls, mechanism: Mechanism) -> SeenFromModel:
        """Those of a model's loads."""
        drivers = mechanism.drivers.values()
        return cls(tuple(replace(each, law=Free(0.0, 0.0, each.law.rotary)) for each in drivers))

    def __call__(self, motion: MotionTrace, load: Load, **manner: bool) -> ModelSite:
        return ModelSite(self.drivers, motion, load, **manner)


def near_name(driver: str) -> str:
    """Name of the input near which, within half a turn, a driver's angle is where another joint is the coordinate."""
    return f"near:{driver}"


def coordinate_of(motion: MotionTrace, driver: Driver) -> tuple[Scalar, Scalar]:
    """The coordinate of a driver's joint, rad or m, and its rate, whether the motion goes by it or not."""
    if driver.name in motion.drivers:
        own = Input("turn" if driver.law.rotary else "slide", driver.name)
        return motion.trace.position(own.name), motion.drivers[driver.name].rate
    if not driver.law.rotary:
        place, rate, _second = MotionOutputs(motion).slide(driver.joint)
        return place, rate
    a, b = motion.states[driver.relative_to], motion.states[driver.link]
    along, e = a.pose.direction, b.pose.direction
    near = motion.trace.position(near_name(driver.name))
    return nearest_turn(angle(along.cross(e), along.dot(e)), near), b.omega - a.omega


def freed(mechanism: Mechanism) -> Mechanism:
    """The mechanism with its drivers' coordinates free, its actuators and what its stops do among its loads.

    A constant speed would be folded into the programs, so that the coordinate's second derivative were known. One
    that follows a path begins as it is at the path's beginning.
    """
    mechanism = mechanism.posed
    drivers = {name: _free(each) for name, each in mechanism.drivers.items()}
    stops = (contact(stop) for stop in mechanism.stops.values())
    loads: Mapping[str, Load] = {**mechanism.loads, **mechanism.actuators, **{each.name: each for each in stops}}
    return replace(mechanism, drivers=drivers, loads=loads, actuators={}, run=None, cycle=None)


def _free(driver: Driver) -> Driver:
    law = driver.law.own
    if isinstance(law, Free):
        return replace(driver, law=law)
    return replace(driver, law=Free(law.at(0.0), law.constant_speed or 0.0, law.rotary))


def load_numbers(mechanism: Mechanism) -> tuple[dict[str, float], dict[str, Table]]:
    """What the loads of a freed mechanism take besides dimensions: numbers by the names of parameters, and tables.

    Raises:
        LinkwrightError: a load goes by limits that an output does not have over the input's range, or by the angle of
            a link that turns through.
    """
    along = numbers_of_loads(mechanism.loads.values(), mechanism)
    numbers = dict(along.constants)
    for name, driver in mechanism.drivers.items():
        nominal = driver.law.nominal if isinstance(driver.law, Free) else driver.law.constant_speed or 0.0
        numbers[sense_name(name)] = -1.0 if nominal < 0.0 else 1.0
    if along.outputs or along.angles:
        signals = _signals(mechanism)
        for load in mechanism.loads.values():
            phase = load.magnitude.limits
            if phase is not None:
                numbers |= _limits(phase, signals)
        middles = along.middles(signals)
        if middles is None:
            raise LinkwrightError(
                _(
                    "a load of {name!r} goes by the angle of a link that turns through, which has no value of its "
                    "own in motion under forces; let it go by the input",
                    code="dynamics.angle_of_turning_link",
                    name=mechanism.name,
                )
            )
        numbers |= middles
    return numbers, dict(along.tables)


def _signals(mechanism: Mechanism) -> MotionSignals:
    """The motion in which limits are found: the first input at constant speed, the others at rest."""
    speed, drivers = 1.0, {}
    for name, driver in mechanism.drivers.items():
        drivers[name] = replace(driver, law=ConstantSpeed(speed, driver.law.at(0.0), driver.law.rotary))
        speed = 0.0
    bare = replace(mechanism, drivers=drivers, loads={})
    return MotionSignals(solve_motion(bare, failures="mark"))


def _limits(phase: BetweenLimits, signals: MotionSignals) -> dict[str, float]:
    """Where an output has its largest and its smallest value, rad or m of the input, and these values."""
    strokes(phase, signals)
    found = {}
    for kind in ("max", "min"):
        limit = next(each for each in outermost(signals.limits(phase.output)) if each.kind == kind)
        found[limit_name(phase.output, kind)] = limit.input
        found[value_name(phase.output, kind)] = limit.value
    return found
