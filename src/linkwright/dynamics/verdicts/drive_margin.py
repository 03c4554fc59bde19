"""Whether a machine starts and runs with its drive, and with what margin, position by position."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import ClassVar, Literal

import numpy as np

from linkwright.core.arguments import STEPS, integer, require
from linkwright.core.arrays import Flags, Floats, largest, runs
from linkwright.core.attached import PlotMixin
from linkwright.core.quantity import INFINITE, shown
from linkwright.core.search import edge, lowest
from linkwright.core.table import PERCENT, Block, Numbers, Row
from linkwright.dynamics.verdicts.drive import Drive, Torques, mean_over
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import si_unit
from linkwright.words import Message, Translate, _
from linkwright.words.message import together

Kind = Literal["jam", "dead_point", "stall"]
#: Parts of the way between two positions among which the end of a stretch is looked for, and the share of it that
#: it is found to.
_PARTS, _NARROW = 32, 32.0**-5
#: Share of the largest available torque that is none.
_NO_TORQUE = 1e-9
#: Square of the sine of a transmission angle below which a position counts as a dead point: 2.6°.
_DEAD = 2e-3
#: An efficiency this near 1 is that of a machine without friction.
_ROUNDING = 1e-12

LABELS: Mapping[str, Message] = {
    "needed_starting": _("largest torque needed to start"),
    "available_starting": _("  torque that the drive has there"),
    "starting_margin": _("least margin of starting: available over needed"),
    "missing": _("  missing there"),
    "spare": _("  to spare there"),
    "efficiency": _("smallest efficiency of a position, by friction in joints"),
    "mean_needed": _("mean torque needed at speed"),
    "largest_needed": _("largest torque needed at speed"),
    "mean_available": _("mean torque that the drive has at speed"),
    "running_margin": _("margin of running: mean available over mean needed"),
    "holding": _("share of the positions in which it stands by itself without the drive"),
}


@dataclass(frozen=True)
class Stretch:
    """Positions, one after the other, from which a machine does not start: from ``begin`` to ``end`` of the input
    (rad or m), worst at ``worst``, where ``needed`` is asked for and ``available`` there (N·m or N)."""

    kind: Kind
    begin: float
    end: float
    worst: float
    needed: float
    available: float

    @property
    def missing(self) -> float:
        """What the drive lacks at the worst position, N·m or N; infinite where the machine jams."""
        return self.needed - self.available


@dataclass(frozen=True)
class DriveMargin(PlotMixin, Numbers):
    """The torque that a machine needs against the torque that its actuators have, over its cycle.

    ``starting``: at rest, at the verge of motion; ``running``: at the speeds and accelerations of the cycle, None
    where nothing gives them; ``quality`` (n,): square of the sine of the worst transmission angle, 0 at a dead point
    of the input itself; ``stretches``: where it does not start; ``worst``: the position of the smallest margin
    of starting; ``peak``: that of the largest torque needed to start.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    mechanism: Mechanism = field(repr=False)
    driver: str
    rotary: bool
    driven: bool
    speed: float | None
    starting: Torques = field(repr=False)
    running: Torques | None = field(repr=False)
    stretches: tuple[Stretch, ...]
    worst: Torques = field(repr=False)
    peak: Torques = field(repr=False)
    quality: Floats = field(repr=False)
    closed: bool = field(repr=False)

    @property
    def title(self) -> str:
        """Name of the machine."""
        return self.mechanism.name

    @property
    def dimension(self) -> str:
        """``torque``, or ``force`` of a driver that slides."""
        return "torque" if self.rotary else "force"

    @property
    def verdict(self) -> Literal["starts", "jam", "dead_point", "stall", "no_drive"]:
        """``starts`` from every position, else the worst that keeps it from it: a ``jam`` (no finite effort moves
        it), a ``dead_point`` (the actuators have no lever arm), a ``stall`` (their torque is too small)."""
        kinds = {each.kind for each in self.stretches}
        for kind in ("jam", "dead_point", "stall"):
            if kind in kinds:
                return kind
        return "starts" if self.driven else "no_drive"

    @property
    def starting_margin(self) -> float:
        """Least ratio of the available to the needed torque at rest; infinite where the loads start the machine, NaN
        without actuators."""
        return float(self.worst.ratio[0]) if self.driven else np.nan

    @property
    def missing_torque(self) -> float:
        """Largest torque (force) that the drive lacks to start, N·m or N; 0 where it starts from every position."""
        return max((each.missing for each in self.stretches), default=0.0)

    @property
    def running_margin(self) -> float:
        """Mean available over mean needed torque at speed; NaN where it is not known."""
        if self.running is None or not self.driven:
            return np.nan
        needed, available = (self._mean(each) for each in (self.running.needed, self.running.available))
        return np.inf if needed <= 0.0 else available / needed

    def _mean(self, values: Floats) -> float:
        """Mean of torques at speed over the way of the input."""
        assert self.running is not None
        rate, time = self.running.rate, self.running.time
        if self.closed:
            return float(np.average(values, weights=rate))
        return mean_over(time, values * rate) / mean_over(time, rate)

    @property
    def efficiency(self) -> Floats:
        """Instantaneous efficiency at rest, (n,): torque needed without friction over the one with it; 0 where the
        machine jams, NaN where the loads help. Source: Sun Huan, Theory of Machines and Mechanisms, ch. 5 (η ≤ 0:
        self-locking)."""
        return efficiency(self.starting)

    @property
    def holds(self) -> Flags:
        """Where the machine stands by itself with the actuators off, (n,): the loads drive it neither way."""
        return (self.starting.returning <= 0.0) & ~(self.starting.needed < 0.0)

    def blocks(self, translate: Translate) -> list[Block]:
        """The numbers at rest and at speed."""
        return [
            Block("starting", translate(_("At rest, at the verge of motion")), self._starting_rows()),
            *(
                []
                if self.running is None
                else [Block("running", translate(_("At the speed of the cycle")), self._running_rows(self.running))]
            ),
        ]

    def _starting_rows(self) -> list[Row]:
        peak, worst = self.peak, self.worst
        rows = [self._placed("needed_starting", float(peak.needed[0]), peak.input)]
        if self.driven:
            if np.isfinite(peak.available[0]):
                rows.append(Row("available_starting", float(peak.available[0]), self.dimension))
            rows.append(self._placed("starting_margin", self.starting_margin, worst.input, ""))
            excess = float(worst.excess[0])
            if np.isfinite(excess):
                rows.append(Row("missing" if excess < 0.0 else "spare", abs(excess), self.dimension))
        shares = self.efficiency
        if np.isfinite(shares).any() and np.nanmin(shares) < 1.0 - _ROUNDING:
            place = int(np.nanargmin(shares))
            rows.append(self._placed("efficiency", float(shares[place]), self.starting.input[place:], ""))
            rows.append(Row("holding", float(np.mean(self.holds)), scale=PERCENT))
        return rows

    def _running_rows(self, running: Torques) -> list[Row]:
        place = int(np.argmax(np.where(np.isnan(running.needed), np.inf, running.needed)))
        rows = [
            Row("mean_needed", self._mean(running.needed), self.dimension),
            self._placed("largest_needed", float(running.needed[place]), running.input[place:]),
        ]
        if self.driven:
            rows.append(Row("mean_available", self._mean(running.available), self.dimension))
            rows.append(Row("running_margin", self.running_margin))
        return [each for each in rows if not np.isnan(each.value) or each.text]

    def _placed(self, key: str, value: float, at: Floats, dimension: str | None = None) -> Row:
        """A number with the input where it is; one beyond all bounds, and that of a jam, as a sign."""
        kind = self.dimension if dimension is None else dimension
        bounded = math.isfinite(value)
        note, more = shown(float(at[0]), self._input), {f"at [{si_unit(self._input)}]": float(at[0])}
        return Row(key, value if bounded else math.nan, kind, note=note, more=more, text="" if bounded else INFINITE)

    @property
    def _input(self) -> str:
        return "angle" if self.rotary else "length"

    def columns(self) -> dict[str, Floats]:
        """Torques over the input, SI."""
        unit = si_unit(self.dimension)
        found = {
            f"input [{si_unit(self._input)}]": self.starting.input,
            f"needed_at_rest [{unit}]": self.starting.needed,
            f"available_at_rest [{unit}]": self.starting.available,
        }
        if self.running is not None:
            found[f"needed [{unit}]"] = self.running.needed
            found[f"available [{unit}]"] = self.running.available
        return found

    @property
    def findings(self) -> tuple[Message, ...]:
        """The verdict in sentences."""
        found = [self._sentence(kind) for kind in ("jam", "dead_point", "stall")]
        sentences = [each for each in found if each is not None]
        if not sentences and self.driven:
            sentences.append(
                _(
                    "{name!r} starts from every position: its drive has at least {margin:.4g} times the torque "
                    "needed, least at {where}",
                    name=self.mechanism.name,
                    margin=self.starting_margin,
                    where=shown(float(self.worst.input[0]), self._input),
                )
                if np.isfinite(self.starting_margin)
                else _("{name!r} starts from every position: its loads help to", name=self.mechanism.name)
            )
        if float(np.nanmin(self.quality)) < _DEAD:
            place = int(np.nanargmin(self.quality))
            sentences.append(
                _(
                    "near {where} two links of {name!r} are almost in line ({angle}), a dead point of its input: the "
                    "forces in its joints grow without bound there, and the smallest friction stops it",
                    code="verdicts.input_dead_point",
                    name=self.mechanism.name,
                    where=shown(float(self.starting.input[place]), self._input),
                    angle=shown(math.asin(math.sqrt(max(float(self.quality[place]), 0.0))), "angle", 3),
                )
            )
        if self.running_margin < 1.0 and self.running is not None:
            sentences.append(
                _(
                    "at the speed of the cycle the drive of {name!r} has {available} on the average, less than the "
                    "{needed} that the machine needs: it slows down until it has more, or stalls; find the speed "
                    "with run",
                    code="verdicts.too_slow",
                    name=self.mechanism.name,
                    available=shown(self._mean(self.running.available), self.dimension, 4),
                    needed=shown(self._mean(self.running.needed), self.dimension, 4),
                )
            )
        return tuple(sentences)

    def _sentence(self, kind: Kind) -> Message | None:
        found = [each for each in self.stretches if each.kind == kind]
        if not found:
            return None
        worst = max(found, key=lambda each: each.missing)
        values = {
            "name": self.mechanism.name,
            "places": together([self._interval(each) for each in found]),
            "where": shown(worst.worst, self._input),
        }
        if kind != "jam":
            values |= {
                "available": shown(worst.available, self.dimension, 4),
                "needed": shown(worst.needed, self.dimension, 4),
                "missing": shown(worst.missing, self.dimension, 4),
            }
        return SENTENCES[kind].format(**values)

    def _interval(self, stretch: Stretch) -> str:
        if stretch.begin == stretch.end:
            return _("at {place}", place=shown(stretch.begin, self._input))
        return _(
            "between {begin} and {end}", begin=shown(stretch.begin, self._input), end=shown(stretch.end, self._input)
        )

    def notes(self, language: str = "en") -> list[str]:
        """The verdict in sentences of a language."""
        return [each.translate(language) for each in self.findings]


