"""What a run does at singular positions, so that it neither creeps into a dead point nor loses its way.

The event is a group whose quality falls below a bound. Where a change point is near, the coordinates stay, and their
formulas are bridged; else the joint takes over in which the groups are farthest from singular. Where there is none,
as for a pose that is only passed at some distance, the bound is lowered, and in the end the run is refused.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.change_point_search import change_point
from linkwright.dynamics.change_points import Bridged, ChangePoint
from linkwright.dynamics.description import Description
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.hand_over import Descriptions
from linkwright.dynamics.right_side import RightSide
from linkwright.errors import LinkwrightError
from linkwright.kinematics.positions import coordinate_text
from linkwright.words import _
from linkwright.words.message import together

#: Quality of a group (of two pinned bars sin² between them) below which something must be done.
BOUND = 0.1
#: Another description must be so much better; below this quality nothing helps any more.
BETTER, HOPELESS = 2.0, 1e-8
#: Quality below which a run begins at a dead point, and how far rounding may put that out of reach, rad or size.
AT_ONCE, ROUNDED = 1e-6, (1e-15, 1e-14, 1e-13, 1e-12)
#: The surroundings of a change point end at this multiple of its reach.
BEHIND = 1.1


@dataclass
class Stretch:
    """The way between two such events: a description, and the change point in whose surroundings it lies, if any.

    ``bound``: the quality at which the next event is.
    """

    description: Description
    point: ChangePoint | None = None
    bound: float = BOUND

    def side(self, right: RightSide) -> RightSide | Bridged:
        """A right side of its equation as it is to be called on it."""
        right.set_inputs(self.description.held)
        return right if self.point is None else Bridged(right, self.point)

    def margin(self, qualities: Floats, side: RightSide | Bridged) -> float:
        """Positive within the stretch: at qualities of the groups, where a side was called last."""
        if self.point is not None and isinstance(side, Bridged):
            return BEHIND * self.point.reach - abs(side.beyond)
        return float(np.min(qualities, initial=np.inf)) - self.bound


class SingularPositions:
    """Those of one machine."""

    def __init__(self, equation: EquationOfMotion) -> None:
        self.descriptions = Descriptions(equation)

    def first(self, q: Floats, w: Floats) -> tuple[Stretch, Floats, Floats]:
        """The stretch on which a run begins, and its coordinates and rates (drivers,) each."""
        begin = Stretch(Description.of(self.descriptions.first))
        q = self._reached(begin.description, q)
        if not begin.description.quality(q) <= BOUND:
            return begin, q, w
        found = self.next(begin, q, w)
        if found[0].point is None and begin.description.quality(q) < AT_ONCE and w.any():
            raise LinkwrightError(
                _(
                    "{name!r} begins at a dead point, at {where}, where a speed of its driver does not tell how fast "
                    "the others are; begin from rest, or at another position",
                    code="dynamics.speed_at_dead_point",
                    name=begin.description.equation.source.name,
                    where=self._where(begin.description, q),
                )
            )
        return found

    @staticmethod
    def _reached(description: Description, q: Floats) -> Floats:
        """Coordinates (drivers,); those of a dead point that rounding has put out of reach, just within it."""
        if np.isfinite(description.qualities(q)).all():
            return q
        size = description.equation.mechanism.size
        unit = np.array([1.0 if description.equation.rotary[name] else size for name in description.names])
        for share in ROUNDED:
            for k in range(len(q)):
                for sign in (1.0, -1.0):
                    near = q.copy()
                    near[k] += sign * share * unit[k]
                    if np.isfinite(description.qualities(near)).all():
                        return near
        return q

    def next(self, stretch: Stretch, q: Floats, w: Floats) -> tuple[Stretch, Floats, Floats]:
        """The stretch that follows behind an event, and the coordinates and rates on it.

        Raises:
            LinkwrightError: no other coordinates lead on.
        """
        now = self.descriptions.flipping(stretch.description)
        if stretch.point is not None:
            side = 1.0 if stretch.point.beyond(q) < 0.0 else -1.0
            flipped = {group: side * sign for group, sign in stretch.point.modes.items()}
            now = replace(now, modes={**now.modes, **flipped})
            return Stretch(now, None, self._bound(now, q)), q, w
        point = change_point(now, q, w)
        if point is not None:
            return Stretch(now, point), q, w
        quality = now.quality(q)
        better = self.descriptions.better(now, q, w, BETTER * max(quality, HOPELESS))
        if better is not None:
            other, q, w = better
            return Stretch(other, None, self._bound(other, q)), q, w
        if not quality > HOPELESS:
            self._refuse(now, q)
        return Stretch(now, None, 0.5 * quality), q, w

    @staticmethod
    def _bound(description: Description, q: Floats) -> float:
        return min(BOUND, 0.5 * description.quality(q))

    def _refuse(self, now: Description, q: Floats) -> None:
        group = now.equation.groups[int(np.argmin(now.qualities(q)))]
        raise LinkwrightError(
            _(
                "{name!r} comes to a singular position at {where}: the group ({links}) is at a dead point, and no "
                "other joint's coordinate leads beyond it; change a length of it, or end the run before",
                code="dynamics.dead_point",
                name=now.equation.source.name,
                where=self._where(now, q),
                links=tuple(now.equation.solver.motion.placed[group].group.links),
            )
        )

    @staticmethod
    def _where(now: Description, q: Floats) -> str:
        """The coordinates of the model's drivers in words."""
        drivers = now.equation.source.drivers
        own = now.coordinates(drivers, q, 0.0 * q)[0].tolist()
        pairs = zip(drivers.values(), own, strict=True)
        return together([coordinate_text(each.name, value, each.law.rotary) for each, value in pairs])
