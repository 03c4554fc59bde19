"""Velocity and acceleration polygons of one position: their numbers, and the polygons to scale next to the position.

The graphical method: absolute vectors begin at the pole; on every link the vector of a point is that of its first
joint plus the relative one, whose acceleration has a part along the link (normal, ω² r towards the first joint) and
one across it (tangential, α r). At a moving guide the block's point adds the Coriolis acceleration 2 ω × v_r and the
relative one along the guide (Norton, Design of Machinery, chapters 6 and 7).
"""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import per_mm, significant
from linkwright.errors import LinkwrightError
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.pictures.drawing import BLUE, GREEN, ORANGE, PURPLE, TEAL, Drawing, Sketch, arrow_rules
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import indexed, joined
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plotting.diagrams.marks import with_index
from linkwright.plotting.diagrams.scaled_page import (
    BAR,
    MILLIMETRE,
    Cell,
    Written,
    key,
    page,
    page_width,
    position_cell,
    scale_of_picture,
    scale_title,
    side_by_side,
    units,
)
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.words import _

#: Longest extent of the polygon on the paper, mm.
POLYGON = 110.0
#: Minimum width of a column of sizes, units.
COLUMN = 168.0
#: Letters of the pole, the first one that no point has.
POLES = ("p", "π", "o", "p*")
#: Letters above the symbols of parts of an acceleration.
ABOVE = {"normal": "n", "tangential": "t", "coriolis": "k", "sliding": "r"}
#: Roles of vectors with their colours and dashes, mm.
LOOKS = {
    "absolute": (BLUE, ""),
    "relative": (ORANGE, ""),
    "normal": (GREEN, "6 3"),
    "tangential": (ORANGE, "6 3"),
    "coriolis": (PURPLE, "6 3"),
    "sliding": (TEAL, "6 3"),
}
CSS = "".join(arrow_rules(role, colour, 1.8, dash) for role, (colour, dash) in LOOKS.items())
#: What the parts of a polygon are.
ROLES = {
    "absolute": _("absolute"),
    "relative": _("relative"),
    "normal": _("normal aⁿ"),
    "tangential": _("tangential aᵗ"),
    "coriolis": _("Coriolis aᵏ"),
    "sliding": _("sliding"),
}


class MotionPolygons(Kind):
    """A polygon with its pole, images of all points, and the vectors between them, drawn to a round scale."""

    unit: ClassVar[str]
    letter: ClassVar[str]
    prime: ClassVar[str] = ""
    single = _("a polygon shows one mechanism at one position; give one result", code="picture.one_mechanism")

    @abstractmethod
    def polygon(self, motion: Motion) -> MotionPolygon:
        """The polygon of a motion's first position."""

    def draw(self, sources: Sequence[PlotInput], request: Request) -> Drawing:
        motion = sources[0].at(request.at)
        polygon = self.polygon(motion)
        scale = scale_of_picture(polygon.places, POLYGON)
        return self._page(sources[0], motion, polygon, scale, request)

    def _page(
        self, source: PlotInput, motion: Motion, polygon: MotionPolygon, scale: float, request: Request
    ) -> Drawing:
        translate = request.translate
        scale_text = scale_title(translate(_("polygon")), self.letter, f"{significant(scale)} {per_mm(self.unit)}")
        bar = f"{significant(BAR * MILLIMETRE * scale)} {self.unit}"
        cells = [position_cell(motion, translate), Cell(_sketch(polygon, scale, self.prime), (scale_text,), bar)]
        roles = {step.role for step in polygon.steps}
        subject = f"{translate(self.title)}, {source.place_text(motion, translate)}"
        title = request.titled(source.label, subject)
        return page(
            cells,
            2,
            [
                key([(translate(ROLES[role]), f"lw-{role}") for role in LOOKS if role in roles]),
                *_columns(_table(polygon, self.unit), page_width(cells, 2)),
            ],
            request.heading(title),
            title,
            CSS,
        )


@DIAGRAMS.register("velocity_polygon")
class VelocityPolygon(MotionPolygons):
    """Velocities of all points from one pole p, and relative velocities between them."""

    title = _("velocity polygon")
    options = ("at",)
    unit, letter = "m/s", "v"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return velocity_polygon(motion, 0)


@DIAGRAMS.register("acceleration_polygon")
class AccelerationPolygon(MotionPolygons):
    """Accelerations of all points from one pole p′; normal, tangential, Coriolis and sliding parts dashed."""

    title = _("acceleration polygon")
    options = ("at",)
    unit, letter, prime = "m/s²", "a", "′"

    def polygon(self, motion: Motion) -> MotionPolygon:
        return acceleration_polygon(motion, 0)


