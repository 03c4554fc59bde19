"""Positions on the command line: ``0 deg, 30 deg``, ``0..90deg:10``, ``rocker min``; by driver ``NAME=…``."""

from __future__ import annotations

import re
from collections.abc import Sequence

from linkwright.cli.errors import UsageError, did_you_mean
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, RequestError, about
from linkwright.events.position_list import known_outputs, of_text, values_of
from linkwright.kinematics.positions import rotary
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


def quantities(text: str, dimension: str, option: str) -> list[float]:
    """SI values of a list of quantities and ranges, separated by commas; raises UsageError."""
    with about(option, UsageError, LinkwrightError):
        return values_of(text, dimension)


def duration(text: str | None, option: str) -> float | None:
    """One time, s; a bare number is in seconds. Raises UsageError."""
    if text is None:
        return None
    try:
        return float(text)
    except ValueError:
        return only(quantities(text, "time", option), text, option)


def only(values: Sequence[float], text: str, option: str) -> float:
    """The one value of an option; raises UsageError where there are more."""
    if len(values) > 1:
        raise UsageError(
            _(
                '{option}: "{text}" is more than one value; give one',
                code="draw.one_position",
                option=option,
                text=text,
            )
        )
    return values[0]


def one_input(text: str | None, mechanism: Mechanism) -> dict[str, float] | None:
    """One coordinate of every driver that ``--at`` names."""
    if text is None:
        return None
    return {name: only(values, text, "--at") for name, values in inputs(text, mechanism).items()}


def one_speed(text: str | None, mechanism: Mechanism) -> dict[str, float] | None:
    """Rates by driver of ``--speed``: of the first driver, or ``NAME=rate; NAME=rate``; raises UsageError."""
    if text is None:
        return None
    drivers = rotary(mechanism)
    found: dict[str, float] = {}
    for part in text.split(";"):
        name, equals, value = part.rpartition("=")
        name = name.strip() if equals else next(iter(drivers), "")
        if name not in drivers:
            cause = did_you_mean(_('there is no driver "{name}"', code="solve.no_driver", name=name), name, drivers)
            raise UsageError(_("{name}: {cause}", name="--speed", cause=cause))
        dimension = "angular_velocity" if drivers[name] else "velocity"
        found[name] = only(quantities(value, dimension, "--speed"), value, "--speed")
    return found


def one_place(text: str | None, mechanism: Mechanism, dimension: str, option: str) -> float | None:
    """One time or coordinate of the first driver."""
    return None if text is None else only(places(text, mechanism, dimension, option), text, option)


def joined(words: Sequence[str]) -> str:
    """Words that follow an option, each with values, as the one list that they are."""
    return ("; " if any("=" in word for word in words) else ", ").join(words)


def inputs(text: str, mechanism: Mechanism, option: str = "--at") -> dict[str, list[float]]:
    """Coordinates by driver of an option: a list for the first driver, in which limit positions may stand, or
    ``NAME=list; NAME=list``; raises UsageError."""
    drivers = rotary(mechanism)
    if not drivers:
        raise UsageError(
            _(
                "{name}: {cause}",
                name=option,
                cause=_("the model has no driver, so there is no input to set", code="solve.no_input"),
            )
        )
    if "=" not in text:
        return {next(iter(drivers)): places(text, mechanism, mechanism.across, option)}
    found: dict[str, list[float]] = {}
    for part in text.split(";"):
        name, equals, values = part.rpartition("=")
        name = name.strip() if equals else next(iter(drivers))
        if name not in drivers:
            cause = did_you_mean(_('there is no driver "{name}"', code="solve.no_driver", name=name), name, drivers)
            raise UsageError(_("{name}: {cause}", name=option, cause=cause))
        found[name] = quantities(values, "angle" if drivers[name] else "length", option)
    counts = {len(values) for values in found.values()} - {1}
    if len(counts) > 1:
        raise UsageError(
            _(
                "{option}: the drivers have lists of different lengths ({counts}); give as many values for each, "
                "or one",
                code="solve.uneven",
                option=option,
                counts=tuple(map(str, sorted(counts))),
            )
        )
    return found


def places(text: str, mechanism: Mechanism, dimension: str, option: str) -> list[float]:
    """Times, s, or coordinates of the first driver, in which limit positions may stand; raises UsageError."""
    with about(option, UsageError, LinkwrightError):
        listed = of_text(text, (dimension,))
        known_outputs(mechanism, listed)
    if not mechanism.drivers and listed.at_limits:
        raise UsageError(
            _(
                "{name}: {cause}",
                name=option,
                cause=_("the model has no driver, so there is no input to set", code="solve.no_input"),
            )
        )
    with about(option, UsageError, RequestError):
        return listed.times(mechanism) if dimension == "time" else listed.inputs(mechanism)


def zone_of(text: str, across: str, option: str = "--zone") -> tuple[float, float]:
    """The ends of a zone, rad or m, from ``-880..-1450 deg``; raises QuantityError."""
    first, dots, last = (each.strip() for each in text.partition(".."))
    if not dots:
        raise UsageError(
            _(
                '{option}: invalid range "{text}"; write where it begins and ends, such as "90..210 deg"',
                code="compensate.bad_zone",
                option=option,
                text=text,
            )
        )
    unit = re.sub(r"^[-+\d.eE]*", "", last).strip()
    begin = first if re.search(r"[^-+\d.eE\s]", first) else f"{first} {unit}"
    return amount(begin, across), amount(last, across)
