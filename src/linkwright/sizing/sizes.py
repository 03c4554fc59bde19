"""The sizes of links and pins of a machine: what its file gives, else from the largest forces, else by rule."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from linkwright.core.data import Frozen
from linkwright.core.quantity import shown
from linkwright.errors import LinkwrightError
from linkwright.formula.recently_made import Recent
from linkwright.mechanism.mechanism import Mechanism
from linkwright.sizing.given import GivenSizes, given_sizes
from linkwright.sizing.link_sizes import LinkSizes
from linkwright.sizing.preferred import decade
from linkwright.sizing.rule import PIN, usual_pin_radius, usual_thickness, usual_width
from linkwright.sizing.size_links import size_links
from linkwright.words import Message, _


@dataclass(frozen=True)
class Sizes(Frozen):
    """Sizes of all links and pins of a machine, m.

    ``width`` and ``thickness`` by the names of the links, the frame's among them; ``pin_radius`` by the names of the
    pins; ``notes``: where those come from that the file does not give.
    """

    width: Mapping[str, float]
    pin_radius: Mapping[str, float]
    thickness: Mapping[str, float]
    notes: tuple[Message, ...] = ()


def sizes_of(mechanism: Mechanism) -> Sizes:
    """The sizes of a machine: what its file gives, else from the largest forces, else by rule.

    The only place that decides it. Raises nothing: where forces cannot be solved, a note says why.
    """
    return _recent.get(mechanism, None, lambda: _sizes(mechanism))


_recent: Recent[Mechanism, Sizes] = Recent(64)


def _sizes(mechanism: Mechanism) -> Sizes:
    given, count = given_sizes(mechanism), len(mechanism.links) + 1
    ruled = _by_rule(mechanism, given)
    if len(given.width) == len(given.thickness) == count and len(given.pin_radius) == len(mechanism.pins):
        return ruled
    width = shown(_usual_width(mechanism), "length")
    if not mechanism.has_loads:
        if mechanism.construction is not None and mechanism.construction.width:
            note = _(
                "Sizes that the file does not give are round shares of the width of links, {width}: pins half as "
                "thick as that, plates a quarter.",
                width=width,
            )
            return _noted(ruled, note)
        note = _(
            "Sizes that the file does not give are round shares of the machine: width {width}, a twelfth of the "
            "usual length of links.",
            width=width,
        )
        return _noted(ruled, note)
    try:
        sized = size_links(mechanism)
    except LinkwrightError as error:
        note = _(
            "Sizes that the file does not give are round shares of the machine, width {width}, as its forces give "
            "none ({why}).",
            width=width,
            why=error.sentence,
        )
        return _noted(ruled, note)
    if not sized.fit:
        note = _(
            "Sizes that the file does not give are round shares of the machine, width {width}: those from its forces "
            "do not leave room for each other ({why}).",
            width=width,
            why=next(each for each in sized.notes if each.code == "sizing.no_room"),
        )
        return _noted(ruled, note)
    return _by_forces(ruled, sized)


def _noted(sizes: Sizes, note: Message) -> Sizes:
    return Sizes(sizes.width, sizes.pin_radius, sizes.thickness, (note,))


def _by_forces(ruled: Sizes, sized: LinkSizes) -> Sizes:
    note = _(
        "Sizes that the file does not give are from the largest forces over the cycle, with a safety factor of "
        "{safety:g} (linkwright size shows how).",
        safety=sized.safety,
    )
    return Sizes(
        {**ruled.width, **{name: each.width for name, each in sized.links.items()}},
        {name: 0.5 * each.diameter for name, each in sized.pins.items()},
        sized.thickness,
        (note, *sized.notes),
    )


def _by_rule(mechanism: Mechanism, given: GivenSizes) -> Sizes:
    """Sizes by rule where the file gives none; no thinner than the pins that it gives need."""
    usual, links = _usual_width(mechanism), ("frame", *mechanism.links)
    width = {name: max(usual, _eye(mechanism, given, name)) for name in links} | dict(given.width)
    radius = {name: usual_pin_radius(min(width[link] for link in pin.joined)) for name, pin in mechanism.pins.items()}
    thickness = dict.fromkeys(links, usual_thickness(usual)) | dict(given.thickness)
    return Sizes(width, radius | dict(given.pin_radius), thickness)


def _usual_width(mechanism: Mechanism) -> float:
    """The width that the file gives for all links, else the one by rule, m."""
    construction = mechanism.construction
    return (construction.width if construction is not None else None) or usual_width(mechanism)


def _eye(mechanism: Mechanism, given: GivenSizes, link: str) -> float:
    """The width of a link around the largest of its pins whose radius is given, m; 0 without."""
    radii = (given.pin_radius.get(name, 0.0) for name, pin in mechanism.pins.items() if link in pin.joined)
    largest = max(radii, default=0.0)
    return decade(largest / PIN, up=True) if largest else 0.0
