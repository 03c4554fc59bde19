"""What comes near to what in a machine over its cycle: all pairs of its solids, and its end stops."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations
from math import isfinite
from typing import Any

from linkwright.collisions.cycle_pieces import Span
from linkwright.collisions.gaps import Gap, Moving, smallest_gaps
from linkwright.collisions.stops import StopReach, stop_reaches
from linkwright.core.arguments import real, require
from linkwright.core.data import Frozen
from linkwright.core.quantity import shown
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.errors import RequestError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.solids.solid import Solids
from linkwright.solids.solids_of import solids
from linkwright.words import Message, _

#: Pairs that a text shows besides those that come nearer than the clearance, and spans of one pair.
SHOWN_PAIRS, SHOWN_SPANS = 10, 3


@dataclass(frozen=True)
class SolidPair:
    """Two solids of a machine, seen along its axes: as if both were in one layer.

    ``gap``: the smallest one over the cycle, None where their contact is meant (``joined``).
    """

    first: str
    second: str
    gap: Gap | None

    @property
    def joined(self) -> bool:
        """Whether their contact is meant, so that there is no gap between them."""
        return self.gap is None

    @property
    def overlap(self) -> bool:
        """Whether they overlap, or touch, somewhere in the cycle."""
        return self.gap is not None and self.gap.size <= 0.0


@dataclass(frozen=True)
class Interference(Tabular, Frozen):
    """Gaps between the solids of a machine over its cycle, seen along its axes.

    ``pairs``: all pairs, the smallest gap first, joined ones last; ``clearance``: m, the gap that was asked for;
    ``stops``: how far the motion goes against end stops. Two solids that overlap must be in different layers.
    """

    mechanism: Mechanism = field(repr=False)
    solids: Solids = field(repr=False)
    motion: Motion = field(repr=False)
    clearance: float
    pairs: tuple[SolidPair, ...]
    stops: tuple[StopReach, ...] = ()

    @cached_property
    def near(self) -> tuple[SolidPair, ...]:
        """The pairs that overlap, or come nearer than the clearance."""
        return tuple(each for each in self.pairs if each.gap and (each.overlap or each.gap.size < self.clearance))

    def pair(self, first: str, second: str) -> SolidPair:
        """The pair of two solids by their names, in any order; raises RequestError where there is none."""
        found = self._by_names.get(frozenset((first, second)))
        if found is None:
            raise RequestError(
                _(
                    'there is no pair of "{first}" and "{second}"; the solids are {names}',
                    code="interference.no_pair",
                    first=first,
                    second=second,
                    names=tuple(self.solids.by_name),
                )
            )
        return found

    @cached_property
    def _by_names(self) -> dict[frozenset[str], SolidPair]:
        return {frozenset((each.first, each.second)): each for each in self.pairs}

    @property
    def exact(self) -> bool:
        """Whether gaps hold between the solved positions; if not, in these alone."""
        return all(each.gap.exact for each in self.pairs if each.gap)

    @property
    def notes(self) -> tuple[Message | str, ...]:
        """What is found, in sentences, and what was taken by rule."""
        return (*self._found(), *self.solids.notes)

    def _found(self) -> Iterator[Message]:
        overlapping = sum(each.overlap for each in self.pairs)
        if overlapping:
            yield _(
                "{count} of {all} pairs overlap when seen along the axes: these need different layers; `linkwright "
                "layers` finds them",
                count=overlapping,
                all=sum(not each.joined for each in self.pairs),
            )
        else:
            yield _("nothing overlaps when seen along the axes: everything can lie in one layer")
        if not self.exact:
            yield _("the gaps are those of the solved positions alone, as nothing is known between them")
        if not self.motion.ok.all():
            yield _("only a part of the cycle is reached; the gaps are those of that part")

    def tables(self, language: str = "en", *args: Any, every: bool = False, **options: Any) -> Sequence[Table]:
        """The pairs, and the stops; unless ``every`` pair is asked for, those nearer than the clearance and the next
        ones."""
        gaps = [each for each in self.pairs if not each.joined]
        taken = list(self.pairs) if every else gaps[: len(self.near) + SHOWN_PAIRS]
        head = [_("pair of solids"), _("smallest gap"), _("at input"), "x", "y", _("nearer than the clearance")]
        if self.clearance <= 0.0:
            head[-1] = _("overlap")
        notes: list[str] = []
        if len(taken) < len(gaps):
            notes.append(_("{count} more pairs have larger gaps", count=len(gaps) - len(taken)))
        table = Table(head, [self._row(each, language) for each in taken], "<>>>><", self.mechanism.name, notes)
        found = [table, *([self._stops(language)] if self.stops else [])]
        return (*found, Table(notes=self.notes))

    def _row(self, pair: SolidPair, language: str) -> list[Cell]:
        names, gap = f"{pair.first} – {pair.second}", pair.gap
        if gap is None:
            return [names, _("joined"), None, None, None, None]
        return [
            names,
            _("overlap") if pair.overlap else Amount(gap.size, "length", 4),
            Amount(gap.input, self.mechanism.across, 5) if isfinite(gap.input) else Amount(gap.time, "time", 5),
            *gap.cells(self.mechanism.size),
            self._spans_text(gap.spans, language),
        ]

    def _spans_text(self, spans: Sequence[Span], language: str) -> str:
        """Spans as intervals of the input; over the end of a closed cycle as one."""
        duration = float(self.motion.positions.around[-1] - self.motion.positions.around[0])
        if len(spans) == 1 and abs(spans[0][1] - spans[0][0] - abs(duration)) <= 1e-9 * abs(duration):
            return _("always").translate(language)
        inputs = [self._inputs(each) for each in self._joined(spans)]
        dimension = self.mechanism.across if self.motion.inputs else "time"
        texts = [
            _("{begin} to {end}", begin=shown(begin, dimension, 5), end=shown(end, dimension, 5)).translate(language)
            for begin, end in inputs[:SHOWN_SPANS]
        ]
        return ", ".join([*texts, *(["…"] if len(inputs) > SHOWN_SPANS else [])])

    def _joined(self, spans: Sequence[Span]) -> list[Span]:
        """Spans, of which the last one goes on with the first one over the end of a closed cycle."""
        period, found = self.motion.positions.period, [*spans]
        if period is None or not self.motion.positions.closed or len(found) < 2:
            return found
        start, slack = float(self.motion.time[0]), 1e-9 * period
        if found[0][0] - start > slack or start + period - found[-1][1] > slack:
            return found
        return [*found[1:-1], (found[-1][0], found[0][1])]

    def _inputs(self, span: Span) -> Span:
        """The first driver's coordinate at both ends of a span, or the times without a driver."""
        driver = next(iter(self.mechanism.drivers.values()), None)
        if driver is None:
            return span
        return driver.law.at(span[0]), driver.law.at(span[1])

    def _stops(self, language: str) -> Table:
        head = (
            _("end stop"),
            _("output"),
            _("side"),
            _("stops at"),
            _("goes to"),
            _("at input"),
            _("beyond the stop"),
        )
        sides = {"below": _("not below"), "above": _("not above")}
        rows: list[list[Cell]] = [
            [
                each.stop.name,
                str(each.stop.of),
                sides[each.stop.side],
                Amount(each.stop.at, each.stop.of.dimension, 5),
                Amount(each.value, each.stop.of.dimension, 5),
                Amount(each.input, self.mechanism.across, 5),
                self._spans_text(each.spans, language) if each.spans else _("not passed"),
            ]
            for each in self.stops
        ]
        passed = [each.stop.name for each in self.stops if each.spans]
        notes = [
            _(
                "{names}: the prescribed motion goes beyond the stop; a machine would be held there",
                names=tuple(passed),
            )
        ]
        return Table(head, rows, "<<<>>><", _("End stops"), notes if passed else [])

    def data(self) -> Mapping[str, Any]:
        """Everything as plain data, SI."""
        return {
            "name": self.mechanism.name,
            "clearance": self.clearance,
            "exact": self.exact,
            "pairs": [_pair_data(each) for each in self.pairs],
            "stops": [
                {
                    "name": each.stop.name,
                    "of": str(each.stop.of),
                    "at": each.stop.at,
                    "side": each.stop.side,
                    "reached": each.value,
                    "beyond": each.beyond,
                    "time": each.time,
                    "input": each.input,
                    "spans": [list(span) for span in each.spans],
                }
                for each in self.stops
            ],
            "notes": [str(note) for note in self.notes],
        }

    def columns(self) -> dict[str, list[Any]]:
        """The pairs by name with unit, SI; nothing where contact is meant."""
        unit = "rad" if self.mechanism.across == "angle" else "m"
        gaps = [each.gap for each in self.pairs]

        def column(read: Any) -> list[Any]:
            return [None if gap is None else read(gap) for gap in gaps]

        return {
            "first": [each.first for each in self.pairs],
            "second": [each.second for each in self.pairs],
            "joined": [each.joined for each in self.pairs],
            "gap [m]": column(lambda gap: gap.size),
            "time [s]": column(lambda gap: gap.time),
            f"input [{unit}]": column(lambda gap: gap.input),
            "x [m]": column(lambda gap: gap.place.real),
            "y [m]": column(lambda gap: gap.place.imag),
        }


