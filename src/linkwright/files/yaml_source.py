"""The tree of a YAML text with its places, by libyaml where its parser in C is there, and the text as it wants it.

``BaseLoader`` leaves every scalar a text: what it means is decided by the rules of YAML 1.2; no tag makes an object.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from itertools import accumulate
from typing import Any

import yaml

from linkwright.fields.nodes import MAX_DEPTH, MAX_NODES, Mapping, Node, Remark, Sequence
from linkwright.words import Message, _

#: What libyaml takes for the end of a line, and YAML 1.2 does not.
_OLD_BREAKS = re.compile("[\x85\u2028\u2029]")
#: Colons without a space that are put right in one text, at most.
MOST_SHIFTS = 20
_PAIR = re.compile(r"(?<!\\)(?:\\\\)*(\\u[dD][89abAB][0-9a-fA-F]{2})(\\u[dD][c-fC-F][0-9a-fA-F]{2})")
_BASE: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)


class Refused(Exception):
    """A text that no tree is made of, with the remark that says why."""

    def __init__(self, mark: Any, message: str, remedy: Message, *, code: str) -> None:
        self.remark = Remark(mark.line, mark.column, message, remedy.format(), code)


def check_count(count: int, mark: Any) -> None:
    """Refuse more values than a model can have."""
    if count > MAX_NODES:
        message, remedy = _("the file holds too many values"), _("a model needs far fewer; remove aliases")
        raise Refused(mark, message.format(), remedy, code="size")


class _Loader(_BASE):  # type: ignore[misc]
    """Ends where a text is too deep or too long for a model: libyaml's composer has no bounds of its own."""

    depth = count = 0

    def descend_resolver(self, parent: Any, index: Any) -> None:
        """Called before every value."""
        self.depth, self.count = self.depth + 1, self.count + 1
        if self.depth > MAX_DEPTH + 1:
            message = _("nested deeper than {most} levels", most=MAX_DEPTH)
            raise Refused(parent.start_mark, message, _("a model needs at most ten"), code="depth")
        if parent is not None:
            check_count(self.count, parent.start_mark)

    def ascend_resolver(self) -> None:
        """Called after every value."""
        self.depth -= 1


def root_node(text: str) -> Any:
    """PyYAML's node of a text's document, None where there is none; raises YAMLError and Refused."""
    return yaml.compose(_OLD_BREAKS.sub(" ", text), Loader=_Loader)


class Source:
    """A text as the parser gets it, and where its characters stood before.

    Escaped pairs (``\\ud83d\\ude00``, as JSON writes them) become one escape, two characters shorter; ``part`` puts a
    space behind a colon that libyaml takes for a part of a word.
    """

    def __init__(self, text: str) -> None:
        self._before = text
        self._shifts: list[tuple[int, int]] = []  # from this offset on, so many characters were there more
        self.text = _PAIR.sub(self._join, text) if "\\u" in text else text

    def _join(self, found: re.Match[str]) -> str:
        code = 0x10000 + ((int(found[1][2:], 16) - 0xD800) << 10) + int(found[2][2:], 16) - 0xDC00
        gone = 2 * len(self._shifts)
        self._shifts.append((found.end() - gone - 2, 2))
        return f"{found[0][:-12]}\\U{code:08x}"

    def part(self, offset: int) -> bool:
        """Whether a colon of a mapping in braces stood at the offset, and has a space behind it now."""
        behind = self.text[offset + 1 : offset + 2]
        if len(self._shifts) >= MOST_SHIFTS or self.text[offset : offset + 1] != ":" or behind not in tuple(",[]{}"):
            return False
        self.text = f"{self.text[: offset + 1]} {self.text[offset + 1 :]}"
        later = [(at + 1 if at > offset else at, shift) for at, shift in self._shifts]
        self._shifts = sorted([*later, (offset + 2, -1)])
        return True

    def restore(self, root: Node) -> None:
        """Gives every node below its place in the text as it was."""
        if not self._shifts:
            return
        offsets = [at for at, _ in self._shifts]
        sums = [0, *accumulate(shift for _, shift in self._shifts)]
        breaks = [at for at, character in enumerate(self._before) if character == "\n"]
        for node in _below(root):
            node.start += sums[bisect_right(offsets, node.start)]
            node.end += sums[bisect_right(offsets, node.end)]
            node.line = bisect_left(breaks, node.start)
            node.column = node.start - (breaks[node.line - 1] + 1 if node.line else 0)


def _below(root: Node) -> list[Node]:
    """Every node of a tree once, also where an alias makes it stand in several places."""
    found: dict[int, Node] = {}
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if id(node) not in found:
            found[id(node)] = node
            if isinstance(node, Sequence):
                waiting += node.items
            elif isinstance(node, Mapping):
                waiting += [each for entry in node.entries for each in (entry.key, entry.value)]
    return list(found.values())
