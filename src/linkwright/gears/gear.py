"""One involute gear: its diameters, tooth thickness, undercut and outline; the involute function.

inv α = tan α − α is the angle at the base circle between the start of an involute and its point of the pressure angle
α, at the radius r = r_b / cos α (DIN 3960; Litvin, Gear Geometry and Applied Theory, chapter 10).

The rack tool rolls with its rolling line on the pitch circle. Its straight flank makes the involute, its rounded tip
the fillet: where the normal of the tool's contour goes through the pitch point, the tool touches the gear (Litvin,
chapter 5). A ring has arcs as fillets that touch flank and root circle.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arguments import real
from linkwright.core.arrays import Flags, Floats
from linkwright.core.search import ends
from linkwright.errors import RequestError
from linkwright.words import _

#: Fewest and most teeth, and the range of the pressure angle, rad.
TEETH = (4, 2000)
PRESSURE_ANGLES = (math.radians(5.0), math.radians(40.0))
#: Ranges of what gears and racks have in common: m, rad, and in modules.
TOOTH = {
    "module": (1e-6, 10.0),
    "pressure_angle": PRESSURE_ANGLES,
    "addendum": (0.1, 3.0),
    "dedendum": (0.1, 3.0),
    "fillet": (0.0, 1.0),
}


_NO_INVOLUTE = _(
    "no involute is left below the tip circle of {tip:.6g} mm; give more teeth, a larger "
    "profile shift or a larger addendum",
    code="gears.no_flank",
)


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
        _unused = self.space

    def _check_tip(self) -> None:
        if self.internal:
            if not self.base_diameter <= self.tip_diameter < self.root_diameter:
                raise RequestError(
                    _(
                        "the ring's tip circle of {tip:.6g} mm lies inside its base circle of {base:.6g} mm "
                        "or beyond its root, so its teeth have no flanks there; give more teeth, a larger "
                        "profile shift or a smaller addendum",
                        code="gears.ring_tip",
                        tip=1e3 * self.tip_diameter,
                        base=1e3 * self.base_diameter,
                    )
                )
        elif not self.root_diameter < self.tip_diameter or self.tip_diameter <= self.base_diameter:
            raise RequestError(_NO_INVOLUTE.format(tip=1e3 * self.tip_diameter))
        if self._thickness(0.5 * self.tip_diameter) <= 0:
            raise RequestError(
                _(
                    "the teeth come to a point before the tip circle of {tip:.6g} mm; give a smaller "
                    "profile shift or addendum",
                    code="gears.pointed",
                    tip=1e3 * self.tip_diameter,
                )
            )
        if self.root_diameter <= 0:
            raise RequestError(_NO_INVOLUTE.format(tip=1e3 * self.tip_diameter))

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
        """d_a = d + 2 m (h_a + x), of a ring d - 2 m (h_a - x), m; or the one that was set."""
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
        return self.module * (math.pi / 2 + 2 * self.outward * self.profile_shift * math.tan(self.pressure_angle))

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
                _(
                    "at a radius of {radius:.6g} mm the flank is not an involute; give {low:.6g} to {high:.6g} mm",
                    code="gears.no_flank_there",
                    radius=1e3 * radius,
                    low=1e3 * ends[0],
                    high=1e3 * ends[1],
                )
            )
        return self._thickness(radius)

    def _thickness(self, radius: float) -> float:
        half = float(self.half_angle(np.array([radius]))[0])
        return 2 * radius * (math.pi / self.teeth - half if self.internal else half)

    @property
    def minimum_profile_shift(self) -> float:
        """The profile shift below which a rack tool undercuts: h_a0* - (z/2) sin² α.

        h_a0* is the depth of the tool's straight flank: 1 for the usual tip rounding of 0.38, which gives the known
        17 teeth.
        """
        rounded = tool_tip(self).radius / self.module
        straight = self.dedendum - rounded * (1 - math.sin(self.pressure_angle))
        return straight - 0.5 * self.teeth * math.sin(self.pressure_angle) ** 2

    @property
    def undercut(self) -> bool:
        """Whether the tool cuts away part of the involute near the base circle; never for a ring."""
        return not self.internal and self.profile_shift < self.minimum_profile_shift - 1e-12

    @cached_property
    def space(self) -> ToothSpace:
        """The space between two teeth, its flanks and fillets."""
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
            raise RequestError(
                _(
                    "{name} is {value}; give {low} to {high}",
                    code="gears.out_of_range",
                    name="points",
                    value=points,
                    low=2,
                    high=5000,
                )
            )
        return self.space.around(self, points)

    def turned(self, angle: float, points: int = 40) -> Floats:
        """The outline turned counter-clockwise about its centre by an angle (rad)."""
        c, s = math.cos(angle), math.sin(angle)
        return np.asarray(self.outline(points) @ np.array([[c, s], [-s, c]]))


def require_ranges(teeth: Any, ranges: Mapping[str, tuple[float, float]]) -> None:
    """Raises RequestError for a number of a gear or rack out of its range, and for teeth that are not an integer."""
    for name, (low, high) in ranges.items():
        value = real(name, getattr(teeth, name), finite=False)
        unit = {"pressure_angle": " rad", "module": " m"}.get(name, "")
        if not low <= value <= high:
            limits = {"value": f"{value:.6g}{unit}", "low": f"{low:.4g}", "high": f"{high:.4g}{unit}"}
            raise RequestError(
                _("{name} is {value}; give {low} to {high}", code="gears.out_of_range").format(name=name, **limits)
            )
    if int(teeth.teeth) != teeth.teeth:
        raise RequestError(
            _("a gear cannot have {teeth} teeth; give an integer", code="gears.whole_teeth", teeth=teeth.teeth)
        )


@dataclass(frozen=True)
class ToolTip:
    """The rack tool's tip above its pitch line: half width ``middle`` and height ``centre`` of the rounding (m).

    Heights count from the rolling line, outward from the gear's centre positive; ``radius`` of the rounding.
    """

    middle: float
    centre: float
    radius: float
    pitch_radius: float
    slope: float

    def foot(self, roll: Floats) -> tuple[Floats, Floats]:
        """Radius (m) and angle from the space's middle (rad) of the fillet where the gear has rolled so far (rad).

        The fillet starts at the root at -middle / r and ends where the tool's normal has the flank's direction.
        """
        r = self.pitch_radius
        across = self.middle + r * roll
        length = np.hypot(across, self.centre)
        reach = self.radius / np.where(length > 0, length, 1.0)
        x, y = across * (1 + reach), r + self.centre * (1 + reach)
        y = np.where(length > 0, y, r + self.centre - self.radius)
        angle = np.arctan2(x, y) - roll
        return np.hypot(x, y), np.asarray(angle)

    @property
    def rolls(self) -> tuple[float, float]:
        """From the root to the end of the straight flank, rad."""
        first = -self.middle / self.pitch_radius
        return first, first - self.centre / (math.tan(self.slope) * self.pitch_radius)


@dataclass(frozen=True)
class ToothSpace:
    """One side of a space from its middle: fillet as polar places, and the radius where the involute begins.

    ``fillet(points)`` gives radii and angles from the middle of the space, from the root to the involute.
    """

    form_radius: float
    tip: ToolTip | None = None
    last_roll: float = 0.0
    arc: tuple[float, float, float, float, float] | None = None

    def fillet(self, points: int) -> tuple[Floats, Floats]:
        """Radii (m) and angles from the space's middle (rad), from the root to the involute."""
        share = np.linspace(0.0, 1.0, points)
        if self.tip is not None:
            first, last = self.tip.rolls[0], self.last_roll
            return self.tip.foot(first + share * (last - first))
        assert self.arc is not None
        radius, angle, size, start, end = self.arc
        angles = start + share * (end - start)
        x = radius * math.cos(angle) + size * np.cos(angles)
        y = radius * math.sin(angle) + size * np.sin(angles)
        return np.hypot(x, y), np.arctan2(y, x)

    def around(self, gear: Gear, points: int) -> Floats:
        """The closed outline, counter-clockwise, a tooth (of a ring: a space) on the x axis."""
        flank = np.linspace(math.sqrt(self.form_radius), math.sqrt(0.5 * gear.tip_diameter), points) ** 2
        pitch = math.pi / gear.teeth
        half = gear.half_angle(flank)
        foot_radii, foot = self.fillet(points)
        radii = np.concatenate([foot_radii[:-1], flank])
        angles = np.concatenate([foot[:-1], half if gear.internal else pitch - half])
        one_side = np.concatenate([_arc(0.0, angles[0], points)[:-1], angles])
        radii = np.concatenate([np.full(len(one_side) - len(radii), radii[0]), radii])
        top = _arc(angles[-1], pitch, points)[1:]
        one_side, radii = np.append(one_side, top), np.append(radii, np.full(len(top), radii[-1]))
        tooth = np.concatenate([-one_side[:0:-1], one_side[:-1]])
        sizes = np.concatenate([radii[:0:-1], radii[:-1]])
        start = 0.0 if gear.internal else pitch
        every = (start + 2 * pitch * np.arange(gear.teeth)[:, None] + tooth[None, :]).ravel()
        r = np.tile(sizes, gear.teeth)
        return np.stack([r * np.cos(every), r * np.sin(every)], axis=1)


