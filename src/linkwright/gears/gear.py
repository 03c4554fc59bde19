"""One involute gear: its diameters, tooth thickness, undercut and outline."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.given import real
from linkwright.errors import RequestError
from linkwright.gears.involute import involute, involute_at

if TYPE_CHECKING:
    from linkwright.gears.space import ToothSpace

#: Fewest and most teeth, and the range of the pressure angle, rad.
TEETH = (4, 2000)
PRESSURE_ANGLES = (math.radians(5.0), math.radians(40.0))
#: Ranges of what gears and racks have in common: m, rad, and in modules.
TOOTH = {
    "module": (1e-6, 10.0), "pressure_angle": PRESSURE_ANGLES, "addendum": (0.1, 3.0), "dedendum": (0.1, 3.0),
    "fillet": (0.0, 1.0),
}  # fmt: skip


@dataclass(frozen=True)
class Gear:
    """A spur gear with involute teeth, cut by a rack tool; ``internal``: a ring with teeth inside.

    ``teeth`` z; ``module`` m (m); ``profile_shift`` x, in modules, outward from the gear's centre positive for both
    kinds; ``pressure_angle`` α (rad); ``addendum`` and ``dedendum`` of the gear in modules (1 and 1.25: ISO 53 A);
    ``fillet`` radius of the tool's tip in modules (0.38), of a ring the radius of its fillet; ``tip`` a tip diameter
    (m) of one's own, such as the shortened one of a pair.

    d = m z, d_b = d cos α, tooth thickness on the pitch circle s = m (π/2 + 2 x tan α), for a ring the width of its
    spaces (DIN 3960). An outline has x to the right, a tooth (a ring: a space) on the x axis.

    Raises RequestError for numbers out of range, and where the teeth would be pointed or have no flank.
    """

    teeth: int
    module: float
    profile_shift: float = 0.0
    pressure_angle: float = math.radians(20.0)
    internal: bool = False
    addendum: float = 1.0
    dedendum: float = 1.25
    fillet: float = 0.38
    tip: float | None = None

    def __post_init__(self) -> None:
        require_ranges(self, {"teeth": TEETH, "profile_shift": (-5.0, 5.0), **TOOTH})
        self._check_tip()
        _ = self.space

    def _check_tip(self) -> None:
        if self.internal:
            if not self.base_diameter <= self.tip_diameter < self.root_diameter:
                raise RequestError(
                    "gears.ring_tip", tip=1e3 * self.tip_diameter, base=1e3 * self.base_diameter
                )
        elif not self.root_diameter < self.tip_diameter or self.tip_diameter <= self.base_diameter:
            raise RequestError("gears.no_flank", tip=1e3 * self.tip_diameter)
        if self._thickness(0.5 * self.tip_diameter) <= 0:
            raise RequestError("gears.pointed", tip=1e3 * self.tip_diameter)
        if self.root_diameter <= 0:
            raise RequestError("gears.no_flank", tip=1e3 * self.tip_diameter)

    @property
    def outward(self) -> int:
        """+1 where the teeth point outward, -1 for a ring."""
        return -1 if self.internal else 1

    @property
    def pitch_diameter(self) -> float:
        """d = m z, m."""
        return self.module * self.teeth

    @property
    def base_diameter(self) -> float:
        """d_b = d cos α, m."""
        return self.pitch_diameter * math.cos(self.pressure_angle)

    @property
    def tip_diameter(self) -> float:
        """d_a = d + 2 m (h_a + x), of a ring d - 2 m (h_a - x), m; or the one that was given."""
        if self.tip is not None:
            return self.tip
        return self.pitch_diameter + 2 * self.module * (self.outward * self.addendum + self.profile_shift)

    @property
    def root_diameter(self) -> float:
        """d_f = d - 2 m (h_f - x), of a ring d + 2 m (h_f + x), m."""
        return self.pitch_diameter + 2 * self.module * (self.profile_shift - self.outward * self.dedendum)

    @property
    def thickness(self) -> float:
        """Tooth thickness on the pitch circle, along the arc, m."""
        return self.module * (
            math.pi / 2 + 2 * self.outward * self.profile_shift * math.tan(self.pressure_angle)
        )

    def half_angle(self, radii: Floats) -> Floats:
        """Half the angle (rad) that a tooth takes between its involutes at radii (n,) m; of a ring its space."""
        at_pitch = (math.pi / 2 + 2 * self.profile_shift * math.tan(self.pressure_angle)) / self.teeth
        start = at_pitch + involute(self.pressure_angle)
        return np.asarray(start - involute_at(np.asarray(radii, dtype=float), 0.5 * self.base_diameter))

    def thickness_at(self, radius: float) -> float:
        """Tooth thickness along the arc at a radius (m), m; raises RequestError where the flank is no involute."""
        ends = sorted((self.form_diameter / 2, self.tip_diameter / 2))
        if not ends[0] * (1 - 1e-9) <= radius <= ends[1] * (1 + 1e-9):
            raise RequestError(
                "gears.no_flank_there", radius=1e3 * radius, low=1e3 * ends[0], high=1e3 * ends[1]
            )
        return self._thickness(radius)

    def _thickness(self, radius: float) -> float:
        half = float(self.half_angle(np.array([radius]))[0])
        return 2 * radius * (math.pi / self.teeth - half if self.internal else half)

    @property
    def least_profile_shift(self) -> float:
        """The profile shift below which a rack tool undercuts: h_a0* - (z/2) sin² α.

        h_a0* is the depth of the tool's straight flank: 1 for the usual tip rounding of 0.38, which gives the known
        17 teeth.
        """
        from linkwright.gears.space import tool_tip

        rounded = tool_tip(self).radius / self.module
        straight = self.dedendum - rounded * (1 - math.sin(self.pressure_angle))
        return straight - 0.5 * self.teeth * math.sin(self.pressure_angle) ** 2

    @property
    def undercut(self) -> bool:
        """Whether the tool cuts away part of the involute near the base circle; never for a ring."""
        return not self.internal and self.profile_shift < self.least_profile_shift - 1e-12

    @cached_property
    def space(self) -> ToothSpace:
        """The space between two teeth, its flanks and fillets."""
        from linkwright.gears.space import ring_space, tool_space

        return ring_space(self) if self.internal else tool_space(self)

    @property
    def form_diameter(self) -> float:
        """Where the involute ends at the fillet, m; with undercut, where the fillet cuts it."""
        return 2 * self.space.form_radius

    def outline(self, points: int = 40) -> Floats:
        """The closed outline (n, 2) m, counter-clockwise, so many points on every flank and fillet.

        All points lie on the exact curves; a tooth is on the x axis, of a ring a space.
        """
        if not 2 <= points <= 5000:
            raise RequestError("gears.out_of_range", name="points", value=points, low=2, high=5000)
        return self.space.around(self, points)

    def turned(self, angle: float, points: int = 40) -> Floats:
        """The outline turned counter-clockwise about its centre by an angle (rad)."""
        c, s = math.cos(angle), math.sin(angle)
        return np.asarray(self.outline(points) @ np.array([[c, s], [-s, c]]))


def require_ranges(teeth: Any, ranges: Mapping[str, tuple[float, float]]) -> None:
    """Raises RequestError for a number of a gear or rack out of its range, and for teeth that are not whole."""
    for name, (low, high) in ranges.items():
        value = real(name, getattr(teeth, name), finite=False)
        unit = {"pressure_angle": " rad", "module": " m"}.get(name, "")
        if not low <= value <= high:
            said = {"value": f"{value:.6g}{unit}", "low": f"{low:.4g}", "high": f"{high:.4g}{unit}"}
            raise RequestError("gears.out_of_range", name=name, **said)
    if int(teeth.teeth) != teeth.teeth:
        raise RequestError("gears.whole_teeth", teeth=teeth.teeth)
