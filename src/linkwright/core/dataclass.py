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
    from collections.abc import Callable
    from dataclasses import dataclass
else:

    def dataclass(cls=None, /, *, slots=False, **options):
        """As the standard one, with ``frozen``, ``eq``, ``repr`` and ``kw_only``; ``slots`` are left to that."""
        make = partial(standard, slots=True, **options) if slots else partial(_made, **options)
        return make if cls is None else make(cls)


def _made(
    cls: Any, *, frozen: bool = False, eq: bool = True, repr: bool = True, kw_only: bool = False
) -> type:
    hashed = bool(cls.__dict__.get("__hash__"))
    methods: dict[str, Callable[[], Any]] = {"__init__": partial(_init, cls, frozen)}
    methods["__match_args__"] = partial(_matched, cls)
    if repr:
        methods["__repr__"] = partial(_repr, cls)
    if eq:
        methods["__eq__"] = partial(_eq, cls)
    if eq and frozen and not hashed:
        methods["__hash__"] = partial(_hash, cls)
    if frozen:
        methods |= {"__setattr__": partial(_setattr, cls), "__delattr__": partial(_delattr, cls)}
    for name, make in methods.items():
        if name not in cls.__dict__ or name == "__hash__":
            setattr(cls, name, _Late(cls, name, make))
    if eq and not (frozen or hashed):
        cls.__hash__ = None
    cls.__dataclass_params__ = _PARAMS[frozen]
    cls.__dataclass_fields__ = _Late(cls, "__dataclass_fields__", partial(_fields, cls, kw_only))
    for name in [name for name, value in cls.__dict__.items() if isinstance(value, Field)]:
        default = cls.__dataclass_fields__[name].default
        delattr(cls, name) if default is MISSING else setattr(cls, name, default)
    return cls  # type: ignore[no-any-return]


class _Late:
    """Stands for an attribute of a class until it is wanted."""

    def __init__(self, cls: Any, name: str, make: Callable[[], Any]) -> None:
        self.cls, self.name, self.make = cls, name, make

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        setattr(self.cls, self.name, self.make())
        return getattr(owner if instance is None else instance, self.name)


def _params(frozen: bool) -> Any:
    plain: Any = type("_", (), {})
    sample: Any = standard(frozen=frozen)(plain)
    return sample.__dataclass_params__


_PARAMS = {frozen: _params(frozen) for frozen in (False, True)}


def _fields(cls: Any, kw_only: bool) -> dict[str, Any]:
    """The fields of a class, its own read by the standard decorator from a class without bases."""
    known: dict[str, Any] = {}
    for base in cls.__mro__[:0:-1]:
        known |= getattr(base, "__dataclass_fields__", {})
    notes = get_annotations(cls)
    body = {name: getattr(cls, name) for name in notes if hasattr(cls, name)}
    body |= {"__module__": cls.__module__, "__annotations__": notes, "__doc__": "its fields"}
    plain: Any = type(cls.__name__, (), body)
    own: Any = standard(plain, init=False, repr=False, eq=False, kw_only=kw_only, match_args=False)
    known |= own.__dataclass_fields__
    return known


def _matched(cls: Any) -> tuple[str, ...]:
    return tuple(each.name for each in fields(cls) if each.init and not each.kw_only)


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


def _reader(cls: Any) -> Callable[[Any], Any]:
    """What takes the values that are compared, as one tuple."""
    names = [each.name for each in fields(cls) if each.compare]
    return attrgetter(*names) if len(names) > 1 else lambda self: tuple(getattr(self, name) for name in names)


def _repr(cls: Any) -> Callable[[Any], str]:
    names = [each.name for each in fields(cls) if each.repr]

    @recursive_repr()
    def __repr__(self: Any) -> str:
        shown = ", ".join(f"{name}={getattr(self, name)!r}" for name in names)
        return f"{self.__class__.__qualname__}({shown})"

    return __repr__


def _eq(cls: Any) -> Callable[[Any, object], Any]:
    values = _reader(cls)

    def __eq__(self: Any, other: object) -> Any:
        if other.__class__ is not self.__class__:
            return NotImplemented
        return values(self) == values(other)

    return __eq__


def _hash(cls: Any) -> Callable[[Any], int]:
    values = _reader(cls)
    return lambda self: hash(values(self))


def _setattr(cls: Any) -> Callable[[Any, str, object], None]:
    names = frozenset(each.name for each in fields(cls))

    def __setattr__(self: Any, name: str, value: object) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    return __setattr__


def _delattr(cls: Any) -> Callable[[Any, str], None]:
    names = frozenset(each.name for each in fields(cls))

    def __delattr__(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return __delattr__