def tool_space(gear: Gear) -> ToothSpace:
    """The space that a rack tool cuts; its fillet ends at the involute, with undercut where both cross."""
    tip = tool_tip(gear)
    last = tip.rolls[1]
    if gear.undercut:
        last = _crossing(gear, tip)
    form = float(tip.foot(np.array([last]))[0][0])
    if form >= 0.5 * gear.tip_diameter:
        raise RequestError(_NO_INVOLUTE.format(tip=1e3 * gear.tip_diameter))
    return ToothSpace(max(form, 0.5 * gear.base_diameter), tip, last)


def tool_tip(gear: Gear) -> ToolTip:
    """The rounding of the tool, smaller where its tip has no room for it or lies too near the rolling line."""
    m, slope = gear.module, gear.pressure_angle
    deep = m * (gear.dedendum - gear.profile_shift)
    if deep <= 0.02 * m:
        raise RequestError(
            _(
                "a rack tool does not reach below the rolling line with a profile shift of {shift}; "
                "give at most {most}",
                code="gears.shift_too_large",
                shift=gear.profile_shift,
                most=gear.dedendum - 0.02,
            )
        )
    half = m * (math.pi / 4 - gear.dedendum * math.tan(slope))
    room = half / (1 / math.cos(slope) - math.tan(slope))
    radius = max(0.0, min(gear.fillet * m, room, deep - 0.02 * m))
    middle = half - radius * (1 / math.cos(slope) - math.tan(slope))
    return ToolTip(middle, radius - deep, radius, 0.5 * gear.pitch_diameter, slope)


