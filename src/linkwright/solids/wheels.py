"""Wheels, rings, pulleys and racks: plates in one layer with those that they mesh or run with."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from linkwright.joints.belt import BeltPair
from linkwright.joints.rack import RackPair
from linkwright.joints.rolling import RollingPair
from linkwright.joints.toothed import WheelPair
from linkwright.mechanism.wheels_and_cams import wheel_sizes
from linkwright.shapes.shape import Piece, Shape, disc
from linkwright.solids.draft import Body, Draft
from linkwright.solids.mounting import Axle, add_disc, eye, fasten
from linkwright.solids.planes import planes_of
from linkwright.solids.racks import Rack, add_rack, rack_of, settle_rack
from linkwright.words import _

#: Corners of a ring; from its pitch circle to its roots and to its rim in modules (ISO 53; rim 2.5).
CORNERS, ROOT, RIM = 96, 1.25, 3.75
#: The same without teeth, and radius of a post: shares of the link's width; of a post as a share of the rim at most.
BARE, POST, IN_RIM = 0.5, 0.15, 0.25


@dataclass(eq=False)
class Wheel:
    """A wheel on a link.

    ``centre`` in the axes of its carrier, m; ``radius`` of the pitch circle and ``module`` m, 0 without teeth;
    ``inside``: a ring, whose teeth point inwards; ``is_link``: whether it is the plate of its link; ``plates``: its
    discs by the planes in which it runs.
    """

    body: Body
    link: str
    centre: complex
    radius: float
    module: float
    inside: bool = False
    is_link: bool = False
    plates: dict[int, str] = field(default_factory=dict)

    @property
    def tip(self) -> float:
        """The radius to which its teeth reach, m."""
        return self.radius + (-self.module if self.inside else self.module)


@dataclass
class Wheels:
    """All wheels and racks of a machine, each once; ``pairs`` of those that run together, ``touching`` of those that
    mesh or roll on each other, ``planes`` in which they do it."""

    wheels: list[Wheel] = field(default_factory=list)
    racks: list[Rack] = field(default_factory=list)
    pairs: list[tuple[Wheel | Rack, Wheel | Rack]] = field(default_factory=list)
    touching: list[tuple[Wheel | Rack, Wheel | Rack]] = field(default_factory=list)
    planes: list[tuple[Wheel | Rack, ...]] = field(default_factory=list)


def plan_wheels(draft: Draft) -> Wheels:
    """Which wheels and racks there are; those around all points of their links become the plates of these."""
    found = Wheels()
    for joint in draft.mechanism.joints.values():
        pair: tuple[Wheel | Rack, ...] = ()
        if isinstance(joint, WheelPair):
            pair = tuple(_known(draft, found, each) for each in _of_pair(draft, joint))
        elif isinstance(joint, RackPair):
            rack = rack_of(draft, joint)
            found.racks.append(rack)
            pair = (_known(draft, found, _pinion(draft, joint, rack)), rack)
        if pair:
            found.pairs.append((pair[0], pair[1]))
            if not isinstance(joint, BeltPair):
                found.touching.append((pair[0], pair[1]))
    for wheel in sorted(found.wheels, key=lambda each: -each.radius):
        _settle(draft, wheel)
    for rack in found.racks:
        settle_rack(draft, rack)
    found.planes = planes_of(found.pairs, lambda a, b: _collide(draft, a, b))
    belts = tuple(each.name for each in draft.mechanism.joints.values() if isinstance(each, BeltPair))
    if belts:
        draft.notes[_("Belts and chains take no room here: {names}.", names=belts)] = None
    return found


def _of_pair(draft: Draft, joint: WheelPair) -> Iterator[Wheel]:
    sizes = wheel_sizes(joint, draft.mechanism)
    assert sizes is not None
    rolling, teeth = isinstance(joint, RollingPair), sizes.teeth or (0.0, 0.0)
    for k, link in enumerate(joint.links):
        radius = sizes.radii[k]
        module = 2.0 * radius / teeth[k] if teeth[k] and rolling else 0.0
        inside = isinstance(joint, RollingPair) and joint.mesh == "internal" and radius > sizes.radii[1 - k]
        yield Wheel(draft.body(link), link, draft.carriers.place(link, joint.centres[k]), radius, module, inside)


def _pinion(draft: Draft, joint: RackPair, rack: Rack) -> Wheel:
    centre = draft.carriers.place(joint.pinion, joint.centre)
    return Wheel(draft.body(joint.pinion), joint.pinion, centre, joint.radius, rack.module)


def _known(draft: Draft, found: Wheels, wheel: Wheel) -> Wheel:
    """The wheel, or the same one of another pair, with the larger teeth of both."""
    for each in found.wheels:
        close = abs(each.centre - wheel.centre) <= draft.near
        alike = each.body is wheel.body and each.inside == wheel.inside
        if alike and close and math.isclose(each.radius, wheel.radius, rel_tol=1e-6):
            each.module = max(each.module, wheel.module)
            return each
    found.wheels.append(wheel)
    return wheel


def _collide(draft: Draft, one: Wheel | Rack, other: Wheel | Rack) -> bool:
    """Whether two that do not mesh cannot run in one plane: they overlap at some position."""
    if isinstance(one, Rack) or isinstance(other, Rack):
        return False
    if one.inside != other.inside:
        ring, wheel = (one, other) if one.inside else (other, one)
        return bool(_distance(draft, ring, wheel).max() + wheel.tip >= ring.tip)
    return bool(one.inside or _distance(draft, one, other).min() <= one.tip + other.tip)


def _distance(draft: Draft, one: Wheel, other: Wheel) -> np.ndarray:
    """Of the centres of two wheels, m, at all positions."""
    if one.body is other.body:
        return np.array([abs(one.centre - other.centre)])
    seen = draft.path_of(other.body.carrier, other.centre, one.body.carrier)
    return np.abs(seen - one.centre) if len(seen) else np.array([np.inf])


def _settle(draft: Draft, wheel: Wheel) -> None:
    """Whether a wheel is its link's plate; what else that plate is to hold."""
    body = wheel.body
    held = [*draft.points(body), *body.held]
    within = all(abs(each - wheel.centre) + eye(draft, body, each) <= wheel.tip for each in held)
    if draft.is_free(body) and not wheel.inside and (within or len(held) == 1):
        body.shape, body.sort, wheel.is_link = wheel_shape(draft, wheel), "wheel", True
    elif wheel.inside:
        body.fixed.append(_posts(draft, wheel))


