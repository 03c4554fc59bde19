"""The model that a command works on, with the warnings about it."""

from __future__ import annotations

from linkwright.errors import Finding, ModelError
from linkwright.model.file import read_text
from linkwright.model.mechanism import Mechanism
from linkwright.model.source import read_source


def read_model(source: str) -> tuple[Mechanism, list[Finding]]:
    """The mechanism of a path or ``gallery:NAME``, and findings that do not hinder; raises ModelError."""
    mechanism, findings = read_text(*read_source(source))
    if mechanism is None:
        raise ModelError(findings)
    return mechanism, findings
