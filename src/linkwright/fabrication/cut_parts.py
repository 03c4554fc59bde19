"""All parts of a machine: what is cut, turned and put between."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.fabrication.part import Part
from linkwright.layers.arrangement import Layers
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True, eq=False)
class CutParts:
    """The ``parts`` of a machine in the order of the list: plates from below, pins, spacers, washers."""

    mechanism: Mechanism
    layers: Layers
    parts: tuple[Part, ...]

    def __getitem__(self, name: str) -> Part:
        """The part of a name."""
        return next(each for each in self.parts if each.name == name)


def cut_parts(mechanism: Mechanism) -> CutParts:
    """The parts of a machine in the fewest layers in which nothing collides."""
    raise NotImplementedError
