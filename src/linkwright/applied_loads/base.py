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
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.applied_loads.keys import magnitude_fields
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.signals import Signals
from linkwright.applied_loads.site import Mechanism, Site, Wrench
from linkwright.applied_loads.sizes import OverCycle, Ramp
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.fields.base import REQUIRED, Field, Quantities, Quantity, Schema, Word, file_key, table_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.nodes import Scalar as ScalarNode
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import (
    LinkName,
    LinkNames,
    LinkPoint,
    OutputName,
    PointName,
    PointPair,
    PointReference,
    PointReferences,
)
from linkwright.joints.base import JointName
from linkwright.registry import Registry
from linkwright.words import Message, _
from linkwright.words.message import together
from linkwright.words.synonyms import meaning

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats

__all__ = [
    "LOADS",
    "LinkPoint",
    "Load",
    "Magnitude",
    "Output",
    "joint",
    "link",
    "links",
    "magnitude",
    "output",
    "point",
    "point_of",
    "points",
    "quantity",
    "ray",
    "values",
    "word",
]


@dataclass(frozen=True, kw_only=True)
class Load:
    """A load on the mechanism; ``name`` is its name in the model.

    ``section``: of the model file; ``exactly_one`` lists groups of keys of which exactly one must be set.
    """

    kind: ClassVar[str]
    section: ClassVar[str] = "loads"
    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = ()
    name: str

    @classmethod
    def fields(cls) -> dict[str, Field]:
        """The keys of a file by their names; of a magnitude several."""
        found: dict[str, Field] = {}
        for each in dataclasses.fields(cls):
            found |= {each.name: each.metadata["field"]} if "field" in each.metadata else {}
            found |= each.metadata.get("magnitude", {})
        return found

    @classmethod
    def of(cls, name: str, values: Mapping[str, Any]) -> Load:
        """A load of this kind from values by the keys of :meth:`fields`."""
        return cls(name=name, **cls._gathered(values))

    @classmethod
    def _gathered(cls, values: Mapping[str, Any]) -> dict[str, Any]:
        """The attributes from values by key."""
        found = dict(values)
        for each in dataclasses.fields(cls):
            if keys := each.metadata.get("magnitude"):
                own = {key: found.pop(key, None) for key in keys}
                found[each.name] = Magnitude.of(own)
        return found

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
        """Checks across fields; ``report(key, message, remedy)`` adds a finding. A kind may replace this."""

    def wrenches(self, site: Site) -> list[Wrench]:
        """The load's forces and torques on the links, those on the frame included.

        One formula for numbers and for traced values: ``+ - * /``, ``sqrt`` and ``select`` only.
        """
        raise NotImplementedError(f'the load kind "{self.kind}" does not say its wrenches')

    @property
    def magnitude(self) -> Magnitude:
        """What ``site.magnitude()`` gives."""
        own = type(self).from_cycle is not Load.from_cycle
        return Magnitude(OverCycle(self.from_cycle)) if own else Magnitude()

    def from_cycle(self, signals: Signals) -> Floats:
        """What ``site.magnitude()`` gives at each position, (n,), where a kind has no formula of it.

        Such a load goes one design at a time in sweeps.
        """
        raise NotImplementedError

    def reverses(self, mechanism: Mechanism) -> Output | RelativeAngle | None:
        """What it is at whose limits the load changes its sign, because it goes by the sign of a velocity."""
        return None

    @classmethod
    def schema(cls) -> Schema:
        """JSON Schema of the load in a file."""
        found = table_schema({"kind": Word((cls.kind,), required=True), **cls.fields()})
        doc = " ".join((cls.__doc__ or "").partition("\n\n")[0].split())
        return {"title": cls.kind, "description": doc, **found}

    def fields_with_values(self) -> Iterator[tuple[str, Field, Any]]:
        """Keys, fields and values of the load, see :meth:`fields`."""
        for each in dataclasses.fields(self):
            value = getattr(self, each.name)
            if "field" in each.metadata:
                yield each.name, each.metadata["field"], value
            elif keys := each.metadata.get("magnitude"):
                yield from ((key, keys[key], part) for key, part in value.by_key.items())

    @property
    def acts_on(self) -> str | None:
        """The link that it names alone, of several the first."""
        return next((value for _unused, each, value in self.fields_with_values() if isinstance(each, LinkName)), None)

    @property
    def pair(self) -> tuple[str, ...]:
        """The two links between which it acts; none where it names no pair."""
        return next((value for _unused, each, value in self.fields_with_values() if isinstance(each, LinkNames)), ())

    @property
    def named_points(self) -> tuple[LinkPoint, ...]:
        """The points that it names."""
        found: list[LinkPoint] = []
        for _unused, each, value in self.fields_with_values():
            if isinstance(each, PointName) and value is not None:
                found.append(LinkPoint(getattr(self, each.of), value))
            elif isinstance(each, PointReference | PointReferences) and value is not None:
                found += [value] if isinstance(value, LinkPoint) else value
        return tuple(found)

    def dimensions(self) -> dict[str, float]:
        """Addresses ``SECTION.NAME.FIELD`` of the load's dimensions with their SI values."""
        return {
            f"{self.section}.{self.name}.{each.key or name}{suffix}": number
            for name, each, value in self.fields_with_values()
            for suffix, number in each.flatten(value).items()
        }

    def with_dimensions(self, value: Callable[[str], float]) -> Load:
        """The same load with the values that ``value`` gives for the addresses of ``dimensions``."""

        def rebuilt(name: str, each: Field, part: Any) -> Any:
            address = f"{self.section}.{self.name}.{each.key or name}"
            return each.rebuild(part, lambda suffix: value(address + suffix))

        return dataclasses.replace(
            self,
            **self._gathered({name: rebuilt(name, each, part) for name, each, part in self.fields_with_values()}),
        )

    def written(self) -> dict[str, Any]:
        """The load as plain data for a file."""
        usual = {each.name: each.default for each in dataclasses.fields(self)}
        written_keys = (
            each for each in self.fields_with_values() if each[2] is not None and each[2] != usual.get(each[0])
        )
        return {"kind": self.kind, **{each.key or name: each.written(value) for name, each, value in written_keys}}


