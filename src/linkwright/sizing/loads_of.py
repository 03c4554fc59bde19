"""The largest forces of a machine over its cycle, as its pins and links see them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.beams.cut import LinkCut
from linkwright.sizing.links import Section, needed_widths
from linkwright.sizing.members import Member, members
from linkwright.sizing.peaks import Largest, peaks

#: Links turn on a pin that turn by more than this, rad.
TURNING = 1e-6


@dataclass(frozen=True, eq=False)
class MachineLoads:
    """Forces of a machine over its cycle, and what is largest of them."""

    mechanism: Mechanism
    forces: Forces

    @cached_property
    def members(self) -> Mapping[str, Member]:
        """The links that have a length."""
        return members(self.mechanism, self.forces)

    @property
    def on_pins(self) -> Mapping[tuple[str, str], Largest]:
        """The largest force of every pin on each of its links."""
        return self._largest[0]

    @property
    def compression(self) -> Mapping[str, Largest]:
        """The largest compression of every member."""
        return self._largest[1]

    @property
    def moments(self) -> Mapping[str, Largest]:
        """The largest bending moment of every member."""
        return self._largest[2]

    @cached_property
    def _largest(self) -> tuple[Mapping[Any, Largest], ...]:
        sides = [(name, link) for name, pin in self.mechanism.pins.items() for link in pin.joined]
        names = list(self.members)

        def signals(forces: Forces) -> Floats:
            sizes = [np.linalg.norm(forces.reaction(name, on=link), axis=1) for name, link in sides]
            cuts = [self._cut(name, forces) for name in names]
            pressed = [np.maximum(-cut.normal, 0.0).max(axis=1) for cut in cuts]
            bent = [np.abs(cut.moment).max(axis=1) for cut in cuts]
            return np.stack([*sizes, *pressed, *bent]) if sizes or cuts else np.zeros((0, forces.steps))

        found = iter([each.largest for each in peaks(self.forces, signals)])
        return tuple(dict(zip(keys, islice(found, len(keys)), strict=True)) for keys in (sides, names, names))

    def _cut(self, name: str, forces: Forces) -> LinkCut:
        """A member cut under some forces."""
        return self._base_cuts[name] if forces is self.forces else self.members[name].cut(forces)

    @cached_property
    def _base_cuts(self) -> Mapping[str, LinkCut]:
        return {name: member.cut(self.forces) for name, member in self.members.items()}

    @cached_property
    def turning(self) -> frozenset[tuple[str, str]]:
        """Pairs of a pin and a link on it that turns against the pin's first link, or the frame."""
        angles = {name: self.forces.motion.link(name).angle for name in self.mechanism.links}
        angles["frame"] = np.zeros(self.forces.steps)
        found = set()
        for name, pin in self.mechanism.pins.items():
            seat = seat_of(pin.joined)
            found |= {(name, link) for link in pin.joined if np.ptp(angles[link] - angles[seat]) > TURNING}
        return frozenset(found)

    def rough_width(self, name: str, bores: Mapping[str, float], thickness: float, stress: float) -> float:
        """The width, m, that the stress asks for of a member at the positions that were solved."""
        cut = self._base_cuts[name]
        return float(np.nanmax(needed_widths(cut, self.members[name].bores(bores), thickness, stress)))

    def sections(
        self, bores: Mapping[str, float], thickness: Mapping[str, float], stress: Mapping[str, float]
    ) -> dict[str, Section]:
        """The section of every member at which the stress asks for the largest width, between the positions too."""
        wanted = list(self.members.values())

        def widths(member: Member, forces: Forces) -> Floats:
            name, cut = member.name, self._cut(member.name, forces)
            return needed_widths(cut, member.bores(bores), thickness[name], stress[name])

        def signals(forces: Forces) -> Floats:
            rows = [widths(each, forces).max(axis=1) for each in wanted]
            return np.stack(rows) if rows else np.zeros((0, forces.steps))

        found = {}
        for member, peak in zip(wanted, peaks(self.forces, signals), strict=True):
            cut, i = member.cut(peak.forces), peak.index
            k = int(widths(member, peak.forces)[i].argmax())
            bore, place = float(member.bores(bores)[k]), float(member.line.stations[k])
            normal, moment = float(cut.normal[i, k]), float(cut.moment[i, k])
            rounding = 1e-12 * max(abs(normal) * member.length, float(np.abs(cut.moment).max()))
            moment = moment if abs(moment) > rounding else 0.0
            found[member.name] = Section(normal, moment, place, bore, peak.largest.at)
        return found


def seat_of(links: tuple[str, ...]) -> str:
    """The link in which a pin is fixed: the frame if that is on it, else the first."""
    return "frame" if "frame" in links else links[0]
