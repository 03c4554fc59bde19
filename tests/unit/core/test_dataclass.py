"""Dataclasses whose methods are written late are, from outside, those of the standard library."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import pickle
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import FrozenInstanceError, field
from dataclasses import dataclass as standard
from typing import Any, ClassVar

import pytest

from linkwright.core.dataclass import dataclass

Decorator = Callable[..., Any]


def plain(made: Decorator) -> type:
    @made
    class Thing:
        """With defaults, a factory, something hidden and something that is no field."""

        kind: ClassVar[str] = "any"
        a: int
        b: float = 1.5
        c: list[int] = field(default_factory=list)
        d: int = field(default=0, compare=False)
        e: int = field(default=7, repr=False, kw_only=True)
        f: int = field(default=1, init=False)
        g: list[int] = field(default_factory=list, init=False)

    return Thing


def frozen(made: Decorator) -> type:
    @made(frozen=True)
    class Thing:
        """Hashed by its only field."""

        a: tuple[int, ...] = ()

    return Thing


def inherited(made: Decorator) -> type:
    @made(frozen=True, kw_only=True)
    class Base(ABC):
        """Its keywords come last."""

        named: bool = False
        note: str = "none"

        @abstractmethod
        def area(self) -> float:
            """Of the shape."""

    @made(frozen=True)
    class Square(Base):
        """A field more, and another default of one of the base."""

        side: float
        note: str = field(default="square", kw_only=True)

        def __post_init__(self) -> None:
            object.__setattr__(self, "side", abs(self.side))

        def area(self) -> float:
            """Side squared."""
            return self.side**2

    return Square


def own_methods(made: Decorator) -> type:
    @made(frozen=True)
    class Thing:
        """With a printed form and a hash of its own."""

        a: int = 0
        b: int = 0

        def __repr__(self) -> str:
            return "own"

        def __hash__(self) -> int:
            return 5

    return Thing


def unequal(made: Decorator) -> type:
    @made(frozen=True, eq=False, repr=False)
    class Thing:
        """The same as itself only."""

        a: int = 0

    return Thing


def slotted(made: Decorator) -> type:
    @made(frozen=True, slots=True)
    class Thing:
        """Without a dictionary."""

        a: int = 0

    return Thing


KINDS = (plain, frozen, inherited, own_methods, unequal, slotted)


@pytest.fixture(params=KINDS, ids=lambda kind: kind.__name__)
def both(request: pytest.FixtureRequest) -> tuple[Any, Any]:
    return request.param(dataclass), request.param(standard)


def described(cls: Any) -> list[tuple[object, ...]]:
    missing = dataclasses.MISSING
    return [
        (f.name, f.type, f.default, f.default_factory is missing, f.init, f.repr, f.compare, f.kw_only)
        for f in dataclasses.fields(cls)
    ]


def test_fields_and_signature_are_the_same(both: tuple[Any, Any]) -> None:
    ours, theirs = both
    assert described(ours) == described(theirs)
    assert str(inspect.signature(ours)) == str(inspect.signature(theirs))
    assert ours.__match_args__ == theirs.__match_args__
    assert ours.__init__.__qualname__ == theirs.__init__.__qualname__
    defaults = [name for f in dataclasses.fields(ours) if hasattr(ours, name := f.name)]
    assert defaults == [f.name for f in dataclasses.fields(theirs) if hasattr(theirs, f.name)]
    assert [repr(getattr(ours, name)) for name in defaults] == [
        repr(getattr(theirs, name)) for name in defaults
    ]


def test_objects_are_made_shown_compared_and_hashed_the_same(both: tuple[Any, Any]) -> None:
    ours, theirs = both
    if ours.__repr__ is not object.__repr__:
        assert repr(ours(3)) == repr(theirs(3))
    for cls in both:
        one, same, other = cls(3), cls(3), cls(-4)
        assert (one == same, one == other, one == 3) == (theirs(3) == theirs(3), False, False)
        assert vars(copy.copy(one)) == vars(one) if hasattr(one, "__dict__") else copy.copy(one) == one
    assert (ours.__hash__ is None) == (theirs.__hash__ is None)
    if ours.__hash__ is not None and ours(3) == ours(3):
        assert hash(ours(3)) == hash(theirs(3))
    assert dataclasses.asdict(ours(3)) == dataclasses.asdict(theirs(3))
    name = dataclasses.fields(ours)[0].name
    assert getattr(dataclasses.replace(ours(3), **{name: 9}), name) == 9


def test_what_the_standard_one_refuses_is_refused_in_the_same_words(both: tuple[Any, Any]) -> None:
    for call in (lambda cls: cls(1, unknown=2), lambda cls: cls(1, 2, 3, 4, 5, 6, 7)):
        said = []
        for cls in both:
            with pytest.raises(TypeError) as caught:
                call(cls)
            said.append(str(caught.value))
        assert said[0] == said[1]


def test_frozen_objects_stay_as_they_are() -> None:
    ours, theirs = frozen(dataclass), frozen(standard)
    for act in (
        lambda one: setattr(one, "a", 2),
        lambda one: delattr(one, "a"),
        lambda one: setattr(one, "z", 2),
    ):
        said = []
        for cls in (ours, theirs):
            with pytest.raises(FrozenInstanceError) as caught:
                act(cls((1,)))
            said.append(str(caught.value))
        assert said[0] == said[1]


def test_factories_make_one_value_for_each_object() -> None:
    ours = plain(dataclass)
    one, other = ours(1), ours(1)
    one.c.append(5)
    one.g.append(5)
    assert (other.c, other.g, ours(1, 2.0, [7]).c) == ([], [], [7])


def test_a_list_as_default_is_refused_by_the_first_object() -> None:
    @dataclass
    class Thing:
        a: list[int] = []  # noqa: RUF012

    with pytest.raises(ValueError, match="mutable default <class 'list'> for field a"):
        Thing()


def test_either_decorator_extends_the_other() -> None:
    """A package of its own derives its joint or load from ours with the standard decorator."""

    @standard(frozen=True)
    class Third(inherited(dataclass)):  # type: ignore[misc]
        """Of another package."""

        more: int = 4

    @dataclass(frozen=True)
    class Fourth(Third):
        """Ours again."""

        most: int = 5

    assert repr(Fourth(-2.0, named=True)).endswith(
        "Fourth(named=True, note='square', side=2.0, more=4, most=5)"
    )
    assert Third(2.0) != Fourth(2.0)
    assert Fourth(2.0, 6, 7, note="x").area() == 4.0


@dataclass(frozen=True)
class Nested:
    """May hold itself."""

    inner: Any = None


def test_pickles_and_what_holds_itself() -> None:
    assert pickle.loads(pickle.dumps(Nested(Nested(3)))) == Nested(Nested(3))
    held: list[Any] = []
    held.append(Nested(held))
    assert repr(held[0]) == "Nested(inner=[...])"


def test_methods_are_written_when_they_are_wanted() -> None:
    ours = plain(dataclass)
    assert not inspect.isfunction(vars(ours)["__init__"])
    ours(1)
    assert inspect.isfunction(vars(ours)["__init__"])