LOADS: Registry[type[Load]] = Registry(
    _("load kind"), "linkwright.applied_loads", entry_points="linkwright.loads", attribute="kind"
)


_ACTUATOR = _("motors, brakes and flywheels act in motion under forces: write them under actuators")
#: What some take for a kind of load, by its meaning, and the message that says where it belongs.
ELSEWHERE = {
    "gravity": _("gravity is a key of the model, not a load: gravity: [0, -9.81 m/s²]"),
    "mass": _("gravity is a key of the model, not a load: gravity: [0, -9.81 m/s²]"),
    "input": _ACTUATOR,
    "brake": _ACTUATOR,
    "flywheel": _ACTUATOR,
    "friction": _("friction is a key of pins and guides under joints: friction: 0.1, of a pin with pin_radius: 5 mm"),
}


def read_load(reader: Reader, node: Node, place: Place, name: str) -> Load | None:
    """The load at a node of a file, or None after findings."""
    return read_kind(reader, node, place, name, LOADS, ELSEWHERE, _("the load has no kind"))


def read_kind(
    reader: Reader,
    node: Node,
    place: Place,
    name: str,
    kinds: Mapping[str, type[Load]],
    elsewhere: Mapping[str, Message],
    missing: Message,
) -> Load | None:
    """A load of one of the ``kinds`` at a node of a file, or None after findings; ``elsewhere``: what is none of
    them, by its meaning; ``missing``: the finding where there is no kind."""
    before = reader.error_count
    kind_node = node.get("kind") if isinstance(node, MappingNode) else None
    text = kind_node.text if isinstance(kind_node, ScalarNode) and kind_node.text not in kinds else ""
    for concept in meaning(text) & elsewhere.keys() if text else ():
        problem = _('"{text}" is not known here', code="model.unknown_word", text=text)
        reader.error(kind_node, place.child("kind"), problem, elsewhere[concept], "unknown-word")
        return None
    read = reader.of_kind(node, place, kinds, missing, _("write kind: one of {kinds}"))
    if read is None:
        return None
    mapping, cls, found = read
    present = {name for name, each in cls.fields().items() if mapping.get(each.key or name) is not None}
    _check_choices(reader, node, place, cls, present)

    def report(key: str, message: str, remedy: str) -> None:
        reader.error(mapping.get(key) or node, place.child(key) if key else place, message, remedy, "load")

    if reader.error_count == before:
        if isinstance(found.get("ramp"), Ramp) and found.get("phase") is None:
            report(
                "ramp",
                _("a ramp needs a phase, and there is none", code="loads.ramp_without_phase"),
                _("add phase: {{input: [from, to]}} or another"),
            )
        cls.check(found, report)
    return cls.of(name, found) if reader.error_count == before else None


