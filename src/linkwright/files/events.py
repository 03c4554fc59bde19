"""The events of a YAML text with their places, from libyaml where its parser in C is there.

Only the parser is used: what a scalar means is decided here by the rules of YAML 1.2, and no tag makes an object.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from functools import cache
from itertools import accumulate
from typing import Any

from linkwright.fields.nodes import Mapping, Node, Sequence

#: What libyaml takes for the end of a line, and YAML 1.2 does not.
_OLD_BREAKS = re.compile("[\x85\u2028\u2029]")
#: Colons without a space that are put right in one text, at most.
MOST_SHIFTS = 20
_PAIR = re.compile(r"(?<!\\)(?:\\\\)*(\\u[dD][89abAB][0-9a-fA-F]{2})(\\u[dD][c-fC-F][0-9a-fA-F]{2})")


def event_reader(text: str) -> Callable[[], Any]:
    """A function that gives the next event of a text; raises yaml.YAMLError where the text is no YAML."""
    get_event: Callable[[], Any] = _parser()(_OLD_BREAKS.sub(" ", text)).get_event
    return get_event


@cache
def _parser() -> Callable[[str], Any]:
    try:
        from yaml._yaml import CParser
    except ImportError:
        return _pure_parser()
    parser: Callable[[str], Any] = CParser
    return parser


def _pure_parser() -> Callable[[str], Any]:
    """The parser in Python of the same package; it gives the same events, more slowly."""
    from yaml.parser import Parser
    from yaml.reader import Reader
    from yaml.scanner import Scanner

    class PureParser(Reader, Scanner, Parser):  # type: ignore[misc]
        def __init__(self, text: str) -> None:
            Reader.__init__(self, text)
            Scanner.__init__(self)
            Parser.__init__(self)

    return PureParser


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
        if (
            len(self._shifts) >= MOST_SHIFTS
            or self.text[offset : offset + 1] != ":"
            or behind not in tuple(",[]{}")
        ):
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
