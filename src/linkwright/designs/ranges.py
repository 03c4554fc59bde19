"""Designs between the ends of ranges such as ``1.2..1.3 m:11`` or ``1.2, 1.25 m``: a grid or a Sobol sequence."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from linkwright import units
from linkwright.applied_loads.keys import PhaseField
from linkwright.core.arguments import integer
from linkwright.core.arrays import Floats
from linkwright.core.quantity import si_of, written
from linkwright.errors import LinkwrightError, RequestError, about
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Values of a range without a number of its own.
USUAL_COUNT = 11
_RANGE = re.compile(r"^(?P<low>.+?)\s*\.\.\s*(?P<high>.+?)(?:\s*:\s*(?P<count>[^:]+))?$")
_DASHED = re.compile(
    r"^(?P<low>[+-]?[\d.]+)\s*(?P<unit>[^\W\d]\S*?)?\s*(?:-|–|—|~|～|to|至|到|…|\.\.\.)\s*(?P<high>\d.*)$"
)
_QUANTITY = re.compile(r"^([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$")


@dataclass(frozen=True)
class Range:
    """The values of one dimension, SI, between ``low`` and ``high``; ``unit`` as the user wrote it."""

    address: str
    values: Floats
    unit: str = ""

    @property
    def low(self) -> float:
        """Smallest value."""
        return float(self.values.min())

    @property
    def high(self) -> float:
        """Largest value."""
        return float(self.values.max())

    @property
    def si(self) -> str:
        """The SI unit of its values."""
        return si_of(self.unit)

    def shown(self, value: float) -> str:
        """A value in the user's unit."""
        return written(value, self.unit)


def parse_range(mechanism: Mechanism, address: str, values: str | ArrayLike) -> Range:
    """The values from a text, or from numbers in SI.

    Raises:
        LinkwrightError: a text that is no range, a unit that does not fit the dimension.
    """
    if not isinstance(values, str):
        return Range(address, np.atleast_1d(np.asarray(values, dtype=float)))
    with about(f"{address}={values}"):
        found = _parsed(address, values.strip())
        _require_unit(mechanism, address, found.unit, values)
    return found


def _parsed(address: str, text: str) -> Range:
    match = _RANGE.match(text)
    if match is None:
        try:
            return _listed(address, text)
        except LinkwrightError:
            if (dashed := _DASHED.match(text)) is None:
                raise
            first = " ".join(filter(None, (dashed["low"], dashed["unit"])))
            raise RequestError(
                _(
                    "a range has two dots between its ends; write {right}",
                    code="study.no_dots",
                    right=f"{first}..{dashed['high']}",
                )
            ) from None
    high, unit = _quantity(match["high"], "", address, text)
    low, unit = _quantity(match["low"], unit, address, text)
    count = _count(match["count"], address, text)
    return Range(address, np.linspace(low, high, count), unit)


def _listed(address: str, text: str) -> Range:
    """One value, or several with commas; a unit at the end holds for all without one."""
    values, unit = [], ""
    for part in reversed(text.split(",")):
        value, unit = _quantity(part, unit, address, text)
        values.append(value)
    return Range(address, np.array(values[::-1]), unit)


def _quantity(part: str, unit: str, address: str, text: str) -> tuple[float, str]:
    """A number in SI and its unit; without a unit of its own that of ``unit``, else one of the same dimension."""
    match = _QUANTITY.match(part.strip())
    if match is None:
        raise RequestError(
            _(
                '{address}={text}: invalid quantity "{part}"; write a range as 1.2..1.3 m:11, or values '
                "as 1.2, 1.25, 1.3 m",
                code="study.no_quantity",
                address=address,
                text=text,
                part=part.strip(),
            )
        )
    number, own = match[1], match[2].strip() or unit
    factor, kind = units.unit(own) if own else (1.0, units.NONE)
    if unit and kind != units.unit(unit)[1]:
        raise RequestError(
            _(
                "{address}={text}: {first} and {second} are units of different dimensions; give both in one",
                code="study.units_differ",
                address=address,
                text=text,
                first=own,
                second=unit,
            )
        )
    value = float(number) * factor
    if not math.isfinite(value):
        raise RequestError(
            _("{address}={text}: a value is not finite", code="study.value_not_finite", address=address, text=text)
        )
    return value, own


