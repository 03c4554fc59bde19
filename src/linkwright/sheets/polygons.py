"""Velocity, acceleration and force polygons as panels, to preferred scales."""

from __future__ import annotations

import re
from abc import abstractmethod
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import per_mm
from linkwright.kinetostatics.forces import link_numbers
from linkwright.pictures.labels import Name, put
from linkwright.pictures.picture import MIN_TEXT, Picture, as_runs, indexed, joined
from linkwright.plotting.diagrams.marks import LOW
from linkwright.plotting.diagrams.motion_polygons import (
    MotionPolygon,
    acceleration_polygon,
    arrows,
    gathered,
    velocity_polygon,
)
from linkwright.plotting.diagrams.scaled_page import SHARES, SHORT, corners, end_to_end
from linkwright.plotting.free_bodies import Action
from linkwright.sheets.panel import Drawn, Panel, preferred
from linkwright.sheets.positions import Positions, Shown
from linkwright.words import Message, _

#: Letters at the ends of parts of an acceleration.
ENDS = {"normal": "n", "coriolis": "k"}


class ScaledPanel(Panel):
    """A panel of vectors to a preferred scale, SI per mm; ``symbol`` and ``unit`` of that scale."""

    smallest, largest = 34.0, 130.0
    symbol: ClassVar[str]
    unit: ClassVar[str]

    def __init__(self, name: str, rank: float, positions: Positions, shown: Shown) -> None:
        self.name, self.rank = name, rank
        self.positions, self.shown = positions, shown
        self._pictures: dict[float, Picture] = {}

    @abstractmethod
    def reach(self) -> float:
        """The longer side of the picture, SI."""

    @abstractmethod
    def picture(self, scale: float) -> Picture:
        """The picture to a scale, SI per mm."""

    @abstractmethod
    def caption(self) -> str:
        """What it shows."""

    def drawn(self, size: float, scale: float | None) -> Drawn:
        chosen = scale or preferred(self.reach() / max(size - 10.0, 8.0))
        mu = joined(indexed("μ", self.symbol), f" = {chosen:g} {per_mm(self.unit)}")
        if chosen not in self._pictures:
            self._pictures[chosen] = self.picture(chosen)
        return Drawn(self._pictures[chosen], (as_runs(self.caption()), mu))


class MotionPolygonPanel(ScaledPanel):
    """A velocity or acceleration polygon: absolute vectors thick, relative ones thin, parts dashed."""

    prime: ClassVar[str] = ""
    title: ClassVar[Message]
    title_at: ClassVar[Message]

    def __init__(self, name: str, rank: float, positions: Positions, shown: Shown) -> None:
        super().__init__(name, rank, positions, shown)
        self.polygon = self.made()
        self.longest = float(np.ptp(self.polygon.places, axis=0).max())

    @abstractmethod
    def made(self) -> MotionPolygon:
        """The polygon in SI units."""

    def reach(self) -> float:
        return self.longest

    def caption(self) -> str:
        positions = self.positions
        if len(positions.shown) < 2:
            return positions.subject.words(self.title)
        return positions.subject.words(self.title_at.format(number=self.shown.number))

    def picture(self, scale: float) -> Picture:
        found = Picture()
        pairs = arrows(self.polygon, scale)
        for step, (start, end) in zip(self.polygon.steps, pairs, strict=True):
            if step.role == "absolute":
                found.arrow(start, end)
        for step, (start, end) in zip(self.polygon.steps, pairs, strict=True):
            if step.role != "absolute":
                found.arrow(start, end, "thin" if step.role in ("relative", "sliding") else "dashed")
        names: list[Name] = []
        for texts, place in gathered(self.polygon, scale, self.prime):
            found.circle(place, 0.45, fill="ink")
            runs = as_runs(", ".join(map(self._short, texts)))
            names.append(Name(runs, [place], self.letters, symbol=True))
        names += self._ends(pairs)
        put(found, names)
        return found

    def _short(self, text: str) -> str:
        """A name of an image; that of a guide's point under a block, ``a(lever)``, with the number of its link."""
        found = re.fullmatch(r"(\w+)\((.+)\)(′?)", text)
        numbers = link_numbers(self.positions.mechanism)
        if found is None or found[2] not in numbers:
            return text
        return f"{found[1]}{str(numbers[found[2]]).translate(LOW)}{found[3]}"

    def _ends(self, pairs: list[tuple[Floats, Floats]]) -> list[Name]:
        """n′ at the ends of normal parts, k′ at those of Coriolis parts, numbered where there are several."""
        parts = {
            role: [
                end
                for step, (start, end) in zip(self.polygon.steps, pairs, strict=True)
                if step.role == role and np.hypot(*(end - start)) > SHORT
            ]
            for role in ENDS
        }
        found = []
        for role, ends in parts.items():
            for number, end in enumerate(ends, 1):
                runs = as_runs(((f"{ENDS[role]}′", 0), (str(number) if len(ends) > 1 else "", -1)))
                found.append(Name(runs, [end], MIN_TEXT, symbol=True))
        return found


class VelocityPanel(MotionPolygonPanel):
    """The velocity polygon of a position."""

    symbol, unit = "v", "m/s"
    title = _("Velocity polygon")
    title_at = _("Velocity polygon, position {number}")

    def made(self) -> MotionPolygon:
        return velocity_polygon(self.positions.motion, self.shown.index)


class AccelerationPanel(MotionPolygonPanel):
    """The acceleration polygon of a position."""

    symbol, unit, prime = "a", "m/s²", "′"
    title = _("Acceleration polygon")
    title_at = _("Acceleration polygon, position {number}")

    def made(self) -> MotionPolygon:
        return acceleration_polygon(self.positions.motion, self.shown.index)


class ForcePanel(ScaledPanel):
    """The force polygon of a link: loads, weight, inertia force, then joint forces; it closes."""

    symbol, unit = "F", "N"
    smallest, largest = 28.0, 90.0

    def __init__(
        self, name: str, rank: float, positions: Positions, shown: Shown, link: str, vectors: list[Action]
    ) -> None:
        super().__init__(name, rank, positions, shown)
        self.link = link
        self.vectors = vectors
        self.forces = [each.force for each in vectors]

    def reach(self) -> float:
        return float(np.ptp(corners(self.forces), axis=0).max()) or 1.0

    def caption(self) -> str:
        words, number = self.positions.subject.words, link_numbers(self.positions.mechanism)[self.link]
        if len(self.positions.shown) < 2:
            return words(_("Force polygon of link {link}", link=number))
        return words(_("Force polygon of link {link}, position {number}", link=number, number=self.shown.number))

    def picture(self, scale: float) -> Picture:
        found = Picture()
        names = []
        for vector, (start, end) in zip(self.vectors, end_to_end(self.forces, scale), strict=True):
            found.arrow(start, end, "thick" if vector.role == "reaction" else "thin")
            if np.hypot(*(end - start)) > SHORT:
                spots = [start + share * (end - start) for share in SHARES]
                runs = indexed(vector.letter, vector.index)
                names.append(Name(runs, spots, self.letters, clear=1.2, symbol=True))
        put(found, names)
        return found
