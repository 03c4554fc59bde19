"""Wheels, racks and cams as a page draws them: shapes whose sizes follow dimensions that its reader may change."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch
from math import pi

from linkwright.joints.base import Joint
from linkwright.joints.belt import BeltPair
from linkwright.joints.cam import CamJoint
from linkwright.joints.chain import ChainPair
from linkwright.joints.rack import RackPair
from linkwright.joints.toothed import WheelPair
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class Amount:
    """A number of a drawing whose dimensions may change: ``factor`` times and over those with the given addresses;
    ``value`` as they are."""

    value: float
    times: tuple[str, ...] = ()
    over: tuple[str, ...] = ()
    factor: float = 1.0


@dataclass(frozen=True)
class Wheel:
    """A wheel on a link about ``centre``, a point of ``carrier``; ``nominal``: its pitch radius (m).

    ``radius`` where it does not follow from the distance of the centres; ``inside``: teeth inwards.
    """

    link: str
    carrier: str
    centre: str
    nominal: float
    radius: Amount | None = None
    toothed: bool = False
    teeth: int | None = None
    inside: bool = False


@dataclass(frozen=True)
class Wheels:
    """Two wheels on a carrier, for drawings whose dimensions may change.

    ``ratio`` i of their speeds on it: radii without an amount of their own are d i / (i - 1) and d / (i - 1), d the
    distance of the centres; ``wrapped``: a belt or a chain runs around them, else their teeth mesh.
    """

    pair: tuple[Wheel, Wheel]
    ratio: Amount
    wrapped: bool


@dataclass(frozen=True)
class RackWay:
    """A rack of the link ``rack``: its pitch line goes through ``through`` in the direction ``turn`` (rad, in its
    axes), the pinion on the left, or ``right``."""

    pinion: Wheel
    rack: str
    through: str
    turn: Amount
    right: bool


@dataclass(frozen=True)
class CamContact:
    """A cam, link ``cam`` about ``centre``, and point ``at`` of the follower, held on the carrier by a ``guide``
    (along which ``side`` tells the way out) or a ``pivot`` (``side`` 1 where the arm is on the left).

    ``base``, ``roller``: radii; ``groove``: with an outer wall.
    """

    cam: str
    centre: str
    follower: str
    at: str
    carrier: str
    touch: str
    base: Amount
    roller: Amount
    groove: bool
    guide: str
    pivot: str
    side: int


@singledispatch
def contact_shape(joint: Joint, mechanism: Mechanism) -> Wheels | RackWay | CamContact | None:
    """What a page draws of a pair; None of one whose shape it does not know."""
    return None


@contact_shape.register
def _(joint: WheelPair, mechanism: Mechanism) -> Wheels:
    nominal = [abs(each) for each in joint.arms(mechanism)]
    wrapped = isinstance(joint, BeltPair)
    a, b = (
        Wheel(
            link,
            joint.carrier,
            joint.centres[k],
            nominal[k],
            _running_radius(joint, k) if isinstance(joint, BeltPair) else None,
            joint.toothed,
            None if joint.teeth is None else int(joint.teeth[k]),
            not wrapped and joint.sense > 0 and nominal[k] == max(nominal),
        )
        for k, link in enumerate(joint.links)
    )
    return Wheels((a, b), _ratio(joint), wrapped)


def _ratio(joint: WheelPair) -> Amount:
    if joint.ratio is not None:
        return Amount(joint.ratio, (f"{joint.name}.ratio",))
    key = "teeth" if joint.teeth is not None else "radii"
    return Amount(joint.transmission, (f"{joint.name}.{key}.0",), (f"{joint.name}.{key}.1",), joint.sense)


def _running_radius(joint: BeltPair, k: int) -> Amount:
    """Radius on which a belt or a chain runs."""
    radius = joint.pitch_radii()[k]
    if isinstance(joint, ChainPair) and joint.teeth is not None and joint.pitch is not None:
        return Amount(radius, (f"{joint.name}.pitch",), factor=joint.teeth[k] / (2 * pi))
    return Amount(radius, (f"{joint.name}.radii.{k}",))


@contact_shape.register
def _(joint: RackPair, mechanism: Mechanism) -> RackWay:
    teeth = None if joint.teeth is None else int(joint.teeth)
    if joint.module is None:
        size = Amount(joint.radius, (f"{joint.name}.radius",))
    else:
        size = Amount(joint.radius, (f"{joint.name}.module", f"{joint.name}.teeth"), factor=0.5)
    pinion = Wheel(joint.pinion, joint.pinion, joint.centre, joint.radius, size, True, teeth)
    turn = Amount(joint.direction, (f"{joint.name}.direction",))
    return RackWay(pinion, joint.rack, joint.through, turn, joint.side < 0)


@contact_shape.register
def _(joint: CamJoint, mechanism: Mechanism) -> CamContact:
    base, roller = (
        Amount(value, (f"{joint.name}.{key}",))
        for key, value in (("base_radius", joint.base_radius), ("roller_radius", joint.roller_radius))
    )
    held = ("", joint.holder, 1 if joint.side == "left" else -1)
    if not joint.side:
        outward = mechanism.joints[joint.holder].joined[1] == joint.follower
        held = (joint.holder, "", 1 if outward else -1)
    groove = joint.closure == "groove" and joint.touch == "roller"
    places = (joint.cam, joint.centre, joint.follower, joint.at, joint.carrier)
    return CamContact(*places, joint.touch, base, roller, groove, *held)
