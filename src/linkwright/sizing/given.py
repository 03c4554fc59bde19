"""Sizes that the file of a machine gives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class GivenSizes:
    """Widths and thicknesses of links, the frame's among them, and radii of pins that are given, by names, m."""

    width: Mapping[str, float]
    pin_radius: Mapping[str, float]
    thickness: Mapping[str, float]


def given_sizes(mechanism: Mechanism) -> GivenSizes:
    """The sizes that the file gives, each of its own link or pin, else of the construction."""
    construction = mechanism.construction
    shapes = {name: link.shape for name, link in {"frame": mechanism.frame, **mechanism.links}.items()}

    def given(key: str, owners: Mapping[str, Any]) -> dict[str, float]:
        usual: float | None = getattr(construction, key, None)
        found = {name: getattr(owner, key, None) or usual for name, owner in owners.items()}
        return {name: size for name, size in found.items() if size}

    return GivenSizes(given("width", shapes), given("pin_radius", mechanism.pins), given("thickness", shapes))
