"""All outputs of traced forces, by name, traced only when somebody asks."""

from __future__ import annotations

from functools import cached_property

from linkwright.applied_loads.site import Wrench
from linkwright.core.outputs import Output, row_name, row_names
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.trace import Scalar
from linkwright.kinetostatics.trace import ForceTrace


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