def _sketch(polygon: MotionPolygon, scale: float, prime: str) -> Sketch:
    """Vectors and names; the vectors of a flat polygon stand side by side."""
    sketch = Sketch()
    for step, (start, end) in zip(polygon.steps, arrows(polygon, scale), strict=True):
        sketch.arrow(units(start), units(end), f"lw-{step.role}")
    for names, image in gathered(polygon, scale, prime):
        sketch.circle(vec(units(image)), 1.8, "lw-point")
        sketch.labels.append(Label(", ".join(names), (vec(units(image)),), size=13.0, clearance=5.0, leader=False))
    sketch.write_names()
    return sketch


def arrows(polygon: MotionPolygon, scale: float) -> list[tuple[Floats, Floats]]:
    """Starts and ends of the vectors in paper mm from the pole."""
    return side_by_side([(step.start / scale, step.end / scale) for step in polygon.steps])


def image_names(points: Iterable[str], prime: str = "") -> tuple[str, dict[str, str]]:
    """Names of the pole and of the images of points: small letters, of which no two are the same.

    The pole is p, or where a point's image is p: π, then o. Points whose small letters are the same keep their links'
    names, or their capitals.
    """
    own_points = list(points)
    ways: tuple[Callable[[str], str], ...] = (lambda point: point.rpartition(".")[2].lower(), str.lower, str)
    names: dict[str, str] = {}
    for way in ways:
        tried = {point: with_index(way(point)) for point in own_points if point not in names}
        count = Counter([*tried.values(), *names.values()])
        names |= {point: name for point, name in tried.items() if count[name] == 1 or way is str}
    pole = next(each for each in POLES if each not in names.values())
    return pole + prime, {point: names[point] + prime for point in own_points}


def gathered(polygon: MotionPolygon, scale: float, prime: str) -> list[tuple[list[str], Floats]]:
    """Images with their names; those at one place share a label. The pole comes first."""
    pole, letters = image_names(polygon.images, prime)
    found: list[tuple[list[str], Floats]] = [([pole], np.zeros(2))]
    for name, image in polygon.images.items():
        place = image / scale
        near = next((names for names, other in found if np.hypot(*(other - place)) < 0.6), None)
        if near is None:
            found.append(([letters[name]], place))
        else:
            near.append(letters[name])
    return found


def _table(polygon: MotionPolygon, unit: str) -> list[Written]:
    """Group by group the sizes of the vectors in the colours of their roles, those of zero size left out."""
    largest = max(step.size for step in polygon.steps)
    found: list[Written] = []
    for name in dict.fromkeys(step.group for step in polygon.steps):
        sizes: list[Written] = [
            (
                joined(
                    indexed(step.letter, step.name, ABOVE.get(step.role, "")), f" = {significant(step.size)} {unit}"
                ),
                f"lw-{step.role}-name",
            )
            for step in polygon.steps
            if step.group == name and step.size > 1e-9 * largest
        ]
        found += [(name, "lw-legend"), *sizes] if sizes else []
    return found


