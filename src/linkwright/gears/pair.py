"""Two gears in mesh: working pressure angle, centre distance, contact, and what is wrong with them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arguments import require_pair
from linkwright.core.arrays import Floats
from linkwright.core.attached import attached
from linkwright.errors import RequestError
from linkwright.gears.gear import Gear, angle_of_involute, involute
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.pictures.drawing import Drawing


def gear_pair(
    teeth: tuple[int, int],
    module: float,
    *,
    profile_shift: tuple[float, float] = (0.0, 0.0),
    pressure_angle: float = math.radians(20.0),
    internal: bool = False,
    addendum: float = 1.0,
    dedendum: float = 1.25,
    fillet: float = 0.38,
) -> GearPair:
    """A pinion and a wheel (``internal``: a ring) in mesh without backlash.

    Tips of external pairs are shortened by m (x1 + x2 - y), y m being the change of the centre distance, so that the
    tip clearance stays (dedendum - addendum) m (DIN 3960).

    Raises RequestError for numbers out of range and for teeth that cannot mesh.
    """
    require_pair("teeth", teeth)
    require_pair("profile_shift", profile_shift)
    pinion, wheel = (
        Gear(z, module, x, pressure_angle, ring, addendum, dedendum, fillet)
        for z, x, ring in zip(teeth, profile_shift, (False, internal), strict=True)
    )
    pair = GearPair(pinion, wheel)
    if internal:
        return pair
    centre_distance = pair.centre_distance - 0.5 * module * sum(teeth)
    shortened = 2 * (module * sum(profile_shift) - centre_distance)
    pinion, wheel = (replace(each, tip=each.tip_diameter - shortened) for each in (pinion, wheel))
    return GearPair(pinion, wheel)


@dataclass(frozen=True)
class GearPair:
    """A pinion, its centre at the origin, and a wheel, its centre on the x axis at the centre distance.

    Without ``distance`` (m) the flanks touch on both sides: inv α_w = inv α + 2 tan α (x2 ± x1) / (z2 ± z1),
    a = m (z2 ± z1) cos α / (2 cos α_w), minus for a ring. A larger ``distance`` (of a ring: a smaller one) gives
    backlash (DIN 3960).

    Raises RequestError where modules or pressure angles differ, the pinion is a ring, or there is no room.
    """

    pinion: Gear
    wheel: Gear
    distance: float | None = None

    def __post_init__(self) -> None:
        for name in ("module", "pressure_angle"):
            if getattr(self.pinion, name) != getattr(self.wheel, name):
                raise RequestError(
                    _(
                        "the {name} of the two gears differs, so they do not mesh; give both the same",
                        code="gears.differ",
                        name=name,
                    )
                )
        if self.pinion.internal:
            raise RequestError(_("the pinion is a ring; give the ring as the wheel", code="gears.ring_first"))
        if self.wheel.internal and self.wheel.teeth <= self.pinion.teeth:
            raise RequestError(
                _(
                    "a ring of {ring} teeth has no room for a pinion of {pinion}; give it more teeth",
                    code="gears.ring_small",
                    ring=self.wheel.teeth,
                    pinion=self.pinion.teeth,
                )
            )
        if self._touching_involute <= 0:
            raise RequestError(
                _(
                    "with these profile shifts the flanks meet at no centre distance; give larger ones",
                    code="gears.no_mesh",
                )
            )
        minimum = 0.5 * self._bases
        if self.distance is not None and (self.distance <= minimum or self.backlash < -1e-9 * self.pinion.module):
            raise RequestError(
                _(
                    "a centre distance of {distance:.9g} mm is out of range: the flanks touch on both "
                    "sides at {touching:.9g} mm",
                    code="gears.distance",
                    distance=1e3 * self.distance,
                    touching=1e3 * self._touching_distance,
                )
            )

    @property
    def _bases(self) -> float:
        return self.wheel.base_diameter + self.wheel.outward * self.pinion.base_diameter

    @property
    def _touching_involute(self) -> float:
        outward, alpha = self.wheel.outward, self.pinion.pressure_angle
        shifts = self.wheel.profile_shift + outward * self.pinion.profile_shift
        teeth = self.wheel.teeth + outward * self.pinion.teeth
        return involute(alpha) + 2 * math.tan(alpha) * shifts / teeth

    @property
    def _touching_distance(self) -> float:
        return 0.5 * self._bases / math.cos(angle_of_involute(self._touching_involute))

    @property
    def centre_distance(self) -> float:
        """Distance of the centres a, m."""
        return self._touching_distance if self.distance is None else self.distance

    @cached_property
    def working_pressure_angle(self) -> float:
        """α_w, rad, between the line of action and the common tangent of the rolling circles."""
        if self.distance is None:
            return angle_of_involute(self._touching_involute)
        return math.acos(0.5 * self._bases / self.distance)

    @property
    def backlash(self) -> float:
        """Play along the line of action (m): a turn of one gear by it over its base radius closes it."""
        gained = involute(math.acos(min(0.5 * self._bases / self.centre_distance, 1.0))) - self._touching_involute
        return 0.0 if self.distance is None else self.wheel.outward * self._bases * gained

    @property
    def ratio(self) -> float:
        """Angular velocity of the pinion over that of the wheel; negative where they turn in opposite senses."""
        return -self.wheel.outward * self.wheel.teeth / self.pinion.teeth

    @property
    def path_of_contact(self) -> tuple[float, float]:
        """Start and end of contact along the line of action, m from where it touches the pinion's base circle.

        It starts at the wheel's tip and ends at the pinion's, or where the involute of the other gear ends.
        """
        start, end = self._between_tips
        start = max(start, _reach(self.pinion, self.pinion.form_diameter))
        last = self._on_wheel(_reach(self.wheel, self.wheel.form_diameter))
        return start, min(end, last)

    @property
    def _between_tips(self) -> tuple[float, float]:
        return self._on_wheel(_reach(self.wheel)), _reach(self.pinion)

    def _on_wheel(self, length: float) -> float:
        """Place on the line of action of a point so far (m) from where the line touches the wheel's base circle."""
        across = self.centre_distance * math.sin(self.working_pressure_angle)
        return self.wheel.outward * (across - length)

    @property
    def contact_ratio(self) -> float:
        """ε_α: path of contact over the base pitch π m cos α; 0 where no flank reaches the other."""
        start, end = self.path_of_contact
        return max(end - start, 0.0) / (math.pi * self.pinion.module * math.cos(self.pinion.pressure_angle))

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Room between the pinion's tip and the wheel's root, and between wheel's tip and pinion's root, m."""
        outward = self.wheel.outward

        def room(pinion: float, wheel: float) -> float:
            return outward * (self.centre_distance - 0.5 * wheel) - 0.5 * pinion

        return (
            room(self.pinion.tip_diameter, self.wheel.root_diameter),
            room(self.pinion.root_diameter, self.wheel.tip_diameter),
        )

    @property
    def tip_overlap(self) -> float:
        """Of a ring: the angle by which its tips overlap those of the pinion where the tip circles cross.

        θ2 - inv α_w + inv α_a2 - (z1 / z2) (θ1 + inv α_a1 - inv α_w), θ1 and θ2 being the angles of the crossing at
        the centres, from the line of centres (Colbourne, The Geometry of Involute Gears, chapter 8); rad, negative
        where the tips pass, and where the circles do not cross -inf.
        """
        a = self.centre_distance
        first, second = 0.5 * self.pinion.tip_diameter, 0.5 * self.wheel.tip_diameter
        cosines = ((second**2 - first**2 - a**2) / (2 * first * a), (second**2 - first**2 + a**2) / (2 * second * a))
        if not self.wheel.internal or max(map(abs, cosines)) > 1:
            return -math.inf
        tips = [involute(math.acos(gear.base_diameter / gear.tip_diameter)) for gear in (self.pinion, self.wheel)]
        working = involute(self.working_pressure_angle)
        pinion = math.acos(cosines[0]) + tips[0] - working
        return math.acos(cosines[1]) - working + tips[1] - pinion * self.pinion.teeth / self.wheel.teeth

    @cached_property
    def findings(self) -> tuple[str, ...]:
        """Sentences on undercut, gaps in the contact, and tips that touch roots or fillets."""
        found: list[str] = []
        for gear in (self.pinion, self.wheel):
            if gear.undercut:
                found.append(
                    _(
                        "the gear of {teeth} teeth is undercut; a profile shift of {minimum:.4g} or more avoids it",
                        code="gears.undercut",
                        teeth=gear.teeth,
                        minimum=gear.minimum_profile_shift,
                    )
                )
        if self.contact_ratio == 0:
            found.append(
                _(
                    "no flank reaches the other: the gears do not touch; bring them nearer or give longer teeth",
                    code="gears.no_contact",
                )
            )
        elif self.contact_ratio < 1:
            found.append(
                _(
                    "the contact ratio is {ratio:.4g}, below 1: there are positions without contact",
                    code="gears.gap",
                    ratio=self.contact_ratio,
                )
            )
        if min(self.tip_clearances) < 0:
            found.append(
                _(
                    "a tip reaches {clearance:.4g} mm into a root: shorten the tips or deepen the roots",
                    code="gears.no_clearance",
                    clearance=1e3 * min(self.tip_clearances),
                )
            )
        start, end = self._between_tips
        below = {
            self.pinion: start < _reach(self.pinion, self.pinion.form_diameter) - 1e-12,
            self.wheel: end > self._on_wheel(_reach(self.wheel, self.wheel.form_diameter)) + 1e-12,
        }
        for gear, touched in below.items():
            if touched and not gear.undercut:
                found.append(
                    _(
                        "the mating tip reaches below the involute of the gear of {teeth} teeth, into its fillet",
                        code="gears.fillet_touched",
                        teeth=gear.teeth,
                    )
                )
        if self.wheel.internal and self.tip_overlap > 0:
            found.append(
                _(
                    "tips of pinion and ring overlap by {overlap:.4g}° next to the mesh; take a larger "
                    "difference of the teeth",
                    code="gears.tips_overlap",
                    overlap=math.degrees(self.tip_overlap),
                )
            )
        return tuple(found)

    def wheel_angle(self, pinion_angle: float) -> float:
        """Angle of the wheel's outline (rad) that goes with one of the pinion's, backlash on both sides the same."""
        towards = 0.0 if self.wheel.internal else math.pi + math.pi / self.wheel.teeth
        return towards + pinion_angle / self.ratio

    def outlines(self, pinion_angle: float = 0.0, points: int = 40) -> tuple[Floats, Floats]:
        """Outlines (n, 2) m of pinion and wheel in mesh, the pinion turned by an angle (rad)."""
        wheel = self.wheel.turned(self.wheel_angle(pinion_angle), points)
        return self.pinion.turned(pinion_angle, points), wheel + np.array([self.centre_sign, 0.0])

    @property
    def centre_sign(self) -> float:
        """x of the wheel's centre, m: beyond the pinion, a ring's on the other side of it."""
        return self.wheel.outward * self.centre_distance

    @attached
    def draw(self, pinion_angle: float = 0.0, *, language: str = "en") -> Drawing:
        """The gears in mesh with their circles and the line of action."""
        raise NotImplementedError

    @attached
    def save_dxf(self, path: str | Path, pinion_angle: float = 0.0, *, points: int = 60, force: bool = False) -> Path:
        """The outlines, circles and the line of action at true scale (mm) as DXF; needs ezdxf."""
        raise NotImplementedError


def _reach(gear: Gear, diameter: float | None = None) -> float:
    """Length of the tangent from the base circle to the tip circle, or to another one, m."""
    d = gear.tip_diameter if diameter is None else diameter
    return 0.5 * math.sqrt(max(d**2 - gear.base_diameter**2, 0.0))