def _pair_data(pair: SolidPair) -> dict[str, Any]:
    found: dict[str, Any] = {"first": pair.first, "second": pair.second, "joined": pair.joined}
    gap = pair.gap
    if gap is None:
        return found
    return found | {
        "overlap": pair.overlap,
        "gap": gap.size,
        "time": gap.time,
        "input": gap.input,
        "place": [gap.place.real, gap.place.imag],
        "spans": [list(span) for span in gap.spans],
    }


def interference(mechanism: Mechanism, *, clearance: float | None = None) -> Interference:
    """The smallest gaps between all that takes room in a machine, over its whole cycle, exact between positions.

    Everything is seen along the axes, as if it were in one layer: links, pins, blocks, guides, wheels, cams and the
    frame, with the shapes of the section ``construction`` or by rule (see ``solids``).

    Args:
        mechanism: what to look at.
        clearance: gap, m, that pairs are compared with; by default that of the construction, else 0: of overlaps.

    Returns:
        The pairs with the smallest gap first: gaps to 1e-9 of the machine's size, where in the cycle and at which
        place they are smallest, and when they are below the clearance.

    Raises:
        LinkwrightError: a shape cannot be made, or no position is reached.

    >>> import linkwright as lw
    >>> found = lw.interference(lw.load("gallery:crank_rocker"))
    >>> found.pair("crank", "rocker").overlap
    False
    """
    require(mechanism, Mechanism)
    own = mechanism.construction.clearance if mechanism.construction is not None else None
    asked = (own or 0.0) if clearance is None else real("clearance", clearance)
    found, motion = solids(mechanism), solve_motion(mechanism, failures="mark")
    if not motion.ok.any():
        raise motion.refusal()
    moving = {name: Moving(each.carrier, each.shape) for name, each in found.by_name.items() if each.shape.pieces}
    names = [*combinations(moving, 2)]
    free = [each for each in names if (min(each), max(each)) not in found.joined]
    asked_pairs = [(moving[first], moving[second]) for first, second in free]
    gaps = dict(zip(free, smallest_gaps(motion, asked_pairs, clearance=asked, spans=True), strict=True))
    pairs = [SolidPair(*each, gaps.get(each)) for each in names]
    pairs.sort(key=lambda each: float("inf") if each.gap is None else each.gap.size)
    return Interference(mechanism, found, motion, asked, tuple(pairs), tuple(stop_reaches(motion)))