def _posts(draft: Draft, wheel: Wheel) -> tuple[complex, complex]:
    """Two places opposite each other in the rim of a ring, in line with the farthest point of its link."""
    far = max((each - wheel.centre for each in draft.points(wheel.body)), key=abs)
    way = far / abs(far) if abs(far) > draft.near else 1 + 0j
    middle = 0.5 * (_root(wheel) + _rim(draft, wheel)) * way
    return wheel.centre - middle, wheel.centre + middle


def _root(wheel: Wheel) -> float:
    """The radius to which the gaps of a ring reach, m."""
    return wheel.radius + ROOT * wheel.module


def _rim(draft: Draft, wheel: Wheel) -> float:
    """The outer radius of a ring, m."""
    return wheel.radius + (RIM * wheel.module or BARE * draft.width(wheel.body))


def wheel_shape(draft: Draft, wheel: Wheel) -> Shape:
    """A disc to the tips of the teeth; a ring from their tips to its rim, which leaves that circle free."""
    if not wheel.inside:
        return disc(wheel.centre, wheel.tip)
    half = 0.5 * (_rim(draft, wheel) - wheel.tip)
    turn = np.exp(2j * np.pi * np.arange(CORNERS + 1) / CORNERS)
    middle = (wheel.tip + half) / math.cos(math.pi / CORNERS)
    return Shape((Piece((wheel.centre + middle * turn,), half),))


def add_wheels(draft: Draft, found: Wheels) -> list[Axle]:
    """The plates of wheels and racks that are not their links', how they are held, and which are level."""
    axles: list[Axle] = []
    for plane, members in enumerate(found.planes):
        for each in members:
            if each.is_link and not each.plates:
                each.plates[plane] = each.body.plate
            elif isinstance(each, Rack):
                each.plates[plane] = add_rack(draft, each)
            else:
                each.plates[plane], axle = _add_wheel(draft, each)
                axles += axle
        names = [each.plates[plane] for each in members]
        draft.level += pairwise(names)
        for one, other in found.touching:
            if one in members and other in members:
                draft.join(one.plates[plane], other.plates[plane])
    return axles


def _add_wheel(draft: Draft, wheel: Wheel) -> tuple[str, list[Axle]]:
    body, shape, name = wheel.body, wheel_shape(draft, wheel), draft.free_name(f"wheel {wheel.link}")
    if not wheel.inside:
        return name, [add_disc(draft, "wheel", wheel.link, name, shape, wheel.centre)]
    draft.plate(name, "wheel", body.carrier, shape, wheel.link)
    radius = min(POST * draft.width(body), IN_RIM * (_rim(draft, wheel) - _root(wheel)))
    fasten(draft, name, body, name, _posts(draft, wheel), radius)
    return name, []
