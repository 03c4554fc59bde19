"""Motion programs: what a follower or a driver does over a turn or a time, piece by piece."""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.curves.curve import Curve, Extreme
from linkwright.errors import Finding, ModelError, fault
from linkwright.laws.base import MOTION_LAWS, Ends, MotionLaw
from linkwright.words import _

#: The law of a rise that names none: it meets whatever its neighbours ask for.
USUAL_LAW = "polynomial_5"
#: Share of the largest value within which the sides of a junction are the same.
_SAME = 1e-7
#: Distance from an end at which a derivative has the value of its side.
_EDGE = 1e-13
TURN = 2 * math.pi


class Program(ABC):
    """Lift over x, the cam's angle (rad) or a time (s), repeated after ``period``.

    ``edges`` (k + 1,): where pieces meet, from 0 to the period; ``breaks``: all places where a derivative may jump.
    """

    period: float

    @property
    @abstractmethod
    def edges(self) -> Floats: ...

    @property
    @abstractmethod
    def breaks(self) -> Floats: ...

    @abstractmethod
    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        """Lift and its first three derivatives at x (n,), m or rad over powers of rad or s; exact."""

    def extreme(self, order: int, kind: str) -> Extreme:
        """The largest (``max``) or smallest (``min``) value of a derivative, with its place."""
        return self._curve(order).extreme(kind)

    def extremes(self, order: int) -> tuple[Extreme, Extreme]:
        """The smallest and the largest value of a derivative, with their places."""
        return self._curve(order).extremes()

    def _curve(self, order: int) -> Curve:
        inner = self.breaks[(self.breaks > 0) & (self.breaks < self.period)]
        return Curve.of(lambda x: self.curves(x)[order], 0.0, self.period, pieces=12, knots=inner)

    @cached_property
    def lifts(self) -> tuple[float, float]:
        """Smallest and largest lift."""
        low, high = self.extremes(0)
        return low.value, high.value

    @cached_property
    def fastest(self) -> float:
        """Largest size of the velocity."""
        low, high = self.extremes(1)
        return max(high.value, -low.value)

    def places(self, count: int) -> Floats:
        """About so many places over the period, all edges among them, the last one left out."""
        edges = self.edges
        parts = []
        for low, high in itertools.pairwise(edges):
            number = max(2, math.ceil(count * (high - low) / self.period))
            parts.append(np.linspace(low, high, number, endpoint=False))
        return np.concatenate(parts)


@dataclass(frozen=True)
class Segment:
    """A piece of a program: ``over`` an angle (rad) or time (s), ``rise`` up (down: negative), or ``to`` a lift.

    Neither rise nor law: a dwell. ``law``: a name or a law; ``velocity`` and ``acceleration`` at its end, lift per
    rad or s, where the law and the next one can meet them.
    """

    over: float
    rise: float | None = None
    to: float | None = None
    law: MotionLaw | str | None = None
    velocity: float | None = None
    acceleration: float | None = None

    @property
    def dwells(self) -> bool:
        """Whether nothing moves."""
        return not self.rise and self.to is None and self.law is None


@dataclass(frozen=True)
class _Piece:
    """A segment with its law: lift = first + scale s(u)."""

    first: float
    scale: float
    rise: float
    law: MotionLaw | None

    def curves(self, u: Any, width: float) -> tuple[Any, Any, Any, Any]:
        if self.law is None:
            none = 0.0 * u
            return none + self.first, none, none, none
        s, v, a, j = self.law.curves(u)
        k = self.scale
        return self.first + k * s, k / width * v, k / width**2 * a, k / width**3 * j


@dataclass(frozen=True)
class Junction:
    """Where two pieces meet: its place, and lift, velocity, acceleration, jerk on either side."""

    place: float
    before: tuple[float, float, float, float]
    after: tuple[float, float, float, float]
    jumps: tuple[bool, bool, bool, bool]


