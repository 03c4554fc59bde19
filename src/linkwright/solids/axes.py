"""Axes about which links turn: where pins are, how thick, and where the frame holds them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.shapes.distance import core_distances
from linkwright.solids.draft import Draft
from linkwright.solids.links import COVER
from linkwright.solids.mounting import roller_pin
from linkwright.words import _

#: A link comes over a pin where it is nearer to its middle at a solved position than so many of its radii.
NEAR = 1.02


@dataclass(frozen=True)
class Axis:
    """The pins at one place as one: its ``name``, its ``places`` in the axes of the carriers of its links and its
    ``radius``, m."""

    name: str
    places: Mapping[str, complex]
    radius: float

    def meets(self, draft: Draft, other: Mapping[str, complex]) -> bool:
        """Whether a link has both at the same place."""
        return any(abs(self.places[each] - other[each]) <= draft.near for each in self.places.keys() & other.keys())


def axes_of(draft: Draft) -> list[Axis]:
    """The pins of the joints, one for all at one place, and those of rollers that turn on none of these."""
    found: list[Axis] = []
    for name, pin in draft.mechanism.pins.items():
        places = {draft.carriers.carrier(link): draft.carriers.place(link, name) for link in pin.joined}
        found = _with(draft, found, Axis(name, places, draft.sizes.pin_radius[name]))
    for body in draft.bodies.values():
        for joint in draft.rollers(body):
            places = {body.carrier: draft.carriers.place(joint.follower, joint.at)}
            if not any(each.meets(draft, places) for each in found):
                found.append(Axis(joint.name, places, roller_pin(draft, joint)))
    return found


def _with(draft: Draft, axes: Iterable[Axis], new: Axis) -> list[Axis]:
    """Axes with a new one, which is one with those at its place."""
    known = [*axes]
    together = [each for each in known if each.meets(draft, new.places)]
    apart = [each for each in known if each not in together]
    places = {carrier: place for each in (*together, new) for carrier, place in each.places.items()}
    radius = max(each.radius for each in (*together, new))
    return [*apart, Axis((together or [new])[0].name, places, radius)]


def held_by(draft: Draft, axes: Iterable[Axis]) -> dict[str, tuple[str, ...]]:
    """The plates of the frame that hold the pins in it, by the pins' names.

    Of a frame on both sides these are the base and the cover, unless something moves over the pin: then one of them.
    Two pins of which each passes where a link of the other moves, as those of two cranks that turn fully, are held on
    different sides.
    """
    fixed = [each for each in axes if "frame" in each.places]
    base = tuple(each for each in ("frame",) if each in draft.solids)
    if COVER not in draft.solids:
        return {each.name: base for each in fixed}
    crossed = {each.name: _crossed(draft, each) for each in fixed}
    found: dict[str, tuple[str, ...]] = {name: (*base, COVER) for name, carriers in crossed.items() if not carriers}
    for axis in fixed:
        if axis.name not in found:
            against = [
                each
                for each in fixed
                if crossed[axis.name] & each.places.keys() and crossed[each.name] & axis.places.keys()
            ]
            taken = {found[each.name] for each in against if each.name in found}
            found[axis.name] = (COVER,) if base in taken and (COVER,) not in taken else base
    single = tuple(name for name, carriers in crossed.items() if carriers)
    if single:
        draft.notes[_("Pins that are held on one side only, as links move over them: {names}.", names=single)] = None
    return found


def _crossed(draft: Draft, axis: Axis) -> frozenset[str]:
    """Carriers of plates that come over a pin of the frame which is not theirs."""
    place, found = axis.places["frame"], set()
    radius = axis.radius * NEAR + (draft.construction.clearance or 0.0)
    for solid in draft.solids.values():
        if solid.sort == "frame" or not solid.is_plate or solid.carrier in axis.places.keys() - {"frame"}:
            continue
        seen = draft.path_of("frame", place, solid.carrier)
        seen = seen[np.abs(seen - solid.shape.bound[0]) <= solid.shape.bound[1] + radius]
        if any((core_distances(each, seen) <= each.radius + radius).any() for each in solid.shape.pieces):
            found.add(solid.carrier)
    return frozenset(found)