def _crossing(gear: Gear, tip: ToolTip) -> float:
    """The roll at which the fillet crosses the involute, by halving to the last bit."""
    first, end = tip.rolls
    pitch = math.pi / gear.teeth

    def gap(roll: Floats) -> Floats:
        """How far the fillet lies inside the tooth's involute, rad; below the base circle as at it."""
        radius, angle = tip.foot(roll)
        return np.asarray(pitch - gear.half_angle(np.maximum(radius, 0.5 * gear.base_diameter)) - angle)

    def below(rolls: Floats) -> Flags:
        return np.asarray((tip.foot(rolls)[0] <= 0.5 * gear.base_diameter) | (gap(rolls) < 0))

    rolls = np.linspace(first, end, 2001)
    place = int(np.argmin(below(rolls)))
    if place == 0:
        return end
    return float(ends(below, rolls[place - 1 : place], rolls[place : place + 1])[0])


def ring_space(gear: Gear) -> ToothSpace:
    """The space of a ring: its fillets are arcs that touch the flank and the root circle.

    The parallel of an involute at a distance ρ is an involute of the same base circle, turned by ρ / r_b.
    """
    root, base = 0.5 * gear.root_diameter, 0.5 * gear.base_diameter
    half_root = float(gear.half_angle(np.array([root]))[0])
    if half_root <= 0:
        raise RequestError(
            _(
                "the ring's spaces come to a point before the root circle of {root:.6g} mm; give a "
                "smaller profile shift or dedendum",
                code="gears.pointed_space",
                root=1e3 * gear.root_diameter,
            )
        )
    size = min(gear.fillet * gear.module, 0.9 * half_root * base)
    centre = root - size
    while centre > base and float(gear.half_angle(np.array([centre]))[0]) - size / base < 0 and size > 1e-9 * root:
        size *= 0.9
        centre = root - size
    angle = float(gear.half_angle(np.array([centre]))[0]) - size / base
    length = math.sqrt(centre**2 - base**2)
    touch = math.hypot(base, length + size)
    flank = float(gear.half_angle(np.array([touch]))[0])
    x = touch * math.cos(flank) - centre * math.cos(angle)
    y = touch * math.sin(flank) - centre * math.sin(angle)
    return ToothSpace(touch, arc=(centre, angle, size, angle, math.atan2(y, x)))


def _arc(first: float, last: float, points: int) -> Floats:
    """Angles of an arc of a circle, few where it is short."""
    return np.linspace(first, last, max(2, points // 4 + 2)) if last - first > 1e-12 else np.array([first])


def involute(angle: float) -> float:
    """inv α = tan α − α, rad; near zero by its series, where the difference would lose digits."""
    if abs(angle) < 0.02:
        square = angle * angle
        return angle * square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0)))
    return math.tan(angle) - angle


def angle_of_involute(value: float) -> float:
    """The pressure angle α in [0, π/2) with inv α = value ≥ 0, by Newton's steps from above; exact to rounding."""
    if value < 0:
        raise ValueError(f"an involute function is not negative, and {value} is")
    if value == 0:
        return 0.0
    angle: float = min((3.0 * value) ** (1.0 / 3.0), math.atan(value + 0.5 * math.pi))
    for _step in range(60):
        step = (involute(angle) - value) / math.tan(angle) ** 2
        angle -= step
        if abs(step) <= 1e-16 * angle:
            break
    return angle


def involute_at(radii: Floats, base_radius: float) -> Floats:
    """inv α at radii (n,) not below the base radius, rad."""
    tangent = np.sqrt(np.maximum((radii / base_radius) ** 2 - 1.0, 0.0))
    return np.asarray(tangent - np.arctan(tangent))
