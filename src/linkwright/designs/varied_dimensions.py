"""What varies: addresses of dimensions and the values of many designs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import one_or_more, require
from linkwright.core.arrays import Floats
from linkwright.designs.ranges import Range, parse_range
from linkwright.errors import LinkwrightError, RequestError
from linkwright.joints.toothed import Numbers, is_integer
from linkwright.kinematics.assembly import AssemblyError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import Positions
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import Message, _

#: The change of a dimension with which it is tried, as share of its value or of the mechanism's size.
SMALL = 1e-4


def checked_addresses(mechanism: Mechanism, addresses: Iterable[str]) -> tuple[str, ...]:
    """The addresses, each once; raises LinkwrightError for one that the mechanism does not have."""
    known = mechanism.dimensions()
    wanted = tuple(dict.fromkeys(one_or_more(addresses)))
    for address in wanted:
        if address not in known:
            hint = offered(address, known, _("such as {names}"), most=6)
            raise RequestError(
                _(
                    "there is no dimension or parameter {address!r} in {name!r}; {hint}",
                    code="study.no_dimension",
                    address=address,
                    name=mechanism.name,
                    hint=hint,
                )
            )
    return wanted


def varied_ranges(mechanism: Mechanism, vary: Mapping[str, str | ArrayLike], *, sampled: bool) -> tuple[Range, ...]:
    """What varies, each a text or values (SI); ``sampled``: any value between the bounds may be taken.

    Raises:
        LinkwrightError: nothing varies, an unknown address, a text that is no range, fractions of teeth.
    """
    require(vary, Mapping)
    checked_addresses(mechanism, vary)
    ranges = tuple(parse_range(mechanism, address, values) for address, values in vary.items())
    if not ranges:
        raise RequestError(
            _(
                'nothing varies; give dimensions with ranges: {{"crank.length": "20..30 mm:11"}}',
                code="study.nothing_varies",
            )
        )
    for each in ranges:
        if not each.values.size:
            raise RequestError(_("{address} has no values", code="study.no_values", address=each.address))
        if gives_part_of_tooth(mechanism, each.address, between(each)) and (
            sampled or any(gives_part_of_tooth(mechanism, each.address, value) for value in each.values)
        ):
            low, high = math.ceil(each.low), math.floor(each.high)
            count = max(1, high - low + 1)
            raise RequestError(
                _(
                    "{address} gives numbers of teeth, which are integers; write "
                    "{address}={low}..{high}:{count}, every integer of a grid",
                    code="study.whole_teeth",
                    address=each.address,
                    low=low,
                    high=high,
                    count=count,
                )
            )
    return ranges


def between(bounds: Range) -> float:
    """A value between the bounds that no range written by hand hits."""
    return bounds.low + (bounds.high - bounds.low) / math.pi


def gives_part_of_tooth(mechanism: Mechanism, address: str, value: float) -> bool:
    """Whether a value makes a number of teeth that is not an integer."""
    try:
        changed = mechanism.with_dimensions({address: float(value)})
    except LinkwrightError:
        return False
    numbers = ((changed.declared(name), number) for name, number in changed.dimensions().items())
    return any(isinstance(declared, Numbers) and not is_integer(number) for declared, number in numbers)


def design_values(mechanism: Mechanism, vary: Mapping[str, ArrayLike]) -> dict[str, Floats]:
    """Values (designs,) by address, SI; single numbers are repeated.

    Raises:
        LinkwrightError: an unknown address, columns of different lengths, a value that is no number or not finite, a
            length that is not positive, a negative mass.
    """
    require(vary, Mapping)
    checked_addresses(mechanism, vary)
    if not vary:
        raise RequestError(
            _(
                'nothing varies; give dimensions with their values: {{"crank.length": values}}',
                code="study.nothing_varied",
            )
        )
    columns = {address: _column(address, values) for address, values in vary.items()}
    lengths = {len(column) for column in columns.values() if len(column) != 1}
    for address, column in columns.items():
        if column.ndim != 1:
            raise RequestError(
                _(
                    "the values of {address} have the shape {shape}; give one per design, in one row "
                    "(values.ravel())",
                    code="study.bad_shape",
                    address=address,
                    shape=str(column.shape),
                )
            )
        _check(mechanism, address, column)
    if len(lengths) > 1:
        lengths_text = ", ".join(f"{address}: {len(column)}" for address, column in columns.items())
        raise RequestError(
            _(
                "the dimensions have different numbers of values ({counts}); give one per design each",
                code="study.uneven",
                counts=lengths_text,
            )
        )
    count = lengths.pop() if lengths else 1
    return {address: np.broadcast_to(column, (count,)) for address, column in columns.items()}


def _column(address: str, values: ArrayLike) -> Floats:
    try:
        return np.atleast_1d(np.asarray(values, dtype=np.float64))
    except (ValueError, TypeError):
        raise RequestError(
            _(
                "{address}: invalid list of numbers {given}; give SI values, such as [0.05, 0.06] for 50 and 60 mm",
                code="study.no_numbers",
                address=address,
                given=repr(values)[:60],
            )
        ) from None


def _check(mechanism: Mechanism, address: str, column: Floats) -> None:
    """Every value on its own must be one that the mechanism takes."""
    if not len(column):
        raise RequestError(_("{address} has no values", code="study.no_values", address=address))
    bad = np.flatnonzero(~np.isfinite(column))
    if len(bad):
        raise RequestError(
            _(
                "value {place} of {address} is {value}; give finite numbers",
                code="study.bad_value",
                place=int(bad[0]),
                address=address,
                value=column[bad[0]],
            )
        )
    for extreme in (column.min(), column.max()):
        mechanism.with_dimensions({address: float(extreme)})


def misfits(mechanism: Mechanism, address: str, change: float) -> list[Message]:
    """What no longer fits of pairs of wheels when a dimension changes alone, SI."""
    try:
        changed = mechanism.with_dimensions({address: mechanism.dimension(address) + change})
    except LinkwrightError:
        return []
    found = (joint.misfit(changed) for joint in changed.joints.values())
    return [why for why in found if why is not None]


def refuse_misfits(mechanism: Mechanism, addresses: Iterable[str]) -> None:
    """Refuses dimensions that pairs of wheels fix, so that none of them can change alone.

    Raises:
        RequestError: with what would no longer fit.
    """
    if not mechanism.higher:
        return
    size = mechanism.size
    for address in addresses:
        wrong = misfits(mechanism, address, SMALL * max(abs(mechanism.dimension(address)), size))
        if wrong:
            raise RequestError(
                _(
                    "{address} cannot change alone: {why}; give the pair by its teeth, or by its ratio, "
                    "alone, or let a parameter change all that belongs together",
                    code="study.fixed_by_wheels",
                    address=address,
                    why=wrong[0],
                )
            )


def refuse_moved_positions(mechanism: Mechanism, positions: Positions, columns: Mapping[str, Floats]) -> None:
    """Raises LinkwrightError for a dimension that moves the positions of the input themselves."""
    for address, column in columns.items():
        for value in (column.min(), column.max()):
            changed = mechanism.with_dimensions({address: float(value)})
            try:
                moved = over_cycle(changed, positions.steps)
            except AssemblyError:  # no position of its own; the design fails where all designs are solved
                continue
            if not _same(mechanism, positions, moved):
                wheels = mechanism.cycle is None and changed.drivers == mechanism.drivers
                raise RequestError(
                    _(
                        "{address} changes after how many turns all wheels are back, so that the cycles differ "
                        "from design to design; write one for all into the file, such as cycle: {{turns: 1}}",
                        code="study.moves_cycle",
                        address=address,
                    )
                    if wheels
                    else _(
                        "{address} changes the drive's law or the cycle, so that the positions of the input "
                        "differ from design to design; solve such designs one by one",
                        code="study.moves_positions",
                        address=address,
                    )
                )


def _same(mechanism: Mechanism, a: Positions, b: Positions) -> bool:
    """Whether both have the same coordinates, but for the sign of a turn and the rate of a constant speed."""
    if a.count != b.count:
        return False
    for name, rows in a.coordinates.items():
        q, other = rows[0], b.coordinates[name][0]
        if mechanism.drivers[name].law.constant_speed is None:
            if not all(map(np.array_equal, rows, b.coordinates[name])):
                return False
            continue
        mirrored = a.closed and a.rotary[name] and np.allclose(other - other[0], q[0] - q, rtol=0, atol=1e-9)
        if not mirrored and not np.allclose(other, q, rtol=0, atol=1e-9):
            return False
    return True
