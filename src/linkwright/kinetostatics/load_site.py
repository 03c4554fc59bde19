"""The mechanism as a load sees it, over a traced motion."""

from __future__ import annotations

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.signals import BetweenLimits, place_named
from linkwright.applied_loads.strokes import moving_of_turn, share_of, stroke_of_turn
from linkwright.core.outputs import Output, row_name
from linkwright.drivers.base import Driver
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.trace import Mask, Scalar, angle, cos, select, sign, sin, sqrt
from linkwright.kinematics.trace import MotionOutputs, MotionTrace
from linkwright.mechanism.mechanism import Mechanism


def turns_steadily(mechanism: Mechanism) -> bool:
    """Whether the only driver turns at constant speed, so that limits are found over its input, else the time."""
    drivers = list(mechanism.drivers.values())
    return len(drivers) == 1 and drivers[0].law.rotary and bool(drivers[0].law.constant_speed)


def limit_name(output: object, kind: str) -> str:
    """Name of the parameter that holds the input, or the time, of an output's limit."""
    return f"limit:{output}:{kind}"


def limit_input_name(output: object, kind: str) -> str:
    """Name of the parameter that holds the first driver's coordinate where an output has a limit, found over time."""
    return f"limit input:{output}:{kind}"


#: The parameter that is how far the input turns in a closed cycle, rad; of limits found over the time how long the
#: cycle is, s, twice as long where it does not close. What the first driver's coordinate gains in it, rad or m.
LAP, DRIFT = "lap of the input", "drift of the input"
#: Before the name of a load whose magnitude is traced, but for its phase, which is known per position.
ACTS = "acts"


def acts_name(load: str) -> str:
    """Name of such a load, and of the input that tells whether it acts."""
    return f"{ACTS}:{load}"


def sense_name(driver: str) -> str:
    """Name of the parameter that is the sign of a driver's nominal speed."""
    return f"sense:{driver}"


def constant_name(load: str, field: str) -> str:
    """Name of the parameter that holds a number of a load that is no dimension."""
    return f"constant:{load}:{field}"


def value_name(output: object, kind: str) -> str:
    """Name of the parameter that holds an output at its limit."""
    return f"value:{output}:{kind}"


def middle_name(a: str, b: str) -> str:
    """Name of the parameter near which, within half a turn, the angle of link b against link a stays."""
    return f"middle:{a}|{b}"


def angle_between(motion: MotionTrace, a: str, b: str) -> Scalar:
    """Angle of link b against link a, rad, for links that do not turn through: near a known middle."""
    middle = motion.trace.parameter(middle_name(a, b))
    from_a, c, s = motion.poses[a].direction, cos(middle), sin(middle)
    e = motion.poses[b].direction
    along, across = from_a.dot(e), from_a.cross(e)
    return middle + angle(across * c - along * s, along * c + across * s)


def output_value(motion: MotionTrace, output: Output) -> Scalar:
    """An output as a traced value; an angle that of a link that does not turn through."""
    if output.kind == "angle":
        return angle_between(motion, "frame", output.owner)
    return MotionOutputs(motion).value(output.row)


def guide_state(motion: MotionTrace, joint: str) -> tuple[Vec, Vec, Scalar]:
    """Of a prismatic joint: the guide's unit vector, the block's point, the sliding velocity."""
    prismatic = motion.mechanism.guides[joint]
    guide, block = motion.states[prismatic.guide], motion.states[prismatic.block]
    direction = guide.pose.spin(prismatic.slide_direction(motion.dimensions))
    at = motion.dimensions.point(prismatic.block, prismatic.at)
    place = block.pose.place + block.arm(at)
    relative = block.velocity_of(at) - guide.velocity_at(place - guide.pose.place)
    return direction, place, direction.dot(relative)


