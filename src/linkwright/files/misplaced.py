"""Parts of a model at a wrong level: each is reported once, and read as if it were where it belongs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Set
from dataclasses import replace
from functools import partial
from itertools import groupby
from typing import Any

from linkwright.actuators.base import ACTUATORS
from linkwright.applied_loads.base import ELSEWHERE, LOADS
from linkwright.fields.nodes import Entry, Node, Scalar, Sequence
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.files.node_reader import MODES, PlainReader, meant_kind
from linkwright.joints.base import JOINTS
from linkwright.mechanism.link import LINK_FIELDS
from linkwright.registry import PROBABLE, nearest
from linkwright.words import _
from linkwright.words.synonyms import meaning

#: Keys under which a list of elements gives their names.
NAMED = ("name", "id")
#: Keys of elements, by which one is distinguished from a section of that name.
OWN = ("points", "kind", "also")


def _elements(node: Node) -> bool:
    return isinstance(node, MappingNode) and all(
        key not in OWN and isinstance(value, MappingNode) for key, value in node
    )


def _modes(node: Node) -> bool:
    return isinstance(node, MappingNode) and all(
        isinstance(value, Scalar) and value.text in MODES for _unused, value in node
    )


def _driver(node: Node) -> bool:
    return isinstance(node, MappingNode) and bool({"turn", "slide", "between"} & {key for key, _unused in node})


def _places(node: Node) -> bool:
    return isinstance(node, MappingNode) and all(
        key not in OWN and isinstance(value, Sequence) for key, value in node
    )


#: Sections that may be indented too far, and how they look.
SECTIONS: Mapping[str, Callable[[Node], bool]] = {
    "links": _elements,
    "joints": _elements,
    "loads": _elements,
    "actuators": _elements,
    "stops": _elements,
    "drivers": _elements,
    "assembly": _modes,
    "drawing": _places,
    "driver": _driver,
    "gravity": lambda node: isinstance(node, Sequence),
}
#: Meanings of names that some give the section of actuators.
DRIVES = frozenset(("input", "brake", "cylinder", "flywheel"))
OUTER = ("frame", "links", "joints", "loads", "actuators", "stops", "assembly", "drawing")
ELEMENTS = ("links", "joints", "loads", "actuators", "stops", "drivers")
#: Sections whose elements have kinds.
KINDS: Mapping[str, Mapping[str, Any]] = {"joints": JOINTS, "loads": LOADS, "actuators": ACTUATORS}


def in_place(reader: PlainReader, root: MappingNode, known: tuple[str, ...]) -> MappingNode:
    """The root of a model with sections and elements where they belong; ``known`` are the sections."""
    root = _sorted(reader, _named(reader, _raised(reader, _of_actuators(reader, root, known))))
    return _lowered(reader, _indented(reader, root), known)


def _of_actuators(reader: PlainReader, root: MappingNode, known: tuple[str, ...]) -> MappingNode:
    """With the section of actuators under its own name where it has that of a kind: ``motors``, ``brakes``."""
    entries = list[Entry]()
    for entry in root.entries:
        name, value = entry.key.text, entry.value
        if name not in known and meaning(name) & DRIVES and _elements(value) and not _drivers(value):
            reader.finding(
                entry.key,
                name,
                _('unknown key "{key_}"'),
                "unknown-key",
                _('motors, brakes, cylinders and flywheels are in one section: write "actuators:"'),
                key_=name[:100],
            )
            entry = Entry(replace(entry.key, text="actuators"), value)
        entries.append(entry)
    return replace(root, entries=entries)


def _drivers(node: Node) -> bool:
    return isinstance(node, MappingNode) and any(_driver(value) for _unused, value in node)


def _raised(reader: PlainReader, root: MappingNode) -> MappingNode:
    """With the sections that stand within other sections."""
    entries, raised = list[Entry](), list[Entry]()
    present = {key for key, _unused in root}
    for entry in root.entries:
        inner = entry.value
        if entry.key.text not in OUTER or not isinstance(inner, MappingNode):
            entries.append(entry)
            continue
        deep = [
            each
            for each in inner.entries
            if each.key.text not in present and SECTIONS.get(each.key.text, _never)(each.value)
        ]
        for each in deep:
            key = f"{entry.key.text}.{each.key.text}"
            where = entry.key.text
            reader.finding(
                each.key,
                key,
                _('the section "{section}" is inside "{within}"'),
                "misplaced",
                _('begin the line "{section}:" where "{within}:" begins'),
                section=each.key.text,
                within=where,
            )
        remaining = [each for each in inner.entries if each not in deep]
        entries.append(Entry(entry.key, replace(inner, entries=remaining)) if deep else entry)
        raised += deep
    return replace(root, entries=[*entries, *raised]) if raised else root


def _never(node: Node) -> bool:
    return False


def _named(reader: PlainReader, root: MappingNode) -> MappingNode:
    """With lists of elements that say their names themselves as tables by name."""
    entries = list[Entry]()
    for entry in root.entries:
        value = entry.value
        if entry.key.text in ELEMENTS and isinstance(value, Sequence):
            named = [_by_name(item) for item in value.items]
            complete = [each for each in named if each is not None]
            if complete and len(complete) == len(named):
                section, first = entry.key.text, complete[0].key.text
                reader.finding(
                    value,
                    section,
                    _('"{section}" is a list; expected a mapping with each entry under its name'),
                    "type",
                    _("write {first}: {{…}} in place of - {{name: {first}, …}}"),
                    section=section,
                    first=first,
                )
                table = MappingNode(value.line, value.column, value.start, value.end, complete)
                entry = Entry(entry.key, table)
        entries.append(entry)
    return replace(root, entries=entries)


def _sorted(reader: PlainReader, root: MappingNode) -> MappingNode:
    """With the elements that stand in the section before their own, the line of which is missing or indented."""
    entries, moved, present = list[Entry](), dict[str, list[Entry]](), {key for key, _unused in root}
    for entry in root.entries:
        table = entry.value
        if entry.key.text in ("frame", *ELEMENTS) and isinstance(table, MappingNode):
            remaining = list[Entry]()
            for section, run in groupby(table.entries, partial(_belongs, within=entry.key.text, there=present)):
                found = [*run]
                if section:
                    moved.setdefault(section, []).extend(_report_misplaced(reader, found, section, entry.key.text))
                else:
                    remaining += found
            entry = (
                Entry(entry.key, replace(table, entries=remaining)) if len(remaining) < len(table.entries) else entry
            )
        entries.append(entry)
    for section, more in moved.items():
        entries = _within(entries, section, more)
    return replace(root, entries=entries) if moved else root


def _belongs(entry: Entry, *, within: str, there: Set[str]) -> str:
    """The section in which an entry of another one belongs; empty where it may be in place."""
    name, value = entry.key.text, entry.value
    if name in ELEMENTS and name not in there and isinstance(value, Scalar) and value.empty:
        return name
    if name in OWN or not isinstance(value, MappingNode):
        return ""
    if kind := value.get("kind"):
        if within == "loads" and isinstance(kind, Scalar) and meaning(kind.text) & ELSEWHERE.keys():
            return ""
        sections = (within, *KINDS) if within in KINDS else KINDS
        found = next((name for name in sections if meant_kind(kind, KINDS[name]) is not None), "")
        return "" if found == within else found
    section = "drivers" if _driver(value) else "links" if value.get("points") is not None else ""
    return "" if section == within else section


def _report_misplaced(reader: PlainReader, found: list[Entry], section: str, within: str) -> list[Entry]:
    """Adjacent misplaced elements, reported once; without the line of their section itself."""
    first, elements = found[0].key, [each for each in found if isinstance(each.value, MappingNode)]
    key = f"{within}.{first.text}"
    if len(elements) < len(found):
        reader.finding(
            first,
            key,
            _('the section "{section}" is inside "{within}"'),
            "misplaced",
            _('begin the line "{section}:" where "{within}:" begins'),
            section=section,
            within=within,
        )
    else:
        names = tuple(each.key.text for each in elements)
        reader.finding(
            first,
            key,
            _('"{within}" contains what belongs in "{section}": {names}'),
            "misplaced",
            _('write the line "{section}:" above the first of them, or move them there'),
            names=names,
            section=section,
            within=within,
        )
    return elements


def _indented(reader: PlainReader, root: MappingNode) -> MappingNode:
    """With the keys of links, joints and loads that are at the level of the element above them, not in it."""
    entries = list[Entry]()
    for entry in root.entries:
        value, section = entry.value, entry.key.text
        if section in ELEMENTS and isinstance(value, MappingNode):
            entry = Entry(entry.key, replace(value, entries=_deepened(reader, value.entries, section)))
        entries.append(entry)
    return replace(root, entries=entries)


def _deepened(reader: PlainReader, entries: list[Entry], section: str) -> list[Entry]:
    """The elements of a section, with values that stand after one in it."""
    found = list[Entry]()
    for entry in entries:
        above = found[-1] if found else None
        table = above.value if above is not None else None
        within = isinstance(table, MappingNode) or (isinstance(table, Scalar) and table.empty)
        if above is None or table is None or not within or not _of_element(entry, section):
            found.append(entry)
            continue
        name = above.key.text
        at = f"{section}.{entry.key.text}"
        reader.finding(
            entry.key,
            at,
            _('"{key_}" is at the level of "{name}", not in it'),
            "misplaced",
            _('indent it further than "{name}:"'),
            name=name,
            key_=entry.key.text,
        )
        own = table.entries if isinstance(table, MappingNode) else []
        more = MappingNode(table.line, table.column, table.start, table.end, [*own, entry])
        found[-1] = Entry(above.key, more)
    return found


def _of_element(entry: Entry, section: str) -> bool:
    """Whether an entry of a section is a key of its elements, and no element."""
    key, inner = entry.key.text, isinstance(entry.value, MappingNode)
    if section == "links":
        return key in LINK_FIELDS and (not inner or key in ("points", "also"))
    if inner or section not in KINDS:
        return False
    return key == "kind" or any(key in kind.fields() for kind in KINDS[section].values())


def _by_name(item: Node) -> Entry | None:
    """An element of a list under its name: ``{name: crank, …}`` or ``crank: {…}``."""
    if not isinstance(item, MappingNode):
        return None
    if len(item.entries) == 1 and isinstance(item.entries[0].value, MappingNode):
        return item.entries[0]
    for each in item.entries:
        if each.key.text in NAMED and isinstance(each.value, Scalar):
            return Entry(each.value, replace(item, entries=[other for other in item.entries if other is not each]))
    return None


def _lowered(reader: PlainReader, root: MappingNode, known: tuple[str, ...]) -> MappingNode:
    """With the elements that are at the level of their section."""
    lowered: dict[str, list[Entry]] = {}
    entries = list[Entry]()
    for entry in root.entries:
        section = _section_of(entry, known)
        if not section:
            entries.append(entry)
            continue
        name = entry.key.text
        reader.finding(
            entry.key,
            name,
            _('"{name}" is at the level of the section "{section}", not in it'),
            "misplaced",
            _('indent it below "{section}:"'),
            name=name,
            section=section,
        )
        lowered.setdefault(section, []).append(entry)
    for section, more in lowered.items():
        entries = _within(entries, section, more)
    return replace(root, entries=entries) if lowered else root


def _section_of(entry: Entry, known: tuple[str, ...]) -> str:
    """The section of an element that is no section itself; empty where it is none, or a driver by another word."""
    name, section = entry.key.text, _belongs(entry, within="", there={*known})
    if not section or section == "drivers" or name in known or nearest(name[:100], known, PROBABLE) == "frame":
        return ""
    return section


def _within(entries: list[Entry], section: str, more: list[Entry]) -> list[Entry]:
    """The entries of the root with further ones of a section, which may be empty or not be there."""
    for index, entry in enumerate(entries):
        if entry.key.text != section:
            continue
        value = entry.value
        own = value.entries if isinstance(value, MappingNode) else []
        if isinstance(value, MappingNode) or (isinstance(value, Scalar) and value.empty):
            table = MappingNode(value.line, value.column, value.start, value.end, [*own, *more])
            return [*entries[:index], Entry(entry.key, table), *entries[index + 1 :]]
        return entries
    first = more[0].key
    table = MappingNode(first.line, first.column, first.start, first.end, more)
    return [*entries, Entry(replace(first, text=section), table)]
