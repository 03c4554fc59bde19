"""What magnitudes follow: the input, the time, outputs of the mechanism and their limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

from linkwright.applied_loads.site import Mechanism
from linkwright.core.outputs import Output
from linkwright.errors import LinkwrightError
from linkwright.fields.references import resolve_output, sliding
from linkwright.formula.late_import import numpy as np
from linkwright.formula.trace import Mask, Scalar
from linkwright.registry import offered
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats

LimitKind = Literal["max", "min"]


@dataclass(frozen=True)
class Limit:
    """A position in which an output reverses: ``input`` (rad or m), ``time`` (s), ``value`` of the output."""

    input: float
    time: float
    value: float
    kind: LimitKind


@dataclass(frozen=True)
class FullCycle:
    """The cycle over which limits are found: if it closes, its ``period`` (s) and the input's ``drift`` in it."""

    period: float | None
    drift: float = 0.0


class Signals(Protocol):
    """The n positions of a motion at which magnitudes are wanted; arrays are (n,).

    ``input``: coordinate of the first driver, rad or m (raises LinkwrightError without a driver), ``rotary``: whether
    that turns, ``heading``: 1 where it only grows over the cycle, -1 where it only falls, else 0; ``ok``: which
    positions are solved; ``closes``: period (s) and gain of the input in it, where the first position follows the
    last; ``full_cycle``: the cycle over which ``limits`` are found.
    """

    @property
    def mechanism(self) -> Mechanism: ...
    @property
    def time(self) -> Floats: ...
    @property
    def input(self) -> Floats: ...
    @property
    def rotary(self) -> bool: ...
    @property
    def heading(self) -> int: ...
    @property
    def ok(self) -> Flags: ...
    @property
    def closes(self) -> tuple[float, float] | None: ...
    @property
    def full_cycle(self) -> FullCycle: ...

    def output(self, output: Output) -> tuple[Floats, Floats]:
        """Value and rate of an output; angles are continuous over the cycle, rates of rounding size zero."""
        ...

    def limits(self, output: Output) -> Sequence[Limit]:
        """Where an output reverses within the full cycle, by increasing time, to machine precision."""
        ...

    def angle_between(self, a: str, b: str, near: float) -> Floats:
        """Angle of link b against link a, rad: within half a turn of ``near`` where the cycle begins, continuous."""
        ...


class BetweenLimits(Protocol):
    """A phase from a limit of an output to its next one of the other kind; ``outermost``: only from the largest to
    the smallest value or back, not between all reversals; ``in_part``: only in a part of that."""

    @property
    def output(self) -> Output: ...
    @property
    def start(self) -> LimitKind: ...
    @property
    def end(self) -> LimitKind: ...
    @property
    def outermost(self) -> bool: ...
    @property
    def in_part(self) -> bool: ...


class Course(Protocol):
    """The cycle as one load sees it: arrays of positions, or traced values. ``heading`` is above zero where the
    ``input`` grows."""

    @property
    def input(self) -> Scalar: ...
    @property
    def rotary(self) -> bool: ...
    @property
    def heading(self) -> Scalar: ...
    def output(self, output: Output) -> Scalar: ...
    def angle_between(self, a: str, b: str, near: float) -> Scalar: ...

    def named(self, name: str) -> Scalar:
        """A parameter of the model, ``t``, ``input`` or an output."""
        ...

    def dimension(self, field: str) -> Scalar:
        """A quantity of the load."""
        ...

    def constant(self, field: str) -> Scalar:
        """A number of the load that is no dimension."""
        ...

    def lookup(self, x: Scalar) -> Scalar:
        """The load's table at a place."""
        ...

    def stroke(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        """Whether an output goes from one limit to the other, ends included, and the share of the input's way there
        that is passed, of which a ``ramp`` needs the length."""
        ...

    def moving(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        """The same without the ends, where the output is at rest; the share only for a ramp."""
        ...

    def limit_value(self, output: Output, kind: str) -> Scalar:
        """The output at the limit of a kind that belongs to this stroke."""
        ...


def input_dimension(signals: Signals) -> str:
    """Name of the dimension of the input."""
    return "angle" if signals.rotary else "length"


def column(value: Any, count: int) -> Floats:
    """A number or an array as an array (n,)."""
    return np.array(np.broadcast_to(np.asarray(value, dtype=float), (count,)))


def named_column(name: str, signals: Signals) -> Any:
    """Values, a number or (n,), of a parameter, ``t``, ``input`` or an output in an expression."""
    mechanism = signals.mechanism
    if name in mechanism.parameters:
        return mechanism.parameters[name]
    if name in ("t", "input"):
        return signals.time if name == "t" else signals.input
    found = place_named(name, mechanism)
    if found is None:
        known = ["t", "input", *mechanism.parameters, *mechanism.links, *mechanism.joints]
        raise LinkwrightError(
            _(
                'unknown name "{name}" in its magnitude; {hint}',
                code="loads.unknown_in_magnitude",
                name=name,
                hint=offered(name, known),
            )
        )
    return signals.output(found)[0]


def place_named(name: str, mechanism: Mechanism) -> Output | None:
    """The place over the cycle that a name means; None where it means none."""
    links = {"frame": mechanism.frame, **mechanism.links}
    points = {link: tuple(each.points) for link, each in links.items()}
    guides = ((each.name, each.guide, each.block) for each in mechanism.guides.values())
    return resolve_output(name, points, sliding(guides, links))


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
