"""How a run begins and when it ends: what is asked for, before the section ``run`` of the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.run_conditions import RunConditions, Until
from linkwright.registry import no_such
from linkwright.words import _

#: How long a run is without other conditions, and one that waits for rest or steadiness at most, s.
USUAL, PATIENCE = 1.0, 600.0


def conditions_of(
    mechanism: Mechanism,
    duration: float | None = None,
    turns: float | None = None,
    until: Until | None = None,
    at_most: float | None = None,
    at: float | Mapping[str, float] | None = None,
    speed: float | Mapping[str, float] | None = None,
    prescribed: Iterable[str] | None = None,
) -> RunConditions:
    """How a run begins and ends: what is given goes before the section ``run`` of the file."""
    asked = mechanism.run or RunConditions()
    if duration is None and turns is None and until is None:
        duration, turns, until = asked.duration, asked.turns, asked.until
    return RunConditions(
        at={**asked.at, **_by_name(mechanism, at)},
        speed={**asked.speed, **_by_name(mechanism, speed)},
        duration=duration,
        turns=turns,
        until=until,
        at_most=asked.at_most if at_most is None else at_most,
        prescribed=asked.prescribed if prescribed is None else tuple(prescribed),
    )


def _by_name(mechanism: Mechanism, values: float | Mapping[str, float] | None) -> dict[str, float]:
    if values is None:
        return {}
    if not isinstance(values, Mapping):
        return {next(iter(mechanism.drivers), "driver"): float(values)}
    for name in values:
        if name not in mechanism.drivers:
            raise RequestError(no_such(_("driver"), name, mechanism.drivers))
    return {name: float(value) for name, value in values.items()}


@dataclass(frozen=True)
class End:
    """When a run ends."""

    time: float
    turns: float | None
    until: Until | None

    @classmethod
    def of(cls, asked: RunConditions) -> End:
        if asked.turns is None and asked.until is None:
            return cls(asked.duration or USUAL, None, None)
        return cls(asked.at_most or PATIENCE, asked.turns, asked.until)
