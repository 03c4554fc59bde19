"""What every Assur group with a closed form supplies.

A group is cut at one pin; chain ``a`` and chain ``b`` run from links solved before to that pin. A chain
that begins with a pin has an ``anchor`` (the pin) and an ``arm`` (from the pin to the cut, in the axes of
its first link, slides at zero); a chain of slides has the cut's place at zero slide as ``anchor``.
``directions`` are unit vectors along which the cut moves with each slide; ``senses`` are -1 for slides whose guide
points the other way, because the group's own link carries it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar
from linkwright.joints.pose import Pose, Rotor
from linkwright.registry import Registry
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.elements import Group, Sizes


@dataclass(frozen=True)
class Chain:
    """One open chain of a group, as the closed form has it."""

    anchor: Vec
    arm: Vec | None = None
    directions: tuple[Vec, ...] = ()
    senses: tuple[float, ...] = ()


@dataclass(frozen=True)
class Solved:
    """Chain coordinates (rotors and slides, chain a first) and what the rates and forces share.

    ``inverse_determinant``: of the Jacobian of the closure (cut of chain a minus cut of chain b);
    ``square``: the radicand, negative out of reach, zero at a singular position;
    ``scale``: the size of ``square`` in a position of best condition;
    ``facts``: numbers that explain a failure.
    """

    coordinates: tuple[Rotor | Scalar, ...]
    inverse_determinant: Scalar
    square: Scalar
    scale: Scalar
    facts: Mapping[str, Scalar] = field(default_factory=dict)


class Dyad(Protocol):
    """A group with a closed form: its specification and its position formula."""

    signature: str
    pattern: tuple[str, str]
    words: tuple[str, str]

    def solve(self, a: Chain, b: Chain, mode: Scalar) -> Solved:
        """Positions; ``mode`` is +1 for the first of ``words`` and -1 for the second."""
        ...

    def at_end(self, facts: Mapping[str, float]) -> str:
        """The group's position where the range of the input ends; a class without it is called singular."""
        ...

    def explain(self, facts: Mapping[str, float]) -> str:
        """Why the group cannot be assembled, from the facts at that position; a ``Sentence`` has other languages."""
        ...


class Tracer(Protocol):
    """Inputs of the closed form of a complete group: poses of links solved before, and the traced dimensions."""

    @property
    def poses(self) -> Mapping[str, Pose]: ...
    @property
    def dimensions(self) -> Sizes: ...


class WholeGroup(Protocol):
    """A closed form for a group of any size: it says which groups it fits, and places all their unknowns at once.

    Registered with the dyads; it has one assembly mode, so ``words`` are empty. ``place`` gives a :class:`Solved`
    whose coordinates stand in the order of ``group.unknowns``; the tracer knows the poses of links solved before, and
    the traced dimensions.
    """

    signature: str
    words: tuple[str, str]

    def fits(self, group: Group) -> bool:
        """Whether this is the closed form of a group."""
        ...

    def place(self, tracer: Tracer, group: Group) -> Solved:
        """The unknowns, the radicand (negative out of reach), and facts for ``explain``."""
        ...

    def explain(self, facts: Mapping[str, float]) -> str:
        """Why the group cannot be assembled."""
        ...


DYADS: Registry[type[Dyad]] = Registry(_("Assur group"), "linkwright.groups", entry_points="linkwright.groups")
