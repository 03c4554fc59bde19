"""The kinematic drawing as data: symbols tied to points of the page, and wheels, racks and cams as shapes.

A *stamp* is a symbol of fixed size, as SVG about (0, 0) with x along its direction; bars, plates, rails, rods,
cylinders and springs reach between points and are drawn by the page. Points are named by the keys of the outputs
``p:KEY``, directions by the names of outputs (``e:LINK``, ``d:GUIDE``), or given as an angle on the paper (rad,
clockwise).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import partial, singledispatch
from math import pi
from typing import Any

import numpy as np

from linkwright.actuators.base import Actuator
from linkwright.actuators.cylinder import Cylinder
from linkwright.actuators.motor import Motor
from linkwright.applied_loads.base import Load
from linkwright.core.data import Plain
from linkwright.core.outputs import row_name
from linkwright.fields.colour import as_rgb
from linkwright.joints.base import Joint
from linkwright.joints.belt import BeltPair
from linkwright.joints.cam import CamJoint
from linkwright.joints.chain import ChainPair
from linkwright.joints.rack import RackPair
from linkwright.joints.toothed import WheelPair
from linkwright.kinematics.names import canonical
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.symbols.base import PIN, SYMBOLS, Shape
from linkwright.plotting.drawing.actuators import actuators, end_stop, flywheels, touches
from linkwright.plotting.drawing.cylinders import lengths
from linkwright.plotting.drawing.guides import clear_shift, ground_side, input_arrows, is_cylinder, travel, welds
from linkwright.plotting.drawing.loads import named_points, pressing
from linkwright.plotting.drawing.machine import DrawnMechanism, Part, Press, Turn, bodies, flat, mark_of, pins

_LENGTHS = 2


def glyphs(machine: DrawnMechanism, index: int) -> list[Plain]:
    """All of a machine's drawing; arrows of the drivers stand as at the position ``index``."""
    found = [*(_tied(machine, part, pin) for part, pin in flywheels(machine))]
    found += [*_Tracked(machine).all, *_links(machine), *_guides(machine)]
    found += [*_pins(machine), *_welds(machine)]
    found += [_tied(machine, part) for part in input_arrows(machine, index)]
    found += [*(_tied(machine, part, pin) for part, pin in actuators(machine, index)), *_stops(machine)]
    found += [glyph for each in machine.motion.mechanism.actuators.values() for glyph in _along_line(machine, each)]
    found += [glyph for load in machine.motion.mechanism.loads.values() for glyph in _load(machine, load)]
    found += [
        _stamp("marks", f"{link.name}.@centre", 0.0, SYMBOLS["mass_centre"](), role="centre")
        for link in machine.motion.mechanism.links.values()
        if link.mass
    ]
    return found


def key_of(machine: DrawnMechanism, link: str, point: str) -> str:
    """The key of a point's outputs."""
    return canonical(machine.motion.mechanism, link, point)


def _stamp(layer: str, at: str, along: str | float, shape: Shape, **more: Any) -> Plain:
    svg = "".join(str(each) for each in shape.elements)
    return {"kind": "stamp", "layer": layer, "at": at, "along": along, "svg": svg, **more}


def _links(machine: DrawnMechanism) -> Iterator[Plain]:
    for link in machine.motion.mechanism.links.values():
        keys = [key_of(machine, link.name, point) for point in link.points]
        ends = _ends(machine, link)
        if ends is None:
            yield {"kind": "plate", "layer": "bodies", "points": keys, **_colour(link)}
        elif len(ends) == _LENGTHS:
            yield {"kind": "bar", "layer": "bodies", "points": [keys[end] for end in ends], **_colour(link)}
    yield from (_tied(machine, part) for part in bodies(machine) if part.layer == "pins")


def _colour(link: Link) -> Plain:
    """The colour of a link's bars and plates, where it has one."""
    return {"colour": as_rgb(link.colour)} if link.colour else {}


def _ends(machine: DrawnMechanism, link: Link) -> list[int] | None:
    """Numbers of the two points at the ends of a straight link; all points (one or none) of a short one, None where
    they span an area."""
    cloud = machine.cloud(link.name)
    ends = flat(cloud)
    if ends is None:
        return None
    if len(ends) < _LENGTHS or np.hypot(*(ends[1] - ends[0])) <= 1.0:
        return []
    return [int(np.hypot(*(cloud - end).T).argmin()) for end in ends]


