"""What all motion laws have in common: their four curves, ends and peak factors."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright.curves.curve import Curve
from linkwright.fields.base import FileKeys
from linkwright.registry import Registry
from linkwright.words import Message, _

#: Below this share of the largest value a velocity or acceleration at an end is zero.
SMALL = 1e-9
#: Distance from a break at which a curve has the value of its side.
_EDGE = 1e-13
#: What a law does at an end (VDI 2143): neither velocity nor acceleration, velocity alone, acceleration alone, both.
END_KINDS = ("rest", "velocity", "turn", "motion")


@dataclass(frozen=True)
class Ends:
    """Velocity and acceleration at both ends of a rise of 1 over u from 0 to 1."""

    velocity: tuple[float, float] = (0.0, 0.0)
    acceleration: tuple[float, float] = (0.0, 0.0)

    @property
    def kinds(self) -> tuple[str, str]:
        """``rest``, ``velocity``, ``turn`` or ``motion`` at the start and at the end (VDI 2143: R, G, U, B)."""
        moving = [abs(each) > SMALL for each in self.velocity]
        bending = [abs(each) > SMALL for each in self.acceleration]
        first, last = (END_KINDS[v + 2 * a] for v, a in zip(moving, bending, strict=True))
        return first, last


@dataclass(frozen=True)
class Peaks:
    """Peak factors: the largest sizes of velocity, acceleration and jerk between jumps, for a rise of 1."""

    velocity: float
    acceleration: float
    jerk: float


class MotionLaw(ABC):
    """A rise from 0 at u = 0 to 1 at u = 1; lift h over an angle β: s = h s(φ/β), s' = (h/β) v, s'' = (h/β²) a.

    Laws are frozen dataclasses. ``key`` is the name in files, ``fields`` its further keys there, ``source`` where it
    is described.
    """

    key: ClassVar[str]
    fields = FileKeys()
    source: ClassVar[str]

    @abstractmethod
    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        """Displacement, velocity, acceleration and jerk at u (n,) from 0 to 1, exact derivatives of one another.

        At a jump the value of the right side; for u with an imaginary part the continuation of the piece.
        """

    @property
    def formula(self) -> str:
        """s(u) on a line, for worked solutions; empty where it has several pieces."""
        return ""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Places inside at which a derivative up to the jerk may jump."""
        return ()

    @classmethod
    def meeting(cls, ends: Ends, rise: float) -> MotionLaw | None:
        """The law of this kind whose ends are these (for a rise of 1 or 0), None where its ends are its own."""
        return None

    @cached_property
    def ends(self) -> Ends:
        """Velocity and acceleration at both ends."""
        _place, v, a, _jerk = self.curves(np.array([_EDGE, 1.0 - _EDGE]))
        first, last = np.asarray(v, dtype=float), np.asarray(a, dtype=float)
        return Ends((float(first[0]), float(first[1])), (float(last[0]), float(last[1])))

    @cached_property
    def peaks(self) -> Peaks:
        """Peak factors C_v, C_a, C_j; impulses of the jerk where the acceleration jumps are not among them."""
        return Peaks(*(self._peak(order) for order in (1, 2, 3)))

    @cached_property
    def smoothness(self) -> int:
        """Highest derivative without jumps where the law begins and ends in a dwell: -1 to 3."""
        edges = np.array([0.0, *self.breaks, 1.0])
        left, right = self.curves(edges - _EDGE), self.curves(edges + _EDGE)
        for order in range(4):
            before, after = np.array(left[order], dtype=float), np.array(right[order], dtype=float)
            outside = (0.0, 1.0 if order == 0 else 0.0)
            before[0], after[-1] = outside
            size = max(1.0, float(np.abs(after).max()))
            if np.abs(after - before).max() > 1e-7 * size:
                return order - 1
        return 3

    def _peak(self, order: int) -> float:
        """Largest size of a derivative between its jumps."""
        curve = Curve.of(lambda u: self.curves(u)[order], 0.0, 1.0, pieces=24, knots=np.array(self.breaks))
        return max(curve.extreme("max").value, -curve.extreme("min").value, 0.0)


@dataclass(frozen=True)
class MeetingLaw(MotionLaw):
    """A law that meets any velocity and acceleration at its ends; ``rise`` is 1, or 0 for a way there and back."""

    demanded: Ends = field(default_factory=Ends)
    rise: float = 1.0

    @classmethod
    def meeting(cls, ends: Ends, rise: float) -> MotionLaw:
        return cls(ends, rise)


MOTION_LAWS: Registry[type[MotionLaw]] = Registry(
    _("motion law"), "linkwright.laws", entry_points="linkwright.laws", attribute="key"
)

#: Names of the laws in words.
LABELS: Mapping[str, Message] = {
    "dwell": _("dwell"),
    "constant_acceleration": _("constant acceleration (parabolic)"),
    "constant_velocity": _("constant velocity"),
    "cycloidal": _("cycloidal (sine acceleration)"),
    "double_harmonic": _("double harmonic"),
    "freudenstein": _("Freudenstein 1-3"),
    "freudenstein_135": _("Freudenstein 1-3-5"),
    "gutman": _("Gutman 1-3"),
    "harmonic_combination": _("sum of harmonics"),
    "inclined_sine": _("inclined sine"),
    "modified_sine": _("modified sine"),
    "modified_sine_cv20": _("modified sine, 20 % constant velocity"),
    "modified_sine_cv33": _("modified sine, 33 % constant velocity"),
    "modified_sine_cv50": _("modified sine, 50 % constant velocity"),
    "modified_sine_cv66": _("modified sine, 66 % constant velocity"),
    "modified_trapezoidal": _("modified trapezoidal"),
    "optimized_spline": _("optimised spline"),
    "polydyne": _("polydyne"),
    "polynomial": _("polynomial"),
    "polynomial_23": _("polynomial 2-3"),
    "polynomial_345": _("polynomial 3-4-5"),
    "polynomial_4567": _("polynomial 4-5-6-7"),
    "polynomial_5": _("polynomial of degree 5 that meets its neighbours"),
    "polynomial_7": _("polynomial of degree 7 that meets its neighbours"),
    "simple_harmonic": _("simple harmonic"),
    "sine_constant_cosine": _("sine, constant, cosine"),
    "smoothed_table": _("smoothed table"),
    "spline": _("spline"),
    "triple_harmonic": _("triple harmonic"),
}