SENTENCES: Mapping[Kind, Message] = {
    "jam": _(
        "{name!r} jams {places} of its input: the friction in its joints grows with the driving effort there, so "
        "that no finite effort moves it (self-locking); reduce friction coefficients or pin radii, or improve the "
        "transmission angle",
        code="verdicts.jams",
    ),
    "dead_point": _(
        "{name!r} does not start {places} of its input, a dead point of its drive: the actuators have no lever arm "
        "there, however large they are, and only inertia carries the machine over it ({missing} are missing at "
        "{where}); start elsewhere, add a flywheel, or a second actuator out of phase",
        code="verdicts.dead_point",
    ),
    "stall": _(
        "{name!r} does not start {places} of its input: at {where} it needs {needed} and the drive has {available}, "
        "{missing} too little; choose a drive with more starting torque or another ratio, or start elsewhere",
        code="verdicts.stalls",
    ),
}


def efficiency(torques: Torques) -> Floats:
    """Torque needed without friction over the one with it, (n,): 0 where the machine jams, NaN where loads help."""
    with np.errstate(all="ignore"):
        found = np.where(torques.ideal > 0.0, torques.ideal / torques.needed, np.nan)
    return np.where(np.isnan(torques.needed), 0.0, found)


def drive_margin(mechanism: Mechanism, *, driver: str | None = None, steps: int = STEPS) -> DriveMargin:
    """Whether a machine starts from every position of its cycle, and runs at its speed, with the drive that it has.

    At rest (the motor's starting torque) and at the speeds of the cycle, the torque needed against loads, weights,
    friction in joints and, in motion, inertia is compared with what the ``actuators`` of the machine supply, reduced
    to the driver. Loads and actuators that go by time are taken as at the time 0.

    Args:
        mechanism: with its ``actuators``; without any, what is needed is found all the same.
        driver: along which driver's coordinate; the first one unless named.
        steps: positions over the cycle; worst places and ends are refined between them.

    Returns:
        The torques over the cycle, the verdict, its margin and its sentences.

    Raises:
        LinkwrightError: no such driver, or a machine that cannot be solved.

    Source: Sun Huan, Theory of Machines and Mechanisms, ch. 5 (efficiency and self-locking).
    """
    require(mechanism, Mechanism)
    drive = Drive(mechanism, driver)
    times = drive.cycle(integer("steps", steps, 8, 100_000))
    starting = drive.starting(times)
    running = drive.running(times) if drive.prescribed else None
    return DriveMargin(
        mechanism=mechanism,
        driver=drive.name,
        rotary=drive.rotary,
        driven=drive.driven,
        speed=drive.speed,
        starting=starting,
        running=running,
        stretches=tuple(_stretches(drive, starting)) if drive.driven else tuple(_jams(drive, starting)),
        worst=_lowest(drive, starting, (lambda each: each.ratio) if drive.driven else _unneeded),
        peak=_lowest(drive, starting, _unneeded),
        quality=drive.quality(starting.time),
        closed=drive.period is not None,
    )