def _check_choices(reader: Reader, node: Node, place: Place, cls: type[Load], present: set[str]) -> None:
    for group in cls.exactly_one:
        chosen = [name for name in group if name in present]
        if not chosen:
            problem, remedy = (
                _("none of {words} is set", code="loads.none_given", words=group),
                _("give exactly one of them"),
            )
            reader.error(node, place, problem, remedy, "choice")
        elif len(chosen) > 1:
            problem = _("{keys} are both set", code="loads.both_given", keys=together(chosen))
            reader.error(node, place, problem, _("keep one of {words}", words=group), "choice")


def declares(kind: type[Field]) -> Callable[..., Any]:
    """A function that declares an attribute of a load: from the arguments of a field, and its default; without one
    a file must give it."""

    def declare(*arguments: Any, default: Any = REQUIRED, **options: Any) -> Any:
        return file_key(kind(*arguments, **options), default)

    return declare


#: A quantity in SI of a dimension named in ``units.DIMENSIONS``; limits in SI.
quantity = declares(Quantity)
#: A list of quantities of one dimension, by ``names`` (x, y) or of a fixed ``count``.
values = declares(Quantities)
#: The name of a link; ``moving`` excludes the frame. The names of two different links ``[a, b]``.
link, links = declares(LinkName), declares(LinkNames)
#: The name of a point of the link that the earlier field ``of`` names; two points ``[P, Q]`` of it.
point_of, ray = declares(PointName), declares(PointPair)
#: A point of the mechanism, a LinkPoint; a pair of these.
point, points = declares(PointReference), declares(PointReferences)
#: An Output of the mechanism.
output = declares(OutputName)


def joint(*coordinates: str, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """The name of a joint with one of the coordinates ``turn`` and ``slide`` (default: either)."""
    return file_key(JointName(coordinates or ("turn", "slide"), doc=doc, key=key), default)


def word(*choices: str, default: Any = REQUIRED, doc: str = "", key: str = "") -> Any:
    """One of a few words."""
    return file_key(Word(choices, doc=doc, key=key), default)


def magnitude(dimension: str, *, word: str = _("magnitude")) -> Any:
    """A Magnitude, with the keys ``magnitude``, ``ramp``, ``table`` and ``phase``; ``word``: what it is."""
    return dataclasses.field(default=Magnitude(), metadata={"magnitude": magnitude_fields(dimension, word)})


def check_between(values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
    """For ``Load.check``: the two points of ``between`` are on different links."""
    ends = values.get("between")
    if ends is not None and ends[0].link == ends[1].link:
        problem = _(
            'both points are on the link "{link}", so the load does nothing',
            code="loads.same_link",
            link=ends[0].link,
        )
        report("between", problem, _("name points of two links"))
