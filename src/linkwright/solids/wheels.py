"""Wheels, rings, pulleys and racks: plates in one layer with those that they mesh or run with."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from linkwright.joints.belt import BeltPair
from linkwright.joints.rack import RackPair
from linkwright.joints.rolling import RollingPair
from linkwright.joints.toothed import WheelPair
from linkwright.mechanism.wheels_and_cams import wheel_sizes
from linkwright.shapes.shape import Piece, Shape, disc, polygon
from linkwright.solids.draft import Body, Draft
from linkwright.solids.mounting import Axle, eye, fasten, on_hub
from linkwright.words import _

#: Corners of a ring; from its pitch circle to its rim, and height of a rack, in modules (root 1.25, rim 2.5).
CORNERS, RIM = 96, 3.75
#: The same without teeth, radius of a post, and what a rack is longer than its way: shares of the link's width.
BARE, POST, BEYOND = 0.5, 0.15, 0.5


@dataclass
class Wheel:
    """A wheel on a link, or its rack.

    ``centre`` in the axes of its carrier, m; ``radius`` of the pitch circle and ``module`` m, 0 without teeth;
    ``inside``: a ring, whose teeth point inwards. ``is_link``: whether it is the plate of its link; ``planes``: the
    planes in which it runs, each a plate of its own.
    """

    joint: str
    body: Body
    link: str
    centre: complex
    radius: float
    module: float
    inside: bool = False
    is_link: bool = False
    planes: list[Plane] = field(default_factory=list)

    @property
    def tip(self) -> float:
        """The radius to which its teeth reach, m."""
        return self.radius + (-self.module if self.inside else self.module)


@dataclass
class Rack:
    """A rack on a link: its ``outline`` and the places of its posts in the carrier's axes, m; as of a wheel."""

    body: Body
    link: str
    outline: list[complex]
    posts: tuple[complex, complex]
    is_link: bool = False
    planes: list[Plane] = field(default_factory=list)


@dataclass
class Wheels:
    """All wheels and racks of a machine, each once; ``pairs`` of those that run in one plane, touching or not."""

    wheels: list[Wheel] = field(default_factory=list)
    racks: list[Rack] = field(default_factory=list)
    pairs: list[tuple[Wheel | Rack, Wheel | Rack, bool]] = field(default_factory=list)


def plan_wheels(draft: Draft) -> Wheels:
    """Which wheels and racks there are; those around all points of their links become the plates of these."""
    found = Wheels()
    for joint in draft.mechanism.joints.values():
        if isinstance(joint, WheelPair):
            first, second = (_known(draft, found, each) for each in _pair(draft, joint))
            found.pairs.append((first, second, isinstance(joint, RollingPair)))
        elif isinstance(joint, RackPair):
            rack = _rack(draft, joint)
            found.racks.append(rack)
            found.pairs.append((_known(draft, found, _pinion(draft, joint)), rack, True))
    for wheel in sorted(found.wheels, key=lambda each: -each.radius):
        _settle(draft, wheel)
    for rack in found.racks:
        _settle_rack(draft, rack)
    belts = tuple(each.name for each in draft.mechanism.joints.values() if isinstance(each, BeltPair))
    if belts:
        draft.notes[_("Belts and chains take no room here: {names}.", names=belts)] = None
    return found


def _pair(draft: Draft, joint: WheelPair) -> Iterator[Wheel]:
    sizes = wheel_sizes(joint, draft.mechanism)
    assert sizes is not None
    teeth = sizes.teeth or (0.0, 0.0)
    internal = isinstance(joint, RollingPair) and joint.mesh == "internal"
    for k, link in enumerate(joint.links):
        radius = sizes.radii[k]
        module = 2.0 * radius / teeth[k] if teeth[k] and isinstance(joint, RollingPair) else 0.0
        centre = draft.carriers.place(link, joint.centres[k])
        inside = internal and radius > sizes.radii[1 - k]
        yield Wheel(joint.name, draft.body(link), link, centre, radius, module, inside)


def _pinion(draft: Draft, joint: RackPair) -> Wheel:
    centre = draft.carriers.place(joint.pinion, joint.centre)
    return Wheel(joint.name, draft.body(joint.pinion), joint.pinion, centre, joint.radius, _module(joint))


def _module(joint: RackPair) -> float:
    return joint.module or (0.0 if joint.teeth is None else 2.0 * joint.radius / joint.teeth)


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


