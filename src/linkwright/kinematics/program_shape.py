"""What of a mechanism decides its programs: everything but its numbers, and which of these are known zeros."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Hashable, Mapping
from typing import Any

from linkwright.core.expressions import Expression
from linkwright.drivers.base import Driver
from linkwright.formula.recently_made import Recent
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism

_NUMBER = "#"


def shape(mechanism: Mechanism, free: frozenset[str] = frozenset()) -> Hashable:
    """A key that two mechanisms share just when one program serves both, each with its own dimensions.

    Dimensions that are zero and not ``free``, angles that are multiples of a quarter turn, points of a link that
    coincide and the directions of guides along a link's axis are known to a program (see ``Dimensions``); all other
    numbers are its arguments. Loads, joints and laws take part with their fields, numbers left out.
    """
    numbers = mechanism.dimensions()
    form, guides = _forms.get(mechanism.family, None, lambda: _form(mechanism, numbers))
    return (
        form,
        free,
        tuple(map(_QUARTERS.get, numbers.values())) if not free else _known(numbers, free),
        tuple([link.coinciding for link in (mechanism.frame, *mechanism.links.values())]),
        tuple([_ahead(mechanism, mechanism.joints[name]) for name in guides]),
        mechanism.size,
    )


def _form(mechanism: Mechanism, numbers: Mapping[str, float]) -> tuple[Form, tuple[str, ...]]:
    """What numbers leave as it is, and the names of the guides along two points."""
    elements = (mechanism.joints, mechanism.loads)
    parts = (
        tuple(numbers),
        tuple(_link(link) for link in (mechanism.frame, *mechanism.links.values())),
        *(tuple(map(_plain, each.values())) for each in elements),
        tuple(map(_driver, mechanism.drivers.values())),
        tuple((address, each.text) for address, each in mechanism.expressions.items()),
        tuple((name, each.expression.text) for name, each in mechanism.outputs.items()),
    )
    along = [name for name, joint in mechanism.joints.items() if getattr(joint, "direction_points", None)]
    return Form(parts), tuple(along)


class Form:
    """A part of a key, hashed once."""

    __slots__ = ("_hash", "_parts")

    def __init__(self, parts: Hashable) -> None:
        self._parts, self._hash = parts, hash(parts)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, Form) and self._parts == other._parts)


#: By the family of a mechanism.
_forms: Recent[object, tuple[Form, tuple[str, ...]]] = Recent(256)


def _driver(driver: Driver) -> Hashable:
    return driver.name, driver.joint, driver.link, driver.relative_to, type(driver.law)


#: The number of quarter turns in angles that are multiples of one; 0 for zero.
_QUARTERS = {turns * 0.5 * math.pi: turns for turns in range(-636, 637)}


def _known(numbers: Mapping[str, float], free: frozenset[str]) -> tuple[int | None, ...]:
    return tuple(None if address in free else _QUARTERS.get(value) for address, value in numbers.items())


def _link(link: Link) -> Hashable:
    centre = link.mass_centre if isinstance(link.mass_centre, str) else link.mass_centre is None
    return link.name, link.geometry, tuple(link.points), centre


def _ahead(mechanism: Mechanism, joint: Any) -> tuple[bool, int]:
    """Of a guide along two points: whether the second has the larger abscissa on its link; its half turns."""
    start, end = (mechanism.link(joint.guide).points[name][0] for name in joint.direction_points)
    return bool(end > start), round(joint.direction / math.pi)


def _plain(value: Any) -> Hashable:
    """Fields and names of an element, its numbers left out."""
    if isinstance(value, float):
        return _NUMBER
    if isinstance(value, str | int | bool) or value is None:
        return value
    if isinstance(value, Expression):
        return value.text
    if isinstance(value, Mapping):
        return tuple((key, _plain(each)) for key, each in value.items())
    if isinstance(value, tuple | list):
        return tuple(_plain(each) for each in value)
    if dataclasses.is_dataclass(value):
        fields = ((each.name, _plain(getattr(value, each.name))) for each in dataclasses.fields(value))
        return type(value), tuple(fields)
    return type(value).__qualname__
