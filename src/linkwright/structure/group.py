"""What the structure analysis finds: Assur groups in solving order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cached_property

from linkwright.core.dataclass import dataclass
from linkwright.joints.base import JOINTS
from linkwright.structure.trains import GearTrain


@dataclass(frozen=True)
class Connection:
    """One joint between two links. Prismatic: ``a`` carries the guide, ``b`` the block. Weld: b sits on a."""

    joint: str
    kind: str
    a: str
    b: str
    driver: str | None = None

    def other(self, link: str) -> str:
        """The link at the other end."""
        return self.b if link == self.a else self.a

    @property
    def letter(self) -> str:
        return JOINTS[self.kind].letter

    @property
    def turns(self) -> bool:
        """Whether its coordinate in a chain is a rotation."""
        return JOINTS[self.kind].coordinate == "turn"

    @property
    def slides(self) -> bool:
        """Whether its coordinate in a chain is a displacement."""
        return JOINTS[self.kind].coordinate == "slide"

    @property
    def rigid(self) -> bool:
        """Whether it leaves no freedom."""
        return JOINTS[self.kind].freedoms == 0

    @property
    def higher(self) -> bool:
        """Whether it is a higher pair, on which no link hangs."""
        return JOINTS[self.kind].higher


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


@dataclass(frozen=True)
class Structure:
    """Mobility and Assur groups of a mechanism, in solving order.

    ``grubler``: mobility by Grübler's formula, 3n - 2p_L - p_H; ``redundant``: demands on rotations that others
    make already (joint names), added to it, those of higher pairs also in ``passive``; ``parts``: sets of links
    that share nothing but the frame (more than one: several mechanisms in one model); ``trains``: ratios of gears and
    belts with their carriers stopped; ``turned``: of every turning driver the link, the pin and the link
    against which it turns. See the theory page on structure.
    """

    grubler: int
    redundant: tuple[str, ...]
    drivers: tuple[str, ...]
    groups: tuple[Group, ...]
    counts: dict[str, int]
    parts: tuple[tuple[str, ...], ...] = ()
    passive: tuple[str, ...] = ()
    trains: tuple[GearTrain, ...] = ()
    turned: Mapping[str, tuple[str, str, str]] = field(default_factory=dict)

    @property
    def mobility(self) -> int:
        """Number of independent inputs."""
        return self.grubler + len(self.redundant)

    @property
    def mechanism_class(self) -> int:
        """The highest class of its groups."""
        return max((group.assur_class for group in self.groups), default=1)

    def text(self, language: str = "en") -> str:
        """The structure analysis as a student would write it, in English (``en``) or Chinese (``zh``)."""
        from linkwright.structure.text import describe

        return describe(self, language)

    def data(self) -> dict[str, object]:
        """The same as plain data."""
        from linkwright.structure.text import as_data

        return as_data(self)

    @property
    def chain(self) -> str:
        """The groups in solving order: ``RRR(coupler, rocker) + RRP(rod, slider)``."""
        return " + ".join(f"{group.signature}({', '.join(group.links)})" for group in self.groups)

    def __repr__(self) -> str:
        return f"Structure(mobility {self.mobility}; {self.chain}; class {self.mechanism_class})"
