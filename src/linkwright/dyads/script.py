"""A program while it is written: its lines, the names in it, and where its points are."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator, Sequence

from linkwright.dyads.listed_numbers import angle, number, pair
from linkwright.dyads.plan import Axes, Guide, Pin, Plan, plan
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinetostatics.forces import Forces
from linkwright.words import Translate

#: Names that the program uses itself.
TAKEN = (
    "np",
    "lw",
    "dyads",
    "Body",
    "Line",
    "Load",
    "G",
    "cross",
    "table",
    "motion",
    "library",
    "turning",
    "reactions",
    "label",
    "axis",
    "lean",
    "moved",
    "sign",
    "shift",
    "place",
    "part",
    "i",
    "joint_of",
    "on",
    "force",
    "row",
    "value",
    "print",
    "zip",
    "map",
    "enumerate",
)


class Names:
    """Python names for the points, links and steps of a machine, each its own."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, str], str] = {}
        self._used = {*TAKEN, *keyword.kwlist}

    def of(self, kind: str, name: str) -> str:
        """The name of a point, a link, a driver or a step."""
        key = kind, name
        if key not in self._known:
            plain = re.sub(r"\W", "_", name)
            plain = plain if plain.isidentifier() else f"{kind}_{plain}"
            found = next(each for each in _tries(plain, kind) if each not in self._used)
            self._used.add(found)
            self._known[key] = found
        return self._known[key]


def _tries(name: str, kind: str) -> Iterator[str]:
    yield name
    yield f"{kind}_{name}"
    yield from (f"{kind}_{name}_{i}" for i in range(2, 10_000))


class Script:
    """The lines of a program that solves ``rows`` of a motion, and what its parts share."""

    def __init__(
        self,
        motion: Motion,
        forces: Forces | None,
        say: Translate,
        *,
        rows: Sequence[int] | None = None,
        source: str = "",
        language: str = "en",
    ) -> None:
        chosen = range(motion.steps) if rows is None else rows
        self.motion, self.forces, self.say, self.language = motion, forces, say, language
        self.source = source
        self.rows = [i for i in chosen if motion.ok[i]]
        self.plan: Plan = plan(motion, self.rows)
        self.mechanism = motion.mechanism
        self.names = Names()
        self.lines: list[str] = []
        self.placed: dict[str, str] = {}

    def at(self, link: str, place: complex) -> str:
        """A point of a link by its coordinates along the link's line and to its left."""
        left = "" if number(place.imag) == "0" else f", {number(place.imag)}"
        return f"{self.names.of('link', link)}.point({number(place.real)}{left})"

    def point(self, link: str, point: str) -> str:
        """A point of a link as it was placed, or where it is."""
        key = self.key(link, point)
        if key in self.placed:
            return self.placed[key]
        place = self.plan.axes[link].along(self.plan.local(link, point))
        return pair(place) if link == "frame" else self.at(link, place)

    def outer(self, outer: Pin | Guide) -> str:
        """An outer joint as an argument."""
        if isinstance(outer, Pin):
            return self.point(outer.link, outer.joint)
        axes: Axes = self.plan.axes[outer.link]
        place, turn = axes.along(outer.local), outer.angle - axes.lean
        if outer.link == "frame":
            return f"Line({pair(place)}, {angle(turn)})" if turn else f"Line({pair(place)})"
        arguments = [number(place.real), number(place.imag), angle(turn)]
        return f"{self.names.of('link', outer.link)}.line({', '.join(arguments)})"

    def write(self, *lines: str) -> None:
        """Adds lines to the program."""
        self.lines += lines

    def key(self, link: str, point: str) -> str:
        """The name of a point in the motion."""
        return canonical(self.mechanism, link, point)