@dataclass(frozen=True)
class MotionProgram(Program):
    """Segments one after the other, beginning at ``start`` (m or rad); ``period`` by default one turn.

    ``closed``: it comes back to its beginning and goes on there, so position and velocity meet there as well. Laws
    that meet any ends take over what their neighbours do; where two such laws meet, velocity and acceleration are
    those set at the junction, else zero. Raises ModelError with all findings.
    """

    segments: tuple[Segment, ...]
    start: float = 0.0
    period: float = TURN
    closed: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "segments", tuple(self.segments))
        found = self.findings()
        if found:
            raise ModelError(found)

    def findings(self) -> list[Finding]:
        """Everything that is wrong, keys ``program.0.over``."""
        found = self._faulty_segments()
        if found:
            return found
        try:
            _unused = self._pieces
        except ModelError as error:
            return list(error.findings)
        return [*self._open_ends(), *self._jumps()]

    def _faulty_segments(self) -> list[Finding]:
        if not self.segments:
            return [
                fault(
                    "program_empty",
                    "program",
                    _("the program is empty"),
                    _("write segments such as {{rise: 10 mm, over: 90 deg, law: cycloidal}} and {{dwell: 90 deg}}"),
                )
            ]
        found = [
            fault(
                "segment_over",
                f"program.{k}.over",
                _("a segment over {over}"),
                _("give every segment an angle or a time above zero"),
                over=each.over,
            )
            for k, each in enumerate(self.segments)
            if not each.over > 0 or not math.isfinite(each.over)
        ]
        total = sum(each.over for each in self.segments)
        if not found and abs(total - self.period) > 1e-9 * self.period:
            turn = self.period == TURN
            unit, factor = ("°", 180 / math.pi) if turn else (" s", 1.0)
            values = {"total": f"{factor * total:.7g}{unit}", "period": f"{factor * self.period:.7g}{unit}"}
            missing = f"{factor * abs(self.period - total):.7g}{unit}"
            if total < self.period:
                found.append(
                    fault(
                        "program_short",
                        "program",
                        _("the program does not close: it covers {total} of {period}"),
                        _("add {missing}, such as a dwell"),
                        **values,
                        missing=missing,
                    )
                )
            else:
                found.append(
                    fault(
                        "program_long",
                        "program",
                        _("the program does not close: it covers {total}, more than {period}"),
                        _("take away {missing}"),
                        **values,
                        missing=missing,
                    )
                )
        return found

    def _open_ends(self) -> list[Finding]:
        last = self.lift_at_edges[-1]
        if not self.closed or abs(last - self.start) <= _SAME * self._size:
            return []
        return [
            fault(
                "lift_open",
                f"program.{len(self.segments) - 1}",
                _("the program does not close: it begins at a lift of {first} and ends at {last} (SI units)"),
                _("let the falls be as high as the rises, or end with to: {first}"),
                first=self.start,
                last=last,
            )
        ]

    def _jumps(self) -> list[Finding]:
        found = []
        for number, junction in enumerate(self.junctions):
            if junction.jumps[1]:
                k = (number - 1) % len(self.segments)
                found.append(
                    fault(
                        "velocity_jump",
                        f"program.{k}",
                        _(
                            "the velocity jumps at {place} from {before} to {after} (lift per rad or s, SI "
                            "units): the acceleration would be infinite"
                        ),
                        _(
                            "take a law that ends and begins with the same velocity, such as polynomial_5, or "
                            "give the velocity at the junction"
                        ),
                        place=self.place_text(junction.place),
                        before=junction.before[1] + 0.0,
                        after=junction.after[1] + 0.0,
                    )
                )
        return found

    def place_text(self, place: float) -> str:
        """A place in words: ``90°`` or ``0.2 s``."""
        return shown(place, "angle" if self.period == TURN else "time")

    @property
    def _size(self) -> float:
        """Range of the lift."""
        lifts = self.lift_at_edges
        return max(max(lifts) - min(lifts), 1e-9)

    @cached_property
    def lift_at_edges(self) -> tuple[float, ...]:
        """Lift at every edge."""
        lifts = [self.start]
        for each in self.segments:
            lifts.append(each.to if each.to is not None else lifts[-1] + (each.rise or 0.0))
        return tuple(lifts)

    @cached_property
    def edges(self) -> Floats:
        found = np.cumsum([0.0, *(each.over for each in self.segments)])
        found[-1] = self.period
        return np.asarray(found)

    @cached_property
    def breaks(self) -> Floats:
        places = [self.edges]
        for low, width, piece in zip(self.edges, np.diff(self.edges), self._pieces, strict=False):
            if piece.law is not None:
                places.append(low + width * np.array(piece.law.breaks))
        return np.unique(np.concatenate(places))

    @cached_property
    def _pieces(self) -> tuple[_Piece, ...]:
        """The segments with their laws. Raises ModelError where a law cannot be."""
        own = [self._own_piece(k) for k in range(len(self.segments))]
        ends = self._junction_ends(own)
        return tuple(piece or self._meeting(k, ends[k], ends[k + 1]) for k, piece in enumerate(own))

    def _rise(self, k: int) -> float:
        return self.lift_at_edges[k + 1] - self.lift_at_edges[k]

    def _own_piece(self, k: int) -> _Piece | None:
        """A dwell or a law with ends of its own; None for a law that meets its neighbours."""
        segment, first, rise = self.segments[k], self.lift_at_edges[k], self._rise(k)
        if segment.dwells:
            return _Piece(first, 0.0, 0.0, None)
        law = segment.law or USUAL_LAW
        if isinstance(law, str):
            from linkwright.laws.fitting import motion_law

            kind = MOTION_LAWS.get(law)
            if kind is not None and kind.meeting(Ends(), 1.0) is not None:
                return None
            law = motion_law(law)
        return _Piece(first, rise, rise, law)

    def _junction_ends(self, own: Sequence[_Piece | None]) -> list[tuple[float, float]]:
        """Velocity and acceleration at every edge: set ones, or those of a neighbour with ends of its own, or
        zero."""
        count = len(self.segments)
        found = []
        for edge in range(count + 1):
            before = edge - 1 if edge else (count - 1 if self.closed else None)
            after = edge if edge < count else (0 if self.closed else None)
            value: list[float | None] = [None, None]
            if before is not None:
                value = [self.segments[before].velocity, self.segments[before].acceleration]
            for k, side in ((before, 1.0), (after, 0.0)):
                piece = own[k] if k is not None else None
                if k is not None and piece is not None:
                    at = _at(piece, side, self.segments[k].over)
                    value = [at[i + 1] if each is None else each for i, each in enumerate(value)]
            found.append((value[0] or 0.0, value[1] or 0.0))
        return found

    def _meeting(self, k: int, start: tuple[float, float], end: tuple[float, float]) -> _Piece:
        segment, rise = self.segments[k], self._rise(k)
        name = segment.law if isinstance(segment.law, str) else USUAL_LAW
        width = segment.over
        scale = rise if abs(rise) > _SAME * self._size else 1.0
        ends = Ends(
            (start[0] * width / scale, end[0] * width / scale),
            (start[1] * width**2 / scale, end[1] * width**2 / scale),
        )
        law = MOTION_LAWS[name].meeting(ends, rise / scale)
        return _Piece(self.lift_at_edges[k], scale, rise, law)

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        x = np.asarray(x)
        turn = np.floor(x.real / self.period)
        x = x - turn * self.period
        number = np.clip(np.searchsorted(self.edges, x.real, side="right") - 1, 0, len(self.segments) - 1)
        found = np.zeros((4, *x.shape), dtype=x.dtype if np.iscomplexobj(x) else float)
        for k, piece in enumerate(self._pieces):
            here = number == k
            if here.any():
                width = self.segments[k].over
                u = (x[here] - self.edges[k]) / width
                found[:, here] = np.array(piece.curves(u, width))
        found[0] += turn * (self.lift_at_edges[-1] - self.start)
        return found[0], found[1], found[2], found[3]

    @cached_property
    def junctions(self) -> tuple[Junction, ...]:
        """All edges but the last; the first one joins end and beginning where the program is closed."""
        pieces, count = self._pieces, len(self.segments)
        sizes = self._sizes
        found = []
        for k in range(0 if self.closed else 1, count):
            b, a = (k - 1) % count, k
            before = _at(pieces[b], 1.0, self.segments[b].over)
            after = _at(pieces[a], 0.0, self.segments[a].over)
            jumps = [abs(p - q) > _SAME * size for p, q, size in zip(before, after, sizes, strict=True)]
            found.append(Junction(float(self.edges[k]), before, after, (jumps[0], jumps[1], jumps[2], jumps[3])))
        return tuple(found)

    @cached_property
    def _sizes(self) -> tuple[float, float, float, float]:
        """What counts as large for the lift and its derivatives: range over powers of the shortest moving piece."""
        moving = [each.over for each, piece in zip(self.segments, self._pieces, strict=True) if piece.law]
        shortest = min(moving, default=self.period)
        size = self._size
        return size, size / self.period, size / self.period**2, size / shortest**3

    @property
    def moved_by(self) -> tuple[tuple[MotionLaw | None, float], ...]:
        """Law of every segment (None for a dwell) and what it is multiplied by, m or rad."""
        return tuple((each.law, each.scale) for each in self._pieces)

    @property
    def law_names(self) -> tuple[str, ...]:
        """Name of every segment's law; ``dwell`` for a dwell."""
        return tuple("dwell" if each.law is None else each.law.key for each in self._pieces)

    @property
    def smoothness(self) -> int:
        """Highest derivative that is continuous (3: the jerk too), at junctions and within the laws."""
        for order in range(4):
            if self.places_of_jumps(order):
                return order - 1
        return 3

    def places_of_jumps(self, order: int) -> tuple[float, ...]:
        """Where a derivative jumps: at junctions, and within the laws of segments; rad or s."""
        found = [each.place for each in self.junctions if each.jumps[order]]
        for low, width, piece in zip(self.edges, np.diff(self.edges), self._pieces, strict=False):
            inner = np.array(piece.law.breaks if piece.law is not None else ())
            if len(inner):
                before, after = (piece.curves(inner + side, width)[order] for side in (-_EDGE, _EDGE))
                jump = np.abs(np.asarray(after) - before) > _SAME * self._sizes[order]
                found += (low + width * inner[jump]).tolist()
        return tuple(sorted(found))


def _at(piece: _Piece, u: float, width: float) -> tuple[float, float, float, float]:
    """Lift, velocity at an end of a piece; acceleration and jerk on its inner side."""
    inner = u + _EDGE if u == 0.0 else u - _EDGE
    s, v, a, j = (each.tolist() for each in piece.curves(np.array([u, inner]), width))
    return s[0], v[0], a[1], j[1]
