"""Summaries of outputs over the cycle: means, extremes of all sides, where these are; and reductions of sweeps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats, Indices, Integers
from linkwright.core.outputs import Output
from linkwright.curves.pieces import LOW, Pieces, Wanted
from linkwright.curves.polynomials import NODES, Peak, best_of, climbed, largest
from linkwright.errors import RequestError
from linkwright.events.course import Span
from linkwright.events.events import Limits
from linkwright.formula.reductions import Reduction
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.words import _

#: Sides of a signal on which its summaries lie.
SIDES: Mapping[str, tuple[float, ...]] = {
    "max": (1.0,),
    "min": (-1.0,),
    "peak": (1.0, -1.0),
    "range": (1.0, -1.0),
    "argmax": (1.0,),
    "argmin": (-1.0,),
}
EVEN = ("mean", "rms", "excess")
#: Kinds that limit positions give of an output that has some.
OF_LIMITS = ("max", "min", "range", "argmax", "argmin")
#: A side of a signal: its number, sign, and the output on whose rising or falling strokes it is asked for.
Side = tuple[int, float, tuple[Output, str] | None]


class Signal(NamedTuple):
    """An output in the user's words, or its square."""

    words: str
    squared: bool = False

    def __str__(self) -> str:
        return f"{self.words}²" if self.squared else self.words


class Asked:
    """The summaries ``parts`` that are asked for, by their texts: of ``words``, signals, or of limit positions of
    ``limited`` outputs.

    ``on_strokes``: the outputs on whose rising or falling strokes they are sought; ``more``: signals that are met
    everywhere; ``number`` of every signal, those that are ``even``, all ``sides``, and ``sides_of`` a text.
    """

    def __init__(
        self,
        parts: Mapping[str, Summary],
        words: Mapping[str, Signal],
        limited: Mapping[str, Output],
        on_strokes: Mapping[str, tuple[Output, str]],
        more: Iterable[Signal] = (),
    ) -> None:
        self.parts, self.words, self.limited, self.on_strokes = parts, words, limited, on_strokes
        self.even_words = tuple(more)
        self.number = {each: k for k, each in enumerate(dict.fromkeys([*words.values(), *self.even_words]))}
        even = [each for text, each in words.items() if parts[text].kind in EVEN]
        self.even = tuple(dict.fromkeys(self.number[each] for each in (*even, *self.even_words)))
        numbers: dict[Side, int] = {}
        self.sides_of: dict[str, tuple[int, ...]] = {}
        for text, own in words.items():
            kind = parts[text].kind
            signs = (1.0,) if own.squared and kind == "peak" else SIDES.get(kind, ())
            sides = [(self.number[own], sign, on_strokes.get(text)) for sign in signs]
            self.sides_of[text] = tuple(numbers.setdefault(side, len(numbers)) for side in sides)
        self.sides = tuple(numbers)

    def wanted(self, same_dimension: Sequence[Indices] = (), *, joined: bool = False) -> Wanted:
        """What pieces must be met for."""
        sides = tuple((k, sign) for k, sign, _ in self.sides)
        return Wanted(self.even, sides, same_dimension=same_dimension, joined=joined)


@dataclass(frozen=True)
class Extremes:
    """Extremes of signals on their sides: the ``piece``, the ``place`` in it (-1 to 1), the ``value`` of the output,
    the ``time``, s, (sides, designs) each."""

    piece: Indices
    place: Floats
    value: Floats
    time: Floats


