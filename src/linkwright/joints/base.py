"""What a joint kind supplies, and the registry of the kinds.

A kind is one file with one frozen dataclass, registered under the word of its key ``kind``: the fields of the model
file, what it leaves and ties of its links, its equation, how it hangs a link in an open chain. Solvers ask the joint
and never its kind. What a kind leaves out is reported when it is needed (:class:`LackingError`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass, fields, replace
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, Self

from linkwright.elements import Connection, PairType
from linkwright.errors import LinkwrightError, Severity
from linkwright.fields.base import Field, Schema
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar
from linkwright.joints.ends import Ends, Hung
from linkwright.registry import Registry
from linkwright.words import Message, _, pgettext

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats
    from linkwright.elements import Drawing, Group, Model, ModelLink, Sizes, TreeJoint
    from linkwright.fields.nodes import Mapping as MappingNode
    from linkwright.fields.nodes import Node
    from linkwright.fields.reading import Place as Where
    from linkwright.fields.reading import Reader
    from linkwright.formula.linear_algebra import Vec
    from linkwright.formula.trace import Mask, Scalar

#: The size of a joint's force, from that force.
Size = Callable[[Scalar], Scalar]


#: Kinds of joints as they are read.
PAIRS = {
    "revolute": _("revolute"),
    "prismatic": _("prismatic"),
    "weld": _("weld"),
    "gear": _("gear"),
    "belt": _("belt"),
    "chain": _("chain"),
    "rack": _("rack and pinion"),
    "rolling": _("rolling"),
    "cam": pgettext("nouns", "cam"),
}


@dataclass(frozen=True)
class Entry:
    """A joint's entry in a model file: its name and place, the values of its keys, the links that were read."""

    reader: Reader
    node: MappingNode
    place: Where
    name: str
    values: dict[str, Any]
    links: Mapping[str, ModelLink]

    def finding(
        self, key: str, problem: Message, remedy: Message, code: str = "reference", severity: Severity = "error"
    ) -> None:
        """Adds a finding at one of the keys, or with ``""`` at the entry itself."""
        place = self.place.child(key) if key else self.place
        node = (key and self.node.get(key)) or self.node
        self.reader.error(node, place, problem, remedy, code, severity=severity)


class Report(Protocol):
    """Adds a finding about a key of a joint."""

    def __call__(self, key: str, problem: Message, remedy: Message, severity: Severity = "error") -> None: ...


@dataclass(frozen=True)
class Kinks:
    """Angles of a link to its carrier, rad, at which a joint goes over from one formula to the next; the dimension
    ``phase``, rad, is added to them."""

    link: str
    carrier: str
    phase: str
    angles: tuple[float, ...]


