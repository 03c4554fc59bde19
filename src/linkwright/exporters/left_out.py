"""What a file for another program does not say of a machine, as the command prints it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.core.table import Table, Tabular
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _
from linkwright.words.message import in_language


@dataclass(frozen=True)
class LeftOut(Tabular):
    """Sentences about what the file of a machine in a ``format`` leaves out or says in another way."""

    name: str
    format: str
    remarks: tuple[Message, ...]

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The sentences below a title; no table where the file says everything."""
        if not self.remarks:
            return ()
        title = _("What a file of {format} does not say of {name!r}", format=self.format, name=self.name)
        return (Table(title=title, notes=list(self.remarks)),)

    def data(self) -> Mapping[str, Any]:
        """Plain data: the sentences in English."""
        return {"left_out": [in_language(each, "en") for each in self.remarks]}


def dynamics_left_out(mechanism: Mechanism) -> list[Message]:
    """The sentence about masses and forces, where a machine has some."""
    massive = any(each.mass or each.inertia for each in mechanism.links.values())
    if massive or any(mechanism.gravity) or mechanism.loads or mechanism.actuators or mechanism.stops:
        return [_("Masses, loads, gravity, stops and characteristics of motors are left out.")]
    return []
