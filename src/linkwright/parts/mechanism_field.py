"""The key ``mechanism`` of calculations about a mechanism: a model file, found beside the file that names it."""

from __future__ import annotations

from pathlib import Path

from linkwright.model.fields import Text
from linkwright.model.file import load
from linkwright.model.mechanism import Mechanism
from linkwright.model.source import GALLERY

MECHANISM = Text(required=True, doc="model file of the mechanism, beside this file, or gallery:NAME")


def load_beside(name: str, folder: Path) -> Mechanism:
    """The mechanism that a file in ``folder`` names; raises ModelError."""
    if name.startswith(GALLERY):
        return load(name)
    return load(folder / name)
