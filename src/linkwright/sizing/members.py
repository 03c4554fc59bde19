"""Links as members: the line along which a link carries forces, and what acts on its cross sections."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import permutations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.construction import LinkShape
from linkwright.mechanism.link import Link, Vec
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.plate import needs_width, path_of, shape_kind
from linkwright.mechanism.wheels_and_cams import disc_radii
from linkwright.parts.beams.axis import LinkAxis
from linkwright.parts.beams.cut import STRAIGHT, LinkCut, LinkLine
from linkwright.sizing.rule import extent

#: Stations between two corners, and where only chains are compared.
STATIONS, FEW = 51, 7
#: Of so many points all chains are compared.
MANY = 4
#: Stations within this share of the length of a pin are at it.
NEAR = 1e-9


@dataclass(frozen=True, eq=False)
class Member:
    """A link that carries forces along a ``line``: a bar, or one that lies within the plate.

    By the static theorem of limit analysis a plate is at least as strong as any bar that lies within it. So a plate
    is sized by the chain of bars through its points that has the smallest moments. ``length``, m, for buckling: along
    a bar, between the two points of a plate that are farthest apart.
    """

    line: LinkLine
    pins: tuple[str, ...]
    length: float

    def cut(self, forces: Forces) -> LinkCut:
        """Forces along it."""
        return LinkCut(forces, self.line)

    @property
    def name(self) -> str:
        """Name of the link."""
        return self.line.link.name

    def bores(self, diameters: Mapping[str, float]) -> Floats:
        """Diameters of the holes at the stations, (k,) m; 0 where there is none."""
        stations, places = self.line.stations, self.line.point_places
        found = np.zeros(len(stations))
        for name in self.pins:
            at = np.abs(stations - places[name]) <= NEAR * self.line.axis.length
            found[at] = np.maximum(found[at], diameters[name])
        return found


def members(mechanism: Mechanism, forces: Forces) -> dict[str, Member]:
    """The links of a machine that have a length, without those that are discs or have an outline of their own."""
    found = {}
    for name, link in mechanism.links.items():
        if len(set(link.points.values())) < 2 or not needs_width(link) or _is_disc(mechanism, link):
            continue
        pins = tuple(each for each, pin in mechanism.pins.items() if name in pin.joined)
        line = LinkLine(link, _axis(link, forces), STATIONS)
        found[name] = Member(line, pins, extent(link) if shape_kind(link) == "plate" else line.axis.length)
    return found


def _is_disc(mechanism: Mechanism, link: Link) -> bool:
    """Whether all points of a link lie within a wheel or cam on it."""
    radii = (disc_radii(joint, mechanism).get(link.name, 0.0) for joint in mechanism.joints.values() if joint.higher)
    radius = max(radii, default=0.0)
    places = np.array([*link.points.values()])
    apart = np.linalg.norm(places[:, None] - places, axis=2).max(axis=1)
    return bool(radius and apart.min() <= radius * (1.0 + STRAIGHT))


def _axis(link: Link, forces: Forces) -> LinkAxis:
    if shape_kind(link) != "plate":
        path = path_of(link, link.shape or LinkShape())
        return LinkAxis(np.array([(each.real, each.imag) for each in path]))
    return min(_chains(link), key=lambda axis: _largest_moment(LinkCut(forces, LinkLine(link, axis, FEW))))


def _chains(link: Link) -> Iterator[LinkAxis]:
    """Lines through all points of a link: of few in any order, else in that of the file."""
    names = [name for name, place in link.points.items() if name == _first_at(link, place)]
    orders = permutations(names) if len(names) <= MANY else [tuple(names)]
    for order in orders:
        if order[0] <= order[-1] or len(names) > MANY:
            yield LinkAxis.of(link, order)


def _first_at(link: Link, place: Vec) -> str:
    """The first of the points at a place."""
    return next(name for name, each in link.points.items() if each == place)


def _largest_moment(cut: LinkCut) -> float:
    moments: Floats = np.abs(cut.moment)
    return float(np.nanmax(moments))
