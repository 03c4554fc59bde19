"""The sizes of links and pins of a machine: what its file gives, else by rule."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.core.data import Frozen
from linkwright.core.quantity import shown
from linkwright.formula.recently_made import Recent
from linkwright.mechanism.mechanism import Mechanism
from linkwright.sizing.preferred import decade
from linkwright.sizing.rule import PIN, usual_pin_radius, usual_thickness, usual_width
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
    """The sizes of a machine: what its file gives, else by rule. The only place that decides it."""
    return _recent.get(mechanism, None, lambda: _sizes(mechanism))


_recent: Recent[Mechanism, Sizes] = Recent(64)


def _sizes(mechanism: Mechanism) -> Sizes:
    given = given_sizes(mechanism)
    usual = usual_width(mechanism)
    links = ("frame", *mechanism.links)
    pins = mechanism.pins
    width = {name: max(usual, _eye(mechanism, given, name)) for name in links} | dict(given.width)
    radius = {name: usual_pin_radius(min(width[link] for link in pin.joined)) for name, pin in pins.items()} | dict(
        given.pin_radius
    )
    thickness = dict.fromkeys(links, usual_thickness(usual)) | dict(given.thickness)
    missing = len(given.width) < len(links) or len(given.pin_radius) < len(pins) or len(given.thickness) < len(links)
    note = _(
        "Sizes that the file does not give are round shares of the machine: width {width}, a twelfth of the "
        "usual length of links.",
        width=shown(usual, "length"),
    )
    return Sizes(width, radius, thickness, (note,) if missing else ())


def given_sizes(mechanism: Mechanism) -> Sizes:
    """The sizes that the file gives, of some links and pins only."""
    construction: Any = getattr(mechanism, "construction", None)
    links = {"frame": mechanism.frame, **mechanism.links}
    shapes: dict[str, Any] = {name: getattr(link, "shape", None) for name, link in links.items()}

    def given(key: str, owners: Mapping[str, Any]) -> dict[str, float]:
        usual: float | None = getattr(construction, key, None)
        found = {name: getattr(owner, key, None) or usual for name, owner in owners.items()}
        return {name: size for name, size in found.items() if size}

    return Sizes(given("width", shapes), given("pin_radius", mechanism.pins), given("thickness", shapes))


def _eye(mechanism: Mechanism, given: Sizes, link: str) -> float:
    """The width of a link around the largest of its pins whose radius is given, m; 0 without."""
    radii = (given.pin_radius.get(name, 0.0) for name, pin in mechanism.pins.items() if link in pin.joined)
    largest = max(radii, default=0.0)
    return decade(largest / PIN, up=True) if largest else 0.0