def _guides(machine: DrawnMechanism) -> Iterator[Plain]:
    for name, joint in machine.guides.items():
        ends = {"joint": name, "at": key_of(machine, joint.block, joint.at)}
        through = key_of(machine, joint.guide, joint.through)
        if is_cylinder(machine, name):
            yield {"kind": "cylinder", "layer": "blocks", **ends, "through": through, **_tube(machine, name)}
            continue
        shift = clear_shift(machine, name, joint)
        if joint.guide == "frame":
            yield {"kind": "rail", "layer": "ground", **ends, "shift": shift, "side": ground_side(machine, joint)}
        else:
            carried = len(machine.motion.mechanism.link(joint.guide).points) > 1
            reach = [key_of(machine, joint.guide, point) for point in joint.direction_points or ()]
            yield {
                "kind": "rod",
                "layer": "bodies",
                **ends,
                "reach": [*reach, *([through] if carried or joint.offset else [])],
                "tie": through,
                **_colour(machine.motion.mechanism.link(joint.guide)),
            }
        if shift:
            own = _colour(machine.motion.mechanism.link(joint.block))
            yield {"kind": "stub", "layer": "bodies", **ends, "shift": shift, **own}
        yield _stamp("blocks", ends["at"], row_name("guide_direction", name), SYMBOLS["slider"](), shift=shift)


def _tube(machine: DrawnMechanism, name: str) -> Plain:
    """Lengths of barrel and piston rod, m."""
    short, longest = travel(machine, name)
    length = max(0.8 * short, min(0.62 * longest, 0.94 * short))
    piston = max(longest - 0.92 * length, short - length + 10.0)
    return {"barrel": length / machine.view.scale, "piston": piston / machine.view.scale}


def _pins(machine: DrawnMechanism) -> Iterator[Plain]:
    yield from (_tied(machine, part) for part in pins(machine) if part.layer != "tops")
    for name, joint in machine.pins.items():
        for link in joint.links:
            ends = _ends(machine, machine.motion.mechanism.link(link)) if link != "frame" else None
            if ends and list(machine.motion.mechanism.link(link).points).index(name) not in ends:
                keys = [key_of(machine, link, point) for point in machine.motion.mechanism.link(link).points]
                yield {
                    "kind": "passing",
                    "layer": "tops",
                    "at": name,
                    "points": [keys[end] for end in ends],
                    "length": 1.3 * PIN,
                    **_colour(machine.motion.mechanism.link(link)),
                }


def _along(link: str) -> str | float:
    """The output that a part of a link is turned by."""
    return 0.0 if link == "frame" else row_name("direction", link)


class _Tracked:
    """Wheels, each once, and cams, then belts and racks: what joints say of shapes that follow the dimensions."""

    def __init__(self, machine: DrawnMechanism) -> None:
        self.machine = machine
        self._wheels: list[tuple[Wheel, Plain]] = []
        self._cams: list[tuple[float, Plain]] = []
        self._after: list[Plain] = []
        mechanism = machine.motion.mechanism
        for joint in mechanism.joints.values():
            match contact_shape(joint, mechanism):
                case Wheels() as found:
                    self._pair(found)
                case RackWay() as found:
                    self._rack(found)
                case CamContact() as found:
                    self._cams.append((found.base.value, self._cam(found)))

    @property
    def all(self) -> list[Plain]:
        """Rings, large wheels and large cams first; ``mesh`` is a wheel's place in this list."""
        sized = [(not wheel.inside, -wheel.nominal, glyph) for wheel, glyph in self._wheels]
        sized += [(True, -size, glyph) for size, glyph in self._cams]
        order = sorted(range(len(sized)), key=lambda k: sized[k][:2])
        place = {number: k for k, number in enumerate(order)}
        found = [*(sized[number][2] for number in order), *self._after]
        return [{**each, "mesh": place[each["mesh"]]} if "mesh" in each else each for each in found]

    def _wheel(self, wheel: Wheel, **more: Any) -> tuple[int, bool]:
        """Number of a wheel, and whether it is a new one."""
        at = key_of(self.machine, wheel.carrier, wheel.centre)
        for number, (known, glyph) in enumerate(self._wheels):
            same = (known.link, glyph["at"], round(known.nominal, 9)) == (wheel.link, at, round(wheel.nominal, 9))
            if same:
                return number, False
        radius = None if wheel.radius is None else asdict(wheel.radius)
        glyph = {
            "kind": "wheel",
            "layer": "ground",
            "link": wheel.link,
            "at": at,
            "along": _along(wheel.link),
            "radius": radius,
            "toothed": wheel.toothed,
            "teeth": wheel.teeth,
            "inside": wheel.inside,
            **more,
        }
        self._wheels.append((wheel, glyph))
        return len(self._wheels) - 1, True

    def _pair(self, wheels: Wheels) -> None:
        ends = [key_of(self.machine, each.carrier, each.centre) for each in wheels.pair]
        sizes = {"points": ends, "ratio": asdict(wheels.ratio)}
        (a, a_new), (b, b_new) = (self._wheel(each, **sizes, second=k == 1) for k, each in enumerate(wheels.pair))
        if wheels.wrapped:
            radii = [asdict(each.radius) for each in wheels.pair if each.radius is not None]
            crossed = wheels.ratio.value < 0
            self._after.append(
                {"kind": "strands", "layer": "ground", "points": ends, "radii": radii, "crossed": crossed}
            )
        elif b_new or a_new:
            mine, other = (b, a) if b_new else (a, b)
            self._wheels[mine][1]["mesh"] = other

    def _rack(self, way: RackWay) -> None:
        """The pinion, and the rack as far as it is used."""
        number, _ = self._wheel(way.pinion)
        self._after.append(
            {
                "kind": "rack",
                "layer": "ground",
                "link": way.rack,
                "along": _along(way.rack),
                "mesh": number,
                "at": key_of(self.machine, way.rack, way.through),
                "inside": way.right,
                "turn": asdict(way.turn),
            }
        )

    def _cam(self, contact: CamContact) -> Plain:
        """A cam by what its follower touches."""
        key = partial(key_of, self.machine)
        return {
            "kind": "cam",
            "layer": "ground",
            "link": contact.cam,
            "along": _along(contact.cam),
            "at": key(contact.cam, contact.centre),
            "trace": key(contact.follower, contact.at),
            "follower": contact.follower,
            "carrier": contact.carrier,
            "touch": contact.touch,
            "groove": contact.groove,
            "radius": asdict(contact.roller),
            "base": asdict(contact.base),
            "side": contact.side,
            **({"joint": contact.guide} if contact.guide else {"tie": key(contact.follower, contact.pivot)}),
        }


