"""What all loads have in common: the declaration of their keys, and their registry.

A kind of load is one file with one frozen dataclass, registered under the word of its key ``kind``::

    @LOADS.register("spring")
    @dataclass(frozen=True, kw_only=True)
    class Spring(Load):
        between: tuple[LinkPoint, LinkPoint] = points(doc="its two ends")
        stiffness: float = quantity("stiffness", minimum=0, doc="force per elongation")
        free_length: float = quantity("length", minimum=0, default=0.0)

From the declared fields follow the reading of files with all findings, the JSON Schema, the addresses of the
load's dimensions (``loads.NAME.FIELD``) and the writing of files.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.fields.base import (
    REQUIRED,
    Field,
    Quantities,
    Quantity,
    Schema,
    Word,
    given,
    given_by_file,
    table_schema,
)
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.nodes import Scalar as ScalarNode
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import (
    LinkName,
    LinkNames,
    LinkPoint,
    PointName,
    PointPair,
    PointReference,
    PointReferences,
)
from linkwright.fields.signals import Magnitude, OutputName, Phase, PhaseField, Table, TableField
from linkwright.joints.base import JointName
from linkwright.registry import Registry
from linkwright.words.sentence import Sentence, together
from linkwright.words.synonyms import meaning

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats
    from linkwright.engine.trace import Scalar
    from linkwright.kinematics.motion import Motion
    from linkwright.loads.magnitude import Course
    from linkwright.loads.marks import Mark
    from linkwright.loads.signals import Signals
    from linkwright.loads.site import Site, Wrench
    from linkwright.mechanism.mechanism import Mechanism
    from linkwright.worked.load_formulas import LoadFormulas
    from linkwright.worked.page import Step
    from linkwright.worked.terms import Pair, Term

__all__ = [
    "LOADS",
    "LinkPoint",
    "Load",
    "Output",
    "Phase",
    "Table",
    "joint",
    "link",
    "links",
    "magnitude",
    "output",
    "phase",
    "point",
    "point_of",
    "points",
    "quantity",
    "ray",
    "table",
    "values",
    "word",
]


@dataclass(frozen=True, kw_only=True)
class Load:
    """A load on the mechanism; ``name`` is its name in the model.

    ``exactly_one`` lists groups of fields of which exactly one must be given, ``at_most_one`` of which one
    may be.
    """

    kind: ClassVar[str]
    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = ()
    at_most_one: ClassVar[tuple[tuple[str, ...], ...]] = ()
    name: str

    @classmethod
    def fields(cls) -> dict[str, Field]:
        """The declared fields by their attribute names."""
        return given_by_file(cls)

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
        """Checks across fields; ``report(key, message, remedy)`` adds a finding. A kind may replace this."""

    def wrenches(self, site: Site) -> list[Wrench]:
        """The load's forces and torques on the links, those on the frame included.

        One formula for numbers and for traced values: ``+ - * /``, ``sqrt`` and ``select`` only.
        """
        raise NotImplementedError(f'the load kind "{self.kind}" does not say its wrenches')

    def from_cycle(self, signals: Signals) -> Floats | None:
        """What ``site.magnitude()`` gives at each position, (n,), where no formula of :meth:`traced` can.

        Such a load goes one design at a time in sweeps.
        """
        return None

    def traced(self, course: Course) -> Scalar | None:
        """What ``site.magnitude()`` gives, where the kind has a formula of its own; traced, or over arrays.

        None for kinds whose magnitude is a number, an expression, a ramp or a table.
        """
        return None

    @property
    def twist(self) -> tuple[tuple[str, str], float] | None:
        """Links whose angle with turns the load takes, and the angle (rad) near which that begins."""
        return None

    @property
    def turns_with(self) -> str | None:
        """The link with which the direction of the load's force turns."""
        return None

    def reverses(self, mechanism: Mechanism) -> Output | RelativeAngle | None:
        """What it is at whose limits the load changes its sign, because it goes by the sign of a velocity."""
        return None

    def mark(self, motion: Motion, index: int) -> Mark | None:
        """What drawings show at a position; None: the symbol of the kind between or at the points it names."""
        return None

    def worked_force(self, write: LoadFormulas, step: Step, link: str, force: complex) -> Pair | None:
        """The formula of the force (N, frame axes) on a link in worked solutions; None: magnitude and direction."""
        return None

    def worked_couple(self, write: LoadFormulas, step: Step, link: str, torque: float) -> Term | None:
        """The formula of the couple (N·m) on a link; None: its number."""
        return None

    @classmethod
    def schema(cls) -> Schema:
        """JSON Schema of the load in a file."""
        found = table_schema({"kind": Word((cls.kind,), required=True), **cls.fields()})
        doc = " ".join((cls.__doc__ or "").partition("\n\n")[0].split())
        return {"title": cls.kind, "description": doc, **found}

    def dimensions(self) -> dict[str, float]:
        """Addresses ``loads.NAME.FIELD`` of the load's dimensions with their SI values."""
        return {
            f"loads.{self.name}.{each.key or name}{suffix}": value
            for name, each in self.fields().items()
            for suffix, value in each.flatten(getattr(self, name)).items()
        }

    def with_dimensions(self, value: Callable[[str], float]) -> Load:
        """The same load with the values that ``value`` gives for the addresses of ``dimensions``."""

        def rebuilt(name: str, each: Field) -> Any:
            address = f"loads.{self.name}.{each.key or name}"
            return each.rebuild(getattr(self, name), lambda suffix: value(address + suffix))

        return dataclasses.replace(
            self, **{name: rebuilt(name, each) for name, each in self.fields().items()}
        )

    def written(self) -> dict[str, Any]:
        """The load as plain data for a file."""
        found: dict[str, Any] = {"kind": self.kind}
        for each in dataclasses.fields(self):
            value = getattr(self, each.name)
            if "field" in each.metadata and value is not None and value != each.default:
                declared = each.metadata["field"]
                found[declared.key or each.name] = declared.written(value)
        return found


