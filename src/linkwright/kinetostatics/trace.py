"""Joint forces and driver efforts of a mechanism, traced group by group in reverse solving order, by name.

For every link the demand is what joints must supply: m (a - g) minus the applied loads, and the moment of
that about the link's anchor. In a group Jᵀ λ = Q gives the forces λ at the cuts from the demands Q on the
chain coordinates; then every link's balance, from the ends of the chains inwards, gives the force at the
joint that carries it (d'Alembert; Artobolevsky, Theory of Mechanisms and Machines, kinetostatics of groups).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Set
from dataclasses import dataclass, field
from functools import cached_property, partial

from linkwright.applied_loads.site import Wrench
from linkwright.core.outputs import Output, row_name, row_names
from linkwright.elements import Connection, TreeJoint
from linkwright.formula.linear_algebra import ZERO, Vec, product, transposed
from linkwright.formula.trace import Scalar, absolute
from linkwright.joints.pose import Pose
from linkwright.kinematics.equation import Equation
from linkwright.kinematics.groups import Placed, pair_of
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.load_site import TracedSite, acts_name

#: The size of the force between the teeth of a pair, from that force.
Size = Callable[[Connection, Scalar], Scalar]


@dataclass(frozen=True)
class Demand:
    """Force (N) and moment (N·m, about the link's anchor) that joints must supply to a link."""

    force: Vec = ZERO
    moment: Scalar = 0.0

    def __add__(self, other: Demand) -> Demand:
        return Demand(self.force + other.force, self.moment + other.moment)


@dataclass(frozen=True)
class JointForce:
    """What one pair of links exchanges: ``force`` on link ``on`` at the joint's place, and a couple."""

    connection: Connection
    on: str
    force: Vec
    couple: Scalar


@dataclass
class ForceTrace:
    """Reactions and efforts as traced values.

    By the names of joints ``multipliers``, the forces of higher pairs, and ``between``, those between teeth or in
    strands whose sizes press on pins; ``left``: what a balance wants along the coordinate by which a joint leaves a
    link free, N or N·m, by joint and link: zero but for rounding, for no joint can supply it.
    """

    motion: MotionTrace
    joints: list[JointForce] = field(default_factory=list)
    efforts: dict[str, Scalar] = field(default_factory=dict)
    own: dict[str, Demand] = field(default_factory=dict)
    wrenches: dict[str, list[Wrench]] = field(default_factory=dict)
    between: dict[str, Scalar] = field(default_factory=dict)
    multipliers: dict[str, Scalar] = field(default_factory=dict)
    left: dict[tuple[str, str], Scalar] = field(default_factory=dict)

    def reaction(self, joint: str, on: str) -> Vec:
        """Force that a joint exerts on a link."""
        total = ZERO
        for each in self.joints:
            if each.connection.joint == joint and on in (each.connection.a, each.connection.b):
                total = total + each.force if each.on == on else total - each.force
        return total

    def couple(self, joint: str, on: str) -> Scalar:
        """Couple that a guide or a weld exerts on a link, about the block's point or the weld."""
        total: Scalar = 0.0
        for each in self.joints:
            if each.connection.joint == joint and on in (each.connection.a, each.connection.b):
                total = total + each.couple if each.on == on else total - each.couple
        return total

    @property
    def power(self) -> Scalar:
        """Power that the drivers must supply, from the powers of all inertia forces, weights and loads."""
        total: Scalar = 0.0
        for link, demand in self.own.items():
            state = self.motion.states[link]
            total = total + demand.force.dot(state.velocity) + demand.moment * state.omega
        return total

    @property
    def friction_power(self) -> Scalar:
        """Power that the friction of joints takes."""
        total: Scalar = 0.0
        loads = self.motion.mechanism.loads
        for wrench in (w for name, group in self.wrenches.items() if name not in loads for w in group):
            state = self.motion.states[wrench.link]
            moment = (wrench.place - state.pose.place).cross(wrench.force) + wrench.torque
            total = total - wrench.force.dot(state.velocity) - moment * state.omega
        return total

    @property
    def driver_power(self) -> Scalar:
        """Power of the efforts found from the joint forces."""
        total: Scalar = 0.0
        for name, effort in self.efforts.items():
            total = total + effort * self.motion.drivers[name].rate
        return total


def trace_forces(
    motion: MotionTrace,
    *,
    inertia: bool,
    extra: Mapping[str, list[Wrench]] | None = None,
    along_input: Set[str],
    size: Size = lambda _, force: absolute(force),
    site: Callable[..., TracedSite] = TracedSite,
) -> ForceTrace:
    """Traces all joint forces of a traced motion.

    ``inertia`` False leaves the inertia forces out (static analysis); ``extra``: further wrenches by name, such
    as the friction of joints; ``along_input``: loads whose magnitude is traced over the input; ``size``: of the force
    between the teeth of a pair; ``site``: how loads see the mechanism.
    """
    forces = ForceTrace(motion)
    for name, load in motion.mechanism.loads.items():
        partly = acts_name(name) in along_input
        seen = site(motion, load, along_input=partly or name in along_input, phase_known=partly, inertia=inertia)
        forces.wrenches[name] = list(load.wrenches(seen))
    forces.wrenches |= extra or {}
    demands = {name: Demand() for name in ("frame", *motion.mechanism.links)}
    for name in motion.mechanism.links:
        demands[name] = forces.own[name] = _own_demand(motion, name, forces, inertia)
    solver = _Reverse(forces, demands, size)
    for placed in reversed(list(motion.placed.values())):
        solver.solve(placed)
    return forces


def _own_demand(motion: MotionTrace, link: str, forces: ForceTrace, inertia: bool) -> Demand:
    state, dimensions = motion.states[link], motion.dimensions
    mass = dimensions(f"{link}.mass")
    gravity = Vec(dimensions("gravity.x"), dimensions("gravity.y"))
    centre = dimensions.centre(link)
    acceleration = state.acceleration_of(centre) if inertia else ZERO
    force = (acceleration - gravity) * mass
    moment = _lever(state.pose, centre, force)
    if inertia:
        moment = moment + dimensions(f"{link}.inertia") * state.alpha
    for wrench in (w for group in forces.wrenches.values() for w in group if w.link == link):
        force = force - wrench.force
        moment = moment - (wrench.place - state.pose.place).cross(wrench.force) - wrench.torque
    return Demand(force, moment)


def _lever(pose: Pose, local: Vec, force: Vec) -> Scalar:
    """Moment about the anchor of a force at a point of the link."""
    share = (local - pose.anchor).over(pose.rotor.local)
    now = pose.rotor.now
    return now.cross(force) * share.x - now.dot(force) * share.y


class _Reverse:
    """Goes through the groups from the last to the first."""

    def __init__(self, forces: ForceTrace, demands: dict[str, Demand], size: Size) -> None:
        self.forces = forces
        self.size = size
        self.motion = forces.motion
        self.demands = demands

    def solve(self, placed: Placed) -> None:
        """Forces of one group; what its links need of links solved before is added to their demands.

        The row of a higher pair takes the other joints as closed: its multiplier is the force of the pair, which
        then loads the open chains like any other force, so that a cut pin carries its part of it as well.
        """
        for higher in (True, False):
            if any(cut.connection.higher is higher for cut in placed.cuts):
                for cut, own in self._shares(placed):
                    if cut.connection.higher is higher:
                        self._apply(cut, own)
        for step in reversed(placed.group.tree):
            self._carry(step)

    def _shares(self, placed: Placed) -> list[tuple[Equation, list[Scalar]]]:
        """Every cut of a group with the multipliers of its own rows that supply what its links demand now."""
        multipliers = product(transposed(placed.inverse), self._wanted(placed))
        found, row = [], 0
        for cut in placed.cuts:
            found.append((cut, multipliers[row : row + cut.rows]))
            row += cut.rows
        return found

    def _size(self, connection: Connection, force: Scalar) -> Scalar:
        self.forces.between[connection.joint] = force
        return self.size(connection, force)

    def _wanted(self, placed: Placed) -> list[Scalar]:
        """Demand on every unknown chain coordinate, with the chains open."""
        open_chains = {link: self.demands[link] for link in placed.group.links}
        wanted: dict[TreeJoint, Scalar] = {}
        for step in reversed(placed.group.tree):
            demand = open_chains[step.child]
            if step.free:
                wanted[step] = self._along(step).dot(demand.force) if step.slides else demand.moment
            if step.parent in open_chains:
                passed = self._moved(demand, step, free_pin=step.free and step.turns)
                open_chains[step.parent] = open_chains[step.parent] + passed
        return [wanted[step] for step in placed.group.unknowns]

    def _along(self, step: TreeJoint) -> Vec:
        """The direction in which a guide's child slides."""
        return pair_of(step, self.motion.dimensions).normal(self.motion.poses[step.parent])

    def _moved(self, demand: Demand, step: TreeJoint, *, free_pin: bool) -> Demand:
        """A child's demand as its parent feels it; through a free pin goes no moment."""
        moment = self._arm_on_parent(step).cross(demand.force)
        return Demand(demand.force, moment if free_pin else moment + demand.moment)

    def _arm_on_parent(self, step: TreeJoint) -> Vec:
        parent, child = self.motion.poses[step.parent], self.motion.poses[step.child]
        if step.turns:
            return pair_of(step, self.motion.dimensions).arm(parent)
        return child.place - parent.place

    def _apply(self, cut: Equation, multipliers: list[Scalar]) -> None:
        """The force at a cut, with what presses there and does no work, supplies part of both links' demand."""
        poses, connection = self.motion.poses, cut.connection
        wrenches = cut.wrenches(multipliers, poses)
        if connection.higher:
            self.forces.multipliers[connection.joint] = multipliers[0]
        for link, (force, moment) in cut.held(multipliers[0], poses, partial(self._size, connection)).items():
            own, about = wrenches[link]
            wrenches[link] = own + force, about + moment
        for link, (force, moment) in wrenches.items():
            self.demands[link] = self.demands[link] + Demand(-force, -moment)
        force, couple = wrenches[cut.on]
        if connection.higher and cut.joint.couples:
            arm = cut.place(cut.on, poses) - poses[cut.on].place
            couple = couple - arm.cross(force)
        else:
            couple = 0.0
        self.forces.joints.append(JointForce(connection, cut.on, force, couple))

    def _carry(self, step: TreeJoint) -> None:
        """The joint that hangs a child on its parent supplies all of the child's demand."""
        demand = self.demands[step.child]
        pin = step.turns
        passed = self._moved(demand, step, free_pin=pin and step.free)
        self.demands[step.parent] = self.demands[step.parent] + passed
        force, couple = demand.force, 0.0 if pin else self._couple(step, demand)
        if step.free:
            left = demand.moment if pin else self._along(step).dot(demand.force)
            self.forces.left[step.joint, step.child] = left
        if step.driver is not None:
            force = force - self._drive(step, demand)
        self.forces.joints.append(JointForce(step.connection, step.child, force, couple))

    def _couple(self, step: TreeJoint, demand: Demand) -> Scalar:
        """Couple on the child about the place at which the joint's force is reported."""
        arm = self.motion.poses[step.child].place - self.motion.reaction_place(step.joint)
        return demand.moment + arm.cross(demand.force)

    def _drive(self, step: TreeJoint, demand: Demand) -> Vec:
        """Notes the driver's effort; the force it exerts on the child along a guide."""
        assert step.driver is not None
        if step.turns:
            own = step.child == self.motion.mechanism.drivers[step.driver].link
            self.forces.efforts[step.driver] = demand.moment if own else -demand.moment
            return ZERO
        along = self._along(step)
        effort = along.dot(demand.force)
        self.forces.efforts[step.driver] = effort
        return along * effort


class ForceOutputs:
    """Looks outputs up by name in a :class:`ForceTrace`."""

    def __init__(self, forces: ForceTrace) -> None:
        self.forces = forces
        self.mechanism = forces.motion.mechanism

    def value(self, name: str) -> Scalar:
        """The traced value of an output, by its row; raises KeyError for one that is not of the forces."""
        output = Output.of_row(name)
        found = self.of(output)
        return found if not isinstance(found, Vec) else found.x if output.component == "x" else found.y

    def of(self, output: Output) -> Scalar | Vec:
        """The traced value of an output, of a vector with all components."""
        owner, forces = output.owner, self.forces
        match output.kind:
            case "reaction":
                return forces.reaction(owner, output.on)
            case "couple":
                return forces.couple(owner, output.on)
            case "multiplier":
                return forces.multipliers.get(owner, 0.0)
            case "unsupplied":
                return forces.left[owner, output.on]
            case "effort":
                return forces.efforts[owner]
            case "load":
                return _sum(self._moving(owner))
            case "load_moment":
                return self._moment(forces.wrenches[owner])
            case "load_place":
                return next((wrench.place for wrench in self._moving(owner)), ZERO)
            case "applied":
                wrenches = [w for group in forces.wrenches.values() for w in group if w.link == owner]
                return self._moment(wrenches) if output.component == "m" else _sum(wrenches)
            case "shaking_force":
                return self._shaking()[0]
            case "shaking_moment":
                return self._shaking()[1]
            case "power":
                return forces.driver_power
            case "friction_power":
                return forces.friction_power
            case "power_of_forces":
                return forces.power
        raise KeyError(output.row)

    def _moving(self, load: str) -> list[Wrench]:
        """What a load does to links other than the frame."""
        return [wrench for wrench in self.forces.wrenches[load] if wrench.link != "frame"]

    def _moment(self, wrenches: list[Wrench]) -> Scalar:
        total: Scalar = 0.0
        for wrench in wrenches:
            if wrench.link != "frame":
                total = total + wrench.place.cross(wrench.force) + wrench.torque
        return total

    def _shaking(self) -> tuple[Vec, Scalar]:
        """Resultant of the inertia forces that the moving links put on the frame, about its origin."""
        force, moment = ZERO, 0.0  # type: tuple[Vec, Scalar]
        dimensions = self.forces.motion.dimensions
        for name in self.mechanism.links:
            state = self.forces.motion.states[name]
            centre = dimensions.centre(name)
            arm = state.arm(centre)
            push = state.acceleration_of(centre) * dimensions(f"{name}.mass")
            force = force - push
            moment = moment - (state.pose.place + arm).cross(push) - dimensions(f"{name}.inertia") * state.alpha
        return force, moment

    @cached_property
    def standard(self) -> tuple[str, ...]:
        """What every result stores: reactions on every link, couples, efforts."""
        names: list[str] = []
        for joint, link, couple in self.reaction_keys():
            names += row_names("reaction", joint, link)
            if couple:
                names.append(row_name("couple", joint, on=link))
        return (*names, *(row_name("effort", name) for name in self.forces.efforts))

    @cached_property
    def checks(self) -> tuple[str, ...]:
        """What must be zero but for rounding, the powers of which two must be equal."""
        left = (row_name("unsupplied", joint, on=link) for joint, link in self.forces.left)
        return (*left, row_name("power"), row_name("power_of_forces"))

    def reaction_keys(self) -> list[tuple[str, str, bool]]:
        """Joint, link, and whether it carries a couple; one link per pair, the others follow by reaction."""
        found = []
        for name, joint in self.mechanism.joints.items():
            found += [(name, link, joint.couples) for link in joint.joined[1:]]
        return found


def _sum(wrenches: list[Wrench]) -> Vec:
    total = ZERO
    for wrench in wrenches:
        total = total + wrench.force
    return total
