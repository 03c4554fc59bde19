"""The key ``mechanism`` of calculations about a mechanism: a model file, found beside the file that names it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.model.fields import Text
from linkwright.model.file import load
from linkwright.model.mechanism import Mechanism
from linkwright.model.source import GALLERY
from linkwright.parts.base import Problem

if TYPE_CHECKING:
    from typing import Self

MECHANISM = Text(required=True, doc="model file of the mechanism, beside this file, or gallery:NAME")


def load_beside(name: str, folder: Path) -> Mechanism:
    """The mechanism that a file in ``folder`` names; raises ModelError."""
    if name.startswith(GALLERY):
        return load(name)
    return load(folder / name)


class OfMechanism(Problem):
    """A calculation about a mechanism, which its file names."""

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> Self:
        return cls(**{**values, "mechanism": load_beside(values["mechanism"], folder)})
