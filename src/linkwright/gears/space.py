"""The space between two teeth: involute flanks and the fillets at their feet.

The rack tool rolls with its rolling line on the pitch circle. Its straight flank makes the involute, its rounded tip
the fillet: where the normal of the tool's contour goes through the pitch point, the tool touches the gear (Litvin,
Gear Geometry and Applied Theory, chapter 5). A ring has arcs as fillets that touch flank and root circle.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.search import ends
from linkwright.errors import RequestError

if TYPE_CHECKING:
    from linkwright.gears.gear import Gear


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
        way = start + share * (end - start)
        x = radius * math.cos(angle) + size * np.cos(way)
        y = radius * math.sin(angle) + size * np.sin(way)
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
        whole = np.concatenate([-one_side[:0:-1], one_side[:-1]])
        sizes = np.concatenate([radii[:0:-1], radii[:-1]])
        start = 0.0 if gear.internal else pitch
        every = (start + 2 * pitch * np.arange(gear.teeth)[:, None] + whole[None, :]).ravel()
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
        raise RequestError("gears.no_flank", tip=1e3 * gear.tip_diameter)
    return ToothSpace(max(form, 0.5 * gear.base_diameter), tip, last)


def tool_tip(gear: Gear) -> ToolTip:
    """The rounding of the tool, smaller where its tip has no room for it or lies too near the rolling line."""
    m, slope = gear.module, gear.pressure_angle
    deep = m * (gear.dedendum - gear.profile_shift)
    if deep <= 0.02 * m:
        raise RequestError("gears.shift_too_large", shift=gear.profile_shift, most=gear.dedendum - 0.02)
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

    The curve beside an involute at a distance ρ is an involute of the same base circle, turned by ρ / r_b.
    """
    root, base = 0.5 * gear.root_diameter, 0.5 * gear.base_diameter
    half_root = float(gear.half_angle(np.array([root]))[0])
    if half_root <= 0:
        raise RequestError("gears.pointed_space", root=1e3 * gear.root_diameter)
    size = min(gear.fillet * gear.module, 0.9 * half_root * base)
    centre = root - size
    while (
        centre > base
        and float(gear.half_angle(np.array([centre]))[0]) - size / base < 0
        and size > 1e-9 * root
    ):
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
