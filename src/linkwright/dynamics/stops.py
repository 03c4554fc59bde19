"""End stops: how far an output is from where it is stopped, and the force that stops it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.site import Site, Wrench
from linkwright.core.outputs import Output
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar, angle, cos, sin
from linkwright.kinematics.names import find_point
from linkwright.kinematics.trace import MotionOutputs, MotionTrace
from linkwright.kinetostatics.load_site import TracedSite
from linkwright.mechanism.stops import Stop


def contact_name(stop: str) -> str:
    """Name of the input that is the force, N, or torque, N·m, by which a stop pushes back, and of its load."""
    return f"contact:{stop}"


def stop_gap(motion: MotionTrace, stop: Stop) -> Scalar:
    """How far a machine is from a stop, m or rad: 0 where it touches, never below; of an angle within half a turn."""
    at = motion.dimensions(f"stops.{stop.name}.at")
    if stop.of.kind == "angle":
        e, end = motion.poses[stop.of.owner].direction, Vec(cos(at), sin(at))
        past = angle(end.cross(e), end.dot(e))
    else:
        past = MotionOutputs(motion).value(stop.of.row) - at
    return past if stop.side == "below" else -past


@dataclass(frozen=True, kw_only=True)
class Contact(Load):
    """What a stop does: the frame pushes back on what it stops, on a guide its two parts push each other apart."""

    kind: ClassVar[str] = "contact"
    stopped: Output
    below: bool

    def wrenches(self, site: Site) -> list[Wrench]:
        assert isinstance(site, TracedSite)
        push: Scalar = site.motion.trace.position(self.name)
        push = push if self.below else -push
        mechanism = site.motion.mechanism
        if self.stopped.kind == "angle":
            return [Wrench(self.stopped.owner, torque=push), Wrench("frame", torque=-push)]
        if self.stopped.owner in mechanism.guides:
            guide = mechanism.guides[self.stopped.owner]
            direction, place, _ = site.guide(self.stopped.owner)
            return [Wrench(guide.block, direction * push, place), Wrench(guide.guide, direction * -push, place)]
        link, point = find_point(mechanism, self.stopped.owner)
        force = Vec(push, 0.0) if self.stopped.component == "x" else Vec(0.0, push)
        place = site.place(link, point)
        return [Wrench(link, force, place), Wrench("frame", -force, place)]


def contact(stop: Stop) -> Contact:
    """The load of a stop."""
    return Contact(name=contact_name(stop.name), stopped=stop.of, below=stop.side == "below")