def _count(text: str | None, address: str, full_text: str) -> int:
    if text is None:
        return USUAL_COUNT
    if not text.strip().isdecimal() or int(text) < 1:
        raise RequestError(
            _(
                '{address}={value}: invalid number of values "{text}"; end a range in an integer, such as :11',
                code="study.no_count",
                address=address,
                value=full_text,
                text=text.strip(),
            )
        )
    if int(text) > 1_000_000:
        raise RequestError(
            _(
                "{address}={value}: {count} values are too many; give a million or fewer",
                code="study.count_large",
                address=address,
                value=full_text,
                count=text,
            )
        )
    return int(text)


def _require_unit(mechanism: Mechanism, address: str, unit: str, text: str) -> None:
    """Raises where the unit is of another dimension, or missing."""
    expected = dimension_of(mechanism, address)
    if expected is None:
        return
    kind = units.unit(unit)[1] if unit else units.NONE
    if kind != expected:
        need, example = units.name_of(expected), units.si_symbol(expected)
        mismatch = (
            _("it has the unit {unit}", code="study.has_unit", unit=unit)
            if unit
            else _("it has no unit", code="study.has_no_unit")
        )
        write = (
            _("write it with a unit such as {example}", code="study.with_unit")
            if example
            else _("write it without a unit", code="study.without_unit")
        ).format(example=example)
        raise RequestError(
            _(
                "{address}={text}: expected {need}, but {mismatch}; {write}",
                code="study.wrong_unit",
                address=address,
                text=text,
                need=need,
                mismatch=mismatch,
                write=write,
            )
        )


def dimension_of(mechanism: Mechanism, address: str) -> units.Dimension | None:
    """The exponents of the dimension at an address; None where there is none."""
    if address in mechanism.parameters:
        return mechanism.kinds.get(address)
    found = mechanism.declared(address)
    if isinstance(found, PhaseField):
        name: str | None = mechanism.across
    else:
        name = getattr(found, "dimension", None)
    return None if name is None else units.DIMENSIONS[name]


#: Designs of one study, at most.
MOST = 1_000_000


BAD_SEED = _("invalid seed {seed}; expected an integer of 0 or more", code="study.bad_seed")


def grid(ranges: Sequence[Range]) -> dict[str, Floats]:
    """Every combination of the values; the last range varies fastest."""
    count = 1
    for each in ranges:
        count *= len(each.values)
    if count > MOST:
        raise RequestError(
            _(
                "the grid has {count} designs; give {most} or fewer, or sample it: sampling='sobol'",
                code="study.grid_large",
                count=count,
                most=MOST,
            )
        )
    mesh = np.meshgrid(*(each.values for each in ranges), indexing="ij")
    return {each.address: rows.ravel() for each, rows in zip(ranges, mesh, strict=True)}


def sobol(ranges: Sequence[Range], samples: int, seed: int, sampling: str) -> dict[str, Floats]:
    """``samples`` designs between the ends, by a scrambled Sobol sequence (Owen 1998); the same for the same seed.

    Raises LinkwrightError for another sampling, fewer than one sample, and where scipy is missing.
    """
    if sampling != "sobol":
        raise RequestError(
            _("there is no sampling {sampling!r}; use grid or sobol", code="study.no_sampling", sampling=sampling)
        )
    samples, seed = integer("samples", samples), integer("seed", seed)
    if not 1 <= samples <= MOST:
        raise RequestError(
            _(
                "{samples} samples are asked for; give 1 to {most}",
                code="study.bad_samples",
                samples=samples,
                most=MOST,
            )
        )
    if seed < 0:
        raise RequestError(BAD_SEED.format(seed=seed))
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise LinkwrightError(
            _("a Sobol sequence needs scipy; install it with: pip install scipy", code="study.needs_scipy")
        ) from error
    power = max(0, (samples - 1).bit_length())
    unit = qmc.Sobol(len(ranges), seed=seed).random_base2(power)[:samples]
    return {each.address: each.low + unit[:, i] * (each.high - each.low) for i, each in enumerate(ranges)}