class Summaries(ABC):
    """What is ``asked`` of signals on the ``pieces`` of some designs, with the ``limits`` of outputs."""

    asked: Asked
    span: Span
    limits: dict[Output, Limits]

    @property
    @abstractmethod
    def pieces(self) -> Pieces:
        """The signals on pieces."""

    @property
    @abstractmethod
    def passed(self) -> Flags:
        """Designs that pass the full cycle, (designs,)."""

    @property
    @abstractmethod
    def speed(self) -> Floats:
        """Rate of the first driver where the cycle begins, (designs,) rad/s or m/s."""

    @abstractmethod
    def inside(self, time: Floats, design: Indices | slice = slice(None)) -> Floats:
        """Times, s, in the cycle that begins where the course does, of what lies in pieces of some designs."""

    @abstractmethod
    def input_at(self, time: Floats) -> Floats:
        """The first driver's coordinate at times, (designs,) rad or m."""

    @property
    def begins(self) -> Floats:
        """When the cycles begin, (designs,) s."""
        return np.full(self.span.count, self.span.begin)

    @cached_property
    def means(self) -> dict[int, Floats]:
        """Means over the time of signals that are met everywhere, (designs,)."""
        even = [*self.asked.even]
        return dict(zip(even, self.pieces.mean(even), strict=True))

    @cached_property
    def extremes(self) -> Extremes:
        """The extremes of all sides."""
        sides, pieces = self.asked.sides, self.pieces
        strokes = {stroke: self._on_stroke(*stroke) for stroke in {stroke for *_, stroke in sides} if stroke}
        rows, side, piece = pieces.contenders(
            [(k, sign) for k, sign, _ in sides], [stroke and strokes[stroke] for *_, stroke in sides]
        )
        place, value = climbed(rows)
        signals = np.array([k for k, *_ in sides], dtype=np.intp)
        signs = np.array([sign for _, sign, _ in sides])
        design, signal = pieces.design[piece], signals[side]
        jumps = pieces.unresolved(signal, piece)
        if jumps.any():
            node = rows[:, jumps].argmax(axis=0)
            place[jumps], value[jumps] = 2.0 * NODES[node] - 1.0, rows[:, jumps].max(axis=0)
        same_dimension = EQUAL * pieces.size[signal, design]
        place = np.where((pieces.top - pieces.bottom)[signal, piece] <= same_dimension, -1.0, place)
        time = pieces.columns[LOW][piece] + 0.5 * (1.0 + place) * pieces.width[piece]
        time = self.inside(time, design)
        best = best_of(value, side * self.span.count + design, same_dimension, time)
        shape = len(sides), -1
        piece, place = piece[best].reshape(shape), place[best].reshape(shape)
        value, time = value[best].reshape(shape), time[best].reshape(shape)
        squared = np.array([each.squared for each in self.asked.number])[signals][:, None]
        value = np.where(squared, np.sqrt(np.maximum(value, 0.0)), value * signs[:, None])
        constant = pieces.most(pieces.top) + pieces.most(-pieces.bottom) <= EQUAL * pieces.size
        free = np.array([stroke is None for *_, stroke in sides])[:, None]
        return Extremes(piece, place, value, np.where(constant[signals] & free, self.begins, time))

    def _on_stroke(self, output: Output, way: str) -> Flags:
        """The pieces in which an output rises, or falls."""
        pieces = self.pieces
        middle = pieces.columns[LOW] + 0.5 * pieces.width
        rising = self.limits[output].rising_at(pieces.design, middle)
        return np.asarray(pieces.each(self.limits[output].complete) & (rising == (way == "rising")))

    @cached_property
    def values(self) -> dict[str, Floats]:
        """All parts, (designs,) each; NaN of designs that do not pass."""
        with np.errstate(invalid="ignore"):
            found = {text: self._value(text, part) for text, part in self.asked.parts.items()}
        return {text: np.where(self.passed, each, np.nan) for text, each in found.items()}

    def _value(self, text: str, part: Summary) -> Floats:
        kind = part.kind
        if kind.startswith("arg"):
            return self.input_at(self.time_of(text))
        if text in self.asked.limited:
            limits = self.limits.get(self.asked.limited[text])
            if limits is None:
                return np.full(self.span.count, np.nan)
            return limits.at("max") - limits.at("min") if kind == "range" else limits.at(kind)
        signal = self.asked.words[text]
        k = self.asked.number[signal]
        if kind == "mean":
            return self.means[k]
        if kind == "rms":
            return np.sqrt(self.means[k] if signal.squared else self.pieces.mean_square(k))
        if kind == "excess":
            high, low = self.excess(k)
            gained, rounding = high[2] - low[2], EQUAL * self.pieces.size[k] * self.pieces.period
            return np.where(gained > rounding, gained, 0.0) * np.abs(self.speed)
        sides: list[Floats] = [self.extremes.value[side] for side in self.asked.sides_of[text]]
        if kind == "range":
            return np.asarray(sides[0] - sides[1])
        if kind != "peak":
            return sides[0]
        sizes = np.abs(sides)
        return np.where(np.isinf(sizes).any(axis=0), np.inf, sizes.max(axis=0))

    def time_of(self, text: str) -> Floats:
        """When a part is there, (designs,) s; NaN of what belongs to no time."""
        kind = self.asked.parts[text].kind
        sides, output = self.asked.sides_of.get(text, ()), self.asked.limited.get(text)
        limits = None if output is None else self.limits.get(output)
        if kind == "range" or (limits is None and not sides):
            return np.full(self.span.count, np.nan)
        if limits is not None:
            return limits.time(kind.removeprefix("arg"))
        times, values = self.extremes.time[[*sides]], self.extremes.value[[*sides]]
        sizes = np.where(np.isnan(values), -1.0, np.abs(values))
        if len(sides) < 2:
            return np.asarray(times[0])
        same_dimension = sizes.min(axis=0) >= (1.0 - EQUAL) * sizes.max(axis=0)
        first = np.where(same_dimension, times[0] <= times[1], sizes[0] > sizes[1])
        return np.asarray(np.where(first, times[0], times[1]))

    def excess(self, k: int) -> list[Peak]:
        """The largest and the smallest integral over the time of a signal's lack of its mean."""
        if k not in self._excess:
            lack, design = self.pieces.excess(k, self.means[k]), self.pieces.design
            both, count = np.append(design, design + self.span.count), self.span.count
            piece, place, value = largest(np.append(lack, -lack, axis=1), both)
            high, low = slice(count), slice(count, None)
            self._excess[k] = [
                (piece[high], place[high], value[high]),
                (piece[low] - len(design), place[low], -value[low]),
            ]
        return self._excess[k]

    @cached_property
    def _excess(self) -> dict[int, list[Peak]]:
        return {}


