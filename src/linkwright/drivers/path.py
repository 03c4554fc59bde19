"""A path that a point follows over time, by which two drivers move: its pieces, its law and its keys in files."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from linkwright.drivers.base import LAWS, Law
from linkwright.errors import LinkwrightError
from linkwright.fields.base import Field, Quantity, Schema, table_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import PLACE, LinkPoint, PointReference
from linkwright.fields.tables import Flag
from linkwright.formula.late_import import numpy as np
from linkwright.laws.program_fields import LawField
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.curves.route import Route
    from linkwright.drivers.base import Array
    from linkwright.laws.base import MotionLaw

Vec = tuple[float, float]


@dataclass(frozen=True)
class Turned:
    """A step of a path: an arc about a centre, m, by an angle, rad, counter-clockwise positive."""

    about: Vec
    turn: float


Step = Vec | Turned
ARC_FIELDS: Mapping[str, Field] = {
    "about": replace(PLACE, required=True, doc=_("centre of the arc, in frame axes")),
    "turn": Quantity("angle", nonzero=True, required=True, doc=_("angle of the arc, counter-clockwise positive")),
}


@dataclass(frozen=True)
class Along(Field):
    """Points one after the other, ``[[x, y], …]``, with arcs ``{about: [x, y], turn: 90 deg}`` between them."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        items = reader.items(node, place, None, "[[400 mm, 200 mm], [600 mm, 200 mm]]")
        if items is None:
            return None
        found = [self._step(reader, each, place.child(str(k))) for k, each in enumerate(items)]
        return None if any(each is None for each in found) else tuple(found)

    def _step(self, reader: Reader, node: Node, place: Place) -> Any:
        if not isinstance(node, MappingNode):
            return PLACE.read(reader, node, place, {})
        values = reader.table(node, place, ARC_FIELDS) or {}
        about, turn = values.get("about"), values.get("turn")
        return None if about is None or turn is None else Turned(about, turn)

    def shape(self) -> Schema:
        return {"type": "array", "items": {"anyOf": [PLACE.shape(), table_schema(ARC_FIELDS)]}, "minItems": 2}

    def flatten(self, value: Any) -> dict[str, float]:
        return {
            f".{k}{key}{end}": number
            for k, step in enumerate(value)
            for key, field, part in self._parts(step)
            for end, number in field.flatten(part).items()
        }

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        found = []
        for k, step in enumerate(value):
            parts = [
                field.rebuild(part, lambda end, at=f".{k}{key}": lookup(at + end))  # type: ignore[misc]
                for key, field, part in self._parts(step)
            ]
            found.append(Turned(*parts) if isinstance(step, Turned) else parts[0])
        return tuple(found)

    @staticmethod
    def _parts(step: Step) -> list[tuple[str, Field, Any]]:
        """What a step consists of: suffix of the address, field, value."""
        if isinstance(step, Turned):
            return [(f".{key}", each, getattr(step, key)) for key, each in ARC_FIELDS.items()]
        return [("", PLACE, step)]

    def written(self, value: Any) -> Any:
        return [
            {key: ARC_FIELDS[key].written(getattr(step, key)) for key in ARC_FIELDS}
            if isinstance(step, Turned)
            else PLACE.written(step)
            for step in value
        ]


#: What a file says about where a path leads.
ROUTE_FIELDS: Mapping[str, Field] = {
    "point": PointReference(required=True, doc=_("the point that follows the path")),
    "along": Along(required=True, doc=_("points [x, y] and arcs {{about: [x, y], turn: 90 deg}}, in frame axes")),
    "smooth": Flag(doc=_("true: one smooth curve through all points")),
}
#: What it says about a path that is passed from rest to rest.
OVER_FIELDS: Mapping[str, Field] = {
    "over": Quantity("time", above=0.0, doc=_("time of the whole path, from rest to rest between corners")),
    "law": LawField(doc=_("motion law between corners, with over (default polynomial_5)")),
}


def path_laws() -> dict[str, Mapping[str, Field]]:
    """The keys of every way to say when the point is where, by the one that chooses it: over a time, or a law of the
    distance along the path, as of a sliding driver."""
    return {"over": OVER_FIELDS, **{key: law.fields(rotary=False) for key, law in LAWS.items() if law.prescribed}}


def path_fields() -> dict[str, Field]:
    """All keys of a path."""
    laws = {key: each for fields in path_laws().values() for key, each in fields.items()}
    return {**ROUTE_FIELDS, **{key: replace(each, required=False) for key, each in laws.items()}}


