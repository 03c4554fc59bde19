"""What drawings show of a joint besides its links: wheels, racks, strands, cams and what touches them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import singledispatch
from math import atan2, pi, sqrt

import numpy as np

from linkwright.joints.base import HigherPair, Joint
from linkwright.joints.belt import BeltPair
from linkwright.joints.cam import CamJoint
from linkwright.joints.gear import GearPair
from linkwright.joints.rack import RackPair
from linkwright.joints.rolling import RollingPair
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.wheels_and_cams import CamShape, full_turn
from linkwright.pictures.symbols.base import SYMBOLS, Shape
from linkwright.plotting.drawing.machine import DrawnMechanism, Part

Vec = tuple[float, float]
#: Radius of the circle of a pair of no known shape, as a share of the mechanism's size.
UNKNOWN = 0.01
#: Where wheels (link, centre) that are drawn already have a tooth, rad in their axes.
Teeth = dict[tuple[str, str], float]


@dataclass(frozen=True)
class Mark:
    """A ``symbol`` (``gear``, ``disc``, ``rack``, ``strand``, ``cam``, ``roller``, ``knife`` or ``face``) on a
    link, in its axes, m and rad.

    ``at``: centre, point of the pitch line, edge, or first end; ``to``: second end of a strand or a face; ``turned``:
    place of a tooth, or direction of a rack or of a knife; ``inside``: teeth inwards, or right of a rack;
    ``follows``: the link and point along whose way a rack reaches; ``outlines``: closed curves of a cam, its profile,
    a roller's pitch curve and the outer wall of a groove (each empty where there is none).
    """

    symbol: str
    link: str
    at: Vec
    radius: float = 0.0
    turned: float = 0.0
    inside: bool = False
    teeth: int | None = None
    to: Vec = (0.0, 0.0)
    follows: tuple[str, str] | None = None
    outlines: tuple[tuple[Vec, ...], ...] = ()


@singledispatch
def marks(joint: Joint, mechanism: Mechanism, tooth: Teeth) -> Iterable[Mark]:
    """The marks of a joint, none of one that shows nothing; it adds its own teeth to those that are drawn."""
    return ()


@marks.register
def _(joint: HigherPair, mechanism: Mechanism, tooth: Teeth) -> Iterator[Mark]:
    """Of a kind that registers no marks of its own a small circle where its links touch."""
    link, point = joint.seats[0]
    yield Mark("roller", link, mechanism.link(link).points[point], UNKNOWN * mechanism.size)


@marks.register
def wheels_without_teeth(joint: RollingPair, mechanism: Mechanism, tooth: Teeth) -> Iterator[Mark]:
    """Two wheels of the pitch radii."""
    radii = [abs(each) for each in joint.arms(mechanism)]
    for k, link in enumerate(joint.links):
        ring = joint.mesh == "internal" and radii[k] > radii[1 - k]
        centre = mechanism.link(link).points[joint.centres[k]]
        yield Mark("gear" if joint.toothed else "disc", link, centre, radii[k], inside=ring)


@marks.register
def _(joint: GearPair, mechanism: Mechanism, tooth: Teeth) -> Iterable[Mark]:
    """Two gears whose teeth mesh, where their numbers are known; else two wheels of the pitch radii."""
    wheels = wheels_without_teeth(joint, mechanism, tooth)
    if joint.teeth is None:
        return wheels
    turned = _meshing(joint, mechanism, tooth)
    return [
        replace(mark, turned=turn, teeth=int(z)) for mark, turn, z in zip(wheels, turned, joint.teeth, strict=True)
    ]


def _meshing(joint: GearPair, mechanism: Mechanism, tooth: Teeth) -> tuple[float, float]:
    """Where a tooth of each wheel is, rad in its axes, so that teeth of one lie in gaps of the other.

    With the numbers of pitches u, v from a tooth to the pitch point, counter-clockwise: u + v (external) or v - u
    (internal) is an integer and a half, in all positions if it is in one.
    """
    assert joint.teeth is not None
    points = mechanism.link(joint.carrier).points
    (ax, ay), (bx, by) = (points[each] for each in joint.centres)
    line, (za, zb), phase = atan2(by - ay, bx - ax), joint.teeth, joint.phase or 0.0
    from_a = line if joint.arms(mechanism)[0] > 0 else line + pi
    from_b = line + pi if joint.arms(mechanism)[1] > 0 else line
    a, b = ((link, centre) for link, centre in zip(joint.links, joint.centres, strict=True))
    sense = -joint.sense

    def other(z: float, toward: float, mine: float, own: float) -> float:
        """Tooth of one wheel from that of the other: sense · u z + v z' = half a pitch."""
        return (toward * z + sense * mine - pi) / z - own

    if a not in tooth and b in tooth:
        tooth[a] = other(za, from_a, (from_b - phase - tooth[b]) * zb, 0.0)
    tooth.setdefault(a, 0.0)
    if b not in tooth:
        tooth[b] = other(zb, from_b - phase, (from_a - tooth[a]) * za, 0.0)
    return tooth[a], tooth[b]


@marks.register
def _(joint: BeltPair, mechanism: Mechanism, tooth: Teeth) -> Iterator[Mark]:
    """Two pulleys and the strands between them."""
    radii = joint.pitch_radii()
    for k, link in enumerate(joint.links):
        yield Mark("disc", link, mechanism.link(link).points[joint.centres[k]], radii[k])
    points = mechanism.link(joint.carrier).points
    a, b = (complex(*points[each]) for each in joint.centres)
    e, far = (b - a) / abs(b - a), abs(b - a)
    sine = (radii[0] - joint.sense * radii[1]) / far
    for side in (1.0, -1.0):
        n = e * complex(sine, side * sqrt(1.0 - sine * sine))
        yield Mark("strand", joint.carrier, _vec(a + radii[0] * n), to=_vec(b + joint.sense * radii[1] * n))


