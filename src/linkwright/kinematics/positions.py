"""The positions at which a mechanism is solved: times, and every driver's coordinate with its rates."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from math import cos, sin

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats, Indices
from linkwright.core.expressions import amount
from linkwright.core.inputs import driven
from linkwright.core.quantity import shown
from linkwright.drivers.base import NO_LAW, Driver
from linkwright.drivers.rocking import Rocking
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.units import LARGEST, NOUNS, SI_UNITS
from linkwright.words import Message, _

#: Dimensions of a coordinate and its rates, by whether the driver turns.
_RATES = {True: ("angle", "angular_velocity", "angular_acceleration"), False: ("length", "velocity", "acceleration")}

#: Positions between which a driver turns further than this are no path, but separate positions, rad.
LARGEST_STEP = 0.55


class CycleError(LinkwrightError):
    """A cycle that cannot be laid out."""


@dataclass(frozen=True)
class Positions:
    """n positions of the input: ``time`` (n,) s; per driver coordinate, rate, second derivative, (n,) each.

    ``period``: time in s after which a closed cycle is back at its first position, None for an open one; ``cycle``:
    the positions are equal steps of one motion, however large the steps are. Times of a closed cycle grow.
    """

    time: Floats
    coordinates: Mapping[str, tuple[Floats, Floats, Floats]]
    rotary: Mapping[str, bool]
    period: float | None = None
    cycle: bool = False

    @property
    def closed(self) -> bool:
        """Whether the cycle returns to its first position after the last one."""
        return self.period is not None

    @property
    def repeated(self) -> bool:
        """Whether the last position of a closed cycle is the first one again."""
        return self.period is not None and bool(self.time[-1] - self.time[0] > self.period * (1.0 - 1e-9))

    @cached_property
    def around(self) -> Floats:
        """Times, s, with that at which the first position of a closed cycle comes again."""
        return self.time if self.period is None else np.append(self.time, self.time[0] + self.period)

    @property
    def count(self) -> int:
        """Number of positions."""
        return len(self.time)

    @cached_property
    def is_way(self) -> bool:
        """Whether the positions are a cycle, or follow each other closely enough to be one motion."""
        if self.cycle or self.count < 3:
            return self.cycle
        steps = (np.abs(np.diff(q)).max() for name, (q, *_unused) in self.coordinates.items() if self.rotary[name])
        return self.closed or bool(max(steps, default=0.0) <= LARGEST_STEP)

    @property
    def steps(self) -> int:
        """The number of steps from which the positions of a cycle were made."""
        return max(1, self.count if self.closed else self.count - 1)

    @cached_property
    def paces(self) -> dict[str, float]:
        """The largest rate of every driver, rad/s or m/s."""
        return {name: float(np.abs(rate).max()) for name, (_unused, rate, _unused2) in self.coordinates.items()}

    @property
    def turns(self) -> float:
        """Turns, at its largest rate, of the driver that turns fastest, from the first position to the end."""
        fastest = max((pace for name, pace in self.paces.items() if self.rotary[name]), default=0.0)
        return float(self.around[-1] - self.around[0]) * fastest / (2 * np.pi)

    @cached_property
    def key(self) -> Hashable:
        """What tells these positions from others."""
        rows = (self.time, *chain.from_iterable(self.coordinates.values()))
        return self.closed, self.period, self.cycle, *(row.tobytes() for row in rows)

    def taken(self, order: Indices) -> Positions:
        """Some of the positions in another order, each for itself."""
        coordinates = {
            name: (q[order], rate[order], second[order]) for name, (q, rate, second) in self.coordinates.items()
        }
        return Positions(self.time[order], coordinates, self.rotary)

    @cached_property
    def arrays(self) -> dict[str, Floats]:
        """The program's inputs per position, by name; ``input`` is the first driver's coordinate."""
        found: dict[str, Floats] = {"time": self.time}
        for name, course in self.coordinates.items():
            found |= driven(name, self.rotary[name], course, np.cos, np.sin)
            found.setdefault("input", course[0])
        return found


def at_times(mechanism: Mechanism, time: ArrayLike, period: float | None = None) -> Positions:
    """The positions at times, s, of a closed cycle that is back after a ``period``, s, if that is not None."""
    t = _numbers(time)
    if not np.isfinite(t).all():
        raise CycleError(_("a time is not a finite number; give times in seconds", code="motion.bad_time"))
    coordinates = {name: _driven(driver, t) for name, driver in mechanism.drivers.items()}
    return Positions(t, coordinates, rotary(mechanism), period)


def _numbers(values: ArrayLike) -> Floats:
    try:
        found = np.atleast_1d(np.asarray(values, dtype=float))
    except (TypeError, ValueError):
        texts = [values] if isinstance(values, str) else [each for each in np.ravel(values) if isinstance(each, str)]
        if texts:
            raise CycleError(
                _(
                    '"{text}" is a text; give the number in SI units (rad, m, s): {right}',
                    code="motion.text_for_number",
                    text=str(texts[0])[:60],
                    right=_in_si(str(texts[0])),
                )
            ) from None
        raise CycleError(
            _(
                "invalid input or time {values}; give numbers in SI units (rad, m, s), such as 0.5 or [0.0, 0.5]",
                code="motion.no_numbers",
                values=repr(values)[:60],
            )
        ) from None
    if found.ndim > 1:
        raise CycleError(
            _(
                "inputs and times stand in one row, not in an array of the shape {shape}; give a number per position",
                code="motion.no_row",
                shape=str(found.shape),
            )
        )
    return found


def _in_si(text: str) -> str:
    """The SI value of an angle, a length or a time, 0.5 for anything else."""
    for dimension in ("angle", "length", "time"):
        with suppress(QuantityError):
            return f"{amount(text, dimension):.6g}"
    return "0.5"


def _driven(driver: Driver, time: Floats) -> tuple[Floats, Floats, Floats]:
    """Coordinate and rates of a driver; raises CycleError where a law has none, or none that the driver can have."""
    with np.errstate(all="ignore"):
        rows = driver.law.coordinate(time)
    _refuse_beyond_stroke(driver, rows[0], time)
    kinds = _RATES[driver.law.rotary]
    for row, kind in zip(rows, kinds, strict=True):
        bad = np.flatnonzero(~(np.abs(row) <= LARGEST[kind]))
        if len(bad):
            value, at = float(row[bad[0]]), float(time[bad[0]])
            shown = f"{value:g} {SI_UNITS[kind]}"
            raise CycleError(
                _(
                    "driver {name!r} gives {kind} of {value} at {time:g} s, which no machine has; change "
                    "its law or the cycle",
                    code="motion.law_beyond",
                    name=driver.name,
                    kind=NOUNS[kind],
                    value=shown,
                    time=at,
                )
            )
    return rows


def _refuse_beyond_stroke(driver: Driver, q: Floats, time: Floats) -> None:
    """Refuses lengths (m) that a cylinder does not have, at times (s)."""
    if driver.cylinder is None:
        return
    low, high = driver.cylinder.stroke or (0.0, np.inf)
    slack = 1e-9 * (low or 1.0)
    bad = np.flatnonzero((q < low - slack) | (q > high + slack) | (q <= 0.0))
    if not len(bad):
        return
    value, at = shown(float(q[bad[0]]), "length"), float(time[bad[0]])
    if driver.cylinder.stroke is None:
        raise CycleError(
            _(
                "driver {name!r} would be {value} long at {time:g} s, which no distance is; give the distance of "
                "its two points at time 0, as in start: 600 mm, or change its law",
                code="motion.no_distance",
                name=driver.name,
                value=value,
                time=at,
            )
        )
    raise CycleError(
        _(
            "driver {name!r} would be {value} long at {time:g} s, but its stroke reaches from {low} to {high}; "
            "change its law, the cycle or the stroke",
            code="motion.beyond_stroke",
            name=driver.name,
            value=value,
            time=at,
            low=shown(low, "length"),
            high=shown(high, "length"),
        )
    )


def off_law(mechanism: Mechanism, positions: Positions) -> str | None:
    """The first driver whose coordinates are not those of its law at the times of the positions; None without one."""
    known = at_times(mechanism, positions.time).coordinates
    for name, (q, *_unused) in positions.coordinates.items():
        lawful = known[name][0]
        if not (np.abs(q - lawful) <= 1e-12 + 1e-9 * np.abs(lawful)).all():
            return name
    return None


def at_one_time(mechanism: Mechanism, time: float) -> dict[str, float]:
    """The programs' inputs at one time, s, by name, of drivers that all have constant speeds."""
    found = {"time": time}
    for name, driver in mechanism.drivers.items():
        q, speed = driver.law.at(time), driver.law.constant_speed
        assert speed is not None
        found |= driven(name, driver.law.rotary, (q, speed, 0.0), cos, sin)
        found.setdefault("input", q)
    return found


