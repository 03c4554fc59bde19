"""What fields and elements see of the reader of a file: values, places of findings, names in the model.

At the end: descriptions of what a key of a model file may hold, from its JSON Schema.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeVar

from linkwright import units
from linkwright.words import _
from linkwright.words.message import Message

if TYPE_CHECKING:
    from linkwright.core.expressions import Expression
    from linkwright.core.outputs import Output
    from linkwright.errors import QuantityError, Severity
    from linkwright.fields.nodes import Mapping as MappingNode
    from linkwright.fields.nodes import Node
    from linkwright.units import Dimension


K = TypeVar("K", bound="Kind")


@dataclass(frozen=True)
class Saying:
    """A section's own message in place of a general one: its code, and the message made from the values."""

    code: str
    message: Callable[..., Message]


#: Sayings by the keys of the general sentences.
Sayings = Mapping[str, Saying]


@dataclass(frozen=True)
class Place:
    """Location of a value: ``key`` in the file, ``address`` among the mechanism's dimensions."""

    key: str
    address: str

    def child(self, name: str) -> Place:
        """A key below, which counts in the address as well."""
        return Place(f"{self.key}.{name}" if self.key else name, f"{self.address}.{name}" if self.address else name)

    def outside(self) -> Place:
        """The same key, where the address leaves out its last name."""
        return Place(self.key, self.address.rpartition(".")[0])


@dataclass
class Names:
    """The names in a model, known before its values are read.

    ``links`` maps every link, the frame among them, to its points; ``joints`` every joint, the implied pins
    among them, to its kind; ``sliding`` what means a displacement to its joint; ``pins`` every implied pin to its
    links, ``blocks`` every block to its guide, ``welded`` a link to the one to which a weld ties it on a pin that
    it would share.
    ``illegible`` are the links whose points cannot be read; ``listed`` where the links themselves can be,
    each under a name of its own.
    """

    links: dict[str, tuple[str, ...]] = field(default_factory=lambda: {"frame": ()})
    joints: dict[str, str] = field(default_factory=dict)
    sliding: dict[str, str] = field(default_factory=dict)
    pins: dict[str, tuple[str, ...]] = field(default_factory=dict)
    blocks: dict[str, str] = field(default_factory=dict)
    welded: dict[str, str] = field(default_factory=dict)
    illegible: set[str] = field(default_factory=set)
    listed: bool = True

    @property
    def incomplete(self) -> bool:
        """Whether pins may be missing, since points cannot be read."""
        return not self.listed or bool(self.illegible)

    _owners: dict[str, list[str]] = field(default_factory=dict)

    def settle(self) -> None:
        """All links are known: note which have a point of which name."""
        self._owners = {}
        for link, points in self.links.items():
            for point in dict.fromkeys(points):
                self._owners.setdefault(point, []).append(link)

    def owners(self, point: str) -> list[str]:
        """The links that have a point of this name."""
        return self._owners.get(point, [])


class Kind(Protocol):
    """A kind of elements that a table may be of."""

    @classmethod
    def fields(cls) -> Mapping[str, Any]:
        """The keys of the table, without ``kind``."""
        ...


