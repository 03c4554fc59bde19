"""Belts: two pulleys on one carrier, with an open or a crossed belt."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable, Mapping, Sequence
from math import asin
from math import sqrt as sqrt_of
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Mask, Scalar, reciprocal, sqrt
from linkwright.engine.vector import Vec
from linkwright.fields.base import Field, Quantity, Word
from linkwright.joints.base import JOINTS, Contact, Entry, Poses
from linkwright.joints.marks import Mark
from linkwright.joints.toothed import WheelCut, WheelPair, length
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.elements.topology import Connection
    from linkwright.kinematics.dimensions import Dimensions
    from linkwright.kinetostatics.forces import Forces
    from linkwright.mechanism.mechanism import Mechanism


@JOINTS.register("belt")
@dataclass(frozen=True)
class BeltPair(WheelPair):
    """A belt without slip around two pulleys of pitch ``radii``, ``run`` open or crossed.

    The row is r_a (θ_a - θ_c) ∓ r_b (θ_b - θ_c) = const, - for an open belt. Its multiplier F is the effective pull,
    positive where it turns a counter-clockwise. The strands lie along the tangents; with the ``pretension`` F0 (N, of
    each strand) they carry F0 + F/2 and F0 - F/2 (a note says where F0 is less than F/2), without it the taut one
    carries |F| and the other nothing (Norton, Machine Design, ch. 14).
    """

    letter: ClassVar[str] = "B"
    couples: ClassVar[bool] = True
    run: str = "open"
    pretension: float = 0.0

    @property
    def sense(self) -> float:
        return 1.0 if self.run == "open" else -1.0

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            **super().fields(),
            "run": Word(("open", "crossed"), doc="default open"),
            "pretension": Quantity("force", minimum=0, doc="tension of each strand without load (default 0)"),
        }

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        return ("radii",)

    def pitch_radii(self) -> tuple[float, float]:
        """Radii on which the belt runs, m."""
        assert self.radii is not None
        return self.radii

    def running_radii(self) -> tuple[float, float]:
        return self.pitch_radii()

    def check(self, entry: Entry, distance: float) -> None:
        problem = self._touching(distance)
        if problem is not None:
            entry.say("radii" if self.radii else "teeth", problem, Sentence("joints.pulleys_apart"), "range")

    def _touching(self, distance: float) -> Sentence | None:
        a, b = self.pitch_radii()
        if a + b < distance:
            return None
        return Sentence(
            "joints.pulleys_touch", sum=length(a + b), centres=self.centres, distance=length(distance)
        )

    def misfit(self, mechanism: Mechanism) -> Sentence | None:
        return self._touching(abs(self.line(mechanism)))

    def fits(self, dimensions: Dimensions) -> Mask:
        first, second = self.traced_radii(dimensions)
        a, b = (dimensions.point(self.carrier, each) for each in self.centres)
        both = first + second
        return both * both < (b - a).square

    def dimensions(self) -> Mapping[str, float]:
        own = {f"{self.name}.pretension": self.pretension} if self.pretension else {}
        return {**super().dimensions(), **own}

    def arms(self, mechanism: Mechanism) -> tuple[float, float]:
        a, b = self.pitch_radii()
        return a, -self.sense * b

    def marks(self, mechanism: Mechanism, tooth: dict[tuple[str, str], float]) -> Iterable[Mark]:
        """Two pulleys and the strands between them."""
        radii = self.pitch_radii()
        for k, link in enumerate(self.links):
            yield Mark("disc", link, mechanism.link(link).points[self.centres[k]], radii[k])
        points = mechanism.link(self.carrier).points
        a, b = (complex(*points[each]) for each in self.centres)
        e, far = (b - a) / abs(b - a), abs(b - a)
        sine = (radii[0] - self.sense * radii[1]) / far
        for side in (1.0, -1.0):
            n = e * complex(sine, side * sqrt_of(1.0 - sine * sine))
            start, end = a + radii[0] * n, b + self.sense * radii[1] * n
            yield Mark("strand", self.carrier, (start.real, start.imag), to=(end.real, end.imag))

    def contact(self, mechanism: Mechanism) -> Contact:
        line, (first, other) = self.line(mechanism), self.arms(mechanism)
        return Contact(
            -other,
            self.carrier,
            cmath.phase(line),
            (self.carrier, self.centres[0]),
            lean=asin((first + other) / abs(line)),
            strands=True,
            press=0.0 if self.pretension else 1.0,
            pull=self.pretension,
        )

    def pulls(self, forces: Forces) -> Any:
        """Where the slack strand would have to push: more than twice the pretension is transmitted."""
        if not self.pretension:
            return None
        transmitted = abs(forces.couple(self.name, on=self.links[0])) / self.pitch_radii()[0]
        return transmitted > (2.0 + 1e-9) * self.pretension

    def traced_radii(self, dimensions: Dimensions) -> tuple[Scalar, Scalar]:
        """The radii as traced values."""
        return dimensions(f"{self.name}.radii.0"), dimensions(f"{self.name}.radii.1")

    def cut(self, connection: Connection, dimensions: Dimensions) -> BeltCut:
        a, b = (dimensions.point(self.carrier, each) for each in self.centres)
        first, second = self.traced_radii(dimensions)
        across = -self.sense * second
        line = b - a
        sine = (first + across) * reciprocal(sqrt(line.square))
        pull = dimensions(f"{self.name}.pretension") if self.pretension else 0.0
        rest = -across * dimensions(f"{self.name}.phase")
        k = (first, across, -first - across)
        return BeltCut(
            connection, self.carrier, k, rest, a, b, line * reciprocal(sqrt(line.square)), sine, pull
        )


@dataclass(frozen=True)
class BeltCut(WheelCut):
    """The traced row; ``unit``: from A to B in the carrier's axes; ``sine``: of the strands' angle to it; tension
    ``pull`` of each strand without load. The force is given at the centre of a, with its couple about it."""

    unit: Vec
    sine: Scalar
    pull: Scalar

    def _strands(self, poses: Poses) -> tuple[Vec, Vec]:
        """Unit vectors from a to b along the strand that turns a clockwise, and along the other."""
        e = poses[self.carrier].spin(self.unit)
        cosine = sqrt(1.0 - self.sine * self.sine)
        return e * cosine - e.perp * self.sine, e * cosine + e.perp * self.sine

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Poses) -> tuple[Vec, Scalar]:
        pull = multipliers[0]
        clockwise, counter = self._strands(poses)
        force = counter * (self.pull + 0.5 * pull) + clockwise * (self.pull - 0.5 * pull)
        couple = self.k[0] * pull
        return (force, couple) if end == self.connection.a else (-force, -couple)

    def pressing(
        self, multipliers: Sequence[Scalar], poses: Poses, size: Callable[[Scalar], Scalar]
    ) -> Vec | None:
        """Without a pull of its own one strand is slack: both have half of the other's force more."""
        if not isinstance(self.pull, float) or self.pull != 0.0:
            return None
        clockwise, counter = self._strands(poses)
        return (counter + clockwise) * (0.5 * size(multipliers[0]))
