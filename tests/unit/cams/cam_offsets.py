"""Undercut of random cams against dense polygons: shapely's offset of the pitch curve, hulls of a flat face's lines.

Nothing of the package makes the polygons: lifts, trace points and lines are written down here once more. A command:

    python -m tests.unit.cams.cam_offsets 1000
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from linkwright.cams.curves import CamCurve, FlatCurve, RollerCurve, Undercut, undercuts
from linkwright.cams.follower import Follower
from linkwright.laws.program import MotionProgram, Segment

#: Points of the dense polygons; distance (m) from which a contact counts as lost (they are off by up to 2.3e-6).
DENSE, LOST = 6_000, 3e-6


@dataclass(frozen=True)
class RandomCam:
    """A rise, a dwell, a fall, a dwell, with its follower; lengths in m."""

    kind: str
    oscillating: bool
    angles: tuple[float, float, float, float]
    law: str
    lift: float
    base: float
    roller: float
    offset: float
    pivot: float
    arm: float
    face: float
    turn: float

    def lifts(self, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Lift and its rate, from the laws' textbook formulas."""
        formulas = {
            "cycloidal": (lambda u: u - np.sin(2 * np.pi * u) / (2 * np.pi), lambda u: 1 - np.cos(2 * np.pi * u)),
            "polynomial_345": (
                lambda u: 10 * u**3 - 15 * u**4 + 6 * u**5,
                lambda u: 30 * u**2 - 60 * u**3 + 30 * u**4,
            ),
            "simple_harmonic": (lambda u: 0.5 - 0.5 * np.cos(np.pi * u), lambda u: 0.5 * np.pi * np.sin(np.pi * u)),
        }
        rise, dwell, fall, _ = self.angles
        up = np.clip(phi / rise, 0, 1)
        down = np.clip((phi - rise - dwell) / fall, 0, 1)
        lift, rate = formulas[self.law]
        return self.lift * (lift(up) - lift(down)), self.lift * (rate(up) / rise - rate(down) / fall)

    def curve(self) -> CamCurve:
        """The package's curve."""
        rise, dwell, fall, _ = self.angles
        last = 2 * np.pi - rise - dwell - fall
        program = MotionProgram(
            (
                Segment(rise, self.lift, law=self.law),
                Segment(dwell),
                Segment(fall, -self.lift, law=self.law),
                Segment(last),
            )
        )
        follower = Follower(
            self.kind,
            "oscillating" if self.oscillating else "translating",
            roller_radius=self.roller if self.kind == "roller" else 0.0,
            offset=self.offset,
            pivot_distance=self.pivot,
            arm=self.arm,
            face_offset=self.face,
        )
        made = FlatCurve if self.kind == "flat" else RollerCurve
        return made(program, follower, self.base, self.turn)

    @cached_property
    def found(self) -> tuple[Undercut, ...]:
        """What the package finds."""
        return undercuts(self.curve())

    def lost(self) -> tuple[np.ndarray, np.ndarray]:
        """Angles (n,), and how far the contact is from the profile that is left, m."""
        phi = 2 * np.pi * np.arange(DENSE) / DENSE
        s, v = self.lifts(phi)
        if self.kind == "flat":
            return phi, self._behind_hull(phi, s)
        c, s0 = np.cos(self.turn * phi), np.sin(self.turn * phi)
        if self.oscillating:
            start = np.arccos(
                (self.pivot**2 + self.arm**2 - (self.base + self.roller) ** 2) / (2 * self.pivot * self.arm)
            )
            x, y = self.pivot - self.arm * np.cos(start + s), self.arm * np.sin(start + s)
            dx, dy = self.arm * np.sin(start + s) * v, self.arm * np.cos(start + s) * v
        else:
            x, y = np.full(DENSE, self.offset), np.sqrt((self.base + self.roller) ** 2 - self.offset**2) + s
            dx, dy = np.zeros(DENSE), v
        pitch = np.stack([c * x + s0 * y, -s0 * x + c * y], axis=1)
        left = shapely.Polygon(pitch).buffer(-self.roller, quad_segs=90)
        dx, dy = dx + self.turn * y, dy - self.turn * x
        tangent = np.stack([c * dx + s0 * dy, -s0 * dx + c * dy], axis=1)
        tangent /= np.hypot(*tangent.T)[:, None]
        contact = pitch - self.roller * self.turn * np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        if left.is_empty:
            return phi, np.full(DENSE, np.inf)
        return phi, shapely.distance(shapely.points(contact), left.boundary)

    def _behind_hull(self, phi: np.ndarray, s: np.ndarray) -> np.ndarray:
        """Lines n·x = H bound the cam where n/H lies on the hull of all of them (polar duality)."""
        if self.oscillating:
            psi = np.arcsin((self.base + self.face) / self.pivot) + s
            height, angle = self.pivot * np.sin(psi) - self.face, np.pi / 2 - psi - self.turn * phi
        else:
            height, angle = self.base + s, np.pi / 2 - self.turn * phi
        dual = np.stack([np.cos(angle), np.sin(angle)], axis=1) / height[:, None]
        hull = shapely.MultiPoint(dual).convex_hull
        return shapely.distance(shapely.points(dual), hull.boundary) * height**2


