"""All parts of a machine: what is cut, turned and put between."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from linkwright.core.arguments import require
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.table import Table, Tabular
from linkwright.errors import LinkwrightError
from linkwright.fabrication.holes import Assembly
from linkwright.fabrication.part import Part
from linkwright.fabrication.plates import Plates
from linkwright.fabrication.room import Room
from linkwright.fabrication.turned import Turned
from linkwright.layering.arrangement import Layers
from linkwright.layering.layers_of import layers
from linkwright.mechanism.construction import MATERIALS
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


@dataclass(frozen=True, eq=False)
class CutParts(Tabular, PlotMixin):
    """The ``parts`` of a machine in the order of the list: plates from below, pins, spacers, washers."""

    mechanism: Mechanism
    layers: Layers
    parts: tuple[Part, ...]
    notes: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> Part:
        """The part of a name."""
        return next(each for each in self.parts if each.name == name)

    @property
    def mass(self) -> float:
        """Of all parts together, kg."""
        return sum(each.count * each.mass for each in self.parts)

    @attached
    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The list of parts, and what its numbers mean."""
        raise NotImplementedError

    @attached
    def data(self) -> dict[str, Any]:
        """The parts as plain data, SI."""
        raise NotImplementedError

    @attached
    def save(
        self,
        folder: str | Path,
        forms: Sequence[str] = ("dxf", "svg"),
        language: str = "en",
        *,
        kerf: float | None = None,
        sheet: tuple[float, float] | None = None,
        force: bool = False,
    ) -> list[Path]:
        """Write drawings of all plates (``forms``: ``dxf``, ``svg``), the sheets on which they are nested, and the
        list of parts (CSV, XLSX) into a folder.

        ``kerf`` (m) and the width and height of a ``sheet`` (m) are those of the model unless given. Raises
        LinkwrightError, and writes none, where one cannot be written or is there already unless ``force``.
        """
        raise NotImplementedError


def cut_parts(mechanism: Mechanism) -> CutParts:
    """The parts of a machine in the fewest layers in which nothing collides.

    Raises LinkwrightError where it has no such layers.
    """
    require(mechanism, Mechanism)
    return parts_in(layers(mechanism))


def parts_in(found: Layers) -> CutParts:
    """The parts of a machine in layers; raises LinkwrightError where these conflict."""
    if found.conflicts:
        raise LinkwrightError(
            _(
                "there are no layers in which nothing collides, so there are no parts to make: {conflicts}; see "
                "linkwright layers",
                code="cut.no_layers",
                conflicts=tuple(each.sentence for each in found.conflicts),
            )
        )
    construction, steel = found.mechanism.construction, MATERIALS["steel"]
    fit, washer = (0.0, 0.0) if construction is None else (construction.fit, construction.washer or 0.0)
    pose = Assembly.of(found)
    turned = Turned(found, pose, Room(found, pose), steel.name, steel.density, fit, washer)
    plates = Plates(found, pose)
    parts = (*plates.parts(), *turned.pins(), *turned.rings())
    return CutParts(found.mechanism, found, parts, (*plates.notes(), *turned.notes, *found.solids.notes))