@dataclass(frozen=True)
class Joint(ABC):
    """A connection of links; ``name`` is its name in the model.

    ``freedoms`` it leaves of three; ``letter`` in signatures; ``coordinate``: what it is measured by as a joint of a
    chain, ``turn`` (rad), ``slide`` (m) or nothing; ``higher``: a pair of one row, which no link hangs on;
    ``rotations_only``: whether that row touches rotations alone; ``uneven``: whether the ratio of the speeds that it
    ties to each other varies;
    ``couples``: whether its reaction has a couple about the place that :meth:`place` gives; ``reported_on``: which of
    the two links of a pair its force is worked out on.
    """

    kind: ClassVar[str]
    letter: ClassVar[str] = "?"
    freedoms: ClassVar[int]
    coordinate: ClassVar[str] = ""
    higher: ClassVar[bool] = False
    rotations_only: ClassVar[bool] = False
    uneven: ClassVar[bool] = False
    couples: ClassVar[bool] = False
    reported_on: ClassVar[int] = 0
    name: str

    @property
    @abstractmethod
    def joined(self) -> tuple[str, ...]:
        """Names of the links that the joint connects."""

    @abstractmethod
    def dimensions(self) -> Mapping[str, float]:
        """Addresses of the joint's dimensions (``guide.offset``) with their SI values."""

    def with_dimensions(self, value: Callable[[str], float]) -> Self:
        """The same joint with the values that ``value`` gives for the addresses of ``dimensions``: those of its
        fields, ``JOINT.FIELD``, or of one that holds several, ``JOINT.FIELD.0`` and so on."""
        new: dict[str, Any] = {}
        for address in self.dimensions():
            key, _unused, index = address.removeprefix(f"{self.name}.").partition(".")
            new[key] = (*new.get(key, ()), value(address)) if index else value(address)
        return replace(self, **new)

    def limit(self, address: str, value: float) -> Message | None:
        """What numbers a dimension takes, where this SI value is none of them: by the field of its key."""
        field = self.fields().get(address.removeprefix(f"{self.name}.").partition(".")[0])
        return None if field is None else field.limit(value)

    def aligned(self, points: Mapping[str, tuple[float, float]]) -> Joint:
        """The same joint, with what follows from its first link's points (a guide's direction) made anew."""
        return self

    def settled(self, mechanism: Model, report: Report) -> Joint:
        """The same joint, with what follows from the joints around it."""
        return self

    def drawn(self, drawing: Drawing) -> Joint:
        """The same joint, with what its file leaves to the drawing."""
        return self

    def rotation_sum(self, drawing: Drawing) -> tuple[Mapping[str, float], float] | None:
        """Factors of links' rotations as drawn (rad, with turns) and a constant, together zero; None if unknown."""
        return None

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        """The keys of the joint in a model file, without ``kind``."""
        raise cls.lacks("fields")

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        """The joint from the values of its keys, or None after a finding."""
        return cls(entry.name, **entry.values)

    @classmethod
    def unpinned(cls, values: Mapping[str, Any]) -> tuple[str, Sequence[str]] | None:
        """A point that several links share by an entry with these words, and the links; the last of them is no
        link of the pin that the shared name would imply."""
        return None

    def written(self) -> dict[str, Any]:
        """Values of the keys that a file needs, as plain data: those that must be there, and those that are not the
        default, which is zero where there is none."""
        usual = {each.name: each.default for each in fields(self)}
        values = {key: (field, getattr(self, key)) for key, field in self.fields().items()}
        return {
            key: field.written(value)
            for key, (field, value) in values.items()
            if field.required or ((value or usual[key] is not MISSING) and value != usual[key])
        }

    # structure --------------------------------------------------------------------------------
    @property
    def ties(self) -> tuple[str, ...]:
        """The two links whose rotations the joint ties to each other, if it does."""
        return ()

    def between(self, a: str, b: str, driver: str | None = None) -> Connection:
        """The joint as a connection of two of its links."""
        pair = PairType(self.kind, self.letter, self.coordinate, self.freedoms, self.higher)
        return Connection(self.name, pair, a, b, driver)

    @property
    def turning(self) -> tuple[str, ...]:
        """The links whose rotations the rows of a higher pair add up."""
        return ()

    @property
    def kinks(self) -> Kinks | None:
        """Where what the joint ties goes over from one formula to the next; None where it has one formula."""
        return None

    @property
    def pairs(self) -> int:
        """As how many pairs the joint counts."""
        return 1

    # motion -----------------------------------------------------------------------------------

    def residual(self, at: Ends) -> list[Scalar]:
        """The equations between the links ``at.a`` and ``at.b``: what they leave open, zero where the joint closes.

        Of a higher pair one row; its multiplier is the force of the pair, N per m of the row.
        """
        raise self.lacks("residual")

    def held(self, at: Ends, force: Scalar, size: Size) -> list[tuple[Scalar, Scalar]]:
        """Rows that other joints keep, each with the multiplier by which the joint's ``force`` presses on it.

        Linear in the force, and in its size where teeth press with either flank: ``size`` gives that.
        """
        return []

    def place(self, at: Ends, link: str) -> Vec:
        """Where the joint's force on a link is reported: the first of its seats."""
        return at.point(*self.seats[0])

    def hang(self, at: Ends, step: TreeJoint, coordinate: Scalar) -> Hung:
        """The joint as one of an open chain, which hangs ``step.child`` on ``step.parent``."""
        raise self.lacks("hang")

    @classmethod
    def linear(cls, group: Group, cut: Connection) -> bool:
        """Whether the row of the pair is linear in the unknowns of a group in which it is cut."""
        return cls.rotations_only

    def fits(self, dimensions: Sizes) -> Mask:
        """Whether the sizes of the pair fit the places of its links, traced."""
        return True

    def misfit(self, mechanism: Model) -> Message | None:
        """What does not fit, where :meth:`fits` is false."""
        return None

    def slide_direction(self, dimensions: Sizes) -> Vec:
        """Unit vector along which point ``at`` of link ``block`` slides from ``through``, in the axes of ``guide``;
        of kinds with a displacement, which have these four as fields."""
        raise self.lacks("slide_direction")

    def turned(self, step: TreeJoint, dimensions: Sizes) -> Scalar:
        """Constant angle of the child's x axis to the parent's, rad, where the joint does not turn."""
        raise self.lacks("turned")

    def turn_of(self, child: str, mechanism: Model) -> float:
        """The same as a number."""
        raise self.lacks("turn_of")

    def point_on(self, link: str) -> str:
        """The point of one of its links by which the joint holds it."""
        return self.name

    @property
    def friction_arm(self) -> float:
        """Friction over the force that presses the parts together: a coefficient, of a turning joint times the
        radius, m; 0 without friction."""
        return 0.0

    def sums(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float], float]:
        """The row of a higher pair as a sum that is zero: factors of links' rotations (rad, with turns), factors of
        guides' displacements (m), and a constant."""
        raise self.lacks("sums")

    def gains(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """Factors of links' rotations and of guides' displacements that together gain nothing while the drivers come
        back; by default those of :meth:`sums`."""
        rotations, slides, _unused = self.sums(mechanism)
        return rotations, slides

    def tied(self, mechanism: Model) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """Factors of the speeds, of links' rotations and of guides' displacements, that the row of a higher pair ties
        to each other in a position of no special kind; by default those of :meth:`sums`."""
        rotations, slides, _unused = self.sums(mechanism)
        return rotations, slides

    def pulls(self, force: Callable[[], Floats]) -> Flags | None:
        """Where (n,) a pair that can only push would have to pull, or a belt to push; None for one that can do both.

        ``force``: gives the multiplier of its row, (n,) N.
        """
        return None

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        """Links with their points that tell where the reaction acts."""
        raise self.lacks("seats")

    @classmethod
    def word(cls) -> Message | str:
        """The kind as it is read; one of another package by its own word."""
        return PAIRS.get(cls.kind, cls.kind)

    @classmethod
    def lacks(cls, what: str) -> LackingError:
        """The error for what the kind does not supply."""
        return LackingError(
            _(
                'a joint of the kind "{kind}" does not supply "{what}", which is needed here; add '
                "the method to its class",
                code="model.kind_lacks",
                kind=getattr(cls, "kind", cls.__name__),
                what=what,
            )
        )


class HigherPair(Joint):
    """Two links, ``joined``, that touch: one row, which prevents one of their freedoms."""

    freedoms: ClassVar[int] = 2
    higher: ClassVar[bool] = True


class LackingError(LinkwrightError):
    """A joint kind does not supply what is asked of it."""


JOINTS: Registry[type[Joint]] = Registry(
    _("joint kind"), "linkwright.joints", entry_points="linkwright.joints", attribute="kind"
)


#: The kind that links imply which share a point's name.
IMPLIED = "revolute"


def implied_joint(name: str, links: tuple[str, ...]) -> Joint:
    """The joint of links that share the point ``name``."""
    kind: Any = JOINTS[IMPLIED]
    joint: Joint = kind(name, links)
    return joint


@dataclass(frozen=True)
class JointName(Field):
    """The name of a joint, one with one of the ``coordinates``: ``turn``, ``slide``."""

    coordinates: tuple[str, ...] = ("turn", "slide")

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds that have one."""
        return tuple(kind for kind in JOINTS if JOINTS[kind].coordinate in self.coordinates)

    def read(self, reader: Reader, node: Node, place: Where, siblings: Mapping[str, Any]) -> str | None:
        name = reader.text(node, place)
        if name is None or not reader.known(node, place, _("joint"), name, list(reader.names.joints)):
            return None
        kind = reader.names.joints[name]
        if JOINTS[kind].coordinate not in self.coordinates:
            reader.finding(
                node,
                place,
                _('the joint "{name}" is {kind}'),
                "reference",
                _("name a joint that is {kinds}"),
                name=name,
                kind=JOINTS[kind].word(),
                kinds=tuple(JOINTS[each].word() for each in self.kinds),
            )
            return None
        return name

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "joint", "x-kinds": list(self.kinds)}