@dataclass(frozen=True)
class Path:
    """The path of a point over time: ``along`` its steps, the first a place; ``given`` the law of the distance along
    it, m, or None where the point goes ``over`` a time, s, from rest to rest between its corners, by a motion law."""

    point: LinkPoint
    along: tuple[Step, ...]
    given: Law | None = None
    smooth: bool = False
    over: float | None = None
    law: MotionLaw | str | None = None

    @cached_property
    def route(self) -> Route:
        """Its pieces."""
        from linkwright.curves.route import route

        start, *steps = self.along
        assert isinstance(start, tuple)
        pieces = [(each.about, each.turn) if isinstance(each, Turned) else each for each in steps]
        return route(start, pieces, self.smooth)

    @cached_property
    def distance(self) -> Law:
        """The law of the distance along it."""
        if self.given is not None:
            return self.given
        from linkwright.drivers.program import ProgramLaw
        from linkwright.laws.program import USUAL_LAW, MotionProgram, Segment

        assert self.over is not None
        inner = [at for at, _place in self.route.corners if at > 0.0]
        legs = np.diff([0.0, *inner, self.route.length]).tolist()
        total = self.over / self.route.length
        segments = tuple(Segment(leg * total, leg, None, self.law or USUAL_LAW) for leg in legs)
        program = MotionProgram(segments, period=sum(each.over for each in segments), closed=False)
        return ProgramLaw(program, rotary=False)

    def span(self) -> tuple[float, float]:
        """First and last time, s, at which the law says where the point is on the path."""
        law, speed = self.distance, self.distance.constant_speed
        if self.route.closed:
            return law.span()
        if speed:
            ends = sorted(float(law.time_at(each)) for each in (0.0, self.route.length))
            return ends[0], ends[1]
        duration = law.natural_duration()
        if duration is None or not math.isinf(law.span()[1]):
            return law.span()
        gained = law.at(duration) - law.at(0.0)
        return law.span() if abs(gained) <= 1e-9 * self.route.length else (0.0, duration)

    def natural_duration(self) -> float | None:
        """Time, s, after which the path is passed; None where the law does not say so."""
        speed = self.distance.constant_speed
        if speed is None:
            return self.distance.natural_duration()
        if not speed:
            return None
        return self.route.length / abs(speed) if self.route.closed else self.span()[1] or None

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        """Place of the point, its velocity and its acceleration, (n, 2) each, in m and s, at times t (n,), s.

        Raises LinkwrightError where an open path has ended.
        """
        s, rate, second = (np.asarray(each) for each in self.distance.coordinate(t))
        route = self.route
        if not route.closed:
            slack = 1e-9 * route.length
            beyond = np.flatnonzero((s < -slack) | (s > route.length + slack))
            if len(beyond):
                raise LinkwrightError(
                    _(
                        "the path of {point} is {length:.6g} m long, but at {time:g} s its law asks for "
                        "{distance:.6g} m; change the law or the cycle, or close the path",
                        code="path.beyond",
                        point=self.point,
                        length=route.length,
                        time=float(t[beyond[0]]),
                        distance=float(s[beyond[0]]),
                    )
                )
        place, way, bend = route.at(s)
        return place, rate[:, None] * way, second[:, None] * way + (rate**2)[:, None] * bend

    def breaks(self, start: float, end: float) -> Array:
        """Times, s, at which a derivative of the motion may jump: those of the law, and when pieces are passed."""
        own = self.distance.breaks(start, end)
        return np.union1d(own, self.passing(self.route.joints.tolist(), start, end, own))

    def passing(self, lengths: list[float], start: float, end: float, edges: Array | None = None) -> Array:
        """Times from ``start`` to ``end``, s, at which the point passes lengths of the path, m."""
        from linkwright.core.search import zeros

        if not lengths:
            return np.empty(0)
        inner = self.distance.breaks(start, end) if edges is None else edges
        t = np.union1d(np.linspace(start, end, 721), inner)
        s = self.distance.coordinate(t)[0]
        found: list[Array] = []
        size = self.route.length
        turns = range(math.floor(s.min() / size), math.floor(s.max() / size) + 1) if self.route.closed else (0,)
        for at in (length + turn * size for length in lengths for turn in turns):
            gap = s - at
            found.append(t[np.abs(gap) <= 1e-12 * size])
            k = np.flatnonzero(gap[:-1] * gap[1:] < 0.0)
            if len(k):
                function = self._gap(at)
                found.append(zeros(function, t[k], t[k + 1], gap[k]))
        return np.unique(np.concatenate(found))

    def _gap(self, at: float) -> Callable[[Array], tuple[Array, Array]]:
        def gap(t: Array) -> tuple[Array, Array]:
            s, rate, _second = self.distance.coordinate(t)
            return s - at, rate

        return gap

    def dimensions(self) -> dict[str, float]:
        """Names of its dimensions (``speed``, ``along.0.x``) with their SI values."""
        own = dict(self.given.dimensions()) if self.given is not None else {"over": self.over or 0.0}
        return {**own, **{f"along{end}": each for end, each in Along().flatten(self.along).items()}}

    def with_dimensions(self, value: Callable[[str], float], parameters: Mapping[str, float]) -> Path:
        """The same path with the values that ``value`` gives for the names of ``dimensions``."""
        along = Along().rebuild(self.along, lambda end: value(f"along{end}"))
        if self.given is None:
            return replace(self, along=along, over=value("over"))
        return replace(self, along=along, given=self.given.with_dimensions(value, parameters))

    def written(self) -> dict[str, Any]:
        """As plain data for a file."""
        values: dict[str, Any] = {"point": self.point, "along": self.along, "over": self.over, "law": self.law}
        values |= {"smooth": True} if self.smooth else {}
        values |= {} if self.given is None else self.given.text_values()
        fields = path_fields()
        return {key: fields[key].written(each) for key, each in values.items() if each is not None}
