"""Pins: through all plates that turn about one place, with heads at their ends."""

from __future__ import annotations

from linkwright.shapes.shape import disc
from linkwright.solids.draft import Draft
from linkwright.solids.frame import COVER
from linkwright.solids.guides import Slide, around_pin
from linkwright.solids.mounting import Axle
from linkwright.solids.solid import Solid

#: Radius of a pin's head, as a share of the pin's (ISO 2341: 1.4 to 1.6).
HEAD = 1.5


def add_pins(draft: Draft, slides: list[Slide], axles: list[Axle]) -> None:
    """One pin for all joints at one place, through the wheels and cams that are there too."""
    for names in coaxial(draft):
        _add_pin(draft, slides, axles, names)


def coaxial(draft: Draft) -> list[list[str]]:
    """Names of the pins in groups: those in a group have a link with both at the same place."""
    groups: list[list[str]] = []
    for name in draft.mechanism.pins:
        touching = [each for each in groups if any(_same(draft, name, other) for other in each)]
        groups = [each for each in groups if each not in touching]
        groups.append([*(other for each in touching for other in each), name])
    return groups


def _same(draft: Draft, one: str, other: str) -> bool:
    first, second = _places(draft, one), _places(draft, other)
    return any(abs(first[each] - second[each]) <= draft.near for each in first.keys() & second.keys())


def _places(draft: Draft, name: str) -> dict[str, complex]:
    """Where a pin is in the axes of the carriers of its links."""
    links = draft.mechanism.pins[name].joined
    return {draft.carriers.carrier(link): draft.carriers.place(link, name) for link in links}


def _is_on(draft: Draft, axle: Axle, places: dict[str, complex]) -> bool:
    return axle.carrier in places and abs(places[axle.carrier] - axle.centre) <= draft.near


def _add_pin(draft: Draft, slides: list[Slide], axles: list[Axle], names: list[str]) -> None:
    places = {carrier: place for name in names for carrier, place in _places(draft, name).items()}
    plates = [each for carrier in places if (each := draft.bodies[carrier].plate)]
    on = [each for each in axles if _is_on(draft, each, places)]
    plates += [each.plate for each in on]
    around = [each.hub for each in on]
    for carrier, place in places.items():
        reached, blocks = around_pin(draft, slides, carrier, place)
        plates += reached
        around += blocks
    if COVER in draft.solids and "frame" in places:
        plates.append(COVER)
    if not plates:
        return
    radius = max(draft.sizes.pin_radius[name] for name in names)
    flush = draft.construction is not None and draft.construction.ends == "flush"
    carrier = "frame" if "frame" in places else next(iter(places))
    pin, through = f"pin {names[0]}", tuple(dict.fromkeys(plates))
    head = 0.0 if flush else HEAD * radius
    draft.add(Solid(pin, "pin", carrier, disc(places[carrier], radius), through, head), *through, *around)
    draft.bore(through, places, radius)
