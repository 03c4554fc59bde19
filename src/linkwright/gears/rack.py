"""A rack: the gear whose teeth stand in a line."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.attached import attached
from linkwright.errors import RequestError
from linkwright.gears.gear import TOOTH, require_ranges
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.pictures.drawing import Drawing


@dataclass(frozen=True)
class Rack:
    """A rack of ``teeth`` teeth: straight flanks under the pressure angle (rad), pitch π m; ``module`` m (m).

    ``addendum``, ``dedendum`` and ``fillet`` in modules (ISO 53 A). The outline has its datum line on the x axis, the
    teeth upward, the middle of its first tooth at x = 0.
    """

    teeth: int
    module: float
    pressure_angle: float = math.radians(20.0)
    addendum: float = 1.0
    dedendum: float = 1.25
    fillet: float = 0.38

    def __post_init__(self) -> None:
        require_ranges(self, {"teeth": (1, 10_000), **TOOTH})
        if self.dedendum * math.tan(self.pressure_angle) >= math.pi / 4:
            raise RequestError(
                _(
                    "the rack's spaces come to a point above the dedendum of {dedendum} modules; give a smaller one",
                    code="gears.pointed_rack_space",
                    dedendum=self.dedendum,
                )
            )
        if self.addendum * math.tan(self.pressure_angle) >= math.pi / 4:
            raise RequestError(
                _(
                    "the rack's teeth come to a point below the addendum of {addendum} modules; give a smaller one",
                    code="gears.pointed_rack",
                    addendum=self.addendum,
                )
            )

    @property
    def pitch(self) -> float:
        """π m, m."""
        return math.pi * self.module

    def outline(self, points: int = 12) -> Floats:
        """The teeth from left to right and a back one module below the root, closed, (n, 2) m."""
        half = self._half_tooth(points)
        tooth = np.concatenate([half * (-1.0, 1.0), half[::-1]])
        teeth = [tooth + np.array([self.pitch * k, 0.0]) for k in range(self.teeth)]
        low = -(self.dedendum + 1.0) * self.module
        first, last = teeth[0][0, 0], teeth[-1][-1, 0]
        outline = np.concatenate([*teeth, [(last, low), (first, low)]])
        return np.asarray(outline[::-1])

    @attached
    def draw(self, *, language: str = "en") -> Drawing:
        """The rack with its datum line."""
        raise NotImplementedError

    @attached
    def save_dxf(self, path: str | Path, *, points: int = 12, force: bool = False) -> Path:
        """The outline and the datum line at true scale (mm) as DXF; needs ezdxf."""
        raise NotImplementedError

    def _half_tooth(self, points: int) -> Floats:
        """From the middle of the space on to the tip's corner, mirrored to x > 0: root, fillet, flank."""
        m, slope = self.module, self.pressure_angle
        room = (math.pi / 4 - self.dedendum * math.tan(slope)) / (1 / math.cos(slope) - math.tan(slope))
        radius = m * max(0.0, min(self.fillet, room, self.dedendum))
        foot = m * (math.pi / 4 + self.dedendum * math.tan(slope))
        centre = (foot + radius * (1 / math.cos(slope) - math.tan(slope)), radius - self.dedendum * m)
        angles = np.linspace(-math.pi / 2, slope - math.pi, points)
        fillet = np.stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)], axis=1)
        tip = (m * (math.pi / 4 - self.addendum * math.tan(slope)), self.addendum * m)
        return np.concatenate([[(0.5 * self.pitch, -self.dedendum * m)], fillet, [tip]])