class Reader(Protocol):
    """Values from nodes; a method that reads returns None after it has noted a finding."""

    @property
    def names(self) -> Names: ...
    @property
    def source(self) -> str: ...
    @property
    def error_count(self) -> int: ...
    @property
    def kinds(self) -> dict[str, Dimension]: ...
    @property
    def values(self) -> dict[str, float]: ...
    @property
    def used(self) -> set[str]: ...
    @property
    def broken(self) -> set[str]: ...
    def error(
        self,
        node: Node | None,
        place: Place | str,
        message: str,
        remedy: str = "",
        code: str = "",
        *,
        severity: Severity = "error",
    ) -> None: ...
    def finding(
        self,
        node: Node | None,
        place: Place | str,
        message: Message,
        code: str,
        remedy: str,
        /,
        *,
        severity: Severity = "error",
        general: str = "",
        **values: object,
    ) -> None: ...
    def old_key(self, node: Node, place: Place, key: str, new: str) -> None: ...
    def quantity_error(self, error: QuantityError, node: Node, place: Place, text: str) -> None: ...
    def follows(self, text: str) -> bool: ...
    def plain_numbers(self, what: str) -> AbstractContextManager[None]: ...
    def saying(self, own: Sayings) -> AbstractContextManager[None]: ...

    def mapping(self, node: Node | None, place: Place | str) -> MappingNode | None: ...
    def items(self, node: Node, place: Place | str, count: int | None, form: str) -> list[Node] | None: ...
    def free(self, node: Node) -> Any: ...
    def text(self, node: Node, place: Place | str) -> str | None: ...
    def name(self, node: Node, place: Place | str, what: Message) -> str | None: ...
    def word(self, node: Node, place: Place | str, choices: Collection[str]) -> str | None: ...
    def table(self, node: Node, place: Place, fields: Mapping[str, Any]) -> dict[str, Any] | None: ...

    def unknown_keys(self, mapping: MappingNode, place: Place, known: list[str]) -> tuple[MappingNode, set[str]]: ...
    def of_kind(
        self, node: Node, place: Place, kinds: Mapping[str, type[K]], missing: Message, remedy: Message
    ) -> tuple[MappingNode, type[K], dict[str, Any]] | None: ...

    def quantity(self, node: Node, place: Place, dimension: str) -> float | None: ...
    def quantity_text(self, node: Node, place: Place, example: str) -> str | None: ...
    def formula(self, node: Node, place: Place, dimension: str, variables: dict[str, Any]) -> Expression | None: ...
    def magnitude(self, node: Node, place: Place, dimension: str) -> float | Expression | None: ...
    def within(self, value: float, node: Node, place: Place, largest: float, unit: str) -> float | None: ...
    def increasing(
        self, node: Node, place: Place, x_name: str, xs: tuple[float, ...], ys: tuple[float, ...], y_name: str
    ) -> bool: ...

    def known(self, node: Node, place: Place | str, what: Message, name: str, candidates: list[str]) -> bool: ...
    def point_of(self, node: Node, place: Place | str, name: str, link: str) -> bool: ...
    def link_point(self, node: Node, place: Place, text: str) -> Any: ...
    def output(self, node: Node, place: Place, text: str) -> Output | None: ...
    def over(self, node: MappingNode, place: Place) -> tuple[Literal["input", "time"] | Output | None, str]: ...
    def input_dimension(self) -> str: ...


def missing_remedy(key: str, doc: str, shape: Mapping[str, Any]) -> Message:
    """What to write for a missing key: its description, or in other languages its name and its form."""
    own = form(shape)
    return _("add {key_}: {form}", key_=key, form=partial(_described, doc, own) if doc else own)


def _described(doc: str, own: Message, language: str) -> str:
    return doc if language == "en" else own.translate(language)


_NAMES = {
    "link": _("a link's name"),
    "joint": _("a joint's name"),
    "point": _("a point's name"),
    "link.point": _("a point as link.point"),
    "output": _("an output"),
}


def form(shape: Mapping[str, Any]) -> Message:
    """The words for a JSON Schema: ``a length, such as 60.5 mm``; ``list of 2: a link's name``."""
    match shape:
        case {"const": only} | {"enum": [only]}:
            return _("{value}", value=only)
        case {"enum": names}:
            return _("one of {names}", names=tuple(names))
        case {"x-dimension": dimension, "examples": [example, *_]}:
            return _("{noun}, such as {example}", noun=units.NOUNS[dimension], example=example)
        case {"x-dimension": dimension, "anyOf": [*_, {"type": "array"} as listed]}:
            one = {"x-dimension": dimension, "examples": [units.example(dimension)]}
            return _("one of these forms: {several}", several=[form(one), form(listed)])
        case {"x-dimension": dimension, "x-variables": variables}:
            return _("{noun}, an expression of {variables}", noun=units.NOUNS[dimension], variables=tuple(variables))
        case {"x-reference": what}:
            return _NAMES[what]
        case {"anyOf": several}:
            return _("one of these forms: {several}", several=[form(each) for each in several])
        case {"items": item, "minItems": fewest, "maxItems": most} if fewest == most:
            return _("a list of {count}: {item}", count=fewest, item=form(item))
        case {"items": item}:
            return _("a list: {item}", item=form(item))
        case {"additionalProperties": Mapping() as item}:
            return _("a mapping by name: {item}", item=form(item))
        case {"properties": Mapping() as inner}:
            return _("a mapping with keys of {names}", names=tuple(inner))
        case {"type": "boolean"}:
            return _("true or false")
        case {"type": "number"}:
            return _("a number")
        case {"type": "integer"}:
            return _("an integer")
        case {"type": ["string", "number"]}:
            return _("a number or a quantity")
        case {"type": "string"}:
            return _("a text")
    return _("a value")
