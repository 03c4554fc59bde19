"""What every section of a report supplies, and their registry.

A section is one function, registered under its name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TypeVar

from linkwright.registry import Registry
from linkwright.reports.document import Block
from linkwright.words import Message, _


@dataclass(frozen=True)
class Section:
    """One section; ``rank``: its place unless the user orders them; ``optional``: left out without a word where
    it has nothing to show (raises Missing), unless it is asked for by name; ``common``: about all machines of a
    report together; ``blocks``: of one machine, or of all, raise Missing, or another LinkwrightError, where there are
    none."""

    name: str
    title: Message
    rank: float
    optional: bool
    common: bool
    blocks: Callable[..., Iterator[Block]] = field(repr=False)


#: What makes the blocks of a section, of a case or of all cases.
Blocks = TypeVar("Blocks", bound=Callable[..., Iterator[Block]])
SECTIONS: Registry[Section] = Registry(_("section of reports"), "linkwright.reports.sections")


def section(
    name: str, title: Message, rank: float, *, optional: bool = False, common: bool = False
) -> Callable[[Blocks], Blocks]:
    """Decorator that registers a function as a section: of one machine, or with ``common`` of all of them."""

    def registered(blocks: Blocks) -> Blocks:
        of_all = blocks if common else lambda cases: blocks(cases[0])
        SECTIONS.register(name)(Section(name, title, rank, optional, common, of_all))
        return blocks

    return registered


def section_names() -> list[str]:
    """Names of all sections in the order in which they stand."""
    return sorted(SECTIONS, key=lambda name: SECTIONS[name].rank)