def _unneeded(torques: Torques) -> Floats:
    """The needed torque with the other sign, so that the largest is the lowest."""
    return -np.where(np.isnan(torques.needed), np.inf, torques.needed)


def _stretches(drive: Drive, found: Torques) -> list[Stretch]:
    return [*_jams(drive, found), *_short(drive, found)]


def _jams(drive: Drive, found: Torques) -> list[Stretch]:
    """Where no finite effort moves the machine."""

    def jammed(torques: Torques) -> Flags:
        return np.isnan(torques.needed)

    stretches = []
    for run in _runs(jammed(found), drive.period is not None):
        begin, end = _ends(drive, found, run, jammed)
        worst = float(found.input[run[0]])
        stretches.append(Stretch("jam", begin, end, worst, np.inf, float(found.available[run[0]])))
    return stretches


def _short(drive: Drive, found: Torques) -> list[Stretch]:
    """Where the drive has too little torque, or no lever arm."""
    most = largest(found.available)

    def short(torques: Torques) -> Flags:
        with np.errstate(invalid="ignore"):
            return torques.available < torques.needed

    stretches = []
    for run in _runs(short(found), drive.period is not None):
        begin, end = _ends(drive, found, run, short)
        available = found.available[run]
        dead = bool((np.abs(available) <= _NO_TORQUE * most).any() or np.ptp(np.sign(available)) > 0.0)
        kind: Kind = "dead_point" if dead and most else "stall"
        for at, place, step in ((begin, run[0], -1), (end, run[-1], 1)):
            if np.isnan(found.needed[(place + step) % len(found.time)]):  # towards a jam it grows without bound
                stretches.append(Stretch(kind, begin, end, at, np.inf, float(found.available[place])))
                break
        else:
            worst = _lowest(drive, found, lambda each: each.excess, run)
            numbers = (float(row[0]) for row in (worst.input, worst.needed, worst.available))
            stretches.append(Stretch(kind, begin, end, *numbers))
    return stretches