@marks.register
def _(joint: RackPair, mechanism: Mechanism, tooth: Teeth) -> Iterator[Mark]:
    """The pinion, and the rack as far as it is used."""
    follows = joint.pinion, joint.centre
    centre = mechanism.link(joint.pinion).points[joint.centre]
    teeth = None if joint.teeth is None else int(joint.teeth)
    yield Mark("gear", joint.pinion, centre, joint.radius, tooth.get(follows, 0.0), teeth=teeth)
    start = mechanism.link(joint.rack).points[joint.through]
    yield Mark("rack", joint.rack, start, turned=joint.direction, inside=joint.side < 0, follows=follows)


@marks.register
def _(joint: CamJoint, mechanism: Mechanism, tooth: Teeth) -> Iterator[Mark]:
    """The cam, and the roller, the edge or the face; nothing of a cam that nothing holds."""
    if not joint.centre:
        return
    shape, phi = CamShape.of(joint, mechanism), full_turn()
    profile = shape.profile(phi)
    outer = shape.profile(phi, outer=True) if joint.closure == "groove" and joint.touch == "roller" else ()
    pitch = shape.pitch(phi) if joint.touch == "roller" else ()
    reach = float(np.abs(profile - shape.centre).max())
    outlines = tuple(tuple(_vec(each) for each in line) for line in (profile, pitch, outer))
    yield Mark("cam", joint.cam, _vec(shape.centre), reach, outlines=outlines)
    at = _vec(shape.at)
    if joint.touch == "roller":
        yield Mark("roller", joint.follower, at, joint.roller_radius)
    elif joint.touch == "knife":
        off = {"": 0.0, "left": 0.5 * pi, "right": -0.5 * pi}[joint.side]
        yield Mark("knife", joint.follower, at, turned=shape.geometry.own + off)
    else:
        start, end = shape.face()
        yield Mark("face", joint.follower, _vec(start), to=_vec(end))


@singledispatch
def touching(joint: HigherPair) -> tuple[str, str]:
    """A link and its point nearest to which the force of a pair is drawn on its line of action."""
    return joint.seats[0]


@touching.register
def _(joint: CamJoint) -> tuple[str, str]:
    return joint.follower, joint.at


def _vec(place: complex) -> Vec:
    return float(place.real), float(place.imag)


#: A rack goes on beyond the last place of its pinion, units of the paper.
BEYOND = 14.0
#: Ends of followers, drawn over the blocks that carry them.
_OVER = ("roller", "knife", "face")


def wheels(machine: DrawnMechanism) -> Iterator[Part]:
    """The marks of all joints, each wheel once: below everything else, rings and large ones first, but the ends of
    followers on top."""
    mechanism = machine.motion.mechanism
    tooth: dict[tuple[str, str], float] = {}
    found: dict[Mark, Mark] = {}
    for joint in mechanism.joints.values():
        for mark in marks(joint, mechanism, tooth):
            key = replace(mark, radius=round(mark.radius, 9), turned=0.0, teeth=None, follows=None)
            found.setdefault(key, mark)
    for mark in sorted(found.values(), key=lambda each: (not each.inside, -each.radius)):
        yield Part("tops" if mark.symbol in _OVER else "ground", mark.link, _shape(machine, mark))


def _shape(machine: DrawnMechanism, mark: Mark) -> Shape:
    scale, at = machine.view.scale, machine.view.local(mark.at)
    if mark.symbol == "gear":
        return SYMBOLS["gear"](
            at=at, radius=mark.radius * scale, turned=-mark.turned, inside=mark.inside, teeth=mark.teeth
        )
    if mark.symbol in ("disc", "roller"):
        return SYMBOLS[mark.symbol](at=at, radius=mark.radius * scale)
    if mark.symbol in ("strand", "face"):
        return SYMBOLS[mark.symbol](start=at, end=machine.view.local(mark.to))
    if mark.symbol == "knife":
        return SYMBOLS["knife"](at=at, along=(math.cos(mark.turned), -math.sin(mark.turned)))
    if mark.symbol == "cam":
        profile, pitch, outer = ([machine.view.local(each) for each in line] for line in mark.outlines)
        return SYMBOLS["cam"](profile=profile, pitch=pitch, outer=outer)
    assert mark.follows is not None
    along = (math.cos(mark.turned), -math.sin(mark.turned))
    link, point = mark.follows
    gap = machine.placed[link].world(machine.motion.mechanism.link(link).points[point])
    placed = machine.placed[mark.link]
    gap = gap - placed.world(mark.at)
    c, s = math.cos(mark.turned), math.sin(mark.turned)
    ex, ey = placed.direction[:, 0], placed.direction[:, 1]
    ways = (gap[:, 0] * (ex * c - ey * s) + gap[:, 1] * (ey * c + ex * s)) * scale
    low, high = float(np.nanmin(ways)) - BEYOND, float(np.nanmax(ways)) + BEYOND
    if mark.inside:
        along, low, high = (-along[0], -along[1]), -high, -low
    return SYMBOLS["rack"](at=at, along=along, start=low, end=high)
