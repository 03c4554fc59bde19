"""The standard library's ``dataclass``, whose methods are written when they are first wanted.

The standard one writes and compiles up to six methods for every class, 0.1 to 0.5 ms each time the program starts; a
command makes objects of fewer than half of its classes, and compares or prints hardly any. Classes made here are
dataclasses in every other respect: ``fields``, ``replace``, ``asdict`` and subclasses by either decorator.
"""

from __future__ import annotations

import sys
from dataclasses import MISSING, Field, FrozenInstanceError, fields
from dataclasses import dataclass as standard
from functools import partial
from inspect import get_annotations
from operator import attrgetter
from reprlib import recursive_repr
from typing import TYPE_CHECKING, Any

__all__ = ["dataclass"]

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from dataclasses import dataclass
else:

    def dataclass(cls=None, /, *, slots=False, **options):
        """As the standard one, with ``frozen``, ``eq``, ``repr`` and ``kw_only``; ``slots`` are left to that."""
        make = partial(standard, slots=True, **options) if slots else partial(_made, **options)
        return make if cls is None else make(cls)


def _made(
    cls: type, *, frozen: bool = False, eq: bool = True, repr: bool = True, kw_only: bool = False
) -> type:
    own = _own_fields(cls, kw_only)
    known: dict[str, Any] = {}
    for base in cls.__mro__[:0:-1]:
        known |= getattr(base, "__dataclass_fields__", {})
    made: Any = cls
    made.__dataclass_fields__ = known | own
    made.__dataclass_params__ = _PARAMS[frozen]
    for name, each in own.items():
        if isinstance(cls.__dict__.get(name), Field):
            delattr(cls, name) if each.default is MISSING else setattr(cls, name, each.default)
    shown = fields(made)
    matched = tuple(each.name for each in shown if each.init and not each.kw_only)
    methods: dict[str, Any] = {"__init__": _Written(cls, frozen), "__match_args__": matched}
    if repr:
        methods["__repr__"] = _repr([each.name for each in shown if each.repr])
    if eq:
        values = _reader([each.name for each in shown if each.compare])
        methods["__eq__"] = _eq(values)
        if not (frozen or cls.__dict__.get("__hash__")):
            made.__hash__ = None
    if frozen:
        methods |= _locks(cls, frozenset(each.name for each in shown))
        if eq and not cls.__dict__.get("__hash__"):
            made.__hash__ = lambda self: hash(values(self))
    for name, method in methods.items():
        if name not in cls.__dict__:
            setattr(cls, name, method)
    return cls


def _own_fields(cls: Any, kw_only: bool) -> dict[str, Any]:
    """The fields that a class itself declares, read by the standard decorator from a class without bases."""
    notes = get_annotations(cls)
    body = {name: getattr(cls, name) for name in notes if hasattr(cls, name)}
    body |= {"__module__": cls.__module__, "__annotations__": notes, "__doc__": "its fields"}
    plain: Any = type(cls.__name__, (), body)
    found = standard(plain, init=False, repr=False, eq=False, kw_only=kw_only, match_args=False)
    return dict(found.__dataclass_fields__)


def _params(frozen: bool) -> Any:
    plain: Any = type("_", (), {})
    sample: Any = standard(frozen=frozen)(plain)
    return sample.__dataclass_params__


_PARAMS = {frozen: _params(frozen) for frozen in (False, True)}


class _Written:
    """``__init__`` of a class, written when it is first wanted."""

    def __init__(self, cls: type, frozen: bool) -> None:
        self.cls, self.frozen = cls, frozen

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        made: Any = self.cls
        made.__init__ = _init(self.cls, self.frozen)
        return made.__init__.__get__(instance, owner)


def _init(cls: Any, frozen: bool) -> Any:
    """The function that fills the fields of a new object, in the manner of the standard decorator."""
    outside: dict[str, Any] = {"_put": object.__setattr__, "_none": _NONE}
    taken, lines = {False: ["self"], True: ["*"]}, []
    for each in fields(cls):
        name, value = each.name, each.name
        if each.default_factory is not MISSING:
            outside[f"_make_{name}"] = each.default_factory
            value = f"_make_{name}() if {name} is _none else {name}" if each.init else f"_make_{name}()"
        elif not each.init:
            continue
        if each.init:
            outside[f"_given_{name}"] = _NONE if each.default is MISSING else each.default
            needed = each.default is MISSING and each.default_factory is MISSING
            taken[bool(each.kw_only)].append(name if needed else f"{name}=_given_{name}")
        lines.append(f"_put(self, {name!r}, {value})" if frozen else f"self.{name} = {value}")
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    arguments = ", ".join([*taken[False], *(taken[True] if len(taken[True]) > 1 else [])])
    source = f"def __init__({arguments}):\n  " + "\n  ".join(lines or ["pass"])
    outer = f"def make({', '.join(outside)}):\n {source.replace(chr(10), chr(10) + ' ')}\n return __init__"
    space: dict[str, Any] = {}
    exec(outer, vars(sys.modules[cls.__module__]), space)
    function = space["make"](**outside)
    function.__qualname__ = f"{cls.__qualname__}.__init__"
    function.__annotations__ = {each.name: each.type for each in fields(cls) if each.init} | {"return": None}
    return function


class _None:
    """Stands for a value that its factory makes."""

    def __repr__(self) -> str:
        return "<factory>"


_NONE = _None()


def _reader(names: Sequence[str]) -> Callable[[Any], Any]:
    """What takes the values of the attributes, as one tuple."""
    return attrgetter(*names) if len(names) > 1 else lambda self: tuple(getattr(self, name) for name in names)


def _repr(names: Sequence[str]) -> Callable[[Any], str]:
    @recursive_repr()
    def __repr__(self: Any) -> str:
        shown = ", ".join(f"{name}={getattr(self, name)!r}" for name in names)
        return f"{self.__class__.__qualname__}({shown})"

    return __repr__


def _eq(values: Callable[[Any], Any]) -> Callable[[Any, object], Any]:
    def __eq__(self: Any, other: object) -> Any:
        if other.__class__ is not self.__class__:
            return NotImplemented
        return values(self) == values(other)

    return __eq__


def _locks(cls: Any, names: frozenset[str]) -> dict[str, Any]:
    def __setattr__(self: Any, name: str, value: object) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return {"__setattr__": __setattr__, "__delattr__": __delattr__}
