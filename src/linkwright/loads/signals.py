"""What the magnitude of a load may follow: the input, the time, outputs of the mechanism, their limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, Protocol

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.engine.late_import import numpy as np
from linkwright.errors import LinkwrightError
from linkwright.fields.references import resolve_output
from linkwright.loads.site import Mechanism
from linkwright.registry import offered
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats


@dataclass(frozen=True)
class Limit:
    """A position in which an output reverses: ``input`` (rad or m), ``time`` (s), ``value`` of the output."""

    input: float
    time: float
    value: float
    kind: Literal["max", "min"]


@dataclass(frozen=True)
class Whole:
    """The cycle over which limits are found: if it closes, its ``period`` (s) and the input's ``drift`` in it."""

    period: float | None
    drift: float = 0.0


class Signals(Protocol):
    """The n positions at which magnitudes are wanted; arrays are (n,)."""

    @property
    def mechanism(self) -> Mechanism:
        """Whose loads they are."""
        ...

    @property
    def time(self) -> Floats:
        """Times, s."""
        ...

    @property
    def input(self) -> Floats:
        """Coordinate of the first driver, rad or m; raises LinkwrightError where there is no driver."""
        ...

    @property
    def rotary(self) -> bool:
        """Whether the first driver turns."""
        ...

    @property
    def heading(self) -> int:
        """1 where the input only grows over the cycle, -1 where it only falls, else 0."""
        ...

    @property
    def ok(self) -> Flags:
        """Which positions are solved."""
        ...

    @property
    def closes(self) -> tuple[float, float] | None:
        """Period (s) and gain of the input in it, where the first position follows the last; else None."""
        ...

    @property
    def whole(self) -> Whole:
        """The cycle over which ``limits`` are found."""
        ...

    def output(self, output: Output) -> tuple[Floats, Floats]:
        """Value and rate of an output; angles are continuous over the cycle, rates of rounding size zero."""
        ...

    def limits(self, output: Output) -> Sequence[Limit]:
        """Where an output reverses within the whole cycle, by increasing time, to machine precision."""
        ...

    def angle_between(self, a: str, b: str, near: float) -> Floats:
        """Angle of link b against link a, rad: within half a turn of ``near`` where the cycle begins, continuous."""
        ...


def shown(value: float, dimension: str) -> str:
    """A value for a message: angles in degrees, times in s, lengths in m."""
    if dimension == "angle":
        return f"{round(float(np.degrees(value)), 9) + 0.0:.6g}°"
    return f"{value:.6g} {'s' if dimension == 'time' else 'm'}"


def input_dimension(signals: Signals) -> str:
    """Name of the dimension of the input."""
    return "angle" if signals.rotary else "length"


def spot(signals: Signals, index: int) -> str:
    """Where a position is, for a message."""
    if not signals.mechanism.drivers:
        return Sentence("loads.only_position")
    return Sentence("loads.at_input", input=shown(float(signals.input[index]), input_dimension(signals)))


def column(value: Any, count: int) -> Floats:
    """A number or an array as an array (n,)."""
    return np.array(np.broadcast_to(np.asarray(value, dtype=float), (count,)))


def times_of_inputs(inputs: Floats, signals: Signals) -> Floats | None:
    """Times at which the input has some values; of angles modulo one turn, all within the cycle. None where its law
    is no constant speed."""
    law = next(iter(signals.mechanism.drivers.values())).law
    if not law.constant_speed:
        return None
    times = law.time_at(inputs)
    if not signals.rotary:
        return np.asarray(times)
    turn = 2 * np.pi / abs(law.constant_speed)
    laps = np.arange(np.ceil(np.ptp(signals.time) / turn) + 2) - 1
    first = signals.time.min() + (times - signals.time.min()) % turn
    return np.asarray((first[:, None] + laps * turn).ravel())


def named_column(name: str, signals: Signals) -> Any:
    """Values, a number or (n,), of a parameter, ``t``, ``input`` or an output in an expression."""
    mechanism = signals.mechanism
    if name in mechanism.parameters:
        return mechanism.parameters[name]
    if name in ("t", "input"):
        return signals.time if name == "t" else signals.input
    found = output_named(name, mechanism)
    if found is None:
        known = ["t", "input", *mechanism.parameters, *mechanism.links, *mechanism.joints]
        raise LinkwrightError("loads.unknown_in_magnitude", name=name, hint=offered(name, known))
    return signals.output(found)[0]


def output_named(name: str, mechanism: Mechanism) -> Output | None:
    """The output that a name in an expression means."""
    links = {"frame": mechanism.frame, **mechanism.links}
    return resolve_output(name, {link: tuple(each.points) for link, each in links.items()}, mechanism.guides)
