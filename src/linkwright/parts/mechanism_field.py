"""The key ``mechanism`` of calculations about a mechanism: a model file, relative to the file that names it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright.errors import NO_FILE, Finding, ModelError
from linkwright.fields.base import Text
from linkwright.files.model_file import load
from linkwright.files.source import GALLERY
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.words import _

if TYPE_CHECKING:
    from typing import Self

MECHANISM = Text(required=True, doc="model file of the mechanism, relative to this file, or gallery:NAME")


def load_referenced(name: str, folder: Path) -> Mechanism:
    """The mechanism that a file in ``folder`` names.

    Raises:
        ModelError: there is no such file, with a finding at ``mechanism``; or what is wrong in it, at its places.
    """
    try:
        return load(name if name.startswith(GALLERY) else folder / name)
    except ModelError as error:
        if error.findings[0].code not in NO_FILE:
            raise
        missing = error.findings[0]
        message = _("{name}: {message}", name=name, message=missing.message)
        raise ModelError([Finding("error", "", "mechanism", message, missing.remedy, "reference")]) from None


class OfMechanism(Problem):
    """A calculation about a mechanism, which its file names."""

    mechanism: Mechanism

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> Self:
        return cls(**{**values, "mechanism": load_referenced(values["mechanism"], folder)})
