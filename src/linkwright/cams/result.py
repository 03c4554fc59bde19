"""A finished cam: its curves over the turn, its extremes with their places, its profile as points."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from linkwright.cams.curves import RollerCurve
from linkwright.cams.loading import contact_pressure, leverage, residual_amplitude, steady_deviation
from linkwright.core.arguments import PROFILE_POINTS
from linkwright.core.arrays import Floats
from linkwright.core.attached import attached
from linkwright.core.quantity import number
from linkwright.core.search import ends, first_largest
from linkwright.core.table import Block
from linkwright.curves.curve import Curve, Extreme
from linkwright.equations.steps import Step
from linkwright.errors import RequestError
from linkwright.laws.program import MotionProgram
from linkwright.parts.base import Result
from linkwright.words import Message, Translate, _, pgettext

if TYPE_CHECKING:
    from linkwright.cams.curves import CamCurve, Contact
    from linkwright.cams.loading import CamLoading
    from linkwright.cams.shape import CamShape
    from linkwright.pictures.drawing import Drawing

#: Places of the curves.
POINTS = 1440
#: Share of the largest contact force that is none.
ROUNDING = 1e-12
_FEWEST, _MOST = 36, 100_000
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "lift": _("lift"),
    "own_frequency": _("natural frequency"),
    "steady_deviation": _("largest deviation in steady motion"),
    "barrel_radius": _("radius of the barrel"),
    "roller_radius": _("radius of the roller"),
    "start_angle": _("angle of the arm at zero lift ψ₀"),
    "face_width": _("width of the flat face"),
    "smallest_radius": _("smallest radius of curvature"),
    "hollow_radius": _("smallest hollow radius"),
    "stiffness": _("stiffness of the spring"),
    "preload": _("preload of the spring"),
    "largest_contact_pressure": _("largest contact pressure"),
    "residual": _("residual amplitude"),
    "base_radius": _("radius of the base circle"),
    "prime_radius": _("radius of the prime circle (base circle of the pitch curve)"),
    "offset_row": _("offset"),
    "largest_velocity": _("largest velocity"),
    "smallest_velocity": _("smallest velocity"),
    "largest_acceleration": _("largest acceleration"),
    "smallest_acceleration": _("smallest acceleration"),
    "pressure_angle_rise": pgettext("cams", "pressure angle, rise"),
    "pressure_angle_fall": _("pressure angle, fall"),
    "largest_contact_force": _("largest contact force"),
    "smallest_contact_force": _("smallest contact force"),
    "largest_torque": _("largest torque"),
    "smallest_torque": _("smallest torque"),
}


NO_FOLLOWER = _("the vibration needs elasticity and mass of the follower; give both", code="cams.no_elasticity")


@dataclass(frozen=True, repr=False)
class CamDesign(Result):
    """A cam whose sizes are settled: ``cam`` has base circle, offset and roller, ``cam.loaded`` the spring.

    Curves are over ``angles`` (n,) of one turn, in rad, the end included; walls are those of ``cam.walls``.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    cam: CamShape

    @cached_property
    def angles(self) -> Floats:
        """Angles of the curves, rad: equal steps, and every edge of the program."""
        return np.append(self.cam.program.places(POINTS), self.cam.program.period)

    @cached_property
    def motion(self) -> Floats:
        """Lift, velocity, acceleration and jerk (4, n), m or rad over powers of rad."""
        inside = np.minimum(self.angles, np.nextafter(self.cam.program.period, 0.0))
        return np.array(self.cam.program.curves(inside))

    @cached_property
    def wall(self) -> CamCurve:
        """The wall that the follower is pressed on."""
        return self.cam.walls[0]

    @cached_property
    def contact(self) -> Contact:
        """The contact on the first wall."""
        return self.wall.contact(np.minimum(self.angles, np.nextafter(self.cam.program.period, 0.0)))

    @property
    def loading(self) -> CamLoading:
        """Speed, mass, load and spring, the chosen one among them."""
        return self.cam.loaded

    # extremes -----------------------------------------------------------------------------
    def _extreme(self, values: Any, kind: str) -> Extreme:
        program = self.cam.program
        inner = program.breaks[(program.breaks > 0) & (program.breaks < program.period)]
        return Curve.of(values, 0.0, program.period, pieces=24, knots=inner).extreme(kind)

    @cached_property
    def pressure_angle_rise(self) -> Extreme:
        """The pressure angle (rad) of largest size while the follower rises."""
        return self._steepest(1.0)

    @cached_property
    def pressure_angle_fall(self) -> Extreme:
        """The pressure angle (rad) of largest size while it falls."""
        return self._steepest(-1.0)

    def _steepest(self, way: float) -> Extreme:
        rate = self.motion[1]
        moving = way * rate > 1e-9 * np.abs(rate).max()
        if not moving.any():
            return Extreme(0.0, 0.0)
        size = np.where(moving, np.abs(self.contact.pressure_angle), -1.0)
        return self._largest(size, lambda phi: self.wall.contact(phi).pressure_angle)

    def _largest(self, known: Floats, values: Callable[[Floats], Floats]) -> Extreme:
        """The value of largest size around the largest of those that are known at the angles (n,)."""
        k = first_largest(known)
        inside = self._inside
        low, high = inside[max(k - 1, 0)], inside[min(k + 1, len(known) - 1)]
        for _unused in range(8):
            phi = np.linspace(low, high, 33)
            found = values(phi)
            j = first_largest(np.abs(found))
            low, high = phi[max(j - 1, 0)], phi[min(j + 1, 32)]
        return Extreme(float(phi[j]), float(found[j]))

    @cached_property
    def smallest_radius(self) -> Extreme | None:
        """The profile's smallest radius of curvature where it is convex (m), over all walls; None without any."""
        found = [self._extreme(lambda phi, w=wall: w.contact(phi).curvature, "max") for wall in self.cam.walls]
        sharpest = max(found, key=lambda each: each.value)
        return Extreme(sharpest.place, 1.0 / sharpest.value) if sharpest.value > 0 else None

    @cached_property
    def hollow_radius(self) -> Extreme | None:
        """The smallest radius where the first wall is hollow (m): no larger cutter fits; None where it is convex.

        A flat face touches convex profiles only.
        """
        if self.cam.follower.kind == "flat":
            return None
        found = self._extreme(lambda phi: self.wall.contact(phi).curvature, "min")
        return Extreme(found.place, -1.0 / found.value) if found.value < -1e-9 * abs(self.size) else None

    @property
    def minimum_growth(self) -> float:
        """The smallest growth of the walls along the way, below zero where a profile folds back."""
        return min(self._extreme(lambda phi, w=wall: w.contact(phi).growth, "min").value for wall in self.cam.walls)

    @property
    def size(self) -> float:
        """Largest distance of the profile from the centre, m."""
        return float(np.abs(self.contact.point).max())

    @property
    def face(self) -> tuple[float, float] | None:
        """The part of a flat face that touches, from and to (m) along it; None for other followers."""
        if self.cam.follower.kind != "flat":
            return None
        low = self._extreme(lambda phi: self.wall.contact(phi).along, "min")
        high = self._extreme(lambda phi: self.wall.contact(phi).along, "max")
        return low.value, high.value

    # forces -------------------------------------------------------------------------------
    @property
    def loaded(self) -> bool:
        """Whether anything presses follower and cam together."""
        loading = self.loading
        return bool(loading.mass and loading.speed) or bool(loading.load) or bool(loading.spring.preload)

    @cached_property
    def contact_force(self) -> Floats:
        """Normal force between cam and follower (n,) N; negative: on the other wall of a groove or pair."""
        return self._contact_force(self._inside)

    def _contact_force(self, phi: Floats) -> Floats:
        effort = self.loading.effort(self.cam.program, phi)
        force = effort / leverage(self.cam.follower, self.wall.contact(phi))
        if self._other is None:
            return np.asarray(force)
        back = effort / leverage(self._other.follower, self._other.contact(phi))
        return np.where(effort < 0, -np.abs(back), np.abs(force))

    @property
    def _other(self) -> RollerCurve | None:
        """The wall that pushes the follower back, of a groove or a pair."""
        walls = self.cam.walls
        return walls[1] if len(walls) > 1 and isinstance(walls[1], RollerCurve) else None

    @property
    def _inside(self) -> Floats:
        return np.minimum(self.angles, np.nextafter(self.cam.program.period, 0.0))

    @property
    def wall_changes(self) -> tuple[float, ...]:
        """Where the follower of a groove or a pair begins to press on its other wall, rad."""
        force = self.contact_force
        pressed = np.flatnonzero(np.abs(force) > 1e-6 * np.abs(force).max())
        flips = np.flatnonzero(np.diff(np.sign(force[pressed])))
        before, after = self._inside[pressed[flips]], self._inside[pressed[flips + 1]]
        way = np.sign(force[pressed[flips + 1]])
        program, loading = self.cam.program, self.loading
        return tuple(ends(lambda phi: way * loading.effort(program, phi) > 0, after, before).tolist())

    @cached_property
    def torque(self) -> Floats:
        """Torque (n,) N·m with which the cam must be driven, positive in its sense of turning: effort times s'."""
        return self._torque(self._inside)

    def _torque(self, phi: Floats) -> Floats:
        return np.asarray(self.loading.effort(self.cam.program, phi) * self.cam.program.curves(phi)[1])

    def extreme_force(self, kind: str) -> Extreme:
        """The largest (``max``) or smallest (``min``) contact force, N, found between the places of the curves."""
        found = self._extreme(self._contact_force, kind)
        nothing = abs(found.value) <= ROUNDING * float(np.abs(self.contact_force).max())
        return Extreme(found.place, 0.0) if nothing else found

    def extreme_torque(self, kind: str) -> Extreme:
        """The same of the torque, N·m."""
        return self._extreme(self._torque, kind)

    @cached_property
    def pressure(self) -> Floats | None:
        """Hertz's pressure (n,) Pa on the wall that is pressed; None without width or for a knife."""
        cam = self.cam
        if cam.width is None or cam.follower.kind == "knife" or not self.loaded:
            return None
        return self._pressure(self._inside)

    def _pressure(self, phi: Floats) -> Floats:
        cam, force = self.cam, self._contact_force(phi)
        assert cam.width is not None
        found = contact_pressure(force, self.wall.contact(phi), cam.follower, cam.width, cam.material)
        if self._other is None:
            return found
        back = self._other.contact(phi)
        return found + contact_pressure(-force, back, self._other.follower, cam.width, cam.material)

    @cached_property
    def largest_pressure(self) -> Extreme | None:
        """Its largest value, found between the places of the curves."""
        return None if self.pressure is None else self._largest(self.pressure, self._pressure)

    # points -------------------------------------------------------------------------------
    def profile(self, points: int = PROFILE_POINTS, wall: int = 0) -> Floats:
        """The profile as points (n, 2) m in the cam's axes, exact; of a barrel cam unrolled, from 0 to 2π."""
        contact = self.cam.walls[wall].contact(self.places(points))
        return np.stack([contact.point.real, contact.point.imag], axis=1)

    def pitch_curve(self, points: int = PROFILE_POINTS, wall: int = 0) -> Floats:
        """The path of the roller's centre or the edge (n, 2) m; raises RequestError for a flat face."""
        return self.cutter_path(self.cam.follower.roller_radius, points, wall)

    def cutter_path(self, radius: float | None = None, points: int = PROFILE_POINTS, wall: int = 0) -> Floats:
        """The centre of a round cutter of ``radius`` (m) along the profile, (n, 2) m.

        Raises RequestError for a cutter that does not fit into the hollow parts of the profile.
        """
        radius = self.cam.cutter_radius if radius is None else radius
        if radius is None or not radius >= 0:
            raise RequestError(_("the radius of the cutter is not known", code="cams.no_cutter"))
        contact = self.cam.walls[wall].contact(self.places(points))
        hollow = -float(contact.curvature.min())
        if hollow * radius > 1 + 1e-9:
            raise RequestError(
                _(
                    "a cutter of {radius} mm does not fit into the hollow of the profile; take at most {most} mm",
                    code="cams.cutter_large",
                    radius=number(radius, "length"),
                    most=f"{1e3 / hollow:.6g}",
                )
            )
        path = contact.point + radius * contact.normal
        return np.stack([path.real, path.imag], axis=1)

    def places(self, points: int) -> Floats:
        """Angles (rad) of so many points of the profile; raises RequestError for too few or too many."""
        if not _FEWEST <= points <= _MOST:
            raise RequestError(
                _(
                    "{points} points; give {minimum} to {maximum}",
                    code="cams.points",
                    points=points,
                    minimum=_FEWEST,
                    maximum=_MOST,
                )
            )
        end = self.cam.barrel_radius is not None
        return np.linspace(0.0, 2 * math.pi, points + end, endpoint=end)

    @attached
    def save_profile(self, path: str | Path, points: int = PROFILE_POINTS, *, force: bool = False) -> Path:
        """Writes the profile: ``.dxf`` (mm, layers), ``.csv`` (angle, points, normals), ``.txt`` (x y z in mm).

        Raises RequestError for another ending, LinkwrightError for a file that exists (without ``force``).
        """
        raise NotImplementedError

    @attached
    def draw(self, angle: float = 0.0, language: str = "en") -> Drawing:
        """Cam and follower at an angle (rad), as SVG."""
        raise NotImplementedError

    # what it says -------------------------------------------------------------------------
    def columns(self) -> dict[str, Floats]:
        lift = "rad" if self.cam.follower.oscillating else "m"
        s, v, a, j = self.motion
        contact = self.contact
        with np.errstate(divide="ignore"):
            radius = 1.0 / contact.curvature
        found = {
            "angle [rad]": self.angles,
            f"lift [{lift}]": s,
            f"velocity [{lift}/rad]": v,
            f"acceleration [{lift}/rad²]": a,
            f"jerk [{lift}/rad³]": j,
            "profile x [m]": contact.point.real,
            "profile y [m]": contact.point.imag,
            "normal x": contact.normal.real,
            "normal y": contact.normal.imag,
            "radius of curvature [m]": radius,
            "pressure angle [rad]": contact.pressure_angle,
        }
        if self.loaded:
            found |= {"contact force [N]": self.contact_force, "torque [N·m]": self.torque}
        if self.pressure is not None:
            found["contact pressure [Pa]"] = self.pressure
        return found

    @attached
    def blocks(self, translate: Translate) -> list[Block]:
        raise NotImplementedError

    @attached
    def steps(self, translate: Translate) -> list[Step]:
        raise NotImplementedError

    # vibration ----------------------------------------------------------------------------
    def residual_vibration(self, speeds: Floats) -> Floats:
        """Amplitude left after each rise and fall (n, k) at speeds of the cam (n,) rad/s, without damping, m or rad.

        Raises RequestError without ``elasticity`` and mass, and for a program that is not made of segments.
        """
        if self.cam.elasticity is None or not self.loading.mass:
            raise RequestError(NO_FOLLOWER)
        if not isinstance(self.cam.program, MotionProgram):
            raise RequestError(
                _("a program that was found has no single rises; take its steady deviation", code="cams.no_segments")
            )
        return residual_amplitude(self.cam.program, self.own_frequency, np.asarray(speeds, dtype=float))

    def steady_deviation(self, speeds: Floats) -> Floats:
        """Largest distance of the follower's mass from what the cam asks (n,) at speeds (n,), in steady turning."""
        if self.cam.elasticity is None or not self.loading.mass:
            raise RequestError(NO_FOLLOWER)
        damping = self.cam.elasticity.damping_ratio
        return steady_deviation(self.cam.program, self.own_frequency, damping, np.asarray(speeds, dtype=float))

    @property
    def own_frequency(self) -> float:
        """Natural frequency of the follower on its elasticity, rad/s."""
        assert self.cam.elasticity is not None
        return math.sqrt(self.cam.elasticity.stiffness / self.loading.mass)
