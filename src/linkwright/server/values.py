"""Any value of a text, written and taken out by its path; what the reader refuses there is refused."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from linkwright.errors import Finding, LinkwrightError, with_remedy
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.nodes import Sequence as SequenceNode
from linkwright.files.model_file import read_text
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.server.sizes import tidy
from linkwright.words import _

#: Most values in one, and how deep they may stand in each other.
MOST, DEEPEST = 2000, 12


def put(draft: Draft, action: Mapping[str, Any]) -> None:
    """Writes a value at a path of keys; those that are not there yet are made."""
    path, value = _path(action), _plain(action.get("value"))
    if (
        path[0] in ("links", "loads", "actuators", "stops")
        and len(path) > 2
        and _follow(draft.root, path[:2]) is None
    ):
        _no_place(path)
    before = draft.text
    _put(draft, path, tidy(value) if isinstance(value, str) else value)
    accept(draft, before, path)


def unset(draft: Draft, action: Mapping[str, Any]) -> None:
    """Takes the value at a path out, with what is left empty by that."""
    path, before = _path(action), draft.text
    while path:
        parent = _follow(draft.root, path[:-1])
        if not isinstance(parent, MappingNode) or parent.get(path[-1]) is None:
            return
        if len(path) > 1 and len(parent.entries) == 1:
            path = path[:-1]
            continue
        if len(path) == 1:
            draft.cut_top(path[0])
        else:
            draft.cut(parent, path[-1])
        break
    accept(draft, before, path)


def add(draft: Draft, action: Mapping[str, Any]) -> None:
    """A new entry of a section under a fresh name, such as a load: force1."""
    section, stem = request.name(action, "section"), request.name(action, "stem")
    before, entry = draft.text, _plain(request.mapping(action, "entry"))
    assert isinstance(entry, dict)
    written = {key: tidy(value) if isinstance(value, str) else value for key, value in entry.items()}
    name = draft.put_new(section, stem, written)
    accept(draft, before, [section, name])


def _path(action: Mapping[str, Any]) -> list[str]:
    path = action.get("path")
    if not isinstance(path, list) or not 0 < len(path) <= DEEPEST:
        request.refuse("path", "names")
    return [request.name({"path": str(each) if isinstance(each, int) else each}, "path") for each in path]


def _plain(value: Any, depth: int = 0) -> Any:
    """Plain data that a file can have; raises BadRequest for anything else."""
    if depth > DEEPEST:
        request.refuse("value", "mapping")
    if isinstance(value, dict):
        return {
            request.name({"value": key}, "value"): _plain(each, depth + 1) for key, each in list(value.items())[:MOST]
        }
    if isinstance(value, list):
        return [_plain(each, depth + 1) for each in value[:MOST]]
    if isinstance(value, str):
        return request.line({"value": value}, "value")
    if isinstance(value, bool):
        return value
    return request.number({"value": value}, "value")


def _put(draft: Draft, path: Sequence[str], value: Any) -> None:
    parent = _follow(draft.root, path[:-1])
    if parent is None:
        _put(draft, path[:-1], {path[-1]: value})
    elif isinstance(parent, SequenceNode):
        if not path[-1].isdecimal() or int(path[-1]) >= len(parent.items):
            _no_place(path)
        draft.write(parent.items[int(path[-1])], flow(value))
    elif not isinstance(parent, MappingNode):
        draft.write(parent, flow({path[-1]: value}))
    elif len(path) == 1:
        draft.put_top(path[0], value)
    elif (old := parent.get(path[-1])) is not None:
        draft.write(old, flow(value))
    else:
        draft.write_key(parent, path[-1], flow(value))


def _no_place(path: Sequence[str]) -> None:
    raise LinkwrightError(_('the file has no place for "{address}"', code="model.no_place", address=".".join(path)))


def _follow(node: Node | None, path: Sequence[str]) -> Node | None:
    for key in path:
        if isinstance(node, MappingNode):
            node = node.get(key)
        elif isinstance(node, SequenceNode) and key.isdecimal() and int(key) < len(node.items):
            node = node.items[int(key)]
        else:
            return None
    return node


def accept(draft: Draft, before: str, path: Sequence[str]) -> None:
    """Raises LinkwrightError with what is wrong at a place of the text, and was not before."""
    known = {(each.key, each.code) for each in errors(before)}
    place = f"{'.'.join(path)}."
    for each in errors(draft.text):
        here = f"{each.key}."
        if (each.key, each.code) not in known and (here.startswith(place) or place.startswith(here) or not each.key):
            draft.text = before
            raise LinkwrightError(with_remedy(each.message, each.remedy))


def errors(text: str) -> list[Finding]:
    """What is wrong with a text."""
    return [each for each in read_text(text, "model")[1] if each.severity == "error"]
