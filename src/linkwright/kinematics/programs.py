"""Traced programs of a mechanism's motion, cached by its shape: a changed number costs no tracing."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar, overload

from linkwright.core.outputs import Output
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.kinematics.outputs import MotionOutputs
from linkwright.kinematics.program_shape import Form, shape
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.kinematics.trace import MotionTrace, trace_motion
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