#: Kinds of summaries, and the reductions they need.
KINDS: Mapping[str, tuple[str, ...]] = {
    "min": ("min",),
    "max": ("max",),
    "mean": ("mean",),
    "rms": ("rms",),
    "range": ("min", "max"),
    "peak": ("min", "max"),
    "argmin": ("argmin",),
    "argmax": ("argmax",),
}
#: Which way an output goes, by the limits with which its strokes begin.
STROKES = {"max": "falling", "min": "rising"}
_GROWING = frozenset({"min", "max", "range", "peak", "argmin", "argmax"})


@dataclass(frozen=True)
class Summary:
    """One summary of one output over the cycle; without a ``kind`` a registered metric.

    ``kind``: ``min``, ``max``, ``mean``, ``rms``; ``range`` = max - min (swing, stroke); ``peak`` = largest
    absolute value; ``argmin``, ``argmax``: the first driver's coordinate (rad or m) of the extreme. ``of_cycle``:
    whether pieces of the cycle give it.
    """

    of_cycle: ClassVar[bool] = True
    output: str
    kind: str

    @classmethod
    def of(cls, text: str) -> Summary:
        """The summary that a text ``output kind`` means."""
        output, _unused, kind = text.rpartition(" ")
        return cls(output, kind)

    @property
    def name(self) -> str:
        """Its name in tables."""
        return f"{self.output} {self.kind}".rstrip()


@dataclass(frozen=True)
class StrokeSummary(Summary):
    """A summary while another output, ``by``, goes one ``way``: ``falling`` or ``rising``."""

    by: str
    way: str

    @property
    def name(self) -> str:
        """Its name among others: ``transmission_angle B min on jaw.angle falling``."""
        return f"{self.output} {self.kind} on {self.by} {self.way}"


@dataclass(frozen=True)
class SummaryValue:
    """The value of a summary of one machine; ``time`` s and ``input`` rad or m are NaN where it belongs to no place.

    ``exact``: found between the solved positions to the machine's resolution of a flat extreme, else a sample.
    """

    value: float
    time: float
    input: float
    exact: bool


def reductions(summaries: Iterable[Summary], quantities: Mapping[str, Quantity]) -> list[Reduction]:
    """The reductions of a sweep; raises LinkwrightError for a mean of what is known by its tangent only."""
    found: dict[Reduction, None] = {}
    for summary in summaries:
        if quantities[summary.output].reference is not None and summary.kind not in _GROWING:
            raise RequestError(
                _(
                    "{name!r}: an angle has {kinds} in a study; take one of these, or the mean or rms of its rate",
                    code="study.angle_summary",
                    name=summary.name,
                    kinds=tuple(sorted(_GROWING)),
                )
            )
        for kind in KINDS[summary.kind]:
            found[Reduction(summary.output, kind)] = None  # type: ignore[arg-type]
    return list(found)


def finished(
    summary: Summary, quantity: Quantity, results: Mapping[str, Floats | Integers], input_: Floats
) -> Floats:
    """The summary (designs,) from its reductions; NaN where no position counts."""
    if summary.kind in ("argmin", "argmax"):
        place = np.asarray(results[f"{summary.output}.{summary.kind}"], dtype=np.int64)
        return np.where(place >= 0, input_[np.maximum(place, 0)], np.nan)
    parts = [quantity.shown(np.asarray(results[f"{summary.output}.{k}"], dtype=float)) for k in KINDS[summary.kind]]
    if summary.kind == "range":
        return np.asarray(parts[1] - parts[0])
    if summary.kind == "peak":
        return np.maximum(np.abs(parts[0]), np.abs(parts[1]))
    return np.array(parts[0])