def _rack(draft: Draft, joint: RackPair) -> Rack:
    """A rectangle along the pitch line over all places of the pinion."""
    body, module = draft.body(joint.rack), _module(joint)
    width = draft.width(body)
    way = draft.carriers.places[joint.rack].turn * cmath.exp(1j * joint.direction)
    start = draft.carriers.place(joint.rack, joint.through)
    seen = (draft.seen(joint.pinion, joint.centre, body.carrier) - start) * way.conjugate()
    low, high = (float(each(seen.real)) for each in (np.min, np.max)) if len(seen) else (0.0, 0.0)
    beyond = max(2.0 * module, BEYOND * width)
    low, high = low - beyond, high + beyond
    back = -max(RIM * module, BARE * width)
    side = float(joint.side)
    corners = [complex(low, side * back), complex(high, side * back)]
    corners += [complex(high, side * module), complex(low, side * module)]
    posts = complex(low - 0.5 * back, 0.5 * side * back), complex(high + 0.5 * back, 0.5 * side * back)
    first, second = (start + way * each for each in posts)
    return Rack(body, joint.rack, [start + way * each for each in corners], (first, second))


def _settle(draft: Draft, wheel: Wheel) -> None:
    """Whether a wheel is its link's plate; what else that plate is to hold."""
    body = wheel.body
    within = all(abs(each - wheel.centre) + eye(draft, body, each) <= wheel.tip for each in _held(draft, body))
    centred = len(draft.points(body)) == 1 and not body.fixed
    free = body.carrier != "frame" and body.shape is None and not body.slots
    if free and not wheel.inside and (within or centred):
        body.shape, body.sort, wheel.plate = wheel_shape(draft, wheel), "wheel", body.carrier
    elif wheel.inside:
        body.fixed += _ring_posts(draft, wheel)


def _held(draft: Draft, body: Body) -> list[complex]:
    return [*draft.points(body), *body.fixed]


def _settle_rack(draft: Draft, rack: Rack) -> None:
    body, (a, b, _unused, d) = rack.body, rack.outline
    along, across = (b - a) / abs(b - a), (d - a) / abs(d - a)
    local = [((each - a) * along.conjugate()).real for each in draft.points(body)]
    aside = [((each - a) * across.conjugate()).real for each in draft.points(body)]
    free = body.carrier != "frame" and body.shape is None and not body.slots and not body.fixed
    within = all(0 < x < abs(b - a) and 0 < y < abs(d - a) for x, y in zip(local, aside, strict=True))
    if free and within:
        body.shape, body.sort, rack.plate = polygon(_counter_clockwise(rack.outline)), "wheel", body.carrier
    else:
        body.fixed += rack.posts


def _counter_clockwise(corners: list[complex]) -> list[complex]:
    turned = ((corners[1] - corners[0]).conjugate() * (corners[2] - corners[1])).imag
    return corners if turned > 0.0 else corners[::-1]


def _ring_posts(draft: Draft, wheel: Wheel) -> tuple[complex, complex]:
    """Two places opposite each other in the rim of a ring, in line with the farthest point of its link."""
    ways = [each - wheel.centre for each in draft.points(wheel.body)]
    far = max(ways, key=abs)
    way = far / abs(far) if abs(far) > draft.near else 1 + 0j
    middle = 0.5 * (wheel.radius + _rim(draft, wheel)) * way
    return wheel.centre - middle, wheel.centre + middle


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
    axles = [axle for wheel in found.wheels if not wheel.plate for axle in _add_wheel(draft, wheel)]
    for rack in found.racks:
        if not rack.plate:
            rack.plate = draft.free_name(f"rack {rack.link}")
            shape, radius = polygon(_counter_clockwise(rack.outline)), POST * draft.width(rack.body)
            draft.plate(rack.plate, "wheel", rack.body.carrier, shape, rack.link)
            fasten(draft, rack.plate, rack.body, rack.plate, rack.posts, radius)
    for first, second, touching in found.pairs:
        draft.level.append((first.plate, second.plate))
        if touching:
            draft.join(first.plate, second.plate)
    return axles


def _add_wheel(draft: Draft, wheel: Wheel) -> Iterator[Axle]:
    body, shape = wheel.body, wheel_shape(draft, wheel)
    wheel.plate = draft.free_name(f"wheel {wheel.link}")
    draft.plate(wheel.plate, "wheel", body.carrier, shape, wheel.link)
    if wheel.inside:
        fasten(draft, wheel.plate, body, wheel.plate, _ring_posts(draft, wheel), POST * draft.width(body))
    else:
        yield on_hub(draft, body, wheel.plate, wheel.centre)
