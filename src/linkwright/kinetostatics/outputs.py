"""All outputs of traced forces, by name, traced only when somebody asks."""

from __future__ import annotations

from functools import cached_property

from linkwright.engine.trace import Scalar
from linkwright.engine.vector import ZERO, Vec
from linkwright.kinetostatics.trace import ForceTrace
from linkwright.loads.site import Wrench

#: ``r:JOINT|LINK.x`` reaction on a link, ``c:JOINT|LINK`` couple, ``effort:DRIVER``, ``power`` of all demands,
#: ``driver_power``, ``lf:LOAD.x`` force of a load, ``lm:LOAD`` its moment about the frame's origin, ``lp:LOAD.x``
#: its place, ``on:LINK.x`` and ``on:LINK.m`` loads on a link, ``shake.x`` and ``shake_moment`` on the frame.


class ForceOutputs:
    """Looks outputs up by name in a :class:`ForceTrace`."""

    def __init__(self, forces: ForceTrace) -> None:
        self.forces = forces
        self.mechanism = forces.motion.mechanism

    def value(self, name: str) -> Scalar:
        """The traced value of an output."""
        kind, _, key = name.partition(":")
        if name in ("power", "driver_power"):
            return getattr(self.forces, name)  # type: ignore[no-any-return]
        if name == "shake_moment":
            return self._shaking()[1]
        if kind == "effort":
            return self.forces.efforts[key]
        if kind == "c":
            joint, link = key.split("|", 1)
            return self.forces.couple(joint, link)
        if kind == "lm":
            return self._moment(self.forces.wrenches[key])
        if kind == "on":
            return self._on_link(*key.rsplit(".", 1))
        base, axis = name.rsplit(".", 1)
        vector = self._vector(base)
        return vector.x if axis == "x" else vector.y

    def _vector(self, base: str) -> Vec:
        if base == "shake":
            return self._shaking()[0]
        kind, key = base.split(":", 1)
        if kind == "r":
            joint, link = key.split("|", 1)
            return self.forces.reaction(joint, link)
        wrenches = [w for w in self.forces.wrenches[key] if w.link != "frame"]
        if kind == "lp":
            return wrenches[0].place if wrenches else ZERO
        total = ZERO
        for wrench in wrenches:
            total = total + wrench.force
        return total

    def _on_link(self, link: str, part: str) -> Scalar:
        """Resultant of loads and friction on one link: x, y, or the moment m about the frame's origin."""
        wrenches = [w for group in self.forces.wrenches.values() for w in group if w.link == link]
        if part == "m":
            return self._moment(wrenches)
        total = ZERO
        for wrench in wrenches:
            total = total + wrench.force
        return total.x if part == "x" else total.y

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
            moment = (
                moment - (state.pose.place + arm).cross(push) - dimensions(f"{name}.inertia") * state.alpha
            )
        return force, moment

    @cached_property
    def standard(self) -> tuple[str, ...]:
        """What every result stores: reactions on every link, couples, efforts."""
        names = []
        for joint, link, couple in self.reaction_keys():
            names += [f"r:{joint}|{link}.x", f"r:{joint}|{link}.y"]
            if couple:
                names.append(f"c:{joint}|{link}")
        return (*names, *(f"effort:{name}" for name in self.forces.efforts))

    def reaction_keys(self) -> list[tuple[str, str, bool]]:
        """Joint, link, and whether it carries a couple; one link per pair, the others follow by reaction."""
        found = []
        for name, joint in self.mechanism.joints.items():
            found += [(name, link, joint.couples) for link in joint.joined[1:]]
        return found