def _columns(texts: list[Written], width: float) -> list[list[tuple[Written, float]]]:
    """Texts in lines of columns that are read downwards."""
    columns = int(width // COLUMN)
    rows = -(-len(texts) // columns)
    return [[(text, number * width / columns) for number, text in enumerate(texts[row::rows])] for row in range(rows)]


@dataclass(frozen=True)
class Step:
    """A vector of the polygon from ``start`` to ``end`` (2,): ``letter``, ``name`` of points, ``role``, ``group``.

    Roles: ``absolute``, ``relative``, ``normal``, ``tangential``, ``coriolis``, ``sliding``.
    """

    letter: str
    name: str
    role: str
    start: Floats
    end: Floats
    group: str = ""

    @property
    def size(self) -> float:
        """Its length, SI."""
        return float(np.hypot(*(self.end - self.start)))


@dataclass
class MotionPolygon:
    """``images`` of the points by name, (2,) each from the pole, and the ``steps`` that lead to them."""

    images: dict[str, Floats] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)
    group: str = ""

    @property
    def places(self) -> Floats:
        """The pole, images and ends of all vectors, (n, 2); raises LinkwrightError where nothing moves."""
        found = np.array([np.zeros(2), *self.images.values(), *(step.end for step in self.steps)])
        if not float(np.ptp(found, axis=0).max()) > 0.0:
            raise LinkwrightError(
                _(
                    "nothing moves at this position, so there is no polygon; choose another input: at=…",
                    code="picture.nothing_moves",
                )
            )
        return found

    def put(self, letter: str, name: str, role: str, start: Floats, end: Floats) -> None:
        """A vector from start to end."""
        self.steps.append(Step(letter, name, role, np.asarray(start), np.asarray(end), self.group))


def velocity_polygon(motion: Motion, index: int) -> MotionPolygon:
    """Velocities of all points at one position, m/s."""
    return _Polygon(motion, index, "v").made()


def acceleration_polygon(motion: Motion, index: int) -> MotionPolygon:
    """Accelerations of all points at one position, m/s², with their normal, tangential and Coriolis parts."""
    return _Polygon(motion, index, "a").made()


def place_of(motion: Motion, link: str, point: str, index: int) -> Floats:
    """A point of a link at one position, (2,) m."""
    x, y = motion.mechanism.link(link).points[point]
    if link == "frame":
        return np.array([x, y])
    return np.asarray(motion.point(f"{link}.{point}").position[index])


class _Polygon:
    def __init__(self, motion: Motion, index: int, letter: str) -> None:
        self.motion, self.index, self.letter = motion, index, letter
        self.found = MotionPolygon()

    def made(self) -> MotionPolygon:
        """Group by group, in solving order; in each the absolute vectors of its points first."""
        guides = [joint for joint in self.motion.mechanism.guides.values() if joint.guide != "frame"]
        solved: set[str] = set()
        for group in self.motion.structure.groups:
            self.found.group = f"{group.signature}: {', '.join(group.links)}"
            known, place = set(self.found.images), len(self.found.steps)
            for link in group.links:
                self._link(link)
            solved |= set(group.links)
            for joint in [each for each in guides if solved >= {each.guide, each.block}]:
                guides.remove(joint)
                self._guide(joint)
            relative = self.found.steps[place:]
            del self.found.steps[place:]
            for point in [each for each in self.found.images if each not in known]:
                self.found.put(self.letter, point, "absolute", np.zeros(2), self.found.images[point])
            self.found.steps += relative
        return self.found

    def _link(self, link: str) -> None:
        points = list(self.motion.mechanism.links[link].points)
        known = [p for p in points if canonical(self.motion.mechanism, link, p) in self.found.images]
        fixed = [p for p in points if self._fixed(link, p)]
        base = (fixed or known or points)[0]
        if not fixed:
            self.found.images.setdefault(self._key(link, base), self._value(link, base))
        for point in points:
            if point != base and not self._fixed(link, point):
                self._relative(link, base, point)
                self.found.images[self._key(link, point)] = self._value(link, point)

    def _relative(self, link: str, base: str, point: str) -> None:
        """From the image of a link's base to that of another of its points."""
        state, i = self.motion.link(link), self.index
        arm = place_of(self.motion, link, point, i) - place_of(self.motion, link, base, i)
        across = np.array([-arm[1], arm[0]])
        start, end = self._value(link, base), self._value(link, point)
        pair = point if self._fixed(link, base) else f"{point}{base}"
        if self.letter == "v":
            if not self._fixed(link, base):
                self.found.put("v", pair, "relative", start, end)
            return
        corner = start - float(state.angular_velocity[i]) ** 2 * arm
        self.found.put("a", pair, "normal", start, corner)
        self.found.put("a", pair, "tangential", corner, corner + float(state.angular_acceleration[i]) * across)

    def _guide(self, joint: SlidingJoint) -> None:
        """From the guide's point under the block to the block's own point."""
        under = f"{joint.at}({joint.guide})"
        state, i = self.motion.link(joint.guide), self.index
        base = next(iter(self.motion.mechanism.links[joint.guide].points))
        arm = place_of(self.motion, joint.block, joint.at, i) - place_of(self.motion, joint.guide, base, i)
        across = np.array([-arm[1], arm[0]])
        omega, alpha = float(state.angular_velocity[i]), float(state.angular_acceleration[i])
        point = self.motion.point(f"{joint.guide}.{base}") if not self._fixed(joint.guide, base) else None
        still = np.zeros(2)
        velocity = (still if point is None else point.velocity[i]) + omega * across
        own = self._value(joint.block, joint.at)
        if self.letter == "v":
            self.found.images[under] = velocity
            self.found.put("v", f"{joint.at}{under}", "sliding", velocity, own)
            return
        acceleration = (still if point is None else point.acceleration[i]) + alpha * across - omega**2 * arm
        sliding = np.asarray(self.motion.point(f"{joint.block}.{joint.at}").velocity[i]) - velocity
        corner = acceleration + 2 * omega * np.array([-sliding[1], sliding[0]])
        self.found.images[under] = acceleration
        self.found.put("a", joint.at, "coriolis", acceleration, corner)
        self.found.put("a", joint.at, "sliding", corner, own)

    def _key(self, link: str, point: str) -> str:
        key = canonical(self.motion.mechanism, link, point)
        return key if "." not in key or self._ambiguous(point) else point

    def _ambiguous(self, point: str) -> bool:
        links = self.motion.mechanism.links.values()
        keys = {canonical(self.motion.mechanism, each.name, point) for each in links if point in each.points}
        return len(keys) > 1

    def _fixed(self, link: str, point: str) -> bool:
        return {"frame", link} <= set(self.motion.mechanism.pin_links(point))

    def _value(self, link: str, point: str) -> Floats:
        found = self.motion.point(f"{link}.{point}")
        return np.asarray((found.velocity if self.letter == "v" else found.acceleration)[self.index])