def random_cam(rng: np.random.Generator) -> RandomCam:
    """One whose follower touches it at zero lift; often with undercut."""
    while True:
        shares = rng.uniform(0.4, 1.6, 4)
        angles = tuple((2 * np.pi * shares / shares.sum()).tolist())
        base = rng.uniform(0.015, 0.05)
        oscillating = bool(rng.random() < 0.4)
        kind = "flat" if rng.random() < 0.35 else "roller"
        cam = RandomCam(
            kind=kind,
            oscillating=oscillating,
            angles=angles,
            law=str(rng.choice(["cycloidal", "polynomial_345", "simple_harmonic"])),
            lift=rng.uniform(0.1, 0.6) if oscillating else rng.uniform(0.005, 0.045),
            base=base,
            roller=rng.uniform(0.004, 0.045),
            offset=0.0 if oscillating else rng.uniform(-0.4, 0.4) * base,
            pivot=rng.uniform(2.0, 3.5) * base,
            arm=rng.uniform(1.5, 3.0) * base,
            face=rng.uniform(-0.3, 0.3) * base,
            turn=float(rng.choice([-1.0, 1.0])),
        )
        if possible(cam):
            return cam


def possible(cam: RandomCam) -> bool:
    """Whether the follower can be where the program sends it, and the pitch curve does not cross itself."""
    if not cam.oscillating:
        return True
    if cam.kind == "flat":
        share = (cam.base + cam.face) / cam.pivot
        return 0.05 < share < 0.9 and np.arcsin(share) + cam.lift < 1.45 and cam.lift / min(cam.angles) < 0.45
    prime = cam.base + cam.roller
    share = (cam.pivot**2 + cam.arm**2 - prime**2) / (2 * cam.pivot * cam.arm)
    return abs(share) < 0.97 and np.arccos(share) + cam.lift < 2.6 and cam.lift / min(cam.angles) < 0.5


def disagreement(cam: RandomCam) -> str:
    """Empty where both find the same parts of the way cut away, else what differs."""
    phi, far = cam.lost()
    outside = np.ones(DENSE, dtype=bool)
    for each in cam.found:
        share = ((phi - each.start) % (2 * np.pi)) / (each.end - each.start)
        outside &= share > 1
        kept = (share > 0.1) & (share < 0.9) & (far < 1e-9)
        if each.depth > 20 * LOST and kept.any():
            return f"not cut at {np.degrees(phi[kept])[:3]}: {cam}"
    missed = outside & np.roll(outside, 1) & np.roll(outside, -1) & (far > LOST)
    if missed.any():
        return f"missed at {np.degrees(phi[missed])[:3]}, {far[missed].max():.2e} m: {cam}"
    return ""


def main(count: int) -> int:
    """Compares so many cams; the number that differ."""
    rng = np.random.default_rng(12)
    wrong = cut = 0
    for _ in range(count):
        cam = random_cam(rng)
        cut += bool(cam.found)
        said = disagreement(cam)
        if said:
            wrong += 1
            print(said)
    print(f"{count} cams, {cut} of them undercut, {wrong} differ")
    return wrong


if __name__ == "__main__":
    sys.exit(bool(main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)))