def undrawn(machine: DrawnMechanism) -> list[str]:
    """Joints that the page shows by their numbers only."""
    mechanism = machine.motion.mechanism
    known = {*mechanism.pins, *mechanism.guides, *mechanism.welds}
    return [
        name
        for name, joint in mechanism.joints.items()
        if name not in known and contact_shape(joint, mechanism) is None
    ]


def _welds(machine: DrawnMechanism) -> Iterator[Plain]:
    joints = machine.motion.mechanism.welds.values()
    for joint, part in zip(joints, welds(machine), strict=True):
        yield _tied(machine, part, joint.at)


def _tied(machine: DrawnMechanism, part: Part, point: str | None = None) -> Plain:
    """A part in its carrier's axes, tied to one of the carrier's points."""
    names = list(machine.motion.mechanism.link(part.carrier).points)
    if point is None:
        middle = np.concatenate(part.shape.ink).mean(axis=0)
        places = np.array([machine.local(part.carrier, name) for name in names])
        point = names[int(np.hypot(*(places - middle).T).argmin())]
    at = np.array(machine.local(part.carrier, point))
    shape = Shape(tuple(each.placed(-at) for each in part.shape.elements))
    return _stamp(part.layer, key_of(machine, part.carrier, point), _along(part.carrier), shape)


def _load(machine: DrawnMechanism, load: Load) -> Iterator[Plain]:
    ends = [key_of(machine, each.link, each.point) for each in named_points(machine, load)]
    if load.kind in SYMBOLS and len(ends) == _LENGTHS:
        yield {"kind": load.kind, "layer": "bodies", "points": ends}
    elif isinstance(press := mark_of(load, machine.motion, 0), Press):
        shape = pressing(machine, press, (0.0, 0.0), (1.0, 0.0))
        yield _stamp("marks", ends[0], row_name("guide_direction", press.joint), shape)
    elif load.kind in SYMBOLS and ends:
        yield _stamp("marks", ends[0], 0.0, SYMBOLS[load.kind]())
    elif load.kind in SYMBOLS:
        pin = _common_pin(machine, load)
        if pin is not None:
            yield _stamp("marks", pin, 0.0, SYMBOLS[load.kind]())
    elif not isinstance(mark_of(load, machine.motion, 0), Turn):
        yield {"kind": "load", "layer": "marks", "load": load.name}


def _stops(machine: DrawnMechanism) -> Iterator[Plain]:
    """End stops, ``off`` (m, downwards) from a point of the frame."""
    pins = (name for name, joint in machine.pins.items() if "frame" in joint.links)
    guides = (joint.through for joint in machine.guides.values() if joint.guide == "frame")
    fixed = next(pins, None) or next(guides, None)
    if fixed is None:
        return
    x, y = machine.motion.mechanism.link("frame").points[fixed]
    for place, gap, toward in touches(machine):
        off = [place[0] - x, y - place[1]]
        yield _stamp("ground", key_of(machine, "frame", fixed), 0.0, end_stop(gap, toward), off=off)


def _along_line(machine: DrawnMechanism, actuator: Actuator) -> Iterator[Plain]:
    """A cylinder or linear motor between two points; lengths of its barrel and its rod, m."""
    if not isinstance(actuator, Cylinder | Motor) or actuator.between is None:
        return
    barrel, rod = (each / machine.view.scale for each in lengths(machine, *actuator.between))
    ends = [key_of(machine, each.link, each.point) for each in actuator.between]
    yield {"kind": "cylinder", "layer": "blocks", "through": ends[0], "at": ends[1], "barrel": barrel, "piston": rod}


def _common_pin(machine: DrawnMechanism, load: Load) -> str | None:
    links = set(load.pair)
    return next((name for name, joint in machine.pins.items() if links and links <= set(joint.links)), None)


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
