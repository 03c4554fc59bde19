"""Belts: two pulleys on one carrier, with an open or a crossed belt."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from linkwright.elements import Model, Sizes
from linkwright.fields.base import Field, Quantity, Word
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Mask, Scalar, reciprocal, sqrt
from linkwright.joints.base import JOINTS, Entry, Size
from linkwright.joints.ends import Ends
from linkwright.joints.toothed import WheelPair, length
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats


@JOINTS.register("belt")
@dataclass(frozen=True)
class BeltPair(WheelPair):
    """A belt without creep around two pulleys of pitch ``radii``, ``run`` open or crossed.

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
            "run": Word(("open", "crossed"), doc=_("default open")),
            "pretension": Quantity("force", minimum=0, doc=_("tension of each strand without load (default 0)")),
        }

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        return ("radii",)

    def pitch_radii(self) -> tuple[float, float]:
        """Radii on which the belt runs, m."""
        assert self.radii is not None
        return self.radii

    def check(self, entry: Entry, distance: float) -> None:
        problem = self._touching(distance)
        if problem is not None:
            entry.finding(
                "radii" if self.radii else "teeth",
                problem,
                _("increase the centre distance, or take smaller wheels"),
                "range",
            )

    def _touching(self, distance: float) -> Message | None:
        a, b = self.pitch_radii()
        if a + b < distance:
            return None
        return _(
            "the radii add up to {sum}, but the distance of the centres {centres} is {distance}",
            code="joints.pulleys_touch",
            sum=length(a + b),
            centres=self.centres,
            distance=length(distance),
        )

    def misfit(self, mechanism: Model) -> Message | None:
        return self._touching(abs(self.line(mechanism)))

    def fits(self, dimensions: Sizes) -> Mask:
        first, second = self.traced_radii(dimensions)
        a, b = (dimensions.point(self.carrier, each) for each in self.centres)
        both = first + second
        return both * both < (b - a).square

    def dimensions(self) -> Mapping[str, float]:
        own = {f"{self.name}.pretension": self.pretension} if self.pretension else {}
        return {**super().dimensions(), **own}

    def arms(self, mechanism: Model) -> tuple[float, float]:
        a, b = self.pitch_radii()
        return a, -self.sense * b

    def pulls(self, force: Callable[[], Floats]) -> Flags | None:
        """Where the slack strand would have to push: more than twice the pretension is transmitted."""
        return abs(force()) > (2.0 + 1e-9) * self.pretension if self.pretension else None

    def traced_arms(self, at: Ends) -> tuple[Scalar, Scalar, Scalar]:
        first, second = self.traced_radii(at.dimensions)
        across = -self.sense * second
        return first, across, -first - across

    def held(self, at: Ends, force: Scalar, size: Size) -> list[tuple[Scalar, Scalar]]:
        """Both strands pull the centres together, with the difference of their pulls to one side of their line."""
        outward, aside = self.centre_offset(at)
        sine = -self.traced_arms(at)[2] * reciprocal(sqrt(self.traced_line(at.dimensions).square))
        pull = at.dimension(f"{self.name}.pretension") * 2.0 if self.pretension else size(force)
        return [(-aside, sine * force), (outward, -pull * sqrt(1.0 - sine * sine))]

    def place(self, at: Ends, link: str) -> Vec:
        """The centre of a."""
        return at.point(self.carrier, self.centres[0])

    def traced_radii(self, dimensions: Sizes) -> tuple[Scalar, Scalar]:
        """The radii as traced values."""
        return dimensions(f"{self.name}.radii.0"), dimensions(f"{self.name}.radii.1")
