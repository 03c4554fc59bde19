"""Where a link is and how it moves, as traced values."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.trace import Scalar


@dataclass(frozen=True)
class Rotor:
    """The direction of a link: the world vector ``now`` of what is ``local`` in the link's axes."""

    now: Vec
    local: Vec


@dataclass(frozen=True)
class Pose:
    """The link's ``anchor`` (in its axes) is at ``place``; ``rotor`` gives its direction."""

    anchor: Vec
    place: Vec
    rotor: Rotor

    def spin(self, local: Vec) -> Vec:
        """A vector of the link's axes in frame axes."""
        return self.rotor.now.turn(local.over(self.rotor.local))

    def point(self, local: Vec) -> Vec:
        """A point of the link in frame axes."""
        return self.place + self.spin(local - self.anchor)

    @property
    def direction(self) -> Vec:
        """Unit vector of the link's x axis."""
        return self.spin(Vec(1.0, 0.0))


def _real(share: Vec) -> bool:
    """Whether a point is known to lie on the line of the rotor: its motion is a part of the line's."""
    return isinstance(share.y, float) and share.y == 0.0


#: Any vector whose world image is itself: no rotation.
UNTURNED = Rotor(Vec(1.0, 0.0), Vec(1.0, 0.0))
FRAME_POSE = Pose(ZERO, ZERO, UNTURNED)


@dataclass(frozen=True)
class State:
    """Pose and rates of a link: velocity and acceleration of its anchor, ω and α."""

    pose: Pose
    velocity: Vec
    omega: Scalar
    acceleration: Vec = ZERO
    alpha: Scalar = 0.0

    def arm(self, local: Vec) -> Vec:
        """From the anchor to a point of the link, in frame axes."""
        return self.pose.spin(local - self.pose.anchor)

    def velocity_of(self, local: Vec) -> Vec:
        """Velocity of a point in the link's axes."""
        share = self._share(local)
        if _real(share):
            return self.velocity + (self.pose.rotor.now.perp * self.omega) * share.x
        return self.velocity_at(self.arm(local))

    def acceleration_of(self, local: Vec) -> Vec:
        """Acceleration of a point in the link's axes."""
        share = self._share(local)
        if _real(share):
            now = self.pose.rotor.now
            return self.acceleration + (now.perp * self.alpha - now * (self.omega * self.omega)) * share.x
        return self.acceleration_at(self.arm(local))

    def _share(self, local: Vec) -> Vec:
        """What the point's arm is of the rotor's vector, as a complex number."""
        return (local - self.pose.anchor).over(self.pose.rotor.local)

    def velocity_at(self, arm: Vec) -> Vec:
        """Velocity of the point of the link that is ``arm`` away from the anchor."""
        return self.velocity + arm.perp * self.omega

    def acceleration_at(self, arm: Vec) -> Vec:
        """Acceleration of that point."""
        return self.acceleration + (arm.perp * self.alpha - arm * (self.omega * self.omega))


FRAME_STATE = State(FRAME_POSE, ZERO, 0.0)