def at_inputs(mechanism: Mechanism, at: ArrayLike | Mapping[str, ArrayLike]) -> Positions:
    """The positions at coordinates of the first driver, or of several drivers by name (rad or m).

    Rates are those of the drivers' constant speeds. Raises CycleError for a driver with another law whose
    coordinate is set, since then the time would not be known.
    """
    if not mechanism.drivers:
        raise CycleError(
            _(
                "{name!r} has no driver, so there is no input to set; leave the input out",
                code="motion.no_input_to_set",
                name=mechanism.name,
            )
        )
    requested = dict(at) if isinstance(at, Mapping) else {next(iter(mechanism.drivers)): at}
    if not requested:
        raise CycleError(
            _(
                "no input; give the coordinates of a driver, as in at={{{driver!r}: [0.5]}}",
                code="motion.no_inputs",
                driver=next(iter(mechanism.drivers)),
            )
        )
    refuse_free(mechanism)
    rows = {}
    for name, values in requested.items():
        driver = _driver(mechanism, name)
        if not driver.law.placeable:
            raise CycleError(
                _(
                    "driver {name!r} follows its own law in time; ask for positions by times instead of inputs",
                    code="motion.own_law",
                    name=name,
                )
            )
        q = _numbers(values)
        if not np.isfinite(q).all():
            raise CycleError(
                _("an input of driver {name!r} is not a finite number", code="motion.bad_input", name=name)
            )
        _refuse_beyond(driver, q)
        rows[name] = q
    count = max(len(q) for q in rows.values())
    first, q = next(iter(rows.items()))
    time = np.broadcast_to(mechanism.drivers[first].law.time_at(q), (count,))
    coordinates = {name: _driven(driver, time) for name, driver in mechanism.drivers.items()}
    for name, q in rows.items():
        coordinates[name] = (np.broadcast_to(q, (count,)).copy(), *coordinates[name][1:])
        _refuse_beyond_stroke(mechanism.drivers[name], coordinates[name][0], np.broadcast_to(time, (count,)))
    return Positions(np.array(time), coordinates, rotary(mechanism))


