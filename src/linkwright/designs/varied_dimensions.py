"""What varies: addresses of dimensions, the values of many designs, and the text of a model file with them.

A number is replaced in place, a missing key is added. What an assembled drawing says, the geometry of
links drawn in it, phases of wheels and assemblies, is derived anew from the drawing of the changed machine.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from linkwright import units
from linkwright.core.arguments import one_or_more, require
from linkwright.core.arrays import Floats
from linkwright.designs.ranges import Range, dimension_of, parse_range
from linkwright.drivers.rocking import Rocking
from linkwright.errors import LinkwrightError, QuantityError, RequestError
from linkwright.files.write import Document, no_place
from linkwright.joints.toothed import Numbers, is_integer
from linkwright.kinematics.assembly import AssemblyError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mass_from_shape import derived_addresses
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.units import number
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
                if _ends(changed) != _ends(mechanism):
                    raise RequestError(
                        _(
                            "{address} changes the limits between which the driver rocks, so that the positions of "
                            "the input differ from design to design; write the same ends for all into the file, "
                            "such as cycle: {{rock: [{low}, {high}]}}",
                            code="study.moves_limits",
                            address=address,
                            **_rock_ends(mechanism),
                        )
                    )
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


def refuse_moved_limits(mechanism: Mechanism, positions: Positions, addresses: Iterable[str]) -> None:
    """Refuses dimensions that move the limits between which a driver rocks, or the coordinates of drivers that follow
    a path, as :func:`refuse_moved_positions`."""
    if mechanism.path is not None or (mechanism.cycle is not None and mechanism.cycle.rock is not None):
        known = {address: mechanism.dimension(address) for address in addresses}
        refuse_moved_positions(
            mechanism, positions, {address: np.array([1.001 * value or 1e-3]) for address, value in known.items()}
        )


def _ends(mechanism: Mechanism) -> list[tuple[float, float] | None]:
    """Between what drivers rock."""
    laws = (driver.law for driver in mechanism.drivers.values())
    return [law.ends if isinstance(law, Rocking) else None for law in laws]


def _rock_ends(mechanism: Mechanism) -> dict[str, str]:
    """Ends a little within those of a driver that rocks, as a file has them."""
    (driver,) = mechanism.drivers.values()
    ends = driver.law.ends if isinstance(driver.law, Rocking) else None
    low, high = ends or (-0.5, 0.5)
    inner = (low + 0.05 * (high - low), high - 0.05 * (high - low))
    if driver.law.rotary:
        return {name: f"{math.degrees(each):.0f} deg" for name, each in zip(("low", "high"), inner, strict=True)}
    return {name: f"{1e3 * each:.4g} mm" for name, each in zip(("low", "high"), inner, strict=True)}


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


_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\s\"'#,\]}]*)")
#: Lengths from this one on are in m.
_LONG = 1.0
#: A number that no text around it holds.
_MARK = "1234567.0625"
#: Fewest and most digits of a number that is read back as the same.
_DIGITS = range(12, 18)


@dataclass(frozen=True)
class Written:
    """How a text holds a number in a unit of ``factor`` SI: with ``before`` and ``after`` in place of what is at
    ``span``, its first offset and the one behind it."""

    span: tuple[int, int]
    before: str
    after: str
    unit: str
    factor: float

    def text(self, value: float) -> str:
        """The replacement text."""
        return f"{self.before}{digits(value, self.factor)}{self.after}"


def written(document: Document, address: str, value: float) -> Written | None:
    """How a document holds the dimension, or the coordinate of its drawing, at an address; None where it cannot."""
    place = document.place(address)
    if place is not None and (match := _NUMBER.search(document.text, *place)):
        unit = _unit(match[1], match[2], value)
        if unit is not None:
            return Written(match.span(1), "", "", unit, factor_of(unit))
    unit = usual_unit(document.mechanism, address, value)
    found = document.edit(address, f"{_MARK} {unit}".strip())
    if found is None:
        return None
    before, after = found.written.split(_MARK)
    return Written((found.start, found.end), before, after, unit, factor_of(unit))


def _unit(text: str, unit: str, value: float) -> str | None:
    """The unit behind a number of the text, if both give the value; a bare zero has none to go by."""
    try:
        factor = factor_of(unit)
    except QuantityError:
        return None
    same = abs(float(text) * factor - value) <= 1e-12 * abs(value)
    return unit if same and (unit or value != 0.0) else None


def usual_unit(mechanism: Mechanism, address: str, value: float) -> str:
    """The unit of a dimension, or of a coordinate of the drawing, that its file gives none."""
    drawn = address.startswith("drawing.")
    kind = units.DIMENSIONS["length"] if drawn else dimension_of(mechanism, address)
    if kind == units.DIMENSIONS["length"]:
        return "m" if abs(value) >= _LONG else "mm"
    if kind == units.DIMENSIONS["angle"]:
        return "deg"
    return units.si_symbol(kind) if kind else ""


def factor_of(unit: str) -> float:
    """SI value of one of a unit."""
    return units.unit(unit)[0] if unit else 1.0


def digits(value: float, factor: float) -> str:
    """The shortest number that gives an SI value in a unit again, to the last digit where there is one."""
    near = value / factor
    texts = (f"{near:.{count}g}" for count in _DIGITS)
    return number(float(next((text for text in texts if float(text) * factor == value), repr(near))))


def drawn_places(document: Document) -> dict[str, tuple[Written, str]]:
    """How a document holds the coordinates of its drawing, each with the output that is its place, by address."""
    mechanism, found = document.mechanism, dict[str, tuple[Written, str]]()
    for point, place in mechanism.drawing.items():
        key = _key(mechanism, point)
        for axis, value in zip("xy", place, strict=True):
            how = written(document, address := f"drawing.{point}.{axis}", value)
            if key is not None and how is not None:
                found[address] = how, f"{key}.{axis}"
    return found


def _key(mechanism: Mechanism, point: str) -> str | None:
    """A drawn point as outputs name it; None where no link has it."""
    for name, link in (("frame", mechanism.frame), *mechanism.links.items()):
        own = point.removeprefix(f"{name}.")
        if own in link.points:
            return canonical(mechanism, name, own)
    return None


def moves(mechanism: Mechanism, address: str) -> bool:
    """Whether a change of a dimension may move what is drawn: all but masses, shapes, loads, gravity and speeds."""
    owner, _unused, key = address.partition(".")
    if owner in mechanism.links:
        return key.partition(".")[0] not in ("mass", "inertia", "mass_centre", "shape")
    if address.startswith("frame.shape."):
        return False
    return owner not in ("loads", "gravity", "cycle", "construction", *mechanism.drivers)


def changed_text(document: Document, values: Mapping[str, float]) -> str:
    """The text of a document with changed dimensions (SI), all else as it was.

    Raises LinkwrightError where the file has no place for one, or where the changed machine cannot be assembled,
    ModelError where no file may hold it.
    """
    old = document.mechanism
    new = old.with_dimensions(values)
    changed = {address: float(value) for address, value in values.items() if value != old.dimension(address)}
    drawn = drawn_places(document) if any(moves(old, each) for each in changed) else {}
    edits = []
    for address, value in changed.items():
        if address in derived_addresses(old):  # the other two would be lost
            raise no_place(address, old)
        how = written(document, address, old.dimension(address))
        if how is not None:
            edits.append((how, value))
        elif not (drawn and address in drawn_dimensions(old)):
            raise no_place(address, old)
    if drawn:
        motion = as_drawn(old, new)
        edits += [(how, _coordinate(motion, key)) for how, key in drawn.values()]
    return document.with_text(replaced(document.text, edits)).text


def drawn_dimensions(mechanism: Mechanism) -> set[str]:
    """Addresses that follow from the drawing: the geometry of links that have it from there."""
    drawn = [link for link in mechanism.links.values() if link.geometry == "drawing"]
    return {address for link in drawn for address in link.geometry_dimensions()}


def as_drawn(old: Mechanism, new: Mechanism) -> Motion:
    """A changed machine where its drivers stand in the drawing."""
    drawing = Drawing(old)
    drawn = {name: drawing.driver(name) for name in old.drivers}
    at = {name: old.drivers[name].law.at(0.0) if q is None else q for name, q in drawn.items()}
    return solve_motion(new, at=at)


def _coordinate(motion: Motion, key: str) -> float:
    point, _unused, axis = key.rpartition(".")
    return float(motion.point(point).position[0]["xy".index(axis)])


def replaced(text: str, edits: Iterable[tuple[Written, float]]) -> str:
    """A text with numbers written into it."""
    for how, value in sorted(edits, key=lambda each: each[0].span, reverse=True):
        start, end = how.span
        text = text[:start] + how.text(value) + text[end:]
    return text