def _runs(flags: Flags, closed: bool) -> list[list[int]]:
    """Numbers of the positions one after the other for which something holds; round the end of a closed cycle."""
    found = [[*range(first, last + 1)] for first, last in runs(flags)]
    if closed and len(found) > 1 and found[0][0] == 0 and found[-1][-1] == len(flags) - 1:
        found[0] = found.pop() + found[0]
    return found


def _ends(drive: Drive, found: Torques, run: Sequence[int], holds: Callable[[Torques], Flags]) -> tuple[float, float]:
    """The input where something begins and ceases to hold, refined between the positions."""
    if len(run) == len(found.time):
        return float(found.input[0]), float(found.input[-1])

    def still(times: Floats) -> Flags:
        torques = drive.starting(times)
        return holds(torques) if len(torques.time) == len(times) else np.zeros(len(times), dtype=bool)

    ends = []
    for place, step in ((run[0], -1), (run[-1], 1)):
        inside, outside = float(found.time[place]), _neighbour(drive, found, place, step)
        if outside is not None:
            inside = edge(still, inside, outside, _NARROW * abs(outside - inside), _PARTS)[0]
        ends.append(float(drive.course(np.array([inside]))[0].places[drive.name][0]))
    return ends[0], ends[1]


def _neighbour(drive: Drive, found: Torques, place: int, step: int) -> float | None:
    """Time of the position before or behind one, None where the cycle ends there."""
    count, period = len(found.time), drive.period
    other = place + step
    if 0 <= other < count:
        return float(found.time[other])
    if period is None:
        return None
    return float(found.time[other % count]) + step * period


def _lowest(
    drive: Drive, found: Torques, value: Callable[[Torques], Floats], among: Sequence[int] | None = None
) -> Torques:
    """The torques at the one position where a value is lowest, refined between the neighbours."""
    values = value(found)
    places = range(len(values)) if among is None else among
    place = min(places, key=lambda each: values[each])
    if not np.isfinite(values[place]):
        return _at(found, place)

    def between(times: Floats) -> Floats:
        torques = drive.starting(times[0])
        reached = len(torques.time) == times.shape[1]
        return value(torques)[None] if reached else np.full(times.shape, np.inf)

    start = found.time[place]
    low, high = (_neighbour(drive, found, place, step) for step in (-1, 1))
    time, least = lowest(between, *(np.array([start if end is None else end]) for end in (low, high)))
    return drive.starting(time) if least[0] < values[place] else _at(found, place)


def _at(torques: Torques, place: int) -> Torques:
    return Torques(*(getattr(torques, each.name)[place : place + 1] for each in fields(torques)))