def refuse_free(mechanism: Mechanism) -> None:
    """Raises CycleError for a driver without a law, of which no motion is prescribed."""
    for driver in mechanism.drivers.values():
        if not driver.law.prescribed:
            speed = "10 rad/s" if driver.law.rotary else "0.1 m/s"
            raise CycleError(NO_LAW.format(name=driver.name, speed=speed))


def _refuse_beyond(driver: Driver, q: Floats) -> None:
    """Refuses coordinates (rad or m) to which a driver that rocks does not come: no rate belongs to them."""
    law = driver.law
    if not isinstance(law, Rocking) or law.ends is None:
        return
    low, high = law.ends
    beyond = q[(q < low - 1e-12) | (q > high + 1e-12)]
    if len(beyond):
        kind = "angle" if law.rotary else "length"
        raise CycleError(
            _(
                "{value} lies beyond the ends between which driver {name!r} rocks, {low} and {high}",
                code="motion.beyond_rock",
                value=shown(float(beyond[0]), kind),
                name=driver.name,
                low=shown(low, kind),
                high=shown(high, kind),
            )
        )


def rotary(mechanism: Mechanism) -> dict[str, bool]:
    return {name: mechanism.joints[driver.joint].coordinate == "turn" for name, driver in mechanism.drivers.items()}


def coordinate_text(name: str, value: float, rotary: bool) -> Message:
    """A driver's coordinate in words: ``crank = 30°``."""
    own = _("driver", code="nouns.driver") if name == "driver" else name
    return _("{name} = {value}", name=own, value=shown(value, "angle" if rotary else "length"))


def _driver(mechanism: Mechanism, name: str) -> Driver:
    if name not in mechanism.drivers:
        raise CycleError(no_such(_("driver"), name, mechanism.drivers))
    return mechanism.drivers[name]
