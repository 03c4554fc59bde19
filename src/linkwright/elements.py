"""What joints, drivers, loads and groups have in common: what they see of a model, and how its links hang together.

A connection carries what is needed of its joint's kind, so that nobody who reads a group looks a kind up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from linkwright.formula.differentiation import Symbols
    from linkwright.formula.linear_algebra import Vec
    from linkwright.formula.trace import Scalar, Trace


class ModelLink(Protocol):
    """A link with its points, m, in its own axes."""

    @property
    def points(self) -> Mapping[str, tuple[float, float]]: ...


class ModelJoint(Protocol):
    """A joint as an element sees it."""

    @property
    def name(self) -> str: ...
    @property
    def coordinate(self) -> str: ...
    @property
    def joined(self) -> tuple[str, ...]: ...
    @property
    def ties(self) -> tuple[str, ...]: ...


class Guide(ModelJoint, Protocol):
    """A guide: a line of the link ``guide`` on which a point of the link ``block`` slides."""

    @property
    def guide(self) -> str: ...
    @property
    def through(self) -> str: ...
    @property
    def direction(self) -> float: ...
    @property
    def block(self) -> str: ...
    @property
    def at(self) -> str: ...
    @property
    def offset(self) -> float: ...
    @property
    def block_angle(self) -> float: ...
    def slide_direction(self, dimensions: Sizes) -> Vec: ...


class Model(Protocol):
    """A machine as its elements see it."""

    @property
    def joints(self) -> Mapping[str, ModelJoint]: ...
    @property
    def guides(self) -> Mapping[str, Guide]: ...
    def link(self, name: str) -> ModelLink: ...


class Sizes(Protocol):
    """The dimensions of a machine by their addresses (``crank.length``), traced or as numbers."""

    @property
    def mechanism(self) -> Model: ...
    @property
    def trace(self) -> Trace: ...
    @property
    def symbols(self) -> Symbols: ...
    @property
    def free(self) -> Set[str]: ...
    def __call__(self, address: str) -> Scalar: ...
    def link(self, name: str) -> ModelLink: ...
    def unit(self, address: str) -> Vec: ...
    def point(self, link: str, point: str) -> Vec: ...


class Drawing(Protocol):
    """An assembled drawing: directions of links, rad, with their turns, and places of points, m; None if unknown."""

    @property
    def mechanism(self) -> Model: ...
    def __bool__(self) -> bool: ...
    def angle(self, link: str) -> float | None: ...
    def place(self, link: str, point: str) -> tuple[float, float] | None: ...


@dataclass(frozen=True)
class PairType:
    """A kind of joint as a kinematic pair.

    ``letter`` in signatures; ``coordinate``: what it is measured by as a joint of a chain, ``turn`` (rad), ``slide``
    (m) or nothing; ``freedoms`` it leaves of three; ``higher``: a pair of one row, which no link hangs on.
    """

    kind: str
    letter: str
    coordinate: str
    freedoms: int
    higher: bool


@dataclass(frozen=True)
class Connection:
    """One joint between two links. Prismatic: ``a`` carries the guide, ``b`` the block. Weld: b sits on a."""

    joint: str
    pair: PairType
    a: str
    b: str
    driver: str | None = None

    def other(self, link: str) -> str:
        """The link at the other end."""
        return self.b if link == self.a else self.a

    @property
    def kind(self) -> str:
        return self.pair.kind

    @property
    def letter(self) -> str:
        return self.pair.letter

    @property
    def turns(self) -> bool:
        """Whether its coordinate in a chain is a rotation."""
        return self.pair.coordinate == "turn"

    @property
    def slides(self) -> bool:
        """Whether its coordinate in a chain is a displacement."""
        return self.pair.coordinate == "slide"

    @property
    def rigid(self) -> bool:
        """Whether it leaves no freedom."""
        return self.pair.freedoms == 0

    @property
    def higher(self) -> bool:
        """Whether it is a higher pair, on which no link hangs."""
        return self.pair.higher


@dataclass(frozen=True)
class TreeJoint:
    """A joint that hangs ``child`` on ``parent`` in an open chain of the group."""

    connection: Connection
    parent: str
    child: str

    @property
    def kind(self) -> str:
        return self.connection.kind

    @property
    def turns(self) -> bool:
        """Whether its coordinate is a rotation."""
        return self.connection.turns

    @property
    def slides(self) -> bool:
        """Whether its coordinate is a displacement."""
        return self.connection.slides

    @property
    def joint(self) -> str:
        return self.connection.joint

    @property
    def driver(self) -> str | None:
        return self.connection.driver

    @property
    def free(self) -> bool:
        """Whether the joint's coordinate is unknown."""
        return not self.connection.rigid and self.driver is None


@dataclass(frozen=True)
class Group:
    """Links that are solved together; a driven link with its frame is a group of class I.

    ``tree``: joints of the open chains that hang from links solved before, parents first;
    ``cuts``: the joints whose closure gives the equations.
    """

    name: str
    links: tuple[str, ...]
    tree: tuple[TreeJoint, ...]
    cuts: tuple[Connection, ...]
    signature: str
    assur_class: int
    assur_order: int

    @cached_property
    def joints(self) -> tuple[Connection, ...]:
        return (*(step.connection for step in self.tree), *self.cuts)

    @cached_property
    def drivers(self) -> tuple[str, ...]:
        return tuple(step.driver for step in self.tree if step.driver is not None)

    @cached_property
    def unknowns(self) -> tuple[TreeJoint, ...]:
        return tuple(step for step in self.tree if step.free)

    @property
    def outer_joints(self) -> tuple[Connection, ...]:
        return tuple(c for c in self.joints if c.a not in self.links or c.b not in self.links)

    @property
    def inner_joints(self) -> tuple[Connection, ...]:
        return tuple(c for c in self.joints if c.a in self.links and c.b in self.links)

    def path(self, link: str) -> Iterator[TreeJoint]:
        """The chain of a link, from the link down to a link solved before."""
        hung = {step.child: step for step in self.tree}
        while link in hung:
            step = hung[link]
            yield step
            link = step.parent

    def carried_steadily(self, cut: Connection) -> bool:
        """Whether nothing that the group turns carries an end of a cut, but its first link about its own pin."""
        about = [step for end in (cut.a, cut.b) for step in self.path(end) if step.free and step.turns]
        return all(step.child == cut.a for step in about)
