"""Pins: through all plates that turn about one place, with heads at their ends."""

from __future__ import annotations

from dataclasses import replace

from linkwright.shapes.shape import disc
from linkwright.solids.axes import Axis, axes_of, held_by
from linkwright.solids.blocks import around_pin
from linkwright.solids.draft import Draft
from linkwright.solids.guides import Slide
from linkwright.solids.mounting import Axle
from linkwright.solids.solid import Solid
from linkwright.words import _

#: Radius of a pin's head as a share of the pin's (ISO 2341: 1.4 to 1.6), and the smallest; how near it comes to
#: another pin.
HEAD, MIN_HEAD, ROOM = 1.5, 1.2, 0.1


def add_pins(draft: Draft, slides: list[Slide], axles: list[Axle]) -> None:
    """One pin for all joints at one place, through the wheels and cams that are there too."""
    axes = axes_of(draft)
    held = held_by(draft, axes)
    for axis in axes:
        _add_pin(draft, slides, axles, axis, held.get(axis.name, ()))
    _fit_heads(draft, axes)


def _add_pin(draft: Draft, slides: list[Slide], axles: list[Axle], axis: Axis, frame: tuple[str, ...]) -> None:
    places = axis.places
    plates = [*frame, *(each for carrier in places if carrier != "frame" and (each := draft.bodies[carrier].plate))]
    on = [each for each in axles if axis.meets(draft, {each.carrier: each.centre})]
    plates += [each.plate for each in on]
    around = [each.hub for each in on]
    for carrier, place in places.items():
        blocks, guides = around_pin(draft, slides, carrier, place, axis.radius)
        plates += blocks
        around += guides
    if not plates:
        return
    through = tuple(dict.fromkeys(plates))
    carrier = "frame" if "frame" in places else next(iter(places))
    head = HEAD * axis.radius if draft.construction.ends == "heads" else 0.0
    pin = Solid(f"pin {axis.name}", "pin", carrier, disc(places[carrier], axis.radius), through, head)
    draft.add(pin, *through, *around)
    draft.bore(through, places, axis.radius)


def _fit_heads(draft: Draft, axes: list[Axis]) -> None:
    """Makes heads smaller that would meet another pin of their link, and leaves out those without room."""
    without = []
    for axis in axes:
        pin = draft.solids.get(f"pin {axis.name}")
        if pin is None or not pin.head:
            continue
        room = min((_room(axis, each) for each in axes if each is not axis), default=pin.head)
        head = min(pin.head, room - ROOM * axis.radius)
        if head < MIN_HEAD * axis.radius:
            head = 0.0
            without.append(axis.name)
        draft.solids[pin.name] = replace(pin, head=head)
    if without:
        draft.notes[
            _("Pins without heads, for which there is no room next to other pins: {names}.", names=tuple(without))
        ] = None


def _room(axis: Axis, other: Axis) -> float:
    """From the middle of a pin to another pin in the same link, m."""
    shared = axis.places.keys() & other.places.keys()
    gaps = (abs(axis.places[each] - other.places[each]) - other.radius for each in shared)
    return min(gaps, default=float("inf"))
