"""Traced programs of a mechanism's motion, cached by its shape: a changed number costs no trace."""

from __future__ import annotations

import dataclasses
import math
import threading
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar, overload

from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.drivers.base import Driver
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.kinematics.trace import MotionOutputs, MotionTrace, trace_motion
from linkwright.mechanism.link import Link
from linkwright.mechanism.mass_from_shape import bent_plates, fixed_plate
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology import Structure


@dataclass(frozen=True)
class Manner:
    """How a motion is traced: ``free`` dimensions, ``flipping`` groups whose assembly mode is set per position,
    ``iterations`` of groups without closed form (see ``trace_motion``)."""

    free: frozenset[str] = frozenset()
    flipping: frozenset[str] = frozenset()
    iterations: int = 1


AS_IT_IS = Manner()
T = TypeVar("T")


class locked_property(Generic[T]):
    """A cached property, found under the ``lock`` of its object: all threads share the traced values of the first.

    ``functools.cached_property`` locks the descriptor before the object on Python 3.11, and nothing since 3.12.
    """

    def __init__(self, find: Callable[[Any], T]) -> None:
        self.find = find
        self.__doc__ = find.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, instance: None, owner: type) -> locked_property[T]: ...
    @overload
    def __get__(self, instance: Any, owner: type) -> T: ...
    def __get__(self, instance: Any, owner: type) -> T | locked_property[T]:
        if instance is None:
            return self
        with instance.lock:
            if self.name not in instance.__dict__:
                instance.__dict__[self.name] = self.find(instance)
            return instance.__dict__[self.name]  # type: ignore[no-any-return]


class MotionPrograms:
    """The trace of all mechanisms of one shape, and the programs made of it. May be used from several threads."""

    def __init__(self, mechanism: Mechanism, structure: Structure, manner: Manner) -> None:
        self.mechanism = mechanism
        self.structure = structure
        self.manner = manner
        self.point_keys: dict[str, str] = {}
        self.meanings: dict[str, Output] = {}
        self.courses: dict[Output, tuple[tuple[str, ...], tuple[str, str]]] = {}
        self.lock = threading.RLock()
        self._programs: dict[tuple[str, ...], NumpyProgram] = {}

    def __reduce__(self) -> tuple[Callable[..., MotionPrograms], tuple[Mechanism, Manner]]:
        return motion_programs, (self.mechanism, self.manner)

    @locked_property
    def motion(self) -> MotionTrace:
        """Every link's state as traced values."""
        manner = self.manner
        return trace_motion(
            self.mechanism, self.structure, free=manner.free, modes_vary=manner.flipping, iterations=manner.iterations
        )

    @locked_property
    def outputs(self) -> MotionOutputs:
        """The motion's outputs by name."""
        return MotionOutputs(self.motion)

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs."""
        with self.lock:
            if names not in self._programs:
                self._programs[names] = NumpyProgram(self._plain(names))
            return self._programs[names]

    def _plain(self, names: tuple[str, ...]) -> Program:
        return Program.of(self.motion.trace, {name: self.outputs.value(name) for name in names})

    def places(self, names: tuple[str, ...]) -> Mapping[str, int]:
        """The row of every name among these."""
        return _places.get(self, names, lambda: {name: i for i, name in enumerate(names)})

    def scalar_program(self, names: tuple[str, ...]) -> ScalarProgram:
        """The same for one position on plain numbers."""
        with self.lock:
            return _scalars.get(self, names, lambda: ScalarProgram(self._plain(names)))


_places: Recent[MotionPrograms, Mapping[str, int]] = Recent(64)
_scalars: Recent[MotionPrograms, ScalarProgram] = Recent(64)


def motion_programs(mechanism: Mechanism, manner: Manner) -> MotionPrograms:
    """The programs of a mechanism's shape.

    Raises:
        StructureError: as :func:`linkwright.topology.structure`.
    """
    key = Form((shape(mechanism, manner.free), manner.flipping, manner.iterations))
    return _cache.get(None, key, lambda: MotionPrograms(mechanism, analysed(mechanism), manner))


_cache: Recent[None, MotionPrograms] = Recent(32)


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
        tuple([fixed_plate(mechanism, name) for name in bent_plates(mechanism)]) if free else (),
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
    law = driver.law
    return driver.name, driver.joint, driver.link, driver.relative_to, type(law.own), law.constant_speed is None


#: The number of quarter turns in angles that are multiples of one; 0 for zero.
_QUARTERS = {turns * 0.5 * math.pi: turns for turns in range(-636, 637)}


def _known(numbers: Mapping[str, float], free: frozenset[str]) -> tuple[int | None, ...]:
    return tuple(None if address in free else _QUARTERS.get(value) for address, value in numbers.items())


def _link(link: Link) -> Hashable:
    centre = link.mass_centre if isinstance(link.mass_centre, str) else link.mass_centre is None
    rings = link.shape.rings if link.mass_from_shape and link.shape is not None else ()
    return link.name, link.geometry, tuple(link.points), centre, link.mass_from_shape, _plain(link.shape), rings


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