class TracedSite:
    """View of one load; see :class:`linkwright.applied_loads.site.Site`,
    :class:`linkwright.applied_loads.signals.Course` and :class:`linkwright.applied_loads.strokes.Turning`.

    ``along_input``: the magnitude is traced, with ``phase_known`` all but its phase; else one that varies is an input
    of the program per position. ``inertia`` False: accelerations count as zero.
    """

    def __init__(
        self,
        motion: MotionTrace,
        load: Load,
        *,
        along_input: bool = False,
        phase_known: bool = False,
        inertia: bool = True,
    ) -> None:
        self.motion = motion
        self.load = load
        self.along_input = along_input
        self.phase_known = phase_known
        self.inertia = inertia

    @property
    def drivers(self) -> tuple[Driver, ...]:
        """The drivers by whose coordinates and senses loads go."""
        return tuple(self.motion.mechanism.drivers.values())

    @property
    def time(self) -> Scalar:
        return self.motion.trace.position("time")

    def place(self, link: str, point: str) -> Vec:
        state = self.motion.states[link]
        return state.pose.place + state.arm(self.motion.dimensions.point(link, point))

    def distance(self, link: str, a: str, b: str) -> Scalar:
        return self.motion.dimensions.distance(link, a, b)

    def velocity(self, link: str, point: str) -> Vec:
        state = self.motion.states[link]
        return state.velocity_of(self.motion.dimensions.point(link, point))

    def axis(self, link: str) -> Vec:
        return self.motion.states[link].pose.direction

    def omega(self, link: str) -> Scalar:
        return self.motion.states[link].omega

    def turning(self, link: str, against: str) -> Scalar:
        return self.motion.turning(link, against)

    def turning_second(self, link: str, against: str) -> Scalar:
        return self.motion.states[link].alpha - self.motion.states[against].alpha if self.inertia else 0.0

    def sliding_second(self, joint: str) -> Scalar:
        return MotionOutputs(self.motion).slide(joint)[2] if self.inertia else 0.0

    def drive_sense(self, link: str, against: str) -> Scalar:
        for driver in self.drivers:
            if {link, against} == {driver.link, driver.relative_to}:
                own = self.motion.trace.parameter(sense_name(driver.name))
                return own if link == driver.link else -own
        return 1.0

    def heading_of(self, link: str, point: str) -> Vec:
        velocity = self.velocity(link, point)
        local = self.motion.dimensions.point(link, point)
        seconds = self.motion.states[link].acceleration_of(local)
        moves = self.motion.moving(sqrt(velocity.square), sqrt(seconds.square), "length") > 0.0
        return velocity * select(moves, 1.0 / sqrt(select(moves, velocity.square, 1.0)), 0.0)

    def guide(self, joint: str) -> tuple[Vec, Vec, Scalar]:
        return guide_state(self.motion, joint)

    def dimension(self, field: str) -> Scalar:
        return self.motion.dimensions(f"{self.load.section}.{self.load.name}.{field}")

    def magnitude(self) -> Scalar:
        own, field = self.load.magnitude, self.motion.trace.field_input
        if not (self.along_input or own.constant):
            return field(row_name("magnitude", self.load.name))
        if self.phase_known:
            acts, share = field(acts_name(self.load.name)), field(f"share:{self.load.name}")
            return select(acts > 0.5, own.size.at(self, share), 0.0)
        return own.at(self)

    @property
    def input(self) -> Scalar:
        return self.motion.trace.position("input")

    @property
    def rotary(self) -> bool:
        return self.drivers[0].law.rotary

    @property
    def heading(self) -> Scalar:
        """Its constant rate; where it has none, phases do not ask for its sign."""
        driver = next(iter(self.motion.mechanism.drivers.values()))
        steady = driver.law.constant_speed is not None
        return self.motion.trace.parameter(f"{driver.name}.speed") if steady else 1.0

    def named(self, name: str) -> Scalar:
        if name in self.motion.mechanism.parameters:
            return self.motion.dimensions(name)
        if name in ("t", "input"):
            return self.input if name == "input" else self.motion.trace.position("time")
        found = place_named(name, self.motion.mechanism)
        assert found is not None
        return self.output(found)

    def output(self, output: Output) -> Scalar:
        return output_value(self.motion, output)

    def angle_between(self, a: str, b: str, near: float) -> Scalar:
        return angle_between(self.motion, a, b)

    def stroke(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        return stroke_of_turn(self, phase)

    def moving(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        between, share = moving_of_turn(self, phase) if ramp else (True, 0.0)
        if ramp and turns_steadily(self.motion.mechanism):
            return between, share
        rate, second = (MotionOutputs(self.motion).value(each.row) for each in phase.output.course[1:])
        rate = rate if ramp else self.motion.moving(rate, second, phase.output.dimension)
        grows = rate > 0.0 if phase.end == "max" else rate < 0.0
        return self.motion.trace.logic("and", between, grows), share

    def constant(self, field: str) -> Scalar:
        return self.motion.trace.parameter(constant_name(self.load.name, field))

    def lookup(self, x: Scalar) -> Scalar:
        return self.motion.trace.lookup(row_name("magnitude", self.load.name), x)

    def limit_value(self, output: Output, kind: str) -> Scalar:
        return self.motion.trace.parameter(value_name(output, kind))

    @property
    def along(self) -> Scalar:
        steady = turns_steadily(self.motion.mechanism)
        return self.input if steady else self.motion.trace.position("time")

    @property
    def sense(self) -> Scalar:
        return sign(self.heading) if turns_steadily(self.motion.mechanism) else 1.0

    @property
    def lap(self) -> Scalar:
        return self.motion.trace.parameter(LAP)

    def share_of_input(self, phase: BetweenLimits, share: Scalar) -> Scalar:
        if next(iter(self.motion.mechanism.drivers.values())).law.constant_speed:
            return share
        parameter, kinds = self.motion.trace.parameter, (phase.start, phase.end)
        begin, end = (parameter(limit_input_name(phase.output, kind)) for kind in kinds)
        since, until = (self.limit(phase.output, kind) for kind in kinds)
        drift = parameter(DRIFT)
        gained = self.input + select(self.along < since, drift, 0.0) - begin
        return share_of(gained / (end + select(until < since, drift, 0.0) - begin))

    def limit(self, output: Output, kind: str) -> Scalar:
        return self.motion.trace.parameter(limit_name(output, kind))

    def direction(self, angle: Scalar) -> Vec:
        return Vec(cos(angle), sin(angle))


class RestingSite(TracedSite):
    """The same view of a mechanism that stands still in its positions: nothing has a rate, only directions of motion
    stay."""

    def velocity(self, link: str, point: str) -> Vec:
        return ZERO

    def omega(self, link: str) -> Scalar:
        return 0.0

    def turning(self, link: str, against: str) -> Scalar:
        return 0.0

    def heading_of(self, link: str, point: str) -> Vec:
        velocity = super().velocity(link, point)
        moves = velocity.square > 0.0
        return velocity * select(moves, 1.0 / sqrt(select(moves, velocity.square, 1.0)), 0.0)

    def guide(self, joint: str) -> tuple[Vec, Vec, Scalar]:
        direction, place, _rate = super().guide(joint)
        return direction, place, 0.0
