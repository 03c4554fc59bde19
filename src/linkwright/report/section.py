"""What every section of a report supplies, and their registry.

A section is one function, registered under its name; its title is the word ``report.title_NAME``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import field

from linkwright.core.dataclass import dataclass
from linkwright.registry import Registry
from linkwright.report.case import Case
from linkwright.report.document import Block


@dataclass(frozen=True)
class Section:
    """One section; ``rank``: where it stands unless the user orders them; ``optional``: left out without a word where
    it has nothing to show, unless it is asked for by name; ``common``: about all machines of a report together;
    ``blocks``: of one machine, or of all, raise Missing, or another LinkwrightError, where there are none."""

    name: str
    rank: float
    optional: bool
    common: bool
    blocks: Callable[[Sequence[Case]], Iterator[Block]] = field(repr=False)


SECTIONS: Registry[Section] = Registry("report_section", "linkwright.report.sections")


def section(
    name: str, rank: float, *, optional: bool = False
) -> Callable[[Callable[[Case], Iterator[Block]]], Callable[[Case], Iterator[Block]]]:
    """Decorator that registers a function as a section about one machine."""

    def registered(blocks: Callable[[Case], Iterator[Block]]) -> Callable[[Case], Iterator[Block]]:
        SECTIONS.register(name)(Section(name, rank, optional, False, lambda cases: blocks(cases[0])))
        return blocks

    return registered


def common_section(
    name: str, rank: float, *, optional: bool = False
) -> Callable[[Callable[[Sequence[Case]], Iterator[Block]]], Callable[[Sequence[Case]], Iterator[Block]]]:
    """Decorator that registers a function as a section about all machines together."""

    def registered(
        blocks: Callable[[Sequence[Case]], Iterator[Block]],
    ) -> Callable[[Sequence[Case]], Iterator[Block]]:
        SECTIONS.register(name)(Section(name, rank, optional, True, blocks))
        return blocks

    return registered