LOADS: Registry[type[Load]] = Registry(
    "load_kind", "linkwright.loads", entry_points="linkwright.loads", attribute="kind"
)


#: What some take for a kind of load, by its meaning, and the sentence that says where it stands.
ELSEWHERE = {
    "gravity": "loads.gravity_is_key",
    "mass": "loads.gravity_is_key",
    "friction": "loads.friction_is_key",
}


def read_load(reader: Reader, node: Node, place: Place, name: str) -> Load | None:
    """The load at a node of a file, or None after findings."""
    before = reader.error_count
    said = node.get("kind") if isinstance(node, MappingNode) else None
    text = said.text if isinstance(said, ScalarNode) and said.text not in LOADS else ""
    for concept in meaning(text) & ELSEWHERE.keys() if text else ():
        problem = Sentence("model.unknown_word", text=text)
        reader.error(said, place.child("kind"), problem, Sentence(ELSEWHERE[concept]), "unknown-word")
        return None
    read = reader.of_kind(node, place, LOADS, "loads.no_kind", "loads.write_kind")
    if read is None:
        return None
    mapping, cls, found = read
    given = {name for name, each in cls.fields().items() if mapping.get(each.key or name) is not None}
    _check_choices(reader, node, place, cls, given)
    if reader.error_count == before:
        cls.check(
            found,
            lambda key, message, remedy: reader.error(
                mapping.get(key) or node, place.child(key) if key else place, message, remedy, "load"
            ),
        )
    if reader.error_count > before:
        return None
    return cls(name=name, **found)


def _check_choices(reader: Reader, node: Node, place: Place, cls: type[Load], given: set[str]) -> None:
    for least, groups in ((1, cls.exactly_one), (0, cls.at_most_one)):
        for group in groups:
            chosen = [name for name in group if name in given]
            if least <= len(chosen) <= 1:
                continue
            problem = Sentence("loads.none_given", words=group), Sentence("loads.give_one")
            if chosen:
                keep = Sentence("loads.keep_one_of", words=group)
                problem = Sentence("loads.both_given", given=together(chosen)), keep
            reader.error(node, place, *problem, "choice")


def quantity(
    dimension: str,
    *,
    default: Any = REQUIRED,
    minimum: float | None = None,
    above: float | None = None,
    nonzero: bool = False,
    doc: str = "",
    key: str = "",
) -> Any:
    """A quantity in SI of a dimension named in ``units.DIMENSIONS``; limits in SI. Without ``default`` it
    is required."""
    return given(
        Quantity(dimension, minimum=minimum, above=above, nonzero=nonzero, doc=doc, key=key), default
    )


def values(
    dimension: str,
    *,
    names: tuple[str, ...] = (),
    count: int | None = None,
    default: Any = REQUIRED,
    doc: str = "",
    key: str = "",
) -> Any:
    """A list of quantities of one dimension, by ``names`` (x, y) or of a fixed ``count``."""
    return given(Quantities(dimension, names, count, doc=doc, key=key), default)


def link(*, moving: bool = False, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """The name of a link; ``moving`` excludes the frame."""
    return given(LinkName(moving=moving, doc=doc, key=key), default)


def links(*, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """The names of two different links ``[a, b]``."""
    return given(LinkNames(doc=doc, key=key), default)


def point_of(of: str, *, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """The name of a point of the link that the earlier field ``of`` names."""
    return given(PointName(of, doc=doc, key=key), default)


def ray(of: str, *, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """Two points ``[P, Q]`` of the link that the earlier field ``of`` names."""
    return given(PointPair(of, doc=doc, key=key), default)


def point(*, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """A point of the mechanism, a LinkPoint."""
    return given(PointReference(doc=doc, key=key), default)


def points(*, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """Two points of the mechanism, a pair of LinkPoints."""
    return given(PointReferences(doc=doc, key=key), default)


def joint(*coordinates: str, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """The name of a joint with one of the coordinates ``turn`` and ``slide`` (default: either)."""
    return given(JointName(coordinates or ("turn", "slide"), doc=doc, key=key), default)


def word(*choices: str, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """One of a few words."""
    return given(Word(choices, doc=doc, key=key), default)


def magnitude(dimension: str, *, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """A quantity (float) or an Expression of parameters, ``t``, ``input`` and outputs."""
    return given(Magnitude(dimension, doc=doc, key=key), default)


def output(*, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """An Output of the mechanism."""
    return given(OutputName(doc=doc, key=key), default)


def table(dimension: str, *, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """A Table of values of a dimension over the input, the time or an output."""
    return given(TableField(dimension, doc=doc, key=key), default)


def phase(*, default: Any = None, doc: str = "when the load acts (default: always)", key: str = "") -> Any:
    """A Phase of the cycle: InputPhase, MovingPhase or SwingPhase; None for the whole cycle."""
    return given(PhaseField(doc=doc, key=key), default)


def check_ramp(values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
    """For ``Load.check``: a ramp needs a phase."""
    if values.get("ramp") is not None and values.get("phase") is None:
        report("ramp", Sentence("loads.ramp_without_phase"), Sentence("loads.add_phase"))


def check_between(values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
    """For ``Load.check``: the two points of ``between`` are on different links."""
    ends = values.get("between")
    if ends is not None and ends[0].link == ends[1].link:
        problem = Sentence("loads.same_link", link=ends[0].link)
        report("between", problem, Sentence("loads.name_two_links"))
